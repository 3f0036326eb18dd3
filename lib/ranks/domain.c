// domain.c: decides on domain decomposition (domain.h) in each frame, and takes the steps of frames that use it.
#include "ranks/domain.h"

#include "base/clock.h"
#include "physics/far_force.h"

enum {
    MIN_PARTICLES = 8000, // with fewer particles, communication costs more than it saves
    FIRST_INTERVAL = 32,  // minimum number of steps before the first rebalancing; each rebalancing doubles it
};
// If the largest time of a rank is more than this many times the mean time of all ranks, patches are rebalanced.
#define MAX_IMBALANCE 1.15

// Returns true if a pair force has unlimited range or a far field, or if there is no pair force. Otherwise sets *reach.
static bool has_unbounded_force(const PhysSystem *system, ForceReach *reach) {
    const Force *forces = system->forces.bytes;
    bool any = false;
    reach->contact = false;
    reach->bound = 0;
    for (uint32_t f = 0; f < system->force_count; f++) {
        ForceRow row = phys_force_row(forces[f].given.kind);
        if (row.stage != STAGE_PAIR)
            continue;
        double limit = forces[f].given.max_distance;
        any = true;
        if (phys_is_far(system, &forces[f]))
            return true;
        if (row.reach == REACH_CONTACT)
            reach->contact = true;
        else if (limit > 0)
            reach->bound = fmax(reach->bound, limit);
        else
            return true;
    }
    return !any || !(reach->bound < INFINITY);
}

// Returns true if domain decomposition is worthwhile. A frame must have at least two steps, because collecting all
// particles at its end takes about as long as a step.
static bool pays_off(const PhysSystem *system, const PhysTime *time) {
    bool many = system->particle_count >= MIN_PARTICLES && time->now - time->last > 1.5 * time->resolution;
    return system->options.neighbours != PHYS_NEIGHBOURS_NEVER && system->dimensions <= PHYS_VECTOR_DIMENSIONS &&
           system->particle_count && (ranks_of(system)->min_pairs || many);
}

// Returns the data of a system, or NULL if out of memory.
static Domain *get_domain(PhysSystem *system) {
    if (!system->division.bytes) {
        if (!phys_buffer_reserve(system, &system->division, 0, 1, sizeof(Domain)))
            return NULL;
        memset(system->division.bytes, 0, sizeof(Domain));
    }
    return system->division.bytes;
}

// Creates the local system if there is none, and updates its options. Returns false if out of memory.
static bool prepare_local(PhysSystem *system, Domain *domain) {
    if (!domain->local && !(domain->local = phys_new())) {
        system->failed = true;
        return false;
    }
    PhysOptions options = system->options;
    options.neighbours = PHYS_NEIGHBOURS_ALWAYS;
    options.pool = system->threads;
    options.budget = NULL; // because domain_step charges the system's budget, by the same amount on all ranks
    options.division = NULL;
    if (!system->threads)
        options.threads = 1;
    phys_set_options(domain->local, &options);
    return true;
}

void domain_free(PhysSystem *system) {
    Domain *domain = system->division.bytes;
    Buffer *buffers[] = {
        &domain->patch_owners, &domain->interior,        &domain->owners,           &domain->counts,
        &domain->remote,       &domain->built,           &domain->movers,           &domain->random_offset,
        &domain->to.starts,    &domain->to.items,        &domain->from.starts,      &domain->from.items,
        &domain->transfers,    &domain->transfer_counts, &domain->message,          &domain->gathered,
        &domain->starts,       &domain->rank_seconds,    &domain->boundary.columns, &domain->arrivals.columns,
        &domain->sources,      &domain->spare,           &domain->orders,           &domain->last_orders,
        &domain->column_of};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        phys_buffer_free(buffers[i]);
    phys_neighbour_list_free(&domain->survey);
    phys_free(domain->local);
    phys_buffer_free(&system->division);
}

// Returns true if a particle has a larger radius than the halo was built for.
static bool sees_farther(const PhysSystem *system, const Domain *domain) {
    const double *radius = system->columns.radius;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        if (!(radius[i] > domain->max_radius))
            continue;
        bool large = false;
        for (uint32_t l = 0; l < domain->large_count; l++)
            large |= domain->large[l] == i;
        if (!large)
            return true;
    }
    return false;
}

// Returns true if the work was distributed unevenly. The result is the same on all ranks.
static bool is_unbalanced(const PhysSystem *system, const Domain *domain) {
    const double *rank_seconds = domain->rank_seconds.bytes;
    double max_seconds = 0, sum = 0;
    for (uint32_t r = 0; r < ranks_count(system); r++) {
        max_seconds = fmax(max_seconds, rank_seconds[r]);
        sum += rank_seconds[r];
    }
    return domain->steps >= domain->rebalance_interval && max_seconds * ranks_count(system) > MAX_IMBALANCE * sum;
}

// Makes the columns of the whole system current.
static void leave_local(PhysSystem *system, Domain *domain) {
    if (domain->state == DOMAIN_COLLECTED)
        phys_fill_motion(system);
    domain->state = DOMAIN_NONE;
}

static bool rebalance(PhysSystem *system, Domain *domain) {
    leave_local(system, domain); // so that domain_build_local does not reuse the old local system
    return domain_balance(system, domain) && domain_find_halo(system, domain) && domain_build_local(system, domain);
}

