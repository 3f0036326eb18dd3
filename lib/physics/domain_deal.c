// domain_deal.c: plots of space, along a Hilbert curve, for ranks.
#include "physics/domain.h"

#include <stdlib.h>
#include <string.h>

enum { PLOTS_EACH = 8192 }; // plots for a rank: the smaller they are, the fewer particles are looked at one by one

static uint32_t rotated(uint32_t word, uint32_t by, uint32_t bits) {
    by %= bits;
    return (word >> by | word << (bits - by)) & ((1u << bits) - 1);
}

static uint32_t gray(uint32_t word) {
    return word ^ word >> 1;
}

static uint32_t not_gray(uint32_t word) {
    return word ^ word >> 1 ^ word >> 2; // of at most three bits
}

static uint32_t trailing_ones(uint32_t word) {
    return (uint32_t)__builtin_ctz(~word);
}

// How far along a Hilbert curve a cell is, in a cube of 2^levels cells along each of n axes. From level to level the
// curve enters a cube at a corner and leaves it along an axis; in what order it goes through its parts is a Gray code
// that is reflected and rotated accordingly.
uint64_t phys_curve_place(const uint32_t *cell, uint32_t n, uint32_t levels) {
    uint64_t place = 0;
    uint32_t corner = 0, axis = 0;
    for (uint32_t level = levels; level-- > 0;) {
        uint32_t part = 0;
        for (uint32_t k = 0; k < n; k++)
            part |= (cell[k] >> level & 1) << k;
        uint32_t number = not_gray(rotated(part ^ corner, axis + 1, n));
        uint32_t entry = number ? gray((number - 1) & ~1u) : 0;
        uint32_t turn = !number ? 0 : trailing_ones(number % 2 ? number : number - 1);
        corner ^= rotated(entry, n - (axis + 1) % n, n);
        axis = (axis + turn % n + 1) % n;
        place = place << n | number;
    }
    return place;
}

typedef struct Plot {
    uint64_t place; // along the curve
    uint32_t cell;
    double load;
} Plot;

static int by_place(const void *left, const void *right) {
    const Plot *a = left, *b = right;
    return (a->place > b->place) - (a->place < b->place);
}

static void order_plots(const Grid *grid, Plot *plots, uint32_t count) {
    uint32_t most = 1, levels = 0;
    for (size_t k = 0; k < grid->dimensions; k++)
        most = grid->cells[k] > most ? grid->cells[k] : most;
    while (UINT64_C(1) << levels < most)
        levels++;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t cell[PHYS_VECTOR_DIMENSIONS] = {0}, rest = i;
        for (size_t k = 0; k < grid->dimensions; k++, rest /= grid->cells[k - 1])
            cell[k] = rest % grid->cells[k];
        plots[i] = (Plot){phys_curve_place(cell, (uint32_t)grid->dimensions, levels), i, 0};
    }
}

// Runs of plots with equal loads, as nearly as they come.
static void deal_out(Plot *plots, uint32_t count, uint32_t ranks, uint32_t *owners) {
    double total = 0, so_far = 0;
    for (uint32_t i = 0; i < count; i++)
        total += plots[i].load;
    for (uint32_t i = 0; i < count; i++) {
        double middle = so_far + plots[i].load / 2;
        double rank = total > 0 ? floor(middle / total * ranks) : 0;
        owners[plots[i].cell] = rank < ranks ? (uint32_t)rank : ranks - 1;
        so_far += plots[i].load;
    }
}

// What a particle of each rank has cost, if that is known.
static void price(const PhysSystem *system, const Domain *domain, double *prices) {
    const uint32_t *counts = domain->counts.bytes;
    const double *loads = domain->loads.bytes;
    int ranks = system->options.ranks.count;
    double highest = 0;
    for (int r = 0; r < ranks; r++) {
        prices[r] = domain->steps && counts[r] && loads[r] > 0 ? loads[r] / counts[r] : 0;
        highest = prices[r] > highest ? prices[r] : highest;
    }
    for (int r = 0; r < ranks; r++) // a rank that had nothing knows no price
        prices[r] = prices[r] > 0 ? prices[r] : highest > 0 ? highest : 1;
}

