// grid.c: sorts the particles of a pass into the cells of a grid.
//
// Cells are at least as wide as the reach of a regular particle, so its neighbours are in its own cell and the ones
// around it. The grid covers where most particles are; those outside count to the cells at its rim, which is right
// however far away they are: it keeps neighbours in the same or in adjacent cells. Particles that are much larger than
// the others (a few may be) are in no cell; everyone tests them.
#include "physics/grid.h"
#include "maths/maths.h"
#include "physics/threads.h"

#include <float.h>
#include <string.h>

enum { SAMPLES = 256 }; // particles by which the grid is chosen

// Some of the particles: positions and radii.
typedef struct Samples {
    double of[PHYS_VECTOR_DIMENSIONS + 1][SAMPLES];
    size_t count;
} Samples;

// What is known of the particles before they are sorted.
typedef struct Survey {
    double low[PHYS_VECTOR_DIMENSIONS], high[PHYS_VECTOR_DIMENSIONS];
    double widest, narrowest; // radii of regular ones
    uint32_t regular, large_count;
} Survey;

static Survey no_survey(void) {
    return (Survey){
        .low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}, .narrowest = INFINITY};
}

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
static void take_samples(const PairPass *pass, const Neighbours *list, Samples *samples) {
    uint64_t every = list->total / SAMPLES + 1, i = 0;
    samples->count = 0;
    for (uint32_t r = 0; r < list->ranges.count; r++) {
        const ColumnRange *range = &list->ranges.at[r];
        for (; i < range->count; i += every) {
            if (idle(pass, list, range->first + i))
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

// Work on the particles of a pass, cut into shares.
typedef struct Sorting {
    const PhysSystem *system; // NULL: one thread does it
    const PairPass *pass;
    Neighbours *list;
    const Grid *grid;
    double large; // radius above which a particle is large
    Survey *parts;
} Sorting;

static void share_out(Sorting *sorting, PhysWork *work, int shares) {
    if (shares > 1)
        phys_parallel(sorting->system, shares, work, sorting);
    else
        work(sorting, 0, 1);
}

static int shares_of(const Sorting *sorting) {
    return sorting->system ? phys_shares(sorting->system, sorting->list->total, PHYS_MIN_FOR_THREADS) : 1;
}

// The column of a particle of the pass.
static inline size_t column_of(const Neighbours *list, uint32_t number) {
    const ColumnRange *range = list->ranges.at;
    while (number >= range->count)
        number -= range++->count;
    return (size_t)range->first + number;
}

static uint32_t share_start(const Neighbours *list, int share, int shares) {
    return (uint32_t)phys_share(list->total, share, shares);
}

static void survey_one(const PairPass *pass, Survey *survey, size_t column) {
    survey->regular++;
    double radius = pass->radius[column];
    survey->widest = radius > survey->widest ? radius : survey->widest; // fmax may be a call
    survey->narrowest = radius < survey->narrowest ? radius : survey->narrowest;
    for (size_t k = 0; k < pass->dimensions; k++) {
        double x = pass->position[k * pass->stride + column];
        survey->low[k] = x < survey->low[k] ? x : survey->low[k];
        survey->high[k] = x > survey->high[k] ? x : survey->high[k];
    }
}

// The least and the largest of some numbers; false if one of them is not finite.
static bool extremes(const double *numbers, size_t count, double *low, double *high) {
    enum { WIDE = 8 }; // that a compiler takes at once
    double least[WIDE], most[WIDE], rest[WIDE], lost = 0;
    for (size_t m = 0; m < WIDE; m++) {
        least[m] = INFINITY;
        most[m] = -INFINITY;
        rest[m] = 0;
    }
    for (size_t i = 0; i < count; i += WIDE) {
        size_t from = i + WIDE <= count ? i : count < WIDE ? 0 : count - WIDE, wide = count < WIDE ? count : WIDE;
        for (size_t m = 0; m < wide; m++) {
            double x = numbers[from + m];
            least[m] = x < least[m] ? x : least[m];
            most[m] = x > most[m] ? x : most[m];
            rest[m] += x - x;
        }
    }
    for (size_t m = 0; m < WIDE; m++) {
        *low = fmin(*low, least[m]);
        *high = fmax(*high, most[m]);
        lost += rest[m];
    }
    return lost == 0;
}

// A share in which all particles are regular, as most are; else false.
static bool survey_regular(const Sorting *sorting, size_t first, size_t count, Survey *survey) {
    const PairPass *pass = sorting->pass;
    bool regular = extremes(pass->radius + first, count, &survey->narrowest, &survey->widest);
    for (size_t k = 0; k < pass->dimensions && regular; k++)
        regular = extremes(pass->position + k * pass->stride + first, count, &survey->low[k], &survey->high[k]);
    survey->regular = (uint32_t)count;
    return regular && survey->narrowest > 0 && survey->widest <= sorting->large;
}

static void survey_share(void *context, int share, int shares) {
    const Sorting *sorting = context;
    const PairPass *pass = sorting->pass;
    Neighbours *list = sorting->list;
    Survey survey = no_survey();
    uint32_t first = share_start(list, share, shares), end = share_start(list, share + 1, shares);
    if (list->ranges.count == 1 && survey_regular(sorting, list->ranges.at[0].first + first, end - first, &survey)) {
        memset(list->cell + first, 0, (end - first) * sizeof *list->cell);
        sorting->parts[share] = survey;
        return;
    }
    survey = no_survey();
    for (uint32_t i = first; i < end; i++) {
        size_t column = column_of(list, i);
        bool lost = idle(pass, list, column), large = !lost && pass->radius[column] > sorting->large;
        list->cell[i] = lost ? PHYS_CELL_IDLE : large ? PHYS_CELL_LARGE : 0;
        survey.large_count += large;
        if (!lost && !large)
            survey_one(pass, &survey, column);
    }
    sorting->parts[share] = survey;
}

// Extent of all, and how many are large; fills list->cell with PHYS_CELL_IDLE, PHYS_CELL_LARGE or 0.
static Survey survey_all(Sorting *sorting) {
    Survey parts[PHYS_MOST_SHARES], all = no_survey();
    int shares = shares_of(sorting);
    sorting->parts = parts;
    share_out(sorting, survey_share, shares);
    for (int s = 0; s < shares; s++) {
        all.regular += parts[s].regular;
        all.large_count += parts[s].large_count;
        all.widest = fmax(all.widest, parts[s].widest);
        all.narrowest = fmin(all.narrowest, parts[s].narrowest);
        for (size_t k = 0; k < sorting->pass->dimensions; k++) {
            all.low[k] = fmin(all.low[k], parts[s].low[k]);
            all.high[k] = fmax(all.high[k], parts[s].high[k]);
        }
    }
    return all;
}

// Where the grid lies and how fine it is: cells no narrower than `width`, and not many more of them than particles.
static void choose_cells(const Survey *survey, const Samples *samples, double width, double most, Grid *grid) {
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

static void find_cells_share(void *context, int share, int shares) {
    const Sorting *sorting = context;
    const PairPass *pass = sorting->pass;
    Neighbours *list = sorting->list;
    uint32_t end = share_start(list, share + 1, shares);
    for (uint32_t i = share_start(list, share, shares); i < end; i++)
        if (list->cell[i] < PHYS_CELL_LARGE)
            list->cell[i] = phys_cell_of(sorting->grid, pass->position + column_of(list, i), pass->stride);
}

// The place of each particle instead of its cell, by counting.
static void number_places(Neighbours *list, const Survey *survey, const Grid *grid) {
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

static void put_share(void *context, int share, int shares) {
    const Sorting *sorting = context;
    Neighbours *list = sorting->list;
    uint32_t end = share_start(list, share + 1, shares);
    for (uint32_t i = share_start(list, share, shares); i < end; i++)
        put_into_place(sorting->pass, list, list->cell[i], i, column_of(list, i));
}

// Stable: inside a cell, places are in the order of the columns.
static void sort_by_cell(Sorting *sorting, const Survey *survey) {
    int shares = shares_of(sorting);
    share_out(sorting, find_cells_share, shares);
    number_places(sorting->list, survey, sorting->grid);
    share_out(sorting, put_share, shares);
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
    // Pairs leave half of the quads' room.
    list->next = view->width == PHYS_PAIR ? view->quads + PHYS_PAIR * ((size_t)dummy + PHYS_MOST_LANES) : NULL;
    for (size_t m = 0; m < view->width; m++) {
        size_t last = view->width * (size_t)dummy + m;
        view->quads[last] = m < pass->dimensions ? NAN : 0;
        if (list->next)
            list->next[last] = view->quads[last];
    }
    if (list->view.sources)
        list->view.sources[2 * (size_t)dummy] = list->view.sources[2 * (size_t)dummy + 1] = 0;
}

// Finds out how long a skin is, which particles are large, and where cells lie: no more than about `most`.
static bool lay(Sorting *sorting, double most, Survey *survey, Grid *grid) {
    Neighbours *list = sorting->list;
    Samples samples;
    take_samples(sorting->pass, list, &samples);
    double median = samples.count ? samples.of[PHYS_VECTOR_DIMENSIONS][samples.count / 2] : 0;
    list->base = fmax(2 * median, list->bound);
    if (!(list->base > SHORTEST && list->base < 1 / SHORTEST))
        return false;
    if (!list->skin_given && !(list->skin >= SKIN_LEAST * list->base && list->skin <= SKIN_MOST * list->base))
        list->skin = 0.3 * list->base;
    sorting->large = 2 * list->base;
    *survey = survey_all(sorting);
    if (survey->large_count > PHYS_MOST_LARGE) { // they are no exception
        sorting->large = INFINITY;
        *survey = survey_all(sorting);
    }
    double width = (fmax(2 * survey->widest, list->bound) + list->skin) * (1 + 1e-9);
    choose_cells(survey, &samples, width, fmin(most, 2.0 * survey->regular + 64), grid);
    return true;
}

bool phys_grid_lay(const PairPass *pass, Neighbours *list, double most, Grid *grid, double *widest) {
    Survey survey;
    Sorting sorting = {.pass = pass, .list = list};
    if (!lay(&sorting, most, &survey, grid))
        return false;
    *widest = survey.widest;
    return true;
}

bool phys_grid_build(PhysSystem *system, const Kernels *kernels, const PairPass *pass, Neighbours *list) {
    Survey survey;
    Grid grid = {.dimensions = pass->dimensions, .cells = {1, 1, 1}};
    Sorting sorting = {.system = system, .pass = pass, .list = list, .grid = &grid};
    list->total = (uint32_t)phys_ranges_total(&list->ranges);
    list->order = system->may_settle ? system->order : NULL;
    list->view.direct = false;
    if (list->total > UINT32_MAX / PHYS_QUAD - 2 * PHYS_MOST_LANES || !reserve_arrays(system, pass, list) ||
        !lay(&sorting, INFINITY, &survey, &grid))
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
    sort_by_cell(&sorting, &survey);
    uint32_t dummy = (list->total + PHYS_MOST_LANES - 1) / PHYS_MOST_LANES * PHYS_MOST_LANES;
    fill_up(pass, list, dummy);
    return phys_grid_search(system, kernels, &grid, dummy, list);
}
