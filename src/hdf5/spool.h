// spool.h: crash-safe storage of new frames of a trajectory (FILE.part), used with `--state`.
//
// An HDF5 file gets its name only when it is complete, at the end of a run. If petri and petri-hdf5
// are killed before that, the spool contains the frames up to the last saved state. The next run reads them from it.
#pragma once

#include "cli/hdf5.h"
#include "cli/memory.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Spool {
    Text path;
    int file;        // descriptor, locked
    bool complete;   // true if the spool contains the whole trajectory; an existing HDF5 file is older and ignored
    bool has_frames; // true if the spool contains frames, possibly of an earlier run
    uint64_t size;   // size of the file in bytes
    uint64_t at;     // offset of the next block to read or write
    uint64_t texts;  // number of id strings in the blocks of the current run that were read
} Spool;

// Opens the spool of the trajectory `path` and empties it if `begins` is true. Returns false after a message, for
// example if another process uses the spool.
bool spool_open(Spool *spool, const char *path, bool begins);
// Reads the next block, HDF5_ADD or HDF5_NEW_RUN. Returns false at the first frame later than `after`, at a damaged
// or invalid block and at the end.
bool spool_next(Spool *spool, int64_t after, Hdf5Head *head, char **block);
// Adds a block of this run after the blocks that spool_next has read, and discards any further old blocks. Returns
// false after a message.
bool spool_add(Spool *spool, const Hdf5Head *head, const char *block);
// Writes the spool and its folder entry to disk. Returns false after a message.
bool spool_save(Spool *spool, int folder);
// Closes the spool. Removes its file if it contains no frames, or if `done` is true because the HDF5 file has them all.
void spool_close(Spool *spool, bool done);
