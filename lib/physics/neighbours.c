// neighbours.c: when to use neighbour lists, and how (see neighbours.h).
#include "physics/neighbours.h"
#include "physics/sweep.h"
#include "physics/threads.h"

#include <string.h>

enum {
    MIN_FOR_LISTS = 160, // particles of a pass
    REST_FIRST = 64,     // steps without lists after they did not pay; doubled each time
    REST_LONGEST = 1024,
    ENTRIES_A_UNIT = 4,
    LIFE_FIRST = 8, // steps that a list is expected to serve at first
    LIFE_LEAST = 8, // and that it should serve
    MANY = 250000,  // particles that no cache holds
};

void phys_neighbours_free(Neighbours *list) {
    phys_buffer_free(&list->arrays);
    phys_buffer_free(&list->cells);
    phys_buffer_free(&list->entries);
}

// The reach of a pass; false if one of its forces has none.
static bool bounded(const PairPass *pass, double *bound, bool *touch_only) {
    *bound = 0;
    *touch_only = true;
    for (size_t t = 0; t < pass->term_count; t++) {
        const PairTerm *term = &pass->terms[t];
        if (phys_force_row(term->kind).reach == REACH_CONTACT)
            continue;
        *touch_only = false;
        *bound = fmax(*bound, term->bound);
    }
    return *bound < INFINITY;
}

// The particles of a pass; false if there are too many ranges.
static bool find_ranges(const PhysSystem *system, uint32_t group, uint32_t level, PassRanges *ranges) {
    const Group *groups = system->groups.bytes;
    memset(ranges, 0, sizeof *ranges);
    for (uint32_t g = group; g != NO_GROUP && g >= level; g = g ? groups[groups[g].parent].populated : NO_GROUP) {
        if (ranges->count == PHYS_MOST_RANGES)
            return false;
        ranges->at[ranges->count++] = (ColumnRange){groups[g].first, groups[g].count};
    }
    return true;
}

// The list that was made for this pass, or one that is not used in this frame.
static Neighbours *find_list(PhysSystem *system, uint32_t group, uint32_t level) {
    Neighbours *spare = NULL;
    for (int i = 0; i < PHYS_MOST_LISTS; i++) {
        Neighbours *list = &system->lists[i];
        if (list->frame && list->group == group && list->level == level)
            return list;
        if (list->frame < system->frame && (!spare || list->frame < spare->frame))
            spare = list;
    }
    if (spare)
        spare->built = false;
    return spare;
}

static bool still_idle(const PairPass *pass, const Neighbours *list) {
    for (uint32_t place = list->view.listed; place < list->total; place++) {
        size_t column = list->view.direct ? place : list->view.column[place];
        bool idle = list->touch_only && pass->radius[column] == 0;
        for (size_t k = 0; k < pass->dimensions; k++)
            idle |= !isfinite(pass->position[k * pass->stride + column]);
        if (!idle)
            return false;
    }
    return true;
}

// A pass with a list, as the threads see it.
typedef struct ListPass {
    const Kernels *kernels;
    const PairPass *pass;
    Neighbours *list;
    const Sweep *sweep;          // of step_share
    bool reuse;                  // likewise: chunks of a share take turns with one piece of the column of forces
    bool held[PHYS_MOST_SHARES]; // by share: nothing has left its skin
} ListPass;

// Whole blocks for each worker.
static size_t share_begin(const ListPass *work, size_t places, int worker, int workers) {
    size_t lanes = work->list->lanes, blocks = (places + lanes - 1) / lanes;
    return phys_share(blocks, worker, workers);
}

static void refresh_share(void *context, int worker, int workers) {
    ListPass *work = context;
    const ListView *view = &work->list->view;
    size_t lanes = work->list->lanes, first = share_begin(work, view->listed, worker, workers) * lanes;
    size_t end = share_begin(work, view->listed, worker + 1, workers) * lanes;
    end = end < view->listed ? end : view->listed;
    work->held[worker] = work->kernels->list_refresh(work->pass, view, first, end);
}

static void force_share(void *context, int worker, int workers) {
    ListPass *work = context;
    const ListView *view = &work->list->view;
    size_t first = share_begin(work, view->regular, worker, workers);
    work->kernels->list_forces(work->pass, view, first, share_begin(work, view->regular, worker + 1, workers));
}

