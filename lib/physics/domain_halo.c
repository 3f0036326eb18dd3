// domain_halo.c: particles that go from one rank to another: those that move, and those that others need.
//
// Each message is one that both sides expect: who sends how many is made known to all first.
#include "physics/domain.h"

#include <stdlib.h>
#include <string.h>

static bool add_parcel(PhysSystem *system, Domain *domain, uint32_t rank, uint32_t column) {
    uint64_t count = domain->parcel_count;
    if (!phys_buffer_reserve(system, &domain->parcels, count * sizeof(Parcel), count + 1, sizeof(Parcel)))
        return false;
    ((Parcel *)domain->parcels.bytes)[domain->parcel_count++] = (Parcel){rank, column};
    return true;
}

static bool reserve_parcels(PhysSystem *system, Parcels *parcels, uint64_t count) {
    uint64_t ranks = (uint64_t)system->options.ranks.count;
    if (!phys_buffer_reserve(system, &parcels->starts, 0, ranks + 1, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &parcels->items, 0, count, sizeof(uint32_t)))
        return false;
    parcels->start = parcels->starts.bytes;
    return true;
}

// Sorts the parcels by rank; their order stays.
static bool sort_parcels(PhysSystem *system, const Domain *domain, Parcels *to) {
    const Parcel *parcels = domain->parcels.bytes;
    uint32_t ranks = (uint32_t)system->options.ranks.count;
    if (!reserve_parcels(system, to, domain->parcel_count))
        return false;
    memset(to->start, 0, (ranks + 1) * sizeof *to->start);
    for (uint32_t i = 0; i < domain->parcel_count; i++)
        to->start[parcels[i].rank]++;
    for (uint32_t r = 1; r <= ranks; r++)
        to->start[r] += to->start[r - 1];
    for (uint32_t i = domain->parcel_count; i-- > 0;)
        ((uint32_t *)to->items.bytes)[--to->start[parcels[i].rank]] = parcels[i].column;
    return true;
}

static void reduce(PhysSystem *system, double *numbers, size_t count) {
    const PhysRanks *ranks = &system->options.ranks;
    ranks->most(ranks->host, numbers, count);
    system->traffic.reductions++;
    system->traffic.step_bytes += count * sizeof *numbers;
}

static void send(PhysSystem *system, const Domain *domain, uint32_t to, size_t count) {
    const PhysRanks *ranks = &system->options.ranks;
    ranks->send(ranks->host, (int)to, domain->numbers.bytes, 1, count, count);
    system->traffic.step_messages++;
    system->traffic.step_bytes += count * sizeof(double);
}

static void receive(const PhysSystem *system, const Domain *domain, uint32_t from, size_t count) {
    const PhysRanks *ranks = &system->options.ranks;
    ranks->receive(ranks->host, (int)from, domain->numbers.bytes, 1, count, count);
}

// Tells all how many particles go from each rank to each: row `from`, column `to`.
static const double *tell_counts(PhysSystem *system, Domain *domain, const Parcels *to) {
    size_t ranks = (size_t)system->options.ranks.count, self = (size_t)system->options.ranks.rank;
    if (!phys_buffer_reserve(system, &domain->table, 0, ranks * ranks, sizeof(double)) ||
        !phys_buffer_reserve(system, &domain->starts, 0, ranks + 1, sizeof(size_t)))
        return NULL;
    double *table = domain->table.bytes;
    size_t *starts = domain->starts.bytes;
    memset(table, 0, ranks * ranks * sizeof *table); // should the others never answer
    for (size_t r = 0; r <= ranks; r++)
        starts[r] = r * ranks;
    for (size_t r = 0; r < ranks; r++)
        table[self * ranks + r] = (double)phys_parcel_count(to, r);
    system->options.ranks.gather(system->options.ranks.host, table, starts);
    system->traffic.reductions++;
    system->traffic.step_bytes += ranks * sizeof *table;
    return table;
}

static double *reserve_numbers(PhysSystem *system, Domain *domain, uint64_t count) {
    return phys_buffer_reserve(system, &domain->numbers, 0, count, sizeof(double)) ? domain->numbers.bytes : NULL;
}

