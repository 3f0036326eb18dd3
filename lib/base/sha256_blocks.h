// sha256_blocks.h: the compression function of SHA-256 (FIPS 180-4).
#pragma once

#include "base/private_api.h"

#include <stddef.h>
#include <stdint.h>

enum { SHA256_BLOCK = 64 }; // bytes

extern const uint32_t sha256_constants[64];

// Adds blocks to a state, with the processor's instructions for SHA-256 if it has them. The result does not depend on
// this.
void sha256_blocks(uint32_t state[8], const unsigned char *blocks, size_t count) PRIVATE_API(sha256_blocks);
void sha256_blocks_portable(uint32_t state[8], const unsigned char *blocks, size_t count);
// Uses the instructions (sha256_isa.c). Exists only if SHA256_INSTRUCTIONS is defined, and must be called only if
// cpu_detected.sha256 is true.
void sha256_blocks_fast(uint32_t state[8], const unsigned char *blocks, size_t count);
