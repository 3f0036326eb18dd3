// random.h: counter-based random numbers and trigonometry in turns (spec builtins.md B1.2 and B9).
//
// A stream is a 64-bit key. Its items can be computed independently, in any order and on any thread.
#pragma once

#include "base/cpu.h"

#include <stddef.h>
#include <stdint.h>

// Return the sine and cosine of t full turns. They are exact at quarter turns, apart from the sign of zero (B1.2).
double turns_sin(double t);
double turns_cos(double t);

#define RANDOM_HASH_START UINT64_C(0xe220a8397b1dcdaf)
// Returns the seed hash (B9.2) `hash`, extended by the 64-bit number y.
static inline uint64_t random_hash_step(uint64_t hash, uint64_t y) {
    hash ^= y;
    hash += 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    return hash ^ (hash >> 31);
}
// Returns the bits that represent a number in a seed hash: those of floor(x), of x itself if it is infinite, or of
// the name `nan` if it is NaN.
uint64_t random_hash_number(double x);

// Returns item i of the five-round Squares generator (Widynski, "Squares: A Fast Counter-Based RNG"; spec B9.4).
uint64_t random_raw(uint64_t key, uint64_t i);
// Each returns item i of a stream with the distribution that its name states (B9.5).
double random_uniform(uint64_t key, uint64_t i);
double random_beta(uint64_t key, uint64_t i);
double random_normal(uint64_t key, uint64_t i);
// Computes random_normal for items first to first + count - 1, much faster than separate calls. `level` is
// described in arrays.h.
void random_normals(CpuLevel level, uint64_t key, uint64_t first, size_t count, double *to);
