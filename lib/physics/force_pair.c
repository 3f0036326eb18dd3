// force_pair.c: forces between all pairs of particles (4.1), by passes.
//
//   d_k = to_k − from_k;  l = sqrt(d_0² + d_1² + …);  inv = 1 / l;  u_k = d_k · inv;  f_k = u_k · K
//   collision      l < r₁+r₂: K = (r₁+r₂ − l)^power · strength                        from − f,  to + f
//   gravity        K = (strength · (m₁ · m₂)) / (D · D),  D = max(r₁+r₂, l)           from + f,  to − f
//   electrostatic  K = (strength · (q₁ · q₂)) / (D · D)                               from − f,  to + f
//   adhesion       l < r₁+r₂: K = strength · o · (l − a),  o = r₁+r₂ − l,             from + f,  to − f
//                  a = |r₁−r₂| · overlap + (r₁+r₂) · (1 − overlap)
//
// Every K is symmetric in the two particles, so action equals reaction to the last bit, and a kernel that computes one
// target at a time gives the same sums as this one, which resolves each pair once.
#include "physics/internal.h"
#include "physics/neighbours.h"
#include "physics/pair_wave.h"

#include <float.h>

#define ALWAYS_INLINE static inline __attribute__((always_inline))

typedef struct Body {
    double radius;
    double mass;
    double charge;
} Body;

ALWAYS_INLINE Body body_at(const Columns *columns, size_t i) {
    return (Body){columns->radius[i], columns->mass[i], columns->charge[i]};
}

ALWAYS_INLINE double inverse_square(double strength, double product, double reach, double length) {
    double distance = reach > length ? reach : length;
    return strength * product / (distance * distance);
}

// K with the sign that the earlier particle sees: positive attracts. False if the force does not apply to the pair.
ALWAYS_INLINE bool pair_coefficient(const Force *force, Body a, Body b, double length, double *coefficient) {
    const PhysForce *given = &force->given;
    if (given->max_distance > 0 && !(length < given->max_distance))
        return false;
    double reach = a.radius + b.radius;
    switch (given->kind) {
    case PHYS_COLLISION:
        if (a.radius == 0 || b.radius == 0 || !(length < reach))
            return false;
        *coefficient = -(phys_power(reach - length, given->power) * force->strength);
        return true;
    case PHYS_GRAVITY:
        if (a.mass == 0 || b.mass == 0)
            return false;
        *coefficient = inverse_square(force->strength, a.mass * b.mass, reach, length);
        return true;
    case PHYS_ELECTROSTATIC:
        if (a.charge == 0 || b.charge == 0)
            return false;
        *coefficient = -inverse_square(force->strength, a.charge * b.charge, reach, length);
        return true;
    default: { // PHYS_ADHESION
        if (a.radius == 0 || b.radius == 0 || !(length < reach))
            return false;
        double rest = fabs(a.radius - b.radius) * given->overlap + reach * (1 - given->overlap);
        *coefficient = force->strength * (reach - length) * (length - rest);
        return true;
    }
    }
}

// Pairs of particle i with the particles of one range, in ascending order. `here`, `sum` and `unit` have room for n
// doubles each; where n is a constant they end up in registers.
ALWAYS_INLINE void pair_row(const Columns *columns, ForceRange forces, size_t i, size_t first, size_t end, size_t n,
                            double *here, double *sum, double *unit) {
    const double *restrict position = columns->position;
    double *restrict force = columns->force;
    const size_t stride = columns->stride;
    const Body a = body_at(columns, i);
    for (size_t k = 0; k < n; k++) {
        here[k] = position[k * stride + i];
        sum[k] = force[k * stride + i];
    }
    for (size_t j = first; j < end; j++) {
        double square = 0;
        for (size_t k = 0; k < n; k++) {
            unit[k] = position[k * stride + j] - here[k];
            square += unit[k] * unit[k];
        }
        double length = sqrt(square);
        if (!(length > 0 && length <= DBL_MAX))
            continue;
        double inverse = 1 / length;
        for (size_t k = 0; k < n; k++)
            unit[k] *= inverse;
        const Body b = body_at(columns, j);
        for (const Force *applier = forces.begin; applier < forces.end; applier++) {
            double coefficient;
            if (!pair_coefficient(applier, a, b, length, &coefficient))
                continue;
            for (size_t k = 0; k < n; k++) {
                double f = unit[k] * coefficient;
                sum[k] += f;
                force[k * stride + j] -= f;
            }
        }
    }
    for (size_t k = 0; k < n; k++)
        force[k * stride + i] = sum[k];
}

// The row with everything unrolled for the usual numbers of dimensions.
static void pair_row_1(const Columns *columns, ForceRange forces, size_t i, size_t first, size_t end) {
    double here[1], sum[1], unit[1];
    pair_row(columns, forces, i, first, end, 1, here, sum, unit);
}

static void pair_row_2(const Columns *columns, ForceRange forces, size_t i, size_t first, size_t end) {
    double here[2], sum[2], unit[2];
    pair_row(columns, forces, i, first, end, 2, here, sum, unit);
}

static void pair_row_3(const Columns *columns, ForceRange forces, size_t i, size_t first, size_t end) {
    double here[3], sum[3], unit[3];
    pair_row(columns, forces, i, first, end, 3, here, sum, unit);
}

static void pair_row_n(const Columns *columns, ForceRange forces, size_t i, size_t first, size_t end) {
    size_t n = columns->dimensions;
    double *scratch = columns->scratch;
    pair_row(columns, forces, i, first, end, n, scratch, scratch + n, scratch + 2 * n);
}

typedef void PairRow(const Columns *columns, ForceRange forces, size_t i, size_t first, size_t end);

