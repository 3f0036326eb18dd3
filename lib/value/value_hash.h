// value_hash.h: the seed hash of a vector (spec builtins.md B9.2), from which streams and noise get their keys.
#ifndef PETRI_VALUE_VALUE_HASH_H
#define PETRI_VALUE_VALUE_HASH_H

#include "value/value.h"

// The 64-bit key of a seed. A stream counts as null. The arena is as for value_equal.
uint64_t value_seed_hash(Arena *arena, Value seed);
// The same hash without rounding numbers down (spec pictures.md 7.9).
uint64_t value_exact_hash(Arena *arena, Value seed);
// Item i of a stream value, as `stream[i]` gives it.
double value_stream_item(Value stream, uint64_t i);
// The items at the positions of indices, which cost less where they follow each other.
void value_stream_items(Value stream, const double *at, uint32_t count, double *to);
// Position in a stream of an index x: floored, as a signed 64-bit integer, as unsigned (B9.3).
uint64_t value_stream_position(double x);

#endif
