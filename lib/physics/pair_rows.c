// pair_rows.c: forces between one particle and a range of particles, one pair at a time, for any number of dimensions
// and forces.
#define LANES 1
#include "physics/pair_formulas.h"
#include "physics/pair_wavefront.h"

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
        double square = 0;
        for (size_t k = 0; k < n; k++) {
            double d = pass->position[k * pass->stride + j] - pass->position[k * pass->stride + i];
            square += d * d;
        }
        PairGeometry geometry = {.length = sqrt(square)};
        geometry.valid = geometry.length > 0 && geometry.length <= DBL_MAX;
        if (!geometry.valid)
            continue;
        const PairEnd partner = end_at(pass, j);
        geometry.reach = target.radius + partner.radius;
        Pairs pairs = {.geometry = &geometry, .target = &target, .partner = &partner};
        pairs.contact = both_nonzero(geometry.length < geometry.reach, target.radius, partner.radius);
        double coefficient, inverse = 1 / geometry.length;
        for (size_t t = 0; t < pass->term_count; t++) {
            pairs.term = &pass->terms[t];
            if (pair_apply(&pairs, false, &coefficient))
                add_pair(pass, n, i, j, inverse, coefficient);
        }
    }
}

void phys_pair_row(const PairPass *pass, size_t i, size_t first, size_t end) {
    switch (pass->dimensions) {
    case 1:
        row_forces(pass, 1, i, first, end);
        break;
    case 2:
        row_forces(pass, 2, i, first, end);
        break;
    case 3:
        row_forces(pass, 3, i, first, end);
        break;
    default:
        row_forces(pass, pass->dimensions, i, first, end);
    }
}
