// spool.h: what is added to a trajectory that a run with `--state` writes, until the file has it (FILE.part).
//
// A file of HDF5 takes its name as a whole, when the run ends. If both programs are killed before, the frames up to the
// last saved state are in the spool, and the next run takes them from there.
#ifndef PETRI_SRC_HDF5_SPOOL_H
#define PETRI_SRC_HDF5_SPOOL_H

#include "cli/byte_buffer.h"
#include "cli/hdf5.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Spool {
    ByteBuffer path;
    int file;        // locked
    bool complete;   // the trajectory is all in it: what the file holds is older
    bool has_frames; // frames, perhaps of a run before
    uint64_t size;   // bytes of the file when it was opened
    uint64_t at;
} Spool;

// Opens that of a trajectory, an empty one if it begins. False after a message, also if another process writes it.
bool spool_open(Spool *spool, const char *path, bool begins);
// The next block, in order, of HDF5_ADD or HDF5_NEW_RUN; frames later than `after` are not given, nor what comes behind
// one.
bool spool_next(Spool *spool, int64_t after, Hdf5Head *head, char **block);
// Adds a block of this run; what spool_next has not given goes first. False after a message.
bool spool_add(Spool *spool, const Hdf5Head *head, const char *block);
// Brings it to the disk, its name, too. False after a message.
bool spool_save(Spool *spool, int folder);
// Removes it if the file has all, or there is nothing in it.
void spool_close(Spool *spool, bool done);

#endif
