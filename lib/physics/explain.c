// explain.c: evaluates the forces on one particle one after the other (explain.h).
//
// The formulas are those of steps with one lane. Each is evaluated for a sum of -0.0, the neutral element of addition:
// -0.0 + f and -0.0 - -f are f for all f. So the sum is the contribution, and it stays -0.0 if the force does not
// apply.
#define LANES 1
#include "physics/explain.h"

#include "physics/far_force.h"
#include "physics/integrate.h"
#include "physics/pair_wavefront.h"
#include "physics/single_formulas.h"

#include <string.h>

// Memory of the results.
typedef struct ExplanationMemory {
    Buffer forces;
    Buffer partners;
    Buffer vectors;
    Buffer motion; // sum, position and velocity
} ExplanationMemory;

// An explanation in progress.
typedef struct Probe {
    PhysSystem *system; // the copy
    ExplanationMemory *memory;
    PhysExplanation *result;
    size_t target;  // column of the particle
    uint32_t group; // group of the particle
} Probe;

uint64_t phys_explained_steps(const PhysSystem *system) {
    return system->options.keep_forces && system->has_forces ? system->last_steps : 0;
}

// --- copying the system

static void copy_particles(const PhysSystem *system, const double *rows, PhysSystem *copy) {
    size_t n = system->dimensions;
    const double *own = system->own_force_rows.bytes;
    bool has_own = system->own_forces != OWN_FORCES_NONE;
    phys_expect_particles(copy, system->particle_count);
    for (uint32_t i = 0; i < system->particle_count && !copy->failed; i++) {
        const ParticleRecord *record = phys_record(system, i);
        phys_add_particle(copy, record->group,
                          &(PhysParticle){.position = rows + 2 * n * i,
                                          .velocity = rows + 2 * n * i + n,
                                          .force = has_own ? own + n * i : NULL,
                                          .ease = record->ease,
                                          .radius = record->radius,
                                          .mass = record->mass,
                                          .charge = record->charge,
                                          .anchor = record->anchor});
    }
}

static void copy_forces(const PhysSystem *system, PhysSystem *copy) {
    PhysForce force;
    for (uint32_t i = 0; phys_get_force(system, i, &force) && !copy->failed; i++)
        phys_add_force(copy, phys_force_record(system, i)->group, &force);
}

// Returns a copy of the system with the positions and velocities in `rows`, or NULL if out of memory.
static PhysSystem *copy_system(const PhysSystem *system, const double *rows) {
    PhysSystem *copy = phys_new();
    if (!copy)
        return NULL;
    PhysOptions options = system->options;
    options.keep_forces = false;
    options.division = NULL;
    options.pool = system->threads;
    options.threads = system->threads ? system->options.threads : 1;
    phys_set_options(copy, &options);
    // The host does not read the memory of the copy, so that it must not be retired.
    copy->particles.shown = copy->rows.shown = copy->last_rows.shown = copy->force_rows.shown = false;
    phys_begin(copy, system->dimensions);
    for (uint32_t g = 1; g < system->group_count; g++)
        phys_add_group(copy, phys_group_parent(system, g));
    copy_particles(system, rows, copy);
    copy_forces(system, copy);
    return copy;
}

// --- recording contributions

// Sets the sum of forces on the particle to the neutral element.
static void clear_sum(const Probe *probe) {
    const Columns *columns = &probe->system->columns;
    for (size_t k = 0; k < columns->dimensions; k++)
        columns->force[k * columns->stride + probe->target] = -0.0;
}

