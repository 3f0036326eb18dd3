// force_pair.c: forces between all pairs of particles (spec physics.md 4.1), in passes. The formulas are in
// pair_formulas.h.
#include "physics/division.h"
#include "physics/integrate.h"
#include "physics/internal.h"
#include "physics/neighbour_list.h"

// A pass computes the pair forces that one group declares, for all pairs with a particle of that group or of one group
// inside it.
typedef struct Pass {
    PhysSystem *system;
    const Kernels *kernels;   // NULL: the pass is computed row by row
    const PairKernel *kernel; // NULL: the pass is computed row by row
    PairPass pairs;           // argument of the kernel
    Move *move;               // motion that follows this pass; NULL: particles must not move
} Pass;

void phys_fill_terms(PairTerm *terms, ForceRange forces) {
    for (const Force *force = forces.begin; force < forces.end; force++)
        *terms++ = (PairTerm){
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

static Pass prepare_pass(PhysSystem *system, ForceRange forces) {
    enum { MIN_FOR_LANES = 4 }; // with fewer particles, vectors do not pay off
    const Columns *columns = &system->columns;
    Pass pass = {.system = system};
    phys_fill_terms(system->terms.bytes, forces);
    pass.pairs = phys_columns_pass(columns);
    pass.pairs.term_count = (size_t)(forces.end - forces.begin);
    pass.pairs.terms = system->terms.bytes;
    // With several processes, an abort must not skip rows, because other processes wait for them.
    pass.pairs.stop = system->options.division ? NULL : phys_stop(system);
    if (columns->dimensions <= PHYS_VECTOR_DIMENSIONS && pass.pairs.term_count <= PHYS_MAX_TERMS &&
        columns->count >= MIN_FOR_LANES) {
        pass.kernels = phys_kernels(system);
        pass.kernel = pass.kernels->pair(&pass.pairs);
    }
    return pass;
}

static void move_rows(const void *context, size_t first, size_t end) {
    phys_integrate_rows(context, first, end);
}

// Computes a region on several threads. If pass->move is set, also moves the particles of a triangle.
static void run_wavefront(const Pass *pass, const PairRegion *region, int threads) {
    Integrator integrator;
    Move *move = region->triangle ? pass->move : NULL;
    if (!move || !phys_integrate_begin(pass->system, 0, move->delta, move->speed_of_light, &integrator)) {
        phys_pair_wavefront(pass->system, region, threads, NULL);
        return;
    }
    phys_pair_wavefront(pass->system, region, threads, &(PairMotion){move_rows, &integrator});
    phys_integrate_end(&integrator);
    move->done = true;
}

// Computes a region with the kernel of the pass, divided among processes if this pays off.
static void compute_region(const Pass *pass, const PairRegion *region) {
    const PhysDivision *division = pass->system->options.division;
    if (division && division->compute_pairs(pass->system, region))
        return;
    int threads = phys_wavefront_threads(pass->system, phys_region_pairs(region));
    if (threads)
        run_wavefront(pass, region, threads);
    else if (region->triangle)
        pass->kernel->triangle(&pass->pairs, region->row, region->row_end);
    else
        pass->kernel->tiles(&pass->pairs, region->row, region->row_end, region->column, region->column_end);
}

// Computes all pairs within one range.
static void pass_triangle(const Pass *pass, size_t first, size_t end) {
    if (pass->kernel && end - first > 2) {
        compute_region(pass, &(PairRegion){pass->kernel, &pass->pairs, true, first, end, first, end});
        return;
    }
    for (size_t i = first; i < end && !phys_pass_stopped(&pass->pairs); i++)
        phys_pair_row(&pass->pairs, i, i + 1, end);
}

// Returns the number of vector operations of a rectangle with these numbers of rows and columns.
static size_t vector_count(const Pass *pass, size_t rows, size_t columns) {
    size_t lanes = pass->kernels->lanes;
    return (rows + lanes - 1) / lanes * columns;
}

// Computes all pairs between two ranges. Either range may be the rows, because the factor K of every force is symmetric
// (pair_formulas.h).
static void pass_rectangle(const Pass *pass, size_t first, size_t end, size_t other, size_t other_end) {
    size_t rows = end - first, columns = other_end - other;
    if (!pass->kernel || rows + columns <= 4) {
        for (size_t i = first; i < end && !phys_pass_stopped(&pass->pairs); i++)
            phys_pair_row(&pass->pairs, i, other, other_end);
        return;
    }
    PairRegion region = {pass->kernel, &pass->pairs, false, first, end, other, other_end};
    if (vector_count(pass, rows, columns) > vector_count(pass, columns, rows))
        region = (PairRegion){pass->kernel, &pass->pairs, false, other, other_end, first, end};
    compute_region(pass, &region);
}

// Charges the work for `pairs` pairs. Returns false if the step must be aborted. A pass with a single force has a
// special kernel, which needs 0.5 ns per pair.
static bool charge_pairs(const Pass *pass, uint64_t pairs) {
    enum { GROUP_WORK = 3, SINGLE_A_UNIT = 20, TERMS_A_UNIT = 8, ROWS_A_UNIT = 4 };
    size_t n = pass->pairs.dimensions, terms = pass->pairs.term_count;
    uint64_t units = !pass->kernel ? pairs * n * terms / ROWS_A_UNIT
                     : terms > 1   ? pairs * terms / TERMS_A_UNIT
                                   : pairs / SINGLE_A_UNIT;
    return phys_charge(pass->system, GROUP_WORK + units);
}

// Computes the pair forces that group `level` declares, on the particles of `group`. `level` is `group` itself or a
// group that encloses it. The partners of a particle are the later particles of `group`, then the particles of the
// enclosing groups up to `level`.
static void pair_pass(PhysSystem *system, const Group *group, uint32_t level, Move *move) {
    const Group *groups = system->groups.bytes;
    uint32_t number = (uint32_t)(group - groups);
    Pass pass = prepare_pass(system, phys_forces(system, level, STAGE_PAIR));
    pass.move = move;
    if (pass.kernels && phys_neighbour_list_pass(system, pass.kernels, &pass.pairs, number, level, move))
        return;
    if (system->column_order == ORDER_BY_CELL)
        phys_restore_order(system);
    system->unlisted = true;
    size_t first = group->first, end = first + group->count;
    if (!charge_pairs(&pass, (uint64_t)group->count * group->count / 2))
        return;
    pass_triangle(&pass, first, end);
    // Group numbers ascend from parent to child, so an enclosing group with a smaller number than `level` is outside of
    // `level`.
    for (uint32_t g = number ? groups[group->parent].populated : NO_GROUP; g != NO_GROUP && g >= level;) {
        if (!charge_pairs(&pass, (uint64_t)group->count * groups[g].count))
            return;
        pass_rectangle(&pass, first, end, groups[g].first, (size_t)groups[g].first + groups[g].count);
        g = g ? groups[groups[g].parent].populated : NO_GROUP;
    }
}

void phys_apply_pairs(PhysSystem *system, const Group *group, Move *move) {
    const Group *groups = system->groups.bytes;
    for (uint32_t level = group->nearest[STAGE_PAIR]; level != NO_GROUP;
         level = phys_next_above(groups, level, STAGE_PAIR))
        pair_pass(system, group, level, move);
}
