// motion.c: see motion.h.
#include "cli/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/bytes.h"

static double speed_square(const PetriParticle *particle, uint32_t dimensions) {
    double square = 0;
    for (uint32_t k = 0; k < dimensions; k++) {
        square += particle->velocity[k] * particle->velocity[k];
    }
    return square;
}

double particle_speed(const PetriParticle *particle, uint32_t dimensions) {
    return sqrt(speed_square(particle, dimensions));
}

static void add_particle(Motion *motion, const PetriParticle *particle, uint32_t dimensions) {
    double square = speed_square(particle, dimensions), speed = sqrt(square);
    for (uint32_t k = 0; k < dimensions; k++) {
        motion->momentum[k] += particle->mass * particle->velocity[k];
    }
    motion->moving++;
    motion->kinetic_energy += 0.5 * particle->mass * square;
    if (motion->fastest_id == NULL || speed > motion->fastest) {
        free(motion->fastest_id);
        motion->fastest_id = memory_text(particle->id);
        motion->fastest = speed;
    }
}

Motion motion_measure(PetriSession *session, size_t number, const PetriSystem *system) {
    Motion motion = {.momentum = memory_zeroed(system->dimensions * sizeof(double))};
    PetriParticle particle;
    for (uint32_t i = 0; petri_particle(session, number, i, &particle); i++) {
        if (!particle.anchor) {
            add_particle(&motion, &particle, system->dimensions);
        }
    }
    return motion;
}

void motion_free(Motion *motion) {
    free(motion->momentum);
    free(motion->fastest_id);
}
