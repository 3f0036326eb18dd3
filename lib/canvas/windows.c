// windows.c: finds the windows of a frame.
#include "canvas/read.h"

const Node *canvas_next_window(const Schema *schema, Value tree, uint32_t *at) {
    while (tree.kind == VALUE_MIXED && *at < tree.len) {
        const Item *item = &tree.as.items[(*at)++];
        NodeKind kind = item->type == ITEM_NODE ? schema_window_kind(schema, item->as.node) : KIND_COUNT;
        if (kind == KIND_WINDOW || kind == KIND_OFFSCREEN)
            return item->as.node;
    }
    return NULL;
}

// Returns true for nodes that create a picture without an input picture, or refer to a picture. Effect nodes need an
// input picture.
static bool is_source(NodeKind kind) {
    return kind == KIND_CANVAS || kind == KIND_CANVAS3D || kind == KIND_PICTURE_IMAGE || kind == KIND_REFERENCE ||
           kind == KIND_NOISE || kind == KIND_SHADER;
}

static bool has_source(const Schema *schema, const Node *node, int depth, uint32_t *remaining) {
    enum { MAX_DEPTH = 100 }; // deeper nodes are not drawn
    for (uint32_t i = 0; i < node->child_count && depth < MAX_DEPTH; i++) {
        NodeKind kind = schema_kind_in(schema, node->children[i], PLACE_PICTURES);
        if (*remaining == 0 || (kind < KIND_COUNT && is_source(kind)))
            return true;
        --*remaining;
        if (kind < KIND_COUNT && has_source(schema, node->children[i], depth + 1, remaining))
            return true;
    }
    return false;
}

bool canvas_window_has_picture(const Schema *schema, const Node *window) {
    uint32_t remaining = CANVAS_MAX_CHECKED;
    if (node_get(window, schema->slots[ROW_WINDOW_VERTEX].name).len > 0 ||
        node_get(window, schema->slots[ROW_WINDOW_FRAGMENT].name).len > 0)
        return true; // the program of the window draws it
    return has_source(schema, window, 0, &remaining);
}
