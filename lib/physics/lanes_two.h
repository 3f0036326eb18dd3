// lanes_two.h: the vocabulary of lanes.h with two lanes, in the vector extension that gcc and clang share. It comes out
// as SSE2 on x86-64, as NEON on AArch64, as SIMD128 in WebAssembly, and as plain C elsewhere.
#ifndef PETRI_PHYSICS_LANES_TWO_H
#define PETRI_PHYSICS_LANES_TWO_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#define KERNEL static inline __attribute__((always_inline))
#define LANES 2
#define LANES_LEVEL CPU_SCALAR
#define PER_ISA(name) name##_two

typedef double Real __attribute__((vector_size(16)));
typedef int64_t Mask __attribute__((vector_size(16)));

KERNEL Mask mask_first(size_t count) {
    return (Mask){count > 0 ? -1 : 0, count > 1 ? -1 : 0};
}
KERNEL Mask mask_and(Mask a, Mask b) {
    return a & b;
}
KERNEL Mask mask_or(Mask a, Mask b) {
    return a | b;
}
KERNEL Mask mask_not(Mask a) {
    return ~a;
}
KERNEL unsigned mask_bits(Mask a) {
    return (unsigned)(a[0] & 1) | (unsigned)(a[1] & 2);
}
KERNEL bool mask_any(Mask a) {
    return (a[0] | a[1]) != 0;
}
KERNEL Mask real_less(Real a, Real b) {
    return (Mask)(a < b);
}
KERNEL Mask real_less_where(Mask mask, Real a, Real b) {
    return mask & (Mask)(a < b);
}
KERNEL Mask real_at_most_where(Mask mask, Real a, Real b) {
    return mask & (Mask)(a <= b);
}
KERNEL Mask real_differs_where(Mask mask, Real a, Real b) {
    return mask & (Mask)(a != b);
}
KERNEL Real real_select(Mask mask, Real a, Real b) {
    return (Real)((mask & (Mask)a) | (~mask & (Mask)b));
}
KERNEL Real real_keep(Mask mask, Real a) {
    return (Real)(mask & (Mask)a);
}
KERNEL Real real_zero(void) {
    return (Real){0, 0};
}
KERNEL Real real_set(double a) {
    return (Real){a, a};
}
KERNEL Real real_add(Real a, Real b) {
    return a + b;
}
KERNEL Real real_sub(Real a, Real b) {
    return a - b;
}
KERNEL Real real_mul(Real a, Real b) {
    return a * b;
}
KERNEL Real real_div(Real a, Real b) {
    return a / b;
}
// The vector extension has no square root.
KERNEL Real real_sqrt(Real a) {
#if defined(__SSE2__)
    return (Real)_mm_sqrt_pd((__m128d)a);
#elif defined(__aarch64__)
    return (Real)vsqrtq_f64((float64x2_t)a);
#elif defined(__wasm_simd128__)
    return (Real)wasm_f64x2_sqrt((v128_t)a);
#else
    return (Real){sqrt(a[0]), sqrt(a[1])};
#endif
}
KERNEL Real real_larger(Real a, Real b) {
    return real_select((Mask)(a > b), a, b);
}
KERNEL Real real_absolute(Real a) {
    return (Real)((Mask)a & (Mask){INT64_MAX, INT64_MAX});
}
KERNEL Real real_add_where(Mask mask, Real sum, Real a) {
    return real_select(mask, sum + a, sum);
}
KERNEL Real real_sub_where(Mask mask, Real sum, Real a) {
    return real_select(mask, sum - a, sum);
}
KERNEL Real real_load(const double *from) {
    return (Real){from[0], from[1]};
}
KERNEL void real_store(double *to, Real a) {
    to[0] = a[0];
    to[1] = a[1];
}
KERNEL void real_store_where(Mask mask, double *to, Real a) {
    for (int lane = 0; lane < LANES; lane++)
        if (mask[lane])
            to[lane] = a[lane];
}
KERNEL void real_transpose(Real *r) {
    Real first = {r[0][0], r[1][0]}, second = {r[0][1], r[1][1]};
    r[0] = first;
    r[1] = second;
}
KERNEL Real real_gather(const double *from, const uint32_t *index) {
    return (Real){from[index[0]], from[index[1]]};
}
KERNEL void real_scatter_where(Mask mask, double *to, const uint32_t *index, Real a) {
    for (int lane = 0; lane < LANES; lane++)
        if (mask[lane])
            to[index[lane]] = a[lane];
}
KERNEL void real_load_quads(const double *quads, const uint32_t *index, Real *parts) {
    const double *a = quads + 4 * (size_t)index[0], *b = quads + 4 * (size_t)index[1];
    for (int m = 0; m < 4; m++)
        parts[m] = (Real){a[m], b[m]};
}
KERNEL void real_store_quads(double *quads, const Real *parts) {
    for (int lane = 0; lane < LANES; lane++)
        for (int m = 0; m < 4; m++)
            quads[4 * lane + m] = parts[m][lane];
}
KERNEL size_t mask_numbers(Mask mask, uint32_t base, uint32_t *to) {
    size_t count = 0;
    for (uint32_t lane = 0; lane < LANES; lane++)
        if (mask[lane])
            to[count++] = base + lane;
    return count;
}

#endif
