// sheets.h: pixels as numbers, for what Cairo does not do: filters, canvases of more than 8 bits.
#ifndef PETRI_DRAW_SHEETS_H
#define PETRI_DRAW_SHEETS_H

#include "draw/draw.h"

enum { SHEET_WIDEST = 256 }; // standard deviation of a blur, pixels

// A cleared one, charged to the picture's memory. Without memory, and of what has none, `pixels` is NULL; what follows
// then does nothing. What is not freed is freed when the drawing ends.
Sheet sheet_new(Canvas *canvas, int width, int height);
void sheet_free(Canvas *canvas, Sheet *sheet);
void sheets_free_all(Canvas *canvas);
Sheet sheet_copy(Canvas *canvas, const Sheet *sheet);

// From and to ARGB32 pixels.
Sheet sheet_take(Canvas *canvas, cairo_surface_t *surface);
void sheet_put(const Sheet *sheet, cairo_surface_t *surface);

// In place; lengths in pixels. What they cost does not grow with them.
void sheet_blur(Canvas *canvas, Sheet *sheet, const double sigma[2]);
void sheet_spread(Canvas *canvas, Sheet *sheet, const double radius[2], bool least);
void sheet_move(Canvas *canvas, Sheet *sheet, double dx, double dy);
// Gives all of it one colour, and leaves its alpha, times that of the colour.
void sheet_shade(Sheet *sheet, const double color[4]);
void sheet_lay_over(Sheet *below, const Sheet *above);
void sheet_fill(Sheet *sheet, const double color[4]);
// Four rows of five numbers, on colours that are not multiplied by alpha.
void sheet_recolor(Sheet *sheet, const double *matrix);
// k: of the product, of s, of d, and what is added. Without k the mode counts. Into d.
void sheet_combine(Sheet *d, const Sheet *s, const double *k, CompositeMode mode);

#endif