// Forces, motion and the quads of the next step in one go, by chunks that stay in the cache. What moves is the columns,
// and the kernels for forces read the quads alone.
static void step_share(void *context, int worker, int workers) {
    enum { CHUNK = 16384 }; // places
    ListPass *work = context;
    const ListView *view = &work->list->view;
    ListView next = *view;
    next.quads = work->list->next;
    size_t lanes = work->list->lanes, start = share_begin(work, view->regular, worker, workers) * lanes;
    size_t stop = share_begin(work, view->regular, worker + 1, workers) * lanes;
    stop = stop < view->regular ? stop : view->regular;
    for (size_t first = start, end; first < stop; first = end) {
        end = stop - first > CHUNK ? first + CHUNK : stop;
        PairPass pass = *work->pass;
        Columns columns = *work->sweep->pass.columns;
        Sweep sweep = *work->sweep;
        columns.force = pass.force -= work->reuse ? first - start : 0;
        sweep.pass.columns = &columns;
        work->kernels->list_forces(&pass, view, first / lanes, (end + lanes - 1) / lanes);
        phys_sweep_rows(&sweep, first, end);
        work->held[worker] &= work->kernels->list_refresh(&pass, &next, first, end);
    }
}

static int shares_for(const PhysSystem *system, const Neighbours *list) {
    return phys_shares(system, list->total, PHYS_MIN_FOR_THREADS);
}

// Runs `share`; false if something has left its skin.
static bool run(const PhysSystem *system, ListPass *work, PhysWork *share) {
    bool held = true;
    memset(work->held, true, sizeof work->held);
    phys_parallel(system, shares_for(system, work->list), share, work);
    for (int w = 0; w < PHYS_MOST_SHARES; w++)
        held &= work->held[w];
    return held;
}

// The halo is where others say.
static bool refresh_foreign(const PhysSystem *system, const ListPass *work) {
    const ListView *view = &work->list->view;
    uint32_t lanes = (uint32_t)work->list->lanes, count = system->foreign ? work->list->total : 0, i = 0;
    bool held = true;
    for (; i < count && (i = phys_next_foreign(system, i)) < count; i = i / lanes * lanes + lanes) {
        uint32_t first = i / lanes * lanes, end = first + lanes < view->listed ? first + lanes : view->listed;
        held &= work->kernels->list_refresh(work->pass, view, first, end);
    }
    return held;
}

// Brings the list's copy of the particles up to date. False if something has left its skin.
static bool refresh(const PhysSystem *system, ListPass *work) {
    Neighbours *list = work->list;
    if (list->ahead && list->ahead == system->motion) {
        double *quads = list->view.quads;
        list->view.quads = list->next;
        list->next = quads;
        list->ahead = 0;
        return refresh_foreign(system, work) && list->next_holds;
    }
    list->view.same_radii = list->radii == system->radii;
    return run(system, work, refresh_share) && still_idle(work->pass, list);
}

// The whole step, if all that it has is this pass, the motion and what is in the columns. Where caches hold all of it,
// this gains nothing.
static bool step(PhysSystem *system, ListPass *work, Move *move) {
    Neighbours *list = work->list;
    bool many = list->total >= MANY || system->options.neighbours == PHYS_NEIGHBOURS_ALWAYS;
    if (!move || !many || !list->next || !list->view.direct || list->view.regular < list->total)
        return false;
    Sweep sweep;
    work->sweep = &sweep;
    work->reuse = !system->has_own_forces && !system->options.keep_forces;
    move->done = true;
    if (!phys_sweep_begin(system, 0, move->delta, move->speed_of_light, &sweep))
        return true; // the meter gives the step up
    list->next_holds = run(system, work, step_share);
    list->ahead = system->motion + 1; // as it is after the step
    phys_sweep_end(&sweep);
    return true;
}

