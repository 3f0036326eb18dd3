// domain_halo.c: transfers of particles between ranks: migration and halos.
//
// Before a transfer, ranks exchange the numbers of particles. So each rank knows which messages it will receive.
#include "ranks/domain.h"

#include <string.h>

bool domain_add_transfer(PhysSystem *system, Domain *domain, uint32_t rank, uint32_t column) {
    if (!phys_buffer_grow(system, &domain->transfers, domain->transfer_count, sizeof(Transfer)))
        return false;
    ((Transfer *)domain->transfers.bytes)[domain->transfer_count++] = (Transfer){rank, column};
    return true;
}

bool domain_list_column(PhysSystem *system, ColumnList *list, uint32_t column) {
    if (!phys_buffer_grow(system, &list->columns, list->count, sizeof column))
        return false;
    ((uint32_t *)list->columns.bytes)[list->count++] = column;
    return true;
}

static bool reserve_transfers(PhysSystem *system, Transfers *transfers, uint64_t count) {
    uint64_t ranks = ranks_count(system);
    if (!phys_buffer_reserve(system, &transfers->starts, 0, ranks + 1, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &transfers->items, 0, count, sizeof(uint32_t)))
        return false;
    transfers->start = transfers->starts.bytes;
    return true;
}

// Copies domain->transfers to `to`, sorted by rank. The sort is stable.
static bool sort_transfers(PhysSystem *system, const Domain *domain, Transfers *to) {
    const Transfer *transfers = domain->transfers.bytes;
    uint32_t ranks = ranks_count(system);
    if (!reserve_transfers(system, to, domain->transfer_count))
        return false;
    memset(to->start, 0, (ranks + 1) * sizeof *to->start);
    for (uint32_t i = 0; i < domain->transfer_count; i++)
        to->start[transfers[i].rank]++;
    for (uint32_t r = 1; r <= ranks; r++)
        to->start[r] += to->start[r - 1];
    for (uint32_t i = domain->transfer_count; i-- > 0;)
        ((uint32_t *)to->items.bytes)[--to->start[transfers[i].rank]] = transfers[i].column;
    return true;
}

void domain_reduce(const PhysSystem *system, Domain *domain, double *numbers, size_t count) {
    const PetriRanks *ranks = ranks_of(system);
    ranks->allreduce_max(ranks->user_data, numbers, count);
    domain->stats.reductions++;
    domain->stats.step_bytes += count * sizeof *numbers;
}

static void send_message(const PhysSystem *system, Domain *domain, uint32_t to, size_t count) {
    const PetriRanks *ranks = ranks_of(system);
    ranks->send(ranks->user_data, (int)to, domain->message.bytes, 1, count, count);
    domain->stats.step_messages++;
    domain->stats.step_bytes += count * sizeof(double);
}

static void receive_message(const PhysSystem *system, const Domain *domain, uint32_t from, size_t count) {
    const PetriRanks *ranks = ranks_of(system);
    ranks->receive(ranks->user_data, (int)from, domain->message.bytes, 1, count, count);
}

// Exchanges the number of particles that each rank sends to each other rank. Returns these numbers as a table with a
// row per sender and a column per receiver. Returns NULL if out of memory.
static const double *exchange_counts(PhysSystem *system, Domain *domain, const Transfers *to) {
    size_t ranks = ranks_count(system), self = ranks_self(system);
    if (!phys_buffer_reserve(system, &domain->transfer_counts, 0, ranks * ranks, sizeof(double)) ||
        !phys_buffer_reserve(system, &domain->starts, 0, ranks + 1, sizeof(size_t)))
        return NULL;
    double *table = domain->transfer_counts.bytes;
    size_t *starts = domain->starts.bytes;
    memset(table, 0, ranks * ranks * sizeof *table); // other ranks' rows stay 0 if the exchange is interrupted
    for (size_t r = 0; r <= ranks; r++)
        starts[r] = r * ranks;
    for (size_t r = 0; r < ranks; r++)
        table[self * ranks + r] = (double)domain_transfer_count(to, r);
    ranks_of(system)->allgatherv(ranks_of(system)->user_data, table, starts);
    domain->stats.reductions++;
    domain->stats.step_bytes += ranks * sizeof *table;
    return table;
}

static double *reserve_numbers(PhysSystem *system, Domain *domain, uint64_t count) {
    return phys_buffer_reserve(system, &domain->message, 0, count, sizeof(double)) ? domain->message.bytes : NULL;
}

typedef enum Direction { SEND, RECEIVE } Direction;

// Copies one vector of each of the `count` particles in `columns` to a message, or from a received message, component
// by component. column_of[c] is the index of column c in `vectors`; NULL: the index is c. `at` describes the layout of
// `vectors`.
static void copy_vectors(Direction direction, double *vectors, const Columns *at, const uint32_t *column_of,
                         const uint32_t *columns, size_t count, double *message) {
    for (size_t k = 0; k < at->dimensions; k++)
        for (size_t i = 0; i < count; i++, message++) {
            double *number = &vectors[k * at->stride + (column_of ? column_of[columns[i]] : columns[i])];
            if (direction == SEND)
                *message = *number;
            else
                *number = *message;
        }
}

