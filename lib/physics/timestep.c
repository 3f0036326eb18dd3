// timestep.c: the loop over the steps of a frame (spec physics.md section 4).
//
//   remaining = t − last
//   repeat
//       delta = min(resolution, remaining)
//       one step of delta at clock, or PhysTime.parts steps of delta / parts
//       clock = clock + delta
//       last = last + delta;  remaining = t − last
//       more = remaining > 1e-9 * resolution
//   until not (more and (lockstep or this is the frame's first step and performance > 1.5))
#include "maths/random.h"
#include "physics/divergence.h"
#include "physics/division.h"

#include <math.h>

static bool run_step(PhysSystem *system, double clock, double delta, double speed_of_light) {
    const PhysDivision *division = system->options.division;
    return (division ? division->step : phys_step)(system, clock, delta, speed_of_light);
}

// Writes the results to the rows. Returns false if the frame was aborted.
static bool end_frame(PhysSystem *system, bool keep_last_finite) {
    if (system->options.division)
        return system->options.division->end_frame(system, keep_last_finite);
    phys_write_rows(system, keep_last_finite);
    return true;
}

static PhysResult abort_frame(PhysSystem *system, const PhysTime *time) {
    phys_discard_columns(system);
    return (PhysResult){.status = system->failed ? PHYS_NO_MEMORY : PHYS_STOPPED, .clock = time->clock};
}

// Returns the size of a system: the longest side of the box around its particles; if they are all at one point, its
// largest coordinate, else 1.
static double system_size(const Columns *columns) {
    double size = 0, coordinate = 0;
    for (size_t k = 0; k < columns->dimensions; k++) {
        const double *position = columns->position + k * columns->stride;
        double low = INFINITY, high = -INFINITY;
        for (uint32_t i = 0; i < columns->count; i++) {
            low = fmin(low, position[i]);
            high = fmax(high, position[i]);
        }
        size = fmax(size, high - low);
        coordinate = fmax(coordinate, fmax(fabs(low), fabs(high)));
    }
    size = size > 0 ? size : coordinate;
    return size > 0 && isfinite(size) ? size : 1;
}

// Moves all particles but anchors by PhysTime.shift in each direction, forwards or backwards.
static void shift_particles(PhysSystem *system, const PhysTime *time) {
    const Columns *columns = &system->columns;
    double distance = time->shift * system_size(columns);
    uint64_t item = 0;
    for (size_t k = 0; k < columns->dimensions; k++)
        for (uint32_t i = 0; i < columns->count; i++, item++)
            if (!columns->anchor[i])
                columns->position[k * columns->stride + i] +=
                    random_uniform(time->shift_key, item) < 0.5 ? -distance : distance;
}

PhysResult phys_simulate(PhysSystem *system, const PhysTime *time) {
    PhysResult result = {.status = PHYS_OK, .clock = time->clock};
    system->frame++;
    system->last_time = *time;
    system->last_steps = 0;
    if (!phys_prepare(system) || (time->keep_last_finite && !phys_clear_not_finite(system)) ||
        (system->options.keep_forces && !phys_keep_start(system))) {
        result.status = PHYS_NO_MEMORY;
        return result;
    }
    if (time->clock == 0)
        phys_watch_start(system);
    if (time->clock == 0 && time->shift > 0)
        shift_particles(system, time);
    if (system->options.division)
        system->options.division->begin_frame(system, time);
    if (system->failed) {
        result.status = PHYS_NO_MEMORY;
        return result;
    }
    double last = time->last, remaining = time->now - last;
    double delta = 0;
    bool more = remaining > 0;
    for (uint64_t part = 0, parts = phys_parts(time); more; part = (part + 1) % parts) {
        delta = part > 0 ? delta : phys_step_length(time, last);
        if (result.steps == PHYS_MAX_STEPS || last + delta == last || !isfinite(result.clock + delta)) {
            result.status = PHYS_DROPPED_TIME;
            break;
        }
        if (parts > 1)
            phys_begin_part(system, part);
        if (!run_step(system, result.clock, delta, time->speed_of_light))
            return abort_frame(system, time);
        result.clock += delta;
        result.steps++;
        system->steps++;
        system->has_forces = true;
        last += delta;
        remaining = time->now - last;
        more = part + 1 < parts || (remaining > 1e-9 * time->resolution &&
                                    (time->lockstep || (result.steps == parts && time->performance > 1.5)));
    }
    if (!end_frame(system, time->keep_last_finite))
        return abort_frame(system, time);
    system->last_steps = result.steps;
    return result;
}
