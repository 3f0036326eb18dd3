// far_force.c: passes of pair forces with `theta` (spec far-field.md).
#include "physics/far_force.h"

#include "base/spec.h"
#include "physics/division.h"
#include "physics/far_walk.h"
#include "physics/threads.h"

enum { EVALUATIONS_A_UNIT = 16 };

bool phys_is_far(const PhysSystem *system, const Force *force) {
    return phys_force_row(force->given.kind).reach == REACH_INVERSE_SQUARE && force->given.theta > 0 &&
           (system->dimensions == 2 || system->dimensions == 3);
}

bool phys_far_divides(const PhysSystem *system, const Group *group, ForceRange forces) {
    bool divides = false;
    for (const Force *force = forces.begin; force < forces.end && group->count >= PHYS_FAR_MIN_PARTICLES; force++)
        divides |= phys_is_far(system, force);
    return divides;
}

double phys_far_min_useful(double theta) {
    // Measured in a uniform cube with AVX-512 on one thread: 2000 particles for theta 0.5, 4000 for 0.3.
    return fmax(PHYS_FAR_MIN_PARTICLES, 450 / (theta * theta));
}

void phys_far_forget(PhysSystem *system) {
    for (int f = 0; f < PHYS_FORESTS; f++)
        ((FarForest *)system->forests)[f].built = false;
}

void phys_far_free(FarForest *forest) {
    Buffer *buffers[] = {&forest->members, &forest->keys,    &forest->cells,   &forest->moments, &forest->trees,
                         &forest->targets, &forest->scratch, &forest->results, &forest->places};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        phys_buffer_free(buffers[i]);
}

// Returns the forest of a force for the current step, or NULL if the step must be aborted.
static FarForest *get_forest(PhysSystem *system, PhysForceKind kind) {
    enum { WORK_OF_PARTICLE = 20 };
    bool charges = phys_force_row(kind).need == NEED_CHARGE;
    FarForest *forest = &system->forests[charges];
    if (forest->built)
        return forest;
    forest->charges = charges;
    if (!phys_charge(system, (uint64_t)system->columns.count * WORK_OF_PARTICLE) || !phys_far_build(system, forest))
        return NULL;
    return forest;
}

// --- targets

static bool add_targets(PhysSystem *system, FarForest *forest, uint32_t *count, uint32_t first, uint32_t end) {
    if (!phys_buffer_grow(system, &forest->targets, *count, sizeof(FarTargets)))
        return false;
    ((FarTargets *)forest->targets.bytes)[(*count)++] = (FarTargets){first, end};
    return true;
}

// Divides the members of a tree into groups of targets: the largest cells with at most FAR_GROUP members, and parts of
// larger leaves. Returns their number; sets system->failed if out of memory.
static uint32_t list_targets(PhysSystem *system, FarForest *forest, const FarTree *tree) {
    const FarCell *cells = forest->cells.bytes;
    uint32_t count = 0;
    for (uint32_t c = tree->root; c < tree->end;) {
        const FarCell *cell = &cells[c];
        bool small = cell->end - cell->first <= FAR_GROUP, leaf = cell->skip == c + 1;
        for (uint32_t first = cell->first; (small || leaf) && first < cell->end; first += FAR_GROUP) {
            uint32_t end = cell->end - first > FAR_GROUP ? first + FAR_GROUP : cell->end;
            if (!add_targets(system, forest, &count, first, end))
                return 0;
        }
        c = small ? cell->skip : c + 1;
    }
    return count;
}

static FarPass make_pass(const PhysSystem *system, FarForest *forest, Force *force, uint32_t targets,
                         uint32_t sources) {
    double opening = force->given.theta * 2 / 3;
    FarPass pass = {
        .system = system,
        .forest = forest,
        .targets = phys_far_tree(forest, targets),
        .sources = phys_far_tree(forest, sources),
        .opening_squared = opening * opening,
        .stop = system->options.division ? NULL : phys_stop(system),
    };
    phys_fill_terms(&pass.term, (ForceRange){force, force + 1});
    pass.bound = pass.term.bound * 0.5 * forest->half_scale;
    return pass;
}

// --- whether a tree saves time

// Returns the number of targets of a group that are not anchors.
static size_t moving_targets(const FarPass *pass, FarTargets targets) {
    size_t moving = 0;
    for (uint32_t i = targets.first; i < targets.end; i++)
        moving += !pass->system->columns.anchor[pass->forest->column[i]];
    return moving;
}

