// neighbour_list.c: decides when to use neighbour lists, tunes them and computes passes with them (neighbour_list.h).
#include "physics/neighbour_list.h"

#include "physics/integrate.h"
#include "physics/pair_wavefront.h"
#include "physics/threads.h"

#include <string.h>

enum {
    MIN_FOR_LISTS = 160, // minimum number of particles in a pass
    FIRST_COOLDOWN = 64, // number of steps without lists after lists have not paid off; each further failure doubles it
    MAX_COOLDOWN = 1024, // maximum number of steps without lists
    ENTRIES_A_UNIT = 4,  // list entries per unit of work
    FIRST_LIFETIME = 8,  // number of steps that the first lists are expected to serve
    MIN_LIFETIME = 8,    // if lists serve fewer steps, the skin grows
    MANY = 250000,       // this many particles no longer fit into the cache
};

void phys_neighbour_list_free(NeighbourList *list) {
    phys_buffer_free(&list->arrays);
    phys_buffer_free(&list->cells);
    phys_buffer_free(&list->entries);
}

// Returns NeighbourList.bound for a pass, or INFINITY if one of its forces has no bound.
static double bound_of(const PairPass *pass) {
    double bound = 0;
    for (size_t t = 0; t < pass->term_count; t++)
        if (phys_force_row(pass->terms[t].kind).reach != REACH_CONTACT)
            bound = fmax(bound, pass->terms[t].bound);
    return bound;
}

// Finds the particles of a pass. Returns false if there are too many ranges.
static bool find_ranges(const PhysSystem *system, uint32_t group, uint32_t level, PassRanges *ranges) {
    const Group *groups = system->groups.bytes;
    memset(ranges, 0, sizeof *ranges);
    for (uint32_t g = group; g != NO_GROUP; g = phys_next_enclosing(groups, g, level)) {
        if (ranges->count == PHYS_MAX_RANGES)
            return false;
        ranges->at[ranges->count++] = (ColumnRange){groups[g].first, groups[g].count};
    }
    return true;
}

// Returns the list of this pass. If it has none, returns the list that has not been used for the longest time. Returns
// NULL if other passes of this frame use all lists.
static NeighbourList *find_list(PhysSystem *system, uint32_t group, uint32_t level) {
    NeighbourList *spare = NULL;
    for (int i = 0; i < PHYS_MAX_LISTS; i++) {
        NeighbourList *list = &system->lists[i];
        if (list->frame && list->group == group && list->level == level)
            return list;
        if (list->frame < system->frame && (!spare || list->frame < spare->frame))
            spare = list;
    }
    return spare;
}

static bool still_idle(const PairPass *pass, const NeighbourList *list) {
    for (uint32_t index = list->view.listed; index < list->total; index++)
        if (!phys_is_idle(pass, list, list->view.direct ? index : list->view.column[index]))
            return false;
    return true;
}

// Context of the threads for a pass with a list.
typedef struct ListPass {
    const Kernels *kernels;
    const PairPass *pass;
    NeighbourList *list;
    const Integrator *sweep;     // for step_chunk: second half of the step
    bool reuse;                  // for step_chunk: all parts of a chunk use the same section of the force columns
    bool valid[PHYS_MAX_CHUNKS]; // by chunk: true if no particle has moved by half the skin
} ListPass;

// Returns the first block of a chunk.
static size_t chunk_first_block(const ListPass *work, size_t count, int chunk, int chunks) {
    size_t lanes = work->list->lanes, blocks = (count + lanes - 1) / lanes;
    return phys_chunk_begin(blocks, chunk, chunks);
}

static void refresh_chunk(void *context, int chunk, int chunks) {
    ListPass *work = context;
    const ListView *view = &work->list->view;
    size_t lanes = work->list->lanes, first = chunk_first_block(work, view->listed, chunk, chunks) * lanes;
    size_t end = chunk_first_block(work, view->listed, chunk + 1, chunks) * lanes;
    end = end < view->listed ? end : view->listed;
    work->valid[chunk] = work->kernels->list_refresh(work->pass, view, first, end);
}

static void force_chunk(void *context, int chunk, int chunks) {
    ListPass *work = context;
    const ListView *view = &work->list->view;
    size_t first = chunk_first_block(work, view->regular, chunk, chunks);
    work->kernels->list_forces(work->pass, view, first, chunk_first_block(work, view->regular, chunk + 1, chunks));
}

