// render_graph.h: makes the tree of pictures of a frame (spec pictures.md 2 to 5): canvases, images, programs over
// them.
//
// Each node makes one picture, children first. What has an id is known to those that ask for it later, in this frame or
// in the next. A painter keeps the last frame's pictures for that: frames whose trees look back (petri_needs_history)
// must all be made by one painter, in their order.
#ifndef PETRI_DRAW_RENDER_GRAPH_H
#define PETRI_DRAW_RENDER_GRAPH_H

#include "draw/cairo_canvas.h"

typedef struct RenderGraph RenderGraph; // what is kept from frame to frame

// NULL if memory is used up.
RenderGraph *render_graph_new(void);
void render_graph_free(PetriPainter *painter); // those of a painter

// What the next frame would continue.
void render_graph_clear(PetriPainter *painter);

// Makes all pictures of a frame. *shown is the one of the picture's window, or NULL if it has none; it is kept until
// the next call, as are the records. What cannot be made is reported and left out. PETRI_OK,
// PETRI_OUT_OF_MEMORY, or PETRI_INVALID after an error.
PetriStatus render_graph_run(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults, Texture **shown);
const Recorded *render_graph_records(const RenderGraph *pictures, uint32_t *count);
// The picture with this id, as it is known now; NULL: none. Borrowed.
Texture *render_graph_find(const RenderGraph *pictures, Str id);

// The size of a node's picture in one that is width x height large.
void render_graph_node_size(const DrawNode *node, int *width, int *height);
// The canvas whose pixels are the picture of a node of that size as they are, in whatever size they are drawn; NULL if
// programs are needed, or pictures are mixed.
const DrawNode *render_graph_direct_canvas(const DrawNode *node, int width, int height);
// Returns true if the picture looks alike, but for sharpness, when it is made with fewer pixels: no node of the tree
// has a shader written by the script, or patterns that are measured in pixels.
bool render_graph_scalable(const DrawNode *node);
// The pixels of `side` units; at least 1.
int render_graph_pixels(int side, double detail);
// Can its result be made by mixing what is inside?
bool render_graph_is_plain(const DrawNode *node);

#endif
