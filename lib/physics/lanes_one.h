// lanes_one.h: the part of the vocabulary of lanes.h that formulas use, with one lane: plain C. It serves what has no
// vector form: any number of dimensions, groups of a few particles, links, bounces.
#ifndef PETRI_PHYSICS_LANES_ONE_H
#define PETRI_PHYSICS_LANES_ONE_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KERNEL static inline __attribute__((always_inline))
#define LANES 1
#define LANES_LEVEL CPU_SCALAR
#define PER_ISA(name) name##_one

typedef double Real;
typedef bool Mask;

KERNEL Mask mask_first(size_t count) {
    return count > 0;
}
KERNEL Mask mask_and(Mask a, Mask b) {
    return a && b;
}
KERNEL Mask mask_or(Mask a, Mask b) {
    return a || b;
}
KERNEL Mask mask_not(Mask a) {
    return !a;
}
KERNEL unsigned mask_bits(Mask a) {
    return a;
}
KERNEL bool mask_any(Mask a) {
    return a;
}
KERNEL Mask real_less(Real a, Real b) {
    return a < b;
}
KERNEL Mask real_less_where(Mask mask, Real a, Real b) {
    return mask && a < b;
}
KERNEL Mask real_at_most_where(Mask mask, Real a, Real b) {
    return mask && a <= b;
}
KERNEL Mask real_differs_where(Mask mask, Real a, Real b) {
    return mask && a != b;
}
KERNEL Real real_select(Mask mask, Real a, Real b) {
    return mask ? a : b;
}
KERNEL Real real_zero(void) {
    return 0;
}
KERNEL Real real_set(double a) {
    return a;
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
KERNEL Real real_sqrt(Real a) {
    return sqrt(a);
}
KERNEL Real real_larger(Real a, Real b) {
    return a > b ? a : b;
}
KERNEL Real real_absolute(Real a) {
    return fabs(a);
}
KERNEL Real real_add_where(Mask mask, Real sum, Real a) {
    return mask ? sum + a : sum;
}
KERNEL Real real_sub_where(Mask mask, Real sum, Real a) {
    return mask ? sum - a : sum;
}
KERNEL Real real_load(const double *from) {
    return *from;
}
KERNEL void real_store(double *to, Real a) {
    *to = a;
}

#endif
