// render_graph.c: the state of a render graph that is kept from frame to frame, and properties of nodes that can be
// determined before rendering; see render_graph.h and render_graph_walk.h.
#include "base/heap.h"
#include "gl/functions.h"
#include "picture/render_graph_walk.h"

#include <math.h>
#include <string.h>

RenderGraph *render_graph_new(void) {
    RenderGraph *pictures = heap_calloc(1, sizeof *pictures);
    for (int i = 0; pictures && i < 2; i++)
        arena_init(&pictures->frames[i].arena, "pictures", SIZE_MAX);
    return pictures;
}

static void release_node(GraphNode *state) {
    texture_free(state->picture);
    for (uint32_t i = 0; i < state->count; i++)
        release_node(&state->children[i]);
}

void render_graph_clear_frame(Frame *frame) {
    release_node(&frame->top);
    Arena arena = frame->arena;
    arena_reset(&arena);
    *frame = (Frame){.arena = arena};
}

void render_graph_clear(PetriPainter *painter) {
    const char *problem;
    bool gpu = painter->gl && gl_call.enter(painter->gl, &problem);
    for (int i = 0; painter->render_graph && i < 2; i++)
        render_graph_clear_frame(&painter->render_graph->frames[i]);
    if (gpu)
        gl_call.leave(painter->gl);
}

void render_graph_free(PetriPainter *painter) {
    render_graph_clear(painter);
    for (int i = 0; painter->render_graph && i < 2; i++)
        arena_free(&painter->render_graph->frames[i].arena);
    heap_free(painter->render_graph);
    painter->render_graph = NULL;
}

const Recorded *render_graph_records(const RenderGraph *pictures, uint32_t *count) {
    const Frame *frame = &pictures->frames[pictures->now];
    *count = frame->record_count;
    return frame->records;
}

Texture *render_graph_window(const RenderGraph *pictures, const CanvasPicture *picture) {
    const GraphNode *top = &pictures->frames[pictures->now].top;
    for (uint32_t i = 0; i < picture->top_count && i < top->count; i++)
        if (picture->tops[i] == picture->window)
            return top->children[i].picture;
    return NULL;
}

static Texture *find_known(const Frame *frame, Str id) {
    for (uint32_t i = frame->known_count; i-- > 0;)
        if (str_equal(frame->known[i].id, id))
            return frame->known[i].picture;
    return NULL;
}

Texture *render_graph_find(const RenderGraph *pictures, Str id) {
    Texture *found = find_known(&pictures->frames[pictures->now], id);
    return found ? found : find_known(&pictures->frames[!pictures->now], id);
}

void render_graph_name(Walk *walk, Str id, Texture *picture) {
    Frame *frame = walk->frame;
    if (frame->known_count == frame->known_capacity) {
        uint32_t capacity = frame->known_capacity ? 2 * frame->known_capacity : 8;
        frame->known = arena_grow(&frame->arena, frame->known, frame->known_capacity * sizeof *frame->known,
                                  capacity * sizeof *frame->known);
        frame->known_capacity = capacity;
    }
    frame->known[frame->known_count++] = (NamedPicture){id, picture};
}

const GraphNode *render_graph_find_past(const GraphNode *past, const GraphNode *state) {
    for (uint32_t i = 0; past && i < past->count; i++) {
        GraphNode *other = &past->children[i];
        if (!other->matched && other->kind == state->kind && str_equal(other->tags, state->tags) &&
            str_equal(other->id, state->id) &&
            (state->kind != KIND_PICTURE_IMAGE || str_equal(other->file, state->file))) {
            other->matched = true;
            return other;
        }
    }
    return NULL;
}

void render_graph_alloc_children(Walk *walk, GraphNode *state, uint32_t count) {
    state->children = arena_alloc_array(&walk->frame->arena, count, sizeof *state->children);
    memset(state->children, 0, count * sizeof *state->children);
    state->count = count;
}

static bool is_picture(const DrawNode *node) {
    return node->kind != KIND_POINTER && node->kind != KIND_KEY;
}

bool render_graph_is_plain(const DrawNode *node) {
    bool usual = node->kind == KIND_WINDOW || node->kind == KIND_OFFSCREEN || node->kind == KIND_RECORD ||
                 node->kind == KIND_SHADER;
    return usual && !draw_attr(node, ATTR_FRAGMENT) && !draw_attr(node, ATTR_VERTEX) &&
           !draw_attr(node, ATTR_DOWNSAMPLE_PASSES);
}

void render_graph_node_size(const DrawNode *node, int *width, int *height) {
    double size[2];
    if (!draw_pair(node, ATTR_SIZE, size))
        return;
    *width = size[0] <= PETRI_MAX_PICTURE_SIDE ? (int)size[0] : PETRI_MAX_PICTURE_SIDE + 1;
    *height = size[1] <= PETRI_MAX_PICTURE_SIDE ? (int)size[1] : PETRI_MAX_PICTURE_SIDE + 1;
}

const DrawNode *render_graph_direct_canvas(const DrawNode *node, int width, int height) {
    while (node && node->kind != KIND_CANVAS) {
        const DrawNode *only = NULL;
        int wide = width, high = height;
        if (!render_graph_is_plain(node) || draw_number(node, ATTR_ALPHA) != 1)
            return NULL;
        for (uint32_t i = 0; i < node->child_count; i++) {
            const DrawNode *child = node->children[i];
            if (!is_picture(child) || (child->kind != KIND_REFERENCE && draw_flag(child, ATTR_HIDDEN)))
                continue;
            if (only || child->kind == KIND_REFERENCE || child->kind == KIND_PICTURE_IMAGE)
                return NULL;
            only = child;
        }
        if (only)
            render_graph_node_size(only, &wide, &high);
        if (wide != width || high != height)
            return NULL;
        node = only;
    }
    return node && draw_flag(node, ATTR_LINEAR) ? NULL : node;
}

static const bool scalable_kinds[KIND_COUNT] = {
#define PICTURE_EFFECT(id, name, scalable, help) [KIND_##id] = scalable,
#include "schema/schema_list.h"
    [KIND_CANVAS] = true,    [KIND_CANVAS3D] = true,  [KIND_PICTURE_IMAGE] = true,
    [KIND_REFERENCE] = true, [KIND_POINTER] = true,   [KIND_KEY] = true,
    [KIND_WINDOW] = true,    [KIND_OFFSCREEN] = true, [KIND_SHADER] = true,
};

bool render_graph_scalable(const DrawNode *node) {
    PlaceKind children = schema_kinds[node->kind].children;
    if (!scalable_kinds[node->kind] || (children != PLACE_PICTURES && children != PLACE_WINDOW))
        return scalable_kinds[node->kind];
    bool own = draw_attr(node, ATTR_FRAGMENT) || draw_attr(node, ATTR_VERTEX);
    for (uint32_t i = 0; i < node->child_count && !own; i++)
        own = !render_graph_scalable(node->children[i]);
    return !own;
}

int render_graph_pixels(int side, double detail) {
    int pixels = (int)floor(side * detail + 0.5);
    return pixels > 1 ? pixels : 1;
}
