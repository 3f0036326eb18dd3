// random.h: counter-based random numbers and trigonometry in turns (spec builtins.md B1.2 and B9).
//
// A stream is a 64-bit key; any of its items can be computed on its own, in any order and on any thread.
#ifndef PETRI_MATHS_RANDOM_H
#define PETRI_MATHS_RANDOM_H

#include "base/cpu.h"

#include <stddef.h>
#include <stdint.h>

// Sine and cosine of t turns, exact at quarter turns up to the sign of zero (B1.2).
double turns_sin(double t);
double turns_cos(double t);

#define RANDOM_HASH_START UINT64_C(0xe220a8397b1dcdaf)
// One round of the seed hash (B9.2): h updated by the 64-bit y.
static inline uint64_t random_hash_step(uint64_t hash, uint64_t y) {
    hash ^= y;
    hash += 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    return hash ^ (hash >> 31);
}
// The 64 bits by which a number counts in a seed hash: those of floor(x), infinities and nan kept.
uint64_t random_hash_number(double x);

// Item i of the raw five-round Squares generator (Widynski, "Squares: A Fast Counter-Based RNG"), B9.4.
uint64_t random_raw(uint64_t key, uint64_t i);
// Items of the three kinds of stream (B9.5).
double random_uniform(uint64_t key, uint64_t i);
double random_beta(uint64_t key, uint64_t i);
double random_normal(uint64_t key, uint64_t i);
// Normals first … first + count - 1, at a fraction of the price; `level` as in arrays.h.
void random_normals(CpuLevel level, uint64_t key, uint64_t first, size_t count, double *to);

#endif