// One component after the other.
static void pack(const double *vectors, size_t n, size_t stride, const uint32_t *columns, size_t count, double *to) {
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < count; i++)
            *to++ = vectors[k * stride + columns[i]];
}

static void unpack(double *vectors, size_t n, size_t stride, const uint32_t *columns, size_t count,
                   const double *from) {
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < count; i++)
            vectors[k * stride + columns[i]] = *from++;
}

static void pack_numbers(const uint32_t *columns, size_t count, double *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = columns[i];
}

// Particles that move go to their new owner with all that they have; everybody gets to know.
static bool send_movers(PhysSystem *system, Domain *domain, const Parcels *to) {
    const Columns *columns = &system->columns;
    uint32_t ranks = (uint32_t)system->options.ranks.count, all = to->start[ranks];
    size_t n = columns->dimensions;
    double *numbers = reserve_numbers(system, domain, (1 + 2 * n) * all);
    for (uint32_t r = 0; numbers && all && r < ranks; r++) {
        size_t count = phys_parcel_count(to, r);
        if (r == (uint32_t)system->options.ranks.rank)
            continue;
        pack_numbers(phys_parcel(to, 0), all, numbers);
        pack(columns->position, n, columns->stride, phys_parcel(to, r), count, numbers + all);
        pack(columns->velocity, n, columns->stride, phys_parcel(to, r), count, numbers + all + n * count);
        send(system, domain, r, all + 2 * n * count);
    }
    return numbers != NULL;
}

static bool receive_movers(PhysSystem *system, Domain *domain, const double *table, uint32_t from, Parcels *movers) {
    const Columns *columns = &system->columns;
    uint32_t ranks = (uint32_t)system->options.ranks.count, self = (uint32_t)system->options.ranks.rank, all = 0;
    size_t n = columns->dimensions;
    const double *row = table + (size_t)from * ranks;
    for (uint32_t r = 0; r < ranks; r++)
        all += (uint32_t)row[r];
    if (!all)
        return true;
    size_t mine = (size_t)row[self], next = 0;
    const double *numbers = reserve_numbers(system, domain, all + 2 * n * mine);
    if (!numbers || !reserve_parcels(system, movers, mine))
        return false;
    receive(system, domain, from, all + 2 * n * mine);
    for (uint32_t r = 0; r < ranks; r++)
        for (size_t i = 0; i < (size_t)row[r]; i++, next++) {
            phys_owners(domain)[(uint32_t)numbers[next]] = r;
            if (r == self)
                ((uint32_t *)movers->items.bytes)[i] = (uint32_t)numbers[next];
        }
    unpack(columns->position, n, columns->stride, movers->items.bytes, mine, numbers + all);
    unpack(columns->velocity, n, columns->stride, movers->items.bytes, mine, numbers + all + n * mine);
    return true;
}

bool phys_domain_move(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    uint32_t ranks = (uint32_t)system->options.ranks.count, self = (uint32_t)system->options.ranks.rank;
    uint32_t *owners = phys_owners(domain);
    domain->parcel_count = 0;
    for (uint32_t i = 0; i < domain->own_count; i++) {
        uint32_t column = domain->column[((const uint32_t *)domain->own.bytes)[i]];
        uint32_t owner = phys_domain_owner(domain, columns->position + column, columns->stride);
        if (owner != self && !add_parcel(system, domain, owner, column))
            return false;
        owners[column] = owner;
    }
    const double *table;
    if (!sort_parcels(system, domain, &domain->to) || !(table = tell_counts(system, domain, &domain->to)) ||
        !send_movers(system, domain, &domain->to))
        return false;
    bool done = true;
    for (uint32_t r = 0; r < ranks && done; r++)
        done = r == self || receive_movers(system, domain, table, r, &domain->from);
    return done && phys_goes_on(system);
}

