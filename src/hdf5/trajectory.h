// trajectory.h: the file of `petri run --trajectory FILE.h5`, as H5MD 1.1 has it.
#ifndef PETRI_SRC_HDF5_TRAJECTORY_H
#define PETRI_SRC_HDF5_TRAJECTORY_H

#include "base/table.h"
#include "cli/bytes.h"
#include "hdf5/store.h"

typedef struct Group Group;

typedef struct Way {
    Store *store;
    hid_t particles;
    Group *groups;
    size_t group_count;
    TextList texts;   // of ids
    Index index;      // of them
    int64_t *numbers; // of those of the present run
    size_t run_texts;
    int64_t last; // frame; -1: none
} Way;

void way_begin(Way *way, Store *store);
// The same with what the file holds up to a frame; what is later is cut. False if it is no such file.
bool way_go_on(Way *way, Store *store, int64_t after);
// What follows comes from another run.
void way_begin_run(Way *way);
// Adds what Hdf5Frame says, if it is later than what is there. Changes the ids in `bytes`.
void way_add(Way *way, char *bytes);
void way_end(Way *way);

#endif
