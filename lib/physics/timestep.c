// timestep.c: the loop over the steps of a frame (spec physics.md section 4).
//
//   remaining = t − last
//   repeat
//       delta = min(resolution, remaining)
//       one step of delta at clock
//       clock = clock + delta
//       last = last + delta;  remaining = t − last
//       more = remaining > 1e-9 * resolution
//   until not (more and (lockstep or this is the frame's first step and performance > 1.5))
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
    if (system->options.division)
        system->options.division->begin_frame(system, time);
    if (system->failed) {
        result.status = PHYS_NO_MEMORY;
        return result;
    }
    double last = time->last, remaining = time->now - last;
    bool more = remaining > 0;
    while (more) {
        double delta = phys_step_length(time, last);
        if (result.steps == PHYS_MAX_STEPS || last + delta == last || !isfinite(result.clock + delta)) {
            result.status = PHYS_DROPPED_TIME;
            break;
        }
        if (!run_step(system, result.clock, delta, time->speed_of_light))
            return abort_frame(system, time);
        result.clock += delta;
        result.steps++;
        system->steps++;
        system->has_forces = true;
        last += delta;
        remaining = time->now - last;
        more =
            remaining > 1e-9 * time->resolution && (time->lockstep || (result.steps == 1 && time->performance > 1.5));
    }
    if (!end_frame(system, time->keep_last_finite))
        return abort_frame(system, time);
    system->last_steps = result.steps;
    return result;
}
