// h5md.h: what `petri run --trajectory FILE.h5` hands to petri-hdf5.
#ifndef PETRI_SRC_H5MD_H
#define PETRI_SRC_H5MD_H

#include "base/hash_index.h"
#include "cli/byte_buffer.h"
#include "cli/hdf5.h"
#include "cli/output.h"
#include "petri.h"
#include "run/resume.h"

typedef struct H5md {
    Hdf5 writer;
    TextList texts;  // of ids that are no whole numbers from 0
    HashIndex index; // of them
    size_t sent;     // of them
    ByteBuffer ids;  // of the frame's particles, int64_t
} H5md;

// `resume` is NULL if there is no state to go on from. False after a message.
bool h5md_open(H5md *file, const char *path, const Resume *resume, Output *output);
// Adds the last frame of a session. False if memory is used up; `output` has an error if the file cannot be written.
bool h5md_add(H5md *file, PetriSession *session, Output *output);
// Returns when all that was added is on the disk. False after a message of petri-hdf5.
bool h5md_sync(H5md *file, Output *output);
// Puts the file in its place if all is well with it. False if there is none, after a message of petri-hdf5.
bool h5md_close(H5md *file, bool keep, Output *output);

#endif
