// kernels.h: what the vector kernels are given, and the table through which they are called.
//
// The kernels are written once (kernel_*.c over lanes.h) and compiled once per instruction set, into one table each;
// the formulas are those of pair_formulas.h and single_formulas.h. For more dimensions, for more forces and for a few
// particles the same formulas run with one lane (pair_rows.c, and kernel_integrate.c once more). All of them give the
// same bits. That rests on three rules:
//
//   - a lane is a target, or a pair whose term goes to two targets one after the other in the right order;
//   - a term that does not apply leaves its sum alone. Adding +0.0 would not (-0.0 + +0.0 is +0.0), so lanes are
//     blended, or get the neutral zero of the operation: x + -0.0 and x - +0.0 are x for all x;
//   - nothing is contracted, reassociated or approximated.
#ifndef PETRI_PHYSICS_KERNELS_H
#define PETRI_PHYSICS_KERNELS_H

#include "physics/system.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PHYS_VECTOR_DIMENSIONS = 3, // most dimensions that kernels exist for
    PHYS_MAX_TERMS = 8,         // most pair forces of a pass that they take
    PHYS_QUAD = 4,
    PHYS_PAIR = 2,
};

// One force of a pass, with the sign turned so that a positive coefficient attracts.
typedef struct PairTerm {
    PhysForceKind kind;
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
    const PairTerm *terms;
    const atomic_bool *stop; // true: rows are left out, for nobody wants the result any more; NULL: never
} PairPass;

static inline bool phys_pass_stopped(const PairPass *pass) {
    return pass->stop && atomic_load_explicit(pass->stop, memory_order_relaxed);
}

// All pairs inside one range, or between a range of rows and one of columns that do not overlap.
typedef void PairTriangle(const PairPass *pass, size_t first, size_t end);
typedef void PairTiles(const PairPass *pass, size_t row, size_t row_end, size_t column, size_t column_end);

typedef struct PairKernel {
    PairTriangle *triangle;
    PairTiles *tiles;
} PairKernel;

// Neighbour lists as the kernels see them (neighbour_list.c builds them). A place is the number of a particle in the
// order of the grid: first the regular ones, by cell, then a few that are much larger than the others.
typedef struct ListView {
    uint32_t regular;
    uint32_t listed;                       // regular and large ones
    bool direct;                           // columns are in the order of places
    uint32_t *column;                      // else by place; readable for LANES beyond the last
    double *built[PHYS_VECTOR_DIMENSIONS]; // positions for which the lists were made
    double *radius;                        // and radii
    bool same_radii;                       // which are those of now
    double one_radius; // of all places that are listed, if they have the same and no sources; else 0
    double *packed;    // position and radius now, `width` doubles for each place; the place after the last is a dummy
    uint32_t width;    // PHYS_QUAD, or PHYS_PAIR where two dimensions without the radius do
    double *sources;   // mass and charge, two doubles for each place, if a force needs them
    double max_move_squared; // the lists hold while no particle is farther than this, squared, from where it was built
    uint32_t *entries; // partners of LANES regular places side by side, then dummies: [k][lane], places times `width`
    uint64_t *at;      // by block of LANES places: where its entries begin
    uint32_t *max_length; // and the longest of its lists
} ListView;

struct Columns;    // internal.h
struct ListSearch; // grid.h
struct ListChunk;
struct IntegratePass; // integrate.h
typedef void IntegrateKernel(struct IntegratePass *pass, size_t first, size_t end);

typedef struct Kernels {
    size_t lanes;
    // Fastest kernels for the forces of a pass.
    const PairKernel *(*pair)(const PairPass *pass);
    // Brings the quads of places first … end - 1 up to date. False if one of them has moved too far or changed size.
    bool (*list_refresh)(const PairPass *pass, const ListView *view, size_t first, size_t end);
    // Makes the lists of one part.
    void (*list_search)(const struct ListSearch *search, struct ListChunk *chunk);
    // Forces on the regular places of some blocks.
    void (*list_forces)(const PairPass *pass, const ListView *view, size_t first, size_t end);
    // Forces on at most LANES particles from all of one range. `targets` holds LANES columns.
    void (*range_forces)(const PairPass *pass, const uint32_t *targets, size_t count, size_t first, size_t end);
    // Single-particle forces, barriers and motion of some particles.
    IntegrateKernel *integrate;
    // Copies positions and velocities of particles to the rows of their handles, LANES at a time, as long as all are
    // finite and no 0 meets another 0 in the row: returns the first that it did not take.
    size_t (*write_rows)(const struct Columns *columns, const uint32_t *order, double *rows, size_t first, size_t end);
} Kernels;

// kernel_list.c, kernel_search.c, kernel_integrate.c and kernel_pair.c, once for each instruction set.
#define ISA_KERNELS(isa)                                                                                               \
    bool list_refresh_##isa(const PairPass *pass, const ListView *view, size_t first, size_t end);                     \
    void list_search_##isa(const struct ListSearch *search, struct ListChunk *part);                                   \
    void list_forces_##isa(const PairPass *pass, const ListView *view, size_t first, size_t end);                      \
    void range_forces_##isa(const PairPass *pass, const uint32_t *targets, size_t count, size_t first, size_t end);    \
    size_t write_rows_##isa(const struct Columns *columns, const uint32_t *order, double *rows, size_t first,          \
                            size_t end);                                                                               \
    void integrate_all_##isa(struct IntegratePass *pass, size_t first, size_t end);
ISA_KERNELS(two)
ISA_KERNELS(avx2)
ISA_KERNELS(avx512)
extern const Kernels phys_kernels_two;
extern const Kernels phys_kernels_avx2;
extern const Kernels phys_kernels_avx512;

// kernel_integrate.c with one lane: any number of dimensions.
void integrate_all_one(struct IntegratePass *pass, size_t first, size_t end);

#endif
