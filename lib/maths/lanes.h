// lanes.h: the vocabulary of the fast paths: LANES doubles at a time, for the instruction set of the file.
//
// LANES (1, 2, 4 or 8) is set by the file that includes this. With one lane a Real is a double, so that the same source
// gives the scalar functions. Arithmetic is written with operators; each is one IEEE operation per lane.
#ifndef PETRI_MATHS_LANES_H
#define PETRI_MATHS_LANES_H

#include <stdint.h>
#include <string.h>

#if defined(__AVX2__) || defined(__FMA__)
#include <immintrin.h>
#endif
#if defined(__aarch64__)
#include <arm_neon.h>
#endif

#ifndef LANES
#define LANES 1
#endif

// A test may look at what is decided.
#ifndef LANES_WATCH
#define LANES_WATCH(high, low, error) (void)0
#endif

#define KERNEL static inline __attribute__((always_inline))

#if LANES == 1
typedef double Real;
typedef uint64_t Bits;
#else
typedef double Real __attribute__((vector_size(8 * LANES)));
typedef uint64_t Bits __attribute__((vector_size(8 * LANES)));
#endif

// A set of lanes, the first in the lowest bit.
typedef unsigned Lanes;
#define ALL_LANES ((1u << LANES) - 1)

// The lanes in both sets. A single lane takes a branch, which is foreseen well.
#if LANES == 1
#define LANES_BOTH(a, b) ((a) && (b))
#else
#define LANES_BOTH(a, b) ((a) & (b))
#endif

// Has this instruction set a fused multiply-add? It only serves to find results, never to change them.
#if defined(__FMA__) || defined(__aarch64__)
#define HAS_FMA 1
#else
#define HAS_FMA 0
#endif

KERNEL Bits bits_of(Real a) {
    Bits b;
    memcpy(&b, &a, sizeof b);
    return b;
}

KERNEL Real real_of(Bits a) {
    Real b;
    memcpy(&b, &a, sizeof b);
    return b;
}

KERNEL Real real_set(double a) {
#if LANES == 1
    return a;
#else
    return a - (Real){0};
#endif
}

KERNEL Bits bits_set(uint64_t a) {
#if LANES == 1
    return a;
#else
    return a - (Bits){0};
#endif
}

KERNEL Real real_absolute(Real a) {
#if LANES == 1
    return __builtin_fabs(a);
#else
    return real_of(bits_of(a) & bits_set(UINT64_MAX >> 1));
#endif
}

// a b + c with one rounding or with two: for sums whose error bound covers both.
KERNEL Real real_muladd(Real a, Real b, Real c) {
#if !HAS_FMA
    return a * b + c;
#elif LANES == 1
    return __builtin_fma(a, b, c);
#elif LANES == 2 && defined(__aarch64__)
    return (Real)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b);
#elif LANES == 2
    return _mm_fmadd_pd(a, b, c);
#elif LANES == 4
    return _mm256_fmadd_pd(a, b, c);
#else
    return _mm512_fmadd_pd(a, b, c);
#endif
}

#if !HAS_FMA
// Veltkamp: a is the sum of the result and a rest, 26 bits each. |a| < 2^996.
KERNEL Real real_upper(Real a) {
    Real c = a * real_set(134217729.0);
    return c - (c - a);
}
#endif

// a b - p, exactly, for p = a b rounded: by a fused operation or as Dekker (1971) does it. No exponent below -1022.
KERNEL Real real_mul_low(Real a, Real b, Real p) {
#if HAS_FMA
    return real_muladd(a, b, -p);
#else
    Real ah = real_upper(a), bh = real_upper(b), al = a - ah, bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
#endif
}

// c - a b, exactly if that is a double and a b is near c: the rest of a quotient or of a root.
KERNEL Real real_residue(Real c, Real a, Real b) {
#if HAS_FMA
    return real_muladd(-a, b, c);
#else
    Real p = a * b;
    return (c - p) - real_mul_low(a, b, p);
#endif
}

// The rounding error of s = a + b, exactly, where |a| ≥ |b| or a = 0 (Dekker).
KERNEL Real real_add_low(Real a, Real b, Real s) {
    return b - (s - a);
}

// The same for any a and b (Knuth).
KERNEL Real real_add_rest(Real a, Real b, Real s) {
    Real t = s - a;
    return (a - (s - t)) + (b - t);
}

// table[index] per lane.
KERNEL Real real_look_up(const double *table, Bits index) {
#if LANES == 1
    return table[index];
#elif LANES == 4 && defined(__AVX2__)
    return _mm256_i64gather_pd(table, (__m256i)index, 8);
#elif LANES == 8 && defined(__AVX512F__)
    return _mm512_i64gather_pd((__m512i)index, table, 8);
#else
    Real r;
    for (int i = 0; i < LANES; i++)
        r[i] = table[index[i]];
    return r;
#endif
}

