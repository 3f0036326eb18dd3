// kernels.h: what the vector kernels are given, and the table through which they are called.
//
// The kernels are written once (kernel_*.c over simd.h) and compiled once per instruction set, into one table each.
// Where there is no table, for more dimensions, and for what is too small, the scalar code of the other files runs. It
// is the truth: every kernel gives its bits. That rests on three rules:
//
//   - a lane is a target, or a pair whose term goes to two targets one after the other in the right order;
//   - a term that does not apply leaves its sum alone. Adding +0.0 would not (-0.0 + +0.0 is +0.0), so lanes are
//     blended, or get the neutral zero of the operation: x + -0.0 and x - +0.0 are x for all x;
//   - nothing is contracted, reassociated or approximated.
#ifndef PETRI_PHYSICS_KERNELS_H
#define PETRI_PHYSICS_KERNELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PHYS_VECTOR_DIMENSIONS = 3, // most dimensions that kernels exist for
    PHYS_MOST_TERMS = 8,        // most forces of a pass that they take
};

typedef enum TermKind { TERM_GRAVITY, TERM_ELECTROSTATIC, TERM_COLLISION, TERM_ADHESION } TermKind;

// One force of a pass, with the sign turned so that a positive coefficient attracts.
typedef struct PairTerm {
    TermKind kind;
    double strength;
    double power;
    double bound; // the force applies only where l < bound; infinite: no bound
    double overlap;
} PairTerm;

// The forces of one pass over pairs and the columns they work on.
typedef struct PairPass {
    size_t dimensions;
    size_t stride;
    const double *position;
    double *force;
    const double *radius;
    const double *mass;
    const double *charge;
    size_t term_count;
    PairTerm terms[PHYS_MOST_TERMS];
} PairPass;

// All pairs inside one range, or between a range of rows and one of columns that do not overlap.
typedef void PairTriangle(const PairPass *pass, size_t first, size_t end);
typedef void PairTiles(const PairPass *pass, size_t row, size_t row_end, size_t column, size_t column_end);

typedef struct PairKernel {
    PairTriangle *triangle;
    PairTiles *tiles;
} PairKernel;

typedef struct Kernels {
    size_t lanes;
    // Fastest kernels for the forces of a pass.
    const PairKernel *(*pair)(const PairPass *pass);
} Kernels;

extern const Kernels phys_kernels_avx2;
extern const Kernels phys_kernels_avx512;

#endif
