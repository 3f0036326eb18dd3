// table.h: the file of `petri sweep -o FILE.h5`: a table of records.
#ifndef PETRI_SRC_HDF5_TABLE_H
#define PETRI_SRC_HDF5_TABLE_H

#include "hdf5/store.h"

// Makes a set `table` of a table in CSV, whose first line has the names. A column of whole numbers is one, so is one of
// numbers, in which nothing is NaN; all else is text.
void table_store(Store *store, const char *csv, size_t length);

#endif
