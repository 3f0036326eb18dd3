// grid_search.c: builds neighbour lists from the cells of a grid.
#include "physics/grid.h"
#include "physics/threads.h"

enum {
    FIRST_ENTRIES = 12,                                   // initial capacity, in entries per particle
    MAX_LIST_ENTRIES = 160,                               // maximum capacity, in entries per particle
    ENTRIES_SPARE = PHYS_MAX_NEIGHBOURS * PHYS_MAX_LANES, // added to both: entries of a block with the longest lists
};

// A search for the lists of all blocks. Each chunk searches some of the blocks and fills its part of the entries.
typedef struct SearchJob {
    const Kernels *kernels;
    const ListSearch *search;
    uint64_t capacity; // number of entries for all chunks together
    ListChunk chunks[PHYS_MAX_CHUNKS];
} SearchJob;

static void search_chunk(void *context, int chunk, int chunks) {
    SearchJob *job = context;
    size_t lanes = job->kernels->lanes, capacity = (size_t)job->capacity,
           blocks = (job->search->list->view.regular + lanes - 1) / lanes;
    ListChunk *list_chunk = &job->chunks[chunk];
    *list_chunk = (ListChunk){.block = (uint32_t)phys_chunk_begin(blocks, chunk, chunks),
                              .block_end = (uint32_t)phys_chunk_begin(blocks, chunk + 1, chunks),
                              .begin = phys_chunk_begin(capacity, chunk, chunks),
                              .end = phys_chunk_begin(capacity, chunk + 1, chunks)};
    list_chunk->used = list_chunk->begin;
    job->kernels->list_search(job->search, list_chunk);
}

// Runs the search, and repeats it with more memory if necessary. Returns false if out of memory, or if lists would not
// pay off.
static bool search_all(PhysSystem *system, SearchJob *job, NeighbourList *list, uint64_t max_entries) {
    uint64_t first = (uint64_t)FIRST_ENTRIES * list->total + ENTRIES_SPARE;
    uint64_t limit = (uint64_t)MAX_LIST_ENTRIES * list->total + ENTRIES_SPARE;
    max_entries = max_entries < limit ? max_entries : limit;
    uint64_t capacity = list->entries.capacity / sizeof(uint32_t);
    job->capacity = capacity > first ? capacity : first;
    job->capacity = job->capacity < max_entries ? job->capacity : max_entries;
    for (;;) {
        if (!phys_buffer_reserve(system, &list->entries, 0, job->capacity, sizeof(uint32_t)))
            return false;
        list->view.entries = list->entries.bytes;
        int chunks = phys_chunk_count(system, list->total, PHYS_MIN_FOR_THREADS);
        phys_parallel(system, chunks, search_chunk, job);
        bool full = false;
        list->scanned = list->padded = 0;
        for (int w = 0; w < chunks; w++) {
            const ListChunk *list_chunk = &job->chunks[w];
            if (list_chunk->crowded)
                return false;
            full |= list_chunk->full;
            list->scanned += list_chunk->scanned;
            list->padded += list_chunk->used - list_chunk->begin;
        }
        if (!full)
            return true;
        if (job->capacity >= max_entries)
            return false;
        job->capacity += job->capacity / 2;
        job->capacity = job->capacity < max_entries ? job->capacity : max_entries;
    }
}

bool phys_grid_search(PhysSystem *system, const Grid *grid, uint32_t dummy, NeighbourList *list, uint64_t max_entries) {
    uint64_t own = list->ranges.at[0].count, total = list->total;
    ListSearch search = {
        .list = list, .grid = grid, .remote = system->remote, .own = phys_own_keys(list), .dummy = dummy};
    // If most particles are candidates of most others, a grid does not help, so the search stops.
    search.scan_limit = own * total / 4 + 64 * total;
    if (search.scan_limit > 4000 * total)
        search.scan_limit = 4000 * total;
    SearchJob job = {.kernels = system->kernels, .search = &search};
    return search_all(system, &job, list, max_entries);
}
