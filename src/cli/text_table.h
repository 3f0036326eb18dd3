// text_table.h: a text table whose columns are as wide as their widest cell.
#pragma once

#include "cli/memory.h"
#include "cli/output.h"

typedef struct TextTable {
    size_t columns;
    Text cells;    // contents of the cells, each NUL-terminated
    size_t count;  // number of cells
    size_t *width; // widths of the columns, in characters
} TextTable;

TextTable text_table_new(size_t columns);
// Adds the next cell. Cells are added row by row.
void text_table_add(TextTable *table, const char *cell);
// Appends the formatted table to a buffer.
void table_text(const TextTable *table, Text *text);
void text_table_write(const TextTable *table, Output *output);
void text_table_free(TextTable *table);
#define SCOPED_TEXT_TABLE __attribute__((cleanup(text_table_free))) TextTable
