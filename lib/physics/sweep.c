// sweep.c: see sweep.h. The work on one group, dealt out to threads.
#include "physics/sweep.h"
#include "physics/kernels.h"
#include "physics/threads.h"

enum { FEW = 4 }; // particles that are not worth a vector

// The forces of a stage for a group: own ones, then those of the groups around it. False if there are too many.
static bool collect(const PhysSystem *system, uint32_t group, Stage stage, const Force **list, uint32_t *count) {
    const Group *groups = system->groups.bytes;
    *count = 0;
    for (uint32_t g = groups[group].nearest[stage]; g != NO_GROUP; g = phys_next_above(groups, g, stage)) {
        ForceRange range = phys_forces(system, g, stage);
        for (const Force *force = range.begin; force < range.end; force++) {
            if (*count == PHYS_SWEEP_FORCES)
                return false;
            list[(*count)++] = force;
        }
    }
    return true;
}

void phys_sweep_bounce(const SweepPass *pass, size_t i, const double *before) {
    const Columns *columns = pass->columns;
    double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < columns->dimensions; k++)
        acceleration[k] = (columns->velocity[k * columns->stride + i] - before[k]) / pass->delta;
    for (uint32_t b = 0; b < pass->barrier_count; b++)
        phys_bounce(columns, i, pass->barriers[b], pass->delta, pass->speed_of_light);
}

typedef struct Share {
    const Kernels *kernels;
    const SweepPass *pass;
    const Group *group;
    bool random; // one of the forces is
} Share;

static size_t moving_between(const Columns *columns, size_t first, size_t end) {
    size_t count = 0;
    for (size_t i = first; i < end; i++)
        count += !columns->anchor[i];
    return count;
}

static void sweep_share(void *context, int worker, int workers) {
    const Share *share = context;
    double scratch[3 * PHYS_VECTOR_DIMENSIONS];
    Columns columns = *share->pass->columns;
    SweepPass pass = *share->pass;
    columns.scratch = scratch;
    pass.columns = &columns;
    size_t lanes = share->kernels->lanes, blocks = (share->group->count + lanes - 1) / lanes;
    size_t start = share->group->first, stop = start + share->group->count;
    size_t first = start + phys_share(blocks, worker, workers) * lanes;
    size_t end = start + phys_share(blocks, worker + 1, workers) * lanes;
    if (share->random && first > start) {
        uint64_t before = columns.dimensions * moving_between(&columns, start, first);
        for (uint32_t f = 0; f < pass.single_count; f++)
            pass.items[f] += before;
    }
    share->kernels->sweep(&pass, first, end < stop ? end : stop);
}

bool phys_sweep(PhysSystem *system, uint32_t number, double delta, double speed_of_light) {
    const Kernels *kernels = phys_kernels(system);
    const Group *group = (const Group *)system->groups.bytes + number;
    Columns *columns = &system->columns;
    SweepPass pass = {.columns = columns, .delta = delta, .speed_of_light = speed_of_light};
    if (!kernels->sweep || columns->dimensions > PHYS_VECTOR_DIMENSIONS || group->count < FEW ||
        !collect(system, number, STAGE_SINGLE, pass.singles, &pass.single_count) ||
        !collect(system, number, STAGE_BARRIER, pass.barriers, &pass.barrier_count))
        return false;
    pass.keep_force = pass.barrier_count > 0 || system->options.keep_forces;
    Share share = {.kernels = kernels, .pass = &pass, .group = group};
    for (uint32_t f = 0; f < pass.single_count; f++) {
        pass.items[f] = pass.singles[f]->item;
        share.random |= pass.singles[f]->given.kind == PHYS_RANDOM;
    }
    uint32_t few = share.random ? PHYS_FEW_PARTICLES / 4 : PHYS_FEW_PARTICLES;
    phys_parallel(system, phys_shares(system, group->count, few), sweep_share, &share);
    if (share.random) {
        uint64_t taken =
            columns->dimensions * moving_between(columns, group->first, (size_t)group->first + group->count);
        for (uint32_t f = 0; f < pass.single_count; f++)
            ((Force *)pass.singles[f])->item += taken;
    }
    return true;
}
