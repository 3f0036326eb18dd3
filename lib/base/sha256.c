// sha256.c: see sha256.h.
#include "base/sha256.h"

#include "base/sha256_blocks.h"

#include <string.h>

// Returns the initial state: the first 32 bits of the fractional parts of the square roots of the first 8 primes.
Sha256 sha256_new(void) {
    return (Sha256){
        .state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19}};
}

void sha256_add(Sha256 *hash, const char *text, size_t length) {
    if (length == 0)
        return; // `text` may be NULL
    size_t used = hash->length % sizeof hash->block;
    hash->length += length;
    if (used > 0) {
        size_t room = sizeof hash->block - used, part = length < room ? length : room;
        memcpy(hash->block + used, text, part);
        if (part < room)
            return;
        sha256_blocks(hash->state, hash->block, 1);
        text += part;
        length -= part;
    }
    size_t blocks = length / sizeof hash->block, rest = length % sizeof hash->block;
    sha256_blocks(hash->state, (const unsigned char *)text, blocks);
    if (rest > 0)
        memcpy(hash->block, text + length - rest, rest);
}

void sha256_end(Sha256 *hash, char digits[SHA256_DIGITS]) {
    static const char padding[64] = {(char)0x80};
    uint64_t bits = 8 * hash->length;
    char size[8];
    for (int i = 0; i < 8; i++)
        size[i] = (char)(bits >> (56 - 8 * i));
    sha256_add(hash, padding, 1 + (119 - hash->length % 64) % 64); // leaves 8 bytes of the last block for the size
    sha256_add(hash, size, sizeof size);
    for (int i = 0; i < SHA256_DIGITS; i++)
        digits[i] = "0123456789abcdef"[hash->state[i / 8] >> (28 - 4 * (i % 8)) & 15];
}

void sha256_of(const char *text, size_t length, char digits[SHA256_DIGITS]) {
    Sha256 hash = sha256_new();
    sha256_add(&hash, text, length);
    sha256_end(&hash, digits);
}
