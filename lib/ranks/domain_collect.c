// domain_collect.c: collects the results of all ranks in the rows of every rank at the end of a frame.
//
// Each rank fills one section of a common array. A section has three parts: columns of the rank's own particles in
// local order, the handles of these particles, and a tail.
#include "physics/threads.h"
#include "ranks/domain.h"

enum {
    LINE = 8,    // doubles in a cache line; the parts of a section are padded to whole lines
    TAIL = LINE, // doubles in a tail, of which one is used
};

typedef struct RankSection {
    Columns columns;
    uint32_t *handles;
    double *tail; // Domain.seconds of the rank
} RankSection;

static size_t round_up(size_t doubles) {
    return (doubles + LINE - 1) / LINE * LINE;
}

// Returns the number of doubles in a section.
static size_t section_length(uint32_t count, size_t vectors, size_t n) {
    return vectors * n * round_up(count) + round_up((count + 1) / 2) + TAIL;
}

static RankSection section_at(double *numbers, uint32_t count, size_t vectors, size_t n) {
    size_t stride = round_up(count);
    Columns columns = {.dimensions = n, .count = count, .stride = stride, .position = numbers};
    columns.velocity = numbers + n * stride;
    columns.force = numbers + 2 * n * stride;
    double *handles = numbers + vectors * n * stride;
    return (RankSection){columns, (uint32_t *)handles, handles + round_up((count + 1) / 2)};
}

typedef struct Packing {
    const PhysSystem *system;
    const PhysSystem *local;
    RankSection section;
    size_t vectors;                  // number of vectors per particle: 2 (position and velocity) or 3 (also force)
    uint32_t start[PHYS_MAX_CHUNKS]; // by chunk: number of owned particles in earlier chunks
} Packing;

// Copies `count` owned particles, starting at local column `first`, to the section, starting at index `to`.
static void pack_range(const Packing *packing, size_t first, size_t count, size_t to) {
    const Columns *from = &packing->local->columns, *into = &packing->section.columns;
    for (size_t k = 0; k < from->dimensions; k++) {
        size_t here = k * from->stride + first, there = k * into->stride + to;
        memcpy(into->position + there, from->position + here, count * sizeof(double));
        memcpy(into->velocity + there, from->velocity + here, count * sizeof(double));
        for (size_t i = 0; packing->vectors > 2 && i < count; i++)
            into->force[there + i] = from->anchor[first + i] ? 0 : from->force[here + i];
    }
    for (size_t i = 0; i < count; i++)
        packing->section.handles[to + i] = packing->system->order[packing->local->order[first + i]];
}

static uint32_t chunk_first(const PhysSystem *local, int chunk, int chunks) {
    return (uint32_t)phys_chunk_begin(local->particle_count, chunk, chunks);
}

static void pack_chunk(void *context, int chunk, int chunks) {
    const Packing *packing = context;
    const PhysSystem *local = packing->local;
    uint32_t end = chunk_first(local, chunk + 1, chunks), to = packing->start[chunk];
    for (uint32_t stop, first = chunk_first(local, chunk, chunks); first < end; first = stop + 1) {
        stop = phys_next_remote(local, first);
        stop = stop < end ? stop : end;
        pack_range(packing, first, stop - first, to);
        to += stop - first;
    }
}

static void pack_section(const PhysSystem *system, const Domain *domain, RankSection section, size_t vectors) {
    enum { MIN_FOR_THREADS = 10000 }; // with fewer particles, one thread is used
    const PhysSystem *local = domain->local;
    Packing packing = {.system = system, .local = local, .section = section, .vectors = vectors};
    int chunks = phys_chunk_count(local, local->particle_count, MIN_FOR_THREADS);
    for (int s = 1; s < chunks; s++) {
        uint32_t first = chunk_first(local, s - 1, chunks), end = chunk_first(local, s, chunks);
        packing.start[s] = packing.start[s - 1] + end - first;
        for (; (first = phys_next_remote(local, first)) < end; first++)
            packing.start[s]--;
    }
    phys_parallel(local, chunks, pack_chunk, &packing);
    *section.tail = domain->seconds;
}

bool domain_collect(PhysSystem *system, Domain *domain, bool keep_last_finite) {
    const PetriRanks *ranks = ranks_of(system);
    const uint32_t *counts = domain->counts.bytes;
    size_t n = system->dimensions, vectors = system->options.keep_forces ? 3 : 2;
    if (!phys_buffer_reserve(system, &domain->starts, 0, (size_t)ranks->rank_count + 1, sizeof(size_t)))
        return false;
    size_t *starts = domain->starts.bytes;
    starts[0] = 0;
    for (int r = 0; r < ranks->rank_count; r++)
        starts[r + 1] = starts[r] + section_length(counts[r], vectors, n);
    double *gathered = ranks->alloc_shared ? ranks->alloc_shared(ranks->user_data, starts[ranks->rank_count]) : NULL;
    bool shared = gathered;
    if (!shared && !phys_buffer_reserve(system, &domain->gathered, 0, starts[ranks->rank_count], sizeof(double)))
        return false;
    gathered = shared ? gathered : domain->gathered.bytes;
    pack_section(system, domain, section_at(gathered + starts[ranks->rank], counts[ranks->rank], vectors, n), vectors);
    double nothing = 0;
    if (shared)
        ranks->allreduce_max(ranks->user_data, &nothing, 1); // used as a barrier: waits until all ranks have written
    else
        ranks->allgatherv(ranks->user_data, gathered, starts);
    domain->stats.frame_bytes += shared ? 0 : (starts[ranks->rank + 1] - starts[ranks->rank]) * sizeof(double);
    if (!phys_may_continue(system))
        return false;
    for (int r = 0; r < ranks->rank_count; r++) {
        RankSection section = section_at(gathered + starts[r], counts[r], vectors, n);
        ((double *)domain->rank_seconds.bytes)[r] = *section.tail;
        phys_write_column_rows(system, &section.columns, section.handles, keep_last_finite,
                               r == ranks->rank ? domain->local : NULL);
    }
    system->any_from_attribute &= !keep_last_finite || system->any_not_finite;
    return true;
}
