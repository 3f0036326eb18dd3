// system.c: the description of a system (system.h).
#include "base/os.h"
#include "physics/division.h"
#include "physics/far_force.h"
#include "physics/neighbour_list.h"
#include "physics/threads.h"

#include <assert.h>
#include <string.h>

// Counts are uint32_t. PHYS_MAX_BYTES keeps them in range.
_Static_assert(PHYS_MAX_BYTES / sizeof(Group) < UINT32_MAX / STAGE_COUNT, "group numbers must fit");
_Static_assert(PHYS_MAX_BYTES / sizeof(ParticleRecord) < UINT32_MAX, "particle handles must fit");
_Static_assert(PHYS_MAX_BYTES / sizeof(ForceRecord) < UINT32_MAX, "force numbers must fit");
_Static_assert(PHYS_MAX_BYTES < SIZE_MAX, "sizes must fit");

enum { ROW_VECTORS = 2 }; // position, velocity

PhysSystem *phys_new(void) {
    Arena home;
    struct {
        PhysSystem system;
        NeighbourList lists[PHYS_MAX_LISTS];
        FarForest forests[PHYS_FORESTS];
    } * memory;
    arena_init(&home, "physics", SIZE_MAX);
    memory = arena_try_alloc(&home, sizeof *memory); // one block, so that nothing needs to be freed on failure
    if (!memory)
        return NULL;
    PhysSystem *system = &memory->system;
    NeighbourList *lists = memory->lists;
    *system = (PhysSystem){.home = home, .lists = lists, .forests = memory->forests};
    system->particles.shown = system->rows.shown = system->last_rows.shown = system->force_rows.shown = true;
    memset(lists, 0, PHYS_MAX_LISTS * sizeof *lists);
    memset(memory->forests, 0, sizeof memory->forests);
    phys_set_options(system, &(PhysOptions){.threads = 1, .cpu = cpu_detected.level});
    phys_begin(system, 1);
    return system;
}

static void free_division(PhysSystem *system) {
    if (system->division.bytes)
        system->options.division->free(system);
}

void phys_free(PhysSystem *system) {
    if (!system)
        return;
    Buffer *buffers[] = {&system->groups,      &system->particles,  &system->rows,           &system->force_records,
                         &system->vectors,     &system->indices,    &system->forces,         &system->column_data,
                         &system->last_rows,   &system->not_finite, &system->from_attribute, &system->own_force_rows,
                         &system->force_rows,  &system->start_rows, &system->terms,          &system->chain,
                         &system->host_vectors};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        phys_buffer_free(buffers[i]);
    for (int i = 0; i < PHYS_MAX_LISTS; i++)
        phys_neighbour_list_free(&system->lists[i]);
    for (int i = 0; i < PHYS_FORESTS; i++)
        phys_far_free(&system->forests[i]);
    free_division(system);
    if (!system->options.pool)
        phys_threads_free(system->threads);
    Arena home = system->home; // copied, because its memory holds the struct
    arena_free(&home);
}

static void return_to(PhysSystem *system, SystemState state) {
    if (system->state > state)
        system->state = state;
}

void phys_discard_columns(PhysSystem *system) {
    system->state = SYSTEM_DESCRIBED;
}

void phys_set_options(PhysSystem *system, const PhysOptions *options) {
    static const Kernels *const levels[CPU_LEVELS] = {
        [CPU_SCALAR] = &phys_kernels_two,
#ifdef PETRI_X86
        [CPU_AVX2] = &phys_kernels_avx2,
        [CPU_AVX512] = &phys_kernels_avx512,
#endif
    };
    CpuLevel best = cpu_detected.level;
    if (options->division != system->options.division)
        free_division(system);
    if (!system->options.pool)
        phys_threads_free(system->threads);
    if (options->keep_forces != system->options.keep_forces) { // `force_rows` is reserved with the columns
        phys_discard_columns(system);
        system->has_forces = false;
    }
    system->options = *options;
    if (options->threads <= 0)
        system->options.threads = os_processor_count();
    if (system->options.threads > PHYS_MAX_THREADS)
        system->options.threads = PHYS_MAX_THREADS;
    if (options->cpu > best)
        system->options.cpu = best;
    if (options->use_fma == CPU_FMA_FASTER || cpu_detected.use_fma == CPU_FMA_NEVER)
        system->options.use_fma = cpu_detected.use_fma;
    system->fused = (FusedChoice){.use = system->options.use_fma};
    system->kernels = levels[system->options.cpu];
    bool needs_pool = !options->pool && system->options.threads > 1;
    system->threads = needs_pool ? phys_threads_new(system->options.threads) : options->pool;
}

