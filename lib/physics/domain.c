// domain.c: decides on domain decomposition (domain.h) in each frame, and takes the steps of frames that use it.
#include "physics/domain.h"

#include <time.h>

enum {
    MIN_PARTICLES = 8000, // with fewer particles, communication costs more than it saves
    FIRST_INTERVAL = 32,  // minimum number of steps before the first rebalancing; each rebalancing doubles it
};
// If the largest time of a rank is more than this many times the mean time of all ranks, patches are rebalanced.
#define MAX_IMBALANCE 1.15

// Returns true if a pair force has unlimited range, or if there is no pair force. Otherwise sets reach->contact and
// reach->bound.
static bool has_unbounded_force(const PhysSystem *system, Domain *reach) {
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
    const PhysOptions *options = &system->options;
    bool many = system->particle_count >= MIN_PARTICLES && time->now - time->last > 1.5 * time->resolution;
    return options->ranks.rank_count > 1 && options->neighbours != PHYS_NEIGHBOURS_NEVER &&
           system->dimensions <= PHYS_VECTOR_DIMENSIONS && system->particle_count && (options->ranks.min_pairs || many);
}

static Domain *get_domain(PhysSystem *system) {
    if (!system->domain.bytes) {
        if (!phys_buffer_reserve(system, &system->domain, 0, 1, sizeof(Domain)))
            return NULL;
        memset(system->domain.bytes, 0, sizeof(Domain));
    }
    Domain *domain = system->domain.bytes;
    if (!domain->local && !(domain->local = phys_new())) {
        system->failed = true;
        return NULL;
    }
    PhysOptions options = system->options;
    options.neighbours = PHYS_NEIGHBOURS_ALWAYS;
    options.pool = system->threads;
    options.budget = NULL; // because phys_domain_step charges the system's budget, by the same amount on all ranks
    options.ranks = (PhysRanks){.rank_count = 0};
    if (!system->threads)
        options.threads = 1;
    phys_set_options(domain->local, &options);
    return domain;
}

void phys_domain_free(PhysSystem *system) {
    Domain *domain = system->domain.bytes;
    if (!domain)
        return;
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
    phys_buffer_free(&system->domain);
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
    for (int r = 0; r < system->options.ranks.rank_count; r++) {
        max_seconds = fmax(max_seconds, rank_seconds[r]);
        sum += rank_seconds[r];
    }
    return domain->steps >= domain->rebalance_interval &&
           max_seconds * system->options.ranks.rank_count > MAX_IMBALANCE * sum;
}

static bool rebalance(PhysSystem *system, Domain *domain) {
    if (system->columns_stale)
        phys_fill_motion(system);
    if (!phys_domain_balance(system, domain) || !phys_domain_find_halo(system, domain))
        return false;
    domain->is_valid = false; // so that phys_domain_build_local does not reuse the old local system
    domain->is_valid = phys_domain_build_local(system, domain);
    domain->columns_version = system->columns_version;
    return domain->is_valid;
}

static bool begin_frame(PhysSystem *system, const Domain *reach) {
    Domain *domain = get_domain(system);
    if (!domain)
        return false;
    bool same = domain->is_valid && domain->columns_version == system->columns_version;
    if (!same) {
        domain->steps = 0;
        domain->rebalance_interval = FIRST_INTERVAL;
    }
    bool must_rebalance = same && is_unbalanced(system, domain);
    if (must_rebalance)
        domain->rebalance_interval *= 2;
    must_rebalance |= !same || domain->contact != reach->contact || domain->bound != reach->bound ||
                      (system->edited && (!domain->age || sees_farther(system, domain)));
    bool can_reorder = phys_can_reorder(system);
    must_rebalance |= domain->can_reorder && !can_reorder;
    domain->contact = reach->contact;
    domain->bound = reach->bound;
    domain->can_reorder = can_reorder;
    if (must_rebalance ? !rebalance(system, domain) : !phys_domain_update_forces(system, domain))
        return false;
    if (!must_rebalance && system->edited)
        phys_domain_reload(system, domain);
    domain->local->frame = system->frame;
    return true;
}

bool phys_domain_begin(PhysSystem *system, const PhysTime *time) {
    Domain reach, *domain = system->domain.bytes;
    bool shared = pays_off(system, time) && !has_unbounded_force(system, &reach) && begin_frame(system, &reach);
    if (!shared && domain)
        domain->is_valid = false; // because the local system does not take part in this frame
    if (!shared && system->columns_stale && !system->failed)
        phys_fill_motion(system);
    system->edited = false;
    system->rank_stats.decomposition = shared ? PHYS_DOMAIN_DECOMPOSED : PHYS_REPLICATED;
    return shared;
}

// Returns true if an owned particle has moved by half the skin, has grown, or has become finite or not finite since the
// halo was built. Needed only if a pass has no list, because lists detect this themselves.
static bool left_skin(const PhysSystem *system, const Domain *domain) {
    const Columns *columns = &domain->local->columns;
    const double *built = domain->built.bytes;
    double max_square = phys_skin_square(domain->survey.skin);
    bool still = domain->built_valid;
    for (uint32_t c = 0; c < system->particle_count && still; c++) {
        if (phys_owners(domain)[c] != (uint32_t)system->options.ranks.rank)
            continue;
        uint32_t at = phys_local_column(domain, c);
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
    phys_domain_return_items(system, domain->local);
    return phys_domain_move(system, domain) && phys_domain_find_halo(system, domain) &&
           phys_domain_build_local(system, domain);
}

// Updates the halo, or rebuilds it if any rank requires a rebuild.
static bool update_halo(PhysSystem *system, Domain *domain) {
    const PhysRanks *ranks = &system->options.ranks;
    if (!domain->age)
        return true;
    if (!phys_domain_exchange(system, domain))
        return false;
    PhysSystem *local = domain->local;
    double votes[2] = {!phys_lists_valid(local, domain->age) || (local->unlisted && left_skin(system, domain)), 0};
    for (int i = 0; i < PHYS_MAX_LISTS; i++)
        votes[1] += local->lists[i].built ? (double)local->lists[i].padded : 0;
    ranks->allreduce_max(ranks->user_data, votes, 2);
    system->rank_stats.reductions++;
    system->rank_stats.step_bytes += sizeof votes;
    domain->padded = (uint64_t)votes[1] * (uint64_t)ranks->rank_count;
    return !(votes[0] > 0) || rebuild_local(system, domain);
}

static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

bool phys_domain_step(PhysSystem *system, double clock, double delta, double speed_of_light) {
    enum { ENTRIES_A_UNIT = 4, NUMBERS_A_UNIT = 32, STEP_WORK = 64, GROUP_WORK = 2 };
    Domain *domain = system->domain.bytes;
    uint64_t work = STEP_WORK + (uint64_t)GROUP_WORK * system->group_count + system->force_count;
    work += system->particle_count * (2 + system->dimensions / NUMBERS_A_UNIT) + domain->padded / ENTRIES_A_UNIT;
    if (!phys_charge(system, work) || !update_halo(system, domain)) {
        domain->is_valid = false;
        return false;
    }
    double start = cpu_seconds();
    phys_step(domain->local, clock, delta, speed_of_light);
    domain->seconds += cpu_seconds() - start;
    domain->age++;
    domain->steps++;
    uint32_t own = phys_own_count(system, domain);
    system->rank_stats.own += own;
    system->rank_stats.halo += domain->local->particle_count - own;
    domain->local->has_forces = true;
    if (domain->local->failed)
        system->failed = true;
    return !system->failed;
}
