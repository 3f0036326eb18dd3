// copy.c: deep copies of vectors and nodes, which contain each other. The recursion depth is limited by
// NODE_MAX_HEIGHT.
#include "value/node_batch.h"

#include <string.h>

static const Node *batch_copy(Arena *arena, const NodeBatch *batch) {
    uint32_t count = batch->node.attr_count;
    Attr *attrs = arena_alloc_array(arena, count, sizeof *attrs);
    for (uint32_t i = 0; i < count; i++)
        attrs[i] = (Attr){batch->node.attrs[i].name, value_copy(arena, batch->node.attrs[i].value)};
    NodeBatch *copy = node_batch_new(arena, &batch->node, attrs, batch->numbers, count, batch->count);
    copy->node.tags = arena_copy(arena, batch->node.tags, batch->node.tag_count * sizeof *batch->node.tags);
    memcpy(copy->rows, batch->rows, (size_t)batch->stride * batch->count * sizeof *batch->rows);
    copy->count = batch->count;
    return &copy->node;
}

const Node *node_copy(Arena *arena, const Node *node) {
    if (node->is_batch)
        return batch_copy(arena, node_batch(node));
    Node *copy = arena_copy(arena, node, sizeof *node);
    copy->program_lifetime = copy->program_lifetime_children = false;
    copy->tags = arena_copy(arena, node->tags, node->tag_count * sizeof *node->tags);
    Attr *attrs = arena_alloc_array(arena, node->attr_count, sizeof *attrs);
    for (uint32_t i = 0; i < node->attr_count; i++)
        attrs[i] = (Attr){node->attrs[i].name, value_copy(arena, node->attrs[i].value)};
    copy->attrs = attrs;
    const Node **children = arena_alloc_array(arena, node->child_count, sizeof *children);
    for (uint32_t i = 0; i < node->child_count; i++)
        children[i] = node_copy(arena, node->children[i]);
    copy->children = children;
    return copy;
}

static Item item_copy(Arena *arena, Item item) {
    if (item.type == ITEM_STRING)
        item.as.string = value_new_string(arena, item.as.string->text);
    else if (item.type == ITEM_NODE)
        item.as.node = node_copy(arena, item.as.node);
    return item;
}

Value value_copy(Arena *arena, Value v) {
    if (v.kind == VALUE_NUMBERS && v.len > 1)
        v.as.numbers = arena_copy(arena, v.as.numbers, v.len * sizeof *v.as.numbers);
    if (v.kind == VALUE_MIXED) {
        Item *items = arena_alloc(arena, v.len * sizeof *items);
        for (uint32_t i = 0; i < v.len; i++)
            items[i] = item_copy(arena, v.as.items[i]);
        v.as.items = items;
    }
    return v;
}
