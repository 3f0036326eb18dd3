// table.c: see table.h.
#include "cli/table.h"

#include <stdlib.h>
#include <string.h>

#include "base/str.h"

Table table_new(size_t columns) {
    return (Table){.columns = columns, .width = memory_zeroed(columns * sizeof(size_t))};
}

void table_add(Table *table, const char *cell) {
    size_t width = utf8_length(str_from(cell)), *widest = &table->width[table->count++ % table->columns];
    *widest = width > *widest ? width : *widest;
    bytes_add(&table->cells, cell, strlen(cell) + 1);
}

void table_write(const Table *table, Output *output) {
    const char *cell = table->cells.data;
    size_t due = 0; // blanks before the next cell that holds something
    for (size_t i = 0; i < table->count; i++, cell += strlen(cell) + 1) {
        size_t column = i % table->columns;
        if (cell[0] != '\0') {
            output_format(output, "%*s%s", (int)due, "", cell);
            due = 0;
        }
        due += table->width[column] - utf8_length(str_from(cell)) + 2;
        if (column + 1 == table->columns) {
            output_write(output, "\n", 1);
            due = 0;
        }
    }
}

void table_free(Table *table) {
    free(table->width);
    bytes_free(&table->cells);
}
