// node.c: see node.h.
//
// The height of a node and `has_batches` depend on its descendants. Every function that adds attributes or children
// updates them. A copy does not have the lifetime of the program, even if the original has.
#include "value/node_batch.h"

#include <string.h>

Node *node_new(Arena *arena, const Symbol *kind) {
    Node *node = arena_alloc(arena, sizeof *node);
    *node = (Node){.kind = kind, .height = 1};
    return node;
}

static Node *node_clone(Arena *arena, const Node *node) {
    Node *copy = arena_copy(arena, node, sizeof *node);
    copy->program_lifetime = false;
    return copy;
}

Node *node_add_tag(Arena *arena, const Node *node, const Symbol *tag) {
    Node *copy = node_clone(arena, node);
    uint32_t at = 0;
    while (at < node->tag_count && str_compare(node->tags[at]->name, tag->name) < 0)
        at++;
    if (at < node->tag_count && node->tags[at] == tag)
        return copy;
    const Symbol **tags = arena_alloc_array(arena, node->tag_count + 1, sizeof *tags);
    for (uint32_t i = 0; i < node->tag_count; i++)
        tags[i < at ? i : i + 1] = node->tags[i];
    tags[at] = tag;
    copy->tags = tags;
    copy->tag_count++;
    return copy;
}

static uint32_t attr_find(const Attr *attrs, uint32_t count, const Symbol *name) {
    uint32_t i = 0;
    while (i < count && attrs[i].name != name)
        i++;
    return i;
}

uint32_t value_height(Value v) {
    uint32_t height = 0;
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        if (v.as.items[i].type == ITEM_NODE && v.as.items[i].as.node->height > height)
            height = v.as.items[i].as.node->height;
    return height;
}

bool value_has_batches(Value v) {
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        if (v.as.items[i].type == ITEM_NODE && v.as.items[i].as.node->has_batches)
            return true;
    return false;
}

Node *node_set_attrs(Arena *arena, const Node *node, const Attr *set, uint32_t set_count) {
    uint32_t height = node->height;
    bool has_batches = node->has_batches;
    for (uint32_t i = 0; i < set_count; i++) {
        uint32_t inner = value_height(set[i].value) + 1;
        height = inner > height ? inner : height;
        has_batches |= inner > 1 && value_has_batches(set[i].value);
    }
    if (height > NODE_MAX_HEIGHT)
        return NULL;
    Node *copy = node_clone(arena, node);
    Attr *attrs = arena_alloc_array(arena, node->attr_count + set_count, sizeof *attrs);
    if (node->attr_count)
        memcpy(attrs, node->attrs, node->attr_count * sizeof *attrs);
    uint32_t count = node->attr_count;
    for (uint32_t i = 0; i < set_count; i++) {
        uint32_t at = attr_find(attrs, count, set[i].name);
        if (set[i].value.len > 0) {
            attrs[at] = set[i];
            count += at == count;
        } else if (at < count) {
            memmove(attrs + at, attrs + at + 1, (count - at - 1) * sizeof *attrs);
            count--;
        }
    }
    copy->attrs = attrs;
    copy->attr_count = count;
    copy->height = (uint16_t)height;
    copy->has_batches = has_batches;
    return copy;
}

NodeList node_list_in(const Node **nodes, Value children) {
    NodeList list = {.nodes = nodes};
    for (uint32_t i = 0; children.kind == VALUE_MIXED && i < children.len; i++) {
        if (children.as.items[i].type != ITEM_NODE)
            continue;
        const Node *node = children.as.items[i].as.node;
        if (node->height > list.height)
            list.height = node->height;
        list.has_batches |= node->has_batches;
        nodes[list.count++] = node;
    }
    return list;
}

NodeList node_list(Arena *arena, Value children) {
    if (value_height(children) == 0)
        return (NodeList){0};
    return node_list_in(arena_alloc_array(arena, children.len, sizeof(const Node *)), children);
}

