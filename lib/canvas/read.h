// read.h: from a window's nodes to a drawing.
#ifndef PETRI_CANVAS_READ_H
#define PETRI_CANVAS_READ_H

#include "canvas/drawing.h"

// The windows of a frame's tree, `!window` and `!offscreen`: the first from element *at on, which is moved behind it;
// NULL without one.
const Node *canvas_next_window(const Schema *schema, Value tree, uint32_t *at);
// How many nodes are looked at before a window is read. One node may stand in a tree in very many places, by few words;
// with more than these the answer is yes, and reading finds the limits of work and memory.
enum { CANVAS_MAX_CHECKED = 1 << 22 };
// Has it a `!canvas` or something else that makes a picture?
bool canvas_window_has_picture(const Schema *schema, const Node *window);

// Copies a `!window` or `!offscreen` into the arena. What is unknown, misplaced or malformed is reported and left out.
const DrawNode *canvas_read(Schema *schema, Arena *arena, const Node *window);

#endif
