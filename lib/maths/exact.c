// exact.c: elementary functions for arguments that the fast paths cannot handle: special values and hard cases.
//
// Ziv's method (ACM TOMS 17, 1991): the result is computed with a fraction of 192 bits, then 384 and 768, until all
// numbers within the error bound round to the same double. This terminates, because no result is exactly halfway
// between two doubles. By the theorems of Lindemann and of Gelfond and Schneider, the results of atan2 and the
// functions of one argument are not algebraic. The exceptions are integer results of log2 and log10, and cases that are
// handled first (0, 1, tiny ratios). Halfway cases of pow are found with integer arithmetic. The hardest known
// arguments (tables by Lefèvre and Muller, and later work) need a relative accuracy of fewer than 128 bits. A fraction
// of 384 bits gives more than 300.
//
// The error of each function of fixed.h is below 2^16 ulps. The bound used here, 2^SLACK ulps, also covers the few
// operations added in this file.
#include "maths/double_bits.h"
#include "maths/fast.h"
#include "maths/fixed.h"
#include "maths/maths_tables.h"

#define SLACK 20     // binary logarithm of the error bound in ulps
#define FIRST_SIZE 3 // number of limbs (fixed.h) of the fraction in the first attempt

// --- sine, cosine, tangent

typedef enum Trig { SINE, COSINE, TANGENT } Trig;

// Returns sine / cosine. The divisor is scaled to [1/2, 1) before the division, and the quotient is scaled by the same
// factor. The sine and cosine of a double of at least 2^-27 are at least 2^-62, so at most 62 bits are lost.
static Fixed fixed_quotient(Fixed *sine, Fixed *cosine) {
    int shift = -double_exponent(fixed_to_double(cosine)) - 1;
    bool negative = fixed_is_negative(cosine);
    Fixed divisor = negative ? fixed_negate(cosine) : *cosine;
    divisor = fixed_scale(&divisor, shift);
    divisor = fixed_inverse(&divisor);
    Fixed q = fixed_mul(sine, &divisor);
    q = fixed_scale(&q, shift);
    return negative ? fixed_negate(&q) : q;
}

static double exact_trig(double x, Trig trig) {
    if (!double_is_finite(x))
        return double_is_nan(x) ? x + x : DOUBLE_NAN;
    // Sine and tangent are between x - x^3/6 and x + x^3/3, which round to x. The cosine is at least 1 - 2^-55, which
    // rounds to 1.
    if (double_absolute(x) < 0x1p-27)
        return trig == COSINE ? 1 : x;
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= FIXED_MAX_LIMBS; size *= 2) {
        int quadrant, slack = SLACK;
        Fixed r = fixed_reduce(x, size, &quadrant), s, c;
        fixed_sin_cos(&r, &s, &c);
        if (trig == COSINE)
            quadrant++;
        if (quadrant & 1) {
            Fixed t = s;
            s = c;
            c = fixed_negate(&t);
        }
        if (trig == TANGENT) {
            // A half turn negates both sine and cosine, so it does not change the quotient. The error of a quotient q
            // grows with q^2.
            int shift = double_exponent(fixed_to_double(&c));
            slack += shift < 0 ? -2 * shift : 0;
            s = fixed_quotient(&s, &c);
        } else if (quadrant & 2)
            s = fixed_negate(&s);
        done = fixed_decides(&s, slack, 0, &result);
    }
    return result;
}

#define EXACT(name, function, which)                                                                                   \
    double exact_##name(double x) {                                                                                    \
        return function(x, which);                                                                                     \
    }
EXACT(sin, exact_trig, SINE)
EXACT(cos, exact_trig, COSINE)
EXACT(tan, exact_trig, TANGENT)

// --- arcs

// How to compute an angle from the angle r of a point in the first octant: r, pi/2 - r, pi/2 + r or pi - r, in the
// order of the constants.
typedef enum Octant { AS_IT_IS, FROM_QUARTER, PAST_QUARTER, FROM_HALF } Octant;

static Fixed in_octant(const Fixed *angle, Octant octant) {
    Fixed constant = fixed_constant(fixed_half_pi, angle->size);
    if (octant == FROM_HALF)
        constant = fixed_add(&constant, &constant);
    return octant == AS_IT_IS       ? *angle
           : octant == PAST_QUARTER ? fixed_add(&constant, angle)
                                    : fixed_sub(&constant, angle);
}

