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
    size_t bytes;  // size of a cell
    size_t offset; // of a cell in a record
    hid_t type;
} Column;

typedef struct Table {
    char *records;
    size_t bytes; // size of a record
    size_t rows;
    size_t width; // number of columns
    size_t parameters;
    Column *columns; // run, the parameters, and others
} Table;

static char *cell_at(const Table *table, size_t row, size_t column) {
    return &table->records[row * table->bytes + table->columns[column].offset];
}

// Returns the text of a cell in a column of strings. `digits` has space for it.
static const char *text_of(Cell cell, char digits[NUMBER_TEXT]) {
    digits[0] = '\0';
    if (cell.kind == CELL_NUMBER)
        number_format(cell.as.number, digits);
    return cell.kind == CELL_TEXT ? cell.as.text : digits;
}

static void write_cell(const Column *column, Cell cell, char *out) {
    char digits[NUMBER_TEXT];
    const char *text = text_of(cell, digits);
    if (cell.kind == CELL_NONE)
        cell.as.number = NAN;
    if (column->kind == CELL_TEXT)
        memcpy(out, text, strlen(text) + 1);
    else
        memcpy(out, &cell.as, column->bytes);
}

// Chooses the types of columns. `rows` are the cells of all rows.
static void choose_types(Table *table, Str rows) {
    Cell cell;
    size_t count = 0;
    for (; cell_next(&rows, &cell); count++) {
        Column *column = &table->columns[count % table->width];
        char digits[NUMBER_TEXT];
        size_t bytes = strlen(text_of(cell, digits)) + 1;
        column->kind = cell.kind > column->kind ? cell.kind : column->kind;
        column->bytes = bytes > column->bytes ? bytes : column->bytes;
    }
    table->rows = count / table->width;
    for (Column *column = table->columns; column < table->columns + table->width; column++) {
        column->type = column->kind == CELL_INTEGER  ? H5Tcopy(H5T_NATIVE_INT64)
                       : column->kind == CELL_NUMBER ? H5Tcopy(H5T_NATIVE_DOUBLE)
                                                     : store_text_type(column->bytes - 1);
        column->bytes = H5Tget_size(column->type);
        column->offset = table->bytes;
        table->bytes += column->bytes;
    }
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
        table.columns[i] = (Column){.name = cell.as.text, .bytes = 1};
        cell_next(&data, &cell);
        table.columns[i].kind = (CellKind)cell.as.integer;
    }
    choose_types(&table, data);
    table.records = memory_calloc(table.rows * table.bytes);
    for (size_t i = 0; i < table.rows * table.width && cell_next(&data, &cell); i++)
        write_cell(&table.columns[i % table.width], cell, cell_at(&table, i / table.width, i % table.width));
    return table;
}

// The dimensions of a table with one row for each combination of values, in the order of petri sweep.
typedef struct Grid {
    int rank;
    hsize_t sizes[H5S_MAX_RANK];  // number of values of each parameter
    size_t strides[H5S_MAX_RANK]; // number of rows with the same value of a parameter, one after the other
} Grid;

static bool cells_equal(const Table *table, size_t column, size_t a, size_t b) {
    return memcmp(cell_at(table, a, column), cell_at(table, b, column), table->columns[column].bytes) == 0;
}

static bool is_grid(const Table *table, const Grid *grid) {
    for (size_t row = 0; row < table->rows; row++)
        for (int k = 0; k < grid->rank; k++) {
            size_t value = row / grid->strides[k] % grid->sizes[k] * grid->strides[k];
            if (!cells_equal(table, (size_t)k + 1, row, value))
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
        while (count * stride < table->rows && !cells_equal(table, k, count * stride, 0))
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
    bool texts = column.kind == CELL_TEXT;
    if (texts)
        column.type = any_text_type();
    column.bytes = H5Tget_size(column.type);
    char *cells = memory_calloc(count * column.bytes);
    for (size_t i = 0; i < count; i++) {
        const char *cell = cell_at(table, i * stride, number);
        memcpy(cells + i * column.bytes, texts ? (const void *)&cell : cell, column.bytes);
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
    hid_t record = H5Tcreate(H5T_COMPOUND, table.bytes);
    for (size_t i = 0; i < table.width; i++)
        store_check(store, H5Tinsert(record, table.columns[i].name, table.columns[i].offset, table.columns[i].type));
    store_list(store, store->file, "table", record, table.rows, table.records);
    Grid grid;
    if (are_names(&table) && find_grid(&table, &grid))
        store_grid(store, &table, &grid);
    free(table.columns);
    free(table.records);
}
