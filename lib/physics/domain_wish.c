// domain_wish.c: which particles of this rank others need to know.
//
// Nearly all are inland, where nobody can see them, so plots are looked at before particles are.
#include "physics/domain.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

// How far a particle with this radius may be from one of its partners, except for large ones.
static double reach(const Domain *domain, double radius, double partner) {
    double touch = domain->contact ? radius + partner : 0;
    return (fmax(touch, domain->bound) + domain->survey.skin) * (1 + 1e-9);
}

// On each line of plots along an axis, those within `margin` of one that is not inland are not inland either.
static void move_shores(uint32_t *plots, uint32_t count, uint32_t length, uint32_t stride, uint32_t margin) {
    for (uint32_t l = 0; l < count / length; l++) {
        uint32_t *line = plots + (size_t)(l / stride) * stride * length + l % stride, away = margin;
        for (uint32_t i = 0; i < length; i++)
            line[(size_t)i * stride] = away = line[(size_t)i * stride] ? away + 1 : 0;
        away = margin;
        for (uint32_t i = length; i-- > 0;) {
            away = line[(size_t)i * stride] ? away + 1 : 0;
            line[(size_t)i * stride] = away > margin && line[(size_t)i * stride] > margin;
        }
    }
}

// How many plots a regular particle sees along an axis beyond its own, rounding included.
static uint32_t margin_of(const Domain *domain, size_t k) {
    const Grid *grid = &domain->plots;
    double span = grid->cells[k] / grid->scale[k];
    double rounding = 8 * DBL_EPSILON * (fabs(grid->low[k]) + span);
    double margin = floor((reach(domain, domain->widest, domain->widest) + rounding) * grid->scale[k] + 1e-9) + 1;
    return margin < grid->cells[k] ? (uint32_t)margin : grid->cells[k];
}

bool phys_domain_find_inland(PhysSystem *system, Domain *domain) {
    const Grid *grid = &domain->plots;
    uint32_t count = grid->cells[0] * grid->cells[1] * grid->cells[2], stride = 1;
    if (!phys_buffer_reserve(system, &domain->inland, 0, count, sizeof(uint32_t)))
        return false;
    uint32_t *inland = domain->inland.bytes;
    const uint32_t *owners = domain->plot_owners.bytes;
    bool near = !domain->large_count; // they may see any particle
    for (uint32_t i = 0; i < count; i++)
        inland[i] = near && owners[i] == (uint32_t)system->options.ranks.rank;
    for (size_t k = 0; k < grid->dimensions; stride *= grid->cells[k], k++)
        if (grid->cells[k] > 1)
            move_shores(inland, count, grid->cells[k], stride, margin_of(domain, k));
    return true;
}

// All plots that a particle can see into, rounding included, because the number of a plot rises with the position.
static bool wish_for_plots(PhysSystem *system, Domain *domain, uint32_t column, uint32_t *told) {
    const Columns *columns = &system->columns;
    const Grid *grid = &domain->plots;
    uint32_t low[PHYS_VECTOR_DIMENSIONS] = {0}, high[PHYS_VECTOR_DIMENSIONS] = {0};
    double far = reach(domain, columns->radius[column], domain->widest);
    for (size_t k = 0; k < grid->dimensions; k++) {
        double x = columns->position[k * columns->stride + column];
        low[k] = phys_axis_cell(grid, k, x - far);
        high[k] = phys_axis_cell(grid, k, x + far);
    }
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++)
            for (uint32_t x = low[0]; x <= high[0]; x++) {
                uint32_t plot = (z * grid->cells[1] + y) * grid->cells[0] + x;
                uint32_t owner = ((const uint32_t *)domain->plot_owners.bytes)[plot];
                if (told[owner] == column + 1)
                    continue;
                told[owner] = column + 1;
                if (!phys_add_parcel(system, domain, owner, column))
                    return false;
            }
    return true;
}

// Those that a large particle of another rank can see.
static bool wish_for_large(PhysSystem *system, Domain *domain, uint32_t column, const double *places, uint32_t *told) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions;
    for (uint32_t l = 0; l < domain->large_count; l++) {
        uint32_t owner = phys_owners(domain)[domain->large[l]];
        double far = reach(domain, columns->radius[column], columns->radius[domain->large[l]]);
        bool near = told[owner] != column + 1;
        for (size_t k = 0; k < n; k++)
            near &= fabs(columns->position[k * columns->stride + column] - places[l * n + k]) <= far;
        if (!near)
            continue;
        told[owner] = column + 1;
        if (!phys_add_parcel(system, domain, owner, column))
            return false;
    }
    return true;
}

// Where large particles are must be known to all.
static const double *large_places(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions;
    if (!phys_buffer_reserve(system, &domain->numbers, 0, domain->large_count * n, sizeof(double)))
        return NULL;
    double *places = domain->numbers.bytes;
    for (uint32_t l = 0; l < domain->large_count; l++)
        for (size_t k = 0; k < n; k++) {
            double x = columns->position[k * columns->stride + domain->large[l]];
            bool own = phys_owners(domain)[domain->large[l]] == (uint32_t)system->options.ranks.rank;
            places[l * n + k] = own && !isnan(x) ? x : -INFINITY;
        }
    phys_domain_reduce(system, places, domain->large_count * n);
    return places;
}

static int by_rank(const void *left, const void *right) {
    const Parcel *a = left, *b = right;
    if (a->rank != b->rank)
        return a->rank < b->rank ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

// A link takes its ends along, however far apart.
static bool wish_for_links(PhysSystem *system, Domain *domain) {
    const Force *forces = system->forces.bytes;
    const uint32_t *owners = phys_owners(domain);
    uint32_t self = (uint32_t)system->options.ranks.rank, before = domain->parcel_count;
    for (uint32_t f = 0; f < system->force_count; f++) {
        const PhysForce *link = &forces[f].given;
        if (phys_force_row(link->kind).stage != STAGE_LINK || owners[link->from] == owners[link->to])
            continue;
        if ((owners[link->from] == self && !phys_add_parcel(system, domain, owners[link->to], link->from)) ||
            (owners[link->to] == self && !phys_add_parcel(system, domain, owners[link->from], link->to)))
            return false;
    }
    if (domain->parcel_count == before)
        return true;
    Parcel *parcels = domain->parcels.bytes;
    uint32_t kept = 0;
    qsort(parcels, domain->parcel_count, sizeof *parcels, by_rank);
    for (uint32_t i = 0; i < domain->parcel_count; i++)
        if (!kept || by_rank(&parcels[i], &parcels[kept - 1]))
            parcels[kept++] = parcels[i];
    domain->parcel_count = kept;
    return true;
}

bool phys_domain_wish(PhysSystem *system, Domain *domain) {
    uint32_t self = (uint32_t)system->options.ranks.rank, ranks = (uint32_t)system->options.ranks.count;
    const double *places = domain->large_count ? large_places(system, domain) : NULL;
    if ((domain->large_count && !places) || !phys_buffer_reserve(system, &domain->to.items, 0, ranks, sizeof(uint32_t)))
        return false;
    const uint32_t *shore = domain->shore.columns.bytes;
    uint32_t *told = domain->to.items.bytes; // by rank: the last particle that it was given, plus 1
    memset(told, 0, ranks * sizeof *told);
    domain->parcel_count = 0;
    for (uint32_t i = 0; i < domain->shore.count; i++) {
        told[self] = shore[i] + 1;
        if (!wish_for_plots(system, domain, shore[i], told) ||
            (places && !wish_for_large(system, domain, shore[i], places, told)))
            return false;
    }
    return wish_for_links(system, domain);
}
