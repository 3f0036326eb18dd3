// grid.c: sorts the particles of a pass into the cells of a grid.
//
// Cells are at least as wide as the range of a regular particle. So the neighbours of a particle are in the same cell
// or an adjacent one. The grid covers the area of most particles. Particles outside it belong to the cells at its edge,
// so their neighbours are still in the same or an adjacent cell. A few particles can be much larger than the others.
// They are in no cell. Instead, each of them is tested against all particles.
#include "physics/grid.h"

#include "maths/maths.h"
#include "physics/threads.h"

#include <assert.h>
#include <float.h>
#include <string.h>

enum { GRID_SAMPLES = 256 }; // number of particles from which the grid is chosen

// Positions and radii of some particles: of[k] is component k of the positions, and the last element is the radii.
typedef struct Samples {
    double of[PHYS_VECTOR_DIMENSIONS + 1][GRID_SAMPLES];
    size_t count;
} Samples;

// Facts that must be known before particles are sorted: extent and radii of the regular particles, and the numbers of
// regular and large particles.
typedef struct Survey {
    double low[PHYS_VECTOR_DIMENSIONS], high[PHYS_VECTOR_DIMENSIONS];
    double max_radius, min_radius;
    uint32_t regular, large_count;
} Survey;

static Survey no_survey(void) {
    return (Survey){
        .low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}, .min_radius = INFINITY};
}

// Minimum of NeighbourList.contact_distance, so that squares of lengths are not subnormal.
#define MIN_LENGTH 1e-100

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

// Takes samples of the particles and sorts each component. The grid is chosen from the samples, so that it covers most
// particles but not the outliers.
static void sample_particles(const PairPass *pass, const NeighbourList *list, Samples *samples) {
    size_t every = list->total / GRID_SAMPLES + 1, i = 0;
    samples->count = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++) {
        const ColumnRange *range = &list->ranges.at[r];
        for (; i < range->count; i += every) {
            if (phys_is_idle(pass, list, range->first + i))
                continue;
            for (size_t k = 0; k < pass->dimensions; k++)
                samples->of[k][samples->count] = pass->position[k * pass->stride + range->first + i];
            samples->of[PHYS_VECTOR_DIMENSIONS][samples->count++] = pass->radius[range->first + i];
        }
        i -= range->count;
    }
    for (size_t k = 0; k <= PHYS_VECTOR_DIMENSIONS; k++)
        sort_doubles(samples->of[k], k < pass->dimensions || k == PHYS_VECTOR_DIMENSIONS ? samples->count : 0);
}

// Context of the jobs that sort the particles of a pass.
typedef struct Sorting {
    const PhysSystem *system; // NULL: the jobs use one thread
    const PairPass *pass;
    NeighbourList *list;
    const Grid *grid;
    double large; // radius above which a particle is large
    Survey *surveys;
} Sorting;

static int chunk_count_of(const Sorting *sorting) {
    return sorting->system ? phys_chunk_count(sorting->system, sorting->list->total, PHYS_MIN_FOR_THREADS) : 1;
}

// Returns the column of particle `number`, counted through all ranges of the pass.
static inline size_t listed_column(const NeighbourList *list, uint32_t number) {
    const ColumnRange *range = list->ranges.at;
    while (number >= range->count)
        number -= range++->count;
    return (size_t)range->first + number;
}

static uint32_t chunk_start(const NeighbourList *list, int chunk, int chunks) {
    return (uint32_t)phys_chunk_begin(list->total, chunk, chunks);
}

static void survey_particle(const PairPass *pass, Survey *survey, size_t column) {
    survey->regular++;
    double radius = pass->radius[column];
    // fmax and fmin are not used, because they may be function calls.
    survey->max_radius = radius > survey->max_radius ? radius : survey->max_radius;
    survey->min_radius = radius < survey->min_radius ? radius : survey->min_radius;
    for (size_t k = 0; k < pass->dimensions; k++) {
        double x = pass->position[k * pass->stride + column];
        survey->low[k] = x < survey->low[k] ? x : survey->low[k];
        survey->high[k] = x > survey->high[k] ? x : survey->high[k];
    }
}

