// read.h: translates the nodes of a window to a drawing.
#pragma once

#include "base/private_api.h"
#include "canvas/drawing.h"

// Returns the next window (`!window` or `!offscreen`) in a frame's tree. The search starts at element *at, and *at is
// set to the element after the window. Returns NULL if there are no more windows.
const Node *canvas_next_window(const Schema *schema, Value tree, uint32_t *at) PRIVATE_API(canvas_next_window);
// Maximum number of nodes that canvas_window_has_picture checks. A short script can build a huge tree, because a node
// can occur in it many times. A window with more nodes is assumed to have a picture. Reading such a window exceeds the
// work or memory limit.
enum { CANVAS_MAX_CHECKED = 1 << 22 };
// Returns true if the window contains a `!canvas` or another node that creates a picture.
bool canvas_window_has_picture(const Schema *schema, const Node *window) PRIVATE_API(canvas_window_has_picture);

// Copies a `!window` or `!offscreen` into the arena. Unknown, misplaced and malformed nodes are reported and left out.
const DrawNode *canvas_read(Schema *schema, Arena *arena, const Node *window) PRIVATE_API(canvas_read);
