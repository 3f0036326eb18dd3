// colour.c: colour spaces (spec builtins.md B11).
#include "builtin/family.h"
#include "maths/maths.h"
#include "maths/random.h"

#include <math.h>
#include <string.h>

// Returns max(x, 0), and 0 for NaN.
static double clamp_negative(double x) {
    return x > 0 ? x : 0;
}

static double clamp_unit(double x) {
    x = clamp_negative(x);
    return 1 < x ? 1 : x;
}

// Returns exactly fmod(v, 6). Most hues are between -6 and 12. There, at most one subtraction is needed, and its result
// is exact.
static double modulo_6(double v) {
    return v > -6 && v < 6 ? v : v >= 6 && v < 12 ? v - 6 : fmod(v, 6);
}

static double hue_part(double m1, double m2, double v) {
    double r = modulo_6(v);
    if (r < 0)
        r = r + 6;
    if (r < 1)
        return m1 + (m2 - m1) * r;
    if (r < 3)
        return m2;
    if (r < 4)
        return m1 + (m2 - m1) * (4 - r);
    return m1;
}

// Converts HSL to RGB (B11.1). s and l are between 0 and 1.
static Value rgb_of_hsl(Arena *arena, double h, double s, double l) {
    double m2 = l <= 0.5 ? l * (s + 1) : l + s - l * s;
    double m1 = l * 2 - m2;
    double sixths = h * 6;
    double rgb[3] = {hue_part(m1, m2, sixths + 2), hue_part(m1, m2, sixths), hue_part(m1, m2, sixths - 2)};
    return builtin_numbers(arena, rgb, 3);
}

Value builtin_hsl(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_numeric_of(args[0], 3))
        return VALUE_NULL;
    const double *x = args[0].as.numbers;
    return rgb_of_hsl(context->arena, x[0], clamp_unit(x[1]), clamp_unit(x[2]));
}

// Converts HSV to HSL (B11.2): l = v*(1 - s/2), and the HSL saturation is (v - l)/min(l, 1 - l).
Value builtin_hsv(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_numeric(args[0]) || args[0].len > 3)
        return VALUE_NULL;
    const double *x = value_numbers(&args[0]);
    double s = args[0].len > 1 ? clamp_unit(x[1]) : 1, v = args[0].len > 2 ? clamp_unit(x[2]) : 1;
    double l = v * (1 - s / 2);
    double limit = l < 1 - l ? l : 1 - l; // of v - l
    double saturation = l == 0 || l == 1 ? 0 : (v - l) / limit;
    return rgb_of_hsl(context->arena, x[0], saturation, l);
}

// Computes the colour of a black body at t kelvin (B11.3): first the chromaticity x, y on the Planckian locus, then X,
// Y, Z, then linear sRGB. If `normalize` is true, Y is 1.
static void black_body(double t, bool normalize, double *rgb) {
    double T = t > 1667 ? t : 1667;
    T = T < 25000 ? T : 25000;
    double T2 = T * T, x, y;
    if (T < 4000)
        x = -0.2661239e9 / (T * T2) - 0.2343589e6 / T2 + 0.8776956e3 / T + 0.179910;
    else
        x = -3.0258469e9 / (T * T2) + 2.1070379e6 / T2 + 0.2226347e3 / T + 0.240390;
    double x2 = x * x;
    if (T < 2222)
        y = -1.1063814 * x * x2 - 1.34811020 * x2 + 2.18555832 * x - 0.20219683;
    else if (T < 4000)
        y = -0.9549476 * x * x2 - 1.37418593 * x2 + 2.09137015 * x - 0.16748867;
    else
        y = 3.0817580 * x * x2 - 5.87338670 * x2 + 3.75112997 * x - 0.37001483;
    double Y = normalize ? 1 : maths_pow(clamp_negative(t) / 6503.5, 4);
    double X = Y * x / y, Z = Y * (1 - x - y) / y;
    rgb[0] = clamp_negative(3.2406255 * X - 1.537208 * Y - 0.4986286 * Z);
    rgb[1] = clamp_negative(-0.9689307 * X + 1.8757561 * Y + 0.0415175 * Z);
    rgb[2] = clamp_negative(0.0557101 * X - 0.2040211 * Y + 1.0569959 * Z);
}

Value builtin_colortemp(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_numeric(args[0]))
        return VALUE_NULL;
    uint32_t len = args[0].len;
    if (len > VALUE_MAX_LEN / 3)
        return builtin_too_long(context, "colortemp");
    bool normalize = !is_absent(args[1]) && value_true(args[1]);
    const double *t = value_numbers(&args[0]);
    double *result = arena_alloc_array(context->arena, len * 3, sizeof *result);
    for (uint32_t i = 0; i < len; i++)
        black_body(t[i], normalize, result + 3 * i);
    return value_numbers_view(result, len * 3);
}

// Multiplies v by a column-major 3x3 matrix. Row r of the result is m[r]*v0 + m[r+3]*v1 + m[r+6]*v2.
static void transform_3x3(const double *m, double *v) {
    double result[3];
    for (int r = 0; r < 3; r++)
        result[r] = m[r] * v[0] + m[r + 3] * v[1] + m[r + 6] * v[2];
    memcpy(v, result, sizeof result);
}

// Converts OKLab to linear sRGB (B11.4): the result is C·(A·v), where v is B·lab with each element cubed.
static Value rgb_of_oklab(Arena *arena, double l, double a, double b) {
    static const double B[9] = {0.9999999984505199,  1.0000000088817609,   1.000000054672411,
                                0.3963377921737679,  -0.10556134232365635, -0.08948418209496577,
                                0.21580375806075883, -0.0638541747717059,  -1.291485537864092};
    static const double A[9] = {1.2270138511035211,  -0.04058017842328059, -0.0763812845057069,
                                -0.5577999806518222, 1.1122568696168302,   -0.4214819784180127,
                                0.28125614896646783, -0.07167667866560119, 1.586163220440795};
    static const double C[9] = {3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570};
    double v[3] = {l, a, b};
    transform_3x3(B, v);
    for (int i = 0; i < 3; i++)
        v[i] = maths_pow(v[i], 3);
    transform_3x3(A, v);
    transform_3x3(C, v);
    return builtin_numbers(arena, v, 3);
}

Value builtin_oklab(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_numeric_of(args[0], 3))
        return VALUE_NULL;
    const double *lab = args[0].as.numbers;
    return rgb_of_oklab(context->arena, lab[0], lab[1], lab[2]);
}

Value builtin_oklch(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_numeric_of(args[0], 3))
        return VALUE_NULL;
    const double *lch = args[0].as.numbers;
    return rgb_of_oklab(context->arena, lch[0], lch[1] * turns_cos(lch[2]), lch[1] * turns_sin(lch[2]));
}
