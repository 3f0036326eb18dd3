// table.c: see table.h.
//
// The rows are written as records of one table. If they form a grid of parameter values, each column is also written as
// an array with one dimension per parameter.
#include "hdf5/table.h"

#include "base/number.h"
#include "cli/cells.h"
#include "hdf5/scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Column {
    const char *name;
    CellKind kind;
    size_t bytes; // size of a cell in a record
    hid_t type;
} Column;

typedef struct Table {
    Cell *cells; // by row
    size_t rows;
    size_t width;      // number of cells in a row
    size_t parameters; // the columns after the first
    Column *columns;
    TextList texts; // of numbers in columns of strings
} Table;

static Cell *cell_at(const Table *table, size_t row, size_t column) {
    return &table->cells[row * table->width + column];
}

// Chooses the type of a column, whose name and kind are set. In a column of strings, makes all cells texts.
static void choose_type(Table *table, size_t number) {
    Column *column = &table->columns[number];
    size_t max_length = 0;
    for (size_t row = 0; row < table->rows; row++)
        if (cell_at(table, row, number)->kind == CELL_TEXT)
            column->kind = CELL_TEXT;
    for (size_t row = 0; row < table->rows && column->kind == CELL_TEXT; row++) {
        Cell *cell = cell_at(table, row, number);
        if (cell->kind == CELL_NUMBER) {
            char digits[NUMBER_TEXT];
            number_format(cell->as.number, digits);
            texts_add(&table->texts, digits);
        }
        if (cell->kind != CELL_TEXT)
            *cell = (Cell){CELL_TEXT,
                           {.text = cell->kind == CELL_NUMBER ? table->texts.items[table->texts.count - 1] : ""}};
        size_t length = strlen(cell->as.text);
        max_length = length > max_length ? length : max_length;
    }
    column->type = column->kind == CELL_INTEGER  ? H5Tcopy(H5T_NATIVE_INT64)
                   : column->kind == CELL_NUMBER ? H5Tcopy(H5T_NATIVE_DOUBLE)
                                                 : store_text_type(max_length);
    column->bytes = H5Tget_size(column->type);
}

// Reads the data of hdf5_table.
static Table read_table(Str data) {
    Table table = {0};
    Cell cell = {.kind = CELL_NONE};
    cell_next(&data, &cell);
    table.width = (size_t)cell.as.integer;
    cell_next(&data, &cell);
    table.parameters = (size_t)cell.as.integer;
    table.columns = memory_calloc(table.width * sizeof *table.columns);
    for (size_t i = 0; i < table.width; i++) {
        cell_next(&data, &cell);
        table.columns[i].name = cell.as.text;
        cell_next(&data, &cell);
        table.columns[i].kind = (CellKind)cell.as.integer;
    }
    size_t count = 0;
    for (Str rest = data; cell_next(&rest, &cell);)
        count++;
    table.cells = memory_calloc(count * sizeof cell);
    for (size_t i = 0; i < count; i++)
        cell_next(&data, &table.cells[i]);
    table.rows = count / table.width;
    for (size_t i = 0; i < table.width; i++)
        choose_type(&table, i);
    return table;
}

static void write_cell(const Column *column, Cell cell, char *out) {
    if (cell.kind == CELL_NONE)
        cell.as.number = NAN;
    if (column->kind == CELL_TEXT)
        memcpy(out, cell.as.text, strlen(cell.as.text) + 1);
    else
        memcpy(out, &cell.as, column->bytes);
}

// The dimensions of a table with one row for each combination of values, in the order of petri sweep.
typedef struct Grid {
    int rank;
    hsize_t sizes[H5S_MAX_RANK];  // number of values of each parameter
    size_t strides[H5S_MAX_RANK]; // number of rows with the same value of a parameter, one after the other
} Grid;

static bool is_grid(const Table *table, const Grid *grid) {
    for (size_t row = 0; row < table->rows; row++)
        for (int k = 0; k < grid->rank; k++) {
            size_t value = row / grid->strides[k] % grid->sizes[k] * grid->strides[k];
            if (!cell_equal(cell_at(table, row, (size_t)k + 1), cell_at(table, value, (size_t)k + 1)))
                return false;
        }
    return true;
}

