// force_pair.c: forces between all pairs of particles (spec physics.md 4.1), in passes. The formulas are in
// pair_formulas.h.
#include "physics/division.h"
#include "physics/far_force.h"
#include "physics/integrate.h"
#include "physics/internal.h"
#include "physics/neighbour_list.h"

// A pass computes the pair forces that one group declares, for all pairs with a particle of that group or of one group
// inside it.
typedef struct Pass {
    PhysSystem *system;
    const Kernels *kernels; // NULL: the pass is computed row by row
    PairKernel *kernel;     // NULL: the pass is computed row by row
    PairPass pairs;         // argument of the kernel
    Move *move;             // motion that follows this pass; NULL: particles must not move
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
        columns->count >= MIN_FOR_LANES && pass.pairs.term_count > 0) {
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
    else
        pass->kernel(&pass->pairs, region->triangle, region->row, region->row_end, region->column, region->column_end);
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

// Returns the next group that encloses `group`, has particles and is `level` or inside it; NULL: there is none. Group
// numbers ascend from parent to child, so an enclosing group with a smaller number than `level` is outside of `level`.
static const Group *next_enclosing(const PhysSystem *system, const Group *group, uint32_t level) {
    const Group *groups = system->groups.bytes;
    if (group == groups)
        return NULL;
    uint32_t next = groups[group->parent].populated;
    return next != NO_GROUP && next >= level ? &groups[next] : NULL;
}

// Computes the forces of `pass` for all pairs of a particle of `group` with later particles of `group`, and with
// particles of the enclosing groups up to `level`.
static void compute_pass(const Pass *pass, const Group *group, uint32_t level) {
    PhysSystem *system = pass->system;
    if (system->column_order == ORDER_BY_CELL)
        phys_restore_order(system);
    system->unlisted = true;
    size_t first = group->first, end = first + group->count;
    if (!charge_pairs(pass, (uint64_t)group->count * group->count / 2))
        return;
    pass_triangle(pass, first, end);
    for (const Group *other = next_enclosing(system, group, level); other;
         other = next_enclosing(system, other, level)) {
        if (!charge_pairs(pass, (uint64_t)group->count * other->count))
            return;
        pass_rectangle(pass, first, end, other->first, (size_t)other->first + other->count);
    }
}

// Adds one force within a group, or between it and an enclosing group, for all pairs. Returns false if the step must be
// aborted.
static bool add_all_pairs(PhysSystem *system, const Group *group, const Group *other, Force *force) {
    if (system->column_order == ORDER_BY_CELL) {
        phys_restore_order(system);
        phys_far_forget(system); // trees refer to columns
        system->unlisted = true;
    }
    Pass pass = prepare_pass(system, (ForceRange){force, force + 1}, false);
    uint64_t pairs = (uint64_t)group->count * other->count;
    if (!charge_pairs(&pass, group == other ? pairs / 2 : pairs))
        return false;
    size_t end = (size_t)group->first + group->count;
    if (group == other)
        pass_triangle(&pass, group->first, end);
    else
        pass_rectangle(&pass, group->first, end, other->first, (size_t)other->first + other->count);
    return true;
}

// Adds one force with `theta` of a divided pass, between a group and itself or an enclosing group. All pairs are
// computed if the enclosing group has few particles, or if this is faster.
static bool add_far_force(PhysSystem *system, const Group *group, const Group *other, Force *force) {
    const Group *groups = system->groups.bytes;
    uint32_t own = (uint32_t)(group - groups), outer = (uint32_t)(other - groups);
    bool pays = other->count >= PHYS_FAR_MIN_PARTICLES;
    if (pays && !phys_far_pays(system, force, own, outer, &pays))
        return false;
    if (!pays)
        return add_all_pairs(system, group, other, force);
    return phys_far_forces(system, force, own, outer) && (own == outer || phys_far_forces(system, force, outer, own));
}

// Adds one force with `theta` of a divided pass.
static bool add_far_forces(PhysSystem *system, const Group *group, uint32_t level, Force *force) {
    for (const Group *other = group; other; other = next_enclosing(system, other, level))
        if (!add_far_force(system, group, other, force))
            return false;
    return true;
}

// Computes the pair forces that group `level` declares, on the particles of `group`. `level` is `group` itself or a
// group that encloses it. The partners of a particle are the later particles of `group`, then the particles of the
// enclosing groups up to `level`.
static void pair_pass(PhysSystem *system, const Group *group, uint32_t level, Move *move) {
    uint32_t number = (uint32_t)(group - (const Group *)system->groups.bytes);
    ForceRange forces = phys_forces(system, level, STAGE_PAIR);
    bool divided = phys_far_divides(system, group, forces);
    Pass pass = prepare_pass(system, forces, divided);
    pass.move = divided ? NULL : move;
    if (pass.pairs.term_count &&
        (!pass.kernels || !phys_neighbour_list_pass(system, pass.kernels, &pass.pairs, number, level, pass.move)))
        compute_pass(&pass, group, level);
    for (Force *force = forces.begin; force < forces.end && divided; force++)
        if (phys_is_far(system, force) && !add_far_forces(system, group, level, force))
            return;
}

void phys_apply_pairs(PhysSystem *system, const Group *group, Move *move) {
    const Group *groups = system->groups.bytes;
    for (uint32_t level = group->nearest[STAGE_PAIR]; level != NO_GROUP;
         level = phys_next_above(groups, level, STAGE_PAIR))
        pair_pass(system, group, level, move);
}
