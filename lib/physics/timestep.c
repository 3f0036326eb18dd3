// timestep.c: the loop of section 4: how many steps a frame makes, and how long they are.
//
//   remaining = t − last
//   repeat
//       delta = min(resolution, remaining)
//       one step of delta at clock
//       clock = clock + delta
//       last = last + delta;  remaining = t − last
//       more = remaining > 1e-9 * resolution
//   until not (more and (lockstep or this is the frame's first step and performance > 1.5))
#include "physics/internal.h"

PhysResult phys_simulate(PhysSystem *system, const PhysTime *time) {
    PhysResult result = {.status = PHYS_OK, .clock = time->clock};
    if (system->failed || !phys_arrange(system) || !phys_load(system)) {
        result.status = PHYS_NO_MEMORY;
        return result;
    }
    double last = time->last, remaining = time->now - last;
    bool more = remaining > 0;
    while (more) {
        double delta = time->resolution < remaining ? time->resolution : remaining;
        if (result.steps == PHYS_MAX_STEPS || last + delta == last) {
            result.status = PHYS_DROPPED_TIME;
            break;
        }
        if (time->interrupt && atomic_load_explicit(time->interrupt, memory_order_relaxed)) {
            result.status = PHYS_INTERRUPTED;
            break;
        }
        phys_step(system, result.clock, delta, time->speed_of_light);
        result.clock += delta;
        result.steps++;
        system->stepped = true;
        last += delta;
        remaining = time->now - last;
        more =
            remaining > 1e-9 * time->resolution && (time->lockstep || (result.steps == 1 && time->performance > 1.5));
    }
    phys_store(system);
    return result;
}
