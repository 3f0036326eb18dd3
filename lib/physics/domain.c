// domain.c: see domain.h. What the ranks do in a frame.
#include "physics/domain.h"

#include <time.h>

enum {
    WORTH_PARTICLES = 8000, // for fewer it is not worth it
    PATIENCE_FIRST = 32,    // steps before plots are dealt out again, at first; doubled each time
};
#define UNEVEN 1.15 // the longest work of a rank, divided by the mean, that lets plots be dealt out again

static bool any_far(const PhysSystem *system, Domain *reach) {
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

// Making particles whole at the end of a frame takes about as long as one step.
static bool worth(const PhysSystem *system, const PhysTime *time) {
    const PhysOptions *options = &system->options;
    bool many = system->particle_count >= WORTH_PARTICLES && time->now - time->last > 1.5 * time->resolution;
    return options->ranks.count > 1 && options->neighbours != PHYS_NEIGHBOURS_NEVER &&
           system->dimensions <= PHYS_VECTOR_DIMENSIONS && system->particle_count && (options->ranks.least || many);
}

static Domain *domain_of(PhysSystem *system) {
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
    options.meter = NULL; // all ranks charge the same, whatever their part
    options.ranks = (PhysRanks){.count = 0};
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
        &domain->plot_owners, &domain->inland,     &domain->owners,  &domain->counts,        &domain->foreign,
        &domain->built,       &domain->movers,     &domain->draws,   &domain->to.starts,     &domain->to.items,
        &domain->from.starts, &domain->from.items, &domain->parcels, &domain->table,         &domain->numbers,
        &domain->whole,       &domain->starts,     &domain->loads,   &domain->shore.columns, &domain->fresh.columns,
        &domain->sources,     &domain->spare,      &domain->orders,  &domain->last_orders,   &domain->places};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        phys_buffer_free(buffers[i]);
    phys_neighbours_free(&domain->survey);
    phys_free(domain->local);
    phys_buffer_free(&system->domain);
}

// Some particle sees farther than the halo was made for.
static bool grown(const PhysSystem *system, const Domain *domain) {
    const double *radius = system->columns.radius;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        if (!(radius[i] > domain->widest))
            continue;
        bool large = false;
        for (uint32_t l = 0; l < domain->large_count; l++)
            large |= domain->large[l] == i;
        if (!large)
            return true;
    }
    return false;
}

// Has the work turned out uneven? All ranks know the same.
static bool uneven(const PhysSystem *system, const Domain *domain) {
    const double *loads = domain->loads.bytes;
    double longest = 0, sum = 0;
    for (int r = 0; r < system->options.ranks.count; r++) {
        longest = fmax(longest, loads[r]);
        sum += loads[r];
    }
    return domain->steps >= domain->patience && longest * system->options.ranks.count > UNEVEN * sum;
}

static bool deal(PhysSystem *system, Domain *domain) {
    if (system->behind)
        phys_load_motion(system);
    if (!phys_domain_deal(system, domain) || !phys_domain_find_halo(system, domain))
        return false;
    domain->made = false; // for what is there is not to be taken along
    domain->made = phys_domain_gather(system, domain);
    domain->arrangement = system->arrangement;
    return domain->made;
}

static bool begin(PhysSystem *system, const Domain *reach) {
    Domain *domain = domain_of(system);
    if (!domain)
        return false;
    bool same = domain->made && domain->arrangement == system->arrangement;
    if (!same) {
        domain->steps = 0;
        domain->patience = PATIENCE_FIRST;
    }
    bool again = same && uneven(system, domain);
    if (again)
        domain->patience *= 2;
    again |= !same || domain->contact != reach->contact || domain->bound != reach->bound ||
             (system->touched && (!domain->age || grown(system, domain)));
    bool may_settle = phys_can_settle(system);
    again |= domain->may_settle && !may_settle;
    domain->contact = reach->contact;
    domain->bound = reach->bound;
    domain->may_settle = may_settle;
    if (again ? !deal(system, domain) : !phys_domain_take_forces(system, domain))
        return false;
    if (!again && system->touched)
        phys_domain_reload(system, domain);
    domain->local->frame = system->frame;
    return true;
}

