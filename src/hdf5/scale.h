// scale.h: dimension scales of HDF5, which name the dimensions of data sets for xarray and tools for NetCDF.
#pragma once

#include "hdf5/store.h"

// A data set attached to a dimension scale, as stored in the attribute REFERENCE_LIST of the scale.
typedef struct ScaleUse {
    hobj_ref_t set;
    int dimension;
} ScaleUse;

typedef struct Scale {
    hid_t set;
    ScaleUse *uses;
    size_t use_count;
} Scale;

// Makes a data set a dimension scale. The caller calls scale_end.
Scale scale_begin(Store *store, hid_t set, const char *name);
// Creates the data set `name` with the numbers from 0 to count - 1 as a dimension scale. The caller calls scale_end.
Scale scale_count(Store *store, hid_t parent, const char *name, hsize_t count);
// Names the dimensions of a data set by scales, one per dimension. `rank` is at most H5S_MAX_RANK.
void scale_attach(Store *store, hid_t set, int rank, Scale *const scales[]);
// Writes the list of attached data sets to the scale, and frees the list.
void scale_end(Store *store, Scale *scale);
// Removes what these functions added to a data set, so that it can be attached again.
void scale_remove(Store *store, hid_t set);
