// wide.c: arithmetic on wide numbers. See wide.h.
#include "maths/wide.h"

#include "maths/doubles.h"
#include "maths/maths_tables.h"

#include <assert.h>
#include <stddef.h>

__extension__ typedef unsigned __int128 Product;

bool wide_is_negative(const Wide *a) {
    return a->limb[a->size] >> 63;
}

Wide wide_from_int(int64_t x, int size) {
    Wide r;
    r.size = size;
    memset(r.limb, 0, sizeof r.limb);
    r.limb[size] = (uint64_t)x;
    return r;
}

Wide wide_negate(const Wide *a) {
    Wide r;
    r.size = a->size;
    bool carry = true;
    for (int i = 0; i <= a->size; i++) {
        r.limb[i] = ~a->limb[i] + carry;
        carry = carry && r.limb[i] == 0;
    }
    return r;
}

static inline __attribute__((always_inline)) void add_limbs(const uint64_t *a, const uint64_t *b, uint64_t *r, int n) {
    Product sum = 0;
    for (int i = 0; i < n; i++) {
        sum += (Product)a[i] + b[i];
        r[i] = (uint64_t)sum;
        sum >>= 64;
    }
}

static inline __attribute__((always_inline)) void sub_limbs(const uint64_t *a, const uint64_t *b, uint64_t *r, int n) {
    uint64_t borrow = 0;
    for (int i = 0; i < n; i++) {
        Product difference = (Product)a[i] - b[i] - borrow;
        r[i] = (uint64_t)difference;
        borrow = (uint64_t)(difference >> 64) & 1;
    }
}

Wide wide_add(const Wide *a, const Wide *b) {
    Wide r;
    r.size = a->size;
    add_limbs(a->limb, b->limb, r.limb, a->size + 1);
    return r;
}

Wide wide_sub(const Wide *a, const Wide *b) {
    Wide r;
    r.size = a->size;
    sub_limbs(a->limb, b->limb, r.limb, a->size + 1);
    return r;
}

static Wide absolute(const Wide *a) {
    return wide_is_negative(a) ? wide_negate(a) : *a;
}

static Wide shift_left(const Wide *a, int by) {
    Wide r = wide_from_int(0, a->size);
    int limbs = by / 64, bits = by % 64;
    for (int i = a->size; i >= limbs; i--) {
        r.limb[i] = a->limb[i - limbs] << bits;
        if (bits && i > limbs)
            r.limb[i] |= a->limb[i - limbs - 1] >> (64 - bits);
    }
    return r;
}

static Wide shift_right(const Wide *a, int by) {
    Wide r = wide_from_int(0, a->size);
    int limbs = by / 64, bits = by % 64;
    for (int i = 0; i + limbs <= a->size; i++) {
        r.limb[i] = a->limb[i + limbs] >> bits;
        if (bits && i + limbs < a->size)
            r.limb[i] |= a->limb[i + limbs + 1] << (64 - bits);
    }
    return r;
}

Wide wide_scale(const Wide *a, int shift) {
    if (shift >= 0)
        return shift_left(a, shift);
    Wide r = absolute(a);
    r = shift_right(&r, -shift);
    return wide_is_negative(a) ? wide_negate(&r) : r;
}

Wide wide_from_double(double x, int size) {
    Wide r = wide_from_int(0, size);
    if (x == 0)
        return r;
    int exponent;
    r.limb[size] = double_split(x, &exponent);
    r = exponent < 0 ? shift_right(&r, -exponent) : shift_left(&r, exponent);
    return x < 0 ? wide_negate(&r) : r;
}

Wide wide_constant(const uint64_t *constant, int limbs, int size) {
    Wide r;
    r.size = size;
    memcpy(r.limb, constant + (limbs - size), sizeof *constant * (size_t)(size + 1));
    return r;
}

static inline __attribute__((always_inline)) void multiply(const uint64_t *a, const uint64_t *b, uint64_t *all, int n) {
    for (int i = 0; i < n; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < n; j++) {
            Product t = (Product)a[i] * b[j] + (i ? all[i + j] : 0) + carry;
            all[i + j] = (uint64_t)t;
            carry = (uint64_t)(t >> 64);
        }
        all[i + n] = carry;
    }
}

// The school's way, as if both had no sign, and all of the product before its lower limbs are dropped. The limbs of a
// negative a stand for 2^(64 n) more than a: b 2^(64 n) too much.
Wide wide_mul(const Wide *a, const Wide *b) {
    Wide r;
    r.size = a->size;
    uint64_t all[2 * WIDE_MAX + 4];
    int n = a->size + 1;
    if (n == 4) // by far the most frequent size
        multiply(a->limb, b->limb, all, 4);
    else
        multiply(a->limb, b->limb, all, n);
    if (wide_is_negative(a))
        sub_limbs(all + n, b->limb, all + n, n);
    if (wide_is_negative(b))
        sub_limbs(all + n, a->limb, all + n, n);
    memcpy(r.limb, all + a->size, sizeof *all * (size_t)n);
    return r;
}

