// exact.c: the cases that the fast paths leave: special arguments, and those that need many bits.
//
// Ziv (ACM TOMS 17, 1991): the result is computed with 192 bits of fraction, then with 384 and 768, until all
// numbers within the error bound round to the same double. This ends, because no result lies on the border of two
// doubles: by Lindemann's theorem the functions of one argument and atan2 give no algebraic number but where it is told
// apart first (0, 1, ratios that vanish), and the borders that pow meets are found by whole numbers. The hardest
// arguments known (Lefèvre and Muller's tables and what was computed since) need fewer than 128 bits of relative
// accuracy; the first two steps give more than 300.
//
// What wide.h promises for each function is 2^16 ulps; SLACK covers the few products, sums and constants around it.
#include "maths/doubles.h"
#include "maths/fast.h"
#include "maths/maths_tables.h"
#include "maths/wide.h"

#define SLACK 20
#define FIRST_SIZE 3

// --- sine, cosine, tangent

typedef enum Trig { SINE, COSINE, TANGENT } Trig;

// The tangent: the divisor is brought to [1/2, 1) first, then the quotient multiplied as much. No cosine of a double is
// below 2^-62 (nor a sine, if it is not 0), so that 62 bits are lost.
static Wide wide_quotient(Wide *sine, Wide *cosine) {
    int shift = -double_exponent(wide_near(cosine)) - 1;
    bool negative = wide_is_negative(cosine);
    Wide divisor = negative ? wide_negate(cosine) : *cosine;
    divisor = wide_scale(&divisor, shift);
    divisor = wide_inverse(&divisor);
    Wide q = wide_mul(sine, &divisor);
    q = wide_scale(&q, shift);
    return negative ? wide_negate(&q) : q;
}

static double exact_trig(double x, Trig trig) {
    if (!double_is_finite(x))
        return double_is_nan(x) ? x + x : DOUBLE_NAN;
    // x - x^3/6 … x + x^3/3 is nearer to x than to its neighbours; below 2^-27 the cosine is 1 - 2^-55 at least.
    if (double_absolute(x) < 0x1p-27)
        return trig == COSINE ? 1 : x;
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= WIDE_MAX; size *= 2) {
        int quadrant, slack = SLACK;
        Wide r = wide_turn(x, size, &quadrant), s, c;
        wide_sin_cos(&r, &s, &c);
        if (trig == COSINE)
            quadrant++;
        if (quadrant & 1) {
            Wide t = s;
            s = c;
            c = wide_negate(&t);
        }
        if (trig == TANGENT) {
            // In a turn the signs of both cancel. What the shift of a large quotient adds to the error is its square.
            int shift = double_exponent(wide_near(&c));
            slack += shift < 0 ? -2 * shift : 0;
            s = wide_quotient(&s, &c);
        } else if (quadrant & 2)
            s = wide_negate(&s);
        done = wide_decides(&s, slack, 0, &result);
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

// What is done with the angle of (a, b), 0 ≤ b ≤ a: the octant.
typedef enum Octant { AS_IT_IS, FROM_QUARTER, PAST_QUARTER, FROM_HALF } Octant;

static Wide in_octant(const Wide *angle, Octant octant) {
    Wide constant = wide_constant(wide_half_pi, WIDE_MAX, angle->size);
    if (octant == FROM_HALF)
        constant = wide_add(&constant, &constant);
    return octant == AS_IT_IS       ? *angle
           : octant == PAST_QUARTER ? wide_add(&constant, angle)
                                    : wide_sub(&constant, angle);
}

// The angle at (a, b), both not negative and at most 1, a^2 + b^2 = 1.
static Wide circle_angle(const Wide *b, const Wide *a, bool mirrored) {
    Wide d = wide_sub(a, b);
    bool swap = wide_is_negative(&d);
    Wide angle = swap ? wide_atan(a, b) : wide_atan(b, a);
    return in_octant(&angle, mirrored ? (swap ? PAST_QUARTER : FROM_HALF) : (swap ? FROM_QUARTER : AS_IT_IS));
}

// asin or acos of x, 2^-27 ≤ |x| < 1: the angle at (sqrt(1 - x^2), |x|) or (|x|, sqrt(1 - x^2)). |x| and its square are
// exact with 192 bits; 1 - x^2 ≥ 2^-53 is brought to [1/4, 1] by an even shift before the root is taken.
static double exact_circle(double x, bool cosine) {
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= WIDE_MAX; size *= 2) {
        Wide a = wide_from_double(double_absolute(x), size), one = wide_from_int(1, size), square = wide_mul(&a, &a);
        square = wide_sub(&one, &square);
        int halves = -double_exponent(wide_near(&square)) / 2;
        Wide scaled = wide_scale(&square, 2 * halves), inverse = wide_inverse_root(&scaled);
        Wide root = wide_mul(&scaled, &inverse);
        root = wide_scale(&root, -halves);
        Wide angle = cosine ? circle_angle(&root, &a, x < 0) : circle_angle(&a, &root, false);
        done = wide_decides(&angle, SLACK, 0, &result);
    }
    return !cosine && x < 0 ? -result : result;
}

