// stream.h: items of streams of random numbers (spec builtins.md B9.3).
#pragma once

#include "value/value.h"

// Returns item i of a stream value, as `stream[i]` does.
double value_stream_item(Value stream, uint64_t i);
// Sets to[i] to the item of a stream at index at[i] for each i below `count`. Consecutive indices are computed faster.
void value_stream_items(Value stream, const double *at, uint32_t count, double *to);
// Returns the position in a stream for an index x: x rounded down to a signed 64-bit integer, converted to unsigned
// (B9.3).
uint64_t value_stream_position(double x);
