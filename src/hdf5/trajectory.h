// trajectory.h: the H5MD 1.1 file of `petri run --trajectory FILE.h5`.
#pragma once

#include "base/hash_index.h"
#include "cli/memory.h"
#include "hdf5/store.h"

typedef struct Group Group;

typedef struct TrajectoryFile {
    Store *store;
    hid_t particles;
    Group *groups;
    size_t group_count;
    TextList texts;   // ids that are strings; the file stores texts.items[K] as the number -2-K
    HashIndex index;  // index of `texts`
    int64_t *numbers; // maps the number of a string in the current run to its id in the file
    size_t run_texts; // number of strings of the current run
    int64_t last;     // number of the last frame; -1: none
} TrajectoryFile;

// Starts an empty trajectory.
void trajectory_file_begin(TrajectoryFile *file, Store *store);
// Like trajectory_file_begin, but keeps the frames of an existing file up to frame `after` and removes later frames.
// Returns false if the file was not written by petri.
bool trajectory_file_resume(TrajectoryFile *file, Store *store, int64_t after);
// Starts the frames of another run. Must be called before the first of them, because each run numbers its strings
// from 0.
void trajectory_file_begin_run(TrajectoryFile *file);
// Adds a frame (Hdf5Frame and its data) if it is later than the last frame. Modifies the ids in `bytes`.
void trajectory_file_add(TrajectoryFile *file, char *bytes);
// Writes the parts that are only known at the end, and frees the memory.
void trajectory_file_end(TrajectoryFile *file);
