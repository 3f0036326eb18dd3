// motion.h: energies and momenta of a system.
#pragma once

#include "base/str.h"
#include "petri.h"

#include <stdint.h>

double particle_speed(const PetriSystem *system, uint32_t particle);
// Returns the number of particles that are not anchors.
uint32_t motion_count(const PetriSystem *system);

// Computes the kinetic energy of system `number`, and the sum of the potential energies of its forces. Forces without a
// potential count as 0. *potential is NaN if petri_potential_energy fails.
void motion_energies(PetriSession *session, size_t number, const PetriSystem *system, double *kinetic,
                     double *potential);

typedef void MotionRow(void *user_data, const char *name, const char *value);
// Calls `row` for each row of a table about system `number`: kinetic energy, the sum of mass * speed^2 / 2 over all
// particles except anchors; momentum, with at most `max_components` components; in two and three dimensions, angular
// momentum about the origin; the fastest particle; if a force has a potential, potential energy, also of each force if
// there are several, and total energy. Numbers have `digits` digits. Does nothing if all particles are anchors.
void motion_rows(PetriSession *session, size_t number, const PetriSystem *system, int digits, uint32_t max_components,
                 MotionRow *row, void *user_data);

// A quantity of all systems together, for tables.
typedef enum MotionQuantity {
    MOTION_ENERGY, // kinetic and potential energy of all systems; forces without a potential count as 0
    MOTION_KINETIC_ENERGY,
    MOTION_POTENTIAL_ENERGY,
    MOTION_MOMENTUM,         // a vector with as many elements as the system with the most dimensions
    MOTION_ANGULAR_MOMENTUM, // about the origin: in two dimensions one number, in three a vector; otherwise nothing
    MOTION_QUANTITIES
} MotionQuantity;

// Names of the quantities, such as "kinetic_energy".
extern const char *const motion_quantity_names[MOTION_QUANTITIES];
// Returns the quantity with a name, or MOTION_QUANTITIES if there is none.
MotionQuantity motion_quantity(const char *name);
// Appends the present value of a quantity as a cell (cli/cells.h): nothing, a number, or the elements of a vector with
// 17 digits, separated by ';'. Returns the status of petri_potential_energy, or PETRI_OK.
PetriStatus motion_add_quantity(PetriSession *session, MotionQuantity quantity, Text *cells);
