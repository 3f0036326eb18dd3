// table.c: see table.h.
#include "hdf5/table.h"

#include "cli/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum Kind { INTEGER, NUMBER, TEXT } Kind;

typedef struct Column {
    Kind kind;
    size_t bytes; // size of a cell in a record
    hid_t type;
} Column;

typedef struct Table {
    const char **cells; // by row
    size_t rows;        // including the names of the columns
    size_t width;       // number of cells in a row
} Table;

static Table read_table(const char *data, size_t length) {
    uint64_t width;
    memcpy(&width, data, sizeof width);
    const char *at = data + sizeof width, *end = data + length;
    size_t count = 0;
    for (const char *c = at; c < end; c++)
        count += *c == '\0';
    Table table = {memory_calloc(count * sizeof *table.cells), count / width, width};
    for (size_t i = 0; i < count; at += strlen(at) + 1)
        table.cells[i++] = at;
    return table;
}

static const char *cell_at(const Table *table, size_t row, size_t column) {
    return table->cells[row * table->width + column];
}

static Kind kind_of(const char *text) {
    char *end = NULL;
    (void)strtoll(text, &end, 10);
    if (*text != '\0' && *end == '\0' && strlen(text) < 18)
        return INTEGER;
    (void)strtod(text, &end);
    return *end == '\0' ? NUMBER : TEXT;
}

// Chooses the type of a column. The last column contains error texts, so it is text even if it is empty.
static Column choose_column(const Table *table, size_t number) {
    Column column = {.kind = number + 1 == table->width ? TEXT : INTEGER};
    size_t max_length = 0;
    for (size_t row = 1; row < table->rows; row++) {
        const char *text = cell_at(table, row, number);
        Kind kind = kind_of(text);
        column.kind = kind > column.kind ? kind : column.kind;
        max_length = strlen(text) > max_length ? strlen(text) : max_length;
    }
    column.type = column.kind == INTEGER  ? H5Tcopy(H5T_NATIVE_INT64)
                  : column.kind == NUMBER ? H5Tcopy(H5T_NATIVE_DOUBLE)
                                          : store_text_type(max_length);
    column.bytes = H5Tget_size(column.type);
    return column;
}

static void write_cell(const Column *column, const char *text, char *out) {
    int64_t whole = column->kind == INTEGER ? strtoll(text, NULL, 10) : 0;
    double number = *text == '\0' ? NAN : strtod(text, NULL);
    switch (column->kind) {
    case INTEGER:
        memcpy(out, &whole, sizeof whole);
        break;
    case NUMBER:
        memcpy(out, &number, sizeof number);
        break;
    default:
        memcpy(out, text, strlen(text) + 1);
    }
}

void table_store(Store *store, const char *data, size_t length) {
    Table table = read_table(data, length);
    size_t bytes = 0;
    Column *columns = memory_calloc(table.width * sizeof *columns);
    for (size_t i = 0; i < table.width; i++) {
        columns[i] = choose_column(&table, i);
        bytes += columns[i].bytes;
    }
    char *records = memory_calloc(table.rows * bytes), *at = records;
    hid_t record = H5Tcreate(H5T_COMPOUND, bytes);
    for (size_t i = 0, offset = 0; i < table.width; offset += columns[i++].bytes)
        store_check(store, H5Tinsert(record, cell_at(&table, 0, i), offset, columns[i].type));
    for (size_t row = 1; row < table.rows; row++)
        for (size_t i = 0; i < table.width; at += columns[i++].bytes)
            write_cell(&columns[i], cell_at(&table, row, i), at);
    store_list(store, store->file, "table", record, table.rows - 1, records);
    free(records);
    free(columns);
    free(table.cells);
}