// The few large particles: each takes everyone.
static void large_forces(const ListPass *work) {
    const Neighbours *list = work->list;
    const PassRanges *ranges = &list->ranges;
    uint32_t end = list->view.listed, own = phys_own_keys(list);
    for (uint32_t place = list->view.regular; place < end && !phys_pass_stopped(work->pass);) {
        uint32_t targets[8] = {0}, count = 0;
        bool inner = list->key[place] < own;
        // Those of enclosing groups meet only the particles of the group itself.
        for (; place < end && count < list->lanes && (list->key[place] < own) == inner; place++)
            targets[count++] = list->view.column[place];
        for (uint32_t r = 0; r < (inner ? ranges->count : 1); r++)
            work->kernels->list_crowd(work->pass, targets, count, ranges->at[r].first,
                                      (size_t)ranges->at[r].first + ranges->at[r].count);
    }
}

// Costs relative to that of a list entry, with eight lanes; only ratios count, so the unit is left open. Where a force
// needs contact, few pairs get as far as a square root. Wrong costs cost time and change no result.
#define PAIR_COST(touch_only) ((touch_only) ? 1.0 / 6 : 1.0)
#define SCAN_COST (1.0 / 3)  // of a candidate, when a list is built
#define LARGE_COST (1.0 / 3) // of a pair with a large particle
#define BUILD_COST 44.0      // of a particle, when a list is built
#define REFRESH_COST 5.5     // of a particle, in every step

static double all_pairs_cost(const Neighbours *list) {
    double n = (double)phys_ranges_total(&list->ranges), own = list->ranges.at[0].count;
    return (own * (own - 1) / 2 + own * (n - own)) * PAIR_COST(list->touch_only);
}

uint64_t phys_max_useful_entries(const Neighbours *list) {
    return (uint64_t)all_pairs_cost(list) + 1;
}

// Is a step with lists cheaper than one with all pairs?
static bool pays(const Neighbours *list) {
    double life = list->life ? list->life : LIFE_FIRST, n = list->total, width = (double)list->lanes / 8;
    double each = n * (BUILD_COST / life + REFRESH_COST), scan = (double)list->scanned * SCAN_COST / life;
    double large = (double)(list->view.listed - list->view.regular) * n * LARGE_COST;
    return each + (scan + large + (double)list->padded) / width < all_pairs_cost(list) / width;
}

// Of a step with lists, but for what does not depend on the skin. Counted, not timed: which way is taken shows in the
// work that is charged.
static double cost_of_step(const Neighbours *list) {
    double build = (double)list->total * BUILD_COST, width = (double)list->lanes / 8;
    return build / list->life + ((double)list->scanned * SCAN_COST / list->life + (double)list->padded) / width;
}

// A longer skin makes longer lists that serve more steps. Each life tries another one, in the same direction until it
// costs more than the last; but motion changes costs, too, and must not lead to lists that serve hardly any step.
static void try_skin(Neighbours *list) {
    double cost = cost_of_step(list);
    bool worse = list->cost > 0 && cost > list->cost;
    list->shorter = list->life >= LIFE_LEAST && list->shorter != worse;
    list->cost = cost;
    list->skin *= list->shorter ? 1 / 1.2 : 1.2;
    list->skin = fmax(SKIN_LEAST * list->base, fmin(list->skin, SKIN_MOST * list->base));
}

// Neither many steps nor few are best.
void phys_adapt_skin(Neighbours *list, uint32_t life) {
    if (life < LIFE_LEAST)
        list->skin = fmin(list->skin * 1.25, SKIN_MOST * list->base);
    else if (life > 24)
        list->skin = fmax(list->skin / 1.15, SKIN_LEAST * list->base);
}

// Large particles meet all others in the order of the columns, and so do all where there is no list.
static bool sort(PhysSystem *system, const Kernels *kernels, const PairPass *pass, Neighbours *list) {
    bool sorted = phys_grid_build(system, kernels, pass, list);
    if (!system->settled || (sorted && list->view.listed == list->view.regular))
        return sorted;
    phys_unsettle(system);
    return sorted && phys_grid_build(system, kernels, pass, list);
}

