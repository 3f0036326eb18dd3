// particles.c: the columns that are simulated, filled from the description and written back to it.
#include "maths/many.h"
#include "physics/internal.h"
#include "physics/kernels.h"
#include "physics/threads.h"

#include <string.h>

// Points the columns into their memory.
static bool reserve_columns(PhysSystem *system) {
    Columns *columns = &system->columns;
    uint64_t n = system->dimensions, count = system->particle_count;
    double **vectors[] = {&columns->position, &columns->velocity, &columns->thrust, &columns->force};
    double **scalars[] = {&columns->ease,   &columns->radius,  &columns->mass,
                          &columns->charge, &columns->section, &columns->volume};
    enum { VECTORS = sizeof vectors / sizeof *vectors, SCALARS = sizeof scalars / sizeof *scalars, SCRATCH = 3 };
    // n * count is bounded by the rows, which exist already. Without particles nothing is needed, however large n is.
    // Vector kernels want columns that begin at a cache line, and may read one vector beyond the last.
    enum { LINE = 8 };
    uint64_t stride = n <= PHYS_VECTOR_DIMENSIONS ? (count + LINE - 1) / LINE * LINE : count;
    uint64_t doubles = VECTORS * n * stride + SCALARS * stride + (count ? SCRATCH * n : 0) + 2 * LINE;
    uint64_t flags = (count + sizeof(double) - 1) / sizeof(double);
    if (!phys_buffer_reserve(system, &system->column_data, 0, doubles + flags, sizeof(double)))
        return false;
    *columns = (Columns){.dimensions = n, .count = system->particle_count, .stride = stride};
    if (!count)
        return true;
    uintptr_t line = LINE * sizeof(double), address = (uintptr_t)system->column_data.bytes;
    double *next = (double *)((address + line - 1) / line * line);
    for (int i = 0; i < VECTORS; i++, next += n * stride)
        *vectors[i] = next;
    for (int i = 0; i < SCALARS; i++, next += stride)
        *scalars[i] = next;
    columns->scratch = next;
    columns->anchor = (bool *)(next + SCRATCH * n);
    // Lanes beyond the last particle are computed and thrown away: from defined numbers, not from whatever lay here.
    size_t padding = (stride - count) * sizeof(double);
    for (int i = 0; i < VECTORS; i++)
        for (uint64_t k = 0; k < n && padding; k++)
            memset(*vectors[i] + k * stride + count, 0, padding);
    for (int i = 0; i < SCALARS; i++)
        memset(*scalars[i] + count, 0, padding);
    memset(columns->anchor + count, 0, 2 * LINE);
    return true;
}

static void raise_radii(const PhysSystem *system, double power, double *to) {
    maths_power_many(system->options.cpu, system->columns.radius, power, system->columns.count, to);
}

// radius^(n-1) and radius^n are wanted at every step.
void phys_raise_radii(PhysSystem *system) {
    const Columns *columns = &system->columns;
    const Force *forces = system->forces.bytes;
    bool drag = false, buoyancy = false;
    for (uint32_t i = 0; i < system->force_count; i++) {
        drag |= forces[i].given.kind == PHYS_DRAG;
        buoyancy |= forces[i].given.kind == PHYS_BUOYANCY;
    }
    double n = (double)columns->dimensions;
    if (drag)
        raise_radii(system, n - 1, columns->section);
    if (buoyancy)
        raise_radii(system, n, columns->volume);
    system->radii_raised = true;
}

static void load_share(void *context, int worker, int workers) {
    PhysSystem *system = context;
    const Columns *columns = &system->columns;
    const ParticleRecord *particles = system->particles.bytes;
    size_t n = columns->dimensions, stride = columns->stride, end = phys_share(columns->count, worker + 1, workers);
    for (size_t i = phys_share(columns->count, worker, workers); i < end; i++) {
        uint32_t handle = system->order[i];
        const ParticleRecord *particle = &particles[handle];
        columns->radius[i] = particle->radius;
        columns->mass[i] = particle->mass;
        columns->charge[i] = particle->charge;
        columns->anchor[i] = particle->anchor;
        const double *row = phys_row(system, handle);
        for (size_t k = 0; k < n; k++) {
            columns->position[k * stride + i] = row[k];
            columns->velocity[k * stride + i] = row[n + k];
        }
        if (!system->pushed)
            continue;
        const double *thrust = (const double *)system->thrusts.bytes + n * handle;
        columns->ease[i] = particle->ease;
        for (size_t k = 0; k < n; k++)
            columns->thrust[k * stride + i] = thrust[k];
    }
}

