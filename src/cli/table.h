// table.h: cells in columns that are as wide as what they hold.
#ifndef PETRI_SRC_REPL_TABLE_H
#define PETRI_SRC_REPL_TABLE_H

#include "cli/bytes.h"
#include "cli/output.h"

typedef struct Table {
    size_t columns;
    Bytes cells;   // each ended by NUL
    size_t count;  // of cells
    size_t *width; // of columns, in characters
} Table;

Table table_new(size_t columns);
// The next cell, row by row.
void table_add(Table *table, const char *cell);
void table_write(const Table *table, Output *output);
void table_free(Table *table);
#define SCOPED_TABLE __attribute__((cleanup(table_free))) Table

#endif
