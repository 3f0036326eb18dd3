// render_graph.h: renders a frame's tree of pictures (spec pictures.md 2 to 5): canvases, images, and effects on them.
//
// Each node produces one picture, after its children. A picture with an id can be referenced by later nodes of the same
// frame and by nodes of the next frame. Therefore a painter keeps the pictures of the last frame. If a script has such
// references (petri_needs_history), one painter must render all frames in order.
#pragma once

#include "picture/canvas_picture.h"

typedef struct RenderGraph RenderGraph; // state that is kept from frame to frame

// Returns NULL if out of memory.
RenderGraph *render_graph_new(void);
void render_graph_free(PetriPainter *painter); // frees the graph of a painter

// Frees all pictures and other state that the next frame would continue.
void render_graph_clear(PetriPainter *painter);

// Renders all pictures of a frame. *shown receives the picture of the window, or NULL if the window has none. The
// picture and the records are valid until the next call. Pictures that cannot be rendered are reported and left out.
// Returns PETRI_OK, PETRI_OUT_OF_MEMORY, or PETRI_INVALID after an error.
PetriStatus render_graph_run(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags, Texture **shown);
// Returns the picture of the window that `picture` shows. The last call of render_graph_run must have been for it.
Texture *render_graph_window(const RenderGraph *pictures, const CanvasPicture *picture);
const Recorded *render_graph_records(const RenderGraph *pictures, uint32_t *count);
// Returns the picture with this id in the current frame or, if there is none, in the previous frame. Returns NULL if
// there is none in either. The picture is borrowed.
Texture *render_graph_find(const RenderGraph *pictures, Str id);

// Computes the size of a node's picture in pixels. On entry, *width and *height are the size of the parent's picture.
// They do not change if the node sets no size.
void render_graph_node_size(const DrawNode *node, int *width, int *height);
// Returns the canvas whose pixels equal the node's picture. This canvas can be drawn directly at any resolution.
// Returns NULL if the picture needs effects, compositing or linear light.
const DrawNode *render_graph_direct_canvas(const DrawNode *node, int width, int height);
// Returns true if fewer pixels would change only the sharpness of the picture. This is the case if no node of the tree
// has a custom shader or a pattern measured in pixels.
bool render_graph_scalable(const DrawNode *node);
// Converts a width or height from units to pixels. `detail` is the number of pixels per unit. The result is at least 1.
int render_graph_pixels(int side, double detail);
// Returns true if the node only composites its children, without a custom shader or an effect.
bool render_graph_is_plain(const DrawNode *node);
