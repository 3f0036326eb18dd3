// render_graph_walk.h: internal declarations of the files that render a frame's tree of pictures; see render_graph.h.
#pragma once

#include "picture/painter.h"

// State of a node, kept until the next frame. In that frame, a node with the same parent, kind, tags and id continues
// the state; images must also have the same file. Each state is continued at most once. If several states match a node,
// the node continues the first one that is left.
typedef struct GraphNode GraphNode;
struct GraphNode {
    uint8_t kind;
    bool matched; // true if a node of the next frame has continued this state
    Str tags;
    Str id;
    Str file;
    Texture *picture;    // the node's picture; NULL: none
    GraphNode *children; // the state of each child of the node
    uint32_t count;
};

// A picture that can be referenced by its id.
typedef struct NamedPicture {
    Str id;
    Texture *picture;
} NamedPicture;

typedef struct Frame {
    Arena arena;   // holds all other data of the frame
    GraphNode top; // the windows are its children
    NamedPicture *known;
    uint32_t known_count;
    uint32_t known_capacity;
    Recorded *records;
    uint32_t record_count;
} Frame;

struct RenderGraph {
    Frame frames[2];
    double beat; // beat of the last frame
    int now;     // index in `frames` of the current or last frame
};

typedef struct Walk {
    PetriPainter *painter;
    const CanvasPicture *picture;
    DiagSink *diags;
    Frame *frame;
    const Frame *before; // the previous frame
    int bits;            // bits per channel of the window
    int depth;           // nesting depth of the node that is being rendered
    bool gpu;            // true if the context of the GPU is current in this thread
    double beat;         // beat of the previous frame
    Texture *shown;
} Walk;

// render_graph.c
void render_graph_clear_frame(Frame *frame);
void render_graph_name(Walk *walk, Str id, Texture *picture);
// Returns the child of `past` that the state `state` continues, and marks it as matched. Returns NULL if there is none.
const GraphNode *render_graph_find_past(const GraphNode *past, const GraphNode *state);
// Allocates the state of a node's children.
void render_graph_alloc_children(Walk *walk, GraphNode *state, uint32_t count);

// render_graph_nodes.c
// Returns the bits per channel that a node sets, or else `bits`.
int render_graph_bits(const DrawNode *node, int bits);
// Returns true if a picture can have this size. If not, reports it.
bool render_graph_check_size(Walk *walk, const DrawNode *node, int width, int height);
// These functions return a new picture. If there is none, they report this and return NULL.
Texture *render_graph_draw_canvas(Walk *walk, const DrawNode *node, int width, int height);
// Returns NULL, without a report, if the image node names no file.
Texture *render_graph_load_image(Walk *walk, const DrawNode *node);
// Composites the inputs, with the node's effect if there is a GPU. `past` is the node's state in the previous frame.
Texture *render_graph_run_effect(Walk *walk, const DrawNode *node, const GraphNode *past, Texture *const *inputs,
                                 uint32_t count, int width, int height);
// Renders a scene, and the views of its secondary cameras, which are stored like children of the node.
Texture *render_graph_draw_scene(Walk *walk, const DrawNode *node, GraphNode *state, int width, int height);
// Adds a `!record` with its picture to the records of the frame.
void render_graph_add_record(Walk *walk, const DrawNode *node, Texture *texture);
