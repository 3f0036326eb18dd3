// kernels.h: parameters of the vector kernels and the table of kernels for each instruction set.
//
// The kernels are written once (kernel_*.c, with the operations of lanes.h) and compiled once per instruction set. They
// use the formulas of pair_formulas.h and single_formulas.h. Passes with too many dimensions or forces, or with very
// few particles, use the same formulas with one lane (pair_rows.c and kernel_integrate.c). All variants give
// bit-identical results, because:
//
//   - a lane computes one target, or one pair whose term is added to the sums of both particles in the right order;
//   - a term that does not apply does not change the sum. Adding +0.0 would change a sum of -0.0. So the old sum is
//     selected, or the neutral zero of the operation is used: x + -0.0 and x - +0.0 are x for all x;
//   - nothing is contracted, reassociated or approximated, except in fused_roots.h, whose results are proven.
#pragma once

#include "physics/system.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PHYS_VECTOR_DIMENSIONS = 3, // maximum number of dimensions of the kernels
    PHYS_MAX_LANES = 8,         // maximum number of lanes of all kernels
    PHYS_MAX_TERMS = 8,         // maximum number of pair forces in a pass of the kernels
    PHYS_QUAD = 4,              // values of ListView.width: doubles per particle
    PHYS_PAIR = 2,
};

// One force of a pass. The sign of `strength` is such that a positive K (pair_formulas.h) attracts. Some attributes are
// copied from `given`, so that kernels read them from one place.
typedef struct PairTerm {
    const PhysForce *given;
    PhysForceKind kind;
    double strength;
    double power;
    double bound; // the force applies only at smaller distances; infinite: no bound
    double overlap;
} PairTerm;

// The forces of one pass over pairs (phys_apply_pairs) and the columns that they use.
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
    const atomic_bool *stop; // set when the frame is aborted, so that the remaining rows are skipped; NULL: never
} PairPass;

static inline bool phys_pass_stopped(const PairPass *pass) {
    return pass->stop && atomic_load_explicit(pass->stop, memory_order_relaxed);
}

// Computes all pairs of a row and a column. The ranges of rows and columns must not overlap. With `triangle`, they must
// be equal, and each pair within the range is computed once.
typedef void PairKernel(const PairPass *pass, bool triangle, size_t row, size_t row_end, size_t column,
                        size_t column_end);

// Neighbour lists for the kernels. Particles are in sorted order (neighbour_list.h).
typedef struct ListView {
    uint32_t regular;                      // number of regular particles
    uint32_t listed;                       // number of regular and large particles
    bool direct;                           // columns are in sorted order, so a column is equal to its sorted index
    uint32_t *column;                      // by sorted index: column; readable for LANES elements beyond the last
    double *built[PHYS_VECTOR_DIMENSIONS]; // by component and sorted index: positions for which the lists were built
    double *radius;                        // by sorted index: radii for which the lists were built
    bool same_radii;                       // `radius` holds the current radii
    double one_radius; // common radius of all listed particles; 0: radii differ, or `sources` is set
    double *packed;    // by sorted index: current position and radius, `width` doubles; the last is a dummy particle
    uint32_t width;    // PHYS_QUAD; in two dimensions with `one_radius` set: PHYS_PAIR, without radii
    double *sources;   // by sorted index: mass and charge, two doubles; NULL: no force needs them
    double max_move_squared; // lists are valid while no squared distance from `built` exceeds this
    // By block of LANES particles: their lists, padded with dummies and interleaved, so that element k of each list is
    // at [k][lane]. An entry is the sorted index of a partner times `width`.
    uint32_t *entries;
    uint64_t *at;         // by block of LANES sorted indices: index of its first entry
    uint32_t *max_length; // by block: length of its longest list
} ListView;

struct Columns;    // internal.h
struct ListSearch; // grid.h
struct ListChunk;
struct IntegratePass; // integrate.h
typedef void IntegrateKernel(struct IntegratePass *pass, size_t first, size_t end);

typedef struct FarKernels FarKernels; // far_field.h

typedef struct Kernels {
    size_t lanes;
    // Returns the fastest kernel for the forces of a pass. `fused`: with fused_roots.h, if there is such a kernel.
    PairKernel *(*pair)(const PairPass *pass, bool fused);
    // Updates `packed` and `sources` for sorted indices first to end - 1. Returns false if a particle has moved too far
    // or has grown.
    bool (*list_refresh)(const PairPass *pass, const ListView *view, size_t first, size_t end);
    // Builds the lists of one chunk.
    void (*list_search)(const struct ListSearch *search, struct ListChunk *chunk);
    // Adds the forces on the regular particles of blocks first to end - 1.
    void (*list_forces)(const PairPass *pass, const ListView *view, size_t first, size_t end);
    // Adds the forces that the particles in columns first to end - 1 exert on those in columns targets[0] to
    // targets[count - 1]. `count` is at most LANES, and `targets` must be readable for LANES elements.
    void (*range_forces)(const PairPass *pass, const uint32_t *targets, size_t count, size_t first, size_t end);
    // Applies single-particle forces, barriers and motion to the particles in columns first to end - 1.
    IntegrateKernel *integrate;
    // Copies positions and velocities from columns first to end - 1 to `rows`, LANES particles at a time. order[i] is
    // the handle of the particle in column i. Stops early if a value of the next LANES particles is not finite or would
    // replace a zero of the other sign. Returns the first column that was not copied.
    size_t (*write_rows)(const struct Columns *columns, const uint32_t *order, double *rows, size_t first, size_t end);
    // Evaluate forces with `theta`.
    const FarKernels *far;
} Kernels;

// Functions of the files kernel_*.c, which are compiled once per instruction set.
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
extern const FarKernels far_kernels_two;
extern const FarKernels far_kernels_avx2;
extern const FarKernels far_kernels_avx512;
extern const Kernels phys_kernels_two;
extern const Kernels phys_kernels_avx2;
extern const Kernels phys_kernels_avx512;

// The one-lane variant of kernel_integrate.c, which supports any number of dimensions.
void integrate_all_one(struct IntegratePass *pass, size_t first, size_t end);
