// ops.c: see ops.h.
//
// The shorter operand is repeated. Frequent cases are loops over arrays, which the compiler vectorises. They have the
// same bits, because an element of the result depends on one element of each operand.
#include "value/ops.h"

#include "base/cpu.h"
#include "maths/arrays.h"

// Computes result = x op y for a vector and a number, a number and a vector, or two vectors of equal length.
#define EACH_ELEMENT(operator)                                                                                         \
    if (y_len == 1)                                                                                                    \
        for (uint32_t i = 0; i < len; i++)                                                                             \
            result[i] = x[i] operator y[0];                                                                            \
    else if (x_len == 1)                                                                                               \
        for (uint32_t i = 0; i < len; i++)                                                                             \
            result[i] = x[0] operator y[i];                                                                            \
    else                                                                                                               \
        for (uint32_t i = 0; i < len; i++)                                                                             \
            result[i] = x[i] operator y[i];                                                                            \
    return true;

// Computes +, -, * and / in loops that the compiler vectorises. Returns false for other operators.
static bool simple_arith(ArithOp op, const double *restrict x, uint32_t x_len, const double *restrict y, uint32_t y_len,
                         double *restrict result, uint32_t len) {
    switch (op) {
    case ARITH_ADD:
        EACH_ELEMENT(+)
    case ARITH_SUB:
        EACH_ELEMENT(-)
    case ARITH_MUL:
        EACH_ELEMENT(*)
    case ARITH_DIV:
        EACH_ELEMENT(/)
    default:
        return false;
    }
}

// Computes x^y for a vector x and a number or vector y. Returns false if x is a number and y a vector.
static bool array_powers(const double *x, uint32_t x_len, const double *y, uint32_t y_len, double *result,
                         uint32_t len) {
    if (x_len != len)
        return false;
    maths_arrays(cpu_detected.level)->pow(x, y, y_len != 1, x_len, result);
    return true;
}

// Computes result = x op y with array functions, one chunk at a time. Returns false if there is none for the operator
// and these operands.
static bool arith_in_chunks(Arena *arena, ArithOp op, const double *x, uint32_t x_len, const double *y, uint32_t y_len,
                            double *result, uint32_t len) {
    for (uint32_t at = 0; at < len; at += BUDGET_CHUNK) {
        uint32_t count = len - at < BUDGET_CHUNK ? len - at : BUDGET_CHUNK;
        uint32_t x_count = x_len == 1 ? 1 : count, y_count = y_len == 1 ? 1 : count;
        const double *x_at = x_len == 1 ? x : x + at, *y_at = y_len == 1 ? y : y + at;
        arena_charge(arena, op == ARITH_POW ? count / 2 : 0);
        if (op == ARITH_POW ? !array_powers(x_at, x_count, y_at, y_count, result + at, count)
                            : !simple_arith(op, x_at, x_count, y_at, y_count, result + at, count))
            return false;
    }
    return true;
}

Value op_arith(Arena *arena, ArithOp op, Value a, Value b) {
    if (!value_is_numeric(a) || !value_is_numeric(b))
        return VALUE_NULL;
    const double *x = value_numbers(&a), *y = value_numbers(&b);
    // Squares are computed as x * x (D2), which gives the same result as maths_pow but is much faster.
    bool square = op == ARITH_POW && b.len == 1 && y[0] == 2;
    if (a.len == 1 && b.len == 1)
        return value_number(square ? x[0] * x[0] : op_number(op, x[0], y[0]));
    uint32_t len = a.len > b.len ? a.len : b.len;
    double *result = arena_alloc_array(arena, len, sizeof *result);
    if ((a.len == 1 || b.len == 1 || a.len == b.len) &&
        arith_in_chunks(arena, square ? ARITH_MUL : op, x, a.len, square ? x : y, square ? a.len : b.len, result, len))
        return value_numbers_view(result, len);
    for (uint32_t i = 0, j = 0, k = 0; i < len; i++) {
        arena_charge_chunk(arena, i, 1);
        result[i] = square ? x[j] * x[j] : op_number(op, x[j], y[k]);
        j = j + 1 == a.len ? 0 : j + 1;
        k = k + 1 == b.len ? 0 : k + 1;
    }
    return value_numbers_view(result, len);
}

Value op_negate(Arena *arena, Value v) {
    if (!value_is_numeric(v))
        return VALUE_NULL;
    if (v.len == 1)
        return value_number(-v.as.number);
    double *result = arena_alloc_array(arena, v.len, sizeof *result);
    for (uint32_t i = 0; i < v.len; i++)
        result[i] = -v.as.numbers[i];
    return value_numbers_view(result, v.len);
}

Value op_plus(Value v) {
    return value_is_numeric(v) ? v : VALUE_NULL;
}

// Reads one bound of a range. Sets *x to the value of v if it is a number, or to `default_value` if v is null. Returns
// false for other values.
static bool range_bound(Value v, double default_value, double *x) {
    *x = v.len == 0 ? default_value : v.as.number;
    return v.len == 0 || value_is_number(v);
}

OpRange op_range_bounds(Value start, Value stop, Value step, bool *too_long) {
    OpRange range = {0};
    if (!range_bound(start, 0, &range.start) || !range_bound(step, 1, &range.step) || range.step == 0 ||
        stop.len != 1 || stop.kind != VALUE_NUMBERS)
        return range;
    double count = ceil((stop.as.number - range.start) / range.step);
    if (!(count > 0) || isinf(count))
        return range;
    if (count > VALUE_MAX_LEN)
        *too_long = true;
    else
        range.len = (uint32_t)count;
    return range;
}

Value op_range(Arena *arena, Value start, Value stop, Value step, bool *too_long) {
    OpRange range = op_range_bounds(start, stop, step, too_long);
    if (range.len < 2)
        return range.len ? value_number(op_range_number(&range, 0)) : VALUE_NULL;
    double *result = arena_alloc_array(arena, range.len, sizeof *result);
    for (uint32_t i = 0; i < range.len; i++)
        result[i] = op_range_number(&range, i);
    return value_numbers_view(result, range.len);
}
