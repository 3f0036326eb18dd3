// particles.h: particles as a table of comma-separated values, a row a particle and frame (RFC 4180): what `petri run
// --trajectory run.csv` writes, and the page in a browser.
#ifndef PETRI_SRC_PARTICLES_H
#define PETRI_SRC_PARTICLES_H

#include "petri.h"

#include <stdbool.h>
#include <stdint.h>

// How many dimensions the columns must have for the systems of the last frame: at least 1.
uint32_t particles_dimensions(PetriSession *session);
// The line with the columns' names.
void particles_header(uint32_t dimensions, PetriWriteCallback *write, void *user_data);
// The rows of the last frame. A component that a system does not have is left empty. False if memory is used up.
bool particles_rows(PetriSession *session, uint32_t dimensions, PetriWriteCallback *write, void *user_data);

#endif