double exact_asin(double x) {
    if (!(double_absolute(x) <= 1))
        return double_is_nan(x) ? x + x : DOUBLE_NAN;
    if (double_absolute(x) < 0x1p-27)
        return x; // as for the sine
    return double_absolute(x) == 1 ? double_with_sign(HALF_PI_HIGH, x) : exact_circle(x, false);
}

double exact_acos(double x) {
    if (!(double_absolute(x) <= 1))
        return double_is_nan(x) ? x + x : DOUBLE_NAN;
    if (double_absolute(x) < 0x1p-60)
        return HALF_PI_HIGH; // its rest is 2^-53.9, far from half of 2^-52
    return x == 1 ? 0 : x == -1 ? PI_HIGH : exact_circle(x, true);
}

// The double nearest to q - q^3/3 + … for q = (b / a) 2^scale below 2^-60, with whole b and a below 2^53: a quotient of
// 120 bits. No quotient of such numbers is nearer than 2^-107 q to the border of two doubles but on it: the cube, below
// 2^-120 q, only matters there, and there it goes down. The bits are 2 q - 1 with q cut off, an odd number.
static double tiny_ratio(uint64_t b, uint64_t a, int scale) {
    __extension__ typedef unsigned __int128 Long;
    Wide q = wide_from_int(0, 2);
    Long high = (Long)b << 64;
    uint64_t rest = (uint64_t)(high % a);
    Long low = ((Long)rest << 64) / a;
    q.limb[2] = (uint64_t)(high / a >> 64);
    q.limb[1] = (uint64_t)(high / a);
    q.limb[0] = (uint64_t)low;
    bool exact = ((Long)rest << 64) % a == 0;
    Wide least = {.size = 2, .limb = {1}};
    if (exact)
        q = wide_sub(&q, &least);
    q.limb[0] |= 1; // it is not on the border
    return wide_round(&q, scale);
}

static Octant octant_of(double b, double a, double x) {
    bool swap = b > a;
    return x < 0 ? (swap ? PAST_QUARTER : FROM_HALF) : swap ? FROM_QUARTER : AS_IT_IS;
}

// atan2(y, x) of finite numbers that are not 0, without y's sign
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
    for (int size = FIRST_SIZE; !done && size <= WIDE_MAX; size *= 2) {
        // A ratio below 2^-100 is nothing beside pi/2 and pi: their nearest border is 2^-56 away.
        Wide a_wide = wide_from_double((double)am * 0x1p-53, size);
        Wide b_wide = wide_from_double((double)bm * 0x1p-53, size);
        b_wide = scale < -100 ? wide_from_int(0, size) : wide_scale(&b_wide, scale);
        Wide angle = wide_atan(&b_wide, &a_wide);
        angle = in_octant(&angle, octant);
        done = wide_decides(&angle, scale < -100 ? 64 * size - 99 : SLACK, 0, &result);
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

// e^t with t of a size, wrong by 2^slack ulps: t = k ln2 + r, and e^r in [1/2, 2].
static bool decide_exp(const Wide *t, int slack, double *result) {
    int k = (int)(wide_near(t) * LOG_2E_HIGH);
    Wide log_2 = wide_constant(wide_log_2, WIDE_MAX, t->size);
    log_2 = wide_mul_small(&log_2, (uint64_t)(k < 0 ? -k : k));
    Wide r = k < 0 ? wide_add(t, &log_2) : wide_sub(t, &log_2);
    r = wide_exp(&r);
    return wide_decides(&r, slack, k, result);
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
    for (int size = FIRST_SIZE; !done && size <= WIDE_MAX; size *= 2) {
        Wide t = wide_from_double(x, size);
        done = decide_exp(&t, SLACK, &result);
    }
    return result;
}

// ln x of a positive finite number other than 1
static Wide wide_log_of(double x, int size) {
    int exponent;
    double m = (double)double_split(x, &exponent) * 0x1p-52;
    // ln m must not take away most of the exponent's part: m is in [0.7, 1.4).
    return m < 1.40625 ? wide_log(m, exponent + 52, size) : wide_log(m * 0.5, exponent + 53, size);
}

static double exact_logarithm(double x, const uint64_t *scale) {
    if (!(x > 0) || (double_absolute(x) == DOUBLE_INFINITY) || x == 1)
        return double_is_nan(x) ? x + x : x == 0 ? -DOUBLE_INFINITY : x < 0 ? DOUBLE_NAN : x == 1 ? 0 : x;
    double result = 0;
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= WIDE_MAX; size *= 2) {
        Wide log = wide_log_of(x, size);
        if (scale) {
            Wide by = wide_constant(scale, WIDE_MAX, size);
            log = wide_mul(&log, &by);
        }
        done = wide_decides(&log, SLACK, 0, &result);
    }
    return result;
}

