// read.h: translates the nodes of a window to a drawing.
#ifndef PETRI_CANVAS_READ_H
#define PETRI_CANVAS_READ_H

#include "canvas/drawing.h"

// Returns the next window of a frame's tree, `!window` or `!offscreen`, from element *at on, and moves *at to the
// element after it. Returns NULL if there is none.
const Node *canvas_next_window(const Schema *schema, Value tree, uint32_t *at);
// Limit of the nodes that are checked before a window is read. A node can occur many times in a tree that a short
// script builds. Larger windows count as having a picture, and reading them then exceeds the limits of work and memory.
enum { CANVAS_MAX_CHECKED = 1 << 22 };
// Returns true if the window contains a `!canvas` or another node that makes a picture.
bool canvas_window_has_picture(const Schema *schema, const Node *window);

// Copies a `!window` or `!offscreen` into the arena. Unknown, misplaced and malformed nodes are reported and left out.
const DrawNode *canvas_read(Schema *schema, Arena *arena, const Node *window);

#endif
