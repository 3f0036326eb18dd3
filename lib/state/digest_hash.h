// digest_hash.h: XXH3-128 (xxHash), compiled into the files that include this header.
#pragma once

#include <stddef.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

// Adds bytes to a hash. digest_hash.c is compiled once per instruction set; all variants give the same hash.
typedef void DigestUpdate(XXH3_state_t *hash, const void *bytes, size_t size);
DigestUpdate digest_update_plain, digest_update_avx2;
