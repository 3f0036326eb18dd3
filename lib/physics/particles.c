// particles.c: fills the columns from the description and writes the results back to the rows.
#include "base/number.h"
#include "maths/arrays.h"
#include "physics/internal.h"
#include "physics/kernels.h"
#include "physics/threads.h"

#include <string.h>

bool phys_reserve_columns(PhysSystem *system, uint64_t spare) {
    Columns *columns = &system->columns;
    uint64_t n = system->dimensions, count = system->particle_count;
    // The last elements of `vectors` and `scalars` are used only if particles have `force` attributes. When the first
    // such attribute is set, the columns are reserved again.
    double **vectors[] = {&columns->position, &columns->velocity, &columns->force, &columns->own_force};
    double **scalars[] = {&columns->radius,  &columns->mass,   &columns->charge,
                          &columns->section, &columns->volume, &columns->ease};
    enum { SCRATCH = 3 };
    bool own = system->own_forces != OWN_FORCES_NONE;
    const unsigned vector_count = own ? 4 : 3, scalar_count = own ? 6 : 5;
    // n * count cannot overflow, because the rows already exist. Without particles no memory is needed, however large n
    // is. Columns are aligned to cache lines, and kernels may read one vector beyond the end.
    enum { LINE = 8 };
    uint64_t stride = n <= PHYS_VECTOR_DIMENSIONS ? (count + spare + LINE - 1) / LINE * LINE : count;
    uint64_t doubles = vector_count * n * stride + scalar_count * stride + (count ? SCRATCH * n : 0) + 2 * LINE;
    uint64_t flags = (stride + sizeof(double) - 1) / sizeof(double);
    if (!phys_buffer_reserve(system, &system->column_data, 0, doubles + flags, sizeof(double)) ||
        (system->options.keep_forces &&
         !phys_buffer_reserve(system, &system->force_rows, 0, count, n * sizeof(double))))
        return false;
    *columns = (Columns){.dimensions = system->dimensions, .count = system->particle_count, .stride = (size_t)stride};
    if (!count)
        return true;
    uintptr_t line = LINE * sizeof(double), address = (uintptr_t)system->column_data.bytes;
    double *next = (double *)((address + line - 1) / line * line);
    for (unsigned i = 0; i < vector_count; i++, next += n * stride)
        *vectors[i] = next;
    for (unsigned i = 0; i < scalar_count; i++, next += stride)
        *scalars[i] = next;
    columns->scratch = next;
    columns->anchor = (bool *)(next + SCRATCH * n);
    // Kernels also compute the lanes beyond the last particle and discard the results, so these lanes must be
    // initialised.
    size_t padding = (size_t)(stride - count) * sizeof(double);
    for (unsigned i = 0; i < vector_count; i++)
        for (uint64_t k = 0; k < n && padding; k++)
            memset(*vectors[i] + k * stride + count, 0, padding);
    for (unsigned i = 0; i < scalar_count; i++)
        memset(*scalars[i] + count, 0, padding);
    memset(columns->anchor + count, 0, (size_t)(stride - count) + 2 * LINE);
    return true;
}

static void power_radii(const PhysSystem *system, double power, double *to) {
    maths_arrays(system->options.cpu)->pow(system->columns.radius, &power, 0, system->columns.count, to);
}

// Computes radius^(n-1) and radius^n if forces need them. All steps use these numbers.
void phys_update_radius_powers(PhysSystem *system) {
    const Columns *columns = &system->columns;
    const Force *forces = system->forces.bytes;
    bool section = false, volume = false;
    for (uint32_t i = 0; i < system->force_count; i++) {
        ForceNeed need = phys_force_row(forces[i].given.kind).need;
        section |= need == NEED_SECTION;
        volume |= need == NEED_VOLUME;
    }
    double n = (double)columns->dimensions;
    if (section)
        power_radii(system, n - 1, columns->section);
    if (volume)
        power_radii(system, n, columns->volume);
    if (section || volume)
        phys_note_change(system, COLUMNS_EDITED);
}

static void fill_motion(const PhysSystem *system, size_t i) {
    const Columns *columns = &system->columns;
    const double *row = phys_row(system, system->order[i]);
    for (size_t k = 0, n = columns->dimensions; k < n; k++) {
        columns->position[k * columns->stride + i] = row[k];
        columns->velocity[k * columns->stride + i] = row[n + k];
    }
}