static PairRow *row_for(size_t dimensions) {
    switch (dimensions) {
    case 1:
        return pair_row_1;
    case 2:
        return pair_row_2;
    case 3:
        return pair_row_3;
    default:
        return pair_row_n;
    }
}

enum { PAIRS_FOR_THREADS = 30000 }; // fewer are done before another thread is awake

// One pass on its way through the groups.
typedef struct Pass {
    const Columns *columns;
    ForceRange forces;
    PairRow *row;
    const Kernels *kernels;   // NULL: not for this pass
    const PairKernel *kernel; // NULL: rows only
    size_t lanes;
    const PhysSystem *system;
    int threads;
    PairPass vector; // what the kernel is given
} Pass;

static PairTerm pair_term_of(const Force *force) {
    const PhysForce *given = &force->given;
    PairTerm term = {.strength = force->strength, .power = given->power, .overlap = given->overlap};
    term.bound = given->max_distance > 0 ? given->max_distance : INFINITY;
    switch (given->kind) {
    case PHYS_COLLISION:
        term.kind = TERM_COLLISION;
        term.strength = -force->strength;
        break;
    case PHYS_GRAVITY:
        term.kind = TERM_GRAVITY;
        break;
    case PHYS_ELECTROSTATIC:
        term.kind = TERM_ELECTROSTATIC;
        term.strength = -force->strength;
        break;
    default:
        term.kind = TERM_ADHESION;
        break;
    }
    return term;
}

static void choose_kernel(const PhysSystem *system, Pass *pass) {
    const Kernels *kernels = phys_kernels(system);
    const Columns *columns = pass->columns;
    size_t terms = (size_t)(pass->forces.end - pass->forces.begin);
    enum { FEW = 4 }; // particles that are not worth a vector
    if (columns->dimensions > PHYS_VECTOR_DIMENSIONS || terms > PHYS_MOST_TERMS || columns->count < FEW)
        return;
    pass->vector = (PairPass){
        .dimensions = columns->dimensions,
        .stride = columns->stride,
        .position = columns->position,
        .force = columns->force,
        .radius = columns->radius,
        .mass = columns->mass,
        .charge = columns->charge,
        .term_count = terms,
    };
    for (size_t t = 0; t < terms; t++)
        pass->vector.terms[t] = pair_term_of(&pass->forces.begin[t]);
    pass->kernels = kernels;
    pass->kernel = kernels->pair ? kernels->pair(&pass->vector) : NULL;
    pass->lanes = kernels->lanes;
    pass->system = system;
    pass->threads = system->options.threads;
}

// All pairs inside one range.
static void pass_triangle(const Pass *pass, size_t first, size_t end) {
    size_t count = end - first;
    if (pass->kernel && pass->threads > 1 && count * count / 2 >= PAIRS_FOR_THREADS) {
        PairWave wave = {pass->kernel, &pass->vector, true, first, end, first, end};
        phys_pair_wave(pass->system, &wave);
        return;
    }
    if (pass->kernel && count > 2) {
        pass->kernel->triangle(&pass->vector, first, end);
        return;
    }
    for (size_t i = first; i < end; i++)
        pass->row(pass->columns, pass->forces, i, i + 1, end);
}

// Vectors that a rectangle with so many rows and columns takes.
static size_t vectors(const Pass *pass, size_t rows, size_t columns) {
    return (rows + pass->lanes - 1) / pass->lanes * columns;
}

// All pairs of two ranges. As action equals reaction, it does not matter which of the two has the lanes.
static void pass_rectangle(const Pass *pass, size_t first, size_t end, size_t other, size_t other_end) {
    size_t rows = end - first, columns = other_end - other;
    if (!pass->kernel || rows + columns <= 4) {
        for (size_t i = first; i < end; i++)
            pass->row(pass->columns, pass->forces, i, other, other_end);
        return;
    }
    PairWave wave = {pass->kernel, &pass->vector, false, first, end, other, other_end};
    if (vectors(pass, rows, columns) > vectors(pass, columns, rows))
        wave = (PairWave){pass->kernel, &pass->vector, false, other, other_end, first, end};
    if (pass->threads > 1 && rows * columns >= PAIRS_FOR_THREADS)
        phys_pair_wave(pass->system, &wave);
    else
        pass->kernel->tiles(&pass->vector, wave.row, wave.row_end, wave.column, wave.column_end);
}

// The pair forces that `level`, the group itself or one above it, declares. The partners of a particle are the later
// ones of its group, then the particles of the enclosing groups up to `level`.
static void pair_pass(PhysSystem *system, const Group *group, uint32_t level) {
    const Group *groups = system->groups.bytes;
    uint32_t number = (uint32_t)(group - groups);
    Pass pass = {.columns = &system->columns, .forces = phys_forces(system, level, STAGE_PAIR)};
    pass.row = row_for(pass.columns->dimensions);
    choose_kernel(system, &pass);
    if (pass.kernels && phys_neighbour_pass(system, pass.kernels, &pass.vector, number, level))
        return;
    size_t first = group->first, end = first + group->count;
    pass_triangle(&pass, first, end);
    // Numbers ascend from parent to child, so on the way up those below `level` are beyond it.
    for (uint32_t g = number ? groups[group->parent].populated : NO_GROUP; g != NO_GROUP && g >= level;) {
        pass_rectangle(&pass, first, end, groups[g].first, (size_t)groups[g].first + groups[g].count);
        g = g ? groups[groups[g].parent].populated : NO_GROUP;
    }
}

void phys_apply_pairs(PhysSystem *system, const Group *group) {
    const Group *groups = system->groups.bytes;
    for (uint32_t level = group->nearest[STAGE_PAIR]; level != NO_GROUP;
         level = phys_next_above(groups, level, STAGE_PAIR))
        pair_pass(system, group, level);
}
