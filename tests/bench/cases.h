// cases.h: the whole scripts that are measured, one row each.
#ifndef TESTS_BENCH_CASES_H
#define TESTS_BENCH_CASES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// What a row's nanoseconds are counted by: unordered pairs and steps, particles and steps, or particles and frames.
typedef enum Unit { PER_PAIR, PER_STEP, PER_PARTICLE } Unit;

// Which of our limit kernels (limit.h) does the same inner loop.
typedef enum Limit { LIMIT_NONE, LIMIT_PAIRS_2D, LIMIT_PAIRS_3D, LIMIT_DISCS, LIMIT_SPHERES } Limit;

typedef struct Case {
    const char *name;
    const char *script; // file name in tests/bench/workloads
    const char *family; // rows of one family and as many steps make a scaling exponent
    uint32_t n;
    int steps;  // of simulation per frame
    double fps; // frames per second: fewer of them make more steps per frame
    Unit unit;
    Limit limit;
    const char *peer; // LAMMPS input (tests/bench/peers) of the same system, or NULL
    int side;         // of the square or cube of discs or spheres
    int peer_steps;   // that LAMMPS takes in about a second
} Case;

extern const Case cases[];
extern const size_t case_count;

// The row with this name, or case_count.
size_t case_find(const char *name);
// The row before `index` of the same family and as many steps per frame, or case_count.
size_t case_before(size_t index);

#endif