Node *node_append_list(Arena *arena, const Node *node, const NodeList *list) {
    if (list->height >= NODE_MAX_HEIGHT)
        return NULL;
    Node *copy = node_clone(arena, node);
    if (list->count == 0)
        return copy;
    if (node->child_count == 0) {
        copy->children = list->nodes;
        copy->program_lifetime_children = list->program_lifetime;
    } else {
        const Node **all = arena_alloc_array(arena, node->child_count + list->count, sizeof *all);
        memcpy(all, node->children, node->child_count * sizeof *all);
        memcpy(all + node->child_count, list->nodes, list->count * sizeof *all);
        copy->children = all;
        copy->program_lifetime_children = false;
    }
    copy->child_count += list->count;
    copy->has_batches |= list->has_batches;
    if (list->height >= copy->height)
        copy->height = (uint16_t)(list->height + 1);
    return copy;
}

// The recursion depth is limited by NODE_MAX_HEIGHT. A marked node is skipped, because its descendants are marked too.
static void node_mark_program_lifetime(Node *node) {
    if (node->program_lifetime)
        return;
    node->program_lifetime = node->program_lifetime_children = true;
    for (uint32_t i = 0; i < node->attr_count; i++)
        value_mark_program_lifetime(node->attrs[i].value);
    for (uint32_t i = 0; i < node->child_count; i++)
        node_mark_program_lifetime((Node *)node->children[i]);
}

void value_mark_program_lifetime(Value v) {
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        if (v.as.items[i].type == ITEM_NODE)
            node_mark_program_lifetime((Node *)v.as.items[i].as.node);
}

Origin node_origin(const Node *node, const Symbol *attr) {
    const NodeOrigin *origin = node->origin;
    if (!origin)
        return (Origin){0};
    for (uint32_t i = 0; i < origin->attr_count; i++)
        if (origin->attrs[i].name == attr)
            return (Origin){origin->origin.source, origin->attrs[i].span};
    return origin->origin;
}

Value node_get(const Node *node, const Symbol *name) {
    uint32_t at = attr_find(node->attrs, node->attr_count, name);
    return at < node->attr_count ? node->attrs[at].value : VALUE_NULL;
}

bool node_mentions(const Node *node, const Symbol *name) {
    const NodeOrigin *origin = node->origin;
    bool found = !origin || attr_find(node->attrs, node->attr_count, name) < node->attr_count;
    for (uint32_t i = 0; !found && i < origin->attr_count; i++)
        found = origin->attrs[i].name == name;
    return found;
}

// Returns a copy of a mixed vector's items, in which the caller replaces nodes.
static Item *items_clone(Arena *arena, Value v) {
    return arena_copy(arena, v.as.items, v.len * sizeof(Item));
}

Value value_add_tag(Arena *arena, Value v, const Symbol *tag) {
    if (v.kind != VALUE_MIXED)
        return v;
    Item *items = items_clone(arena, v);
    for (uint32_t i = 0; i < v.len; i++)
        if (items[i].type == ITEM_NODE)
            items[i].as.node = node_add_tag(arena, items[i].as.node, tag);
    return (Value){.len = v.len, .kind = VALUE_MIXED, .as.items = items};
}

// Replaces the node of an item by `extended`. If `extended` is NULL, keeps the item and sets *too_high.
static void replace_node(Item *item, const Node *extended, bool *too_high) {
    if (extended)
        item->as.node = extended;
    else
        *too_high = true;
}

Value value_set_attrs(Arena *arena, Value v, const Attr *attrs, uint32_t count, bool *too_high) {
    if (v.kind != VALUE_MIXED)
        return v;
    Item *items = items_clone(arena, v);
    for (uint32_t i = 0; i < v.len; i++)
        if (items[i].type == ITEM_NODE)
            replace_node(&items[i], node_set_attrs(arena, items[i].as.node, attrs, count), too_high);
    return (Value){.len = v.len, .kind = VALUE_MIXED, .as.items = items};
}

Value value_append(Arena *arena, Value v, const NodeList *list, bool *too_high) {
    if (v.kind != VALUE_MIXED)
        return v;
    Item *items = items_clone(arena, v);
    for (uint32_t i = 0; i < v.len; i++)
        if (items[i].type == ITEM_NODE)
            replace_node(&items[i], node_append_list(arena, items[i].as.node, list), too_high);
    return (Value){.len = v.len, .kind = VALUE_MIXED, .as.items = items};
}
