// render_graph_run.c: renders the nodes of a frame, each after those inside it; see render_graph.h.
#include "gl/functions.h"
#include "picture/render_graph_walk.h"

enum { MAX_DEPTH = 100, DEFAULT_SIZE = 512 };

static Str text_of(Arena *arena, const DrawNode *node, AttrName name) {
    const AttrValue *attr = schema_row((NodeKind)node->kind, name) ? draw_attr(node, name) : NULL;
    return attr ? str_copy(arena, attr->as.text) : (Str){0};
}

static Texture *make_node(Walk *walk, const DrawNode *node, GraphNode *state, const GraphNode *past, int width,
                          int height);

// Renders the children. Stores the pictures that are not hidden in `inputs`, which has space for all children, and
// returns their number.
static uint32_t make_inputs(Walk *walk, const DrawNode *node, GraphNode *state, const GraphNode *past, int width,
                            int height, Texture **inputs) {
    uint32_t count = 0;
    render_graph_alloc_children(walk, state, node->child_count);
    for (uint32_t i = 0; i < node->child_count; i++) {
        const DrawNode *child = node->children[i];
        Texture *texture = make_node(walk, child, &state->children[i], past, width, height);
        bool hidden = schema_row((NodeKind)child->kind, ATTR_HIDDEN) && draw_flag(child, ATTR_HIDDEN);
        if (texture && !hidden)
            inputs[count++] = texture;
    }
    return count;
}

static Texture *make_effect_node(Walk *walk, const DrawNode *node, GraphNode *state, const GraphNode *past, int width,
                                 int height) {
    Texture **inputs = arena_alloc_array(&walk->frame->arena, node->child_count, sizeof *inputs);
    uint32_t count = make_inputs(walk, node, state, past, width, height, inputs);
    if (node->kind == KIND_OFFSCREEN && node != walk->picture->window && state->id.len == 0)
        return NULL; // no node can refer to this picture
    Texture *texture = render_graph_run_effect(walk, node, past, inputs, count, width, height);
    const AttrValue *file = node->kind == KIND_RECORD ? draw_attr(node, ATTR_FILENAME) : NULL;
    if (texture && file && file->as.text.len > 0)
        render_graph_add_record(walk, node, texture);
    return texture;
}

static Texture *find_reference(Walk *walk, Str id) {
    Texture *found = render_graph_find(walk->painter->render_graph, id);
    return found ? texture_retain(found) : NULL;
}

// Renders the picture of a node and fills `state`, the state of the node, which owns the picture. `parent` is the state
// of the node's parent in the previous frame; width x height is the size of the parent's picture. Returns NULL if the
// node has no picture.
static Texture *make_node(Walk *walk, const DrawNode *node, GraphNode *state, const GraphNode *parent, int width,
                          int height) {
    Arena *arena = &walk->frame->arena;
    *state = (GraphNode){.kind = node->kind,
                         .tags = str_copy(arena, node->tags),
                         .id = text_of(arena, node, ATTR_ID),
                         .file = text_of(arena, node, ATTR_FILENAME)};
    const GraphNode *past = render_graph_find_past(parent, state);
    if (walk->depth >= MAX_DEPTH) {
        painter_report(walk->diags, NULL, DIAG_WARNING, "too-deep",
                       "pictures are nested more than %d deep; the innermost are "
                       "left out",
                       MAX_DEPTH);
        return NULL;
    }
    walk->depth++;
    switch ((NodeKind)node->kind) {
    case KIND_POINTER:
    case KIND_KEY:
        break;
    case KIND_REFERENCE:
        state->picture = find_reference(walk, state->id);
        state->id = (Str){0};
        break;
    case KIND_PICTURE_IMAGE:
        state->picture = render_graph_load_image(walk, node);
        break;
    default:
        render_graph_node_size(node, &width, &height);
        if (!render_graph_check_size(walk, node, width, height))
            break;
        state->picture = node->kind == KIND_CANVAS     ? render_graph_draw_canvas(walk, node, width, height)
                         : node->kind == KIND_CANVAS3D ? render_graph_draw_scene(walk, node, state, width, height)
                                                       : make_effect_node(walk, node, state, past, width, height);
    }
    walk->depth--;
    if (state->id.len > 0 && state->picture)
        render_graph_name(walk, state->id, state->picture);
    return state->picture;
}

static void make_windows(void *context) {
    Walk *walk = context;
    const CanvasPicture *picture = walk->picture;
    GraphNode *top = &walk->frame->top;
    render_graph_alloc_children(walk, top, picture->top_count);
    for (uint32_t i = 0; i < picture->top_count; i++) {
        enum { DEFAULT_BITS = 16 };
        walk->bits = render_graph_bits(picture->tops[i], DEFAULT_BITS);
        Texture *texture =
            make_node(walk, picture->tops[i], &top->children[i], &walk->before->top, DEFAULT_SIZE, DEFAULT_SIZE);
        if (picture->tops[i] == picture->window)
            walk->shown = texture;
    }
}

// Frees the older of the two stored frames. Makes the GPU context current first, because images can only be freed in
// the current context.
static void clear_old_frame(Walk *walk) {
    const char *problem;
    if (walk->painter->gl)
        walk->gpu = gl_call.enter(walk->painter->gl, &problem);
    render_graph_clear_frame(walk->frame);
}

PetriStatus render_graph_run(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags, Texture **shown) {
    RenderGraph *pictures = painter->render_graph;
    Frame *before = &pictures->frames[pictures->now];
    pictures->now = !pictures->now;
    Walk walk = {.painter = painter,
                 .picture = picture,
                 .diags = diags,
                 .frame = &pictures->frames[pictures->now],
                 .before = before,
                 .beat = pictures->beat};
    pictures->beat = picture->beat;
    painter_limit(painter, picture);
    clear_old_frame(&walk);
    Arena *arenas[] = {&walk.frame->arena, &painter->arena, diags->arena};
    ArenaOutcome end = arena_protect(arenas, 3, make_windows, &walk);
    if (walk.gpu)
        gl_call.leave(painter->gl);
    *shown = end == ARENA_OK ? walk.shown : NULL;
    painter_report_needed(painter, picture, diags);
    return end == ARENA_OK ? PETRI_OK : end == ARENA_MEMORY_LIMIT ? painter_report_limit(diags) : PETRI_OUT_OF_MEMORY;
}
