// domain_halo.c: particles that go from one rank to another: those that move, and those that others need.
//
// Each message is one that both sides expect: who sends how many is made known to all first.
#include "physics/domain.h"

#include <string.h>

bool phys_add_parcel(PhysSystem *system, Domain *domain, uint32_t rank, uint32_t column) {
    uint64_t count = domain->parcel_count;
    if (!phys_buffer_reserve(system, &domain->parcels, count * sizeof(Parcel), count + 1, sizeof(Parcel)))
        return false;
    ((Parcel *)domain->parcels.bytes)[domain->parcel_count++] = (Parcel){rank, column};
    return true;
}

bool phys_list_column(PhysSystem *system, ColumnList *list, uint32_t column) {
    uint64_t count = list->count;
    if (!phys_buffer_reserve(system, &list->columns, count * sizeof column, count + 1, sizeof column))
        return false;
    ((uint32_t *)list->columns.bytes)[list->count++] = column;
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

void phys_domain_reduce(PhysSystem *system, double *numbers, size_t count) {
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

// One component after the other, of the particles of some columns; `place`: where each is, unless there.
static void pack(const double *vectors, const Columns *at, const uint32_t *place, const uint32_t *columns, size_t count,
                 double *to) {
    for (size_t k = 0; k < at->dimensions; k++)
        for (size_t i = 0; i < count; i++)
            *to++ = vectors[k * at->stride + (place ? place[columns[i]] : columns[i])];
}

static void unpack(double *vectors, const Columns *at, const uint32_t *place, const uint32_t *columns, size_t count,
                   const double *from) {
    for (size_t k = 0; k < at->dimensions; k++)
        for (size_t i = 0; i < count; i++)
            vectors[k * at->stride + (place ? place[columns[i]] : columns[i])] = *from++;
}

static void pack_numbers(const uint32_t *columns, size_t count, double *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = columns[i];
}

static void pass_on(const Domain *domain, uint32_t from, uint32_t to, uint32_t column) {
    uint32_t *counts = domain->counts.bytes;
    counts[from]--;
    counts[to]++;
    phys_owners(domain)[column] = to;
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
        pack(columns->position, columns, NULL, phys_parcel(to, r), count, numbers + all);
        pack(columns->velocity, columns, NULL, phys_parcel(to, r), count, numbers + all + n * count);
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
            uint32_t column = (uint32_t)numbers[next];
            pass_on(domain, from, r, column);
            if (r != self)
                continue;
            ((uint32_t *)movers->items.bytes)[i] = column;
            if (!phys_list_column(system, &domain->fresh, column) || !phys_list_column(system, &domain->shore, column))
                return false;
        }
    unpack(columns->position, columns, NULL, movers->items.bytes, mine, numbers + all);
    unpack(columns->velocity, columns, NULL, movers->items.bytes, mine, numbers + all + n * mine);
    return true;
}

// The particle in a column of the local system, as it is within a frame, into one of the system.
static void give_back(const PhysSystem *system, const Domain *domain, uint32_t here, uint32_t column) {
    const Columns *from = &domain->local->columns, *to = &system->columns;
    for (size_t k = 0; k < to->dimensions; k++) {
        to->position[k * to->stride + column] = from->position[k * from->stride + here];
        to->velocity[k * to->stride + column] = from->velocity[k * from->stride + here];
    }
}

// The ends of links are sent wherever they are.
static void give_ends_back(const PhysSystem *system, const Domain *domain) {
    const Force *forces = system->forces.bytes;
    for (uint32_t f = 0; f < system->force_count; f++) {
        if (phys_force_row(forces[f].given.kind).stage != STAGE_LINK)
            continue;
        uint32_t ends[2] = {forces[f].given.from, forces[f].given.to};
        for (int i = 0; i < 2; i++)
            if (phys_owners(domain)[ends[i]] == (uint32_t)system->options.ranks.rank)
                give_back(system, domain, phys_local_column(domain, ends[i]), ends[i]);
    }
}

enum { CHUNK = 64, SIDE_BY_SIDE = 8, MOST_PLOTS = 32 };

// Whether all particles of a whole chunk are inland, as most are; by the box that they are in, which is small where
// columns are in the order of a list. False, too, where that is not easily found out.
static bool chunk_inland(const Columns *columns, const Grid *plots, const uint32_t *inland, size_t first) {
    uint32_t low[PHYS_VECTOR_DIMENSIONS] = {0}, high[PHYS_VECTOR_DIMENSIONS] = {0}, count = 1;
    for (size_t k = 0; k < plots->dimensions; k++) {
        const double *x = columns->position + k * columns->stride + first;
        double least[SIDE_BY_SIDE], most[SIDE_BY_SIDE], finite[SIDE_BY_SIDE] = {0};
        memcpy(least, x, sizeof least);
        memcpy(most, x, sizeof most);
        for (size_t i = 0; i < CHUNK; i += SIDE_BY_SIDE)
            for (size_t l = 0; l < SIDE_BY_SIDE; l++) {
                least[l] = x[i + l] < least[l] ? x[i + l] : least[l];
                most[l] = x[i + l] > most[l] ? x[i + l] : most[l];
                finite[l] += x[i + l] * 0;
            }
        for (size_t l = 1; l < SIDE_BY_SIDE; l++) {
            least[0] = least[l] < least[0] ? least[l] : least[0];
            most[0] = most[l] > most[0] ? most[l] : most[0];
            finite[0] += finite[l];
        }
        low[k] = phys_axis_cell(plots, k, least[0]);
        high[k] = phys_axis_cell(plots, k, most[0]);
        count *= high[k] - low[k] < MOST_PLOTS ? high[k] - low[k] + 1 : MOST_PLOTS + 1;
        if (!(finite[0] == 0) || count > MOST_PLOTS)
            return false;
    }
    bool all = true;
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++)
            for (uint32_t x = low[0]; x <= high[0]; x++)
                all &= inland[(z * plots->cells[1] + y) * plots->cells[0] + x] > 0;
    return all;
}

