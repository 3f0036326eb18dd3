// table.c: see table.h.
#include "hdf5/table.h"

#include "cli/memory.h"
#include "hdf5/scale.h"

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

// The dimensions of a table with one row for each combination of values, in the order of petri sweep.
typedef struct Grid {
    int rank;
    hsize_t sizes[H5S_MAX_RANK];  // number of values of each parameter
    size_t strides[H5S_MAX_RANK]; // number of rows with the same value of a parameter, one after the other
} Grid;

// Returns the number of parameters: their columns are between `run` and `frame`.
static size_t count_parameters(const Table *table) {
    size_t end = 1;
    while (end < table->width && strcmp(cell_at(table, 0, end), "frame") != 0)
        end++;
    return end - 1;
}

static bool is_grid(const Table *table, const Grid *grid, size_t rows) {
    for (size_t row = 0; row < rows; row++)
        for (int k = 0; k < grid->rank; k++) {
            size_t value = row / grid->strides[k] % grid->sizes[k] * grid->strides[k];
            if (strcmp(cell_at(table, row + 1, (size_t)k + 1), cell_at(table, value + 1, (size_t)k + 1)) != 0)
                return false;
        }
    return true;
}

// Finds the dimensions of a table. Returns false if it has other rows, such as those of a sample or of several frames.
static bool find_grid(const Table *table, Grid *grid) {
    size_t parameters = count_parameters(table), rows = table->rows - 1, stride = 1;
    grid->rank = (int)parameters;
    if (parameters == 0 || parameters > H5S_MAX_RANK)
        return false;
    for (size_t k = parameters; k > 0; k--) {
        size_t count = 1;
        while (count * stride < rows && strcmp(cell_at(table, count * stride + 1, k), cell_at(table, 1, k)) != 0)
            count++;
        grid->sizes[k - 1] = count;
        grid->strides[k - 1] = stride;
        stride *= count;
    }
    return stride == rows && is_grid(table, grid, rows);
}

// Returns a type for texts of any length, in memory: const char *. Debian's libnetcdf cannot read texts of fixed
// length.
static hid_t any_text_type(void) {
    hid_t type = store_text_type(0);
    H5Tset_size(type, H5T_VARIABLE);
    return type;
}

// Writes every `stride`-th cell of a column as a data set.
static hid_t store_cells(Store *store, const Table *table, const Column *columns, size_t number, int rank,
                         const hsize_t *sizes, size_t stride) {
    size_t count = 1;
    for (int k = 0; k < rank; k++)
        count *= sizes[k];
    Column column = columns[number];
    if (column.kind == TEXT)
        column = (Column){.kind = TEXT, .bytes = sizeof(const char *), .type = any_text_type()};
    char *cells = memory_calloc(count * column.bytes);
    for (size_t i = 0; i < count; i++) {
        const char *text = cell_at(table, i * stride + 1, number);
        if (column.kind == TEXT)
            memcpy(cells + i * column.bytes, &text, sizeof text);
        else
            write_cell(&column, text, cells + i * column.bytes);
    }
    hid_t set = store_array(store, store->file, cell_at(table, 0, number), column.type, rank, sizes, cells);
    free(cells);
    return set;
}

// Writes each column after the parameters as an array whose dimensions are the parameters.
static void store_grid(Store *store, const Table *table, const Column *columns, const Grid *grid) {
    Scale scales[H5S_MAX_RANK], *dimensions[H5S_MAX_RANK];
    for (int k = 0; k < grid->rank; k++) {
        size_t number = (size_t)k + 1;
        hid_t set = store_cells(store, table, columns, number, 1, &grid->sizes[k], grid->strides[k]);
        scales[k] = scale_begin(store, set, cell_at(table, 0, number));
        dimensions[k] = &scales[k];
    }
    for (size_t i = (size_t)grid->rank + 1; i < table->width; i++)
        scale_attach(store, store_cells(store, table, columns, i, grid->rank, grid->sizes, 1), grid->rank, dimensions);
    for (int k = 0; k < grid->rank; k++)
        scale_end(store, &scales[k]);
}

// Returns true if each column can be a data set beside `table`.
static bool are_names(const Table *table) {
    for (size_t i = 0; i < table->width; i++) {
        const char *name = cell_at(table, 0, i);
        if (name[0] == '\0' || strcmp(name, "table") == 0 || strcmp(name, ".") == 0 || strchr(name, '/'))
            return false;
    }
    return true;
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
    Grid grid;
    if (are_names(&table) && find_grid(&table, &grid))
        store_grid(store, &table, columns, &grid);
    free(columns);
    free(table.cells);
}
