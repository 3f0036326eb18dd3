// step.c: one step as the ordered list of stages of section 4.
#include "physics/sweep.h"
#include "physics/threads.h"

#include <string.h>

// Strength of every force applier and barrier: `strength`, times (clock / ease) while ease > 0 and clock < ease.
static void ease_strengths(const PhysSystem *system, double clock) {
    Force *forces = system->forces.bytes;
    for (uint32_t i = 0; i < system->force_count; i++)
        forces[i].strength = forces[i].given.strength * phys_ramp(forces[i].given.ease, clock);
}

// The force on a particle at the start of the step is its own, eased in likewise. (A factor of 1 changes no bit.)
typedef struct Start {
    const PhysSystem *system;
    double clock;
} Start;

static void start_share(void *context, int share, int shares) {
    const Start *start = context;
    const PhysSystem *system = start->system;
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, stride = columns->stride;
    size_t first = phys_share(columns->count, share, shares);
    size_t count = phys_share(columns->count, share + 1, shares) - first;
    for (size_t k = 0; k < n; k++) {
        double *force = columns->force + k * stride + first;
        const double *thrust = columns->thrust + k * stride + first;
        if (!system->pushed)
            memset(force, 0, count * sizeof *force);
        else if (!system->eased)
            memcpy(force, thrust, count * sizeof *force);
        else
            for (size_t i = 0; i < count; i++)
                force[i] = thrust[i] * phys_ramp(columns->ease[first + i], start->clock);
    }
}

static void start_forces(const PhysSystem *system, double clock) {
    enum { FEW = 50000 }; // that are set before a second thread is ready
    Start start = {system, clock};
    if (system->columns.count)
        phys_parallel(system, phys_shares(system, system->columns.count, FEW), start_share, &start);
}

// Single-particle forces, then barrier constraint forces: those of the group itself first, then its parent's, …
// Each acts on all particles of the group in turn; a particle still receives them in this order.
static void apply_singles_and_barriers(const PhysSystem *system, uint32_t number, double delta) {
    const Group *groups = system->groups.bytes, *group = &groups[number];
    const Columns *columns = &system->columns;
    for (uint32_t g = group->nearest[STAGE_SINGLE]; g != NO_GROUP; g = phys_next_above(groups, g, STAGE_SINGLE))
        phys_apply_singles(columns, group, phys_forces(system, g, STAGE_SINGLE), delta);
    for (uint32_t g = group->nearest[STAGE_BARRIER]; g != NO_GROUP; g = phys_next_above(groups, g, STAGE_BARRIER))
        phys_apply_barriers(columns, group, phys_forces(system, g, STAGE_BARRIER));
}

// Motion of one particle, then bounces in the order of the constraint forces.
static void move_particle(const PhysSystem *system, const Group *group, size_t i, double delta, double speed_of_light) {
    const Group *groups = system->groups.bytes;
    phys_move(&system->columns, i, delta, speed_of_light);
    for (uint32_t g = group->nearest[STAGE_BARRIER]; g != NO_GROUP; g = phys_next_above(groups, g, STAGE_BARRIER)) {
        ForceRange barriers = phys_forces(system, g, STAGE_BARRIER);
        for (const Force *barrier = barriers.begin; barrier < barriers.end; barrier++)
            phys_bounce(&system->columns, i, barrier, delta, speed_of_light);
    }
}

void phys_step(PhysSystem *system, double clock, double delta, double speed_of_light) {
    const Group *groups = system->groups.bytes;
    const Columns *columns = &system->columns;
    ease_strengths(system, clock);
    start_forces(system, clock);
    // 1. Forces between particles, all of them before anything moves.
    for (uint32_t g = 0; g < system->group_count; g++) {
        phys_apply_links(columns, phys_forces(system, g, STAGE_LINK));
        if (groups[g].count)
            phys_apply_pairs(system, &groups[g]);
    }
    // 2. What happens to each particle alone.
    for (uint32_t g = 0; g < system->group_count; g++) {
        if (!groups[g].count || phys_sweep(system, g, delta, speed_of_light))
            continue;
        apply_singles_and_barriers(system, g, delta);
        for (size_t i = groups[g].first, end = i + groups[g].count; i < end; i++)
            if (!columns->anchor[i])
                move_particle(system, &groups[g], i, delta, speed_of_light);
    }
}
