// text_table.c: see text_table.h.
#include "cli/text_table.h"

#include "base/str.h"

#include <stdlib.h>
#include <string.h>

TextTable text_table_new(size_t columns) {
    return (TextTable){.columns = columns, .width = memory_calloc(columns * sizeof(size_t))};
}

void text_table_add(TextTable *table, const char *cell) {
    size_t width = utf8_length(str_from(cell)), *widest = &table->width[table->count++ % table->columns];
    *widest = width > *widest ? width : *widest;
    text_add(&table->cells, (Str){cell, strlen(cell) + 1});
}

void table_text(const TextTable *table, Text *text) {
    const char *cell = table->cells.bytes;
    size_t due = 0; // spaces before the next cell that is not empty
    for (size_t i = 0; i < table->count; i++, cell += strlen(cell) + 1) {
        size_t column = i % table->columns;
        if (cell[0] != '\0') {
            text_add_format(text, "%*s%s", (int)due, "", cell);
            due = 0;
        }
        due += table->width[column] - utf8_length(str_from(cell)) + 2;
        if (column + 1 == table->columns) {
            text_add_c(text, "\n");
            due = 0;
        }
    }
}

void text_table_write(const TextTable *table, Output *output) {
    SCOPED_TEXT text = {0};
    table_text(table, &text);
    if (text.len > 0)
        output_write(output, text.bytes, text.len);
}

void text_table_free(TextTable *table) {
    free(table->width);
    text_free(&table->cells);
}
