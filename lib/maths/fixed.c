// fixed.c: the arithmetic functions of fixed.h.
#include "maths/fixed.h"

#include "base/wide.h"
#include "maths/double_bits.h"
#include "maths/maths_tables.h"

#include <assert.h>
#include <stddef.h>

bool fixed_is_negative(const Fixed *a) {
    return a->limb[a->size] >> 63;
}

Fixed fixed_from_int(int64_t x, int size) {
    Fixed r;
    r.size = size;
    memset(r.limb, 0, sizeof r.limb);
    r.limb[size] = (uint64_t)x;
    return r;
}

Fixed fixed_negate(const Fixed *a) {
    Fixed r;
    r.size = a->size;
    bool carry = true;
    for (int i = 0; i <= a->size; i++) {
        r.limb[i] = ~a->limb[i] + carry;
        carry = carry && r.limb[i] == 0;
    }
    return r;
}

static inline __attribute__((always_inline)) void add_limbs(const uint64_t *a, const uint64_t *b, uint64_t *r, int n) {
    uint64_t carry = 0;
    for (int i = 0; i < n; i++) {
        uint64_t sum = a[i] + carry;
        carry = sum < carry;
        r[i] = sum + b[i];
        carry += r[i] < sum;
    }
}

static inline __attribute__((always_inline)) void sub_limbs(const uint64_t *a, const uint64_t *b, uint64_t *r, int n) {
    uint64_t borrow = 0;
    for (int i = 0; i < n; i++) {
        uint64_t difference = a[i] - borrow, lower = b[i];
        borrow = difference > a[i];
        borrow += difference < lower;
        r[i] = difference - lower;
    }
}

Fixed fixed_add(const Fixed *a, const Fixed *b) {
    Fixed r;
    r.size = a->size;
    add_limbs(a->limb, b->limb, r.limb, a->size + 1);
    return r;
}

Fixed fixed_sub(const Fixed *a, const Fixed *b) {
    Fixed r;
    r.size = a->size;
    sub_limbs(a->limb, b->limb, r.limb, a->size + 1);
    return r;
}

static Fixed absolute_value(const Fixed *a) {
    return fixed_is_negative(a) ? fixed_negate(a) : *a;
}

static Fixed shift_left(const Fixed *a, int by) {
    Fixed r = fixed_from_int(0, a->size);
    int limbs = by / 64, bits = by % 64;
    for (int i = a->size; i >= limbs; i--) {
        r.limb[i] = a->limb[i - limbs] << bits;
        if (bits && i > limbs)
            r.limb[i] |= a->limb[i - limbs - 1] >> (64 - bits);
    }
    return r;
}

static Fixed shift_right(const Fixed *a, int by) {
    Fixed r = fixed_from_int(0, a->size);
    int limbs = by / 64, bits = by % 64;
    for (int i = 0; i + limbs <= a->size; i++) {
        r.limb[i] = a->limb[i + limbs] >> bits;
        if (bits && i + limbs < a->size)
            r.limb[i] |= a->limb[i + limbs + 1] << (64 - bits);
    }
    return r;
}

Fixed fixed_scale(const Fixed *a, int shift) {
    if (shift >= 0)
        return shift_left(a, shift);
    Fixed r = absolute_value(a);
    r = shift_right(&r, -shift);
    return fixed_is_negative(a) ? fixed_negate(&r) : r;
}

Fixed fixed_from_double(double x, int size) {
    Fixed r = fixed_from_int(0, size);
    if (x == 0)
        return r;
    int exponent;
    r.limb[size] = double_split(x, &exponent);
    r = exponent < 0 ? shift_right(&r, -exponent) : shift_left(&r, exponent);
    return x < 0 ? fixed_negate(&r) : r;
}

Fixed fixed_constant(const uint64_t *constant, int size) {
    Fixed r;
    r.size = size;
    memcpy(r.limb, constant + (FIXED_MAX_LIMBS - size), sizeof *constant * (size_t)(size + 1));
    return r;
}

static inline __attribute__((always_inline)) void multiply_limbs(const uint64_t *a, const uint64_t *b, uint64_t *all,
                                                                 int n) {
    for (int i = 0; i < n; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < n; j++) {
            Wide t = wide_multiply_add(a[i], b[j], carry);
            uint64_t before = i ? all[i + j] : 0;
            all[i + j] = t.low + before;
            carry = t.high + (all[i + j] < before);
        }
        all[i + n] = carry;
    }
}

// Multiplies the operands as unsigned numbers by the schoolbook method, then drops the lower limbs. A negative a is
// represented as a + 2^(64 n). The product is then too large by b 2^(64 n), which is subtracted. The same applies to a
// negative b.
Fixed fixed_mul(const Fixed *a, const Fixed *b) {
    Fixed r;
    r.size = a->size;
    uint64_t all[2 * FIXED_MAX_LIMBS + 4];
    int n = a->size + 1;
    if (n == 4) // by far the most frequent size
        multiply_limbs(a->limb, b->limb, all, 4);
    else
        multiply_limbs(a->limb, b->limb, all, n);
    if (fixed_is_negative(a))
        sub_limbs(all + n, b->limb, all + n, n);
    if (fixed_is_negative(b))
        sub_limbs(all + n, a->limb, all + n, n);
    memcpy(r.limb, all + a->size, sizeof *all * (size_t)n);
    return r;
}

