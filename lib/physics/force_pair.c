// force_pair.c: forces between all pairs of particles (spec physics.md 4.1), in passes. The formulas are in
// pair_formulas.h.
#include "base/clock.h"
#include "physics/division.h"
#include "physics/far_force.h"
#include "physics/integrate.h"
#include "physics/internal.h"
#include "physics/neighbour_list.h"

// A pass computes the pair forces that one group declares, for all pairs with a particle of that group or of one group
// inside it.
typedef struct Pass {
    PhysSystem *system;
    PairKernel *kernel; // NULL: the pass is computed row by row
    PairPass pairs;     // argument of the kernel
    Move *move;         // motion that follows this pass; NULL: particles must not move
} Pass;

// Fills terms with the forces that the main part of a pass computes. Returns their number.
static size_t fill_pass_terms(PhysSystem *system, ForceRange forces, bool divided) {
    PairTerm *terms = system->terms.bytes;
    size_t count = 0;
    for (Force *force = forces.begin; force < forces.end; force++)
        if (!divided || !phys_is_far(system, force))
            phys_fill_terms(&terms[count++], (ForceRange){force, force + 1});
    return count;
}

// `divided`: leaves out the forces with `theta`.
static Pass prepare_pass(PhysSystem *system, ForceRange forces, bool divided) {
    enum { MIN_FOR_LANES = 4 }; // with fewer particles, vectors do not pay off
    const Columns *columns = &system->columns;
    Pass pass = {.system = system};
    pass.pairs = phys_columns_pass(columns);
    pass.pairs.term_count = fill_pass_terms(system, forces, divided);
    pass.pairs.terms = system->terms.bytes;
    // With several processes, an abort must not skip rows, because other processes wait for them.
    pass.pairs.stop = system->options.division ? NULL : phys_stop(system);
    if (columns->dimensions <= PHYS_VECTOR_DIMENSIONS && pass.pairs.term_count <= PHYS_MAX_TERMS &&
        columns->count >= MIN_FOR_LANES && pass.pairs.term_count > 0)
        pass.kernel = system->kernels->pair(&pass.pairs, phys_fused_chosen(&system->fused));
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

// Computes a region with the kernel of the pass, divided among processes or threads if this pays off.
static void run_region(const Pass *pass, const PairRegion *region) {
    const PhysDivision *division = pass->system->options.division;
    if (division && division->compute_pairs(pass->system, region))
        return;
    int threads = phys_wavefront_threads(pass->system, phys_region_pairs(region));
    if (threads)
        run_wavefront(pass, region, threads);
    else
        pass->kernel(&pass->pairs, region->triangle, region->row, region->row_end, region->column, region->column_end);
}

static void compute_region(const Pass *pass, const PairRegion *region) {
    FusedChoice *choice = &pass->system->fused;
    uint64_t begin = phys_fused_measures(choice) ? clock_nanoseconds() : 0;
    run_region(pass, region);
    if (begin)
        phys_fused_learn(choice, phys_region_pairs(region), clock_nanoseconds() - begin);
}

// Returns the number of vector operations of a rectangle with these numbers of rows and columns.
static size_t vector_count(const Pass *pass, size_t rows, size_t columns) {
    size_t lanes = pass->system->kernels->lanes;
    return (rows + lanes - 1) / lanes * columns;
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

// Computes all pairs of a particle of `group` with a particle of `other`, which encloses it or is the same. Either may
// be the rows, because the factor K of every force is symmetric (pair_formulas.h). Returns false if the step must be
// aborted.
static bool compute_groups(const Pass *pass, const Group *group, const Group *other) {
    bool same = group == other;
    if (!charge_pairs(pass, (uint64_t)group->count * other->count / (same ? 2 : 1)))
        return false;
    PairRegion region = {pass->kernel, &pass->pairs, same, .row = group->first, .column = other->first};
    region.row_end = region.row + group->count;
    region.column_end = region.column + other->count;
    bool few = same ? group->count <= 2 : group->count + other->count <= 4;
    if (!pass->kernel || few) {
        for (size_t i = region.row; i < region.row_end && !phys_pass_stopped(&pass->pairs); i++)
            phys_pair_row(&pass->pairs, i, same ? i + 1 : region.column, region.column_end);
        return true;
    }
    if (vector_count(pass, group->count, other->count) > vector_count(pass, other->count, group->count))
        region = (PairRegion){pass->kernel,      &pass->pairs, same,          region.column,
                              region.column_end, region.row,   region.row_end};
    compute_region(pass, &region);
    return true;
}

// Prepares the columns for passes over all pairs, which sum in the order of handles.
static void restore_order(PhysSystem *system) {
    if (system->column_order == ORDER_BY_CELL) {
        phys_restore_order(system);
        phys_far_forget(system); // trees refer to columns
    }
    system->unlisted = true;
}

// Adds one force with `theta` of a divided pass, between a group and itself or an enclosing group. Returns false if the
// step must be aborted.
static bool add_far_force(PhysSystem *system, uint32_t group, uint32_t other, Force *force) {
    const Group *groups = system->groups.bytes;
    bool pays;
    if (!phys_far_pays(system, force, group, other, &pays))
        return false;
    if (pays)
        return phys_far_forces(system, force, group, other) &&
               (group == other || phys_far_forces(system, force, other, group));
    restore_order(system);
    Pass pass = prepare_pass(system, (ForceRange){force, force + 1}, false);
    return compute_groups(&pass, &groups[group], &groups[other]);
}

// Computes a pass (phys_next_enclosing): first the forces without `theta` together, then the others one by one.
static void pair_pass(PhysSystem *system, uint32_t group, uint32_t level, Move *move) {
    const Group *groups = system->groups.bytes;
    ForceRange forces = phys_forces(system, level, STAGE_PAIR);
    bool divided = phys_far_divides(system, &groups[group], forces), more = true;
    Pass pass = prepare_pass(system, forces, divided);
    pass.move = divided ? NULL : move;
    if (pass.pairs.term_count &&
        (!pass.kernel || !phys_neighbour_list_pass(system, &pass.pairs, group, level, pass.move))) {
        restore_order(system);
        for (uint32_t g = group; g != NO_GROUP && more; g = phys_next_enclosing(groups, g, level))
            more = compute_groups(&pass, &groups[group], &groups[g]);
    }
    for (Force *force = forces.begin; force < forces.end && divided; force++)
        for (uint32_t g = group; g != NO_GROUP && phys_is_far(system, force); g = phys_next_enclosing(groups, g, level))
            if (!add_far_force(system, group, g, force))
                return;
}

void phys_apply_pairs(PhysSystem *system, uint32_t group, Move *move) {
    const Group *groups = system->groups.bytes;
    for (uint32_t level = groups[group].nearest[STAGE_PAIR]; level != NO_GROUP;
         level = phys_next_above(groups, level, STAGE_PAIR))
        pair_pass(system, group, level, move);
}
