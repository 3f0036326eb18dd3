// grid_search.c: neighbour lists from the cells of a grid.
#include "physics/grid.h"
#include "physics/threads.h"

enum {
    NEAR_MOST = 1024,   // longest list
    NEAR_CHUNK = 256,   // candidates looked at in one go
    ENTRIES_FIRST = 12, // room in the lists for so many entries a particle, at first
    ENTRIES_MOST = 160, // and at most
};

static void sort_keys(uint64_t *keys, size_t count) {
    for (size_t gap = count > 48 ? count / 2 : 1; gap; gap /= 2)
        for (size_t i = gap; i < count; i++) {
            uint64_t key = keys[i];
            size_t k = i;
            for (; k >= gap && keys[k - gap] > key; k -= gap)
                keys[k] = keys[k - gap];
            keys[k] = key;
        }
}

// The lists of all blocks, made by several workers, each with a part of the blocks and of the memory.
typedef struct Search {
    const Kernels *kernels;
    const Neighbours *list;
    const Grid *grid;
    const bool *foreign; // by column: needs no list; NULL: none
    uint32_t own;        // places with a key below are of the pass's own group
    uint32_t dummy;
    uint64_t capacity;    // entries in all
    uint64_t scan_limit;  // candidates for each worker
    bool *crowded, *full; // by worker: too many neighbours for lists; no more room
    uint64_t *scanned, *padded;
} Search;

typedef struct Finder {
    const Search *search;
    NearQuery query;
    uint64_t scanned;
    size_t found;
    bool crowded;
    uint32_t near[NEAR_MOST + NEAR_CHUNK + PHYS_MOST_LANES];
    uint64_t keys[NEAR_MOST];
} Finder;

static void find_between(Finder *finder, uint32_t first, uint32_t end) {
    const Search *search = finder->search;
    for (uint32_t begin = first; begin < end; begin += NEAR_CHUNK) {
        uint32_t stop = end - begin > NEAR_CHUNK ? begin + NEAR_CHUNK : end;
        if (finder->found > NEAR_MOST) {
            finder->crowded = true;
            return;
        }
        finder->found += search->kernels->list_near(&search->list->view, search->grid->dimensions, &finder->query,
                                                    begin, stop, finder->near + finder->found);
    }
    finder->scanned += end - first;
}

static void find_around(Finder *finder) {
    const Grid *grid = finder->search->grid;
    uint32_t low[PHYS_VECTOR_DIMENSIONS] = {0}, high[PHYS_VECTOR_DIMENSIONS] = {0};
    for (size_t k = 0; k < grid->dimensions; k++) {
        uint32_t cell = phys_axis_cell(grid, k, finder->query.place[k]);
        low[k] = cell ? cell - 1 : 0;
        high[k] = cell + 1 < grid->cells[k] ? cell + 1 : cell;
    }
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++) {
            size_t row = ((size_t)z * grid->cells[1] + y) * grid->cells[0];
            find_between(finder, grid->start[row + low[0]], grid->start[row + high[0] + 1]);
        }
    find_between(finder, finder->search->list->view.regular, finder->search->list->view.listed);
}

// Puts the list of one place into the order of the pass. Two particles of enclosing groups are no pair.
static size_t find_list(Finder *finder, uint32_t place) {
    const Neighbours *list = finder->search->list;
    for (size_t k = 0; k < finder->search->grid->dimensions; k++)
        finder->query.place[k] = list->view.built[k][place];
    finder->query.radius = list->view.radius[place];
    finder->found = 0;
    find_around(finder);
    if (finder->crowded || finder->found > NEAR_MOST) {
        finder->crowded = true;
        return 0;
    }
    uint32_t limit = list->key[place] < finder->search->own ? UINT32_MAX : finder->search->own;
    size_t count = 0;
    for (size_t k = 0; k < finder->found; k++) {
        uint32_t key = list->key[finder->near[k]];
        finder->keys[count] = (uint64_t)key << 32 | finder->near[k];
        count += finder->near[k] != place && key < limit;
    }
    sort_keys(finder->keys, count);
    return count;
}

