// light.h: canvases whose light does not end at 1 (spec canvas.md 1.5): Cairo makes figures, of 8 bits; colours are
// made (shade.h) and combined here, as numbers.
#ifndef PETRI_DRAW_LIGHT_H
#define PETRI_DRAW_LIGHT_H

#include "draw/shade.h"
#include "draw/sheets.h"

// Draws the current path; an image within the clip; a sheet at x, y of the target, within
// it.
void light_figure(Canvas *canvas, const ListCommand *command, const ListPaint *paint);
void light_image(Canvas *canvas, const ListPaint *paint, const Shade *image);
void light_lay(Canvas *canvas, const Sheet *sheet, double x, double y, int composite);
// Begins a layer; what was there before. Lays it over that.
Sheet light_begin(Canvas *canvas);
void light_end(Canvas *canvas, Sheet below, double alpha);

#endif
