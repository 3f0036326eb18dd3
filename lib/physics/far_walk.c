// far_walk.c: see far_walk.h.
#include "physics/far_walk.h"

#include <string.h>

// Margin of comparisons with max_distance, so that rounding cannot move a pair to the wrong side.
#define BOUND_MARGIN 0x1p-40
// Minimum square of the distance of an accepted cell, so that its powers neither overflow nor underflow (spec
// far-field.md, 5).
#define MIN_SQUARE 0x1p-80

// What a walk does with a cell.
typedef enum Decision { CELL_OPEN, CELL_ACCEPT, CELL_SKIP } Decision;

// The bounding box of the targets of a walk, scaled.
typedef struct Box {
    size_t dimensions;
    double low[FAR_DIMENSIONS], high[FAR_DIMENSIONS];
    double radius; // largest radius of a target
} Box;

static Box target_box(const FarForest *forest, FarTargets targets) {
    Box box = {.dimensions = forest->dimensions};
    for (size_t k = 0; k < box.dimensions; k++) {
        const double *scaled = forest->scaled[k];
        box.low[k] = box.high[k] = scaled[targets.first];
        for (uint32_t i = targets.first + 1; i < targets.end; i++) {
            box.low[k] = scaled[i] < box.low[k] ? scaled[i] : box.low[k];
            box.high[k] = scaled[i] > box.high[k] ? scaled[i] : box.high[k];
        }
    }
    for (uint32_t i = targets.first; i < targets.end; i++) {
        double radius = forest->radius[i] * 0.5 * forest->half_scale;
        box.radius = radius > box.radius ? radius : box.radius;
    }
    return box;
}

// --- targets

static void collect_targets(const FarPass *pass, FarTargets targets, FarScratch *scratch) {
    const FarForest *forest = pass->forest;
    scratch->target_count = 0;
    for (uint32_t i = targets.first; i < targets.end; i++) {
        if (pass->system->columns.anchor[forest->column[i]])
            continue;
        FarTarget *target = &scratch->targets[scratch->target_count++];
        for (size_t k = 0; k < forest->dimensions; k++) {
            target->position[k] = forest->position[k][i];
            target->scaled[k] = forest->scaled[k][i];
        }
        target->source = forest->source[i];
        target->radius = forest->radius[i];
        target->column = forest->column[i];
        memset(target->pair_sums, 0, sizeof target->pair_sums);
        memset(target->cell_sums, 0, sizeof target->cell_sums);
    }
}