// Adds to *pairs the number of exact pairs of a pass, estimated from a sample of its groups of targets. Returns false
// if the step must be aborted.
static bool estimate_pairs(PhysSystem *system, const FarPass *pass, double *pairs) {
    enum { SAMPLES = 64 };
    uint32_t count = list_targets(system, pass->forest, pass->targets), step = 1 + count / SAMPLES;
    const FarTargets *targets = pass->forest->targets.bytes;
    uint64_t sum = 0, visits = 0;
    for (uint32_t i = 0; i < count && !system->failed; i += step) {
        FarCount walk = phys_far_count(pass, targets[i]);
        sum += walk.pairs * moving_targets(pass, targets[i]);
        visits += walk.visits;
    }
    *pairs += (double)sum * step;
    return !system->failed && phys_charge(system, visits * FAR_VISIT / EVALUATIONS_A_UNIT + 1);
}

bool phys_far_pays(PhysSystem *system, Force *force, uint32_t group, uint32_t other, bool *pays) {
    const Group *groups = system->groups.bytes;
    *pays = groups[other].count >= PHYS_FAR_MIN_PARTICLES;
    FarForest *forest = *pays ? get_forest(system, force->given.kind) : NULL;
    if (!forest || system->options.old_rules & SPEC_OLD_FAR_FIELDS)
        return forest || !*pays;
    FarPass inward = make_pass(system, forest, force, group, other),
            outward = make_pass(system, forest, force, other, group);
    double pairs = 0;
    if (!estimate_pairs(system, &inward, &pairs) || (group != other && !estimate_pairs(system, &outward, &pairs)))
        return false;
    double all = (double)groups[group].count * groups[other].count * (group == other ? 1 : 2);
    *pays = pairs * 4 <= all * 3;
    return true;
}

// --- batches

// Groups of targets that are evaluated together, every `step`-th from `first` on.
typedef struct Batch {
    const FarPass *pass;
    const FarTargets *targets;
    const size_t *results; // by group: index of its forces in FarForest.results; NULL: forces are added to the columns
    size_t first, count, step;
} Batch;

static void batch_chunk(void *context, int chunk, int chunks) {
    const Batch *batch = context;
    FarForest *forest = batch->pass->forest;
    FarScratch *scratch = (FarScratch *)forest->scratch.bytes + chunk;
    size_t end = phys_chunk_begin(batch->count, chunk + 1, chunks);
    for (size_t i = phys_chunk_begin(batch->count, chunk, chunks); i < end; i++) {
        size_t at = batch->first + i * batch->step;
        double *forces = batch->results ? (double *)forest->results.bytes + batch->results[at] : NULL;
        phys_far_walk(batch->pass, batch->targets[at], scratch, forces);
    }
}

// Evaluates a batch. Returns the number of evaluations.
static uint64_t run_far_batch(Batch *batch, int chunks) {
    FarScratch *scratch = batch->pass->forest->scratch.bytes;
    uint64_t evaluations = 0;
    if ((size_t)chunks > batch->count)
        chunks = (int)batch->count;
    for (int c = 0; c < chunks; c++)
        scratch[c].evaluations = 0;
    phys_parallel(batch->pass->system, chunks, batch_chunk, batch);
    for (int c = 0; c < chunks; c++)
        evaluations += scratch[c].evaluations;
    return evaluations;
}

// Evaluates all groups of targets in batches, each of which is charged before the next. The sizes of the batches do not
// depend on the number of threads.
static bool run_alone(PhysSystem *system, const FarPass *pass, size_t count, int chunks) {
    enum { FIRST_BATCH = 64, BATCH_EVALUATIONS = 50000000 };
    Batch batch = {.pass = pass, .targets = pass->forest->targets.bytes, .step = 1};
    for (size_t next = FIRST_BATCH; batch.first < count; batch.first += batch.count) {
        batch.count = count - batch.first < next ? count - batch.first : next;
        uint64_t evaluations = run_far_batch(&batch, chunks);
        if (!phys_charge(system, evaluations / EVALUATIONS_A_UNIT + 1) || !phys_may_continue(system))
            return false;
        next = (size_t)(BATCH_EVALUATIONS / (evaluations / batch.count + 1)) + 1;
    }
    return true;
}

// --- several processes

// Adds the forces of a group of targets to the columns.
static void add_results(const FarPass *pass, FarTargets targets, const double *forces) {
    const Columns *columns = &pass->system->columns;
    for (uint32_t i = targets.first; i < targets.end; i++) {
        uint32_t column = pass->forest->column[i];
        for (size_t k = 0; k < pass->forest->dimensions && !columns->anchor[column]; k++)
            columns->force[k * columns->stride + column] += *forces++;
    }
}