bool phys_find_extremes(const double *numbers, size_t count, double *low, double *high) {
    enum { WIDE = 8 }; // numbers processed together, so that a compiler can vectorise the loop
    double min[WIDE], max[WIDE], rest[WIDE], lost = 0;
    for (size_t m = 0; m < WIDE; m++) {
        min[m] = INFINITY;
        max[m] = -INFINITY;
        rest[m] = 0;
    }
    for (size_t i = 0; i < count; i += WIDE) {
        size_t from = i + WIDE <= count ? i : count < WIDE ? 0 : count - WIDE, wide = count < WIDE ? count : WIDE;
        for (size_t m = 0; m < wide; m++) {
            double x = numbers[from + m];
            min[m] = x < min[m] ? x : min[m];
            max[m] = x > max[m] ? x : max[m];
            rest[m] += x - x;
        }
    }
    for (size_t m = 0; m < WIDE; m++) {
        *low = min[m] < *low ? min[m] : *low;
        *high = max[m] > *high ? max[m] : *high;
        lost += rest[m];
    }
    return lost == 0;
}

// Surveys a chunk quickly if all of its particles are regular, which is the common case. Otherwise returns false, and
// `survey` must not be used.
static bool survey_regular(const Sorting *sorting, size_t first, size_t count, Survey *survey) {
    const PairPass *pass = sorting->pass;
    bool regular = phys_find_extremes(pass->radius + first, count, &survey->min_radius, &survey->max_radius);
    for (size_t k = 0; k < pass->dimensions && regular; k++)
        regular =
            phys_find_extremes(pass->position + k * pass->stride + first, count, &survey->low[k], &survey->high[k]);
    survey->regular = (uint32_t)count;
    return regular && survey->min_radius > 0 && survey->max_radius <= sorting->large;
}

static void survey_chunk(void *context, int chunk, int chunks) {
    const Sorting *sorting = context;
    const PairPass *pass = sorting->pass;
    NeighbourList *list = sorting->list;
    Survey survey = no_survey();
    uint32_t first = chunk_start(list, chunk, chunks), end = chunk_start(list, chunk + 1, chunks);
    if (list->ranges.count == 1 && survey_regular(sorting, list->ranges.at[0].first + first, end - first, &survey)) {
        memset(list->cell + first, 0, (end - first) * sizeof *list->cell);
        sorting->surveys[chunk] = survey;
        return;
    }
    survey = no_survey();
    for (uint32_t i = first; i < end; i++) {
        size_t column = listed_column(list, i);
        bool lost = phys_is_idle(pass, list, column), large = !lost && pass->radius[column] > sorting->large;
        list->cell[i] = lost ? PHYS_CELL_IDLE : large ? PHYS_CELL_LARGE : 0;
        survey.large_count += large;
        if (!lost && !large)
            survey_particle(pass, &survey, column);
    }
    sorting->surveys[chunk] = survey;
}

// Surveys all particles. Sets list->cell to PHYS_CELL_IDLE, to PHYS_CELL_LARGE or, for regular particles, to 0.
static Survey survey_all(Sorting *sorting) {
    Survey parts[PHYS_MAX_CHUNKS], all = no_survey();
    int chunks = chunk_count_of(sorting);
    sorting->surveys = parts;
    phys_parallel(sorting->system, chunks, survey_chunk, sorting);
    sorting->surveys = NULL;
    for (int s = 0; s < chunks; s++) {
        all.regular += parts[s].regular;
        all.large_count += parts[s].large_count;
        all.max_radius = fmax(all.max_radius, parts[s].max_radius);
        all.min_radius = fmin(all.min_radius, parts[s].min_radius);
        for (size_t k = 0; k < sorting->pass->dimensions; k++) {
            all.low[k] = fmin(all.low[k], parts[s].low[k]);
            all.high[k] = fmax(all.high[k], parts[s].high[k]);
        }
    }
    return all;
}

// Chooses the extent and resolution of the grid: at most `max` cells, none narrower than `width`.
static void choose_cells(const Survey *survey, const Samples *samples, double width, double max, Grid *grid) {
    double product = 1;
    double span[PHYS_VECTOR_DIMENSIONS];
    for (size_t k = 0; k < grid->dimensions; k++) {
        const double *sample = samples->of[k];
        size_t edge = samples->count / 4;
        double low = samples->count ? sample[edge] : 0, high = samples->count ? sample[samples->count - 1 - edge] : 0;
        double usual = high - low;
        low = fmax(survey->low[k], low - 1.5 * usual);
        high = fmin(survey->high[k], high + 1.5 * usual);
        grid->low[k] = low;
        span[k] = high - low;
        product *= fmax(span[k] / width, 1);
    }
    // If the particles are extremely far apart, no axis gets more than `chunk` cells.
    bool vast = !(product <= 1e100);
    double chunk = floor(maths_pow(max, 1.0 / (double)grid->dimensions));
    if (product > max && !vast)
        width *= maths_pow(product / max, 1.0 / (double)grid->dimensions);
    product = 1;
    for (size_t k = 0; k < grid->dimensions; k++) {
        double cells = floor(span[k] / width);
        if (vast && cells > chunk)
            cells = chunk;
        cells = cells >= 1 && cells <= max / product ? cells : 1; // 1 cell also if the span is not finite
        product *= cells;
        grid->cells[k] = (uint32_t)cells;
        grid->scale[k] = cells > 1 ? cells / span[k] : 0;
    }
}

