// grid.c: sorts the particles of a pass into the cells of a grid and makes their neighbour lists.
//
// Cells are at least as wide as the reach of a regular particle, so its neighbours are in its own cell and the ones
// around it. The grid covers where most particles are; those outside count to the cells at its rim, which is right
// however far away they are: it keeps neighbours in the same or in adjacent cells. Particles that are much larger than
// the others (a few may be) are in no cell; everyone tests them.
#include "physics/neighbours.h"
#include "physics/threads.h"

#include <float.h>

enum {
    SAMPLES = 256,      // particles by which the grid is chosen
    NEAR_MOST = 1024,   // longest list
    NEAR_CHUNK = 256,   // candidates looked at in one go
    LANES_MOST = 8,     // of any kernel
    ENTRIES_FIRST = 12, // room in the lists for so many entries a particle, at first
    ENTRIES_MOST = 160, // and at most
};

typedef struct Grid {
    size_t dimensions;
    double low[PHYS_VECTOR_DIMENSIONS];
    double scale[PHYS_VECTOR_DIMENSIONS]; // cells per length
    uint32_t cells[PHYS_VECTOR_DIMENSIONS];
    uint32_t *start; // places of cell c: start[c] up to start[c + 1]
} Grid;

// What is known of the particles before they are sorted.
typedef struct Survey {
    double low[PHYS_VECTOR_DIMENSIONS], high[PHYS_VECTOR_DIMENSIONS];
    double sample[PHYS_VECTOR_DIMENSIONS + 1][SAMPLES]; // positions and radii
    size_t samples;
    double large;  // radius above which a particle is large
    double widest; // radius of the largest regular one
    uint32_t regular, large_count;
} Survey;

// Squares of lengths that a list deals with must be normal numbers.
#define SHORTEST 1e-100

// Instead of a cell.
#define IDLE UINT32_MAX
#define LARGE (UINT32_MAX - 1)

static void sort_doubles(double *values, size_t count) {
    for (size_t gap = count / 2; gap; gap /= 2)
        for (size_t i = gap; i < count; i++) {
            double value = values[i];
            size_t k = i;
            for (; k >= gap && values[k - gap] > value; k -= gap)
                values[k] = values[k - gap];
            values[k] = value;
        }
}

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

static bool idle(const PairPass *pass, const Neighbours *list, size_t column) {
    bool lost = list->touch_only && pass->radius[column] == 0;
    for (size_t k = 0; k < pass->dimensions; k++)
        lost |= !isfinite(pass->position[k * pass->stride + column]);
    return lost;
}

// Looks at some of the particles, so that outliers cannot spoil the grid.
static void take_samples(const PairPass *pass, const Neighbours *list, Survey *survey) {
    uint64_t every = list->total / SAMPLES + 1, number = 0;
    survey->samples = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++) {
        const ColumnRange *range = &list->ranges.at[r];
        for (uint32_t i = 0; i < range->count; i++, number++) {
            if (number % every || idle(pass, list, range->first + i))
                continue;
            for (size_t k = 0; k < pass->dimensions; k++)
                survey->sample[k][survey->samples] = pass->position[k * pass->stride + range->first + i];
            survey->sample[PHYS_VECTOR_DIMENSIONS][survey->samples++] = pass->radius[range->first + i];
        }
    }
    for (size_t k = 0; k <= PHYS_VECTOR_DIMENSIONS; k++)
        sort_doubles(survey->sample[k], k < pass->dimensions || k == PHYS_VECTOR_DIMENSIONS ? survey->samples : 0);
}

// Extent of all, and how many are large; fills list->cell with IDLE, LARGE or 0.
static void survey_all(const PairPass *pass, Neighbours *list, Survey *survey) {
    uint32_t rank = 0;
    for (size_t k = 0; k < pass->dimensions; k++) {
        survey->low[k] = INFINITY;
        survey->high[k] = -INFINITY;
    }
    survey->widest = 0;
    survey->regular = survey->large_count = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++)
        for (uint32_t i = 0; i < list->ranges.at[r].count; i++, rank++) {
            size_t column = (size_t)list->ranges.at[r].first + i;
            if (idle(pass, list, column)) {
                list->cell[rank] = IDLE;
                continue;
            }
            if (pass->radius[column] > survey->large) {
                list->cell[rank] = LARGE;
                survey->large_count++;
                continue;
            }
            list->cell[rank] = 0;
            survey->regular++;
            survey->widest = fmax(survey->widest, pass->radius[column]);
            for (size_t k = 0; k < pass->dimensions; k++) {
                double x = pass->position[k * pass->stride + column];
                survey->low[k] = x < survey->low[k] ? x : survey->low[k];
                survey->high[k] = x > survey->high[k] ? x : survey->high[k];
            }
        }
}

