// terminal_picture.h: a picture as text that a terminal shows: kitty's or sixel graphics where it has them, else cells
// of Unicode (or ASCII, unless the locale is UTF-8), in the colours that it has.
//
// To show one picture, as still.h does:
//     TerminalPicture *way = terminal_picture_new(STDOUT_FILENO, true);
//     TerminalCells cells = terminal_picture_fit(way, columns, rows, width, height);   // of the picture as it is
//     ... draw it with cells.width x cells.height pixels ...
//     char *text = terminal_picture_text(way, pixels, &cells, &length);
// and write the text and a newline. Built without libchafa, terminal_picture_new gives NULL.
#ifndef PETRI_SRC_TERMINAL_PICTURE_H
#define PETRI_SRC_TERMINAL_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// How a terminal shows pictures.
typedef struct TerminalPicture TerminalPicture;

// What a picture takes.
typedef struct TerminalCells {
    int columns;
    int rows;
    int width; // pixels that are worth drawing
    int height;
} TerminalCells;

// Whether petri was built with libchafa.
bool terminal_picture_possible(void);
// For the terminal that `fd` is, by the environment (TERM and what terminals set). Without colour: in black and white.
// NULL without libchafa or memory.
TerminalPicture *terminal_picture_new(int fd, bool colour);
// NULL is fine.
void terminal_picture_free(TerminalPicture *renderer);
// Whether pictures are graphics, which lie over the text and must be taken away, rather than cells.
bool terminal_picture_is_graphics(const TerminalPicture *renderer);
// The cells for a picture of width x height, above 0, that has at most columns x rows cells; the shape of the cells is
// asked of the terminal.
TerminalCells terminal_picture_fit(const TerminalPicture *renderer, int columns, int rows, int width, int height);
// The text for cells->width x cells->height pixels, rows following each other: 32 bits each, alpha in the highest byte,
// then red, green, blue, multiplied by alpha. The lines are divided by newlines; the last has none. To be freed by the
// caller; NULL if memory is used up.
char *terminal_picture_text(TerminalPicture *renderer, const uint32_t *pixels, const TerminalCells *cells,
                            size_t *length);

#endif
