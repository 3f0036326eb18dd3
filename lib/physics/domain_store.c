// domain_store.c: the end of a frame: what all ranks have come to goes into the rows of each.
#include "physics/domain.h"
#include "physics/threads.h"

#include <string.h>

enum {
    MIN_FOR_THREADS = 10000, // particles
    TAIL = 2,                // numbers of a rank behind those of its particles: the seconds it worked, and below
};

// A number that may not go into a row as it is: not finite, or a zero, which may equal the row's. (0 * inf is NaN.)
static inline bool is_special(double x) {
    return !(x * 0 == 0 && x != 0);
}

typedef struct Sharing {
    PhysSystem *system;
    Domain *domain;
    size_t width;                   // numbers of a particle: position, velocity, perhaps the force
    double *mine;                   // of own particles, in the order of columns
    bool special[PHYS_MOST_SHARES]; // by share: of own particles some number is
    // what came from all
    bool keep_last_finite;
    double *whole;
    const size_t *starts; // where the numbers of each rank begin
    size_t *next;         // by share and rank: where those of the next particle are
    bool any_not_finite[PHYS_MOST_SHARES];
} Sharing;

static inline bool pack_range(const Sharing *sharing, size_t n, size_t first, size_t end) {
    const Columns *columns = &sharing->domain->local->columns;
    const uint32_t *own = sharing->domain->own.bytes;
    size_t width = sharing->width, stride = columns->stride;
    bool special = false;
    for (size_t i = first; i < end; i++) {
        uint32_t at = phys_local_column(sharing->domain, own[i]);
        double *to = sharing->mine + i * width;
        for (size_t k = 0; k < n; k++) {
            to[k] = columns->position[k * stride + at];
            to[n + k] = columns->velocity[k * stride + at];
            special |= is_special(to[k]) || is_special(to[n + k]);
        }
        for (size_t k = 2 * n; k < width; k++)
            to[k] = columns->force[(k - 2 * n) * stride + at];
    }
    return special;
}

static void pack_share(void *context, int share, int shares) {
    Sharing *sharing = context;
    size_t n = sharing->system->dimensions, count = sharing->domain->own_count;
    size_t first = phys_share(count, share, shares), end = phys_share(count, share + 1, shares);
    sharing->special[share] = n == 2   ? pack_range(sharing, 2, first, end)
                              : n == 3 ? pack_range(sharing, 3, first, end)
                                       : pack_range(sharing, n, first, end);
}

// How many numbers of each rank come before those of the next share.
static void count_share(void *context, int share, int shares) {
    const Sharing *sharing = context;
    size_t ranks = (size_t)sharing->system->options.ranks.count, count = sharing->system->particle_count;
    const uint32_t *owners = phys_owners(sharing->domain);
    if (share + 1 == shares)
        return;
    size_t *next = sharing->next + (size_t)(share + 1) * ranks;
    for (size_t i = phys_share(count, share, shares), end = phys_share(count, share + 1, shares); i < end; i++)
        next[owners[i]] += sharing->width;
}

// One particle for which the rule of PhysTime.keep_last_finite must be looked at; its numbers end up as the row's.
static bool keep_one(const Sharing *sharing, uint32_t column, double *numbers) {
    const PhysSystem *system = sharing->system;
    size_t n = system->dimensions;
    bool kept = !phys_keep_row(system, n, system->order[column], numbers, numbers + n, 1);
    if (phys_owners(sharing->domain)[column] == (uint32_t)system->options.ranks.rank) {
        const Columns *columns = &sharing->domain->local->columns;
        uint32_t here = phys_local_column(sharing->domain, sharing->domain->local_of[column]);
        for (size_t k = 0; k < n; k++) {
            columns->position[k * columns->stride + here] = numbers[k];
            columns->velocity[k * columns->stride + here] = numbers[n + k];
        }
    }
    return kept;
}

static inline bool any_special(const double *numbers, size_t count) {
    bool special = false;
    for (size_t k = 0; k < count; k++)
        special |= is_special(numbers[k]);
    return special;
}

static void take_force(const PhysSystem *system, size_t n, uint32_t column, const double *force) {
    double *row = (double *)system->force_rows.bytes + n * system->order[column];
    for (size_t k = 0; k < n; k++)
        row[k] = system->columns.anchor[column] ? 0 : force[k];
}