bool phys_domain_begin(PhysSystem *system, const PhysTime *time) {
    Domain reach, *domain = system->domain.bytes;
    bool shared = worth(system, time) && !any_far(system, &reach) && begin(system, &reach);
    if (!shared && domain)
        domain->made = false; // it does not know of what happens in this frame
    if (!shared && system->behind && !system->failed)
        phys_load_motion(system);
    system->touched = false;
    system->traffic.sharing = shared ? PHYS_BY_REGION : PHYS_ALONE;
    return shared;
}

// Has an own particle left its skin, or grown? For forces that have no lists, which would tell.
static bool stirred(const PhysSystem *system, const Domain *domain) {
    const Columns *columns = &domain->local->columns;
    const double *built = domain->built.bytes;
    double most = phys_skin_square(domain->survey.skin);
    bool still = domain->noted;
    for (uint32_t c = 0; c < system->particle_count && still; c++) {
        if (phys_owners(domain)[c] != (uint32_t)system->options.ranks.rank)
            continue;
        uint32_t at = phys_local_column(domain, c);
        double square = 0;
        bool finite = true;
        for (size_t k = 0; k < columns->dimensions; k++, built++) {
            double x = columns->position[k * columns->stride + at], d = x - *built;
            finite &= isfinite(x) || !isfinite(*built);
            square += d * d;
        }
        still = finite && !(square > most) && !(columns->radius[at] > *built++);
    }
    return !still;
}

static bool move_on(PhysSystem *system, Domain *domain) {
    phys_adapt_skin(&domain->survey, domain->age);
    phys_domain_give_back_items(system, domain->local);
    return phys_domain_move(system, domain) && phys_domain_find_halo(system, domain) &&
           phys_domain_gather(system, domain);
}

// Brings the halo up to date, with a new one if some rank needs it.
static bool prepare(PhysSystem *system, Domain *domain) {
    const PhysRanks *ranks = &system->options.ranks;
    if (!domain->age)
        return true;
    if (!phys_domain_exchange(system, domain))
        return false;
    PhysSystem *local = domain->local;
    double news[2] = {!phys_lists_hold(local, domain->age) || (local->unlisted && stirred(system, domain)), 0};
    for (int i = 0; i < PHYS_MOST_LISTS; i++)
        news[1] += local->lists[i].built ? (double)local->lists[i].padded : 0;
    ranks->most(ranks->host, news, 2);
    system->traffic.reductions++;
    system->traffic.step_bytes += sizeof news;
    domain->padded = (uint64_t)news[1] * (uint64_t)ranks->count;
    return !(news[0] > 0) || move_on(system, domain);
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

bool phys_domain_step(PhysSystem *system, double clock, double delta, double speed_of_light) {
    enum { ENTRIES_A_UNIT = 4, NUMBERS_A_UNIT = 32, STEP_WORK = 64, GROUP_WORK = 2 };
    Domain *domain = system->domain.bytes;
    uint64_t work = STEP_WORK + (uint64_t)GROUP_WORK * system->group_count + system->force_count;
    work += system->particle_count * (2 + system->dimensions / NUMBERS_A_UNIT) + domain->padded / ENTRIES_A_UNIT;
    if (!phys_charge(system, work) || !prepare(system, domain)) {
        domain->made = false;
        return false;
    }
    double start = seconds();
    phys_step(domain->local, clock, delta, speed_of_light);
    domain->seconds += seconds() - start;
    domain->age++;
    domain->steps++;
    uint32_t own = phys_own_count(system, domain);
    system->traffic.own += own;
    system->traffic.halo += domain->local->particle_count - own;
    domain->local->stepped = true;
    if (domain->local->failed)
        system->failed = true;
    return !system->failed;
}
