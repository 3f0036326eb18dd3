// fixed_functions.c: the elementary functions of fixed.h.
//
// Each function reduces its argument to a small number, and sums a Taylor series of it by Horner's rule. Each step
// multiplies the error so far by less than 2^-6 and adds 2 ulps for a product and a constant, so the total error is
// below 3 ulps. The series is truncated where the remaining terms are below one ulp.
#include "maths/double_bits.h"
#include "maths/fast.h"
#include "maths/fixed.h"
#include "maths/maths_tables.h"

// How often the argument is halved before the series is summed.
#define EXP_HALVINGS 8
#define SINCOS_HALVINGS 6

// Returns the index of the last term of e^x that is needed for |x| < 2^-bits and `size` limbs. Term n is below
// 2^-(bits n) / n!.
static int last_term(int bits, int size) {
    int left = 64 * size, n = 0;
    while (left > 0)
        left -= bits + double_exponent((double)++n);
    return n;
}

Fixed fixed_exp(const Fixed *r) {
    bool negative = fixed_is_negative(r);
    Fixed x = fixed_scale(r, -EXP_HALVINGS);
    if (negative)
        x = fixed_negate(&x);
    Series powers = {0, last_term(EXP_HALVINGS, r->size), 1, negative};
    Fixed sum = fixed_series(&x, powers);
    // Each squaring doubles the relative error, initially 4 ulps, and adds an ulp. After eight squarings the error is
    // below 2^12 ulps.
    for (int i = 0; i < EXP_HALVINGS; i++)
        sum = fixed_mul(&sum, &sum);
    return sum;
}

// Halves the argument six times, computes s = sin x and v = 1 - cos x of the result, and doubles the angle six times. A
// doubling uses 1 - cos 2x = 2 s^2 and sin 2x = 2 s (1 - v). It multiplies the error by less than 4, on average by less
// than 3. After six doublings the error is below 2^12 ulps.
void fixed_sin_cos(const Fixed *r, Fixed *sine, Fixed *cosine) {
    Fixed x = fixed_scale(r, -SINCOS_HALVINGS), one = fixed_from_int(1, r->size), square = fixed_mul(&x, &x);
    int last = last_term(SINCOS_HALVINGS, r->size) | 1; // odd, for the sine; the cosine uses the next even number
    Series odd = {1, last, 2, true}, even = {2, last + 1, 2, true};
    Fixed s = fixed_series(&square, odd), v = fixed_series(&square, even);
    s = fixed_mul(&x, &s);
    v = fixed_mul(&square, &v);
    for (int i = 0; i < SINCOS_HALVINGS; i++) {
        Fixed c = fixed_sub(&one, &v);
        v = fixed_mul(&s, &s);
        v = fixed_add(&v, &v);
        s = fixed_mul(&s, &c);
        s = fixed_add(&s, &s);
    }
    *sine = s;
    *cosine = fixed_sub(&one, &v);
}

// Starts from a double h near ln m. With m e^-h = 1 + d, |d| < 2^-40, the result is ln m = h + ln(1 + d). The error of
// e^-h and of d is below 2^13 ulps, because m < 2. The series adds less than 8 ulps.
Fixed fixed_log(double m, int exponent, int size) {
    double h = fast_log_near(m);
    Fixed minus = fixed_from_double(-h, size), d = fixed_exp(&minus), one = fixed_from_int(1, size);
    Fixed factor = fixed_from_double(m, size), series = fixed_from_int(0, size);
    d = fixed_mul(&d, &factor);
    d = fixed_sub(&d, &one);
    for (int k = 64 * size / 40 + 1; k; k--) {
        Fixed term = fixed_div_small(&one, (uint32_t)k);
        series = fixed_mul(&series, &d);
        series = fixed_sub(&term, &series);
    }
    series = fixed_mul(&series, &d);
    Fixed sum = fixed_sub(&series, &minus);
    Fixed log_2 = fixed_constant(fixed_log_2, size);
    log_2 = fixed_mul_small(&log_2, (uint64_t)(exponent < 0 ? -exponent : exponent));
    return exponent < 0 ? fixed_sub(&sum, &log_2) : fixed_add(&sum, &log_2);
}

