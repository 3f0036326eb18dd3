// step.c: one step, in the order of spec physics.md section 4.
#include "physics/far_force.h"
#include "physics/integrate.h"
#include "physics/threads.h"

#include <string.h>

// Sets Force.strength of every force applier and barrier: the given strength, multiplied by clock / ease if ease > 0
// and clock < ease.
static void ease_strengths(const PhysSystem *system, double clock) {
    Force *forces = system->forces.bytes;
    for (uint32_t i = 0; i < system->force_count; i++)
        forces[i].strength = forces[i].given.strength * phys_ramp(forces[i].given.ease, clock);
}

void phys_begin_part(PhysSystem *system, uint64_t part) {
    Force *forces = system->forces.bytes;
    for (uint32_t i = 0; i < system->force_count; i++) {
        if (part == 0)
            forces[i].start = forces[i].item;
        forces[i].item = forces[i].start;
    }
}

// Context of start_chunk, which sets the initial force on each particle in a step. This is the `force` attribute of the
// particle, multiplied by clock / ease while the attribute is eased in. Without easing, the factor is 1, which changes
// no bit.
typedef struct StartForces {
    const PhysSystem *system;
    double clock;
} StartForces;

static void start_chunk(void *context, int chunk, int chunks) {
    const StartForces *start = context;
    const PhysSystem *system = start->system;
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, stride = columns->stride;
    size_t first = phys_chunk_begin(columns->count, chunk, chunks);
    size_t count = phys_chunk_begin(columns->count, chunk + 1, chunks) - first;
    for (size_t k = 0; k < n; k++) {
        double *force = columns->force + k * stride + first;
        if (system->own_forces == OWN_FORCES_NONE) { // the column own_force does not exist
            memset(force, 0, count * sizeof *force);
            continue;
        }
        const double *own_force = columns->own_force + k * stride + first;
        if (system->own_forces == OWN_FORCES_CONSTANT)
            memcpy(force, own_force, count * sizeof *force);
        else
            for (size_t i = 0; i < count; i++)
                force[i] = own_force[i] * phys_ramp(columns->ease[first + i], start->clock);
    }
}

static void start_forces(PhysSystem *system, double clock) {
    enum { MIN_FOR_THREADS = 50000 }; // with fewer particles, one thread is used
    StartForces start = {system, clock};
    bool ready = system->columns.forces_clear && system->own_forces == OWN_FORCES_NONE;
    system->columns.forces_clear = false;
    if (system->columns.count && !ready)
        phys_parallel(system, phys_chunk_count(system, system->columns.count, MIN_FOR_THREADS), start_chunk, &start);
}

// Adds the forces of the host (PhysOptions.add_forces) to the initial forces. Sets system->failed if out of memory.
static void add_host_forces(PhysSystem *system, double clock, double delta) {
    enum { VECTORS = 3 }; // position, velocity, force
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, stride = columns->stride, length = n * system->particle_count;
    if (!phys_buffer_reserve(system, &system->host_vectors, 0, system->particle_count, VECTORS * n * sizeof(double)))
        return;
    double *position = system->host_vectors.bytes, *velocity = position + length, *force = velocity + length;
    for (size_t i = 0; i < columns->count; i++)
        for (size_t k = 0, to = n * system->order[i]; k < n; k++, to++) {
            position[to] = columns->position[k * stride + i];
            velocity[to] = columns->velocity[k * stride + i];
            force[to] = 0;
        }
    const PhysStepStart step = {system->dimensions, system->particle_count, clock, delta, position, velocity, force};
    if (!system->options.add_forces(system->options.add_context, system, &step))
        system->failed = true;
    for (size_t i = 0; i < columns->count; i++)
        for (size_t k = 0, from = n * system->order[i]; k < n && !columns->anchor[i]; k++, from++)
            columns->force[k * stride + i] += force[from];
}

void phys_start_step(PhysSystem *system, double clock, double delta) {
    ease_strengths(system, clock);
    phys_far_forget(system);
    start_forces(system, clock);
    if (system->options.add_forces && system->columns.count)
        add_host_forces(system, clock, delta);
}

bool phys_step(PhysSystem *system, double clock, double delta, double speed_of_light) {
    const Group *groups = system->groups.bytes;
    const Columns *columns = &system->columns;
    enum { STEP_WORK = 8, GROUP_WORK = 2, NUMBERS_A_UNIT = 32 };
    uint64_t work = STEP_WORK + (uint64_t)GROUP_WORK * system->group_count;
    work += columns->count * columns->dimensions / NUMBERS_A_UNIT + system->force_count;
    if (!phys_charge(system, work))
        return false;
    phys_start_step(system, clock, delta);
    phys_fused_next_step(&system->fused);
    // 1. Forces between particles. A particle moves only when all forces that need its position are complete.
    Move move = {delta, speed_of_light, false};
    for (uint32_t g = 0; g < system->group_count; g++) {
        phys_apply_links(columns, phys_forces(system, g, STAGE_LINK));
        if (groups[g].count)
            phys_apply_pairs(system, g, system->group_count == 1 ? &move : NULL);
    }
    // Before the step can be aborted, because a pass may have moved particles.
    system->motion_version++;
    if (!phys_may_continue(system) || system->failed)
        return false;
    // 2. Single-particle forces, motion and barriers.
    for (uint32_t g = 0; g < system->group_count && !move.done; g++)
        if (groups[g].count)
            phys_integrate(system, g, delta, speed_of_light);
    bool completed = phys_may_continue(system);
    system->columns.forces_clear = completed && !system->options.keep_forces;
    return completed;
}
