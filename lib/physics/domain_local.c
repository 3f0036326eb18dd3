// domain_local.c: the system that one process simulates: its own particles and its halo.
//
// Its handles are the columns of the whole system, so they are in the order of all, with gaps. Its columns are in that
// order, too, or else in that of a list (settle.c): then own particles stay where they are when a new halo comes, and
// fresh ones take the places of those that have gone.
#include "physics/domain.h"
#include "physics/threads.h"

#include <stdlib.h>
#include <string.h>

enum { LINE = 8 }; // particles, by which the room for columns is rounded up

static int by_number(const void *left, const void *right) {
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

static void put(const Domain *domain, uint32_t here, uint32_t column, uint32_t source) {
    domain->local->order[here] = column;
    domain->local->place[column] = here;
    ((uint32_t *)domain->sources.bytes)[here] = source;
}

// Room for columns in order, and for more than there are now.
static bool reserve(PhysSystem *system, Domain *domain, uint64_t count) {
    Buffer orders = domain->last_orders;
    domain->last_orders = domain->orders;
    domain->orders = orders;
    if (!phys_buffer_reserve(system, &domain->orders, 0, count, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->sources, 0, count, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->places, 0, system->particle_count, sizeof(uint32_t)))
        return false;
    domain->local->order = domain->orders.bytes;
    domain->local->place = domain->places.bytes;
    domain->local->places = system->particle_count;
    return true;
}

// Orders all columns anew. Without a local system before, own particles come from the system's columns.
static bool order_columns(PhysSystem *system, Domain *domain, uint32_t spare) {
    PhysSystem *local = domain->local;
    uint32_t self = (uint32_t)system->options.ranks.rank, fresh = domain->fresh.count, next = 0, here = 0;
    const uint32_t *last_order = local->order, *owners = phys_owners(domain), *come = domain->fresh.columns.bytes;
    const bool *foreign = local->foreign;
    uint64_t last = domain->made ? local->particle_count : phys_own_count(system, domain);
    if (!reserve(system, domain, last + fresh + spare + LINE))
        return false;
    if (!domain->made) {
        memset(local->place, 0xff, system->particle_count * sizeof *local->place); // NO_PLACE
        phys_forget_order(local);
    }
    for (uint32_t i = 0, end = domain->made ? local->particle_count : system->particle_count; i < end; i++) {
        uint32_t column = domain->made ? last_order[i] : i;
        if (domain->made ? foreign[i] : owners[i] != self)
            continue;
        for (; !local->settled && next < fresh && come[next] < column; next++)
            put(domain, here++, come[next], 0);
        put(domain, here++, column, i);
    }
    for (; next < fresh; next++)
        put(domain, here++, come[next], 0);
    local->particle_count = here;
    return true;
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
        bool last = g + 1 == system->group_count;
        while (!last && next < local->particle_count && local->order[next] < end)
            next++;
        next = last ? local->particle_count : next;
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
        draws[i] = ((const uint32_t *)domain->movers.bytes)[domain->local->order[i]];
    Group *groups = domain->local->groups.bytes;
    for (uint32_t g = 0; g < system->group_count; g++)
        groups[g].movers = ((const Group *)system->groups.bytes)[g].movers;
    own->draws = draws;
    return true;
}

static void fill(size_t first, size_t end, double number, double *to) {
    for (size_t i = first; i < end; i++)
        to[i] = number;
}

static void take(const uint32_t *column, size_t first, size_t end, const double *from, double *to) {
    for (size_t i = first; i < end; i++)
        to[i] = from[column[i]];
}

typedef struct Taking {
    const PhysSystem *system;
    const Domain *domain;
    Columns from;
    const uint32_t *sources; // columns of `from` by column
} Taking;

static void take_attributes(const Taking *taking, size_t first, size_t end) {
    const PhysSystem *system = taking->system;
    const Columns *from = &taking->from, *to = &taking->domain->local->columns;
    const uint32_t *sources = taking->sources;
    double *numbers[][2] = {{from->radius, to->radius}, {from->mass, to->mass}, {from->charge, to->charge}};
    for (int i = 0; i < 3; i++)
        if (system->record_stride)
            take(sources, first, end, numbers[i][0], numbers[i][1]);
        else // all have the same
            fill(first, end, numbers[i][0][sources[first]], numbers[i][1]);
    if (is_needed(system, NEED_SECTION))
        take(sources, first, end, from->section, to->section);
    if (is_needed(system, NEED_VOLUME))
        take(sources, first, end, from->volume, to->volume);
    if (system->has_eased_forces)
        take(sources, first, end, from->ease, to->ease);
    for (size_t k = 0; k < to->dimensions && system->has_own_forces; k++)
        take(sources, first, end, from->own_force + k * from->stride, to->own_force + k * to->stride);
}

static void take_range(const Taking *taking, size_t first, size_t end) {
    const Columns *from = &taking->from, *to = &taking->domain->local->columns;
    if (first == end)
        return; // a rank without particles has no columns
    for (size_t k = 0; k < to->dimensions; k++) {
        take(taking->sources, first, end, from->position + k * from->stride, to->position + k * to->stride);
        take(taking->sources, first, end, from->velocity + k * from->stride, to->velocity + k * to->stride);
    }
    for (size_t i = first; i < end; i++)
        to->anchor[i] = from->anchor[taking->sources[i]];
    take_attributes(taking, first, end);
}

static void take_share(void *context, int share, int shares) {
    const Taking *taking = context;
    uint32_t count = taking->domain->local->columns.count;
    take_range(taking, phys_share(count, share, shares), phys_share(count, share + 1, shares));
}

// Attributes are in the system's columns, the rest is in the rows.
static void reload_share(void *context, int share, int shares) {
    const Taking *taking = context;
    const PhysSystem *system = taking->system;
    const Columns *to = &taking->domain->local->columns;
    size_t n = to->dimensions, first = phys_share(to->count, share, shares);
    size_t end = phys_share(to->count, share + 1, shares);
    for (size_t i = first; i < end; i++) {
        const double *row = phys_row(system, system->order[taking->sources[i]]);
        for (size_t k = 0; k < n; k++) {
            to->position[k * to->stride + i] = row[k];
            to->velocity[k * to->stride + i] = row[n + k];
        }
    }
    if (first < end)
        take_attributes(taking, first, end);
}

static int shares_for(const PhysSystem *local) {
    return phys_shares(local, local->particle_count, PHYS_MIN_FOR_THREADS);
}

void phys_domain_reload(const PhysSystem *system, Domain *domain) {
    Taking taking = {system, domain, system->columns, domain->local->order};
    domain->local->radii++;
    domain->local->motion++;
    phys_parallel(domain->local, shares_for(domain->local), reload_share, &taking);
}

static void take_fresh(const PhysSystem *system, const Domain *domain) {
    const Columns *to = &domain->local->columns;
    const uint32_t *fresh = domain->fresh.columns.bytes, *owners = phys_owners(domain);
    uint32_t *sources = domain->sources.bytes;
    Taking taking = {system, domain, system->columns, sources};
    for (uint32_t f = 0; f < domain->fresh.count; f++) {
        uint32_t here = phys_local_column(domain, fresh[f]);
        sources[here] = fresh[f];
        take_range(&taking, here, here + 1);
        for (size_t k = 0; k < to->dimensions; k++)
            to->force[k * to->stride + here] = 0;
        domain->local->foreign[here] = owners[fresh[f]] != (uint32_t)system->options.ranks.rank;
        to->anchor[here] |= domain->local->foreign[here];
    }
}

// The numbers of all into new columns, with some room behind them.
static bool take_all(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    uint32_t spare = phys_own_count(system, domain) / 32 + 256;
    const Columns last = local->columns;
    if (!order_columns(system, domain, spare))
        return false;
    Taking taking = {system, domain, domain->made ? last : system->columns, domain->sources.bytes};
    Buffer memory = domain->spare;
    domain->spare = local->column_data;
    local->column_data = memory;
    local->dimensions = system->dimensions;
    local->has_own_forces = system->has_own_forces;
    local->has_eased_forces = system->has_eased_forces;
    if (!phys_buffer_reserve(system, &domain->foreign, 0, (uint64_t)local->particle_count + spare + LINE,
                             sizeof(bool)) ||
        !phys_reserve_columns(local, spare))
        return false;
    local->foreign = domain->foreign.bytes;
    memset(local->foreign, false, local->columns.stride);
    if (taking.from.count)
        phys_parallel(local, shares_for(local), take_share, &taking);
    return true;
}

// Those that have gone leave their columns to fresh ones, or to the last.
static void fill_gaps(const PhysSystem *system, const Domain *domain) {
    PhysSystem *local = domain->local;
    const uint32_t *come = domain->fresh.columns.bytes;
    uint32_t count = local->particle_count, next = 0;
    Taking taking = {system, domain, local->columns, domain->sources.bytes};
    for (uint32_t i = phys_next_foreign(local, 0); i < count; i = phys_next_foreign(local, i + 1)) {
        if (next < domain->fresh.count) {
            put(domain, i, come[next], 0);
            next++;
            continue;
        }
        while (--count > i && local->foreign[count])
            ;
        if (count == i)
            break;
        put(domain, i, local->order[count], count);
        take_range(&taking, i, (size_t)i + 1);
        local->foreign[i] = false;
    }
    for (; next < domain->fresh.count; next++)
        put(domain, count++, come[next], 0);
    local->particle_count = local->columns.count = count;
}

// The particles whom the rank knows from now on.
static bool take_particles(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    uint32_t fresh = domain->fresh.count;
    if (fresh)
        qsort(domain->fresh.columns.bytes, fresh, sizeof(uint32_t), by_number);
    uint32_t i = domain->made ? phys_next_foreign(local, 0) : local->particle_count;
    for (; i < local->particle_count; i = phys_next_foreign(local, i + 1))
        local->place[local->order[i]] = NO_PLACE;
    if (domain->made && local->settled && (uint64_t)local->particle_count + fresh <= local->columns.stride)
        fill_gaps(system, domain);
    else if (!take_all(system, domain))
        return false;
    local->radii++;
    take_fresh(system, domain);
    return true;
}

// Where own particles were when the halo was made, and how large, if some pass had no list so far.
static bool note_places(PhysSystem *system, Domain *domain) {
    const Columns *columns = &domain->local->columns;
    size_t n = columns->dimensions;
    domain->noted = domain->local->unlisted;
    if (!domain->noted)
        return true;
    if (!phys_buffer_reserve(system, &domain->built, 0, (n + 1) * (uint64_t)phys_own_count(system, domain),
                             sizeof(double)))
        return false;
    double *built = domain->built.bytes;
    for (uint32_t c = 0; c < system->particle_count; c++) {
        if (phys_owners(domain)[c] != (uint32_t)system->options.ranks.rank)
            continue;
        size_t at = phys_local_column(domain, c);
        for (size_t k = 0; k < n; k++)
            *built++ = columns->position[k * columns->stride + at];
        *built++ = columns->radius[at];
    }
    return true;
}

bool phys_domain_gather(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    if (!take_particles(system, domain) || !take_groups(system, domain) || !phys_domain_take_forces(system, domain) ||
        !note_places(system, domain)) {
        system->failed = true;
        return false;
    }
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
    force->given.from = phys_local_column(domain, from);
    force->given.to = phys_local_column(domain, to);
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
    local->record_stride = system->record_stride;
    local->may_settle = domain->may_settle;
    return take_draws(system, domain);
}

void phys_domain_give_back_items(PhysSystem *system, const PhysSystem *local) {
    Force *to = system->forces.bytes;
    const Force *from = local->forces.bytes;
    for (uint64_t s = STAGE_SINGLE; s < (uint64_t)system->group_count * STAGE_COUNT; s += STAGE_COUNT)
        for (uint32_t f = 0; f < system->starts[s + 1] - system->starts[s]; f++)
            to[system->starts[s] + f].item = from[local->starts[s] + f].item;
}