// One step of Horner's rule after the other, on bare limbs: this is where the time goes.
static inline __attribute__((always_inline)) void sum_series(const Wide *x, Series series, uint64_t *sum, int n) {
    uint64_t all[2 * WIDE_MAX + 4];
    for (int k = series.last - series.stride; k >= series.first; k -= series.stride) {
        const uint64_t *term = wide_inverse_factorial[k] + (WIDE_MAX - (n - 1));
        multiply(x->limb, sum, all, n);
        if (series.alternating)
            sub_limbs(term, all + n - 1, sum, n);
        else
            add_limbs(term, all + n - 1, sum, n);
    }
}

Wide wide_series(const Wide *x, Series series) {
    assert((size_t)series.last < sizeof wide_inverse_factorial / sizeof *wide_inverse_factorial);
    Wide sum = wide_constant(wide_inverse_factorial[series.last], WIDE_MAX, x->size);
    if (x->size == 3)
        sum_series(x, series, sum.limb, 4);
    else
        sum_series(x, series, sum.limb, x->size + 1);
    return sum;
}

// Two halves of a limb at a time, so that 64-bit divisions do.
Wide wide_div_small(const Wide *a, uint32_t by) {
    Wide x = absolute(a), r;
    r.size = a->size;
    uint64_t rest = 0;
    for (int i = a->size; i >= 0; i--) {
        uint64_t high = rest << 32 | x.limb[i] >> 32, low = (high % by) << 32 | (x.limb[i] & 0xffffffff);
        r.limb[i] = (high / by) << 32 | low / by;
        rest = low % by;
    }
    return wide_is_negative(a) ? wide_negate(&r) : r;
}

Wide wide_mul_small(const Wide *a, uint64_t by) {
    Wide x = absolute(a), r;
    r.size = a->size;
    uint64_t carry = 0;
    for (int i = 0; i <= a->size; i++) {
        Product t = (Product)x.limb[i] * by + carry;
        r.limb[i] = (uint64_t)t;
        carry = (uint64_t)(t >> 64);
    }
    return wide_is_negative(a) ? wide_negate(&r) : r;
}

// Newton's r + r (1 - a r), which squares the relative error: 2^-48 at first, then 2^-96, and so on. The last step adds
// its own roundings: two products and what r (≤ 2) makes of them, less than 8 ulps.
Wide wide_inverse(const Wide *a) {
    Wide one = wide_from_int(1, a->size), r = wide_from_double(1 / wide_near(a), a->size);
    for (int bits = 48; bits < 64 * a->size + 48; bits *= 2) {
        Wide t = wide_mul(a, &r);
        t = wide_sub(&one, &t);
        t = wide_mul(&r, &t);
        r = wide_add(&r, &t);
    }
    return r;
}

// Newton's r + r (1 - a r^2) / 2: a relative error e becomes 3/2 e^2, 2^-48 at first.
Wide wide_inverse_root(const Wide *a) {
    Wide one = wide_from_int(1, a->size), r = wide_from_double(1 / __builtin_sqrt(wide_near(a)), a->size);
    for (int bits = 47; bits < 64 * a->size + 47; bits = 2 * bits - 1) {
        Wide t = wide_mul(&r, &r);
        t = wide_mul(a, &t);
        t = wide_sub(&one, &t);
        t = wide_mul(&r, &t);
        t = wide_scale(&t, -1);
        r = wide_add(&r, &t);
    }
    return r;
}

// The number of bits of an absolute value.
static int length(const Wide *a) {
    for (int i = a->size; i >= 0; i--)
        if (a->limb[i])
            return 64 * i + 64 - __builtin_clzll(a->limb[i]);
    return 0;
}

static bool bit(const Wide *a, int i) {
    return a->limb[i / 64] >> (i % 64) & 1;
}

static bool any_below(const Wide *a, int i) {
    for (int limb = 0; limb < i / 64; limb++)
        if (a->limb[limb])
            return true;
    return i % 64 && a->limb[i / 64] << (64 - i % 64);
}

double wide_round(const Wide *a, int scale) {
    Wide x = absolute(a);
    uint64_t sign = wide_is_negative(a) ? DOUBLE_SIGN : 0, kept;
    int top = length(&x);
    if (!top)
        return 0;
    // The last bit that the double keeps has the weight 2^unit; in x it is bit number `last`.
    int weight = top - 64 * x.size + scale, unit = weight - 53 > -1074 ? weight - 53 : -1074;
    int last = unit - scale + 64 * x.size;
    if (last > top || weight > 1024)
        return double_of(sign | (last > top ? 0 : double_bits(DOUBLE_INFINITY)));
    if (last <= 0)
        kept = shift_left(&x, -last).limb[0];
    else {
        kept = shift_right(&x, last).limb[0];
        kept += bit(&x, last - 1) && ((kept & 1) || any_below(&x, last - 1));
    }
    // The hidden bit of a normal number adds 1 to the exponent; so does a carry, even to infinity.
    return double_of(sign | (((uint64_t)(unit + 1074) << 52) + kept));
}

double wide_near(const Wide *a) {
    return wide_round(a, 0);
}

bool wide_decides(const Wide *a, int slack, int scale, double *result) {
    Wide error = wide_from_int(0, a->size);
    error.limb[slack / 64] = UINT64_C(1) << slack % 64;
    Wide low = wide_sub(a, &error), high = wide_add(a, &error);
    *result = wide_round(&high, scale);
    double other = wide_round(&low, scale);
    return double_bits(*result) == double_bits(other);
}
