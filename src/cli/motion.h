// motion.h: what is measured of the particles of a system together. Anchors do not count.
#ifndef PETRI_SRC_MOTION_H
#define PETRI_SRC_MOTION_H

#include <stdint.h>

#include "petri.h"

typedef struct Motion {
    uint32_t moving;       // particles
    double kinetic_energy; // half the mass times the speed squared
    double *momentum;      // mass times velocity
    double fastest;        // speed
    char *fastest_id;      // NULL without particles
} Motion;

double particle_speed(const PetriParticle *particle, uint32_t dimensions);
// Of the system with this number; free it with motion_free.
Motion motion_measure(PetriSession *session, size_t number, const PetriSystem *system);
void motion_free(Motion *motion);

#endif
