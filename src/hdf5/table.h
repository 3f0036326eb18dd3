// table.h: the table of records in the file of `petri sweep -o FILE.h5`.
#ifndef PETRI_SRC_HDF5_TABLE_H
#define PETRI_SRC_HDF5_TABLE_H

#include "hdf5/store.h"

// Writes a CSV table, whose first line contains the column names, as the data set `table`. A column is stored as
// integers or as numbers if all its cells are; empty cells of a number column become NaN. All other columns are text.
void table_store(Store *store, const char *csv, size_t length);

#endif
