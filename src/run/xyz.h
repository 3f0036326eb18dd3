// xyz.h: frames in extended XYZ, as ASE and OVITO read it (`petri run --trajectory FILE.xyz`).
#pragma once

#include "cli/output.h"
#include "cli/particles.h"
#include "petri.h"
#include "run/id_numbers.h"

// The numbers of particles and systems, which are the same in all frames of a file.
typedef struct XyzNames {
    IdNumbers ids;
    IdNumbers systems; // only its `texts` are used: the number of a system is the position of its name
} XyzNames;

void xyz_free(XyzNames *names);
// Writes the last frame of a session. `energies` has an element for each system; NULL: none. Returns false if out of
// memory. Write errors are stored in `output`.
bool xyz_add(XyzNames *names, PetriSession *session, const ParticlesEnergies *energies, Output *output);
// Adds the names in the second line of a frame, to continue a file. All frames must be read, in order. Returns false if
// the line was not written by xyz_add, or if out of memory.
bool xyz_read_names(XyzNames *names, const char *line);
