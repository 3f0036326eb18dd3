// ops.h: the operators of spec language.md L5.1 to L5.3, used by constant folding and by the virtual machine.
#pragma once

#include "maths/maths.h"
#include "value/value.h"

#include <math.h>

typedef enum ArithOp { ARITH_ADD, ARITH_SUB, ARITH_MUL, ARITH_DIV, ARITH_FLOORDIV, ARITH_MOD, ARITH_POW } ArithOp;

// Returns x op y.
static inline double op_number(ArithOp op, double x, double y) {
    switch (op) {
    case ARITH_ADD:
        return x + y;
    case ARITH_SUB:
        return x - y;
    case ARITH_MUL:
        return x * y;
    case ARITH_DIV:
        return x / y;
    case ARITH_FLOORDIV:
        return floor(x / y);
    case ARITH_MOD:
        return x - floor(x / y) * y;
    case ARITH_POW:
        return maths_pow(x, y);
    }
    return NAN;
}

// Applies the operator element by element and repeats the shorter vector (L5.1). Returns null unless both are numeric.
Value op_arith(Arena *arena, ArithOp op, Value a, Value b);
// Returns -v, or null if v is not numeric.
Value op_negate(Arena *arena, Value v);
// Returns v if it is numeric, else null.
Value op_plus(Value v);
// Returns start..stop|step (L5.3). Sets *too_long and returns null if the range has more than VALUE_MAX_LEN numbers.
Value op_range(Arena *arena, Value start, Value stop, Value step, bool *too_long);
// A range that is not stored as a vector.
typedef struct OpRange {
    double start;
    double step;
    uint32_t len;
} OpRange;
// Like op_range, but does not store the numbers. `len` is 0 if op_range would return null.
OpRange op_range_bounds(Value start, Value stop, Value step, bool *too_long);
// Returns number i of a range.
static inline double op_range_number(const OpRange *range, uint32_t i) {
    return range->start + range->step * i;
}