static double add_partial_sums(const double *sums) {
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

// Computes the forces on the targets from their partial sums.
static void finish_targets(const FarPass *pass, const FarScratch *scratch, double *forces) {
    const FarForest *forest = pass->forest;
    const Columns *columns = &pass->system->columns;
    size_t n = forest->dimensions;
    for (size_t t = 0; t < scratch->target_count; t++) {
        const FarTarget *target = &scratch->targets[t];
        for (size_t k = 0; k < n; k++) {
            double force = add_partial_sums(target->pair_sums[k]);
            if (scratch->any_cell) {
                double field = add_partial_sums(target->cell_sums[k]) * forest->scale * forest->scale;
                force += pass->term.strength * (target->source * field);
            }
            if (forces)
                forces[t * n + k] = force;
            else
                columns->force[k * columns->stride + target->column] += force;
        }
    }
}

// --- blocks

static size_t padded_count(size_t count) {
    return (count + FAR_SUMS - 1) / FAR_SUMS * FAR_SUMS;
}

static void flush_pairs(const FarPass *pass, FarScratch *scratch) {
    FarPairs *pairs = &scratch->pairs;
    size_t n = pass->forest->dimensions, padded = padded_count(pairs->count);
    scratch->evaluations += FAR_PAIR * pairs->count * scratch->target_count;
    for (; pairs->count < padded; pairs->count++) {
        for (size_t k = 0; k < n; k++)
            pairs->position[k][pairs->count] = NAN;
        pairs->source[pairs->count] = pairs->radius[pairs->count] = 0;
    }
    pass->system->kernels->far->pairs[pass->term.kind][n](pairs, &pass->term, scratch->targets, scratch->target_count);
    pairs->count = 0;
}

static void flush_cells(const FarPass *pass, FarScratch *scratch) {
    FarCells *cells = &scratch->cells;
    size_t n = pass->forest->dimensions, padded = padded_count(cells->count);
    scratch->evaluations += cells->count * scratch->target_count;
    for (; cells->count < padded; cells->count++) {
        size_t at = cells->count;
        cells->monopole[at] = 0;
        for (size_t k = 0; k < n; k++) {
            cells->centre[k][at] = 2; // outside of the cube, whose side is 1
            cells->dipole[k][at] = 0;
        }
        for (size_t m = 0; m < FAR_QUADRUPOLE; m++)
            cells->quadrupole[m][at] = 0;
    }
    pass->system->kernels->far->cells[n][pass->forest->charges](cells, scratch->targets, scratch->target_count);
    cells->count = 0;
}

static bool is_stopped(const FarPass *pass) {
    return pass->stop && atomic_load_explicit(pass->stop, memory_order_relaxed);
}

static void list_members(const FarPass *pass, const FarCell *cell, FarScratch *scratch) {
    const FarForest *forest = pass->forest;
    FarPairs *pairs = &scratch->pairs;
    for (uint32_t first = cell->first; first < cell->end && !is_stopped(pass);) {
        size_t left = cell->end - first, space = FAR_PAIRS - pairs->count, count = left < space ? left : space;
        for (size_t k = 0; k < forest->dimensions; k++)
            memcpy(pairs->position[k] + pairs->count, forest->position[k] + first, count * sizeof(double));
        memcpy(pairs->source + pairs->count, forest->source + first, count * sizeof(double));
        memcpy(pairs->radius + pairs->count, forest->radius + first, count * sizeof(double));
        pairs->count += count;
        first += (uint32_t)count;
        if (pairs->count == FAR_PAIRS)
            flush_pairs(pass, scratch);
    }
}

static void list_cell(const FarPass *pass, uint32_t number, FarScratch *scratch) {
    const FarCell *cell = (const FarCell *)pass->forest->cells.bytes + number;
    const FarMoments *moments = (const FarMoments *)pass->forest->moments.bytes + number;
    FarCells *cells = &scratch->cells;
    size_t at = cells->count++, n = pass->forest->dimensions;
    for (size_t k = 0; k < n; k++)
        cells->centre[k][at] = cell->centre[k];
    cells->monopole[at] = moments->monopole;
    for (size_t k = 0; k < n && pass->forest->charges; k++)
        cells->dipole[k][at] = moments->dipole[k];
    for (size_t m = 0; m < FAR_QUADRUPOLE; m++)
        cells->quadrupole[m][at] = moments->quadrupole[m];
    scratch->any_cell = true;
    if (cells->count == FAR_CELLS)
        flush_cells(pass, scratch);
}

// --- decisions

// Returns the square of the distance from a point to the nearest point of the box.
static inline double nearest_square(const Box *box, const double *point) {
    double square = 0;
    for (size_t k = 0; k < box->dimensions; k++) {
        double below = box->low[k] - point[k], above = point[k] - box->high[k];
        double beyond = below > above ? below : above;
        beyond = beyond > 0 ? beyond : 0;
        square += beyond * beyond;
    }
    return square;
}

static double farthest_square(const Box *box, const double *point) {
    double square = 0;
    for (size_t k = 0; k < box->dimensions; k++) {
        double below = point[k] - box->low[k], above = box->high[k] - point[k];
        double farther = below > above ? below : above;
        square += farther * farther;
    }
    return square;
}

// Decides by max_distance if all pairs are beyond it, or if some may be.
static Decision check_bound(const FarPass *pass, const Box *box, const FarCell *cell, double square) {
    double beyond = pass->bound * (1 + BOUND_MARGIN) + cell->size,
           within = pass->bound * (1 - BOUND_MARGIN) - cell->size;
    if (square > beyond * beyond)
        return CELL_SKIP;
    return within > 0 && farthest_square(box, cell->centre) < within * within ? CELL_ACCEPT : CELL_OPEN;
}

static inline Decision decide(const FarPass *pass, const Box *box, const FarCell *cell) {
    double square = nearest_square(box, cell->centre), reach = cell->size + (cell->radius + box->radius);
    bool far =
        square >= MIN_SQUARE && cell->size * cell->size < pass->opening_squared * square && reach * reach < square;
    if (pass->bound < INFINITY) {
        Decision decision = check_bound(pass, box, cell, square);
        if (decision != CELL_ACCEPT)
            return decision;
    }
    return far ? CELL_ACCEPT : CELL_OPEN;
}

// A leaf of coincident members exerts no force on these members, so it is left out for them.
static bool is_own_point(const FarPass *pass, const FarCell *cell, FarTargets targets) {
    return cell->point && pass->sources == pass->targets && targets.first >= cell->first && targets.end <= cell->end;
}

FarCount phys_far_count(const FarPass *pass, FarTargets targets) {
    const FarCell *cells = pass->forest->cells.bytes;
    Box box = target_box(pass->forest, targets);
    FarCount count = {0, 0};
    for (uint32_t cell = pass->sources->root; cell < pass->sources->end; count.visits++) {
        Decision decision = decide(pass, &box, &cells[cell]);
        bool leaf = cells[cell].skip == cell + 1;
        if (decision == CELL_OPEN && leaf && !is_own_point(pass, &cells[cell], targets))
            count.pairs += cells[cell].end - cells[cell].first;
        cell = decision == CELL_OPEN ? cell + 1 : cells[cell].skip;
    }
    return count;
}

void phys_far_walk(const FarPass *pass, FarTargets targets, FarScratch *scratch, double *forces) {
    const FarCell *cells = pass->forest->cells.bytes;
    collect_targets(pass, targets, scratch);
    if (!scratch->target_count)
        return;
    Box box = target_box(pass->forest, targets);
    uint64_t visits = 0;
    scratch->pairs.count = scratch->cells.count = 0;
    scratch->any_cell = false;
    for (uint32_t cell = pass->sources->root; cell < pass->sources->end; visits++) {
        Decision decision = decide(pass, &box, &cells[cell]);
        bool leaf = cells[cell].skip == cell + 1;
        if (decision == CELL_ACCEPT)
            list_cell(pass, cell, scratch);
        else if (decision == CELL_OPEN && leaf && !is_own_point(pass, &cells[cell], targets))
            list_members(pass, &cells[cell], scratch);
        cell = decision == CELL_OPEN ? cell + 1 : cells[cell].skip;
    }
    if (scratch->pairs.count)
        flush_pairs(pass, scratch);
    if (scratch->cells.count)
        flush_cells(pass, scratch);
    scratch->evaluations += visits * FAR_VISIT;
    finish_targets(pass, scratch, forces);
}
