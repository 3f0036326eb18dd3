// motion.h: what is measured of the particles of a system together. Anchors do not count.
#ifndef PETRI_SRC_MOTION_H
#define PETRI_SRC_MOTION_H

#include "petri.h"

#include <stdint.h>

typedef struct Motion {
    uint32_t moving;           // particles
    double kinetic_energy;     // half the mass times the speed squared
    double *momentum;          // mass times velocity
    double fastest;            // speed
    uint32_t fastest_particle; // if some are moving
} Motion;

double particle_speed(const PetriSystem *system, uint32_t particle);
// Free it with motion_free.
Motion motion_measure(const PetriSystem *system);
void motion_free(Motion *motion);

#endif
