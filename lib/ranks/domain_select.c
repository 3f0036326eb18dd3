// domain_select.c: selects the owned particles that other ranks need for their halos.
//
// Nearly all owned particles are in interior patches, whose particles no other rank needs. So patches are tested before
// particles.
#include "ranks/domain.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

// Returns the distance up to which two particles can interact before the next rebuild, if their radii are `radius` and
// `partner`.
static double interaction_range(const Domain *domain, double radius, double partner) {
    double touch = domain->reach.contact ? radius + partner : 0;
    return (fmax(touch, domain->reach.bound) + domain->survey.skin) * (1 + 1e-9);
}

// On each line of patches along one axis, clears the patches within `margin` of a patch that is 0. The line has
// `length` patches, `stride` elements apart.
static void shrink_interior(uint32_t *patches, uint32_t count, uint32_t length, uint32_t stride, uint32_t margin) {
    for (uint32_t l = 0; l < count / length; l++) {
        uint32_t *line = patches + (size_t)(l / stride) * stride * length + l % stride, away = margin;
        for (uint32_t i = 0; i < length; i++)
            line[(size_t)i * stride] = away = line[(size_t)i * stride] ? away + 1 : 0;
        away = margin;
        for (uint32_t i = length; i-- > 0;) {
            away = line[(size_t)i * stride] ? away + 1 : 0;
            line[(size_t)i * stride] = away > margin && line[(size_t)i * stride] > margin;
        }
    }
}

// Returns how many patches beyond its own a particle can reach along an axis, with a margin for rounding. Large
// particles are treated separately.
static uint32_t patch_margin(const Domain *domain, size_t k) {
    const Grid *grid = &domain->patches;
    double span = grid->cells[k] / grid->scale[k];
    double rounding = 8 * DBL_EPSILON * (fabs(grid->low[k]) + span);
    double margin =
        floor((interaction_range(domain, domain->max_radius, domain->max_radius) + rounding) * grid->scale[k] + 1e-9) +
        1;
    return margin < grid->cells[k] ? (uint32_t)margin : grid->cells[k];
}

bool domain_find_interior(PhysSystem *system, Domain *domain) {
    const Grid *grid = &domain->patches;
    uint32_t count = grid->cells[0] * grid->cells[1] * grid->cells[2], stride = 1;
    if (!phys_buffer_reserve(system, &domain->interior, 0, count, sizeof(uint32_t)))
        return false;
    uint32_t *interior = domain->interior.bytes;
    const uint32_t *owners = domain->patch_owners.bytes;
    bool near = !domain->large_count; // large particles may reach any patch, so that no patch is interior
    for (uint32_t i = 0; i < count; i++)
        interior[i] = near && owners[i] == ranks_self(system);
    for (size_t k = 0; k < grid->dimensions; stride *= grid->cells[k], k++)
        if (grid->cells[k] > 1)
            shrink_interior(interior, count, grid->cells[k], stride, patch_margin(domain, k));
    return true;
}

// Adds transfers of a particle to the owners of all patches that it can reach. Rounding errors are harmless, because
// the index of a patch is monotonic in the position.
static bool select_for_patches(PhysSystem *system, Domain *domain, uint32_t column, uint32_t *last_sent) {
    const Columns *columns = &system->columns;
    const Grid *grid = &domain->patches;
    uint32_t low[PHYS_VECTOR_DIMENSIONS] = {0}, high[PHYS_VECTOR_DIMENSIONS] = {0};
    double far = interaction_range(domain, columns->radius[column], domain->max_radius);
    for (size_t k = 0; k < grid->dimensions; k++) {
        double x = columns->position[k * columns->stride + column];
        low[k] = phys_axis_cell(grid, k, x - far);
        high[k] = phys_axis_cell(grid, k, x + far);
    }
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++)
            for (uint32_t x = low[0]; x <= high[0]; x++) {
                uint32_t patch = (z * grid->cells[1] + y) * grid->cells[0] + x;
                uint32_t owner = ((const uint32_t *)domain->patch_owners.bytes)[patch];
                if (last_sent[owner] == column + 1)
                    continue;
                last_sent[owner] = column + 1;
                if (!domain_add_transfer(system, domain, owner, column))
                    return false;
            }
    return true;
}

