// far_force.h: passes of pair forces with `theta` (spec far-field.md).
#pragma once

#include "physics/far_field.h"

enum { PHYS_FORESTS = 2 }; // for masses and charges

// Returns true if a force is approximated in groups with enough particles.
bool phys_is_far(const PhysSystem *system, const Force *force);
// Returns true if the pass of these forces for a group is divided: forces with `theta` are computed one by one after
// the other forces.
bool phys_far_divides(const PhysSystem *system, const Group *group, ForceRange forces);

// Sets *pays to false if the forces between two groups, which can be the same, are computed for all pairs: if `other`
// has few particles, or if this is faster, because the walks for a sample of the targets list more than three quarters
// of the possible sources. Returns false if the step must be aborted.
bool phys_far_pays(PhysSystem *system, Force *force, uint32_t group, uint32_t other, bool *pays);
// Adds the force that the members of group `sources` exert on those of group `targets`. Returns false if the step must
// be aborted.
bool phys_far_forces(PhysSystem *system, Force *force, uint32_t targets, uint32_t sources);
// Like phys_far_forces, but only for the targets that are evaluated together with the particle in `column`.
bool phys_far_force_on(PhysSystem *system, Force *force, uint32_t column, uint32_t targets, uint32_t sources);

// Makes the forests invalid, because particles have moved or changed.
void phys_far_forget(PhysSystem *system);
void phys_far_free(FarForest *forest);