EXACT(log, exact_logarithm, NULL)
EXACT(log2, exact_logarithm, wide_log2_e)
EXACT(log10, exact_logarithm, wide_log10_e)

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

// x = *odd 2^*exponent with an odd whole number
static void take_apart(double x, uint64_t *odd, int *exponent) {
    *odd = double_split(x, exponent);
    int zeros = __builtin_ctzll(*odd);
    *odd >>= zeros;
    *exponent += zeros;
}

// The root of a perfect square, or 0.
static uint64_t whole_root(uint64_t m) {
    uint64_t r = (uint64_t)__builtin_sqrt((double)m);
    return r * r == m ? r : 0;
}

// Is x^y, x > 0, a finite binary fraction of at most 64 bits? Such a number may lie on the border of two doubles; one
// with more bits than 54 does not. x = m 2^e and y = k 2^f with odd m and k. For m = 1 it is one if e y is whole. For
// m > 1, y must be positive (3^-1 ends nowhere), and for f < 0 x must be a square of a square … -f times: that is m <
// 2^53 no more than five times. Then m^(k 2^f) has 64 bits at most for an exponent of 40 at most, as m ≥ 3.
static bool pow_is_exact(double x, double y, double *result) {
    uint64_t m, k, power = 1;
    int e, f;
    take_apart(x, &m, &e);
    take_apart(double_absolute(y), &k, &f);
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
        return false; // beyond the range, or it has too many bits
    int n = (int)(k << f);
    if (m > 1 && (y < 0 || n > 40))
        return false;
    if (m > 1)
        for (int i = 0; i < n; i++)
            if (__builtin_mul_overflow(power, m, &power))
                return false;
    Wide whole = wide_from_int(0, 1);
    whole.limb[0] = power; // as a fraction
    *result = wide_round(&whole, 64 + (y < 0 ? -e * n : e * n));
    return true;
}

// y ln x for |y ln x| < 2^11: y is a whole number times 2^exponent. ln x is within 2^SLACK ulps, which y multiplies.
static double exact_positive_pow(double x, double y) {
    double result;
    if (pow_is_exact(x, y, &result))
        return result;
    int exponent;
    uint64_t k = double_split(y, &exponent);
    int above = exponent + 53 > 0 ? exponent + 53 : 0; // |y| < 2^above
    bool done = false;
    for (int size = FIRST_SIZE; !done && size <= WIDE_MAX; size *= 2) {
        Wide t = wide_log_of(x, size);
        double near = wide_near(&t) * y; // but for 2^-48 of it
        if (near > 720 || near < -760)
            return near < 0 ? 0 : DOUBLE_INFINITY;
        if (double_absolute(near) < 0x1p-55)
            return 1;
        t = wide_mul_small(&t, k);
        t = wide_scale(&t, exponent);
        if (y < 0)
            t = wide_negate(&t);
        done = decide_exp(&t, SLACK + above, &result);
    }
    return result;
}

// The cases of C17 F.10.4.4 where x is 0 or infinite: their result for |x|, before the sign.
static double pow_at_end(double x, double y) {
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
        return sign * pow_at_end(a, y);
    if (x < 0 && !is_whole(y))
        return DOUBLE_NAN;
    return sign * (a == 1 ? 1 : exact_positive_pow(a, y));
}