static void store_at_index(const PairPass *pass, NeighbourList *list, uint32_t index, uint32_t rank, size_t column) {
    list->view.column[index] = (uint32_t)column;
    list->key[index] = list->order ? list->order[column] : rank;
    for (size_t k = 0; k < pass->dimensions; k++)
        list->view.built[k][index] = pass->position[k * pass->stride + column];
    list->view.radius[index] = pass->radius[column];
}

static void find_cells_chunk(void *context, int chunk, int chunks) {
    const Sorting *sorting = context;
    const PairPass *pass = sorting->pass;
    NeighbourList *list = sorting->list;
    uint32_t end = chunk_start(list, chunk + 1, chunks);
    for (uint32_t i = chunk_start(list, chunk, chunks); i < end; i++)
        if (list->cell[i] < PHYS_CELL_LARGE)
            list->cell[i] = phys_cell_of(sorting->grid, pass->position + listed_column(list, i), pass->stride);
}

// Replaces the cell of each particle in list->cell by its sorted index, with a counting sort. During the sort,
// grid->start[c + 1] is the next index in cell c.
static void number_sorted(NeighbourList *list, const Survey *survey, const Grid *grid) {
    uint32_t cells = 1, large = survey->regular, rest = survey->regular + survey->large_count;
    for (size_t k = 0; k < grid->dimensions; k++)
        cells *= grid->cells[k];
    for (uint32_t c = 0; c < cells + 2; c++)
        grid->start[c] = 0;
    for (uint32_t i = 0; i < list->total; i++)
        if (list->cell[i] < PHYS_CELL_LARGE)
            grid->start[list->cell[i] + 2]++;
    for (uint32_t c = 2; c < cells + 2; c++)
        grid->start[c] += grid->start[c - 1];
    for (uint32_t i = 0; i < list->total; i++) {
        uint32_t cell = list->cell[i];
        list->cell[i] = cell == PHYS_CELL_IDLE ? rest++ : cell == PHYS_CELL_LARGE ? large++ : grid->start[cell + 1]++;
    }
}

static void store_chunk(void *context, int chunk, int chunks) {
    const Sorting *sorting = context;
    NeighbourList *list = sorting->list;
    uint32_t end = chunk_start(list, chunk + 1, chunks);
    for (uint32_t i = chunk_start(list, chunk, chunks); i < end; i++)
        store_at_index(sorting->pass, list, list->cell[i], i, listed_column(list, i));
}

// Sorts the particles by cell. The sort is stable: within a cell, particles are in the order of the pass.
static void sort_by_cell(Sorting *sorting, const Survey *survey) {
    int chunks = chunk_count_of(sorting);
    phys_parallel(sorting->system, chunks, find_cells_chunk, sorting);
    number_sorted(sorting->list, survey, sorting->grid);
    phys_parallel(sorting->system, chunks, store_chunk, sorting);
}

// Reserves memory for the arrays of a list.
static bool reserve_arrays(PhysSystem *system, const PairPass *pass, NeighbourList *list) {
    uint64_t total = (list->total + PHYS_MAX_LANES - 1) / PHYS_MAX_LANES * PHYS_MAX_LANES + PHYS_MAX_LANES,
             n = pass->dimensions;
    enum { SOURCES = 2, WORDS = 4 };
    uint64_t doubles = (n + 1 + PHYS_QUAD + (list->bound == 0 ? 0 : SOURCES)) * total;
    if (!phys_buffer_reserve(system, &list->arrays, 0, doubles + total * (WORDS + 2) / 2, sizeof(double)))
        return false;
    double *next = list->arrays.bytes;
    ListView *view = &list->view;
    view->packed = next;
    next += PHYS_QUAD * total;
    for (size_t k = 0; k < n; k++, next += total)
        view->built[k] = next;
    view->radius = next;
    next += total;
    view->sources = list->bound == 0 ? NULL : next;
    next += list->bound == 0 ? 0 : SOURCES * total;
    view->at = (uint64_t *)next;
    view->column = (uint32_t *)(view->at + total);
    list->key = view->column + total;
    list->cell = list->key + total;
    view->max_length = list->cell + total;
    return true;
}

