// read.h: from a window's nodes to a drawing.
#ifndef PETRI_CANVAS_READ_H
#define PETRI_CANVAS_READ_H

#include "canvas/drawing.h"

// Copies a `!window` or `!offscreen` into the arena. What is unknown, misplaced or malformed is reported and left out.
const DrawNode *canvas_read(Schema *schema, Arena *arena, const Node *window);

#endif
