// cases.h: the scripts that the bench measures.
#ifndef TESTS_BENCH_CASES_H
#define TESTS_BENCH_CASES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Unit of a row's nanoseconds: per unordered pair and step, per particle and step, or per particle and frame.
typedef enum Unit { PER_PAIR, PER_STEP, PER_PARTICLE } Unit;

// The limit kernel (limit.h) with the same inner loop.
typedef enum Limit { LIMIT_NONE, LIMIT_PAIRS_2D, LIMIT_PAIRS_3D, LIMIT_DISCS, LIMIT_SPHERES } Limit;

typedef struct Case {
    const char *name;
    const char *script; // file name in tests/bench/workloads
    const char *family; // the scaling exponent is computed from rows with the same family and steps
    uint32_t n;         // number of particles
    int steps;          // simulation steps per frame
    double fps;         // frames per second; a lower rate makes more steps per frame
    Unit unit;
    Limit limit;
    const char *peer; // LAMMPS input (tests/bench/peers) of the same system; NULL: none
    int side;         // discs or spheres along an edge
    int peer_steps;   // number of steps that LAMMPS does in about a second
} Case;

extern const Case cases[];
extern const size_t case_count;

// Returns the row with this name, or case_count.
size_t case_find(const char *name);
// Returns the previous row with the same family and steps per frame, or case_count.
size_t case_before(size_t index);

#endif
