// grid.c: sorts the particles of a pass into the cells of a grid.
//
// Cells are at least as wide as the reach of a regular particle, so its neighbours are in its own cell and the ones
// around it. The grid covers where most particles are; those outside count to the cells at its rim, which is right
// however far away they are: it keeps neighbours in the same or in adjacent cells. Particles that are much larger than
// the others (a few may be) are in no cell; everyone tests them.
#include "physics/grid.h"
#include "maths/maths.h"

#include <float.h>

enum { SAMPLES = 256 }; // particles by which the grid is chosen

// What is known of the particles before they are sorted.
typedef struct Survey {
    double low[PHYS_VECTOR_DIMENSIONS], high[PHYS_VECTOR_DIMENSIONS];
    double sample[PHYS_VECTOR_DIMENSIONS + 1][SAMPLES]; // positions and radii
    size_t samples;
    double large;  // radius above which a particle is large
    double widest; // radius of the largest regular one
    double narrowest;
    uint32_t regular, large_count;
} Survey;

// Squares of lengths that a list deals with must be normal numbers.
#define SHORTEST 1e-100

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

// Extent of all, and how many are large; fills list->cell with PHYS_CELL_IDLE, PHYS_CELL_LARGE or 0.
static void survey_all(const PairPass *pass, Neighbours *list, Survey *survey) {
    uint32_t rank = 0;
    for (size_t k = 0; k < pass->dimensions; k++) {
        survey->low[k] = INFINITY;
        survey->high[k] = -INFINITY;
    }
    survey->widest = 0;
    survey->narrowest = INFINITY;
    survey->regular = survey->large_count = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++)
        for (uint32_t i = 0; i < list->ranges.at[r].count; i++, rank++) {
            size_t column = (size_t)list->ranges.at[r].first + i;
            if (idle(pass, list, column)) {
                list->cell[rank] = PHYS_CELL_IDLE;
                continue;
            }
            if (pass->radius[column] > survey->large) {
                list->cell[rank] = PHYS_CELL_LARGE;
                survey->large_count++;
                continue;
            }
            list->cell[rank] = 0;
            survey->regular++;
            survey->widest = fmax(survey->widest, pass->radius[column]);
            survey->narrowest = fmin(survey->narrowest, pass->radius[column]);
            for (size_t k = 0; k < pass->dimensions; k++) {
                double x = pass->position[k * pass->stride + column];
                survey->low[k] = x < survey->low[k] ? x : survey->low[k];
                survey->high[k] = x > survey->high[k] ? x : survey->high[k];
            }
        }
}

// Where the grid lies and how fine it is: cells no narrower than `width`, and not many more of them than particles.
static void choose_cells(const Survey *survey, double width, double most, Grid *grid) {
    double product = 1;
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
    // Where the particles are astronomically far apart, each axis gets its share of the cells.
    bool vast = !(product <= 1e100);
    double share = floor(maths_pow(most, 1.0 / (double)grid->dimensions));
    if (product > most && !vast)
        width *= maths_pow(product / most, 1.0 / (double)grid->dimensions);
    product = 1;
    for (size_t k = 0; k < grid->dimensions; k++) {
        double cells = floor(span[k] / width);
        if (vast && cells > share)
            cells = share;
        cells = cells >= 1 && cells <= most / product ? cells : 1; // also where the span is not finite
        product *= cells;
        grid->cells[k] = (uint32_t)cells;
        grid->scale[k] = cells > 1 ? cells / span[k] : 0;
    }
}

static void put_into_place(const PairPass *pass, Neighbours *list, uint32_t place, uint32_t rank, size_t column) {
    list->view.column[place] = (uint32_t)column;
    list->key[place] = list->order ? list->order[column] : rank;
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
            if (list->cell[rank] < PHYS_CELL_LARGE) {
                list->cell[rank] = phys_cell_of(grid, pass->position + list->ranges.at[r].first + i, pass->stride);
                grid->start[list->cell[rank] + 2]++;
            }
    for (uint32_t c = 2; c < cells + 2; c++)
        grid->start[c] += grid->start[c - 1];
    rank = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++)
        for (uint32_t i = 0; i < list->ranges.at[r].count; i++, rank++) {
            uint32_t cell = list->cell[rank];
            uint32_t place = cell == PHYS_CELL_IDLE    ? rest++
                             : cell == PHYS_CELL_LARGE ? large++
                                                       : grid->start[cell + 1]++;
            put_into_place(pass, list, place, rank, (size_t)list->ranges.at[r].first + i);
        }
}

