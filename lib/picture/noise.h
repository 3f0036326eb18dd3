// noise.h: noise as a paint source (spec canvas.md 5.5): the noise of SVG's feTurbulence, and Perlin's improved noise.
#pragma once

#include "picture/display_list.h"
#include "schema/table.h"

// Fills premultiplied ARGB32 pixels, rows without gaps, whose top left corner is at left, top. `to_units` maps pixels
// to the units of the source.
void noise_fill(const NOISEOperands *source, const DisplayMatrix *to_units, int left, int top, double alpha,
                uint32_t *pixels, int width, int height);
