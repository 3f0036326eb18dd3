// h5md.h: H5MD trajectories (`petri run --trajectory FILE.h5`), which petri-hdf5 writes.
#pragma once

#include "cli/hdf5.h"
#include "cli/memory.h"
#include "cli/output.h"
#include "cli/particles.h"
#include "petri.h"
#include "run/id_numbers.h"
#include "run/resume.h"

typedef struct H5md {
    Hdf5 writer;
    IdNumbers names;
    size_t sent; // number of `names.texts` that were sent to petri-hdf5
    Text ids;    // ids of the particles of the current frame, as int64_t values
} H5md;

// Starts petri-hdf5 and makes `output` write to it. `resume` describes the state from which the run continues; if it is
// NULL, later runs cannot continue the file. Returns false after a message.
bool h5md_open(H5md *file, const char *path, const Resume *resume, Output *output);
// Adds the last frame of a session. `energies` has an element for each system; NULL: none. Returns false if out of
// memory. Write errors are stored in `output`.
bool h5md_add(H5md *file, PetriSession *session, const ParticlesEnergies *energies, Output *output);
// Waits until all frames are on disk. Returns false after a message of petri-hdf5.
bool h5md_sync(H5md *file, Output *output);
// Completes the file, or discards it if `keep` is false. Returns false, after a message of petri-hdf5, on failure.
bool h5md_close(H5md *file, bool keep, Output *output);
