// domain_local.c: the system that one process simulates: its own particles and its halo, in the order of all.
#include "physics/domain.h"
#include "physics/threads.h"

#include <string.h>

// Marks whom the rank knows and numbers them in the order of the columns.
static bool number_columns(PhysSystem *system, Domain *domain) {
    uint32_t count = system->particle_count, self = (uint32_t)system->options.ranks.rank, next = 0;
    uint32_t halo = domain->from.start[system->options.ranks.count];
    if (!phys_buffer_reserve(system, &domain->columns, 0, 2 * (uint64_t)count, sizeof(uint32_t)))
        return false;
    domain->local_of = domain->columns.bytes;
    domain->column = domain->local_of + count;
    const uint32_t *owners = phys_owners(domain), *items = domain->from.items.bytes;
    for (uint32_t i = 0; i < count; i++)
        domain->local_of[i] = owners[i] == self;
    for (uint32_t i = 0; i < halo; i++)
        domain->local_of[items[i]] = true;
    domain->own_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!domain->local_of[i]) {
            domain->local_of[i] = UINT32_MAX;
            continue;
        }
        domain->own_count += owners[i] == self;
        domain->column[next] = i;
        domain->local_of[i] = next++;
    }
    domain->local->particle_count = next;
    return true;
}

static void localize(const Domain *domain, const Parcels *parcels, uint32_t count) {
    uint32_t *items = parcels->items.bytes;
    for (uint32_t i = 0; i < count; i++)
        items[i] = domain->local_of[items[i]];
}

static bool take_groups(const PhysSystem *system, const Domain *domain) {
    PhysSystem *local = domain->local;
    const Group *groups = system->groups.bytes;
    local->group_count = system->group_count;
    if (!phys_buffer_reserve(local, &local->groups, 0, system->group_count, sizeof(Group)))
        return false;
    Group *own = local->groups.bytes;
    uint32_t next = 0;
    for (uint32_t g = 0; g < system->group_count; g++) {
        uint32_t end = groups[g].first + groups[g].count;
        own[g] = groups[g];
        own[g].first = next;
        while (next < local->particle_count && domain->column[next] < end)
            next++;
        own[g].count = next - own[g].first;
    }
    return true;
}

// How many particles of its group come before each, anchors apart: where it is in the streams of random numbers.
static bool count_movers(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    Group *groups = system->groups.bytes;
    if (!phys_buffer_reserve(system, &domain->movers, 0, system->particle_count, sizeof(uint32_t)))
        return false;
    uint32_t *movers = domain->movers.bytes;
    for (uint32_t g = 0; g < system->group_count; g++) {
        groups[g].movers = 0;
        for (uint32_t i = groups[g].first; i < groups[g].first + groups[g].count; i++) {
            movers[i] = groups[g].movers;
            groups[g].movers += !columns->anchor[i];
        }
    }
    return true;
}

static bool is_needed(const PhysSystem *system, ForceNeed need) {
    const Force *forces = system->forces.bytes;
    for (uint32_t f = 0; f < system->force_count; f++)
        if (phys_force_row(forces[f].given.kind).need == need)
            return true;
    return false;
}

static bool take_draws(PhysSystem *system, Domain *domain) {
    Columns *own = &domain->local->columns;
    own->draws = NULL;
    if (!is_needed(system, NEED_STREAM))
        return true;
    if (!phys_buffer_reserve(system, &domain->draws, 0, own->count, sizeof(uint32_t)) || !count_movers(system, domain))
        return false;
    uint32_t *draws = domain->draws.bytes;
    for (uint32_t i = 0; i < own->count; i++)
        draws[i] = ((const uint32_t *)domain->movers.bytes)[domain->column[i]];
    Group *groups = domain->local->groups.bytes;
    for (uint32_t g = 0; g < system->group_count; g++)
        groups[g].movers = ((const Group *)system->groups.bytes)[g].movers;
    own->draws = draws;
    return true;
}

static void take(const uint32_t *column, size_t first, size_t end, const double *from, double *to) {
    for (size_t i = first; i < end; i++)
        to[i] = from[column[i]];
}

typedef struct Taking {
    const PhysSystem *system;
    const Domain *domain;
    bool all; // not only what a frame changes
} Taking;

static void take_share(void *context, int share, int shares) {
    const Taking *taking = context;
    const PhysSystem *system = taking->system;
    const Columns *from = &system->columns, *to = &taking->domain->local->columns;
    const uint32_t *column = taking->domain->column;
    size_t first = phys_share(to->count, share, shares), end = phys_share(to->count, share + 1, shares);
    for (size_t k = 0; k < to->dimensions && first < end; k++) {
        size_t there = k * from->stride, here = k * to->stride;
        take(column, first, end, from->position + there, to->position + here);
        take(column, first, end, from->velocity + there, to->velocity + here);
        if (taking->all && system->has_own_forces)
            take(column, first, end, from->own_force + there, to->own_force + here);
    }
    if (!taking->all)
        return;
    take(column, first, end, from->radius, to->radius);
    take(column, first, end, from->mass, to->mass);
    take(column, first, end, from->charge, to->charge);
    if (is_needed(system, NEED_SECTION))
        take(column, first, end, from->section, to->section);
    if (is_needed(system, NEED_VOLUME))
        take(column, first, end, from->volume, to->volume);
    if (system->has_eased_forces)
        take(column, first, end, from->ease, to->ease);
}