// Returns the angle of the point (a, b) on the unit circle, 0 ≤ a, b ≤ 1. If `mirrored`, returns the angle of (-a, b).
static Fixed circle_angle(const Fixed *b, const Fixed *a, bool mirrored) {
    Fixed d = fixed_sub(a, b);
    bool swap = fixed_is_negative(&d);
    Fixed angle = swap ? fixed_atan(a, b) : fixed_atan(b, a);
    return in_octant(&angle, mirrored ? (swap ? PAST_QUARTER : FROM_HALF) : (swap ? FROM_QUARTER : AS_IT_IS));
}

// Returns asin x or, if `cosine`, acos x for 2^-60 ≤ |x| < 1. asin |x| is the angle of (sqrt(1 - x^2), |x|), and acos
// |x| is that of (|x|, sqrt(1 - x^2)). 192 bits represent |x| exactly and its square within an ulp. 1 - x^2 ≥ 2^-53 is
// scaled to [1/4, 1] by an even shift before the root is taken.
static double exact_circle(double x, bool cosine) {
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= FIXED_MAX_LIMBS; size *= 2) {
        Fixed a = fixed_from_double(double_absolute(x), size), one = fixed_from_int(1, size),
              square = fixed_mul(&a, &a);
        square = fixed_sub(&one, &square);
        int halves = -double_exponent(fixed_to_double(&square)) / 2;
        Fixed scaled = fixed_scale(&square, 2 * halves), inverse = fixed_inverse_root(&scaled);
        Fixed root = fixed_mul(&scaled, &inverse);
        root = fixed_scale(&root, -halves);
        Fixed angle = cosine ? circle_angle(&root, &a, x < 0) : circle_angle(&a, &root, false);
        done = fixed_decides(&angle, SLACK, 0, &result);
    }
    return !cosine && x < 0 ? -result : result;
}

double exact_asin(double x) {
    if (!(double_absolute(x) <= 1))
        return double_is_nan(x) ? x + x : DOUBLE_NAN;
    if (double_absolute(x) < 0x1p-27)
        return x; // asin x is nearer to x than to any other double
    return double_absolute(x) == 1 ? double_with_sign(HALF_PI_HIGH, x) : exact_circle(x, false);
}

double exact_acos(double x) {
    if (!(double_absolute(x) <= 1))
        return double_is_nan(x) ? x + x : DOUBLE_NAN;
    if (double_absolute(x) < 0x1p-60)
        return HALF_PI_HIGH; // differs from pi/2 by 2^-53.9, clearly less than half an ulp (2^-53)
    return x == 1 ? 0 : x == -1 ? PI_HIGH : exact_circle(x, true);
}

// Returns the double nearest to atan(q) = q - q^3/3 + … for q = (b / a) 2^scale below 2^-60, with integers b and a
// below 2^53. Such a quotient is either a midpoint between two doubles or at least 2^-107 q away from every midpoint.
// So subtracting q^3/3, which is below 2^-120 q, changes the rounding only of midpoints, which then round down. The
// code has the same effect: it truncates b / a to 128 bits of fraction, reduces an exact quotient by an ulp, and sets
// the last bit.
static double tiny_ratio(uint64_t b, uint64_t a, int scale) {
    Fixed q = fixed_from_int((int64_t)(b / a), 2);
    uint64_t rest = b % a;
    for (int bit = 127; bit >= 0; bit--) { // long division
        rest *= 2;
        q.limb[bit / 64] |= (uint64_t)(rest >= a) << bit % 64;
        rest -= rest >= a ? a : 0;
    }
    Fixed ulp = {.size = 2, .limb = {1}};
    if (rest == 0)
        q = fixed_sub(&q, &ulp);
    q.limb[0] |= 1; // so that q is never exactly halfway between two doubles
    return fixed_round(&q, scale);
}

static Octant octant_of(double b, double a, double x) {
    bool swap = b > a;
    return x < 0 ? (swap ? PAST_QUARTER : FROM_HALF) : swap ? FROM_QUARTER : AS_IT_IS;
}

