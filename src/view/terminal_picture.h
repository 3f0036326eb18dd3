// terminal_picture.h: converts a picture to text for a terminal: Kitty or Sixel graphics if the terminal supports them,
// else cells of Unicode characters (ASCII if the locale is not UTF-8) in its colours.
//
// To show one picture, as in still.h:
//     TerminalPicture *way = terminal_picture_new(STDOUT_FILENO, true);
//     TerminalCells cells = terminal_picture_fit(way, columns, rows, width, height);   // of the picture as it is
//     ... draw it with cells.width x cells.height pixels ...
//     char *text = terminal_picture_text(way, pixels, &cells, &length);
// and write the text and a newline. Built without libchafa, terminal_picture_new returns NULL.
#ifndef PETRI_SRC_TERMINAL_PICTURE_H
#define PETRI_SRC_TERMINAL_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The capabilities of a terminal.
typedef struct TerminalPicture TerminalPicture;

// The size of a picture in a terminal.
typedef struct TerminalCells {
    int columns;
    int rows;
    int width; // pixels that the picture should be drawn with
    int height;
} TerminalCells;

// Returns true if petri was built with libchafa.
bool terminal_picture_possible(void);
// Returns a renderer for the terminal of `fd`, chosen by the environment (TERM and variables set by terminals). Without
// `colour` it is black and white. Returns NULL if out of memory or without libchafa.
TerminalPicture *terminal_picture_new(int fd, bool colour);
// NULL is ignored.
void terminal_picture_free(TerminalPicture *renderer);
// Returns true if pictures are graphics, which cover the text and must be deleted, rather than cells.
bool terminal_picture_is_graphics(const TerminalPicture *renderer);
// Returns the largest cells for a picture of width x height (above 0) within columns x rows. The terminal is asked for
// the shape of its cells.
TerminalCells terminal_picture_fit(const TerminalPicture *renderer, int columns, int rows, int width, int height);
// Returns the text for cells->width x cells->height pixels, row by row: 32 bits each, alpha in the highest byte, then
// premultiplied red, green and blue. Lines are separated by newlines. The caller frees it with free. Returns NULL if
// out of memory.
char *terminal_picture_text(TerminalPicture *renderer, const uint32_t *pixels, const TerminalCells *cells,
                            size_t *length);

#endif
