// nodes.h: functions that create single nodes and values of nodes. The library creates them in lists (vm/construct.c).
#pragma once

#include "value/node.h"

static inline Value value_node(Arena *arena, const Node *node) {
    return value_item(arena, (Item){ITEM_NODE, .as.node = node});
}

// Appends the nodes of `children`. Returns NULL if the tree would be too deep.
static inline Node *node_append(Arena *arena, const Node *node, Value children) {
    NodeList list = node_list(arena, children);
    return node_append_list(arena, node, &list);
}
