// particles.h: CSV files (RFC 4180), and trajectories in this format with one row per particle and frame. Used by
// `petri sweep`, by `petri run --trajectory run.csv` and by the playground.
#pragma once

#include "base/str.h"
#include "petri.h"

#include <stdbool.h>
#include <stdint.h>

// Writes a cell, quoted if it contains commas, quotes or line ends.
void csv_write(Str cell, PetriWriteCallback *write, void *user_data);

// Returns the largest number of dimensions of the systems in the last frame, at least 1.
uint32_t particles_dimensions(PetriSession *session);
// The kinetic and potential energy of a system.
typedef struct ParticlesEnergies {
    double kinetic;
    double potential;
} ParticlesEnergies;

// Writes the line with the column names. `energies` is true if the rows have energies.
void particles_header(uint32_t dimensions, bool energies, PetriWriteCallback *write, void *user_data);
// Writes the rows of the last frame. Components beyond the dimensions of a system are empty. Each row has the energies
// of its system. `energies` has an element for each system; NULL: the rows have no energies. Returns false if out of
// memory.
bool particles_rows(PetriSession *session, uint32_t dimensions, const ParticlesEnergies *energies,
                    PetriWriteCallback *write, void *user_data);
