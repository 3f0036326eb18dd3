// domain_store.c: the end of a frame: what all ranks have come to goes into the rows of each.
//
// What a rank has is a part of its own of what is whole: columns of its particles, in the order in which its local
// system has them, their handles, and a tail.
#include "physics/domain.h"
#include "physics/threads.h"

enum {
    LINE = 8, // doubles by which columns, and what is behind them, are rounded up
    TAIL = LINE,
};

typedef struct Part {
    Columns columns;
    uint32_t *handles;
    double *tail; // the seconds that it worked
} Part;

static size_t rounded(size_t doubles) {
    return (doubles + LINE - 1) / LINE * LINE;
}

// Doubles of a part.
static size_t part_length(uint32_t count, size_t vectors, size_t n) {
    return vectors * n * rounded(count) + rounded((count + 1) / 2) + TAIL;
}

static Part part_at(double *numbers, uint32_t count, size_t vectors, size_t n) {
    size_t stride = rounded(count);
    Columns columns = {.dimensions = n, .count = count, .stride = stride, .position = numbers};
    columns.velocity = numbers + n * stride;
    columns.force = numbers + 2 * n * stride;
    double *handles = numbers + vectors * n * stride;
    return (Part){columns, (uint32_t *)handles, handles + rounded((count + 1) / 2)};
}

typedef struct Packing {
    const PhysSystem *system;
    const PhysSystem *local;
    Part part;
    size_t vectors;
    uint32_t start[PHYS_MOST_SHARES]; // own particles before each share
} Packing;

// A run of own particles, to place `to` on.
static void pack_run(const Packing *packing, size_t first, size_t count, size_t to) {
    const Columns *from = &packing->local->columns, *into = &packing->part.columns;
    for (size_t k = 0; k < from->dimensions; k++) {
        size_t here = k * from->stride + first, there = k * into->stride + to;
        memcpy(into->position + there, from->position + here, count * sizeof(double));
        memcpy(into->velocity + there, from->velocity + here, count * sizeof(double));
        for (size_t i = 0; packing->vectors > 2 && i < count; i++)
            into->force[there + i] = from->anchor[first + i] ? 0 : from->force[here + i];
    }
    for (size_t i = 0; i < count; i++)
        packing->part.handles[to + i] = packing->system->order[packing->local->order[first + i]];
}

static uint32_t first_of(const PhysSystem *local, int share, int shares) {
    return (uint32_t)phys_share(local->particle_count, share, shares);
}

static void pack_share(void *context, int share, int shares) {
    const Packing *packing = context;
    const PhysSystem *local = packing->local;
    uint32_t end = first_of(local, share + 1, shares), to = packing->start[share];
    for (uint32_t stop, first = first_of(local, share, shares); first < end; first = stop + 1) {
        stop = phys_next_foreign(local, first);
        stop = stop < end ? stop : end;
        pack_run(packing, first, stop - first, to);
        to += stop - first;
    }
}

static void pack(const PhysSystem *system, const Domain *domain, Part part, size_t vectors) {
    enum { MIN_FOR_THREADS = 10000 }; // particles
    const PhysSystem *local = domain->local;
    Packing packing = {.system = system, .local = local, .part = part, .vectors = vectors};
    int shares = phys_shares(local, local->particle_count, MIN_FOR_THREADS);
    for (int s = 1; s < shares; s++) {
        uint32_t first = first_of(local, s - 1, shares), end = first_of(local, s, shares);
        packing.start[s] = packing.start[s - 1] + end - first;
        for (; (first = phys_next_foreign(local, first)) < end; first++)
            packing.start[s]--;
    }
    phys_parallel(local, shares, pack_share, &packing);
    *part.tail = domain->seconds;
}

bool phys_domain_store(PhysSystem *system, bool keep_last_finite) {
    Domain *domain = system->domain.bytes;
    const PhysRanks *ranks = &system->options.ranks;
    const uint32_t *counts = domain->counts.bytes;
    size_t n = system->dimensions, vectors = system->options.keep_forces ? 3 : 2;
    domain->made = false;
    if (!phys_buffer_reserve(system, &domain->starts, 0, (size_t)ranks->count + 1, sizeof(size_t)))
        return false;
    size_t *starts = domain->starts.bytes;
    starts[0] = 0;
    for (int r = 0; r < ranks->count; r++)
        starts[r + 1] = starts[r] + part_length(counts[r], vectors, n);
    double *whole = ranks->share ? ranks->share(ranks->host, starts[ranks->count]) : NULL;
    bool common = whole;
    if (!common && !phys_buffer_reserve(system, &domain->whole, 0, starts[ranks->count], sizeof(double)))
        return false;
    whole = common ? whole : domain->whole.bytes;
    pack(system, domain, part_at(whole + starts[ranks->rank], counts[ranks->rank], vectors, n), vectors);
    double nothing = 0;
    if (common)
        ranks->most(ranks->host, &nothing, 1); // all are done when it returns
    else
        ranks->gather(ranks->host, whole, starts);
    system->traffic.frame_bytes += common ? 0 : (starts[ranks->rank + 1] - starts[ranks->rank]) * sizeof(double);
    if (!phys_goes_on(system))
        return false;
    for (int r = 0; r < ranks->count; r++) {
        Part part = part_at(whole + starts[r], counts[r], vectors, n);
        ((double *)domain->loads.bytes)[r] = *part.tail;
        phys_store_columns(system, &part.columns, part.handles, keep_last_finite,
                           r == ranks->rank ? domain->local : NULL);
    }
    system->any_from_attribute &= !keep_last_finite || system->any_not_finite;
    system->behind = true;
    return domain->made = true;
}