// Where the grid lies and how fine it is: cells no narrower than `width`, and not many more of them than particles.
static void choose_cells(const Survey *survey, double width, Grid *grid) {
    double most = 2.0 * survey->regular + 64, product = 1;
    double span[PHYS_VECTOR_DIMENSIONS];
    for (size_t k = 0; k < grid->dimensions; k++) {
        const double *sample = survey->sample[k];
        size_t edge = survey->samples / 4;
        double low = survey->samples ? sample[edge] : 0,
               high = survey->samples ? sample[survey->samples - 1 - edge] : 0;
        double usual = high - low;
        low = fmax(survey->low[k], low - 1.5 * usual);
        high = fmin(survey->high[k], high + 1.5 * usual);
        grid->low[k] = low;
        span[k] = high - low;
        product *= fmax(span[k] / width, 1);
    }
    if (product > most)
        width *= pow(product / most, 1.0 / (double)grid->dimensions);
    product = 1;
    for (size_t k = 0; k < grid->dimensions; k++) {
        double cells = floor(span[k] / width);
        cells = cells >= 1 && cells <= most / product ? cells : 1; // also where the span is not finite
        product *= cells;
        grid->cells[k] = (uint32_t)cells;
        grid->scale[k] = cells > 1 ? cells / span[k] : 0;
    }
}

static uint32_t axis_cell(const Grid *grid, size_t k, double x) {
    if (grid->cells[k] == 1)
        return 0;
    double cell = (x - grid->low[k]) * grid->scale[k], last = grid->cells[k] - 1;
    return (uint32_t)(cell > 0 ? cell < last ? cell : last : 0);
}

static uint32_t cell_of(const Grid *grid, const double *position, size_t stride) {
    uint32_t cell = 0;
    for (size_t k = grid->dimensions; k-- > 0;)
        cell = cell * grid->cells[k] + axis_cell(grid, k, position[k * stride]);
    return cell;
}

static void put_into_place(const PairPass *pass, Neighbours *list, uint32_t place, uint32_t rank, size_t column) {
    list->view.column[place] = (uint32_t)column;
    list->key[place] = rank;
    for (size_t k = 0; k < pass->dimensions; k++)
        list->view.built[k][place] = pass->position[k * pass->stride + column];
    list->view.radius[place] = pass->radius[column];
}

// A stable counting sort by cell: inside a cell, places are in the order of the pass.
static void sort_by_cell(const PairPass *pass, Neighbours *list, const Survey *survey, Grid *grid) {
    uint32_t cells = 1, rank = 0, large = survey->regular, rest = survey->regular + survey->large_count;
    for (size_t k = 0; k < grid->dimensions; k++)
        cells *= grid->cells[k];
    for (uint32_t c = 0; c < cells + 2; c++)
        grid->start[c] = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++)
        for (uint32_t i = 0; i < list->ranges.at[r].count; i++, rank++)
            if (list->cell[rank] < LARGE) {
                list->cell[rank] = cell_of(grid, pass->position + list->ranges.at[r].first + i, pass->stride);
                grid->start[list->cell[rank] + 2]++;
            }
    for (uint32_t c = 2; c < cells + 2; c++)
        grid->start[c] += grid->start[c - 1];
    rank = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++)
        for (uint32_t i = 0; i < list->ranges.at[r].count; i++, rank++) {
            uint32_t cell = list->cell[rank];
            uint32_t place = cell == IDLE ? rest++ : cell == LARGE ? large++ : grid->start[cell + 1]++;
            put_into_place(pass, list, place, rank, (size_t)list->ranges.at[r].first + i);
        }
}

