// windows.c: the windows of a frame.
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

bool canvas_in_window(const Schema *schema, const Node *window) {
    for (uint32_t i = 0; i < window->child_count; i++)
        if (schema_window_kind(schema, window->children[i]) == KIND_CANVAS)
            return true;
    return false;
}
