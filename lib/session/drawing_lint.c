// drawing_lint.c: reports of drawings that stay invisible: shapes that nothing fills, and black ones on black.
#include "session/session.h"

#include <string.h>

// Nodes that add to a path, by kind.
static const bool is_shape[KIND_COUNT] = {
#define SHAPE(id, name, help) [KIND_##id] = true,
#include "schema/schema_list.h"
};

enum {
    MAX_SHAPES = 64,            // shapes that are remembered until a node fills them
    MAX_DRAWING_NODES = 1 << 14 // nodes that are visited in a window; the rest is not checked
};

// A canvas that is being checked.
typedef struct Drawing {
    Schema *schema;
    Arena *arena;
    const Node *shapes[MAX_SHAPES]; // shapes of which no later node has used the path yet
    NodeKind kinds[MAX_SHAPES];
    uint32_t shape_count;
    uint32_t left;    // nodes that may still be visited
    bool draws;       // something is filled, stroked or written
    bool has_unknown; // a node is not known, so it may be misspelled
    bool has_colours; // colours can come from an attribute, an image, a filter or another node
} Drawing;

static bool mentions_state(const Drawing *drawing, const Node *node, NodeKind kind, AttrName name) {
    const SchemaRow *row = schema_row(kind, name);
    return row && node_mentions(node, drawing->schema->slots[row - schema_rows].name);
}

static void check_nodes(Drawing *drawing, const Node *parent, NodeKind parent_kind, bool in_path, int depth);

static void check_node(Drawing *drawing, const Node *node, NodeKind kind, bool in_path, int depth) {
    PlaceKind place = schema_kinds[kind].place;
    bool painted = mentions_state(drawing, node, kind, ATTR_FILL) || mentions_state(drawing, node, kind, ATTR_STROKE);
    bool uses_path = kind == KIND_FILL || kind == KIND_STROKE || kind == KIND_CLIP || kind == KIND_MASK;
    if (uses_path)
        drawing->shape_count = 0;
    drawing->draws = drawing->draws || painted || kind == KIND_FILL || kind == KIND_STROKE || kind == KIND_TEXT;
    drawing->has_colours = drawing->has_colours || place == PLACE_SOURCE || place == PLACE_FILTER ||
                           kind == KIND_IMAGE || mentions_state(drawing, node, kind, ATTR_COLOR) ||
                           mentions_state(drawing, node, kind, ATTR_COMPOSITE);
    if (is_shape[kind] && !painted && !in_path && drawing->shape_count < MAX_SHAPES) {
        drawing->kinds[drawing->shape_count] = kind;
        drawing->shapes[drawing->shape_count++] = node;
    }
    check_nodes(drawing, node, kind, in_path || kind == KIND_PATH, depth + 1);
}

static void check_nodes(Drawing *drawing, const Node *parent, NodeKind parent_kind, bool in_path, int depth) {
    enum { MAX_DEPTH = 100 }; // deeper nodes are not drawn
    for (uint32_t i = 0; i < parent->child_count && depth < MAX_DEPTH && drawing->left > 0; i++) {
        const Node *child = parent->children[i];
        NodeKind kind = schema_kind_in(drawing->schema, child, schema_kinds[parent_kind].children);
        const Reader reader = {drawing->schema, drawing->arena, child, kind, 1};
        drawing->left--;
        drawing->has_unknown = drawing->has_unknown || kind == KIND_COUNT || !reader_knows_attrs(&reader);
        if (kind != KIND_COUNT)
            check_node(drawing, child, kind, in_path, depth);
    }
}

static void report_shapes(const Drawing *drawing) {
    for (uint32_t i = 0; i < drawing->shape_count; i++) {
        const Reader reader = {drawing->schema, drawing->arena, drawing->shapes[i], drawing->kinds[i], 1};
        bool can_fill = schema_row(drawing->kinds[i], ATTR_FILL);
        reader_report(&reader, "no-paint", "",
                      can_fill ? STR("the shape is neither filled nor stroked, so it is not visible; add fill=true or "
                                     "stroke=true")
                               : STR("the path is neither filled nor stroked, so it is not visible; put '!fill' or "
                                     "'!stroke' after it"));
    }
}

// Returns true if a script contains a word.
static bool contains(const Source *source, const char *word) {
    size_t len = strlen(word);
    for (size_t i = 0; i + len <= source->text.len; i++)
        if (memcmp(source->text.bytes + i, word, len) == 0)
            return true;
    return false;
}

static void lint_canvas(Drawing *drawing, const Node *canvas, bool can_be_black, const Source *script) {
    const Reader reader = {drawing->schema, drawing->arena, canvas, KIND_CANVAS, 1};
    *drawing = (Drawing){drawing->schema, drawing->arena, .left = drawing->left};
    check_node(drawing, canvas, KIND_CANVAS, false, 0);
    if (drawing->left == 0 || drawing->has_unknown)
        return;
    report_shapes(drawing);
    if (can_be_black && drawing->draws && !drawing->has_colours && !contains(script, "color"))
        reader_report(&reader, "black-on-black", "",
                      STR("no colour is set, so black is drawn on a black window; for white, write !canvas color=1"));
}

// Returns true if a window shows nothing but canvases.
static bool shows_only_canvases(const Schema *schema, const Node *window) {
    for (uint32_t i = 0; i < window->child_count; i++) {
        NodeKind kind = schema_kind_in(schema, window->children[i], PLACE_WINDOW);
        if (kind != KIND_CANVAS && kind != KIND_POINTER && kind != KIND_KEY)
            return false;
    }
    return schema_window_kind(schema, window) == KIND_WINDOW &&
           !node_mentions(window, schema->slots[ROW_WINDOW_FRAGMENT].name);
}

static void lint_pictures(Drawing *drawing, const Node *parent, bool can_be_black, const Source *script, int depth) {
    enum { MAX_DEPTH = 100 };
    for (uint32_t i = 0; i < parent->child_count && depth < MAX_DEPTH && drawing->left > 0; i++) {
        const Node *child = parent->children[i];
        NodeKind kind = schema_kind_in(drawing->schema, child, PLACE_PICTURES);
        drawing->left--;
        if (kind == KIND_CANVAS)
            lint_canvas(drawing, child, can_be_black, script);
        else if (kind != KIND_COUNT)
            lint_pictures(drawing, child, false, script, depth + 1);
    }
}

void session_lint_drawings(Schema *schema, Arena *arena, const Node *window, const Source *script) {
    Drawing *drawing = arena_alloc(arena, sizeof *drawing);
    *drawing = (Drawing){schema, arena, .left = MAX_DRAWING_NODES};
    lint_pictures(drawing, window, shows_only_canvases(schema, window), script, 0);
}
