// trajectory.h: the file of `petri run --trajectory FILE.h5`, as H5MD 1.1 has it.
#ifndef PETRI_SRC_HDF5_TRAJECTORY_H
#define PETRI_SRC_HDF5_TRAJECTORY_H

#include "cli/bytes.h"
#include "hdf5/store.h"

typedef struct Group Group;

typedef struct Way {
    Store *store;
    hid_t particles;
    Group *groups;
    size_t group_count;
    Bytes texts; // of ids
    hsize_t text_count;
} Way;

void way_begin(Way *way, Store *store);
// Adds what Hdf5Frame says.
void way_add(Way *way, const char *bytes);
void way_end(Way *way);

#endif