// The lists of all blocks, made by several workers, each with a part of the blocks and of the memory.
typedef struct Search {
    const Kernels *kernels;
    const Neighbours *list;
    const Grid *grid;
    uint32_t own; // places with a key below are of the pass's own group
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
    uint32_t near[NEAR_MOST + NEAR_CHUNK + LANES_MOST];
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
        uint32_t cell = axis_cell(grid, k, finder->query.place[k]);
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
    uint64_t begin = phys_share(search->capacity, worker, workers), used = begin;
    uint64_t end = phys_share(search->capacity, worker + 1, workers);
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
    bool crowded[PHYS_MOST_THREADS] = {0}, full[PHYS_MOST_THREADS] = {0};
    uint64_t scanned[PHYS_MOST_THREADS] = {0}, padded[PHYS_MOST_THREADS] = {0};
    search->crowded = crowded;
    search->full = full;
    search->scanned = scanned;
    search->padded = padded;
    uint64_t first = (uint64_t)ENTRIES_FIRST * list->total + NEAR_MOST * LANES_MOST;
    uint64_t most = (uint64_t)ENTRIES_MOST * list->total + NEAR_MOST * LANES_MOST;
    if (system->options.neighbours == PHYS_NEIGHBOURS_AUTO && most > phys_entries_that_pay(list))
        most = phys_entries_that_pay(list);
    uint64_t room = list->entries.capacity / sizeof(uint32_t);
    search->capacity = room > first ? room : first;
    search->capacity = search->capacity < most ? search->capacity : most;
    for (;;) {
        if (!phys_buffer_reserve(system, &list->entries, 0, search->capacity, sizeof(uint32_t)))
            return false;
        list->view.entries = list->entries.bytes;
        int threads = system->options.threads < PHYS_MOST_THREADS ? system->options.threads : PHYS_MOST_THREADS;
        phys_parallel(list->total < PHYS_FEW_PARTICLES ? 1 : threads, find_blocks, search);
        bool too_full = false;
        list->scanned = list->padded = 0;
        for (int w = 0; w < PHYS_MOST_THREADS; w++) {
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

// Points the arrays of a list into their memory.
static bool reserve_arrays(PhysSystem *system, const PairPass *pass, Neighbours *list) {
    uint64_t total = (list->total + LANES_MOST - 1) / LANES_MOST * LANES_MOST + LANES_MOST, n = pass->dimensions;
    enum { QUAD = 4, SOURCES = 2, WORDS = 4 };
    uint64_t doubles = (n + 1 + QUAD + (list->touch_only ? 0 : SOURCES)) * total;
    if (!phys_buffer_reserve(system, &list->arrays, 0, doubles + total * (WORDS + 2) / 2, sizeof(double)))
        return false;
    double *next = list->arrays.bytes;
    ListView *view = &list->view;
    view->quads = next;
    next += QUAD * total;
    for (size_t k = 0; k < n; k++, next += total)
        view->built[k] = next;
    view->radius = next;
    next += total;
    view->sources = list->touch_only ? NULL : next;
    next += list->touch_only ? 0 : SOURCES * total;
    view->at = (uint64_t *)next;
    view->column = (uint32_t *)(view->at + total);
    list->key = view->column + total;
    list->cell = list->key + total;
    view->most = list->cell + total;
    return true;
}

// What lies beyond the last place is read but never counts.
static void fill_up(const PairPass *pass, Neighbours *list, uint32_t dummy) {
    for (uint32_t place = list->total; place <= dummy; place++) {
        list->view.column[place] = list->ranges.at[0].first;
        for (size_t k = 0; k < pass->dimensions; k++)
            list->view.built[k][place] = 0;
        list->view.radius[place] = 0;
    }
    for (uint32_t lane = 1; lane < LANES_MOST; lane++)
        list->view.column[dummy + lane] = list->ranges.at[0].first;
    for (int m = 0; m < 4; m++)
        list->view.quads[4 * (size_t)dummy + (size_t)m] = m < (int)pass->dimensions ? NAN : 0;
    if (list->view.sources)
        list->view.sources[2 * (size_t)dummy] = list->view.sources[2 * (size_t)dummy + 1] = 0;
}

bool phys_grid_build(PhysSystem *system, const Kernels *kernels, const PairPass *pass, Neighbours *list) {
    Survey survey;
    list->total = (uint32_t)phys_ranges_total(&list->ranges);
    if (!reserve_arrays(system, pass, list))
        return false;
    take_samples(pass, list, &survey);
    double median = survey.samples ? survey.sample[PHYS_VECTOR_DIMENSIONS][survey.samples / 2] : 0;
    list->base = fmax(2 * median, list->bound);
    if (!(list->base > SHORTEST && list->base < 1 / SHORTEST))
        return false;
    if (!(list->skin >= 0.05 * list->base && list->skin <= 0.6 * list->base))
        list->skin = 0.3 * list->base;
    // A little less than half the skin, so that rounding cannot let a pair slip through.
    list->view.moved = 0.25 * list->skin * list->skin * (1 - 1e-6);
    survey.large = 2 * list->base;
    survey_all(pass, list, &survey);
    if (survey.large_count > PHYS_MOST_LARGE) { // they are no exception
        survey.large = INFINITY;
        survey_all(pass, list, &survey);
    }
    double width = (fmax(2 * survey.widest, list->bound) + list->skin) * (1 + 1e-9);
    Grid grid = {.dimensions = pass->dimensions, .cells = {1, 1, 1}};
    choose_cells(&survey, width, &grid);
    uint64_t cells = (uint64_t)grid.cells[0] * grid.cells[1] * grid.cells[2];
    if (!phys_buffer_reserve(system, &list->cells, 0, cells + 2, sizeof(uint32_t)))
        return false;
    grid.start = list->cells.bytes;
    list->view.regular = survey.regular;
    list->view.listed = survey.regular + survey.large_count;
    sort_by_cell(pass, list, &survey, &grid);
    uint32_t dummy = (list->total + LANES_MOST - 1) / LANES_MOST * LANES_MOST;
    fill_up(pass, list, dummy);
    Search search = {.kernels = kernels, .list = list, .grid = &grid, .own = list->ranges.at[0].count, .dummy = dummy};
    // Where nearly everybody is a candidate of everybody, a grid does not help.
    uint64_t own = list->ranges.at[0].count;
    search.scan_limit = own * list->total / 4 + 64 * (uint64_t)list->total;
    if (search.scan_limit > 4000 * (uint64_t)list->total)
        search.scan_limit = 4000 * (uint64_t)list->total;
    return find_all(system, &search, list);
}