void phys_domain_reload(const PhysSystem *system, Domain *domain, bool all) {
    PhysSystem *local = domain->local;
    Taking taking = {system, domain, all};
    local->radii += all;
    phys_parallel(local, phys_shares(local, local->particle_count, PHYS_MIN_FOR_THREADS), take_share, &taking);
}

static bool take_particles(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    local->dimensions = system->dimensions;
    local->has_own_forces = system->has_own_forces;
    local->has_eased_forces = system->has_eased_forces;
    if (!phys_reserve_columns(local) ||
        !phys_buffer_reserve(system, &domain->own, 0, domain->own_count, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->foreign, 0, local->particle_count, sizeof(bool)) ||
        !phys_buffer_reserve(system, &domain->built, 0, (system->dimensions + 1) * (uint64_t)domain->own_count,
                             sizeof(double)))
        return false;
    phys_domain_reload(system, domain, true);
    const uint32_t *owners = phys_owners(domain);
    bool *foreign = domain->foreign.bytes;
    uint32_t *own = domain->own.bytes;
    for (uint32_t i = 0; i < local->particle_count; i++) {
        foreign[i] = owners[domain->column[i]] != (uint32_t)system->options.ranks.rank;
        local->columns.anchor[i] = foreign[i] || system->columns.anchor[domain->column[i]];
        if (!foreign[i])
            *own++ = i;
    }
    local->foreign = foreign;
    return true;
}

// Where own particles were when the halo was made, and how large.
static void note_places(const Domain *domain) {
    const Columns *columns = &domain->local->columns;
    const uint32_t *own = domain->own.bytes;
    double *built = domain->built.bytes;
    for (size_t k = 0; k < columns->dimensions && domain->own_count; k++, built += domain->own_count)
        take(own, 0, domain->own_count, columns->position + k * columns->stride, built);
    take(own, 0, domain->own_count, columns->radius, built);
}

bool phys_domain_gather(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    if (!number_columns(system, domain) || !take_groups(system, domain) || !take_particles(system, domain) ||
        !phys_domain_take_forces(system, domain))
        return false;
    uint32_t ranks = (uint32_t)system->options.ranks.count;
    localize(domain, &domain->to, domain->to.start[ranks]);
    localize(domain, &domain->from, domain->from.start[ranks]);
    note_places(domain);
    phys_lists_drop(local, domain->survey.skin);
    local->unlisted = false;
    domain->age = 0;
    return true;
}

// A link that acts on own particles has both ends here; others are left out.
static bool take_force(const PhysSystem *system, const Domain *domain, Force *force) {
    if (phys_force_row(force->given.kind).stage != STAGE_LINK)
        return true;
    uint32_t self = (uint32_t)system->options.ranks.rank, from = force->given.from, to = force->given.to;
    const uint32_t *owners = phys_owners(domain);
    force->given.from = domain->local_of[from];
    force->given.to = domain->local_of[to];
    return (owners[from] == self || owners[to] == self) && from != to;
}

bool phys_domain_take_forces(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    uint64_t slots = (uint64_t)system->group_count * STAGE_COUNT;
    if (!phys_buffer_reserve(local, &local->indices, 0, slots + 1, sizeof(uint32_t)) ||
        !phys_buffer_reserve(local, &local->forces, 0, system->force_count, sizeof(Force)) ||
        !phys_buffer_reserve(local, &local->terms, 0, system->force_count, sizeof(PairTerm)) ||
        !phys_buffer_reserve(local, &local->chain, 0, system->force_count, sizeof(Force *)))
        return false;
    const Force *all = system->forces.bytes;
    Force *forces = local->forces.bytes;
    local->starts = local->indices.bytes;
    uint32_t count = 0;
    for (uint64_t s = 0; s < slots; s++) {
        local->starts[s] = count;
        for (uint32_t f = system->starts[s]; f < system->starts[s + 1]; f++) {
            forces[count] = all[f];
            count += take_force(system, domain, &forces[count]);
        }
    }
    local->starts[slots] = local->force_count = count;
    phys_link_groups(local);
    return take_draws(system, domain);
}

// How far the streams of random numbers are: the same on all ranks.
static void give_back_items(PhysSystem *system, const PhysSystem *local) {
    Force *to = system->forces.bytes;
    const Force *from = local->forces.bytes;
    for (uint64_t s = STAGE_SINGLE; s < (uint64_t)system->group_count * STAGE_COUNT; s += STAGE_COUNT)
        for (uint32_t f = 0; f < system->starts[s + 1] - system->starts[s]; f++)
            to[system->starts[s] + f].item = from[local->starts[s] + f].item;
}

void phys_domain_give_back(PhysSystem *system, const Domain *domain) {
    give_back_items(system, domain->local);
    const Columns *from = &domain->local->columns, *to = &system->columns;
    const uint32_t *own = domain->own.bytes;
    for (size_t k = 0; k < to->dimensions; k++)
        for (uint32_t i = 0; i < domain->own_count; i++) {
            size_t here = k * from->stride + own[i], there = k * to->stride + domain->column[own[i]];
            to->position[there] = from->position[here];
            to->velocity[there] = from->velocity[here];
        }
}