// Adds the contribution that the columns hold. Leaves out a contribution that cannot change the sum.
static void record(Probe *probe, uint32_t force, uint32_t partner) {
    PhysExplanation *result = probe->result;
    PhysSystem *system = probe->system;
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions, count = result->count;
    const double *sum = columns->force + probe->target;
    bool neutral = force != PHYS_OWN_FORCE; // an own force replaces the sum
    for (size_t k = 0; k < n; k++)
        neutral &= sum[k * columns->stride] == 0 && signbit(sum[k * columns->stride]);
    if (neutral || !phys_buffer_grow(system, &probe->memory->forces, count, sizeof(uint32_t)) ||
        !phys_buffer_grow(system, &probe->memory->partners, count, sizeof(uint32_t)) ||
        !phys_buffer_grow(system, &probe->memory->vectors, count, n * sizeof(double)))
        return;
    ((uint32_t *)probe->memory->forces.bytes)[count] = force;
    ((uint32_t *)probe->memory->partners.bytes)[count] = partner;
    double *vector = (double *)probe->memory->vectors.bytes + count * n, *total = probe->memory->motion.bytes;
    for (size_t k = 0; k < n; k++) {
        vector[k] = sum[k * columns->stride];
        total[k] = force == PHYS_OWN_FORCE ? vector[k] : total[k] + vector[k];
    }
    result->count++;
}

// --- the forces of a step

// The sum of forces starts with the `force` attribute of the particle. Without such an attribute, it starts with 0.
static void explain_own_force(Probe *probe) {
    const Columns *columns = &probe->system->columns;
    for (size_t k = 0; k < columns->dimensions; k++) {
        double own = columns->force[k * columns->stride + probe->target];
        if (own != 0 || signbit(own)) {
            record(probe, PHYS_OWN_FORCE, PHYS_NO_PARTNER);
            return;
        }
    }
}

static void explain_links(Probe *probe, ForceRange forces) {
    const PhysSystem *system = probe->system;
    for (Force *force = forces.begin; force < forces.end; force++) {
        uint32_t from = force->given.from, to = force->given.to;
        if (from == to || (from != probe->target && to != probe->target))
            continue;
        clear_sum(probe);
        phys_apply_links(&system->columns, (ForceRange){force, force + 1});
        record(probe, force->number, system->order[from == probe->target ? to : from]);
    }
}

// The pair forces of one pass.
typedef struct PassForces {
    ForceRange forces;
    bool divided;   // forces with `theta` are left out
    PairPass pairs; // argument of phys_pair_row
} PassForces;

// Records the forces that the particles of one group exert on the particle.
static bool explain_partners(Probe *probe, PassForces *pass, const Group *partners) {
    enum { PARTNER_WORK = 4 }; // work units of one pair and force
    PhysSystem *system = probe->system;
    uint64_t terms = (uint64_t)(pass->forces.end - pass->forces.begin);
    if (!phys_charge(system, PARTNER_WORK * terms * partners->count))
        return false;
    for (size_t j = partners->first; j < (size_t)partners->first + partners->count && !system->failed; j++)
        for (size_t t = 0; t < terms && j != probe->target; t++) {
            if (pass->divided && phys_is_far(system, &pass->forces.begin[t]))
                continue;
            pass->pairs.terms = (const PairTerm *)system->terms.bytes + t;
            clear_sum(probe);
            phys_pair_row(&pass->pairs, probe->target, j, j + 1);
            record(probe, pass->forces.begin[t].number, system->order[j]);
        }
    return !system->failed;
}

// Prepares to record the forces in a range. `divided`: leaves out forces with `theta`.
static PassForces pass_forces(const Probe *probe, ForceRange forces, bool divided) {
    PassForces pass = {forces, divided, phys_columns_pass(&probe->system->columns)};
    phys_fill_terms(probe->system->terms.bytes, forces);
    pass.pairs.term_count = 1;
    return pass;
}

// Records the forces of `pass` between `group` and `other`, if the particle is in one of them.
static bool explain_groups(Probe *probe, PassForces *pass, uint32_t group, uint32_t other) {
    const Group *groups = probe->system->groups.bytes;
    bool target_above = other == probe->group;
    return phys_charge(probe->system, 1) && ((group != probe->group && !target_above) ||
                                             explain_partners(probe, pass, &groups[target_above ? group : other]));
}