// Evaluates the series by Horner's rule. Works on limbs directly, because most of the time is spent here.
static inline __attribute__((always_inline)) void sum_series(const Fixed *x, Series series, uint64_t *sum, int n) {
    uint64_t all[2 * FIXED_MAX_LIMBS + 4];
    for (int k = series.last - series.stride; k >= series.first; k -= series.stride) {
        const uint64_t *term = fixed_inverse_factorial[k] + (FIXED_MAX_LIMBS - (n - 1));
        multiply_limbs(x->limb, sum, all, n);
        if (series.alternating)
            sub_limbs(term, all + n - 1, sum, n);
        else
            add_limbs(term, all + n - 1, sum, n);
    }
}

Fixed fixed_series(const Fixed *x, Series series) {
    assert((size_t)series.last < sizeof fixed_inverse_factorial / sizeof *fixed_inverse_factorial);
    Fixed sum = fixed_constant(fixed_inverse_factorial[series.last], x->size);
    if (x->size == 3)
        sum_series(x, series, sum.limb, 4);
    else
        sum_series(x, series, sum.limb, x->size + 1);
    return sum;
}

// Long division, half a limb at a time, so that 64-bit divisions suffice.
Fixed fixed_div_small(const Fixed *a, uint32_t by) {
    Fixed x = absolute_value(a), r;
    r.size = a->size;
    uint64_t rest = 0;
    for (int i = a->size; i >= 0; i--) {
        uint64_t high = rest << 32 | x.limb[i] >> 32, low = (high % by) << 32 | (x.limb[i] & 0xffffffff);
        r.limb[i] = (high / by) << 32 | low / by;
        rest = low % by;
    }
    return fixed_is_negative(a) ? fixed_negate(&r) : r;
}

Fixed fixed_mul_small(const Fixed *a, uint64_t by) {
    Fixed x = absolute_value(a), r;
    r.size = a->size;
    uint64_t carry = 0;
    for (int i = 0; i <= a->size; i++) {
        Wide t = wide_multiply_add(x.limb[i], by, carry);
        r.limb[i] = t.low;
        carry = t.high;
    }
    return fixed_is_negative(a) ? fixed_negate(&r) : r;
}

// Newton's iteration r + r (1 - a r) squares the relative error: initially 2^-48, then 2^-96 and so on. The roundings
// of the last iteration (two products, multiplied by r ≤ 2) add less than 8 ulps.
Fixed fixed_inverse(const Fixed *a) {
    Fixed one = fixed_from_int(1, a->size), r = fixed_from_double(1 / fixed_to_double(a), a->size);
    for (int bits = 48; bits < 64 * a->size + 48; bits *= 2) {
        Fixed t = fixed_mul(a, &r);
        t = fixed_sub(&one, &t);
        t = fixed_mul(&r, &t);
        r = fixed_add(&r, &t);
    }
    return r;
}

// Newton's iteration r + r (1 - a r^2) / 2 reduces a relative error e, initially 2^-48, to 3/2 e^2.
Fixed fixed_inverse_root(const Fixed *a) {
    Fixed one = fixed_from_int(1, a->size), r = fixed_from_double(1 / __builtin_sqrt(fixed_to_double(a)), a->size);
    for (int bits = 47; bits < 64 * a->size + 47; bits = 2 * bits - 1) {
        Fixed t = fixed_mul(&r, &r);
        t = fixed_mul(a, &t);
        t = fixed_sub(&one, &t);
        t = fixed_mul(&r, &t);
        t = fixed_scale(&t, -1);
        r = fixed_add(&r, &t);
    }
    return r;
}

// Returns the number of bits of a non-negative number, without leading zeros.
static int bit_length(const Fixed *a) {
    for (int i = a->size; i >= 0; i--)
        if (a->limb[i])
            return 64 * i + 64 - __builtin_clzll(a->limb[i]);
    return 0;
}

static bool get_bit(const Fixed *a, int i) {
    return a->limb[i / 64] >> (i % 64) & 1;
}

static bool any_bit_below(const Fixed *a, int i) {
    for (int limb = 0; limb < i / 64; limb++)
        if (a->limb[limb])
            return true;
    return i % 64 && a->limb[i / 64] << (64 - i % 64);
}

double fixed_round(const Fixed *a, int scale) {
    Fixed x = absolute_value(a);
    uint64_t sign = fixed_is_negative(a) ? DOUBLE_SIGN : 0, mantissa;
    int top = bit_length(&x);
    if (!top)
        return 0;
    // The lowest bit of the double is bit `last` of x and has the weight 2^unit.
    int weight = top - 64 * x.size + scale, unit = weight - 53 > -1074 ? weight - 53 : -1074;
    int last = unit - scale + 64 * x.size;
    if (last > top || weight > 1024)
        return double_from_bits(sign | (last > top ? 0 : double_bits(DOUBLE_INFINITY)));
    if (last <= 0)
        mantissa = shift_left(&x, -last).limb[0];
    else {
        mantissa = shift_right(&x, last).limb[0];
        mantissa += get_bit(&x, last - 1) && ((mantissa & 1) || any_bit_below(&x, last - 1));
    }
    // The mantissa includes its implicit leading bit, so the addition increments the exponent field. A carry from the
    // rounding increments it once more, which can result in infinity.
    return double_from_bits(sign | (((uint64_t)(unit + 1074) << 52) + mantissa));
}

double fixed_to_double(const Fixed *a) {
    return fixed_round(a, 0);
}

bool fixed_decides(const Fixed *a, int slack, int scale, double *result) {
    Fixed error = fixed_from_int(0, a->size);
    error.limb[slack / 64] = UINT64_C(1) << slack % 64;
    Fixed low = fixed_sub(a, &error), high = fixed_add(a, &error);
    *result = fixed_round(&high, scale);
    double other = fixed_round(&low, scale);
    return double_bits(*result) == double_bits(other);
}