// As many plots along each axis as the curve has: cut in the middle, it gives halves with a straight border.
static void round_plots(Grid *grid) {
    for (size_t k = 0; k < grid->dimensions; k++) {
        uint32_t cells = 1;
        while (2 * cells <= grid->cells[k])
            cells *= 2;
        grid->scale[k] = cells > 1 ? grid->scale[k] * cells / grid->cells[k] : 0;
        grid->cells[k] = cells;
    }
}

static bool lay_plots(PhysSystem *system, Domain *domain) {
    Neighbours *survey = &domain->survey;
    PairPass pass = phys_columns_pass(&system->columns);
    survey->ranges = (PassRanges){.count = 1, .at = {{0, system->particle_count}}};
    survey->total = system->particle_count;
    survey->touch_only = domain->bound == 0;
    survey->bound = domain->bound;
    if (!phys_buffer_reserve(system, &survey->cells, 0, system->particle_count, sizeof(uint32_t)))
        return false;
    survey->cell = survey->cells.bytes;
    domain->plots = (Grid){.dimensions = system->dimensions, .cells = {1, 1, 1}};
    double most = (double)PLOTS_EACH * system->options.ranks.count;
    if (!phys_grid_lay(&pass, survey, most, &domain->plots, &domain->widest))
        return false;
    round_plots(&domain->plots);
    domain->large_count = 0;
    for (uint32_t i = 0; i < system->particle_count; i++)
        if (survey->cell[i] == PHYS_CELL_LARGE)
            domain->large[domain->large_count++] = i;
    return true;
}

// Who owns which particle, and which of this rank are on the shore.
static bool take_owners(PhysSystem *system, Domain *domain) {
    const uint32_t *at = domain->survey.cell, *plot_owners = domain->plot_owners.bytes, *inland = domain->inland.bytes;
    uint32_t *owners = phys_owners(domain), *counts = domain->counts.bytes;
    memset(counts, 0, (size_t)system->options.ranks.count * sizeof *counts);
    domain->shore.count = domain->fresh.count = 0;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        owners[i] = plot_owners[at[i]];
        counts[owners[i]]++;
        if (owners[i] == (uint32_t)system->options.ranks.rank && !inland[at[i]] &&
            !phys_list_column(system, &domain->shore, i))
            return false;
    }
    return true;
}

bool phys_domain_deal(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    uint32_t count = system->particle_count, ranks = (uint32_t)system->options.ranks.count;
    if (!lay_plots(system, domain))
        return false;
    uint32_t cells = domain->plots.cells[0] * domain->plots.cells[1] * domain->plots.cells[2],
             *at = domain->survey.cell;
    if (!phys_buffer_reserve(system, &domain->numbers, 0, cells * sizeof(Plot) + ranks * sizeof(double), 1) ||
        !phys_buffer_reserve(system, &domain->plot_owners, 0, cells, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->owners, (uint64_t)domain->made * count * sizeof(uint32_t), count,
                             sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->counts, 0, ranks, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->loads, 0, ranks, sizeof(double)))
        return false;
    Plot *plots = domain->numbers.bytes;
    double *prices = (double *)(plots + cells);
    price(system, domain, prices);
    order_plots(&domain->plots, plots, cells);
    for (uint32_t i = 0; i < count; i++) {
        at[i] = phys_cell_of(&domain->plots, columns->position + i, columns->stride);
        plots[at[i]].load += prices[domain->steps ? phys_owners(domain)[i] : 0];
    }
    qsort(plots, cells, sizeof *plots, by_place);
    deal_out(plots, cells, ranks, domain->plot_owners.bytes);
    memset(domain->loads.bytes, 0, ranks * sizeof(double));
    domain->steps = 0;
    domain->seconds = 0;
    return phys_domain_find_inland(system, domain) && take_owners(system, domain);
}