static void fill_motion_chunk(void *context, int chunk, int chunks) {
    const PhysSystem *system = context;
    size_t end = phys_chunk_begin(system->columns.count, chunk + 1, chunks);
    for (size_t i = phys_chunk_begin(system->columns.count, chunk, chunks); i < end; i++)
        fill_motion(system, i);
}

static void fill_row_chunk(void *context, int chunk, int chunks) {
    PhysSystem *system = context;
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, stride = columns->stride, end = phys_chunk_begin(columns->count, chunk + 1, chunks);
    for (size_t i = phys_chunk_begin(columns->count, chunk, chunks); i < end; i++) {
        uint32_t handle = system->order[i];
        const ParticleRecord *particle = phys_record(system, handle);
        columns->radius[i] = particle->radius;
        columns->mass[i] = particle->mass;
        columns->charge[i] = particle->charge;
        columns->anchor[i] = particle->anchor;
        fill_motion(system, i);
        if (system->own_forces == OWN_FORCES_NONE)
            continue;
        const double *own_force = (const double *)system->own_force_rows.bytes + n * handle;
        columns->ease[i] = particle->ease;
        for (size_t k = 0; k < n; k++)
            columns->own_force[k * stride + i] = own_force[k];
    }
}

typedef struct RowWriter {
    PhysSystem *system;
    const Columns *columns;
    const uint32_t *order; // handles by column
    bool keep_last_finite;
    const PhysSystem *home;               // system whose columns receive restored values; NULL: none
    bool any_not_finite[PHYS_MAX_CHUNKS]; // by chunk: some value was not finite
} RowWriter;

// Applies PhysTime.keep_last_finite to one vector. If the result in `column` is finite, and if it differs from `row` or
// `row` came from an attribute, copies it to `row`. Otherwise copies `row` to `home`, unless `home` is NULL. Returns
// false if the result was not finite. The state references the rows (scene/mirror.h). Only this function and
// Kernels.write_rows keep inf and nan of `!physics` out of the rows.
static inline bool keep_last_finite(const Columns *columns, const double *column, double *row, bool from_attribute,
                                    double *home, size_t home_stride) {
    size_t n = columns->dimensions, stride = columns->stride;
    bool finite = numbers_finite(column, n, stride), equal = true;
    for (size_t k = 0; k < n; k++)
        equal &= column[k * stride] == row[k];
    bool stored = finite && (from_attribute || !equal);
    for (size_t k = 0; k < n && stored; k++)
        row[k] = column[k * stride];
    for (size_t k = 0; k < n && !stored && home; k++)
        home[k * home_stride] = row[k];
    return finite;
}

// Applies PhysTime.keep_last_finite to one particle. If its position or velocity was not finite, marks that vector in
// system->not_finite and returns false.
static bool write_finite_row(const RowWriter *writer, size_t i) {
    const PhysSystem *system = writer->system, *home = writer->home;
    const Columns *columns = writer->columns;
    uint32_t handle = writer->order[i];
    double *row = phys_row(system, handle), *position = NULL, *velocity = NULL;
    size_t n = columns->dimensions, stride = home ? home->columns.stride : 0;
    if (home) {
        size_t at = home == system ? i : home->column_of[system->column_of[handle]];
        position = home->columns.position + at;
        velocity = home->columns.velocity + at;
    }
    uint8_t *from = system->any_from_attribute ? (uint8_t *)system->from_attribute.bytes + handle : NULL;
    bool position_given = from && (*from & PHYS_POSITION), velocity_given = from && (*from & PHYS_VELOCITY);
    bool position_finite = keep_last_finite(columns, columns->position + i, row, position_given, position, stride);
    bool velocity_finite = keep_last_finite(columns, columns->velocity + i, row + n, velocity_given, velocity, stride);
    uint8_t marks = (uint8_t)((position_finite ? 0 : PHYS_POSITION) | (velocity_finite ? 0 : PHYS_VELOCITY));
    if (from)
        *from &= marks;
    if (marks)
        ((uint8_t *)system->not_finite.bytes)[handle] = marks;
    return !marks;
}

