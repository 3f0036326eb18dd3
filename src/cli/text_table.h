// text_table.h: cells in columns that are as wide as what they hold.
#ifndef PETRI_SRC_REPL_TEXT_TABLE_H
#define PETRI_SRC_REPL_TEXT_TABLE_H

#include "cli/byte_buffer.h"
#include "cli/output.h"

typedef struct TextTable {
    size_t columns;
    ByteBuffer cells; // each ended by NUL
    size_t count;     // of cells
    size_t *width;    // of columns, in characters
} TextTable;

TextTable text_table_new(size_t columns);
// The next cell, row by row.
void text_table_add(TextTable *table, const char *cell);
void table_text(const TextTable *table, ByteBuffer *text);
void text_table_write(const TextTable *table, Output *output);
void text_table_free(TextTable *table);
#define SCOPED_TEXT_TABLE __attribute__((cleanup(text_table_free))) TextTable

#endif
