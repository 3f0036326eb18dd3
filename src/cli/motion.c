// motion.c: see motion.h.
#include "cli/motion.h"

#include "cli/memory.h"

#include <math.h>
#include <stdlib.h>

static double speed_square(const PetriSystem *system, uint32_t particle) {
    const double *velocity = system->velocity.data + particle * system->velocity.stride;
    double square = 0;
    for (uint32_t k = 0; k < system->dimensions; k++)
        square += velocity[k] * velocity[k];
    return square;
}

double particle_speed(const PetriSystem *system, uint32_t particle) {
    return sqrt(speed_square(system, particle));
}

static void add_particle(Motion *motion, const PetriSystem *system, uint32_t i) {
    const double *velocity = system->velocity.data + i * system->velocity.stride;
    double square = speed_square(system, i), speed = sqrt(square), mass = system->mass.data[i * system->mass.stride];
    for (uint32_t k = 0; k < system->dimensions; k++)
        motion->momentum[k] += mass * velocity[k];
    motion->kinetic_energy += 0.5 * mass * square;
    if (motion->moving++ == 0 || speed > motion->fastest) {
        motion->fastest_particle = i;
        motion->fastest = speed;
    }
}

Motion motion_measure(const PetriSystem *system) {
    Motion motion = {.momentum = memory_calloc(system->dimensions * sizeof(double))};
    for (uint32_t i = 0; i < system->particle_count; i++)
        if (!system->anchor[i * system->anchor_stride])
            add_particle(&motion, system, i);
    return motion;
}

void motion_free(Motion *motion) {
    free(motion->momentum);
}