// The lists of one block side by side; false if there is no room for them.
static bool find_block(Finder *finder, uint32_t block, uint64_t *used, uint64_t end) {
    const Search *search = finder->search;
    const ListView *view = &search->list->view;
    uint32_t lanes = (uint32_t)search->list->lanes, first = block * lanes, *entries = view->entries + *used;
    uint32_t most = 0;
    for (uint32_t lane = 0; lane < lanes && first + lane < view->regular; lane++) {
        if (search->foreign && search->foreign[view->column[first + lane]])
            continue;
        size_t count = find_list(finder, first + lane);
        if (*used + (uint64_t)(count > most ? count : most) * lanes > end)
            return false;
        for (; most < count; most++)
            for (uint32_t l = 0; l < lanes; l++)
                entries[most * lanes + l] = search->dummy;
        for (size_t k = 0; k < count; k++)
            entries[k * lanes + lane] = (uint32_t)finder->keys[k];
    }
    view->at[block] = *used;
    view->most[block] = most;
    *used += (uint64_t)most * lanes;
    return true;
}

static void find_blocks(void *context, int worker, int workers) {
    const Search *search = context;
    const Neighbours *list = search->list;
    Finder finder = {.search = search, .query = {.bound = list->bound, .skin = list->skin}};
    size_t blocks = (list->view.regular + list->lanes - 1) / list->lanes;
    size_t capacity = (size_t)search->capacity; // entries are in memory
    uint64_t begin = phys_share(capacity, worker, workers), used = begin;
    uint64_t end = phys_share(capacity, worker + 1, workers);
    size_t stop = phys_share(blocks, worker + 1, workers);
    search->crowded[worker] = search->full[worker] = false;
    for (size_t block = phys_share(blocks, worker, workers); block < stop && !finder.crowded; block++) {
        if (!find_block(&finder, (uint32_t)block, &used, end)) {
            search->full[worker] = !finder.crowded;
            break;
        }
        finder.crowded |= finder.scanned > search->scan_limit;
    }
    search->crowded[worker] = finder.crowded;
    search->scanned[worker] = finder.scanned;
    search->padded[worker] = used - begin;
}

// Runs the search, with more memory if there was too little.
static bool find_all(PhysSystem *system, Search *search, Neighbours *list) {
    bool crowded[PHYS_MOST_SHARES] = {0}, full[PHYS_MOST_SHARES] = {0};
    uint64_t scanned[PHYS_MOST_SHARES] = {0}, padded[PHYS_MOST_SHARES] = {0};
    search->crowded = crowded;
    search->full = full;
    search->scanned = scanned;
    search->padded = padded;
    uint64_t first = (uint64_t)ENTRIES_FIRST * list->total + NEAR_MOST * PHYS_MOST_LANES;
    uint64_t most = (uint64_t)ENTRIES_MOST * list->total + NEAR_MOST * PHYS_MOST_LANES;
    if (system->options.neighbours == PHYS_NEIGHBOURS_AUTO && most > phys_max_useful_entries(list))
        most = phys_max_useful_entries(list);
    uint64_t room = list->entries.capacity / sizeof(uint32_t);
    search->capacity = room > first ? room : first;
    search->capacity = search->capacity < most ? search->capacity : most;
    for (;;) {
        if (!phys_buffer_reserve(system, &list->entries, 0, search->capacity, sizeof(uint32_t)))
            return false;
        list->view.entries = list->entries.bytes;
        phys_parallel(system, phys_shares(system, list->total, PHYS_MIN_FOR_THREADS), find_blocks, search);
        bool too_full = false;
        list->scanned = list->padded = 0;
        for (int w = 0; w < PHYS_MOST_SHARES; w++) {
            if (crowded[w])
                return false;
            too_full |= full[w];
            list->scanned += scanned[w];
            list->padded += padded[w];
        }
        if (!too_full)
            return true;
        if (search->capacity >= most)
            return false;
        search->capacity += search->capacity / 2;
        search->capacity = search->capacity < most ? search->capacity : most;
    }
}

bool phys_grid_search(PhysSystem *system, const Kernels *kernels, const Grid *grid, uint32_t dummy, Neighbours *list) {
    uint64_t own = list->ranges.at[0].count, total = list->total;
    Search search = {.kernels = kernels,
                     .list = list,
                     .grid = grid,
                     .foreign = system->foreign,
                     .own = (uint32_t)own,
                     .dummy = dummy};
    // Where nearly everybody is a candidate of everybody, a grid does not help.
    search.scan_limit = own * total / 4 + 64 * total;
    if (search.scan_limit > 4000 * total)
        search.scan_limit = 4000 * total;
    return find_all(system, &search, list);
}