// Adds transfers of a particle to the owners of large particles that can reach it.
static bool select_for_large(PhysSystem *system, Domain *domain, uint32_t column, const double *positions,
                             uint32_t *last_sent) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions;
    for (uint32_t l = 0; l < domain->large_count; l++) {
        uint32_t owner = domain_owners(domain)[domain->large[l]];
        double far = interaction_range(domain, columns->radius[column], columns->radius[domain->large[l]]);
        bool near = last_sent[owner] != column + 1;
        for (size_t k = 0; k < n; k++)
            near &= fabs(columns->position[k * columns->stride + column] - positions[l * n + k]) <= far;
        if (!near)
            continue;
        last_sent[owner] = column + 1;
        if (!domain_add_transfer(system, domain, owner, column))
            return false;
    }
    return true;
}

// Exchanges the positions of the large particles between the ranks. Returns the positions of all large particles, or
// NULL if out of memory.
static const double *large_positions(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions;
    if (!phys_buffer_reserve(system, &domain->message, 0, domain->large_count * n, sizeof(double)))
        return NULL;
    double *positions = domain->message.bytes;
    for (uint32_t l = 0; l < domain->large_count; l++)
        for (size_t k = 0; k < n; k++) {
            double x = columns->position[k * columns->stride + domain->large[l]];
            bool own = domain_owners(domain)[domain->large[l]] == ranks_self(system);
            positions[l * n + k] = own && !isnan(x) ? x : -INFINITY;
        }
    domain_reduce(system, domain, positions, domain->large_count * n);
    return positions;
}

static int compare_transfers(const void *left, const void *right) {
    const Transfer *a = left, *b = right;
    if (a->rank != b->rank)
        return a->rank < b->rank ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

// Adds transfers for links between particles of different ranks, whatever their distance is. Then removes duplicate
// transfers.
static bool select_for_links(PhysSystem *system, Domain *domain) {
    const Force *forces = system->forces.bytes;
    const uint32_t *owners = domain_owners(domain);
    uint32_t self = ranks_self(system), before = domain->transfer_count;
    for (uint32_t f = 0; f < system->force_count; f++) {
        const PhysForce *link = &forces[f].given;
        if (phys_force_row(link->kind).stage != STAGE_LINK || owners[link->from] == owners[link->to])
            continue;
        if ((owners[link->from] == self && !domain_add_transfer(system, domain, owners[link->to], link->from)) ||
            (owners[link->to] == self && !domain_add_transfer(system, domain, owners[link->from], link->to)))
            return false;
    }
    if (domain->transfer_count == before)
        return true;
    Transfer *transfers = domain->transfers.bytes;
    uint32_t unique = 0;
    qsort(transfers, domain->transfer_count, sizeof *transfers, compare_transfers);
    for (uint32_t i = 0; i < domain->transfer_count; i++)
        if (!unique || compare_transfers(&transfers[i], &transfers[unique - 1]))
            transfers[unique++] = transfers[i];
    domain->transfer_count = unique;
    return true;
}

bool domain_select(PhysSystem *system, Domain *domain) {
    uint32_t self = ranks_self(system), ranks = ranks_count(system);
    const double *positions = domain->large_count ? large_positions(system, domain) : NULL;
    if ((domain->large_count && !positions) ||
        !phys_buffer_reserve(system, &domain->to.items, 0, ranks, sizeof(uint32_t)))
        return false;
    const uint32_t *boundary = domain->boundary.columns.bytes;
    uint32_t *last_sent = domain->to.items.bytes; // by rank: last column selected for that rank, plus 1
    memset(last_sent, 0, ranks * sizeof *last_sent);
    domain->transfer_count = 0;
    for (uint32_t i = 0; i < domain->boundary.count; i++) {
        last_sent[self] = boundary[i] + 1;
        if (!select_for_patches(system, domain, boundary[i], last_sent) ||
            (positions && !select_for_large(system, domain, boundary[i], positions, last_sent)))
            return false;
    }
    return select_for_links(system, domain);
}
