// stability.h: forces that are certainly unstable (the reference, "Stability of springs").
//
// For this integrator, masses that are connected by springs are unstable if λ·δ² > 4. δ is the length of a step, and λ
// is the largest eigenvalue of M⁻¹K, with the masses M and the stiffness K. Each further spring can only increase λ, so
// some of the springs suffice to show that a system is unstable. No spring that is missed, and no damping, makes it
// stable.
#pragma once

#include "physics/system.h"

typedef struct PhysInstability {
    uint32_t force;    // number of the force
    double strength;   // strength with which the force is stable, unless other forces are too strong
    double resolution; // longest step with which it is stable at its present strength
} PhysInstability;

// Finds a force that is certainly unstable with steps of `delta`. Only linear forces are checked: `!distance`,
// `!collision` and soft boundaries with power 1, and `!adhesion`. A `!distance` with equal bounds is checked together
// with all others. Any other spring acts on one side only, so it must be unstable by itself; and a force between all
// pairs must be unstable for every pair of particles on which it can act. Charges work to the budget of the system.
// Returns false if there is no such force, if memory ran out, or if the system must stop.
bool phys_find_instability(const PhysSystem *system, double delta, PhysInstability *found);
