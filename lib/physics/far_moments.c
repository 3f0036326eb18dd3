// far_moments.c: centres, sizes and multipole moments of the cells of a forest (far_field.h).
#include "physics/far_field.h"

#include <string.h>

// FarMoments.quadrupole holds the second moments Σ q y_k y_l until all cells have been processed.
static const size_t pair_first[FAR_QUADRUPOLE] = {0, 0, 0, 1, 1, 2}, pair_second[FAR_QUADRUPOLE] = {0, 1, 2, 1, 2, 2};

// A sum of weighted positions.
typedef struct Centre {
    double weight;
    double sum[FAR_DIMENSIONS];
} Centre;

static void add_to_centre(Centre *centre, size_t n, double weight, const double *position) {
    centre->weight += weight;
    for (size_t k = 0; k < n; k++)
        centre->sum[k] += weight * position[k];
}

static double larger(double a, double b) {
    return b > a || isnan(b) ? b : a;
}

static void member_position(const FarForest *forest, uint32_t member, double *position) {
    for (size_t k = 0; k < forest->dimensions; k++)
        position[k] = forest->scaled[k][member];
}

static bool is_point(const FarForest *forest, const FarCell *cell) {
    for (size_t k = 0; k < forest->dimensions; k++)
        for (uint32_t i = cell->first + 1; i < cell->end; i++)
            if (forest->position[k][i] != forest->position[k][cell->first])
                return false;
    return true;
}

// Adds the moments of a source with monopole `q` and dipole `dipole` at `y`, relative to the centre.
static void add_moments(const FarForest *forest, FarMoments *moments, double q, const double *dipole, const double *y) {
    size_t n = forest->dimensions;
    moments->monopole += q;
    if (forest->charges)
        for (size_t k = 0; k < n; k++)
            moments->dipole[k] += dipole[k] + q * y[k];
    for (size_t m = 0; m < FAR_QUADRUPOLE; m++) {
        size_t k = pair_first[m], l = pair_second[m];
        if (l >= n)
            continue;
        double second = q * y[k] * y[l];
        if (forest->charges)
            second = second + dipole[k] * y[l] + y[k] * dipole[l];
        moments->quadrupole[m] += second;
    }
}

static void leaf_moments(const FarForest *forest, FarCell *cell, FarMoments *moments) {
    static const double none[FAR_DIMENSIONS];
    double at[FAR_DIMENSIONS], y[FAR_DIMENSIONS];
    size_t n = forest->dimensions;
    Centre centre = {.weight = 0};
    cell->point = is_point(forest, cell);
    member_position(forest, cell->first, cell->centre);
    for (uint32_t i = cell->first; i < cell->end; i++) {
        member_position(forest, i, at);
        add_to_centre(&centre, n, fabs(forest->source[i]), at);
        cell->radius = larger(cell->radius, forest->radius[i] * 0.5 * forest->half_scale);
        if (cell->point)
            moments->monopole += forest->source[i];
    }
    cell->weight = centre.weight;
    if (cell->point)
        return;
    for (size_t k = 0; k < n; k++)
        cell->centre[k] = centre.sum[k] / centre.weight;
    for (uint32_t i = cell->first; i < cell->end; i++) {
        member_position(forest, i, at);
        cell->size = larger(cell->size, phys_distance(at, cell->centre, n, 1));
        for (size_t k = 0; k < n; k++)
            y[k] = at[k] - cell->centre[k];
        add_moments(forest, moments, forest->source[i], none, y);
    }
}

// Computes a cell from its children.
static void inner_moments(const FarForest *forest, uint32_t number, FarMoments *all) {
    FarCell *cells = forest->cells.bytes, *cell = &cells[number];
    FarMoments *moments = &all[number];
    size_t n = forest->dimensions;
    Centre centre = {.weight = 0};
    for (uint32_t child = number + 1; child < cell->skip; child = cells[child].skip) {
        add_to_centre(&centre, n, cells[child].weight, cells[child].centre);
        cell->radius = larger(cell->radius, cells[child].radius);
    }
    cell->weight = centre.weight;
    for (size_t k = 0; k < n; k++)
        cell->centre[k] = centre.sum[k] / centre.weight;
    for (uint32_t child = number + 1; child < cell->skip; child = cells[child].skip) {
        double y[FAR_DIMENSIONS];
        for (size_t k = 0; k < n; k++)
            y[k] = cells[child].centre[k] - cell->centre[k];
        cell->size = larger(cell->size, phys_distance(cells[child].centre, cell->centre, n, 1) + cells[child].size);
        add_moments(forest, moments, all[child].monopole, all[child].dipole, y);
        for (size_t m = 0; m < FAR_QUADRUPOLE; m++)
            moments->quadrupole[m] += all[child].quadrupole[m];
    }
}

// Q = 3 S - δ tr S, where S are the second moments.
static void remove_trace(FarMoments *moments) {
    double *q = moments->quadrupole, trace = q[0] + q[3] + q[5];
    for (size_t m = 0; m < FAR_QUADRUPOLE; m++)
        q[m] = pair_first[m] == pair_second[m] ? 3 * q[m] - trace : 3 * q[m];
}

void phys_far_moments(FarForest *forest) {
    FarCell *cells = forest->cells.bytes;
    FarMoments *moments = forest->moments.bytes;
    if (forest->cell_count)
        memset(moments, 0, forest->cell_count * sizeof *moments);
    for (uint32_t cell = forest->cell_count; cell-- > 0;)
        if (cells[cell].skip == cell + 1)
            leaf_moments(forest, &cells[cell], &moments[cell]);
        else
            inner_moments(forest, cell, moments);
    for (uint32_t cell = 0; cell < forest->cell_count; cell++)
        remove_trace(&moments[cell]);
}
