// cells.c: see cells.h.
#include "cli/cells.h"

#include <string.h>

enum { NUMBER_BYTES = 8 };

void cell_add(Text *cells, Cell cell) {
    text_add_char(cells, (char)cell.kind);
    if (cell.kind == CELL_TEXT) {
        for (const char *c = cell.as.text; *c != '\0'; c++)
            text_add_char(cells, (unsigned char)*c < ' ' ? ' ' : *c);
        text_add_char(cells, '\0');
    } else if (cell.kind != CELL_NONE) {
        for (int i = 0; i < NUMBER_BYTES; i++)
            text_add_char(cells, (char)((uint64_t)cell.as.integer >> 8 * i));
    }
}

bool cell_next(Str *cells, Cell *cell) {
    if (cells->len == 0 || (unsigned char)cells->bytes[0] > CELL_TEXT)
        return false;
    const char *contents = cells->bytes + 1;
    size_t rest = cells->len - 1;
    *cell = (Cell){.kind = (CellKind)cells->bytes[0]};
    size_t length = cell->kind == CELL_NONE ? 0 : cell->kind == CELL_TEXT ? strnlen(contents, rest) + 1 : NUMBER_BYTES;
    if (length > rest)
        return false;
    if (cell->kind == CELL_TEXT)
        cell->as.text = contents;
    for (size_t i = 0; cell->kind != CELL_TEXT && i < length; i++)
        cell->as.integer |= (int64_t)((uint64_t)(unsigned char)contents[i] << 8 * i);
    *cells = (Str){contents + length, rest - length};
    return true;
}
