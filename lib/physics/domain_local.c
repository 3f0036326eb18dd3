// domain_local.c: the system that one process simulates: its own particles and its halo.
//
// Local numbers count them in the order of all. The columns are in that order, too, or else in that of a list
// (settle.c): then own particles keep it when a new halo comes, and fresh ones are put behind them.
#include "physics/domain.h"
#include "physics/threads.h"

#include <stdlib.h>
#include <string.h>

static int by_number(const void *left, const void *right) {
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

static void put(Domain *domain, uint32_t column, uint32_t source, bool own) {
    uint32_t number = domain->local->particle_count++;
    domain->column[number] = column;
    domain->local_of[column] = number;
    ((uint32_t *)domain->sources.bytes)[number] = source;
    if (own)
        ((uint32_t *)domain->own.bytes)[domain->own_count++] = number;
}

// Without a local system before: all own particles, whose numbers are in the system's columns.
static bool list_own(PhysSystem *system, Domain *domain) {
    uint32_t self = (uint32_t)system->options.ranks.rank, next = 0;
    const uint32_t *owners = phys_owners(domain);
    if (!phys_buffer_reserve(system, &domain->local_numbers, 0, system->particle_count, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->columns, 0, ((uint32_t *)domain->counts.bytes)[self], sizeof(uint32_t)))
        return false;
    domain->local_of = domain->local_numbers.bytes;
    domain->column = domain->columns.bytes;
    for (uint32_t i = 0; i < system->particle_count; i++)
        if (owners[i] == self)
            domain->column[next++] = i;
        else
            domain->local_of[i] = UINT32_MAX;
    domain->local->particle_count = next;
    return true;
}

// Numbers whom the rank knows from now on in the order of the system's columns: own particles that stay, and fresh
// ones.
static bool number_columns(PhysSystem *system, Domain *domain) {
    uint32_t self = (uint32_t)system->options.ranks.rank, fresh = domain->fresh.count, next = 0;
    if (!domain->made && !list_own(system, domain))
        return false;
    Buffer columns = domain->columns;
    domain->columns = domain->last_columns;
    domain->last_columns = columns;
    uint32_t last = domain->local->particle_count;
    const uint32_t *last_column = columns.bytes, *owners = phys_owners(domain);
    const bool *foreign = domain->made ? domain->foreign.bytes : NULL;
    uint32_t *come = domain->fresh.columns.bytes;
    if (!phys_buffer_reserve(system, &domain->columns, 0, (uint64_t)last + fresh, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->sources, 0, (uint64_t)last + fresh, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->renumbered, 0, last, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->own, 0, ((const uint32_t *)domain->counts.bytes)[self], sizeof(uint32_t)))
        return false;
    uint32_t *renumbered = domain->renumbered.bytes;
    domain->column = domain->columns.bytes;
    domain->local->particle_count = domain->own_count = 0;
    if (fresh)
        qsort(come, fresh, sizeof *come, by_number);
    for (uint32_t i = 0; i < last; i++) {
        uint32_t column = last_column[i];
        domain->local_of[column] = renumbered[i] = UINT32_MAX;
        if (owners[column] != self || (foreign && foreign[phys_local_column(domain, i)]))
            continue;
        for (; next < fresh && come[next] < column; next++)
            put(domain, come[next], 0, owners[come[next]] == self);
        renumbered[i] = domain->local->particle_count;
        put(domain, column, foreign ? i : column, true);
    }
    for (; next < fresh; next++)
        put(domain, come[next], 0, owners[come[next]] == self);
    return true;
}

// Which column each gets.
static bool order_columns(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    Buffer orders = domain->last_orders;
    domain->last_orders = domain->orders;
    domain->orders = orders;
    // One at least: there is no place in nothing.
    if (!phys_buffer_reserve(system, &domain->orders, 0, 2 * (uint64_t)local->particle_count + 1, sizeof(uint32_t)))
        return false;
    const uint32_t *last_order = local->order, *renumbered = domain->renumbered.bytes;
    uint32_t *sources = domain->sources.bytes, last = local->columns.count, next = 0;
    local->order = domain->orders.bytes;
    local->place = local->order + local->particle_count;
    if (!domain->made)
        phys_forget_order(local);
    if (!local->settled)
        for (; next < local->particle_count; next++)
            local->order[next] = local->place[next] = next;
    for (uint32_t i = 0; local->settled && i < last; i++)
        if (renumbered[last_order[i]] != UINT32_MAX) {
            local->order[next] = renumbered[last_order[i]];
            sources[next++] = i;
        }
    const uint32_t *fresh = domain->fresh.columns.bytes;
    for (uint32_t f = 0; next < local->particle_count; f++) {
        local->order[next] = domain->local_of[fresh[f]];
        sources[next++] = 0;
    }
    for (uint32_t i = 0; i < next; i++)
        local->place[local->order[i]] = i;
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

static void take_share(void *context, int share, int shares) {
    const Taking *taking = context;
    const Columns *from = &taking->from, *to = &taking->domain->local->columns;
    size_t first = phys_share(to->count, share, shares), end = phys_share(to->count, share + 1, shares);
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

// Attributes are in the system's columns, the rest is in the rows.
static void reload_share(void *context, int share, int shares) {
    const Taking *taking = context;
    const PhysSystem *system = taking->system;
    const Columns *to = &taking->domain->local->columns;
    size_t n = to->dimensions, first = phys_share(to->count, share, shares);
    size_t end = phys_share(to->count, share + 1, shares);
    if (first == end)
        return;
    for (size_t i = first; i < end; i++) {
        const double *row = phys_row(system, system->order[taking->sources[i]]);
        for (size_t k = 0; k < n; k++) {
            to->position[k * to->stride + i] = row[k];
            to->velocity[k * to->stride + i] = row[n + k];
        }
    }
    take_attributes(taking, first, end);
}

static int shares_for(const PhysSystem *local) {
    return phys_shares(local, local->particle_count, PHYS_MIN_FOR_THREADS);
}

void phys_domain_reload(const PhysSystem *system, Domain *domain) {
    uint32_t *sources = domain->sources.bytes;
    for (uint32_t i = 0; i < domain->local->particle_count; i++)
        sources[i] = domain->column[domain->local->order[i]];
    Taking taking = {system, domain, system->columns, sources};
    domain->local->radii++;
    phys_parallel(domain->local, shares_for(domain->local), reload_share, &taking);
}

static void take_fresh(const PhysSystem *system, const Domain *domain) {
    const Columns *from = &system->columns, *to = &domain->local->columns;
    const uint32_t *fresh = domain->fresh.columns.bytes;
    uint32_t *sources = domain->sources.bytes;
    Taking taking = {system, domain, *from, sources};
    for (uint32_t f = 0; f < domain->fresh.count; f++) {
        size_t here = phys_local_column(domain, domain->local_of[fresh[f]]);
        sources[here] = fresh[f];
        for (size_t k = 0; k < to->dimensions; k++) {
            to->position[k * to->stride + here] = from->position[k * from->stride + fresh[f]];
            to->velocity[k * to->stride + here] = from->velocity[k * from->stride + fresh[f]];
        }
        take_attributes(&taking, here, here + 1);
    }
}

// The numbers of all into new columns.
static bool take_numbers(const PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    Taking taking = {system, domain, domain->made ? local->columns : system->columns, domain->sources.bytes};
    Buffer memory = domain->spare;
    domain->spare = local->column_data;
    local->column_data = memory;
    local->dimensions = system->dimensions;
    local->has_own_forces = system->has_own_forces;
    local->has_eased_forces = system->has_eased_forces;
    if (!phys_reserve_columns(local))
        return false;
    local->radii++;
    if (taking.from.count)
        phys_parallel(local, shares_for(local), take_share, &taking);
    take_fresh(system, domain);
    return true;
}

static void mark_fresh(const PhysSystem *system, const Domain *domain, bool *foreign) {
    const uint32_t *fresh = domain->fresh.columns.bytes, *owners = phys_owners(domain);
    for (uint32_t f = 0; f < domain->fresh.count; f++) {
        uint32_t at = phys_local_column(domain, domain->local_of[fresh[f]]);
        foreign[at] = owners[fresh[f]] != (uint32_t)system->options.ranks.rank;
        domain->local->columns.anchor[at] = foreign[at] || system->columns.anchor[fresh[f]];
    }
}

static bool take_particles(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    if (!take_numbers(system, domain) ||
        !phys_buffer_reserve(system, &domain->foreign, 0, local->particle_count, sizeof(bool)))
        return false;
    local->foreign = domain->foreign.bytes;
    if (local->particle_count)
        memset(local->foreign, false, local->particle_count);
    mark_fresh(system, domain, local->foreign);
    return true;
}

static void take_placed(const Domain *domain, const double *from, double *to) {
    const uint32_t *own = domain->own.bytes;
    for (uint32_t i = 0; i < domain->own_count; i++)
        to[i] = from[phys_local_column(domain, own[i])];
}

// Where own particles were when the halo was made, and how large, if some pass had no list so far.
static bool note_places(PhysSystem *system, Domain *domain) {
    const Columns *columns = &domain->local->columns;
    domain->noted = domain->local->unlisted;
    if (!domain->noted)
        return true;
    if (!phys_buffer_reserve(system, &domain->built, 0, (columns->dimensions + 1) * (uint64_t)domain->own_count,
                             sizeof(double)))
        return false;
    double *built = domain->built.bytes;
    for (size_t k = 0; k < columns->dimensions && domain->own_count; k++, built += domain->own_count)
        take_placed(domain, columns->position + k * columns->stride, built);
    take_placed(domain, columns->radius, built);
    return true;
}

bool phys_domain_gather(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    if (!number_columns(system, domain) || !order_columns(system, domain) || !take_groups(system, domain) ||
        !take_particles(system, domain) || !phys_domain_take_forces(system, domain) || !note_places(system, domain)) {
        system->failed = true;
        return false;
    }
    uint32_t ranks = (uint32_t)system->options.ranks.count;
    localize(domain, &domain->to, domain->to.start[ranks]);
    localize(domain, &domain->from, domain->from.start[ranks]);
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