// Divides the system for a frame. Returns false if space cannot be divided into patches, or if out of memory.
static bool divide(PhysSystem *system, Domain *domain, ForceReach reach) {
    if (!prepare_local(system, domain))
        return false;
    bool same = domain->state == DOMAIN_COLLECTED, edited = system->columns_change == COLUMNS_EDITED;
    if (!same) {
        domain->steps = 0;
        domain->rebalance_interval = FIRST_INTERVAL;
    }
    bool must_rebalance = same && is_unbalanced(system, domain);
    if (must_rebalance)
        domain->rebalance_interval *= 2;
    must_rebalance |= !same || domain->reach.contact != reach.contact || domain->reach.bound != reach.bound ||
                      (edited && (!domain->age || sees_farther(system, domain)));
    must_rebalance |= domain->local->column_order != ORDER_FIXED && !phys_can_reorder(system);
    domain->reach = reach;
    if (must_rebalance ? !rebalance(system, domain) : !domain_update_forces(system, domain))
        return false;
    if (!must_rebalance && edited)
        domain_reload(system, domain);
    domain->local->frame = system->frame;
    return true;
}

void domain_begin(PhysSystem *system, const PhysTime *time) {
    ForceReach reach;
    Domain *domain = get_domain(system);
    if (!domain)
        return;
    if (system->columns_change == COLUMNS_FILLED)
        domain->state = DOMAIN_NONE;
    if (pays_off(system, time) && !has_unbounded_force(system, &reach) && divide(system, domain, reach))
        domain->state = DOMAIN_STEPPING;
    else
        leave_local(system, domain); // the local system does not take part in this frame
    system->columns_change = COLUMNS_SAME;
    domain->stats.decomposition = domain->state == DOMAIN_STEPPING ? PETRI_DOMAIN_DECOMPOSED : PETRI_REPLICATED;
}

// Returns true if an owned particle has moved by half the skin, has grown, or has become finite or not finite since the
// halo was built. Needed only if a pass has no list, because lists detect this themselves.
static bool left_skin(const PhysSystem *system, const Domain *domain) {
    const Columns *columns = &domain->local->columns;
    const double *built = domain->built.bytes;
    double max_square = phys_skin_square(domain->survey.skin);
    bool still = domain->built_valid;
    for (uint32_t c = 0; c < system->particle_count && still; c++) {
        if (domain_owners(domain)[c] != ranks_self(system))
            continue;
        uint32_t at = domain_local_column(domain, c);
        double square = 0;
        bool unchanged = true;
        for (size_t k = 0; k < columns->dimensions; k++, built++) {
            double x = columns->position[k * columns->stride + at], d = x - *built;
            unchanged &= isfinite(x) == isfinite(*built);
            square += d * d;
        }
        still = unchanged && !(square > max_square) && !(columns->radius[at] > *built++);
    }
    return !still;
}

static bool rebuild_local(PhysSystem *system, Domain *domain) {
    phys_adapt_skin(&domain->survey, domain->age);
    domain_return_items(system, domain->local);
    return domain_move(system, domain) && domain_find_halo(system, domain) && domain_build_local(system, domain);
}

// Updates the halo, or rebuilds it if any rank requires a rebuild.
static bool update_halo(PhysSystem *system, Domain *domain) {
    if (!domain->age)
        return true;
    if (!domain_exchange(system, domain))
        return false;
    PhysSystem *local = domain->local;
    double votes[2] = {!phys_lists_valid(local, domain->age) || (local->unlisted && left_skin(system, domain)), 0};
    for (int i = 0; i < PHYS_MAX_LISTS; i++)
        votes[1] += phys_list_is_built(&local->lists[i]) ? (double)local->lists[i].padded : 0;
    domain_reduce(system, domain, votes, 2);
    domain->padded = (uint64_t)votes[1] * ranks_count(system);
    return !(votes[0] > 0) || rebuild_local(system, domain);
}

// Takes a step of the local system.
static bool step_local(PhysSystem *system, Domain *domain, double clock, double delta, double speed_of_light) {
    enum { ENTRIES_A_UNIT = 4, NUMBERS_A_UNIT = 32, STEP_WORK = 64, GROUP_WORK = 2 };
    uint64_t work = STEP_WORK + (uint64_t)GROUP_WORK * system->group_count + system->force_count;
    work += system->particle_count * (2 + system->dimensions / NUMBERS_A_UNIT) + domain->padded / ENTRIES_A_UNIT;
    if (!phys_charge(system, work) || !update_halo(system, domain))
        return false;
    double start = clock_read(CLOCK_THREAD_CPUTIME_ID);
    phys_step(domain->local, clock, delta, speed_of_light);
    domain->seconds += clock_read(CLOCK_THREAD_CPUTIME_ID) - start;
    domain->age++;
    domain->steps++;
    uint32_t own = domain_own_count(system, domain);
    domain->stats.own += own;
    domain->stats.halo += domain->local->particle_count - own;
    domain->local->has_forces = true;
    if (domain->local->failed)
        system->failed = true;
    return !system->failed;
}

bool domain_step(PhysSystem *system, double clock, double delta, double speed_of_light) {
    Domain *domain = system->division.bytes;
    if (domain->state == DOMAIN_NONE)
        return phys_step(system, clock, delta, speed_of_light);
    bool done = step_local(system, domain, clock, delta, speed_of_light);
    if (!done)
        domain->state = DOMAIN_NONE;
    return done;
}

bool domain_end(PhysSystem *system, bool keep_last_finite) {
    Domain *domain = system->division.bytes;
    if (domain->state == DOMAIN_NONE) {
        phys_write_rows(system, keep_last_finite);
        return true;
    }
    bool done = domain_collect(system, domain, keep_last_finite);
    domain->state = done ? DOMAIN_COLLECTED : DOMAIN_NONE;
    return done;
}
