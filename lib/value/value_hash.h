// value_hash.h: hashes of seeds (spec builtins.md B9.2), which are used as keys of streams and noise.
#pragma once

#include "value/value.h"

// Returns the 64-bit key of a seed. A stream is treated as null. The arena has the same purpose as in value_equal.
uint64_t value_seed_hash(Arena *arena, Value seed);
// Like value_seed_hash, but does not round numbers down (spec pictures.md 7.9).
uint64_t value_exact_hash(Arena *arena, Value seed);