// How far a particle with this radius may be from one of its partners, except for large ones.
static double reach(const Domain *domain, double radius, double partner) {
    double touch = domain->contact ? radius + partner : 0;
    return (fmax(touch, domain->bound) + domain->survey.skin) * (1 + 1e-9);
}

// All plots that a particle can see into, rounding included, because the number of a plot rises with the position.
static bool wish_for_plots(PhysSystem *system, Domain *domain, uint32_t column, uint32_t *told) {
    const Columns *columns = &system->columns;
    const Grid *grid = &domain->plots;
    uint32_t low[PHYS_VECTOR_DIMENSIONS] = {0}, high[PHYS_VECTOR_DIMENSIONS] = {0};
    double far = reach(domain, columns->radius[column], domain->widest);
    for (size_t k = 0; k < grid->dimensions; k++) {
        double x = columns->position[k * columns->stride + column];
        low[k] = phys_axis_cell(grid, k, x - far);
        high[k] = phys_axis_cell(grid, k, x + far);
    }
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++)
            for (uint32_t x = low[0]; x <= high[0]; x++) {
                uint32_t plot = (z * grid->cells[1] + y) * grid->cells[0] + x;
                uint32_t owner = ((const uint32_t *)domain->plot_owners.bytes)[plot];
                if (told[owner] == column + 1)
                    continue;
                told[owner] = column + 1;
                if (!add_parcel(system, domain, owner, column))
                    return false;
            }
    return true;
}

// Those that a large particle of another rank can see.
static bool wish_for_large(PhysSystem *system, Domain *domain, uint32_t column, const double *places, uint32_t *told) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions;
    for (uint32_t l = 0; l < domain->large_count; l++) {
        uint32_t owner = phys_owners(domain)[domain->large[l]];
        double far = reach(domain, columns->radius[column], columns->radius[domain->large[l]]);
        bool near = told[owner] != column + 1;
        for (size_t k = 0; k < n; k++)
            near &= fabs(columns->position[k * columns->stride + column] - places[l * n + k]) <= far;
        if (!near)
            continue;
        told[owner] = column + 1;
        if (!add_parcel(system, domain, owner, column))
            return false;
    }
    return true;
}

// Where large particles are must be known to all.
static const double *large_places(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions;
    double *places = reserve_numbers(system, domain, domain->large_count * n);
    for (uint32_t l = 0; places && l < domain->large_count; l++)
        for (size_t k = 0; k < n; k++) {
            double x = columns->position[k * columns->stride + domain->large[l]];
            bool own = phys_owners(domain)[domain->large[l]] == (uint32_t)system->options.ranks.rank;
            places[l * n + k] = own && !isnan(x) ? x : -INFINITY;
        }
    if (places && domain->large_count)
        reduce(system, places, domain->large_count * n);
    return places;
}