// Records one force with `theta` of a divided pass, between `group` and itself or an enclosing group. All that a group
// exerts on the particle is one contribution.
static bool explain_far_force(Probe *probe, Force *force, uint32_t group, uint32_t other) {
    PhysSystem *system = probe->system;
    bool pays;
    if (group != probe->group && other != probe->group)
        return phys_charge(system, 1);
    if (!phys_far_pays(system, force, group, other, &pays))
        return false;
    if (!pays) {
        PassForces pass = pass_forces(probe, (ForceRange){force, force + 1}, false);
        return explain_groups(probe, &pass, group, other);
    }
    clear_sum(probe);
    if (!phys_far_force_on(system, force, (uint32_t)probe->target, probe->group, group == probe->group ? other : group))
        return false;
    record(probe, force->number, PHYS_NO_PARTNER);
    return !system->failed;
}

// Records the forces of a pass (phys_next_enclosing).
static bool explain_pass(Probe *probe, uint32_t group, uint32_t level) {
    PhysSystem *system = probe->system;
    const Group *groups = system->groups.bytes;
    ForceRange forces = phys_forces(system, level, STAGE_PAIR);
    PassForces pass = pass_forces(probe, forces, phys_far_divides(system, &groups[group], forces));
    for (uint32_t g = group; g != NO_GROUP; g = phys_next_enclosing(groups, g, level))
        if (!explain_groups(probe, &pass, group, g))
            return false;
    for (Force *force = forces.begin; force < forces.end && pass.divided; force++)
        for (uint32_t g = group; g != NO_GROUP && phys_is_far(system, force); g = phys_next_enclosing(groups, g, level))
            if (!explain_far_force(probe, force, group, g))
                return false;
    return true;
}

// Records links and pair forces (step 1 of the specification).
static bool explain_pairs(Probe *probe) {
    PhysSystem *system = probe->system;
    const Group *groups = system->groups.bytes;
    if (!phys_charge(system, system->group_count + system->force_count))
        return false;
    for (uint32_t g = 0; g < system->group_count; g++) {
        explain_links(probe, phys_forces(system, g, STAGE_LINK));
        for (uint32_t level = groups[g].count ? groups[g].nearest[STAGE_PAIR] : NO_GROUP; level != NO_GROUP;
             level = phys_next_above(groups, level, STAGE_PAIR))
            if (!explain_pass(probe, g, level))
                return false;
    }
    return true;
}

// Records single-particle forces and soft barriers (step 2 of the specification). The groups before that of the
// particle only advance the random streams.
static bool explain_singles(Probe *probe, double delta) {
    PhysSystem *system = probe->system;
    const Group *groups = system->groups.bytes;
    const Columns *columns = &system->columns;
    Integrator integrator = {.kernel = NULL};
    for (uint32_t g = 0; g <= probe->group; g++) {
        if (g > 0 && groups[g - 1].count)
            phys_integrate_end(&integrator);
        if (groups[g].count && !phys_integrate_begin(system, g, delta, system->last_time.speed_of_light, &integrator))
            return false;
    }
    const IntegratePass *pass = &integrator.pass;
    for (size_t i = groups[probe->group].first; i < probe->target; i++)
        integrator.pass.draw_count += columns->anchor[i] ? 0 : columns->dimensions;
    Block block = block_at(columns, probe->target);
    for (uint32_t f = 0; f < pass->force_count; f++) {
        clear_sum(probe);
        single_apply(&(Singles){pass, columns, pass->forces[f], columns->dimensions, &block});
        record(probe, pass->forces[f]->number, PHYS_NO_PARTNER);
    }
    return true;
}

// --- the frame

// Reserves memory for the results. Returns false if out of memory.
static bool reserve_results(Probe *probe, size_t n) {
    enum { MOTION_VECTORS = 3 };
    probe->memory = arena_try_alloc(&probe->system->home, sizeof *probe->memory);
    if (!probe->memory)
        return false;
    memset(probe->memory, 0, sizeof *probe->memory);
    probe->result->memory = probe->memory;
    if (!phys_buffer_reserve(probe->system, &probe->memory->motion, 0, MOTION_VECTORS * n, sizeof(double)))
        return false;
    double *motion = probe->memory->motion.bytes;
    memset(motion, 0, MOTION_VECTORS * n * sizeof *motion);
    probe->result->sum = motion;
    probe->result->position = motion + n;
    probe->result->velocity = motion + 2 * n;
    return true;
}