// Points the arrays of a list into their memory.
static bool reserve_arrays(PhysSystem *system, const PairPass *pass, Neighbours *list) {
    uint64_t total = (list->total + PHYS_MOST_LANES - 1) / PHYS_MOST_LANES * PHYS_MOST_LANES + PHYS_MOST_LANES,
             n = pass->dimensions;
    enum { SOURCES = 2, WORDS = 4 };
    uint64_t doubles = (n + 1 + PHYS_QUAD + (list->touch_only ? 0 : SOURCES)) * total;
    if (!phys_buffer_reserve(system, &list->arrays, 0, doubles + total * (WORDS + 2) / 2, sizeof(double)))
        return false;
    double *next = list->arrays.bytes;
    ListView *view = &list->view;
    view->quads = next;
    next += PHYS_QUAD * total;
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
    for (uint32_t place = list->total; place < dummy + PHYS_MOST_LANES; place++) {
        list->view.column[place] = list->ranges.at[0].first;
        for (size_t k = 0; k < pass->dimensions; k++)
            list->view.built[k][place] = 0;
        list->view.radius[place] = 0;
    }
    ListView *view = &list->view;
    for (size_t m = 0; m < view->width; m++)
        view->quads[view->width * (size_t)dummy + m] = m < pass->dimensions ? NAN : 0;
    if (list->view.sources)
        list->view.sources[2 * (size_t)dummy] = list->view.sources[2 * (size_t)dummy + 1] = 0;
}

// Finds out how long a skin is, which particles are large, and where cells lie: no more than about `most`.
static bool lay(const PairPass *pass, Neighbours *list, double most, Survey *survey, Grid *grid) {
    take_samples(pass, list, survey);
    double median = survey->samples ? survey->sample[PHYS_VECTOR_DIMENSIONS][survey->samples / 2] : 0;
    list->base = fmax(2 * median, list->bound);
    if (!(list->base > SHORTEST && list->base < 1 / SHORTEST))
        return false;
    if (!list->skin_given && !(list->skin >= SKIN_LEAST * list->base && list->skin <= SKIN_MOST * list->base))
        list->skin = 0.3 * list->base;
    survey->large = 2 * list->base;
    survey_all(pass, list, survey);
    if (survey->large_count > PHYS_MOST_LARGE) { // they are no exception
        survey->large = INFINITY;
        survey_all(pass, list, survey);
    }
    double width = (fmax(2 * survey->widest, list->bound) + list->skin) * (1 + 1e-9);
    choose_cells(survey, width, fmin(most, 2.0 * survey->regular + 64), grid);
    return true;
}

bool phys_grid_lay(const PairPass *pass, Neighbours *list, double most, Grid *grid, double *widest) {
    Survey survey;
    if (!lay(pass, list, most, &survey, grid))
        return false;
    *widest = survey.widest;
    return true;
}

bool phys_grid_build(PhysSystem *system, const Kernels *kernels, const PairPass *pass, Neighbours *list) {
    Survey survey;
    Grid grid = {.dimensions = pass->dimensions, .cells = {1, 1, 1}};
    list->total = (uint32_t)phys_ranges_total(&list->ranges);
    list->order = system->settled ? system->order : NULL;
    list->view.direct = false;
    if (list->total > UINT32_MAX / PHYS_QUAD - 2 * PHYS_MOST_LANES || !reserve_arrays(system, pass, list) ||
        !lay(pass, list, INFINITY, &survey, &grid))
        return false;
    list->view.moved = phys_skin_square(list->skin);
    uint64_t cells = (uint64_t)grid.cells[0] * grid.cells[1] * grid.cells[2];
    if (!phys_buffer_reserve(system, &list->cells, 0, cells + 2, sizeof(uint32_t)))
        return false;
    grid.start = list->cells.bytes;
    list->view.regular = survey.regular;
    list->view.listed = survey.regular + survey.large_count;
    bool one_size = survey.widest == survey.narrowest && !survey.large_count && list->touch_only;
    list->view.one_radius = one_size ? survey.widest : 0;
    list->view.width = one_size && pass->dimensions == 2 ? PHYS_PAIR : PHYS_QUAD;
    sort_by_cell(pass, list, &survey, &grid);
    uint32_t dummy = (list->total + PHYS_MOST_LANES - 1) / PHYS_MOST_LANES * PHYS_MOST_LANES;
    fill_up(pass, list, dummy);
    return phys_grid_search(system, kernels, &grid, dummy, list);
}
