// particles.h: CSV trajectories (RFC 4180), one row per particle and frame. Used by `petri run --trajectory run.csv`
// and by the playground.
#pragma once

#include "petri.h"

#include <stdbool.h>
#include <stdint.h>

// Returns the largest number of dimensions of the systems in the last frame, at least 1.
uint32_t particles_dimensions(PetriSession *session);
// Writes the line with the column names.
void particles_header(uint32_t dimensions, PetriWriteCallback *write, void *user_data);
// Writes the rows of the last frame. Components beyond the dimensions of a system are empty. Returns false if out of
// memory.
bool particles_rows(PetriSession *session, uint32_t dimensions, PetriWriteCallback *write, void *user_data);