// Copies positions and velocities in the system's columns to or from a message.
static void copy_motion(Direction direction, const Columns *at, const uint32_t *columns, size_t count,
                        double *message) {
    copy_vectors(direction, at->position, at, NULL, columns, count, message);
    copy_vectors(direction, at->velocity, at, NULL, columns, count, message + at->dimensions * count);
}

static void pack_columns(const uint32_t *columns, size_t count, double *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = columns[i];
}

static void change_owner(const Domain *domain, uint32_t from, uint32_t to, uint32_t column) {
    uint32_t *counts = domain->counts.bytes;
    counts[from]--;
    counts[to]++;
    domain_owners(domain)[column] = to;
}

// Sends positions and velocities of migrating particles to their new owners. Sends the columns of all particles that
// leave this rank to every rank, so that all ranks know the new owners.
static bool send_movers(PhysSystem *system, Domain *domain, const Transfers *to) {
    const Columns *columns = &system->columns;
    uint32_t ranks = ranks_count(system), all = to->start[ranks];
    size_t n = columns->dimensions;
    double *numbers = reserve_numbers(system, domain, (1 + 2 * n) * all);
    for (uint32_t r = 0; numbers && all && r < ranks; r++) {
        size_t count = domain_transfer_count(to, r);
        if (r == ranks_self(system))
            continue;
        pack_columns(domain_transfer(to, 0), all, numbers);
        copy_motion(SEND, columns, domain_transfer(to, r), count, numbers + all);
        send_message(system, domain, r, all + 2 * n * count);
    }
    return numbers;
}

static bool receive_movers(PhysSystem *system, Domain *domain, const double *table, uint32_t from, Transfers *moved) {
    const Columns *columns = &system->columns;
    uint32_t ranks = ranks_count(system), self = ranks_self(system), all = 0;
    size_t n = columns->dimensions;
    const double *row = table + (size_t)from * ranks;
    for (uint32_t r = 0; r < ranks; r++)
        all += (uint32_t)row[r];
    if (!all)
        return true;
    size_t mine = (size_t)row[self], next = 0;
    double *numbers = reserve_numbers(system, domain, all + 2 * n * mine);
    if (!numbers || !reserve_transfers(system, moved, mine))
        return false;
    receive_message(system, domain, from, all + 2 * n * mine);
    for (uint32_t r = 0; r < ranks; r++)
        for (size_t i = 0; i < (size_t)row[r]; i++, next++) {
            uint32_t column = (uint32_t)numbers[next];
            change_owner(domain, from, r, column);
            if (r != self)
                continue;
            ((uint32_t *)moved->items.bytes)[i] = column;
            if (!domain_list_column(system, &domain->arrivals, column) ||
                !domain_list_column(system, &domain->boundary, column))
                return false;
        }
    copy_motion(RECEIVE, columns, moved->items.bytes, mine, numbers + all);
    return true;
}

// Copies position and velocity from local column `here` to the system's column `column`.
static void copy_back(const PhysSystem *system, const Domain *domain, uint32_t here, uint32_t column) {
    const Columns *from = &domain->local->columns, *to = &system->columns;
    for (size_t k = 0; k < to->dimensions; k++) {
        to->position[k * to->stride + column] = from->position[k * from->stride + here];
        to->velocity[k * to->stride + column] = from->velocity[k * from->stride + here];
    }
}

// Copies owned particles with links back to the system's columns, because they can be sent even if they are not on the
// boundary.
static void copy_link_ends_back(const PhysSystem *system, const Domain *domain) {
    const Force *forces = system->forces.bytes;
    for (uint32_t f = 0; f < system->force_count; f++) {
        if (phys_force_row(forces[f].given.kind).stage != STAGE_LINK)
            continue;
        uint32_t ends[2] = {forces[f].given.from, forces[f].given.to};
        for (int i = 0; i < 2; i++)
            if (domain_owners(domain)[ends[i]] == ranks_self(system))
                copy_back(system, domain, domain_local_column(domain, ends[i]), ends[i]);
    }
}

enum { RUN_LENGTH = 64, MAX_PATCHES = 32 };

// Returns true if the RUN_LENGTH particles starting at `first` are certainly in interior patches, which is the
// common case. Tests all patches that the particles' bounding box overlaps. The box is small if the columns are in
// sorted order.
static bool run_is_interior(const Columns *columns, const Grid *patches, const uint32_t *interior, size_t first) {
    uint32_t low[PHYS_VECTOR_DIMENSIONS] = {0}, high[PHYS_VECTOR_DIMENSIONS] = {0}, count = 1;
    for (size_t k = 0; k < patches->dimensions; k++) {
        double min = INFINITY, max = -INFINITY;
        if (!phys_find_extremes(columns->position + k * columns->stride + first, RUN_LENGTH, &min, &max))
            return false;
        low[k] = phys_axis_cell(patches, k, min);
        high[k] = phys_axis_cell(patches, k, max);
        count *= high[k] - low[k] < MAX_PATCHES ? high[k] - low[k] + 1 : MAX_PATCHES + 1;
        if (count > MAX_PATCHES)
            return false;
    }
    bool all = true;
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++)
            for (uint32_t x = low[0]; x <= high[0]; x++)
                all &= interior[(z * patches->cells[1] + y) * patches->cells[0] + x] > 0;
    return all;
}

