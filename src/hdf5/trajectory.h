// trajectory.h: the file of `petri run --trajectory FILE.h5`, as H5MD 1.1 has it.
#ifndef PETRI_SRC_HDF5_TRAJECTORY_H
#define PETRI_SRC_HDF5_TRAJECTORY_H

#include "base/hash_index.h"
#include "cli/byte_buffer.h"
#include "hdf5/store.h"

typedef struct Group Group;

typedef struct TrajectoryFile {
    Store *store;
    hid_t particles;
    Group *groups;
    size_t group_count;
    TextList texts;   // of ids
    HashIndex index;  // of them
    int64_t *numbers; // of those of the present run
    size_t run_texts;
    int64_t last; // frame; -1: none
} TrajectoryFile;

void trajectory_file_begin(TrajectoryFile *way, Store *store);
// The same with what the file holds up to a frame; what is later is cut. False if it is no such file.
bool trajectory_file_resume(TrajectoryFile *way, Store *store, int64_t after);
// What follows comes from another run.
void trajectory_file_begin_run(TrajectoryFile *way);
// Adds what Hdf5Frame says, if it is later than what is there. Changes the ids in `bytes`.
void trajectory_file_add(TrajectoryFile *way, char *bytes);
void trajectory_file_end(TrajectoryFile *way);

#endif
