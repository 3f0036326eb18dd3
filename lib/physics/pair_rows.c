// pair_rows.c: forces between one particle and a range of particles, and between the two particles of a link
// (`!distance`, spec physics.md 4.1). Computes one pair at a time, for any number of dimensions and forces.
#include "physics/pair_formulas.h"
#include "physics/pair_wavefront.h"

void phys_fill_terms(PairTerm *terms, ForceRange forces) {
    for (const Force *force = forces.begin; force < forces.end; force++)
        *terms++ = (PairTerm){
            .given = &force->given,
            .kind = force->given.kind,
            .strength = force->strength * phys_force_row(force->given.kind).sign,
            .power = force->given.power,
            .bound = force->given.max_distance > 0 ? force->given.max_distance : INFINITY,
            .overlap = force->given.overlap,
        };
}

PairPass phys_columns_pass(const Columns *columns) {
    return (PairPass){
        .dimensions = columns->dimensions,
        .stride = columns->stride,
        .position = columns->position,
        .force = columns->force,
        .radius = columns->radius,
        .mass = columns->mass,
        .charge = columns->charge,
    };
}

KERNEL double distance_between(const PairPass *pass, size_t n, size_t i, size_t j) {
    return phys_distance(pass->position + i, pass->position + j, n, pass->stride);
}

// Adds a force with coefficient K along the line between particles i and j.
KERNEL void add_pair(const PairPass *pass, size_t n, size_t i, size_t j, double inverse, double coefficient) {
    for (size_t k = 0; k < n; k++) {
        size_t first = k * pass->stride + i, second = k * pass->stride + j;
        double f = (pass->position[second] - pass->position[first]) * inverse * coefficient;
        pass->force[first] += f;
        pass->force[second] -= f;
    }
}

KERNEL PairEnd end_at(const PairPass *pass, size_t i) {
    return (PairEnd){.radius = pass->radius[i], .mass = pass->mass[i], .charge = pass->charge[i]};
}

// Computes the pairs of particle i with the particles of one range, in ascending order.
KERNEL void row_forces(const PairPass *pass, size_t n, size_t i, size_t first, size_t end) {
    const PairEnd target = end_at(pass, i);
    for (size_t j = first; j < end; j++) {
        const PairEnd partner = end_at(pass, j);
        const PairGeometry geometry = lone_geometry(distance_between(pass, n, i, j), &target, &partner);
        if (!geometry.valid)
            continue;
        Pairs pairs = lone_pair(&geometry, &target, &partner);
        double coefficient, inverse = 1 / geometry.length;
        for (size_t t = 0; t < pass->term_count; t++) {
            pairs.term = &pass->terms[t];
            if (pair_apply(&pairs, false, &coefficient))
                add_pair(pass, n, i, j, inverse, coefficient);
        }
    }
}

void phys_pair_row(const PairPass *pass, size_t i, size_t first, size_t end) {
#define ROW(n) row_forces(pass, n, i, first, end)
    if (pass->dimensions <= PHYS_VECTOR_DIMENSIONS)
        FOR_DIMENSIONS(pass->dimensions, ROW);
    else
        ROW(pass->dimensions);
}

static bool link_coefficient(const Force *force, double length, double *coefficient) {
    switch (force->given.kind) {
#define LINK(KIND, name)                                                                                               \
    case PHYS_##KIND:                                                                                                  \
        return link_##name(&force->given, force->strength, length, coefficient);
#define OTHER(KIND, ...) case PHYS_##KIND:
        PHYS_FORCES(PHYS_NO_ROW, LINK, PHYS_NO_ROW, PHYS_NO_ROW)
        PHYS_FORCES(OTHER, PHYS_NO_ROW, OTHER, OTHER)
#undef LINK
#undef OTHER
    case PHYS_FORCE_KINDS:
        break;
    }
    __builtin_unreachable(); // STAGE_LINK has only links
}

void phys_apply_links(const Columns *columns, ForceRange forces) {
    PairPass pass = phys_columns_pass(columns);
    for (const Force *force = forces.begin; force < forces.end; force++) {
        uint32_t from = force->given.from, to = force->given.to;
        if (from == to) // then there may be no particle, and no column
            continue;
        double coefficient, length = distance_between(&pass, pass.dimensions, from, to);
        if (length > 0 && length <= DBL_MAX && link_coefficient(force, length, &coefficient))
            add_pair(&pass, pass.dimensions, from, to, 1 / length, coefficient);
    }
}