// Finds owned particles outside the interior. Adds each to the boundary list, or to the transfers if it has a new
// owner.
static bool scan_boundary(PhysSystem *system, Domain *domain) {
    const Columns *columns = &domain->local->columns;
    const bool *remote = domain->local->remote;
    const Grid patches = domain->patches;
    const uint32_t *interior = domain->interior.bytes, *owners = domain->patch_owners.bytes;
    uint32_t self = ranks_self(system);
    for (uint32_t i = 0; i < columns->count; i++) {
        while (i % RUN_LENGTH == 0 && i + RUN_LENGTH <= columns->count &&
               run_is_interior(columns, &patches, interior, i))
            i += RUN_LENGTH;
        if (i == columns->count)
            break;
        uint32_t patch = phys_cell_of(&patches, columns->position + i, columns->stride);
        if (interior[patch] || remote[i])
            continue;
        uint32_t column = domain->local->order[i];
        copy_back(system, domain, i, column);
        if (owners[patch] == self ? !domain_list_column(system, &domain->boundary, column)
                                  : !domain_add_transfer(system, domain, owners[patch], column))
            return false;
    }
    return true;
}

bool domain_move(PhysSystem *system, Domain *domain) {
    uint32_t ranks = ranks_count(system), self = ranks_self(system);
    domain->transfer_count = domain->boundary.count = domain->arrivals.count = 0;
    const double *table;
    copy_link_ends_back(system, domain);
    if (!domain_find_interior(system, domain) || !scan_boundary(system, domain) ||
        !sort_transfers(system, domain, &domain->to) || !(table = exchange_counts(system, domain, &domain->to)) ||
        !send_movers(system, domain, &domain->to))
        return false;
    for (uint32_t r = 0; r < ranks; r++)
        for (size_t i = 0; i < domain_transfer_count(&domain->to, r); i++) {
            uint32_t column = domain_transfer(&domain->to, r)[i];
            change_owner(domain, self, r, column);
            domain->local->remote[domain_local_column(domain, column)] = true;
        }
    bool done = true;
    for (uint32_t r = 0; r < ranks && done; r++)
        done = r == self || receive_movers(system, domain, table, r, &domain->from);
    return done && phys_may_continue(system);
}

// Sends or receives the positions of particles. In a new halo, their columns precede the positions.
static bool transfer_positions(PhysSystem *system, Domain *domain, Direction direction, bool new_halo) {
    const Transfers *transfers = direction == SEND ? &domain->to : &domain->from;
    const PhysSystem *home = new_halo ? system : domain->local;
    const uint32_t *column_of = new_halo ? NULL : home->column_of;
    for (uint32_t r = 0; r < ranks_count(system); r++) {
        size_t count = domain_transfer_count(transfers, r), head = new_halo ? count : 0;
        size_t length = head + system->dimensions * count;
        if (!count)
            continue;
        double *numbers = reserve_numbers(system, domain, length);
        if (!numbers)
            return false;
        uint32_t *items = (uint32_t *)transfers->items.bytes + transfers->start[r];
        if (direction == RECEIVE)
            receive_message(system, domain, r, length);
        else
            pack_columns(items, head, numbers);
        for (size_t i = 0; i < head && direction == RECEIVE; i++) {
            items[i] = (uint32_t)numbers[i];
            if (!domain_list_column(system, &domain->arrivals, items[i]))
                return false;
        }
        copy_vectors(direction, home->columns.position, &home->columns, column_of, items, count, numbers + head);
        if (direction == SEND)
            send_message(system, domain, r, length);
    }
    return true;
}

// Sets domain->from to the numbers of particles that this rank receives.
static bool expect_transfers(PhysSystem *system, Domain *domain, const double *table) {
    size_t ranks = ranks_count(system), total = 0;
    const double *received = table + ranks_self(system);
    for (size_t r = 0; r < ranks; r++)
        total += (size_t)received[r * ranks];
    if (!reserve_transfers(system, &domain->from, total))
        return false;
    domain->from.start[0] = 0;
    for (size_t r = 0; r < ranks; r++)
        domain->from.start[r + 1] = domain->from.start[r] + (uint32_t)received[r * ranks];
    return true;
}

bool domain_find_halo(PhysSystem *system, Domain *domain) {
    const double *table;
    return domain_select(system, domain) && sort_transfers(system, domain, &domain->to) &&
           (table = exchange_counts(system, domain, &domain->to)) && transfer_positions(system, domain, SEND, true) &&
           expect_transfers(system, domain, table) && transfer_positions(system, domain, RECEIVE, true) &&
           phys_may_continue(system); // an interrupted exchange delivers zeros
}

bool domain_exchange(PhysSystem *system, Domain *domain) {
    return transfer_positions(system, domain, SEND, false) && transfer_positions(system, domain, RECEIVE, false);
}
