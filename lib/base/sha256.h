// sha256.h: incremental SHA-256 (FIPS 180-4).
#pragma once

#include <stddef.h>
#include <stdint.h>

#define SHA256_DIGITS 64

typedef struct Sha256 {
    uint32_t state[8];
    uint64_t length; // number of bytes added
    unsigned char block[64];
} Sha256;

Sha256 sha256_new(void);
void sha256_add(Sha256 *hash, const char *text, size_t length);
// Writes the hash as hexadecimal digits without a NUL byte. `hash` must not be used after this call.
void sha256_end(Sha256 *hash, char digits[SHA256_DIGITS]);
// Writes the hash of `length` bytes like sha256_end.
void sha256_of(const char *text, size_t length, char digits[SHA256_DIGITS]);
