// value_hash.h: hashes of seeds (spec builtins.md B9.2), which are used as keys of streams and noise, and the items of
// streams.
#pragma once

#include "value/value.h"

// Returns the 64-bit key of a seed. A stream is treated as null. The arena has the same purpose as in value_equal.
uint64_t value_seed_hash(Arena *arena, Value seed);
// Like value_seed_hash, but does not round numbers down (spec pictures.md 7.9).
uint64_t value_exact_hash(Arena *arena, Value seed);
// Returns item i of a stream value, as `stream[i]` does.
double value_stream_item(Value stream, uint64_t i);
// Sets to[i] to the item of a stream at index at[i] for each i below `count`. Consecutive indices are computed faster.
void value_stream_items(Value stream, const double *at, uint32_t count, double *to);
// Returns the position in a stream for an index x: x rounded down to a signed 64-bit integer, converted to unsigned
// (B9.3).
uint64_t value_stream_position(double x);
