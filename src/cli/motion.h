// motion.h: kinetic energy and momentum of a system, without its anchors.
#pragma once

#include "petri.h"

#include <stdint.h>

typedef struct Motion {
    uint32_t moving;           // number of particles that are not anchors
    double kinetic_energy;     // sum of mass * speed^2 / 2
    double *momentum;          // sum of mass * velocity, one value per dimension
    double fastest;            // highest speed
    uint32_t fastest_particle; // index of the particle with that speed; undefined if `moving` is 0
} Motion;

double particle_speed(const PetriSystem *system, uint32_t particle);
// Computes the sums over all particles except anchors. The caller frees the result with motion_free.
Motion motion_measure(const PetriSystem *system);
void motion_free(Motion *motion);
