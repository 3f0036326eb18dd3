// table.h: the table of records in the file of `petri sweep -o FILE.h5`.
#pragma once

#include "hdf5/store.h"

// Writes the `length` bytes of data that hdf5_table (cli/hdf5.h) has sent, as the data set `table`. If there is one row
// for each combination of values, each column is also an array whose dimensions are the parameters.
void table_store(Store *store, const char *data, size_t length);