static inline void copy_to_row(const RowWriter *writer, size_t n, size_t i) {
    const Columns *columns = writer->columns;
    double *row = phys_row(writer->system, writer->order[i]);
    for (size_t k = 0; k < n; k++) {
        row[k] = columns->position[k * columns->stride + i];
        row[n + k] = columns->velocity[k * columns->stride + i];
    }
}

static void write_chunk(void *context, int chunk, int chunks) {
    RowWriter *writer = context;
    const PhysSystem *system = writer->system;
    const Columns *columns = writer->columns;
    size_t n = columns->dimensions, end = phys_chunk_begin(columns->count, chunk + 1, chunks);
    size_t first = phys_chunk_begin(columns->count, chunk, chunks);
    if (writer->keep_last_finite) {
        // When the kernel stops, the next `lanes` particles are written one at a time. Then the kernel continues.
        const Kernels *kernels = system->kernels;
        while (first < end) {
            if (n <= PHYS_VECTOR_DIMENSIONS && !system->any_from_attribute)
                first = kernels->write_rows(columns, writer->order, system->rows.bytes, first, end);
            size_t stop = end - first < kernels->lanes ? end : first + kernels->lanes;
            for (; first < stop; first++)
                writer->any_not_finite[chunk] |= !write_finite_row(writer, first);
        }
        return;
    }
    for (size_t i = first; i < end; i++)
        copy_to_row(writer, n, i);
}

bool phys_clear_not_finite(PhysSystem *system) {
    uint64_t before = system->not_finite.capacity;
    if (!phys_buffer_reserve(system, &system->not_finite, 0, system->particle_count, 1))
        return false;
    if ((system->any_not_finite || system->not_finite.capacity != before) && system->not_finite.capacity)
        memset(system->not_finite.bytes, 0, (size_t)system->not_finite.capacity);
    system->any_not_finite = false;
    return true;
}

// Copies the forces to force_rows, for PhysColumns.force.
static void write_forces(PhysSystem *system, const Columns *columns, const uint32_t *order) {
    size_t n = columns->dimensions;
    for (size_t i = 0; i < columns->count; i++) {
        double *row = (double *)system->force_rows.bytes + n * order[i];
        for (size_t k = 0; k < n; k++)
            row[k] = columns->anchor && columns->anchor[i] ? 0 : columns->force[k * columns->stride + i];
    }
}

bool phys_keep_start(PhysSystem *system) {
    uint64_t row = (uint64_t)2 * system->dimensions * sizeof(double), count = system->particle_count;
    if (!phys_buffer_reserve(system, &system->start_rows, 0, count, row))
        return false;
    if (count)
        memcpy(system->start_rows.bytes, system->rows.bytes, (size_t)(count * row));
    return true;
}

static int row_chunk_count_for(const PhysSystem *system, uint32_t particles) {
    enum { MIN_FOR_THREADS = 10000 };
    return phys_chunk_count(system, particles, MIN_FOR_THREADS);
}

bool phys_fill_columns(PhysSystem *system) {
    if (!phys_reserve_columns(system, 0))
        return false;
    phys_parallel(system, row_chunk_count_for(system, system->particle_count), fill_row_chunk, system);
    phys_note_change(system, COLUMNS_FILLED);
    system->radius_version++;
    system->motion_version++;
    return true;
}

void phys_fill_motion(PhysSystem *system) {
    phys_parallel(system, row_chunk_count_for(system, system->particle_count), fill_motion_chunk, system);
    system->motion_version++;
}

void phys_write_column_rows(PhysSystem *system, const Columns *columns, const uint32_t *order, bool keep,
                            const PhysSystem *home) {
    RowWriter writer = {.system = system, .columns = columns, .order = order, .keep_last_finite = keep, .home = home};
    phys_parallel(system, row_chunk_count_for(system, columns->count), write_chunk, &writer);
    for (int w = 0; w < PHYS_MAX_CHUNKS; w++)
        system->any_not_finite |= writer.any_not_finite[w];
    if (system->options.keep_forces && system->has_forces)
        write_forces(system, columns, order);
}

void phys_write_rows(PhysSystem *system, bool keep) {
    phys_write_column_rows(system, &system->columns, system->order, keep, system);
    system->any_from_attribute &= !keep || system->any_not_finite;
}
