// contributions.h: names and values of the forces that act on a particle (petri_explain_force), as text.
#pragma once

#include "cli/memory.h"
#include "petri-inspect.h"

// Appends the name of a force, such as "gravity". `force` is an element of PetriExplanation.force.
void contribution_add_name(PetriSession *session, size_t system, uint32_t force, Text *text);
// Appends FILE:LINE, the position of the force's node, or "-" if it is unknown or `force` is PETRI_OWN_FORCE.
void contribution_add_position(PetriSession *session, size_t system, uint32_t force, Text *text);
// Appends the id of the other particle of a force, or "-" if there is none.
void contribution_add_partner(PetriSession *session, size_t system, uint32_t partner, Text *text);
// Appends a vector in full precision.
void contribution_add_vector(PetriSession *session, const double *vector, uint32_t dimensions, Text *text);