void phys_begin(PhysSystem *system, uint32_t dimensions) {
    Buffer rows = system->last_rows;
    system->last_rows = system->rows;
    system->rows = rows;
    system->failed = false;
    system->state = SYSTEM_DESCRIBED;
    system->dimensions = dimensions;
    system->group_count = 0;
    system->particle_count = 0;
    system->record_stride = 0;
    system->force_count = 0;
    system->own_forces = OWN_FORCES_NONE;
    system->any_from_attribute = system->has_forces = false;
    system->vector_doubles = 0;
    phys_add_group(system, 0);
}

// Sets whether the columns may be reordered. Returns false if out of memory.
static bool choose_order(PhysSystem *system) {
    bool by_cell = system->column_order == ORDER_BY_CELL;
    phys_allow_reorder(system, !system->options.division && phys_can_reorder(system));
    // Links contain columns, which have changed if the order was restored.
    return !by_cell || system->column_order == ORDER_BY_CELL || phys_arrange_forces(system);
}

bool phys_prepare(PhysSystem *system) {
    if (system->failed)
        return false;
    if (system->state == SYSTEM_DESCRIBED) {
        if (!phys_arrange(system) || !phys_fill_columns(system))
            return false;
        system->state = SYSTEM_FILLED;
    }
    if (system->state == SYSTEM_FILLED) {
        if (!phys_arrange_forces(system))
            return false;
        system->state = SYSTEM_SORTED;
    }
    if (!choose_order(system))
        return false;
    if (system->state == SYSTEM_SORTED)
        phys_update_radius_powers(system);
    system->state = SYSTEM_READY;
    Force *forces = system->forces.bytes;
    for (uint32_t i = 0; i < system->force_count; i++)
        forces[i].item = 0;
    return true;
}

uint32_t phys_add_group(PhysSystem *system, uint32_t parent) {
    if (!phys_buffer_grow(system, &system->groups, system->group_count, sizeof(Group)))
        return 0;
    uint32_t group = system->group_count++;
    assert(parent < group || !group);
    ((Group *)system->groups.bytes)[group] = (Group){.parent = parent};
    return group;
}

static void copy_vector(double *to, PhysVector from, size_t dimensions) {
    if (from)
        memcpy(to, from, dimensions * sizeof *to);
    else
        memset(to, 0, dimensions * sizeof *to);
}

// Stores a particle's `force` attribute. The buffer is allocated only when the first such attribute is set.
static void set_own_force(PhysSystem *system, uint32_t handle, PhysVector force, double ease) {
    OwnForces kind = ease > 0 ? OWN_FORCES_EASED : force ? OWN_FORCES_CONSTANT : OWN_FORCES_NONE;
    bool first = system->own_forces == OWN_FORCES_NONE;
    size_t n = system->dimensions, retained = first ? 0 : handle;
    if (first && kind == OWN_FORCES_NONE)
        return;
    if (!phys_buffer_reserve(system, &system->own_force_rows, retained * n * sizeof(double), system->particle_count,
                             n * sizeof(double)))
        return;
    double *rows = system->own_force_rows.bytes;
    if (first)
        memset(rows, 0, system->particle_count * n * sizeof *rows);
    copy_vector(rows + n * handle, force, n);
    if (kind <= system->own_forces)
        return;
    system->own_forces = kind;
    return_to(system, SYSTEM_DESCRIBED); // the columns own_force and ease do not exist yet, or were not filled
}

static ParticleRecord record_of(const PhysParticle *particle, uint32_t group, bool anchor) {
    return (ParticleRecord){.ease = particle->ease,
                            .radius = particle->radius,
                            .mass = particle->mass,
                            .charge = particle->charge,
                            .group = group,
                            .anchor = anchor};
}

// Stores the record of a particle. `count` is the number of particles, including this one. As long as the records of
// all particles are equal, only one record is stored. Returns false if out of memory.
static bool set_record(PhysSystem *system, uint32_t handle, uint32_t count, const ParticleRecord *record) {
    bool single = !system->record_stride && count > 1;
    if (single && memcmp(phys_record(system, 0), record, sizeof *record) == 0)
        return true;
    uint64_t retained = (single ? 1 : handle) * sizeof *record;
    if (!phys_buffer_reserve(system, &system->particles, retained, count, sizeof *record))
        return false;
    ParticleRecord *records = system->particles.bytes;
    for (uint32_t i = 1; single && i < count; i++)
        records[i] = records[0];
    system->record_stride = count > 1;
    records[handle] = *record;
    return true;
}

