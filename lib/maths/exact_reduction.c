// exact_reduction.c: reduction of large arguments for the fast paths of sine, cosine and tangent.
//
// Payne and Hanek's method (1983) with integers, like fixed_reduce. With |x| = m 2^exponent, the product of m and
// 2/pi 2^exponent is the number of quarter turns. 64 bits of its integer part and 192 of its fraction are computed. As
// the table is truncated, they are too small by less than m < 2^53 units of the last bit. Only the upper 136 bits of
// the fraction are used, so the angle is accurate to 2^-127 quarter turns. After conversion to two doubles it is
// accurate to 2^-116.
#include "base/wide.h"
#include "maths/double_bits.h"
#include "maths/fast.h"
#include "maths/fixed.h"
#include "maths/lanes.h"
#include "maths/maths_tables.h"

void exact_reduction(double x, uint64_t *n, double *high, double *low) {
    enum { LIMBS = 1024 / 64 + FIXED_MAX_LIMBS + 2, FRACTION = 3 };
    int exponent;
    uint64_t m = double_split(x, &exponent);
    int from = 64 * (LIMBS - FRACTION) - exponent;
    uint64_t product[FRACTION + 1], carry = 0;
    const uint64_t *table = fixed_two_over_pi + from / 64;
    int shift = from % 64;
    for (int i = 0; i <= FRACTION; i++) {
        uint64_t above = from / 64 + i < LIMBS ? table[i + 1] : 0; // the integer part of 2/pi is 0
        uint64_t window = shift ? table[i] >> shift | above << (64 - shift) : table[i];
        Wide t = wide_multiply_add(m, window, carry);
        product[i] = t.low;
        carry = t.high;
    }
    // Round to a multiple of pi/512: the integer part and 8 bits of the fraction become n.
    uint64_t upper = product[2] << 8 | product[1] >> 56, rest = product[1] << 8 | product[0] >> 56;
    *n = (product[3] << 8 | product[2] >> 56) + (upper >> 63);
    // The remainder is in [-1/2, 1/2) steps of pi/512. `first` holds its upper 53 bits and `second` the next 75, both
    // in units of 2^-64 steps.
    double first = (double)(int64_t)(upper & ~UINT64_C(2047));
    double second = (double)(upper & 2047) + (double)rest * 0x1p-64;
    if (x < 0) {
        *n = -*n;
        first = -first;
        second = -second;
    }
    // Multiply by 2^-64 pi/512 = 2^-72 pi/2. The product is the sum of two doubles.
    double a = first * HALF_PI_HIGH, b = real_two_product_error(first, HALF_PI_HIGH, a);
    b += first * HALF_PI_LOW + second * HALF_PI_HIGH;
    double sum = a + b;
    *low = real_two_sum_error(a, b, sum) * 0x1p-72;
    *high = sum * 0x1p-72;
}