// Returns |atan2(y, x)| for finite x and y other than 0, with b = |y| and a = |x|.
static double exact_ratio(double b, double a, double x) {
    int a_exponent, b_exponent;
    Octant octant = octant_of(b, a, x);
    double large = b > a ? b : a, small = b > a ? a : b;
    uint64_t am = double_split(large, &a_exponent), bm = double_split(small, &b_exponent);
    int scale = b_exponent - a_exponent;
    if (octant == AS_IT_IS && scale < -61)
        return tiny_ratio(bm, am, scale);
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= FIXED_MAX_LIMBS; size *= 2) {
        // A ratio below 2^-100 is replaced by 0. It cannot change the rounding of pi/2 and pi, which are 2^-56 away
        // from any midpoint.
        Fixed a_fixed = fixed_from_double((double)am * 0x1p-53, size);
        Fixed b_fixed = fixed_from_double((double)bm * 0x1p-53, size);
        b_fixed = scale < -100 ? fixed_from_int(0, size) : fixed_scale(&b_fixed, scale);
        Fixed angle = fixed_atan(&b_fixed, &a_fixed);
        angle = in_octant(&angle, octant);
        done = fixed_decides(&angle, scale < -100 ? 64 * size - 99 : SLACK, 0, &result);
    }
    return result;
}

double exact_atan2(double y, double x) {
    if (double_is_nan(x) || double_is_nan(y))
        return x + y;
    double angle;
    if ((double_absolute(x) == DOUBLE_INFINITY))
        angle = (double_absolute(y) == DOUBLE_INFINITY) ? (x > 0 ? HALF_PI_HIGH / 2 : 3 * (PI_HIGH / 4))
                : x > 0                                 ? 0
                                                        : PI_HIGH;
    else if ((double_absolute(y) == DOUBLE_INFINITY) || (x == 0 && y != 0))
        angle = HALF_PI_HIGH;
    else if (y == 0)
        angle = double_is_negative(x) ? PI_HIGH : 0;
    else
        angle = exact_ratio(double_absolute(y), double_absolute(x), x);
    return double_with_sign(angle, y);
}

// --- exponential and logarithms

// Computes e^t = 2^k e^r with t = k ln2 + r and e^r in [1/2, 2]. If an error of 2^slack ulps in e^r cannot change the
// rounded value of e^t, sets *result to that value and returns true.
static bool decide_exp(const Fixed *t, int slack, double *result) {
    int k = (int)(fixed_to_double(t) * LOG_2E_HIGH);
    Fixed log_2 = fixed_constant(fixed_log_2, t->size);
    log_2 = fixed_mul_small(&log_2, (uint64_t)(k < 0 ? -k : k));
    Fixed r = k < 0 ? fixed_add(t, &log_2) : fixed_sub(t, &log_2);
    r = fixed_exp(&r);
    return fixed_decides(&r, slack, k, result);
}

double exact_exp(double x) {
    if (double_is_nan(x))
        return x + x;
    if (x > 710 || x < -746)
        return x < 0 ? 0 : DOUBLE_INFINITY;
    if (double_absolute(x) < 0x1p-54)
        return 1;
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= FIXED_MAX_LIMBS; size *= 2) {
        Fixed t = fixed_from_double(x, size);
        done = decide_exp(&t, SLACK, &result);
    }
    return result;
}

// Returns ln x for a positive finite x other than 1.
static Fixed fixed_log_of(double x, int size) {
    int exponent;
    double m = (double)double_split(x, &exponent) * 0x1p-52;
    // m is moved to [0.7, 1.4), so that exponent * ln 2 + ln m is not a difference of similar numbers.
    return m < 1.40625 ? fixed_log(m, exponent + 52, size) : fixed_log(m * 0.5, exponent + 53, size);
}

static double exact_logarithm(double x, const uint64_t *scale) {
    if (!(x > 0) || (double_absolute(x) == DOUBLE_INFINITY) || x == 1)
        return double_is_nan(x) ? x + x : x == 0 ? -DOUBLE_INFINITY : x < 0 ? DOUBLE_NAN : x == 1 ? 0 : x;
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= FIXED_MAX_LIMBS; size *= 2) {
        Fixed log = fixed_log_of(x, size);
        if (scale) {
            Fixed by = fixed_constant(scale, size);
            log = fixed_mul(&log, &by);
        }
        done = fixed_decides(&log, SLACK, 0, &result);
    }
    return result;
}

EXACT(log, exact_logarithm, NULL)
EXACT(log2, exact_logarithm, fixed_log2_e)
EXACT(log10, exact_logarithm, fixed_log10_e)

// --- power

static bool is_whole(double y) {
    return double_absolute(y) >= 0x1p53 || (y == y && (double)(int64_t)y == y);
}

static bool is_odd(double y) {
    return double_absolute(y) < 0x1p53 && (double)(int64_t)y == y && ((int64_t)y & 1);
}