static void set_from_attribute(PhysSystem *system, uint32_t handle, uint8_t which, bool from) {
    uint8_t *marks = (uint8_t *)system->from_attribute.bytes + handle;
    *marks = (uint8_t)(from ? *marks | which : *marks & ~which);
    system->any_from_attribute |= from;
}

void phys_expect_particles(PhysSystem *system, uint64_t more) {
    uint64_t count = system->particle_count, n = system->dimensions, row = ROW_VECTORS * n * sizeof(double);
    if (system->failed || more > (PHYS_MAX_BYTES >> 4) / row)
        return;
    phys_buffer_reserve(system, &system->rows, count * row, count + more, row);
    phys_buffer_reserve(system, &system->from_attribute, count, count + more, 1);
    system->failed = false; // a failed reservation is not an error
}

uint32_t phys_add_particle(PhysSystem *system, uint32_t group, const PhysParticle *particle) {
    uint32_t handle = system->particle_count;
    size_t n = system->dimensions;
    ParticleRecord record = record_of(particle, group, particle->anchor);
    if (!phys_buffer_grow(system, &system->rows, handle, ROW_VECTORS * n * sizeof(double)) ||
        !phys_buffer_grow(system, &system->from_attribute, handle, 1) ||
        !set_record(system, handle, handle + 1, &record))
        return 0;
    assert(group < system->group_count);
    ((uint8_t *)system->from_attribute.bytes)[handle] = 0;
    set_from_attribute(system, handle, PHYS_POSITION, particle->position_from_attribute);
    set_from_attribute(system, handle, PHYS_VELOCITY, particle->velocity_from_attribute);
    double *row = phys_row(system, handle);
    copy_vector(row, particle->position, n);
    copy_vector(row + n, particle->anchor ? NULL : particle->velocity, n);
    system->particle_count++;
    set_own_force(system, handle, particle->anchor ? NULL : particle->force, particle->anchor ? 0 : particle->ease);
    return handle;
}

// Updates the columns, if they exist, with a particle's new attributes.
static void update_columns(PhysSystem *system, uint32_t handle, const ParticleRecord *record, const double *row) {
    if (system->state == SYSTEM_DESCRIBED)
        return;
    phys_note_change(system, COLUMNS_EDITED);
    system->motion_version++;
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, stride = columns->stride, i = system->column_of[handle];
    if (columns->radius[i] != record->radius) {
        return_to(system, SYSTEM_SORTED);
        system->radius_version++;
    }
    columns->radius[i] = record->radius;
    columns->mass[i] = record->mass;
    columns->charge[i] = record->charge;
    for (size_t k = 0; k < n; k++) {
        columns->position[k * stride + i] = row[k];
        columns->velocity[k * stride + i] = row[n + k];
    }
    if (system->own_forces == OWN_FORCES_NONE)
        return;
    columns->ease[i] = record->ease;
    for (size_t k = 0; k < n; k++)
        columns->own_force[k * stride + i] = ((const double *)system->own_force_rows.bytes)[n * handle + k];
}

void phys_update_particle(PhysSystem *system, uint32_t particle, const PhysParticle *numbers, PhysPreserve preserve) {
    size_t n = system->dimensions;
    const ParticleRecord *before = phys_record(system, particle);
    ParticleRecord record = record_of(numbers, before->group, before->anchor);
    if (!set_record(system, particle, system->particle_count, &record))
        return;
    double *row = phys_row(system, particle);
    if (!preserve.position) {
        copy_vector(row, numbers->position, n);
        set_from_attribute(system, particle, PHYS_POSITION, numbers->position_from_attribute);
    }
    if (!preserve.velocity) {
        copy_vector(row + n, record.anchor ? NULL : numbers->velocity, n);
        set_from_attribute(system, particle, PHYS_VELOCITY, numbers->velocity_from_attribute);
    }
    set_own_force(system, particle, record.anchor ? NULL : numbers->force, record.anchor ? 0 : numbers->ease);
    update_columns(system, particle, &record, row);
}

// Copies a vector of a force. Returns the index of the copy plus 1. Returns 0 for all zeros (NULL), or if out of
// memory.
static uint64_t store_vector(PhysSystem *system, PhysVector vector) {
    uint64_t n = system->dimensions, begin = system->vector_doubles;
    if (!vector || !phys_buffer_reserve(system, &system->vectors, begin * sizeof(double), begin + n, sizeof(double)))
        return 0;
    copy_vector((double *)system->vectors.bytes + begin, vector, (size_t)n);
    system->vector_doubles += n;
    return begin + 1;
}

