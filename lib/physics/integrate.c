// integrate.c: divides the integration of one group among threads (integrate.h).
#include "physics/integrate.h"

#include "base/spec.h"
#include "physics/threads.h"

#include <assert.h>

// Appends to system->chain all forces of a stage that act on a group: first those of the group itself, then those of
// the enclosing groups. Returns the number of these forces. `already` is the length of the chain before the call.
static uint32_t collect_forces(const PhysSystem *system, uint32_t group, Stage stage, uint32_t already) {
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

static size_t moving_between(const Columns *columns, size_t first, size_t end) {
    size_t count = 0;
    for (size_t i = first; i < end; i++)
        count += !columns->anchor[i];
    return count;
}

void phys_integrate_rows(const Integrator *integrator, size_t first, size_t end) {
    double scratch[3 * PHYS_VECTOR_DIMENSIONS];
    Columns columns = *integrator->pass.columns;
    IntegratePass pass = integrator->pass;
    assert(!integrator->wide || columns.dimensions <= PHYS_VECTOR_DIMENSIONS);
    if (integrator->wide)
        columns.scratch = scratch;
    pass.columns = &columns;
    Draws draws;
    draws.force = NULL;
    pass.draws = &draws;
    pass.end = end;
    if (integrator->random && first > integrator->group->first && !columns.random_offset)
        pass.draw_count = columns.dimensions * moving_between(&columns, integrator->group->first, first);
    integrator->kernel(&pass, first, end);
}

static void integrate_chunk(void *context, int chunk, int chunks) {
    const Integrator *integrator = context;
    size_t lanes = integrator->lanes, blocks = (integrator->group->count + lanes - 1) / lanes;
    size_t start = integrator->group->first, stop = start + integrator->group->count;
    size_t first = start + phys_chunk_begin(blocks, chunk, chunks) * lanes;
    size_t end = start + phys_chunk_begin(blocks, chunk + 1, chunks) * lanes;
    phys_integrate_rows(integrator, first, end < stop ? end : stop);
}

// Returns true if one of the forces uses a random stream.
static bool draws_random(const IntegratePass *pass) {
    for (uint32_t f = 0; f < pass->force_count; f++)
        if (phys_force_row(pass->forces[f]->given.kind).need == NEED_STREAM)
            return true;
    return false;
}

// Advances the random streams by the items that the particles of a group have used.
static void advance_streams(const IntegratePass *pass, const Group *group) {
    const Columns *columns = pass->columns;
    uint64_t movers = columns->random_offset
                          ? group->movers
                          : moving_between(columns, group->first, (size_t)group->first + group->count);
    for (uint32_t f = 0; f < pass->force_count; f++)
        ((Force *)pass->forces[f])->item += movers * columns->dimensions;
}

bool phys_integrate_begin(PhysSystem *system, uint32_t number, double delta, double speed_of_light,
                          Integrator *integrator) {
    enum { MIN_FOR_LANES = 4 }; // with fewer particles, vectors do not pay off
    enum { NUMBERS_A_UNIT = 16, DRAWN_A_UNIT = 2 };
    const Group *group = (const Group *)system->groups.bytes + number;
    const Columns *columns = &system->columns;
    IntegratePass pass = {
        .columns = columns, .delta = delta, .speed_of_light = speed_of_light, .stop = phys_stop(system)};
    uint32_t singles = collect_forces(system, number, STAGE_SINGLE, 0);
    pass.barrier_count = collect_forces(system, number, STAGE_BARRIER, singles);
    pass.force_count = singles + pass.barrier_count;
    pass.forces = system->chain.bytes;
    system->columns.uniform_mass = !system->record_stride;
    system->columns.no_anchors = !system->record_stride && !system->remote && !columns->anchor[0];
    pass.keep_force = system->options.keep_forces;
    pass.old_barriers = system->options.old_rules & SPEC_OLD_BARRIERS;
    *integrator = (Integrator){
        .kernel = integrate_all_one, .lanes = 1, .pass = pass, .group = group, .random = draws_random(&pass)};
    integrator->wide = columns->dimensions <= PHYS_VECTOR_DIMENSIONS && group->count >= MIN_FOR_LANES;
    if (integrator->wide) {
        integrator->kernel = system->kernels->integrate;
        integrator->lanes = system->kernels->lanes;
    }
    uint64_t numbers = (uint64_t)group->count * columns->dimensions * (1 + pass.force_count);
    return phys_charge(system, numbers / (integrator->random ? DRAWN_A_UNIT : NUMBERS_A_UNIT));
}

void phys_integrate_end(const Integrator *integrator) {
    if (integrator->random)
        advance_streams(&integrator->pass, integrator->group);
}

void phys_integrate(PhysSystem *system, uint32_t number, double delta, double speed_of_light) {
    Integrator integrator;
    if (!phys_integrate_begin(system, number, delta, speed_of_light, &integrator))
        return;
    size_t min_count = integrator.random ? PHYS_MIN_FOR_THREADS / 4 : PHYS_MIN_FOR_THREADS;
    phys_parallel(system, integrator.wide ? phys_chunk_count(system, integrator.group->count, min_count) : 1,
                  integrate_chunk, &integrator);
    phys_integrate_end(&integrator);
}
