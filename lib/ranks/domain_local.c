// domain_local.c: the local system of a rank: its owned particles and its halo.
//
// The handles of the local system are columns of the whole system, with gaps. The columns of the local system are in
// ascending order of handles, or in the sorted order of a list (reorder.c). In sorted order, a rebuild of the halo
// leaves nearly all owned particles in their columns. Arrivals fill the columns that have become free.
#include "physics/threads.h"
#include "ranks/domain.h"

#include <stdlib.h>
#include <string.h>

enum { LINE = 8 }; // number of particles in a cache line; the capacity of the columns is a multiple of this

static int compare_columns(const void *left, const void *right) {
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

// Assigns local column `here` to the particle in global column `column`. The values of the particle will be copied from
// column `source` (Domain.sources).
static void set_column(const Domain *domain, uint32_t here, uint32_t column, uint32_t source) {
    domain->local->order[here] = column;
    domain->local->column_of[column] = here;
    ((uint32_t *)domain->sources.bytes)[here] = source;
}

// Reserves `orders`, `sources` and `column_of` for `count` local columns, and retains the old `orders` in
// `last_orders`.
static bool reserve_orders(PhysSystem *system, Domain *domain, uint64_t count) {
    Buffer orders = domain->last_orders;
    domain->last_orders = domain->orders;
    domain->orders = orders;
    if (!phys_buffer_reserve(system, &domain->orders, 0, count, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->sources, 0, count, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->column_of, 0, system->particle_count, sizeof(uint32_t)))
        return false;
    domain->local->order = domain->orders.bytes;
    domain->local->column_of = domain->column_of.bytes;
    domain->local->handle_count = system->particle_count;
    return true;
}

// Assigns local columns to all particles from scratch. Particles that stay are found in the previous local system. If
// there is none, owned particles are found in the system's columns.
static bool order_columns(PhysSystem *system, Domain *domain, uint32_t spare) {
    PhysSystem *local = domain->local;
    bool had_local = domain->state != DOMAIN_NONE;
    uint32_t self = ranks_self(system), arrivals = domain->arrivals.count, next = 0, here = 0;
    const uint32_t *last_order = local->order, *owners = domain_owners(domain),
                   *arriving = domain->arrivals.columns.bytes;
    const bool *remote = local->remote;
    uint64_t last = had_local ? local->particle_count : domain_own_count(system, domain);
    if (!reserve_orders(system, domain, last + arrivals + spare + LINE))
        return false;
    if (!had_local) {
        memset(local->column_of, 0xff, system->particle_count * sizeof *local->column_of); // NO_COLUMN
        phys_forget_order(local);
    }
    for (uint32_t i = 0, end = had_local ? local->particle_count : system->particle_count; i < end; i++) {
        uint32_t column = had_local ? last_order[i] : i;
        if (had_local ? remote[i] : owners[i] != self)
            continue;
        for (; local->column_order != ORDER_BY_CELL && next < arrivals && arriving[next] < column; next++)
            set_column(domain, here++, arriving[next], 0);
        set_column(domain, here++, column, i);
    }
    for (; next < arrivals; next++)
        set_column(domain, here++, arriving[next], 0);
    local->particle_count = here;
    return true;
}

static bool build_groups(const PhysSystem *system, const Domain *domain) {
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

// For each particle, counts the earlier particles of its group that are not anchors. This number determines the
// position of the particle in the random streams.
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

static bool build_random_offsets(PhysSystem *system, Domain *domain) {
    Columns *own = &domain->local->columns;
    own->random_offset = NULL;
    if (!is_needed(system, NEED_STREAM))
        return true;
    if (!phys_buffer_reserve(system, &domain->random_offset, 0, own->count, sizeof(uint32_t)) ||
        !count_movers(system, domain))
        return false;
    uint32_t *offsets = domain->random_offset.bytes;
    for (uint32_t i = 0; i < own->count; i++)
        offsets[i] = ((const uint32_t *)domain->movers.bytes)[domain->local->order[i]];
    Group *groups = domain->local->groups.bytes;
    for (uint32_t g = 0; g < system->group_count; g++)
        groups[g].movers = ((const Group *)system->groups.bytes)[g].movers;
    own->random_offset = offsets;
    return true;
}

static void fill_range(size_t first, size_t end, double number, double *to) {
    for (size_t i = first; i < end; i++)
        to[i] = number;
}

static void gather_column(const uint32_t *column, size_t first, size_t end, const double *from, double *to) {
    for (size_t i = first; i < end; i++)
        to[i] = from[column[i]];
}

typedef struct ColumnCopy {
    const PhysSystem *system;
    const Domain *domain;
    Columns from;
    const uint32_t *sources; // by local column: column of `from` to copy
} ColumnCopy;

static void copy_attributes(const ColumnCopy *copy, size_t first, size_t end) {
    const PhysSystem *system = copy->system;
    const Columns *from = &copy->from, *to = &copy->domain->local->columns;
    const uint32_t *sources = copy->sources;
    double *numbers[][2] = {{from->radius, to->radius}, {from->mass, to->mass}, {from->charge, to->charge}};
    for (int i = 0; i < 3; i++)
        if (system->record_stride)
            gather_column(sources, first, end, numbers[i][0], numbers[i][1]);
        else // all particles have the same attributes
            fill_range(first, end, numbers[i][0][sources[first]], numbers[i][1]);
    if (is_needed(system, NEED_SECTION))
        gather_column(sources, first, end, from->section, to->section);
    if (is_needed(system, NEED_VOLUME))
        gather_column(sources, first, end, from->volume, to->volume);
    if (system->own_forces == OWN_FORCES_EASED)
        gather_column(sources, first, end, from->ease, to->ease);
    for (size_t k = 0; k < to->dimensions && system->own_forces != OWN_FORCES_NONE; k++)
        gather_column(sources, first, end, from->own_force + k * from->stride, to->own_force + k * to->stride);
}

static void copy_range(const ColumnCopy *copy, size_t first, size_t end) {
    const Columns *from = &copy->from, *to = &copy->domain->local->columns;
    if (first == end)
        return; // a rank without particles has no columns
    for (size_t k = 0; k < to->dimensions; k++) {
        gather_column(copy->sources, first, end, from->position + k * from->stride, to->position + k * to->stride);
        gather_column(copy->sources, first, end, from->velocity + k * from->stride, to->velocity + k * to->stride);
    }
    for (size_t i = first; i < end; i++)
        to->anchor[i] = from->anchor[copy->sources[i]];
    copy_attributes(copy, first, end);
}

static void copy_chunk(void *context, int chunk, int chunks) {
    const ColumnCopy *copy = context;
    uint32_t count = copy->domain->local->columns.count;
    copy_range(copy, phys_chunk_begin(count, chunk, chunks), phys_chunk_begin(count, chunk + 1, chunks));
}

// Copies attributes from the system's columns, and positions and velocities from the rows.
static void reload_chunk(void *context, int chunk, int chunks) {
    const ColumnCopy *copy = context;
    const PhysSystem *system = copy->system;
    const Columns *to = &copy->domain->local->columns;
    size_t n = to->dimensions, first = phys_chunk_begin(to->count, chunk, chunks);
    size_t end = phys_chunk_begin(to->count, chunk + 1, chunks);
    for (size_t i = first; i < end; i++) {
        const double *row = phys_row(system, system->order[copy->sources[i]]);
        for (size_t k = 0; k < n; k++) {
            to->position[k * to->stride + i] = row[k];
            to->velocity[k * to->stride + i] = row[n + k];
        }
    }
    if (first < end)
        copy_attributes(copy, first, end);
}

static int chunk_count_for(const PhysSystem *local) {
    return phys_chunk_count(local, local->particle_count, PHYS_MIN_FOR_THREADS);
}

void domain_reload(const PhysSystem *system, Domain *domain) {
    ColumnCopy copy = {system, domain, system->columns, domain->local->order};
    domain->local->radius_version++;
    domain->local->motion_version++;
    phys_parallel(domain->local, chunk_count_for(domain->local), reload_chunk, &copy);
}

static void copy_arrivals(const PhysSystem *system, const Domain *domain) {
    const Columns *to = &domain->local->columns;
    const uint32_t *arrivals = domain->arrivals.columns.bytes, *owners = domain_owners(domain);
    uint32_t *sources = domain->sources.bytes;
    ColumnCopy copy = {system, domain, system->columns, sources};
    for (uint32_t f = 0; f < domain->arrivals.count; f++) {
        uint32_t here = domain_local_column(domain, arrivals[f]);
        sources[here] = arrivals[f];
        copy_range(&copy, here, here + 1);
        for (size_t k = 0; k < to->dimensions; k++)
            to->force[k * to->stride + here] = 0;
        domain->local->remote[here] = owners[arrivals[f]] != ranks_self(system);
        to->anchor[here] |= domain->local->remote[here];
    }
}

// Copies all particles to new columns that have spare capacity, so that later arrivals fit into them.
static bool copy_all(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    uint32_t spare = domain_own_count(system, domain) / 32 + 256;
    const Columns last = local->columns;
    if (!order_columns(system, domain, spare))
        return false;
    ColumnCopy copy = {system, domain, domain->state == DOMAIN_NONE ? system->columns : last, domain->sources.bytes};
    Buffer memory = domain->spare;
    domain->spare = local->column_data;
    local->column_data = memory;
    local->dimensions = system->dimensions;
    local->own_forces = system->own_forces;
    if (!phys_buffer_reserve(system, &domain->remote, 0, (uint64_t)local->particle_count + spare + LINE,
                             sizeof(bool)) ||
        !phys_reserve_columns(local, spare))
        return false;
    local->remote = domain->remote.bytes;
    memset(local->remote, false, local->columns.stride);
    if (copy.from.count)
        phys_parallel(local, chunk_count_for(local), copy_chunk, &copy);
    return true;
}

// Fills the gaps that departed particles have left: first with arrivals, then with the last columns.
static void fill_gaps(const PhysSystem *system, const Domain *domain) {
    PhysSystem *local = domain->local;
    const uint32_t *arriving = domain->arrivals.columns.bytes;
    uint32_t count = local->particle_count, next = 0;
    ColumnCopy copy = {system, domain, local->columns, domain->sources.bytes};
    for (uint32_t i = phys_next_remote(local, 0); i < count; i = phys_next_remote(local, i + 1)) {
        if (next < domain->arrivals.count) {
            set_column(domain, i, arriving[next], 0);
            next++;
            continue;
        }
        while (--count > i && local->remote[count])
            ;
        if (count == i)
            break;
        set_column(domain, i, local->order[count], count);
        copy_range(&copy, i, (size_t)i + 1);
        local->remote[i] = false;
    }
    for (; next < domain->arrivals.count; next++)
        set_column(domain, count++, arriving[next], 0);
    local->particle_count = local->columns.count = count;
}

// Builds the columns of the owned and halo particles.
static bool build_particles(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    bool had_local = domain->state != DOMAIN_NONE;
    uint32_t arrivals = domain->arrivals.count;
    if (arrivals)
        qsort(domain->arrivals.columns.bytes, arrivals, sizeof(uint32_t), compare_columns);
    uint32_t i = had_local ? phys_next_remote(local, 0) : local->particle_count;
    for (; i < local->particle_count; i = phys_next_remote(local, i + 1))
        local->column_of[local->order[i]] = NO_COLUMN;
    if (had_local && local->column_order == ORDER_BY_CELL &&
        (uint64_t)local->particle_count + arrivals <= local->columns.stride)
        fill_gaps(system, domain);
    else if (!copy_all(system, domain))
        return false;
    local->radius_version++;
    copy_arrivals(system, domain);
    return true;
}

// If a pass has run without a list, records positions and radii of the owned particles for left_skin.
static bool record_built(PhysSystem *system, Domain *domain) {
    const Columns *columns = &domain->local->columns;
    size_t n = columns->dimensions;
    domain->built_valid = domain->local->unlisted;
    if (!domain->built_valid)
        return true;
    if (!phys_buffer_reserve(system, &domain->built, 0, (n + 1) * (uint64_t)domain_own_count(system, domain),
                             sizeof(double)))
        return false;
    double *built = domain->built.bytes;
    for (uint32_t c = 0; c < system->particle_count; c++) {
        if (domain_owners(domain)[c] != ranks_self(system))
            continue;
        size_t at = domain_local_column(domain, c);
        for (size_t k = 0; k < n; k++)
            *built++ = columns->position[k * columns->stride + at];
        *built++ = columns->radius[at];
    }
    return true;
}

bool domain_build_local(PhysSystem *system, Domain *domain) {
    PhysSystem *local = domain->local;
    if (!build_particles(system, domain) || !build_groups(system, domain) || !domain_update_forces(system, domain) ||
        !record_built(system, domain)) {
        system->failed = true;
        return false;
    }
    phys_lists_drop(local, domain->survey.skin);
    local->unlisted = false;
    domain->age = 0;
    return true;
}

// Replaces the global columns in a link by local columns. Returns false if the link acts on no owned particle. If it
// acts on one, both of its particles are in the local system.
static bool localise_force(const PhysSystem *system, const Domain *domain, Force *force) {
    if (phys_force_row(force->given.kind).stage != STAGE_LINK)
        return true;
    uint32_t self = ranks_self(system), from = force->given.from, to = force->given.to;
    const uint32_t *owners = domain_owners(domain);
    force->given.from = domain_local_column(domain, from);
    force->given.to = domain_local_column(domain, to);
    return (owners[from] == self || owners[to] == self) && from != to;
}

bool domain_update_forces(PhysSystem *system, Domain *domain) {
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
            count += localise_force(system, domain, &forces[count]);
        }
    }
    local->starts[slots] = local->force_count = count;
    phys_link_groups(local);
    local->record_stride = system->record_stride;
    phys_allow_reorder(local, phys_can_reorder(system));
    return build_random_offsets(system, domain);
}

void domain_return_items(PhysSystem *system, const PhysSystem *local) {
    Force *to = system->forces.bytes;
    const Force *from = local->forces.bytes;
    for (uint64_t s = STAGE_SINGLE; s < (uint64_t)system->group_count * STAGE_COUNT; s += STAGE_COUNT)
        for (uint32_t f = 0; f < system->starts[s + 1] - system->starts[s]; f++)
            to[system->starts[s] + f].item = from[local->starts[s] + f].item;
}