uint32_t phys_add_force(PhysSystem *system, uint32_t group, const PhysForce *force) {
    if (!phys_buffer_grow(system, &system->force_records, system->force_count, sizeof(ForceRecord)))
        return 0;
    assert(group < system->group_count);
    ForceRecord record = {.given = *force, .group = group};
    record.vector = store_vector(system, force->vector);
    record.vector2 = store_vector(system, force->vector2);
    if (system->failed)
        return 0;
    ((ForceRecord *)system->force_records.bytes)[system->force_count] = record;
    return system->force_count++;
}

void phys_begin_forces(PhysSystem *system) {
    system->force_count = 0;
    system->vector_doubles = 0;
    return_to(system, SYSTEM_FILLED);
}

void phys_set_key(PhysSystem *system, uint32_t force, uint64_t key) {
    if (force >= system->force_count)
        return; // `force` comes from a failed call of phys_add_force
    ForceRecord *record = phys_force_record(system, force);
    record->given.key = key;
    if (system->state >= SYSTEM_SORTED)
        ((Force *)system->forces.bytes)[record->arranged].given.key = key;
}

uint32_t phys_particle_group(const PhysSystem *system, uint32_t particle) {
    return phys_record(system, particle)->group;
}

bool phys_is_anchor(const PhysSystem *system, uint32_t particle) {
    return phys_record(system, particle)->anchor;
}

uint32_t phys_group_count(const PhysSystem *system) {
    return system->group_count;
}

uint32_t phys_group_parent(const PhysSystem *system, uint32_t group) {
    return ((const Group *)system->groups.bytes)[group].parent;
}

bool phys_skip_frame(PhysSystem *system) {
    system->has_forces = false;
    return !system->failed;
}

uint32_t phys_particle_count(const PhysSystem *system) {
    return system->particle_count;
}

const double *phys_position(const PhysSystem *system, uint32_t particle) {
    if (particle >= system->particle_count)
        return NULL; // the handle comes from a failed call of phys_add_particle
    return phys_row(system, particle);
}

const double *phys_velocity(const PhysSystem *system, uint32_t particle) {
    const double *position = phys_position(system, particle);
    return position ? position + system->dimensions : NULL;
}

void phys_show_vector(PhysSystem *system, uint32_t particle, bool velocity, const double *vector) {
    double *row = phys_row(system, particle) + (velocity ? system->dimensions : 0);
    memmove(row, vector, system->dimensions * sizeof *row); // the vector can be the row
}

static bool has_mark(const PhysSystem *system, uint32_t particle, uint8_t mark) {
    return system->any_not_finite && (((const uint8_t *)system->not_finite.bytes)[particle] & mark);
}

bool phys_position_finite(const PhysSystem *system, uint32_t particle) {
    return !has_mark(system, particle, PHYS_POSITION);
}

bool phys_velocity_finite(const PhysSystem *system, uint32_t particle) {
    return !has_mark(system, particle, PHYS_VELOCITY);
}

_Static_assert(sizeof(ParticleRecord) % sizeof(double) == 0, "a column of records has a stride in doubles");

PhysColumns phys_columns(const PhysSystem *system) {
    if (!system->particle_count)
        return (PhysColumns){.anchor = NULL};
    const ParticleRecord *records = system->particles.bytes;
    size_t n = system->dimensions, bytes = sizeof *records * system->record_stride, stride = bytes / sizeof(double);
    bool forces = system->has_forces && system->options.keep_forces;
    return (PhysColumns){
        .position = {system->rows.bytes, ROW_VECTORS * n},
        .velocity = {(const double *)system->rows.bytes + n, ROW_VECTORS * n},
        .force = {forces ? system->force_rows.bytes : NULL, n},
        .radius = {&records->radius, stride},
        .mass = {&records->mass, stride},
        .charge = {&records->charge, stride},
        .anchor = &records->anchor,
        .anchor_stride = bytes,
    };
}

uint32_t phys_force_count(const PhysSystem *system) {
    return system->force_count;
}

bool phys_get_force(const PhysSystem *system, uint32_t number, PhysForce *force) {
    if (number >= system->force_count)
        return false;
    const ForceRecord *record = phys_force_record(system, number);
    const double *vectors = system->vectors.bytes;
    *force = record->given;
    force->vector = record->vector ? vectors + record->vector - 1 : NULL;
    force->vector2 = record->vector2 ? vectors + record->vector2 - 1 : NULL;
    return true;
}
