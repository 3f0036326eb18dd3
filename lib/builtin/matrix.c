// matrix.c: 3x3 and 4x4 matrices, column-major (spec builtins.md B6).
#include "builtin/family.h"
#include "value/ops.h"

// Inverts a 3x3 matrix. Element i of the result is (m[a]*m[b] - m[c]*m[d])*k, with a, b, c, d = at[i].
static void inverse_3x3(const double *m, double *result) {
    static const uint8_t at[9][4] = {{4, 8, 5, 7}, {2, 7, 1, 8}, {1, 5, 2, 4}, {5, 6, 3, 8}, {0, 8, 2, 6},
                                     {2, 3, 0, 5}, {3, 7, 4, 6}, {1, 6, 0, 7}, {0, 4, 1, 3}};
    double det =
        (m[0] * (m[4] * m[8] - m[7] * m[5]) + m[3] * (m[7] * m[2] - m[1] * m[8])) + m[6] * (m[1] * m[5] - m[4] * m[2]);
    double k = 1 / det;
    for (int i = 0; i < 9; i++)
        result[i] = (m[at[i][0]] * m[at[i][1]] - m[at[i][2]] * m[at[i][3]]) * k;
}

// One element of the inverse: (m[a]*P - m[b]*Q + m[c]*R)*k, or (-m[a]*P + m[b]*Q - m[c]*R)*k if row plus column is odd
// (`minus`). P, Q and R are the 2x2 determinants d[p], d[q] and d[r]. In the spec, d[0] to d[5] are called s0 to s5,
// and d[6] to d[11] are called c0 to c5.
typedef struct Cofactor {
    uint8_t a, p, b, q, c, r;
    bool minus;
} Cofactor;

static void inverse_4x4(const double *m, double *result) {
    enum { C0 = 6, C1, C2, C3, C4, C5 };
    static const Cofactor cofactors[16] = {
        {5, C5, 6, C4, 7, C3, false}, {1, C5, 2, C4, 3, C3, true},  {13, 5, 14, 4, 15, 3, false},
        {9, 5, 10, 4, 11, 3, true},   {4, C5, 6, C2, 7, C1, true},  {0, C5, 2, C2, 3, C1, false},
        {12, 5, 14, 2, 15, 1, true},  {8, 5, 10, 2, 11, 1, false},  {4, C4, 5, C2, 7, C0, false},
        {0, C4, 1, C2, 3, C0, true},  {12, 4, 13, 2, 15, 0, false}, {8, 4, 9, 2, 11, 0, true},
        {4, C3, 5, C1, 6, C0, true},  {0, C3, 1, C1, 2, C0, false}, {12, 3, 13, 1, 14, 0, true},
        {8, 3, 9, 1, 10, 0, false}};
    static const uint8_t at[12][4] = {{0, 5, 4, 1},    {0, 6, 4, 2},    {0, 7, 4, 3},    {1, 6, 5, 2},
                                      {1, 7, 5, 3},    {2, 7, 6, 3},    {8, 13, 12, 9},  {8, 14, 12, 10},
                                      {8, 15, 12, 11}, {9, 14, 13, 10}, {9, 15, 13, 11}, {10, 15, 14, 11}};
    double d[12];
    for (int i = 0; i < 12; i++)
        d[i] = m[at[i][0]] * m[at[i][1]] - m[at[i][2]] * m[at[i][3]];
    double k = 1 / (d[0] * d[C5] - d[1] * d[C4] + d[2] * d[C3] + d[3] * d[C2] - d[4] * d[C1] + d[5] * d[C0]);
    for (int i = 0; i < 16; i++) {
        const Cofactor *f = &cofactors[i];
        result[i] = f->minus ? (-m[f->a] * d[f->p] + m[f->b] * d[f->q] - m[f->c] * d[f->r]) * k
                             : (m[f->a] * d[f->p] - m[f->b] * d[f->q] + m[f->c] * d[f->r]) * k;
    }
}

Value builtin_inverse(BuiltinContext *context, const Value *args, uint32_t count) {
    double result[16];
    if (is_numeric_of(args[0], 9))
        inverse_3x3(args[0].as.numbers, result);
    else if (is_numeric_of(args[0], 16))
        inverse_4x4(args[0].as.numbers, result);
    else
        return VALUE_NULL;
    return builtin_numbers(context->arena, result, args[0].len);
}

// Computes a·b. Element (r, c) is A(r,0)*B(0,c) + A(r,1)*B(1,c) + A(r,2)*B(2,c) + A(r,3)*B(3,c), added in this order.
static void multiply_4x4(const double *a, const double *b, double *result) {
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            result[4 * c + r] =
                a[r] * b[4 * c] + a[4 + r] * b[4 * c + 1] + a[8 + r] * b[4 * c + 2] + a[12 + r] * b[4 * c + 3];
}

// Computes the three axes of a view along `direction` (B6.2). Returns false if the arguments are not 3-vectors.
static bool view_axes(BuiltinContext *context, Value direction, Value up, Value axes[3]) {
    Arena *arena = context->arena;
    static const double origin[3] = {0, 0, 0};
    Value back = op_arith(arena, ARITH_SUB, value_numbers_view(origin, 3), direction);
    Value z = builtin_normalize(context, &back, 1);
    Value up_and_z[2] = {up, z};
    Value along = op_arith(arena, ARITH_MUL, z, builtin_dot(context, up_and_z, 2));
    Value across = op_arith(arena, ARITH_SUB, up, along);
    Value y = builtin_normalize(context, &across, 1);
    Value y_and_z[2] = {y, z};
    axes[0] = builtin_cross(context, y_and_z, 2);
    axes[1] = y;
    axes[2] = z;
    return is_numeric_of(axes[0], 3) && is_numeric_of(y, 3) && is_numeric_of(z, 3);
}

Value builtin_point_towards(BuiltinContext *context, const Value *args, uint32_t count) {
    Value axes[3];
    if (!view_axes(context, args[0], args[1], axes))
        return VALUE_NULL;
    const double *x = axes[0].as.numbers, *y = axes[1].as.numbers, *z = axes[2].as.numbers;
    double turn[16] = {x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, 0, 0, 0, 1};
    static const double move[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.0, -0.0, -0.0, 1};
    double view[16], result[16];
    multiply_4x4(turn, move, view);
    inverse_4x4(view, result);
    return builtin_numbers(context->arena, result, 16);
}
