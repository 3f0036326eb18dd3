// table.h: the table of records in the file of `petri sweep -o FILE.h5`.
#pragma once

#include "hdf5/store.h"

// Writes a CSV table, whose first line contains the column names, as the data set `table`. A column is stored as
// integers if all its cells are integers, and as doubles if all are numbers or empty (NaN). Other columns are strings.
void table_store(Store *store, const char *csv, size_t length);