// Own particles that are not inland: they move, or are on the shore.
static bool look_along_shore(PhysSystem *system, Domain *domain) {
    const Columns *columns = &domain->local->columns;
    const bool *foreign = domain->local->foreign;
    const Grid plots = domain->plots;
    const uint32_t *inland = domain->inland.bytes, *owners = domain->plot_owners.bytes;
    uint32_t self = (uint32_t)system->options.ranks.rank;
    for (uint32_t i = 0; i < columns->count; i++) {
        while (i % CHUNK == 0 && i + CHUNK <= columns->count && chunk_inland(columns, &plots, inland, i))
            i += CHUNK;
        if (i == columns->count)
            break;
        uint32_t plot = phys_cell_of(&plots, columns->position + i, columns->stride);
        if (inland[plot] || foreign[i])
            continue;
        uint32_t column = domain->local->order[i];
        give_back(system, domain, i, column);
        if (owners[plot] == self ? !phys_list_column(system, &domain->shore, column)
                                 : !phys_add_parcel(system, domain, owners[plot], column))
            return false;
    }
    return true;
}

bool phys_domain_move(PhysSystem *system, Domain *domain) {
    uint32_t ranks = (uint32_t)system->options.ranks.count, self = (uint32_t)system->options.ranks.rank;
    domain->parcel_count = domain->shore.count = domain->fresh.count = 0;
    const double *table;
    give_ends_back(system, domain);
    if (!phys_domain_find_inland(system, domain) || !look_along_shore(system, domain) ||
        !sort_parcels(system, domain, &domain->to) || !(table = tell_counts(system, domain, &domain->to)) ||
        !send_movers(system, domain, &domain->to))
        return false;
    for (uint32_t r = 0; r < ranks; r++)
        for (size_t i = 0; i < phys_parcel_count(&domain->to, r); i++) {
            uint32_t column = phys_parcel(&domain->to, r)[i];
            pass_on(domain, self, r, column);
            domain->local->foreign[phys_local_column(domain, column)] = true;
        }
    bool done = true;
    for (uint32_t r = 0; r < ranks && done; r++)
        done = r == self || receive_movers(system, domain, table, r, &domain->from);
    return done && phys_goes_on(system);
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
        pack(columns->position, columns, NULL, phys_parcel(&domain->to, r), count, numbers + count);
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
        for (size_t i = 0; i < count; i++) {
            items[i] = (uint32_t)numbers[i];
            if (!phys_list_column(system, &domain->fresh, items[i]))
                return false;
        }
        unpack(columns->position, columns, NULL, items, count, numbers + count);
    }
    return true;
}

bool phys_domain_find_halo(PhysSystem *system, Domain *domain) {
    const double *table;
    return phys_domain_wish(system, domain) && sort_parcels(system, domain, &domain->to) &&
           (table = tell_counts(system, domain, &domain->to)) && send_halo(system, domain) &&
           receive_halo(system, domain, table) && phys_goes_on(system); // else what came is not what was sent
}

bool phys_domain_exchange(PhysSystem *system, Domain *domain) {
    const Columns *columns = &domain->local->columns;
    size_t n = system->dimensions, ranks = (size_t)system->options.ranks.count;
    for (uint32_t r = 0; r < ranks; r++) {
        size_t count = phys_parcel_count(&domain->to, r);
        double *numbers = count ? reserve_numbers(system, domain, n * count) : NULL;
        if (!count)
            continue;
        if (!numbers)
            return false;
        pack(columns->position, columns, domain->local->place, phys_parcel(&domain->to, r), count, numbers);
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
        unpack(columns->position, columns, domain->local->place, phys_parcel(&domain->from, r), count, numbers);
    }
    return true;
}