// Starts from a double h near the angle. Rotating (a, b) by -h leaves the small angle atan(t) with
// t = (b cos h - a sin h) / (a cos h + b sin h), |t| < 2^-40. The divisor is nearly the length of (a, b), in
// [1/2, 1.42]. The error is below 2^12 ulps for sine and cosine, 2^13 for the numerator and 2^14 for the quotient.
Fixed fixed_atan(const Fixed *b, const Fixed *a) {
    double h = fast_atan_near(fixed_to_double(b) / fixed_to_double(a));
    Fixed angle = fixed_from_double(h, a->size), sine, cosine, u, v, square, sum = fixed_from_int(0, a->size);
    fixed_sin_cos(&angle, &sine, &cosine);
    u = fixed_mul(b, &cosine);
    v = fixed_mul(a, &sine);
    Fixed t = fixed_sub(&u, &v);
    u = fixed_mul(a, &cosine);
    v = fixed_mul(b, &sine);
    u = fixed_add(&u, &v);
    u = fixed_inverse(&u);
    t = fixed_mul(&t, &u);
    square = fixed_mul(&t, &t);
    Fixed one = fixed_from_int(1, a->size);
    for (int k = 64 * a->size / 80 + 1; k >= 0; k--) {
        Fixed term = fixed_div_small(&one, 2 * (uint32_t)k + 1);
        sum = fixed_mul(&sum, &square);
        sum = fixed_sub(&term, &sum);
    }
    sum = fixed_mul(&sum, &t);
    return fixed_add(&angle, &sum);
}

// Payne and Hanek's method (1983) multiplies only by the bits of 2/pi that matter: the bits before them contribute full
// turns, the bits after them amounts below the precision. x = m 2^exponent with an integer m < 2^53. The window of
// 2/pi 2^exponent has `size` + 2 limbs: one above the binary point, and `size` + 1 below it, one more than the result.
// So the truncated bits contribute less than an ulp.
Fixed fixed_reduce(double x, int size, int *quadrant) {
    enum { LIMBS = 1024 / 64 + FIXED_MAX_LIMBS + 2 };
    int exponent;
    uint64_t m = double_split(x, &exponent);
    // Limb i of the window holds 64 bits of the table starting at bit `from` + 64 i. Bit 64 LIMBS has the weight 1.
    // Since x < 2^1024, `from` is at least 117.
    int from = 64 * LIMBS - exponent - 64 * (size + 1);
    Fixed window = fixed_from_int(0, size + 1);
    for (int i = 0; i <= size + 1; i++) {
        int limb = (from + 64 * i) / 64, bits = (from + 64 * i) % 64;
        uint64_t low = limb <= LIMBS ? fixed_two_over_pi[limb] : 0;
        uint64_t high = limb < LIMBS ? fixed_two_over_pi[limb + 1] : 0;
        window.limb[i] = bits ? low >> bits | high << (64 - bits) : low;
    }
    window = fixed_mul_small(&window, m); // the overflow consists of full turns
    Fixed part = fixed_from_int(0, size);
    for (int i = 0; i < size; i++)
        part.limb[i] = window.limb[i + 1];
    // Round to the nearest quarter turn; the remainder `part` is in [-1/2, 1/2].
    uint64_t whole = window.limb[size + 1] + (part.limb[size - 1] >> 63);
    if (part.limb[size - 1] >> 63)
        part.limb[size] = UINT64_MAX;
    *quadrant = (int)(whole & 3);
    if (x < 0) {
        part = fixed_negate(&part);
        *quadrant = (int)(-whole & 3);
    }
    Fixed half_pi = fixed_constant(fixed_half_pi, size);
    return fixed_mul(&part, &half_pi);
}