// Takes the steps before the requested one. Returns the status and sets `clock` and `delta` of the result.
static bool take_steps(const Probe *probe, const PhysTime *time, uint64_t steps) {
    PhysExplanation *result = probe->result;
    double last = time->last;
    result->clock = time->clock;
    for (uint64_t s = 0;; s++) {
        uint64_t part = s % phys_parts(time);
        result->delta = part > 0 ? result->delta : phys_step_length(time, last);
        if (phys_parts(time) > 1)
            phys_begin_part(probe->system, part);
        if (s == steps)
            return true;
        if (!phys_step(probe->system, result->clock, result->delta, time->speed_of_light))
            return false;
        result->clock += result->delta;
        last += result->delta;
    }
}

// Explains the step that starts in the current state of the columns.
static bool explain_step(Probe *probe, uint32_t particle) {
    PhysSystem *system = probe->system;
    const Columns *columns = &system->columns;
    size_t n = columns->dimensions;
    double *motion = probe->memory->motion.bytes;
    // Columns are reordered only in systems without links and random forces, whose sorted forces contain no columns.
    if (system->column_order == ORDER_BY_CELL)
        phys_restore_order(system);
    probe->target = system->column_of[particle];
    probe->group = phys_particle_group(system, particle);
    for (size_t k = 0; k < n; k++) {
        motion[n + k] = columns->position[k * columns->stride + probe->target];
        motion[2 * n + k] = columns->velocity[k * columns->stride + probe->target];
    }
    if (columns->anchor[probe->target])
        return true;
    phys_start_step(system, probe->result->clock, probe->result->delta);
    explain_own_force(probe);
    return explain_pairs(probe) && explain_singles(probe, probe->result->delta);
}

static PhysStatus explain(Probe *probe, const PhysTime *time, uint32_t particle, uint64_t step) {
    enum { NUMBERS_A_UNIT = 4 };
    PhysSystem *system = probe->system;
    uint64_t numbers = (uint64_t)system->particle_count * system->dimensions;
    // An interrupt stops the formulas before the next charge notices it, so it is checked again at the end.
    bool completed = phys_charge(system, numbers / NUMBERS_A_UNIT) && take_steps(probe, time, step) &&
                     explain_step(probe, particle) && phys_may_continue(system);
    return completed && !system->failed ? PHYS_OK : system->failed ? PHYS_NO_MEMORY : PHYS_STOPPED;
}

static PhysStatus explain_from(const PhysSystem *system, const double *rows, const PhysTime *time, uint32_t particle,
                               uint64_t step, PhysExplanation *result) {
    *result = (PhysExplanation){.copy = copy_system(system, rows)};
    Probe probe = {.system = result->copy, .result = result};
    if (!result->copy || !phys_prepare(result->copy) || !reserve_results(&probe, system->dimensions))
        return PHYS_NO_MEMORY;
    result->copy->last_time = *time;
    PhysStatus status = explain(&probe, time, particle, step);
    result->forces = probe.memory->forces.bytes;
    result->partners = probe.memory->partners.bytes;
    result->vectors = probe.memory->vectors.bytes;
    return status;
}

PhysStatus phys_explain(const PhysSystem *system, uint32_t particle, uint64_t step, PhysExplanation *result) {
    return explain_from(system, system->start_rows.bytes, &system->last_time, particle, step, result);
}

PhysStatus phys_explain_rows(const PhysSystem *system, uint32_t particle, double clock, double delta,
                             PhysExplanation *result) {
    const PhysTime time = {.now = delta,
                           .clock = clock,
                           .resolution = delta,
                           .lockstep = true,
                           .speed_of_light = system->last_time.speed_of_light};
    return explain_from(system, system->rows.bytes, &time, particle, 0, result);
}

void phys_explanation_free(PhysExplanation *explanation) {
    if (explanation->memory) {
        phys_buffer_free(&explanation->memory->forces);
        phys_buffer_free(&explanation->memory->partners);
        phys_buffer_free(&explanation->memory->vectors);
        phys_buffer_free(&explanation->memory->motion);
    }
    phys_free(explanation->copy);
    *explanation = (PhysExplanation){.copy = NULL};
}