// Finds the dimensions of a table. Returns false if it has other rows, such as those of a sample or of several frames.
static bool find_grid(const Table *table, Grid *grid) {
    size_t stride = 1;
    grid->rank = (int)table->parameters;
    if (table->parameters == 0 || table->parameters > H5S_MAX_RANK)
        return false;
    for (size_t k = table->parameters; k > 0; k--) {
        size_t count = 1;
        while (count * stride < table->rows && !cell_equal(cell_at(table, count * stride, k), cell_at(table, 0, k)))
            count++;
        grid->sizes[k - 1] = count;
        grid->strides[k - 1] = stride;
        stride *= count;
    }
    return stride == table->rows && is_grid(table, grid);
}

// Returns a type for texts of any length, in memory: const char *. Debian's libnetcdf cannot read texts of fixed
// length.
static hid_t any_text_type(void) {
    hid_t type = store_text_type(0);
    H5Tset_size(type, H5T_VARIABLE);
    return type;
}

// Writes every `stride`-th cell of a column as a data set.
static hid_t store_cells(Store *store, const Table *table, size_t number, int rank, const hsize_t *sizes,
                         size_t stride) {
    size_t count = 1;
    for (int k = 0; k < rank; k++)
        count *= sizes[k];
    Column column = table->columns[number];
    if (column.kind == CELL_TEXT)
        column =
            (Column){.name = column.name, .kind = CELL_TEXT, .bytes = sizeof(const char *), .type = any_text_type()};
    char *cells = memory_calloc(count * column.bytes);
    for (size_t i = 0; i < count; i++) {
        const Cell *cell = cell_at(table, i * stride, number);
        if (column.kind == CELL_TEXT)
            memcpy(cells + i * column.bytes, &cell->as.text, column.bytes);
        else
            write_cell(&column, *cell, cells + i * column.bytes);
    }
    hid_t set = store_array(store, store->file, column.name, column.type, rank, sizes, cells);
    free(cells);
    return set;
}

// Writes each column after the parameters as an array whose dimensions are the parameters.
static void store_grid(Store *store, const Table *table, const Grid *grid) {
    Scale scales[H5S_MAX_RANK], *dimensions[H5S_MAX_RANK];
    for (int k = 0; k < grid->rank; k++) {
        size_t number = (size_t)k + 1;
        hid_t set = store_cells(store, table, number, 1, &grid->sizes[k], grid->strides[k]);
        scales[k] = scale_begin(store, set, table->columns[number].name);
        dimensions[k] = &scales[k];
    }
    for (size_t i = (size_t)grid->rank + 1; i < table->width; i++)
        scale_attach(store, store_cells(store, table, i, grid->rank, grid->sizes, 1), grid->rank, dimensions);
    for (int k = 0; k < grid->rank; k++)
        scale_end(store, &scales[k]);
}

// Returns true if each column can be a data set beside `table`.
static bool are_names(const Table *table) {
    for (size_t i = 0; i < table->width; i++) {
        const char *name = table->columns[i].name;
        if (name[0] == '\0' || strcmp(name, "table") == 0 || strcmp(name, ".") == 0 || strchr(name, '/'))
            return false;
    }
    return true;
}

void table_store(Store *store, const char *data, size_t length) {
    Table table = read_table((Str){data, length});
    size_t bytes = 0, offset = 0;
    for (size_t i = 0; i < table.width; i++)
        bytes += table.columns[i].bytes;
    char *records = memory_calloc(table.rows * bytes), *at = records;
    hid_t record = H5Tcreate(H5T_COMPOUND, bytes);
    for (size_t i = 0; i < table.width; offset += table.columns[i++].bytes)
        store_check(store, H5Tinsert(record, table.columns[i].name, offset, table.columns[i].type));
    for (size_t row = 0; row < table.rows; row++)
        for (size_t i = 0; i < table.width; at += table.columns[i++].bytes)
            write_cell(&table.columns[i], *cell_at(&table, row, i), at);
    store_list(store, store->file, "table", record, table.rows, records);
    free(records);
    Grid grid;
    if (are_names(&table) && find_grid(&table, &grid))
        store_grid(store, &table, &grid);
    free(table.columns);
    free(table.cells);
    texts_free(&table.texts);
}