static int by_rank(const void *left, const void *right) {
    const Parcel *a = left, *b = right;
    if (a->rank != b->rank)
        return a->rank < b->rank ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

// A link takes its ends along, however far apart.
static bool wish_for_links(PhysSystem *system, Domain *domain) {
    const Force *forces = system->forces.bytes;
    const uint32_t *owners = phys_owners(domain);
    uint32_t self = (uint32_t)system->options.ranks.rank, before = domain->parcel_count;
    for (uint32_t f = 0; f < system->force_count; f++) {
        const PhysForce *link = &forces[f].given;
        if (phys_force_row(link->kind).stage != STAGE_LINK || owners[link->from] == owners[link->to])
            continue;
        if ((owners[link->from] == self && !add_parcel(system, domain, owners[link->to], link->from)) ||
            (owners[link->to] == self && !add_parcel(system, domain, owners[link->from], link->to)))
            return false;
    }
    if (domain->parcel_count == before)
        return true;
    Parcel *parcels = domain->parcels.bytes;
    uint32_t kept = 0;
    qsort(parcels, domain->parcel_count, sizeof *parcels, by_rank);
    for (uint32_t i = 0; i < domain->parcel_count; i++)
        if (!kept || by_rank(&parcels[i], &parcels[kept - 1]))
            parcels[kept++] = parcels[i];
    domain->parcel_count = kept;
    return true;
}

static bool collect_wishes(PhysSystem *system, Domain *domain) {
    uint32_t self = (uint32_t)system->options.ranks.rank, ranks = (uint32_t)system->options.ranks.count;
    const double *places = large_places(system, domain);
    if (!places || !phys_buffer_reserve(system, &domain->to.items, 0, ranks, sizeof(uint32_t)))
        return false;
    uint32_t *told = domain->to.items.bytes; // by rank: the last particle that it was given, plus 1
    memset(told, 0, ranks * sizeof *told);
    domain->parcel_count = 0;
    for (uint32_t column = 0; column < system->particle_count; column++) {
        if (phys_owners(domain)[column] != self)
            continue;
        told[self] = column + 1;
        if (!wish_for_plots(system, domain, column, told) ||
            (domain->large_count && !wish_for_large(system, domain, column, places, told)))
            return false;
    }
    return wish_for_links(system, domain);
}

static bool send_halo(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, ranks = (size_t)system->options.ranks.count;
    for (uint32_t r = 0; r < ranks; r++) {
        size_t count = phys_parcel_count(&domain->to, r);
        if (!count)
            continue;
        double *numbers = reserve_numbers(system, domain, (1 + n) * count);
        if (!numbers)
            return false;
        pack_numbers(phys_parcel(&domain->to, r), count, numbers);
        pack(columns->position, n, columns->stride, phys_parcel(&domain->to, r), count, numbers + count);
        send(system, domain, r, (1 + n) * count);
    }
    return true;
}

static bool receive_halo(PhysSystem *system, Domain *domain, const double *table) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, ranks = (size_t)system->options.ranks.count;
    size_t self = (size_t)system->options.ranks.rank, total = 0;
    for (size_t r = 0; r < ranks; r++)
        total += (size_t)table[r * ranks + self];
    if (!reserve_parcels(system, &domain->from, total))
        return false;
    Parcels *from = &domain->from;
    from->start[0] = 0;
    for (uint32_t r = 0; r < ranks; r++) {
        size_t count = (size_t)table[r * ranks + self];
        from->start[r + 1] = from->start[r] + (uint32_t)count;
        if (!count)
            continue;
        const double *numbers = reserve_numbers(system, domain, (1 + n) * count);
        if (!numbers)
            return false;
        receive(system, domain, r, (1 + n) * count);
        uint32_t *items = (uint32_t *)from->items.bytes + from->start[r];
        for (size_t i = 0; i < count; i++)
            items[i] = (uint32_t)numbers[i];
        unpack(columns->position, n, columns->stride, items, count, numbers + count);
    }
    return true;
}

bool phys_domain_find_halo(PhysSystem *system, Domain *domain) {
    const double *table;
    return collect_wishes(system, domain) && sort_parcels(system, domain, &domain->to) &&
           (table = tell_counts(system, domain, &domain->to)) && send_halo(system, domain) &&
           receive_halo(system, domain, table) && phys_goes_on(system); // else what came is not what was sent
}

bool phys_domain_exchange(PhysSystem *system, Domain *domain) {
    const Columns *columns = &domain->local->columns;
    size_t n = columns->dimensions, ranks = (size_t)system->options.ranks.count;
    for (uint32_t r = 0; r < ranks; r++) {
        size_t count = phys_parcel_count(&domain->to, r);
        double *numbers = count ? reserve_numbers(system, domain, n * count) : NULL;
        if (!count)
            continue;
        if (!numbers)
            return false;
        pack(columns->position, n, columns->stride, phys_parcel(&domain->to, r), count, numbers);
        send(system, domain, r, n * count);
    }
    for (uint32_t r = 0; r < ranks; r++) {
        size_t count = phys_parcel_count(&domain->from, r);
        const double *numbers = count ? reserve_numbers(system, domain, n * count) : NULL;
        if (!count)
            continue;
        if (!numbers)
            return false;
        receive(system, domain, r, n * count);
        unpack(columns->position, n, columns->stride, phys_parcel(&domain->from, r), count, numbers);
    }
    return true;
}
