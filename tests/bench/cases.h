// cases.h: the scripts that the benchmark measures.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Unit to which the nanoseconds in a row refer: one unordered pair and step, one particle and step, or one particle and
// frame.
typedef enum Unit { PER_PAIR, PER_STEP, PER_PARTICLE } Unit;

// The limit kernel (limit.h) with the same inner loop as the script.
typedef enum Limit { LIMIT_NONE, LIMIT_PAIRS_2D, LIMIT_PAIRS_3D, LIMIT_DISCS, LIMIT_SPHERES } Limit;

typedef struct Case {
    const char *name;
    const char *script; // file name in tests/bench/workloads
    const char *family; // rows with equal family and steps form a series, from which the scaling exponent is computed
    uint32_t n;         // number of particles
    int steps;          // simulation steps per frame
    double fps;         // frames per second; at a lower rate, a frame has more steps
    Unit unit;
    Limit limit;
    const char *peer; // LAMMPS input file (tests/bench/peers) for the same system; NULL: none
    int side;         // number of discs or spheres along an edge
    int peer_steps;   // number of steps that LAMMPS computes in about a second
} Case;

extern const Case cases[];
extern const size_t case_count;

// Returns the index of the row with this name, or case_count if there is none.
size_t case_find(const char *name);
// Returns the index of the previous row with the same family and steps per frame, or case_count if there is none.
size_t case_before(size_t index);