// Computes forces, motion and the next step's `packed` at once, in parts that fit into the cache. This is possible
// because motion changes the columns, while the force kernels read only the current `packed`.
static void step_chunk(void *context, int chunk, int chunks) {
    enum { CHUNK = 16384 }; // number of particles in a part
    ListPass *work = context;
    const ListView *view = &work->list->view;
    ListView next = *view;
    next.packed = work->list->next_packed;
    size_t lanes = work->list->lanes, start = chunk_first_block(work, view->regular, chunk, chunks) * lanes;
    size_t stop = chunk_first_block(work, view->regular, chunk + 1, chunks) * lanes;
    stop = stop < view->regular ? stop : view->regular;
    for (size_t first = start, end; first < stop; first = end) {
        end = stop - first > CHUNK ? first + CHUNK : stop;
        PairPass pass = *work->pass;
        Columns columns = *work->sweep->pass.columns;
        Integrator integrator = *work->sweep;
        columns.force = pass.force -= work->reuse ? first - start : 0;
        integrator.pass.columns = &columns;
        work->kernels->list_forces(&pass, view, first / lanes, (end + lanes - 1) / lanes);
        phys_integrate_rows(&integrator, first, end);
        work->valid[chunk] &= work->kernels->list_refresh(&pass, &next, first, end);
    }
}

static int chunk_count_for(const PhysSystem *system, const NeighbourList *list) {
    return phys_chunk_count(system, list->total, PHYS_MIN_FOR_THREADS);
}

// Runs `task` for all chunks. Returns false if a particle has moved by half the skin.
static bool run_list_chunks(const PhysSystem *system, ListPass *work, PhysTask *task) {
    bool held = true;
    memset(work->valid, true, sizeof work->valid);
    phys_parallel(system, chunk_count_for(system, work->list), task, work);
    for (int w = 0; w < PHYS_MAX_CHUNKS; w++)
        held &= work->valid[w];
    return held;
}

// Updates the list's copy of the halo particles, whose positions come from other ranks. Returns false if one of them
// has moved by half the skin.
static bool refresh_remote(const PhysSystem *system, const ListPass *work) {
    const ListView *view = &work->list->view;
    uint32_t lanes = (uint32_t)work->list->lanes, count = system->remote ? work->list->total : 0, i = 0;
    bool held = true;
    for (; i < count && (i = phys_next_remote(system, i)) < count; i = i / lanes * lanes + lanes) {
        uint32_t first = i / lanes * lanes, end = first + lanes < view->listed ? first + lanes : view->listed;
        held &= work->kernels->list_refresh(work->pass, view, first, end);
    }
    return held;
}

// Updates the list's copy of the particles. Returns false if a particle has moved by half the skin.
static bool refresh_list(const PhysSystem *system, ListPass *work) {
    NeighbourList *list = work->list;
    ListState before = list->state;
    list->state = LIST_BUILT;
    if (before > LIST_BUILT && list->next_motion_version == system->motion_version) {
        double *quads = list->view.packed;
        list->view.packed = list->next_packed;
        list->next_packed = quads;
        return refresh_remote(system, work) && before == LIST_AHEAD;
    }
    list->view.same_radii = list->radius_version == system->radius_version;
    return run_list_chunks(system, work, refresh_chunk) && still_idle(work->pass, list);
}

// Takes the whole step if it consists of only this pass and the motion. Returns false if the step consists of more, or
// if the list does not allow this. Also returns false if the particles fit into the cache, because then it is not
// faster.
static bool step_with_list(PhysSystem *system, ListPass *work, Move *move) {
    NeighbourList *list = work->list;
    bool many = list->total >= MANY || system->options.neighbours == PHYS_NEIGHBOURS_ALWAYS;
    if (!move || !many || !list->next_packed || !list->view.direct || list->view.regular < list->total)
        return false;
    Integrator integrator;
    work->sweep = &integrator;
    work->reuse = system->own_forces == OWN_FORCES_NONE && !system->options.keep_forces;
    move->done = true;
    if (!phys_integrate_begin(system, 0, move->delta, move->speed_of_light, &integrator))
        return true; // the budget is exceeded, so the step is aborted
    list->state = run_list_chunks(system, work, step_chunk) ? LIST_AHEAD : LIST_SPENT;
    list->next_motion_version = system->motion_version + 1; // the value of motion_version after the step
    phys_integrate_end(&integrator);
    return true;
}

