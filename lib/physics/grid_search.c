// grid_search.c: neighbour lists from the cells of a grid.
#include "physics/grid.h"
#include "physics/threads.h"

enum {
    ENTRIES_FIRST = 12, // room in the lists for so many entries a particle, at first
    ENTRIES_MOST = 160, // and at most
    ENTRIES_SPARE = PHYS_MOST_NEAR * PHYS_MOST_LANES,
};

// The lists of all blocks, made by several workers, each with a part of the blocks and of the memory.
typedef struct Shares {
    const Kernels *kernels;
    const ListSearch *search;
    uint64_t capacity; // entries in all
    ListPart parts[PHYS_MOST_SHARES];
} Shares;

static void search_share(void *context, int worker, int workers) {
    Shares *shares = context;
    size_t lanes = shares->kernels->lanes, capacity = (size_t)shares->capacity,
           blocks = (shares->search->list->view.regular + lanes - 1) / lanes;
    ListPart *part = &shares->parts[worker];
    *part = (ListPart){.block = (uint32_t)phys_share(blocks, worker, workers),
                       .block_end = (uint32_t)phys_share(blocks, worker + 1, workers),
                       .begin = phys_share(capacity, worker, workers),
                       .end = phys_share(capacity, worker + 1, workers)};
    part->used = part->begin;
    shares->kernels->list_search(shares->search, part);
}

// Runs the search, with more memory if there was too little.
static bool find_all(PhysSystem *system, Shares *shares, Neighbours *list) {
    uint64_t first = (uint64_t)ENTRIES_FIRST * list->total + ENTRIES_SPARE;
    uint64_t most = (uint64_t)ENTRIES_MOST * list->total + ENTRIES_SPARE;
    if (system->options.neighbours == PHYS_NEIGHBOURS_AUTO && most > phys_max_useful_entries(list))
        most = phys_max_useful_entries(list);
    uint64_t room = list->entries.capacity / sizeof(uint32_t);
    shares->capacity = room > first ? room : first;
    shares->capacity = shares->capacity < most ? shares->capacity : most;
    for (;;) {
        if (!phys_buffer_reserve(system, &list->entries, 0, shares->capacity, sizeof(uint32_t)))
            return false;
        list->view.entries = list->entries.bytes;
        int workers = phys_shares(system, list->total, PHYS_MIN_FOR_THREADS);
        phys_parallel(system, workers, search_share, shares);
        bool full = false;
        list->scanned = list->padded = 0;
        for (int w = 0; w < workers; w++) {
            const ListPart *part = &shares->parts[w];
            if (part->crowded)
                return false;
            full |= part->full;
            list->scanned += part->scanned;
            list->padded += part->used - part->begin;
        }
        if (!full)
            return true;
        if (shares->capacity >= most)
            return false;
        shares->capacity += shares->capacity / 2;
        shares->capacity = shares->capacity < most ? shares->capacity : most;
    }
}

bool phys_grid_search(PhysSystem *system, const Kernels *kernels, const Grid *grid, uint32_t dummy, Neighbours *list) {
    uint64_t own = list->ranges.at[0].count, total = list->total;
    ListSearch search = {
        .list = list, .grid = grid, .foreign = system->foreign, .own = phys_own_keys(list), .dummy = dummy};
    // Where nearly everybody is a candidate of everybody, a grid does not help.
    search.scan_limit = own * total / 4 + 64 * total;
    if (search.scan_limit > 4000 * total)
        search.scan_limit = 4000 * total;
    Shares shares = {.kernels = kernels, .search = &search};
    return find_all(system, &shares, list);
}
