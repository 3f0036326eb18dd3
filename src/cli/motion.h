// motion.h: energies and momenta of a system.
#pragma once

#include "petri.h"

#include <stdint.h>

double particle_speed(const PetriSystem *system, uint32_t particle);
// Returns the number of particles that are not anchors.
uint32_t motion_count(const PetriSystem *system);

typedef void MotionRow(void *user_data, const char *name, const char *value);
// Calls `row` for each row of a table about system `number`: kinetic energy, the sum of mass * speed^2 / 2 over all
// particles except anchors; momentum, with at most `max_components` components; in two and three dimensions, angular
// momentum about the origin; the fastest particle; if a force has a potential, potential energy, also of each force if
// there are several, and total energy. Numbers have `digits` digits. Does nothing if all particles are anchors.
void motion_rows(PetriSession *session, size_t number, const PetriSystem *system, int digits, uint32_t max_components,
                 MotionRow *row, void *user_data);