typedef struct Storing {
    PhysSystem *system;
    bool settle;
    bool lost[PHYS_MOST_SHARES]; // something was not finite
} Storing;

// A vector that is finite, and differs from what it was unless that was fresh, replaces that in the row, else the row's
// replaces it. False if it was not finite.
static inline bool settle(double *column, size_t stride, double *row, size_t n, bool fresh) {
    bool finite = true, equal = true;
    for (size_t k = 0; k < n; k++) {
        double x = column[k * stride];
        finite &= x - x == 0;
        equal &= x == row[k];
    }
    if (finite && (fresh || !equal))
        for (size_t k = 0; k < n; k++)
            row[k] = column[k * stride];
    else
        for (size_t k = 0; k < n; k++)
            column[k * stride] = row[k];
    return finite;
}

static inline void settle_range(Storing *storing, size_t n, size_t i, size_t end, int worker) {
    PhysSystem *system = storing->system;
    const Columns *columns = &system->columns;
    size_t stride = columns->stride;
    for (; i < end; i++) {
        double *row = (double *)system->rows.bytes + 2 * n * system->order[i];
        ParticleRecord *record = system->fresh ? (ParticleRecord *)system->particles.bytes + system->order[i] : NULL;
        bool position = settle(columns->position + i, stride, row, n, record && record->fresh_position);
        bool velocity = settle(columns->velocity + i, stride, row + n, n, record && record->fresh_velocity);
        if (record) {
            record->fresh_position &= !position;
            record->fresh_velocity &= !velocity;
        }
        if (position && velocity)
            continue;
        ((uint8_t *)system->unfinished.bytes)[system->order[i]] =
            (uint8_t)((position ? 0 : PHYS_LOST_POSITION) | (velocity ? 0 : PHYS_LOST_VELOCITY));
        storing->lost[worker] = true;
    }
}

static void store_share(void *context, int worker, int workers) {
    Storing *storing = context;
    PhysSystem *system = storing->system;
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, stride = columns->stride, end = phys_share(columns->count, worker + 1, workers);
    size_t first = phys_share(columns->count, worker, workers);
    if (storing->settle) {
        if (n == 2)
            settle_range(storing, 2, first, end, worker);
        else if (n == 3)
            settle_range(storing, 3, first, end, worker);
        else
            settle_range(storing, n, first, end, worker);
        return;
    }
    for (size_t i = first; i < end; i++) {
        double *row = phys_row(system, system->order[i]);
        for (size_t k = 0; k < n; k++) {
            row[k] = columns->position[k * stride + i];
            row[n + k] = columns->velocity[k * stride + i];
        }
    }
}

bool phys_clear_marks(PhysSystem *system) {
    uint64_t before = system->unfinished.capacity;
    if (!phys_buffer_reserve(system, &system->unfinished, 0, system->particle_count, 1))
        return false;
    if ((system->lost || system->unfinished.capacity != before) && system->unfinished.capacity)
        memset(system->unfinished.bytes, 0, system->unfinished.capacity);
    system->lost = false;
    return true;
}

static int shares_for(const PhysSystem *system) {
    enum { FEW = 10000 }; // that are copied before a second thread is ready
    return phys_shares(system, system->particle_count, FEW);
}

bool phys_load(PhysSystem *system) {
    if (!reserve_columns(system))
        return false;
    phys_parallel(system, shares_for(system), load_share, system);
    return true;
}

void phys_store(PhysSystem *system, bool settle_them) {
    Storing storing = {.system = system, .settle = settle_them};
    phys_parallel(system, shares_for(system), store_share, &storing);
    for (int w = 0; w < PHYS_MOST_SHARES; w++)
        system->lost |= storing.lost[w];
    system->fresh &= !settle_them || system->lost;
}
