// sweep.c: see sweep.h. The work on one group, dealt out to threads.
#include "physics/sweep.h"
#include "physics/threads.h"

// The forces of a stage for a group, behind those that are in the chain already: own ones, then those of the groups
// around it. Returns how many there are.
static uint32_t collect(const PhysSystem *system, uint32_t group, Stage stage, uint32_t already) {
    const Group *groups = system->groups.bytes;
    const Force **chain = system->chain.bytes;
    uint32_t count = 0;
    for (uint32_t g = groups[group].nearest[stage]; g != NO_GROUP; g = phys_next_above(groups, g, stage)) {
        ForceRange range = phys_forces(system, g, stage);
        for (const Force *force = range.begin; force < range.end; force++)
            chain[already + count++] = force;
    }
    return count;
}

void phys_sweep_bounce(const SweepPass *pass, size_t i, const double *before) {
    const Columns *columns = pass->columns;
    double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < columns->dimensions; k++)
        acceleration[k] = (columns->velocity[k * columns->stride + i] - before[k]) / pass->delta;
    for (uint32_t b = 0; b < pass->barrier_count; b++)
        phys_bounce(columns, i, phys_barriers(pass)[b], pass->delta, pass->speed_of_light);
}

static size_t moving_between(const Columns *columns, size_t first, size_t end) {
    size_t count = 0;
    for (size_t i = first; i < end; i++)
        count += !columns->anchor[i];
    return count;
}

void phys_sweep_rows(const Sweep *sweep, size_t first, size_t end) {
    double scratch[3 * PHYS_VECTOR_DIMENSIONS];
    Columns columns = *sweep->pass.columns;
    SweepPass pass = sweep->pass;
    if (sweep->wide)
        columns.scratch = scratch;
    pass.columns = &columns;
    if (sweep->random && first > sweep->group->first && !columns.draws)
        pass.taken = columns.dimensions * moving_between(&columns, sweep->group->first, first);
    sweep->kernel(&pass, first, end);
}

static void sweep_share(void *context, int share, int shares) {
    const Sweep *sweep = context;
    size_t lanes = sweep->lanes, blocks = (sweep->group->count + lanes - 1) / lanes;
    size_t start = sweep->group->first, stop = start + sweep->group->count;
    size_t first = start + phys_share(blocks, share, shares) * lanes;
    size_t end = start + phys_share(blocks, share + 1, shares) * lanes;
    phys_sweep_rows(sweep, first, end < stop ? end : stop);
}

// Does one of the forces draw from a stream?
static bool draws(const SweepPass *pass) {
    for (uint32_t f = 0; f < pass->force_count; f++)
        if (phys_force_row(pass->forces[f]->given.kind).need == NEED_STREAM)
            return true;
    return false;
}

// The streams go on behind what the particles of a group have taken.
static void advance_streams(const SweepPass *pass, const Group *group) {
    const Columns *columns = pass->columns;
    uint64_t movers =
        columns->draws ? group->movers : moving_between(columns, group->first, (size_t)group->first + group->count);
    for (uint32_t f = 0; f < pass->force_count; f++)
        ((Force *)pass->forces[f])->item += movers * columns->dimensions;
}

bool phys_sweep_begin(PhysSystem *system, uint32_t number, double delta, double speed_of_light, Sweep *sweep) {
    enum { MIN_FOR_LANES = 4 }; // particles; fewer are not worth a vector
    enum { NUMBERS_A_UNIT = 16, DRAWN_A_UNIT = 2 };
    const Group *group = (const Group *)system->groups.bytes + number;
    const Columns *columns = &system->columns;
    SweepPass pass = {.columns = columns, .delta = delta, .speed_of_light = speed_of_light, .stop = phys_stop(system)};
    uint32_t singles = collect(system, number, STAGE_SINGLE, 0);
    pass.barrier_count = collect(system, number, STAGE_BARRIER, singles);
    pass.force_count = singles + pass.barrier_count;
    pass.forces = system->chain.bytes;
    system->columns.alike = !system->record_stride;
    system->columns.all_move = !system->record_stride && !system->foreign && !columns->anchor[0];
    pass.keep_force = system->options.keep_forces;
    *sweep = (Sweep){.kernel = sweep_all_one, .lanes = 1, .pass = pass, .group = group, .random = draws(&pass)};
    sweep->wide = columns->dimensions <= PHYS_VECTOR_DIMENSIONS && group->count >= MIN_FOR_LANES;
    if (sweep->wide) {
        sweep->kernel = phys_kernels(system)->sweep;
        sweep->lanes = phys_kernels(system)->lanes;
    }
    uint64_t numbers = (uint64_t)group->count * columns->dimensions * (1 + pass.force_count);
    return phys_charge(system, numbers / (sweep->random ? DRAWN_A_UNIT : NUMBERS_A_UNIT));
}

void phys_sweep_end(const Sweep *sweep) {
    if (sweep->random)
        advance_streams(&sweep->pass, sweep->group);
}

void phys_sweep(PhysSystem *system, uint32_t number, double delta, double speed_of_light) {
    Sweep sweep;
    if (!phys_sweep_begin(system, number, delta, speed_of_light, &sweep))
        return;
    size_t least = sweep.random ? PHYS_MIN_FOR_THREADS / 4 : PHYS_MIN_FOR_THREADS;
    phys_parallel(system, sweep.wide ? phys_shares(system, sweep.group->count, least) : 1, sweep_share, &sweep);
    phys_sweep_end(&sweep);
}