// Sets starts[r], where the results of process r start, and the place of the results of each group. Process r evaluates
// every group whose number modulo the number of processes is r. Its last result is its number of evaluations.
static void place_results(const FarPass *pass, size_t count, PhysProcesses processes, size_t *starts, size_t *results) {
    const FarTargets *targets = pass->forest->targets.bytes;
    size_t next = 0, step = (size_t)processes.count;
    for (size_t r = 0; r < step; r++) {
        starts[r] = next;
        for (size_t i = r; i < count; i += step) {
            results[i] = next;
            next += moving_targets(pass, targets[i]) * pass->forest->dimensions;
        }
        next++;
    }
    starts[step] = next;
}

// Evaluates the groups of targets on all processes. All processes charge the same work.
static bool run_divided(PhysSystem *system, const FarPass *pass, size_t count, int chunks) {
    const PhysDivision *division = system->options.division;
    PhysProcesses processes = division->processes(system);
    FarForest *forest = pass->forest;
    size_t step = (size_t)processes.count;
    uint64_t numbers = count * FAR_GROUP * forest->dimensions + step;
    if (!phys_buffer_reserve(system, &forest->results, 0, numbers, sizeof(double)) ||
        !phys_buffer_reserve(system, &forest->places, 0, count + step + 1, sizeof(size_t)))
        return false;
    size_t *starts = forest->places.bytes, *places = starts + step + 1;
    double *results = forest->results.bytes;
    place_results(pass, count, processes, starts, places);
    size_t self = (size_t)processes.self;
    Batch batch = {pass, forest->targets.bytes, places, self, (count + step - 1 - self) / step, step};
    results[starts[self + 1] - 1] = batch.count ? (double)run_far_batch(&batch, chunks) : 0;
    division->gather(system, results, starts);
    double evaluations = 0;
    for (size_t r = 0; r < step; r++)
        evaluations += results[starts[r + 1] - 1];
    for (size_t i = 0; i < count; i++)
        add_results(pass, ((const FarTargets *)forest->targets.bytes)[i], results + places[i]);
    return phys_charge(system, (uint64_t)evaluations / EVALUATIONS_A_UNIT + 1);
}

// --- passes

static bool add_tree_forces(PhysSystem *system, FarPass *pass) {
    enum { MIN_FOR_THREADS = 2 };
    FarForest *forest = pass->forest;
    uint32_t count = list_targets(system, forest, pass->targets);
    int chunks = phys_chunk_count(system, count, MIN_FOR_THREADS);
    if (system->failed || !phys_buffer_reserve(system, &forest->scratch, 0, (uint64_t)chunks, sizeof(FarScratch)))
        return false;
    if (count == 0 || pass->sources->count == 0)
        return true;
    return system->options.division ? run_divided(system, pass, count, chunks) : run_alone(system, pass, count, chunks);
}

bool phys_far_forces(PhysSystem *system, Force *force, uint32_t targets, uint32_t sources) {
    FarForest *forest = get_forest(system, force->given.kind);
    if (!forest)
        return false;
    FarPass pass = make_pass(system, forest, force, targets, sources);
    return add_tree_forces(system, &pass);
}

// Returns the group of targets that contains a column, or an empty group.
static FarTargets find_targets(const FarForest *forest, const FarTree *tree, uint32_t count, uint32_t column) {
    const FarTargets *targets = forest->targets.bytes;
    uint32_t member = tree->first;
    while (member < tree->first + tree->count && forest->column[member] != column)
        member++;
    for (uint32_t i = 0; i < count; i++)
        if (member >= targets[i].first && member < targets[i].end)
            return targets[i];
    return (FarTargets){0, 0};
}

bool phys_far_force_on(PhysSystem *system, Force *force, uint32_t column, uint32_t targets, uint32_t sources) {
    FarForest *forest = get_forest(system, force->given.kind);
    if (!forest)
        return false;
    FarPass pass = make_pass(system, forest, force, targets, sources);
    uint32_t count = list_targets(system, forest, pass.targets);
    if (system->failed || !phys_buffer_reserve(system, &forest->scratch, 0, 1, sizeof(FarScratch)))
        return false;
    FarTargets group = find_targets(forest, pass.targets, count, column);
    FarScratch *scratch = forest->scratch.bytes;
    scratch->evaluations = count;
    if (group.first < group.end && pass.sources->count)
        phys_far_walk(&pass, group, scratch, NULL);
    return phys_charge(system, scratch->evaluations / EVALUATIONS_A_UNIT + 1);
}
