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
    const size_t count = columns->count;
    const Body a = body_at(columns, i);
    for (size_t k = 0; k < n; k++) {
        here[k] = position[k * count + i];
        sum[k] = force[k * count + i];
    }
    for (size_t j = first; j < end; j++) {
        double square = 0;
        for (size_t k = 0; k < n; k++) {
            unit[k] = position[k * count + j] - here[k];
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
                force[k * count + j] -= f;
            }
        }
    }
    for (size_t k = 0; k < n; k++)
        force[k * count + i] = sum[k];
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

// One pass: the pair forces that `level`, the group itself or one above it, declares. The partners of a particle are
// the later ones of its group, then the particles of the enclosing groups up to `level`.
static void pair_pass(const PhysSystem *system, const Group *group, uint32_t level) {
    const Group *groups = system->groups.bytes;
    const Columns *columns = &system->columns;
    ForceRange forces = phys_forces(system, level, STAGE_PAIR);
    PairRow *row = row_for(columns->dimensions);
    uint32_t number = (uint32_t)(group - groups);
    uint32_t nearest = number ? groups[group->parent].populated : NO_GROUP;
    size_t end = (size_t)group->first + group->count;
    for (size_t i = group->first; i < end; i++) {
        row(columns, forces, i, i + 1, end);
        // Numbers ascend from parent to child, so on the way up those below `level` are beyond it.
        for (uint32_t g = nearest; g != NO_GROUP && g >= level;) {
            row(columns, forces, i, groups[g].first, (size_t)groups[g].first + groups[g].count);
            g = g ? groups[groups[g].parent].populated : NO_GROUP;
        }
    }
}

void phys_apply_pairs(const PhysSystem *system, const Group *group) {
    const Group *groups = system->groups.bytes;
    for (uint32_t level = group->nearest[STAGE_PAIR]; level != NO_GROUP;
         level = phys_next_above(groups, level, STAGE_PAIR))
        pair_pass(system, group, level);
}
