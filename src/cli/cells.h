// cells.h: the cells of tables as bytes, in which numbers keep their kind and all their bits.
//
// A cell is a byte with its kind, followed by nothing, by the eight bytes of a number, lowest first, or by a text and a
// NUL. Workers of a sweep send such cells, journals and caches store them, and petri-hdf5 receives them.
#pragma once

#include "cli/memory.h"

// Ordered: a column that has cells of several kinds has the highest of them.
typedef enum CellKind { CELL_NONE, CELL_INTEGER, CELL_NUMBER, CELL_TEXT } CellKind;

typedef struct Cell {
    CellKind kind;
    union {
        int64_t integer;
        double number;
        const char *text;
    } as;
} Cell;

// Appends a cell. Control characters of a text become spaces.
void cell_add(Text *cells, Cell cell);
// Reads the first cell of *cells and removes it. The text of a cell is valid as long as the bytes. Returns false at the
// end, or if the bytes are not a cell.
bool cell_next(Str *cells, Cell *cell);