static inline bool unpack_range(const Sharing *sharing, size_t n, size_t first, size_t end, size_t *next) {
    const PhysSystem *system = sharing->system;
    const uint32_t *owners = phys_owners(sharing->domain);
    bool all_finite = true, watched = sharing->keep_last_finite && system->any_from_attribute;
    bool forces = sharing->width > 2 * n && system->stepped;
    for (size_t i = first; i < end; i++) {
        uint32_t owner = owners[i];
        double *numbers = sharing->whole + next[owner];
        next[owner] += sharing->width;
        bool special = sharing->keep_last_finite && sharing->whole[sharing->starts[owner + 1] - 1] > 0;
        if (watched || (special && any_special(numbers, 2 * n)))
            all_finite &= keep_one(sharing, (uint32_t)i, numbers);
        else
            memcpy((double *)system->rows.bytes + 2 * n * system->order[i], numbers, 2 * n * sizeof *numbers);
        if (forces)
            take_force(system, n, (uint32_t)i, numbers + 2 * n);
    }
    return all_finite;
}

static void unpack_share(void *context, int share, int shares) {
    Sharing *sharing = context;
    const PhysSystem *system = sharing->system;
    size_t n = system->dimensions, *next = sharing->next + (size_t)share * (size_t)system->options.ranks.count;
    size_t first = phys_share(system->particle_count, share, shares),
           end = phys_share(system->particle_count, share + 1, shares);
    sharing->any_not_finite[share] = !(n == 2   ? unpack_range(sharing, 2, first, end, next)
                                       : n == 3 ? unpack_range(sharing, 3, first, end, next)
                                                : unpack_range(sharing, n, first, end, next));
}

// Where the numbers of each rank begin among those of all; its tail comes after them.
static bool lay_out(PhysSystem *system, Domain *domain, size_t width) {
    size_t ranks = (size_t)system->options.ranks.count;
    if (!phys_buffer_reserve(system, &domain->starts, 0, ranks + 1, sizeof(size_t)) ||
        !phys_buffer_reserve(system, &domain->nexts, 0, ranks * PHYS_MOST_SHARES, sizeof(size_t)) ||
        !phys_buffer_reserve(system, &domain->whole, 0, width * system->particle_count + TAIL * ranks, sizeof(double)))
        return false;
    size_t *starts = domain->starts.bytes;
    starts[0] = 0;
    for (size_t r = 0; r < ranks; r++)
        starts[r + 1] = starts[r] + width * ((const uint32_t *)domain->counts.bytes)[r] + TAIL;
    return true;
}

static void pack(Sharing *sharing) {
    const PhysSystem *system = sharing->system;
    size_t own = sharing->domain->own_count;
    int shares = phys_shares(system, own, MIN_FOR_THREADS);
    sharing->mine = sharing->whole + sharing->starts[system->options.ranks.rank];
    phys_parallel(system, shares, pack_share, sharing);
    double *tail = sharing->mine + own * sharing->width;
    tail[0] = sharing->domain->seconds;
    tail[1] = 0;
    for (int s = 0; s < shares; s++)
        tail[1] += sharing->special[s];
}

static void unpack(Sharing *sharing) {
    PhysSystem *system = sharing->system;
    size_t ranks = (size_t)system->options.ranks.count, *next = sharing->next;
    int shares = phys_shares(system, system->particle_count, MIN_FOR_THREADS);
    memcpy(next, sharing->starts, ranks * sizeof *next);
    memset(next + ranks, 0, (size_t)(shares - 1) * ranks * sizeof *next);
    phys_parallel(system, shares, count_share, sharing);
    for (size_t i = ranks; i < (size_t)shares * ranks; i++)
        next[i] += next[i - ranks];
    phys_parallel(system, shares, unpack_share, sharing);
    for (int s = 0; s < shares; s++)
        system->any_not_finite |= sharing->any_not_finite[s];
}

bool phys_domain_store(PhysSystem *system, bool keep_last_finite) {
    Domain *domain = system->domain.bytes;
    const PhysRanks *ranks = &system->options.ranks;
    size_t width = (system->options.keep_forces ? 3 : 2) * (size_t)system->dimensions;
    domain->made = false;
    if (!lay_out(system, domain, width))
        return false;
    const size_t *starts = domain->starts.bytes;
    double *loads = domain->loads.bytes;
    Sharing sharing = {.system = system,
                       .domain = domain,
                       .width = width,
                       .keep_last_finite = keep_last_finite,
                       .whole = domain->whole.bytes,
                       .starts = starts,
                       .next = domain->nexts.bytes};
    pack(&sharing);
    ranks->gather(ranks->host, sharing.whole, starts);
    system->traffic.frame_bytes += (starts[ranks->rank + 1] - starts[ranks->rank]) * sizeof(double);
    if (!phys_goes_on(system))
        return false;
    for (int r = 0; r < ranks->count; r++)
        loads[r] = sharing.whole[starts[r + 1] - TAIL];
    unpack(&sharing);
    system->any_from_attribute &= !keep_last_finite || system->any_not_finite;
    system->behind = true;
    return domain->made = true;
}
