// sha256_blocks.c: see sha256_blocks.h. The portable code, and the choice of the code.
#include "base/sha256_blocks.h"

#include "base/cpu.h"

// Round constants: the first 32 bits of the fractional parts of the cube roots of the first 64 primes.
const uint32_t sha256_constants[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2,
};

static uint32_t rotated(uint32_t x, int right) {
    return x >> right | x << (32 - right);
}

// Computes the message schedule: the block's 16 words and 48 words derived from them.
static void schedule(const unsigned char *block, uint32_t words[64]) {
    for (int i = 0; i < 16; i++, block += 4)
        words[i] = (uint32_t)block[0] << 24 | (uint32_t)block[1] << 16 | (uint32_t)block[2] << 8 | block[3];
    for (int i = 16; i < 64; i++) {
        uint32_t old = words[i - 15], recent = words[i - 2];
        words[i] = words[i - 16] + (rotated(old, 7) ^ rotated(old, 18) ^ old >> 3) + words[i - 7] +
                   (rotated(recent, 17) ^ rotated(recent, 19) ^ recent >> 10);
    }
}

// One variable for each of a to h of the standard, which compilers keep in registers. An array would be moved in memory
// in each of the 64 rounds.
static void compress(uint32_t state[8], const unsigned char *block) {
    uint32_t words[64], a = state[0], b = state[1], c = state[2], d = state[3];
    uint32_t e = state[4], f = state[5], g = state[6], h = state[7];
    schedule(block, words);
    for (int i = 0; i < 64; i++) {
        uint32_t choice = (e & f) ^ (~e & g), majority = (a & b) ^ (a & c) ^ (b & c);
        uint32_t first =
            h + (rotated(e, 6) ^ rotated(e, 11) ^ rotated(e, 25)) + choice + sha256_constants[i] + words[i];
        uint32_t second = (rotated(a, 2) ^ rotated(a, 13) ^ rotated(a, 22)) + majority;
        h = g;
        g = f;
        f = e;
        e = d + first;
        d = c;
        c = b;
        b = a;
        a = first + second;
    }
    const uint32_t added[8] = {a, b, c, d, e, f, g, h};
    for (int i = 0; i < 8; i++)
        state[i] += added[i];
}

void sha256_blocks_portable(uint32_t state[8], const unsigned char *blocks, size_t count) {
    for (; count > 0; count--, blocks += SHA256_BLOCK)
        compress(state, blocks);
}

void sha256_blocks(uint32_t state[8], const unsigned char *blocks, size_t count) {
#ifdef SHA256_INSTRUCTIONS
    if (cpu_detected.sha256) {
        sha256_blocks_fast(state, blocks, count);
        return;
    }
#endif
    sha256_blocks_portable(state, blocks, count);
}