// Row `index` of a table of four columns: its columns per lane. One load a lane and an exchange of places are faster
// than four gathers.
typedef struct Four {
    Real a, b, c, d;
} Four;

KERNEL Four real_look_up_four(const double (*table)[4], Bits index) {
#if LANES == 1
    const double *row = table[index];
    return (Four){row[0], row[1], row[2], row[3]};
#elif LANES == 4 && defined(__AVX2__)
    __m256d a = _mm256_loadu_pd(table[index[0]]), b = _mm256_loadu_pd(table[index[1]]);
    __m256d c = _mm256_loadu_pd(table[index[2]]), d = _mm256_loadu_pd(table[index[3]]);
    __m256d even_ab = _mm256_unpacklo_pd(a, b), odd_ab = _mm256_unpackhi_pd(a, b);
    __m256d even_cd = _mm256_unpacklo_pd(c, d), odd_cd = _mm256_unpackhi_pd(c, d);
    return (Four){_mm256_permute2f128_pd(even_ab, even_cd, 0x20), _mm256_permute2f128_pd(odd_ab, odd_cd, 0x20),
                  _mm256_permute2f128_pd(even_ab, even_cd, 0x31), _mm256_permute2f128_pd(odd_ab, odd_cd, 0x31)};
#elif LANES == 8 && defined(__AVX512F__)
#define ROW(lane) _mm256_loadu_pd(table[index[lane]])
#define ROWS(lane) _mm512_insertf64x4(_mm512_castpd256_pd512(ROW(lane)), ROW(lane + 4), 1)
    __m512d a = ROWS(0), b = ROWS(1), c = ROWS(2), d = ROWS(3);
#undef ROWS
#undef ROW
    __m512d even_ab = _mm512_unpacklo_pd(a, b), odd_ab = _mm512_unpackhi_pd(a, b);
    __m512d even_cd = _mm512_unpacklo_pd(c, d), odd_cd = _mm512_unpackhi_pd(c, d);
    __m512i low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0), high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
    return (Four){_mm512_permutex2var_pd(even_ab, low, even_cd), _mm512_permutex2var_pd(odd_ab, low, odd_cd),
                  _mm512_permutex2var_pd(even_ab, high, even_cd), _mm512_permutex2var_pd(odd_ab, high, odd_cd)};
#else
    const double *first = table[0];
    index <<= 2;
    return (Four){real_look_up(first, index), real_look_up(first + 1, index), real_look_up(first + 2, index),
                  real_look_up(first + 3, index)};
#endif
}

// The upper 12 bits, as signed numbers.
KERNEL Real lanes_exponent(Bits a) {
#if LANES == 1
    return (double)((int64_t)a >> 52);
#else
    // Plus 2048 they are positive; put behind the exponent of 2^52 they make a double.
    Bits above = (a ^ bits_set(UINT64_C(1) << 63)) >> 52;
    return real_of(above | bits_set(UINT64_C(0x4330000000000000))) - real_set(4503599627370496.0 + 2048);
#endif
}

// Comparisons; false for nan.
KERNEL Lanes lanes_equal(Real a, Real b) {
#if LANES == 1
    return a == b;
#elif LANES == 8 && defined(__AVX512F__)
    return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ);
#elif LANES == 4 && defined(__AVX2__)
    return (Lanes)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_EQ_OQ));
#else
    Lanes r = 0;
    for (int i = 0; i < LANES; i++)
        r |= (Lanes)(a[i] == b[i]) << i;
    return r;
#endif
}

KERNEL Lanes lanes_less(Real a, Real b) {
#if LANES == 1
    return a < b;
#elif LANES == 8 && defined(__AVX512F__)
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
#elif LANES == 4 && defined(__AVX2__)
    return (Lanes)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ));
#else
    Lanes r = 0;
    for (int i = 0; i < LANES; i++)
        r |= (Lanes)(a[i] < b[i]) << i;
    return r;
#endif
}

// Ziv's rounding test (ACM TOMS 17, 1991): if the exact value is within `error` of high + low, *result is that value
// rounded to nearest in the lanes that are returned.
KERNEL Lanes lanes_decide(Real high, Real low, Real error, Real *result) {
    LANES_WATCH(high, low, error);
    *result = high + (low + error);
    return lanes_equal(*result, high + (low - error));
}

// x to the nearest whole number, |x| < 2^51 (times `step` before): as a double, and in two's complement.
#define REAL_ROUNDER 6755399441055744.0 // 1.5 2^52
KERNEL Real real_steps(Real x, double step, Bits *number) {
    Real shifted = x * real_set(step) + real_set(REAL_ROUNDER);
    *number = bits_of(shifted) - bits_of(real_set(REAL_ROUNDER));
    return shifted - real_set(REAL_ROUNDER);
}

#endif