// Adds the forces on the few large particles, each of which is tested against all other particles.
static void large_forces(const ListPass *work) {
    const NeighbourList *list = work->list;
    const PassRanges *ranges = &list->ranges;
    uint32_t end = list->view.listed, own = phys_own_keys(list);
    for (uint32_t index = list->view.regular; index < end && !phys_pass_stopped(work->pass);) {
        uint32_t targets[PHYS_MAX_LANES] = {0}, count = 0;
        bool inner = list->key[index] < own;
        // In this pass, large particles of enclosing groups interact only with the pass's own group.
        for (; index < end && count < list->lanes && (list->key[index] < own) == inner; index++)
            targets[count++] = list->view.column[index];
        for (uint32_t r = 0; r < (inner ? ranges->count : 1); r++)
            work->kernels->range_forces(work->pass, targets, count, ranges->at[r].first,
                                        (size_t)ranges->at[r].first + ranges->at[r].count);
    }
}

// Costs of parts of a step. The unit is the cost of a list entry with eight lanes. A pair costs less if all forces need
// contact, because few pairs then need a square root. Wrong values only cost time and do not change results.
#define PAIR_COST(touch_only) ((touch_only) ? 1.0 / 6 : 1.0)
#define SCAN_COST (1.0 / 3)  // per candidate in a build
#define LARGE_COST (1.0 / 3) // per pair with a large particle
#define BUILD_COST 44.0      // per particle in a build
#define REFRESH_COST 5.5     // per particle in every step

static double all_pairs_cost(const NeighbourList *list) {
    double n = (double)phys_ranges_total(&list->ranges), own = list->ranges.at[0].count;
    return (own * (own - 1) / 2 + own * (n - own)) * PAIR_COST(list->bound == 0);
}

// Returns true if a step with lists is cheaper than one with all pairs.
static bool pays_off(const NeighbourList *list) {
    double lifetime = list->lifetime ? list->lifetime : FIRST_LIFETIME, n = list->total,
           width = (double)list->lanes / 8;
    double each = n * (BUILD_COST / lifetime + REFRESH_COST), scan = (double)list->scanned * SCAN_COST / lifetime;
    double large = (double)(list->view.listed - list->view.regular) * n * LARGE_COST;
    return each + (scan + large + (double)list->padded) / width < all_pairs_cost(list) / width;
}

// Returns the part of the cost of a step with lists that depends on the skin. It is computed from counts and not timed,
// because the skin affects the work that is charged, which must not depend on time.
static double cost_of_step(const NeighbourList *list) {
    double build = (double)list->total * BUILD_COST, width = (double)list->lanes / 8;
    return build / list->lifetime + ((double)list->scanned * SCAN_COST / list->lifetime + (double)list->padded) / width;
}

// A larger skin makes longer lists that serve more steps. Each new list tries another skin. The skin changes in the
// same direction as long as the cost falls. If a list has served fewer than MIN_LIFETIME steps, the skin grows in any
// case, because motion also changes the cost.
static void tune_skin(NeighbourList *list) {
    double cost = cost_of_step(list);
    bool worse = list->cost > 0 && cost > list->cost;
    list->shrinking = list->lifetime >= MIN_LIFETIME && list->shrinking != worse;
    list->cost = cost;
    list->skin *= list->shrinking ? 1 / 1.2 : 1.2;
    list->skin = fmax(MIN_SKIN * list->contact_distance, fmin(list->skin, MAX_SKIN * list->contact_distance));
}

void phys_adapt_skin(NeighbourList *list, uint32_t lifetime) {
    if (lifetime < MIN_LIFETIME)
        list->skin = fmin(list->skin * 1.25, MAX_SKIN * list->contact_distance);
    else if (lifetime > 24)
        list->skin = fmax(list->skin / 1.15, MIN_SKIN * list->contact_distance);
}

// Sorts the particles and builds the list. If this fails, or if there are large particles, forces are summed in the
// order of columns. So the columns are put back into ascending order of handles.
static bool sort_particles(PhysSystem *system, const PairPass *pass, NeighbourList *list) {
    bool automatic = system->options.neighbours == PHYS_NEIGHBOURS_AUTO;
    uint64_t max_entries = automatic ? (uint64_t)all_pairs_cost(list) + 1 : UINT64_MAX;
    bool sorted = phys_grid_build(system, pass, list, max_entries);
    if (system->column_order != ORDER_BY_CELL || (sorted && list->view.listed == list->view.regular))
        return sorted;
    phys_restore_order(system);
    return sorted && phys_grid_build(system, pass, list, max_entries);
}

