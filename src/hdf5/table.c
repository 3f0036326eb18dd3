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
    Text texts;    // contents of all cells, each NUL-terminated
    size_t *cells; // offsets of the cells in `texts`
    size_t count;  // number of cells
    size_t width;  // number of cells in a row
} Table;

// Reads the cell at *at and moves *at to the comma or newline after it.
static void read_cell(Table *table, const char **at, const char *end) {
    bool quoted = false;
    for (; *at < end && (quoted || (**at != ',' && **at != '\n')); (*at)++) {
        bool quote = **at == '"';
        if (quote && quoted && *at + 1 < end && (*at)[1] == '"') {
            (*at)++; // two quotes mean one
        } else if (quote) {
            quoted = !quoted;
            continue;
        }
        text_add(&table->texts, (Str){*at, 1});
    }
    text_add(&table->texts, (Str){"", 1});
}

static void read_csv(Table *table, const char *csv, size_t length) {
    size_t capacity = 0;
    for (const char *at = csv, *end = csv + length; at < end; at++) {
        if (table->count == capacity) {
            capacity = 2 * capacity + 64;
            table->cells = memory_realloc(table->cells, capacity * sizeof *table->cells);
        }
        table->cells[table->count++] = table->texts.len;
        read_cell(table, &at, end);
        if (table->width == 0 && (at == end || *at == '\n'))
            table->width = table->count;
    }
}

static const char *cell_at(const Table *table, size_t row, size_t column) {
    return table->texts.bytes + table->cells[row * table->width + column];
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
static Column choose_column(const Table *table, size_t number, size_t rows) {
    Column column = {.kind = number + 1 == table->width ? TEXT : INTEGER};
    size_t max_length = 0;
    for (size_t row = 1; row < rows; row++) {
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

void table_store(Store *store, const char *csv, size_t length) {
    Table table = {0};
    read_csv(&table, csv, length);
    size_t rows = table.width == 0 ? 0 : table.count / table.width, bytes = 0;
    Column *columns = memory_calloc(table.width * sizeof *columns);
    for (size_t i = 0; i < table.width; i++) {
        columns[i] = choose_column(&table, i, rows);
        bytes += columns[i].bytes;
    }
    char *records = memory_calloc(rows * bytes), *at = records;
    hid_t record = H5Tcreate(H5T_COMPOUND, bytes > 0 ? bytes : 1);
    for (size_t i = 0, offset = 0; i < table.width; offset += columns[i++].bytes)
        store_check(store, H5Tinsert(record, cell_at(&table, 0, i), offset, columns[i].type));
    for (size_t row = 1; row < rows; row++)
        for (size_t i = 0; i < table.width; at += columns[i++].bytes)
            write_cell(&columns[i], cell_at(&table, row, i), at);
    store_list(store, store->file, "table", record, rows > 0 ? rows - 1 : 0, records);
    free(records);
    free(columns);
    free(table.cells);
    text_free(&table.texts);
}
