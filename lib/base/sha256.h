// sha256.h: the SHA-256 of a text (FIPS 180-4) that comes in pieces.
#ifndef PETRI_BASE_SHA256_H
#define PETRI_BASE_SHA256_H

#include <stddef.h>
#include <stdint.h>

#define SHA256_DIGITS 64

typedef struct Sha256 {
    uint32_t state[8];
    uint64_t length; // of what was added, in bytes
    unsigned char block[64];
} Sha256;

Sha256 sha256_new(void);
void sha256_add(Sha256 *hash, const char *text, size_t length);
// Writes the hexadecimal digits, without a zero byte behind them. Nothing can be added afterwards.
void sha256_end(Sha256 *hash, char digits[SHA256_DIGITS]);

#endif