double exact_pow_sign(double x, double y) {
    return x > 0 ? 1 : !is_whole(y) ? 0 : is_odd(y) ? -1 : 1;
}

// Finds an odd integer *odd and an *exponent such that |x| = *odd * 2^*exponent.
static void split_odd(double x, uint64_t *odd, int *exponent) {
    *odd = double_split(x, exponent);
    int zeros = __builtin_ctzll(*odd);
    *odd >>= zeros;
    *exponent += zeros;
}

// Returns the square root of a perfect square, else 0.
static uint64_t whole_root(uint64_t m) {
    uint64_t r = (uint64_t)__builtin_sqrt((double)m);
    return r * r == m ? r : 0;
}

// Requires x > 0. If x^y has at most 64 significant bits, sets *result to the power, rounded, and returns true. All
// midpoints are among these powers, because a midpoint has 54 bits. Let x = m 2^e and y = k 2^f with odd m and k. For
// m = 1 the power has finitely many bits if e y is an integer. For m > 1, y must be positive, because the binary
// fraction of 1/m is periodic. For f < 0, the square root must be exact -f times in a row, which is possible at most
// five times for m < 2^53. Since m ≥ 3, m^(k 2^f) has at most 64 bits only if k 2^f is at most 40.
static bool pow_is_exact(double x, double y, double *result) {
    uint64_t m, k, power = 1;
    int e, f;
    split_odd(x, &m, &e);
    split_odd(double_absolute(y), &k, &f);
    for (; f < 0; f++) {
        if (e % 2 || !(m = whole_root(m)))
            return false;
        e /= 2;
        if (e == 0 && m == 1)
            break;
    }
    if (m == 1 && e == 0) {
        *result = 1;
        return true;
    }
    if (f > 12 || k >> (12 - f))
        return false; // the power is out of range or has too many bits
    int n = (int)(k << f);
    if (m > 1 && (y < 0 || n > 40))
        return false;
    if (m > 1)
        for (int i = 0; i < n; i++)
            if (__builtin_mul_overflow(power, m, &power))
                return false;
    Fixed whole = fixed_from_int(0, 1);
    whole.limb[0] = power; // `whole` is power * 2^-64
    *result = fixed_round(&whole, 64 + (y < 0 ? -e * n : e * n));
    return true;
}

// Returns x^y = e^(y ln x) for x > 0, with |y| = k 2^exponent. The error of ln x, at most 2^SLACK ulps, is multiplied
// by |y|.
static double exact_positive_pow(double x, double y) {
    double result;
    if (pow_is_exact(x, y, &result))
        return result;
    int exponent;
    uint64_t k = double_split(y, &exponent);
    int above = exponent + 53 > 0 ? exponent + 53 : 0; // |y| < 2^above
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= FIXED_MAX_LIMBS; size *= 2) {
        Fixed t = fixed_log_of(x, size);
        double near = fixed_to_double(&t) * y; // y ln x with a relative error of 2^-48
        if (near > 720 || near < -760)
            return near < 0 ? 0 : DOUBLE_INFINITY;
        if (double_absolute(near) < 0x1p-55)
            return 1;
        t = fixed_mul_small(&t, k);
        t = fixed_scale(&t, exponent);
        if (y < 0)
            t = fixed_negate(&t);
        done = decide_exp(&t, SLACK + above, &result);
    }
    return result;
}

// Returns |x|^y where x is 0 or infinite (C17 F.10.4.4).
static double pow_of_zero_or_infinity(double x, double y) {
    return (x == 0) == (y < 0) ? DOUBLE_INFINITY : 0;
}

double exact_pow(double x, double y) {
    if (x == 1 || y == 0)
        return 1;
    if (double_is_nan(x) || double_is_nan(y))
        return x + y;
    double a = double_absolute(x);
    if ((double_absolute(y) == DOUBLE_INFINITY))
        return a == 1 ? 1 : (a > 1) == (y > 0) ? DOUBLE_INFINITY : 0;
    double sign = double_is_negative(x) ? is_odd(y) ? -1 : 1 : 1;
    if (a == 0 || (double_absolute(a) == DOUBLE_INFINITY))
        return sign * pow_of_zero_or_infinity(a, y);
    if (x < 0 && !is_whole(y))
        return DOUBLE_NAN;
    return sign * (a == 1 ? 1 : exact_positive_pow(a, y));
}
