// ops.h: the operators of spec language.md L5.1 to L5.3, one function for simplifier and machine alike.
#ifndef PETRI_VALUE_OPS_H
#define PETRI_VALUE_OPS_H

#include "value/value.h"

typedef enum ArithOp { ARITH_ADD, ARITH_SUB, ARITH_MUL, ARITH_DIV, ARITH_FLOORDIV, ARITH_MOD, ARITH_POW } ArithOp;

// x op y for one pair of numbers; ARITH_POW is maths_pow here.
double op_number(ArithOp op, double x, double y);
// Element-wise with repetition (L5.1); null unless both are numeric.
Value op_arith(Arena *arena, ArithOp op, Value a, Value b);
Value op_negate(Arena *arena, Value v);
// +x: x itself if numeric, else null.
Value op_plus(Value v);
// start..stop|step (L5.3). *too_long is set if the count exceeds VALUE_MAX_LEN.
Value op_range(Arena *arena, Value start, Value stop, Value step, bool *too_long);
// The same without its vector.
typedef struct OpRange {
    double start;
    double step;
    uint32_t len;
} OpRange;
OpRange op_range_bounds(Value start, Value stop, Value step, bool *too_long);
static inline double op_range_number(const OpRange *range, uint32_t i) {
    return range->start + range->step * i;
}

#endif
