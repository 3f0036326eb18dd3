// table.h: tables of figures, which are written as aligned text, Markdown or CSV.
#pragma once

#include <stddef.h>
#include <stdio.h>

typedef struct Column {
    const char *name;   // heading in CSV
    const char *top;    // first line of the heading in text
    const char *bottom; // second line of the heading in text
} Column;

enum { TABLE_CELLS = 24, TABLE_TEXT = 64 };

// A cell contains a text, or a number if the text is empty. NaN: not measured.
typedef struct Cell {
    char text[TABLE_TEXT]; // without commas and quotes
    double number;
} Cell;

typedef struct Table {
    const char *title;
    const Column *columns;
    size_t column_count; // at most TABLE_CELLS
    Cell (*rows)[TABLE_CELLS];
    size_t row_count;
} Table;

Table table_new(const char *title, const Column *columns, size_t column_count);
void table_free(Table *table);
// Adds a row of empty cells. The result is valid until the next table_row.
Cell *table_row(Table *table);
Cell cell_number(double x);
Cell cell_text(const char *text);

void table_write_text(const Table *table, FILE *file);
void table_write_markdown(const Table *table, FILE *file);
void table_write_csv(const Table *table, FILE *file);