// Lets a pass do without lists, because they do not pay off or there is no memory for them.
static void pause_list(const PhysSystem *system, NeighbourList *list) {
    list->state = LIST_PAUSED;
    if (system->remote) { // this pass gets no list until the halo is rebuilt
        list->cooldown = UINT32_MAX;
        return;
    }
    list->backoff = list->backoff ? list->backoff * 2 : FIRST_COOLDOWN;
    list->backoff = list->backoff < MAX_COOLDOWN ? list->backoff : MAX_COOLDOWN;
    list->cooldown = list->backoff;
    if (system->options.neighbours == PHYS_NEIGHBOURS_ALWAYS)
        list->state = LIST_DUE;
}

static bool build_list(PhysSystem *system, const PairPass *pass, NeighbourList *list) {
    bool sorted = sort_particles(system, pass, list);
    list->radius_version = system->radius_version;
    system->failed = false; // running out of memory here is not an error, because a pass can do without a list
    list->age = 0;
    if (!sorted || (system->options.neighbours != PHYS_NEIGHBOURS_ALWAYS && !pays_off(list))) {
        pause_list(system, list);
        return false;
    }
    list->state = LIST_BUILT;
    list->backoff = 0;
    if (system->column_order != ORDER_FIXED)
        phys_reorder(system, list);
    return true;
}

// Returns the list for this pass, or NULL if lists cannot be used.
static NeighbourList *prepare_list(PhysSystem *system, const PairPass *pass, uint32_t group, uint32_t level) {
    double bound = bound_of(pass);
    PassRanges ranges;
    if (!(bound < INFINITY) || !find_ranges(system, group, level, &ranges))
        return NULL;
    uint64_t total = phys_ranges_total(&ranges);
    bool always = system->options.neighbours == PHYS_NEIGHBOURS_ALWAYS;
    if (system->options.neighbours == PHYS_NEIGHBOURS_NEVER ||
        (!always && (total < MIN_FOR_LISTS || ranges.at[0].count < MIN_FOR_LISTS / 4)))
        return NULL;
    NeighbourList *list = find_list(system, group, level);
    if (!list)
        return NULL;
    bool same = list->group == group && list->level == level && list->dimensions == pass->dimensions &&
                list->lanes == system->kernels->lanes && list->bound == bound &&
                !memcmp(&list->ranges, &ranges, sizeof ranges);
    list->frame = system->frame;
    if (!same) {
        list->group = group;
        list->level = level;
        list->dimensions = pass->dimensions;
        list->lanes = system->kernels->lanes;
        list->bound = bound;
        list->ranges = ranges;
        list->state = LIST_DUE;
        list->backoff = list->lifetime = 0;
        list->cost = 0;
        list->shrinking = false;
        list->skin = system->skin;
    }
    return list;
}

bool phys_lists_valid(PhysSystem *system, uint32_t age) {
    PairPass pass = phys_columns_pass(&system->columns);
    bool hold = true;
    for (int i = 0; i < PHYS_MAX_LISTS; i++) {
        ListPass work = {.kernels = system->kernels, .pass = &pass, .list = &system->lists[i]};
        if (phys_list_is_built(work.list))
            hold = refresh_list(system, &work) && hold && work.list->age == age;
    }
    return hold;
}

void phys_lists_drop(PhysSystem *system, double skin) {
    system->skin = skin;
    for (int i = 0; i < PHYS_MAX_LISTS; i++) {
        NeighbourList *list = &system->lists[i];
        list->state = LIST_DUE;
        list->skin = skin;
    }
}

bool phys_neighbour_list_pass(PhysSystem *system, const PairPass *pass, uint32_t group, uint32_t level, Move *move) {
    NeighbourList *list = prepare_list(system, pass, group, level);
    if (!list)
        return false;
    if (list->state == LIST_PAUSED) {
        if (--list->cooldown == 0)
            list->state = LIST_DUE;
        return false;
    }
    ListPass work = {.kernels = system->kernels, .pass = pass, .list = list};
    if (list->state != LIST_DUE && !system->remote && !refresh_list(system, &work)) {
        list->state = LIST_DUE;
        list->lifetime = list->age;
        tune_skin(list);
    }
    if (list->state == LIST_DUE) {
        if (!build_list(system, pass, list))
            return false;
        refresh_list(system, &work);
    }
    list->age++;
    uint64_t large = (uint64_t)(list->view.listed - list->view.regular) * list->total;
    if (!phys_charge(system, (list->padded + large) * pass->term_count / ENTRIES_A_UNIT + list->total))
        return true;
    if (step_with_list(system, &work, move))
        return true;
    phys_parallel(system, chunk_count_for(system, list), force_chunk, &work);
    large_forces(&work);
    return true;
}