// Fills the elements beyond the last particle. Kernels read them, but they do not affect results.
static void pad_arrays(const PairPass *pass, NeighbourList *list, uint32_t dummy) {
    for (uint32_t index = list->total; index < dummy + PHYS_MAX_LANES; index++) {
        list->view.column[index] = list->ranges.at[0].first;
        for (size_t k = 0; k < pass->dimensions; k++)
            list->view.built[k][index] = 0;
        list->view.radius[index] = 0;
    }
    ListView *view = &list->view;
    // PHYS_PAIR uses only half of `packed`, so `next_packed` can use the other half.
    list->next_packed = view->width == PHYS_PAIR ? view->packed + PHYS_PAIR * ((size_t)dummy + PHYS_MAX_LANES) : NULL;
    for (size_t m = 0; m < view->width; m++) {
        size_t last = view->width * (size_t)dummy + m;
        view->packed[last] = m < pass->dimensions ? NAN : 0;
        if (list->next_packed)
            list->next_packed[last] = view->packed[last];
    }
    if (list->view.sources)
        list->view.sources[2 * (size_t)dummy] = list->view.sources[2 * (size_t)dummy + 1] = 0;
}

// Determines the skin, the large particles, and a grid of at most `max` cells. Returns false if the typical distance of
// interacting particles is too small or too large.
static bool layout_cells(Sorting *sorting, double max, Survey *survey, Grid *grid) {
    NeighbourList *list = sorting->list;
    Samples samples;
    assert(sorting->pass->dimensions <= PHYS_VECTOR_DIMENSIONS);
    sample_particles(sorting->pass, list, &samples);
    double median = samples.count ? samples.of[PHYS_VECTOR_DIMENSIONS][samples.count / 2] : 0;
    list->contact_distance = fmax(2 * median, list->bound);
    if (!(list->contact_distance > MIN_LENGTH && list->contact_distance < 1 / MIN_LENGTH))
        return false;
    bool fixed = sorting->system && sorting->system->remote; // a local system's skin is that of its halo
    if (!fixed && !(list->skin >= MIN_SKIN * list->contact_distance && list->skin <= MAX_SKIN * list->contact_distance))
        list->skin = 0.3 * list->contact_distance;
    sorting->large = 2 * list->contact_distance;
    *survey = survey_all(sorting);
    if (survey->large_count > PHYS_MAX_LARGE) { // too many to treat as exceptions
        sorting->large = INFINITY;
        *survey = survey_all(sorting);
    }
    double width = (fmax(2 * survey->max_radius, list->bound) + list->skin) * (1 + 1e-9);
    choose_cells(survey, &samples, width, fmin(max, 2.0 * survey->regular + 64), grid);
    return true;
}

bool phys_grid_layout(const PairPass *pass, NeighbourList *list, double max, Grid *grid, double *max_radius) {
    Survey survey;
    Sorting sorting = {.pass = pass, .list = list};
    if (!layout_cells(&sorting, max, &survey, grid))
        return false;
    *max_radius = survey.max_radius;
    return true;
}

bool phys_grid_build(PhysSystem *system, const PairPass *pass, NeighbourList *list, uint64_t max_entries) {
    Survey survey;
    Grid grid = {.dimensions = pass->dimensions, .cells = {1, 1, 1}};
    Sorting sorting = {.system = system, .pass = pass, .list = list, .grid = &grid};
    list->total = (uint32_t)phys_ranges_total(&list->ranges);
    list->order = system->column_order == ORDER_FIXED ? NULL : system->order;
    list->view.direct = false;
    if (list->total > UINT32_MAX / PHYS_QUAD - 2 * PHYS_MAX_LANES || !reserve_arrays(system, pass, list) ||
        !layout_cells(&sorting, INFINITY, &survey, &grid))
        return false;
    list->view.max_move_squared = phys_skin_square(list->skin);
    uint64_t cells = (uint64_t)grid.cells[0] * grid.cells[1] * grid.cells[2];
    if (!phys_buffer_reserve(system, &list->cells, 0, cells + 2, sizeof(uint32_t)))
        return false;
    grid.start = list->cells.bytes;
    list->view.regular = survey.regular;
    list->view.listed = survey.regular + survey.large_count;
    bool one_size = survey.max_radius == survey.min_radius && !survey.large_count && list->bound == 0;
    list->view.one_radius = one_size ? survey.max_radius : 0;
    list->view.width = one_size && pass->dimensions == 2 ? PHYS_PAIR : PHYS_QUAD;
    sort_by_cell(&sorting, &survey);
    uint32_t dummy = (list->total + PHYS_MAX_LANES - 1) / PHYS_MAX_LANES * PHYS_MAX_LANES;
    pad_arrays(pass, list, dummy);
    return phys_grid_search(system, &grid, dummy, list, max_entries);
}
