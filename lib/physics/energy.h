// energy.h: potential energies of forces (spec physics.md section 4.5).
#pragma once

#include "physics/system.h"

// Computes the potential energy of force `number` at the current positions, in units of mass * (length / time)^2. The
// force has its strength at time `clock` of the simulation clock. Sets *energy to NaN if the force has no potential.
// Forces with `theta` count as the exact forces between all pairs, which they approximate. Takes time proportional to
// n^2 for forces of unlimited range, and is otherwise faster. Charges work to the budget of the system. Returns
// PHYS_OK, PHYS_STOPPED or PHYS_NO_MEMORY; after a failure *energy is NaN.
PhysStatus phys_potential_energy(const PhysSystem *system, uint32_t number, double clock, double *energy);