static bool build(PhysSystem *system, const Kernels *kernels, const PairPass *pass, Neighbours *list) {
    list->ahead = 0;
    list->built = sort(system, kernels, pass, list);
    list->radii = system->radii;
    system->failed = false; // lists may fail, the frame need not
    list->age = 0;
    if (list->built && (system->options.neighbours == PHYS_NEIGHBOURS_ALWAYS || pays(list))) {
        list->backoff = 0;
        if (system->may_settle)
            phys_settle(system, list);
        return true;
    }
    list->built = false;
    if (system->foreign) { // until the next halo
        list->resting = UINT32_MAX;
        return false;
    }
    list->backoff = list->backoff ? list->backoff * 2 : REST_FIRST;
    list->backoff = list->backoff < REST_LONGEST ? list->backoff : REST_LONGEST;
    list->resting = system->options.neighbours == PHYS_NEIGHBOURS_ALWAYS ? 0 : list->backoff;
    return false;
}

// A list for this pass as it is described now, valid or not; NULL if there is none to be had.
static Neighbours *list_for(PhysSystem *system, const Kernels *kernels, const PairPass *pass, uint32_t group,
                            uint32_t level) {
    double bound;
    bool touch_only;
    PassRanges ranges;
    if (!bounded(pass, &bound, &touch_only) || !find_ranges(system, group, level, &ranges))
        return NULL;
    uint64_t total = phys_ranges_total(&ranges);
    bool always = system->options.neighbours == PHYS_NEIGHBOURS_ALWAYS;
    if (system->options.neighbours == PHYS_NEIGHBOURS_NEVER ||
        (!always && (total < MIN_FOR_LISTS || ranges.at[0].count < MIN_FOR_LISTS / 4)))
        return NULL;
    Neighbours *list = find_list(system, group, level);
    if (!list)
        return NULL;
    bool same = list->group == group && list->level == level && list->dimensions == pass->dimensions &&
                list->lanes == kernels->lanes && list->touch_only == touch_only && list->bound == bound &&
                !memcmp(&list->ranges, &ranges, sizeof ranges);
    list->frame = system->frame;
    if (!same) {
        list->group = group;
        list->level = level;
        list->dimensions = pass->dimensions;
        list->lanes = kernels->lanes;
        list->touch_only = touch_only;
        list->bound = bound;
        list->ranges = ranges;
        list->built = false;
        list->resting = list->backoff = list->life = 0;
        list->cost = 0;
        list->shorter = false;
        list->skin = system->skin;
        list->skin_given = system->foreign;
    }
    return list;
}

bool phys_lists_hold(PhysSystem *system, uint32_t age) {
    const Kernels *kernels = phys_kernels(system);
    PairPass pass = phys_columns_pass(&system->columns);
    bool hold = true;
    for (int i = 0; i < PHYS_MOST_LISTS; i++) {
        ListPass work = {.kernels = kernels, .pass = &pass, .list = &system->lists[i]};
        if (work.list->built)
            hold = refresh(system, &work) && hold && work.list->age == age;
    }
    return hold;
}

void phys_lists_drop(PhysSystem *system, double skin) {
    system->skin = skin;
    for (int i = 0; i < PHYS_MOST_LISTS; i++) {
        Neighbours *list = &system->lists[i];
        list->built = false;
        list->resting = 0;
        list->skin = skin;
    }
}

bool phys_neighbour_pass(PhysSystem *system, const Kernels *kernels, const PairPass *pass, uint32_t group,
                         uint32_t level, Move *move) {
    Neighbours *list = list_for(system, kernels, pass, group, level);
    if (!list)
        return false;
    if (list->resting) {
        list->resting--;
        return false;
    }
    ListPass work = {.kernels = kernels, .pass = pass, .list = list};
    if (list->built && !system->foreign && !refresh(system, &work)) {
        list->built = false;
        list->life = list->age;
        try_skin(list);
    }
    if (!list->built) {
        if (!build(system, kernels, pass, list))
            return false;
        refresh(system, &work);
    }
    list->age++;
    uint64_t large = (uint64_t)(list->view.listed - list->view.regular) * list->total;
    if (!phys_charge(system, (list->padded + large) * pass->term_count / ENTRIES_A_UNIT + list->total))
        return true;
    if (step(system, &work, move))
        return true;
    phys_parallel(system, shares_for(system, list), force_share, &work);
    large_forces(&work);
    return true;
}
