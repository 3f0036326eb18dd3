// terminal_picture.h: converts a picture to text for a terminal: Kitty or Sixel graphics if the terminal supports them,
// else cells of Unicode characters (ASCII if the locale is not UTF-8) in the terminal's colours.
//
// To show one picture, as in still.h:
//     TerminalPicture *renderer = terminal_picture_new(STDOUT_FILENO, true);
//     TerminalCells cells = terminal_picture_fit(renderer, columns, rows, width, height);   // the size of the script
//     ... draw it with cells.width x cells.height pixels ...
//     char *text = terminal_picture_text(renderer, pixels, &cells, &length);
// and write the text and a newline. If petri was built without libchafa, terminal_picture_new returns NULL.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Converts pictures for one terminal according to its capabilities.
typedef struct TerminalPicture TerminalPicture;

// The size of a picture in a terminal.
typedef struct TerminalCells {
    int columns;
    int rows;
    int width; // size in pixels at which to draw the picture
    int height;
} TerminalCells;

// Returns true if petri was built with libchafa.
bool terminal_picture_possible(void);
// Returns a renderer for the terminal `fd`, whose capabilities are determined from the environment (TERM and variables
// set by terminals). If `colour` is false, pictures are black and white. Returns NULL if out of memory or if petri was
// built without libchafa.
TerminalPicture *terminal_picture_new(int fd, bool colour);
// NULL is ignored.
void terminal_picture_free(TerminalPicture *renderer);
// Returns true if pictures are graphics instead of cells. Graphics cover the text and must be deleted.
bool terminal_picture_is_graphics(const TerminalPicture *renderer);
// Returns the largest size, within columns x rows, of a picture with the aspect ratio width : height (above 0). Queries
// the terminal for the size of its cells.
TerminalCells terminal_picture_fit(const TerminalPicture *renderer, int columns, int rows, int width, int height);
// Returns a picture as text, with lines separated by newlines. The caller frees it with free. Returns NULL if out of
// memory. `pixels` has cells->width x cells->height pixels, row by row. Each has 32 bits: alpha in the highest byte,
// then premultiplied red, green and blue.
char *terminal_picture_text(TerminalPicture *renderer, const uint32_t *pixels, const TerminalCells *cells,
                            size_t *length);
