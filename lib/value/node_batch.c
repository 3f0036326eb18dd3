// node_batch.c: see node_batch.h.
//
// A row has the numbers of all attributes that differ, in the order of the attributes. Attributes that are equal in all
// nodes, or that count up, take no space. A node that does not fit leaves the batch unchanged.
#include "value/node_batch.h"

#include "base/number.h"

#include <assert.h>
#include <string.h>

enum { BATCH_NODE_WORK = 2 }; // work units per created node

// Returns true if each row contains numbers of an attribute whose entry in NodeBatch.numbers is `numbers`.
static bool in_row(uint32_t numbers) {
    return numbers != NODE_BATCH_UNIFORM && numbers != NODE_BATCH_COUNTING;
}

NodeBatch *node_batch_new(Arena *arena, const Node *first, const Attr *attrs, const uint32_t *numbers,
                          uint32_t attr_count, uint32_t capacity) {
    NodeBatch *batch = arena_alloc(arena, sizeof *batch + attr_count * sizeof *attrs);
    Attr *own = (Attr *)(batch + 1);
    uint32_t stride = 0;
    assert(attr_count <= NODE_BATCH_MAX_ATTRS);
    for (uint32_t i = 0; i < attr_count; i++)
        stride += in_row(numbers[i]) ? numbers[i] : 0;
    stride = stride ? stride : 1;
    uint32_t max_rows = NODE_BATCH_MAX_BYTES / sizeof(double) / stride;
    max_rows = max_rows < NODE_BATCH_MAX_ROWS ? max_rows : NODE_BATCH_MAX_ROWS;
    *batch = (NodeBatch){
        .node = *first, .count = 1, .capacity = capacity < max_rows ? capacity : max_rows, .stride = stride};
    batch->node.attrs = own;
    batch->node.attr_count = attr_count;
    batch->node.program_lifetime = batch->node.program_lifetime_children = false;
    batch->node.is_batch = batch->node.has_batches = true;
    memcpy(batch->numbers, numbers, attr_count * sizeof *numbers);
    double *row = batch->rows = arena_alloc_array(arena, (size_t)batch->capacity * stride, sizeof *row);
    for (uint32_t i = 0; i < attr_count; i++) {
        own[i] = attrs[i];
        if (!in_row(numbers[i]))
            continue;
        memcpy(row, value_numbers(&attrs[i].value), numbers[i] * sizeof *row);
        own[i].value = value_numbers_view(row, numbers[i]);
        row += numbers[i];
    }
    return batch;
}

bool node_batch_add(NodeBatch *batch, const Value *values) {
    double *row = batch->rows + (size_t)batch->stride * batch->count;
    for (uint32_t i = 0; i < batch->node.attr_count; i++) {
        uint32_t numbers = batch->numbers[i];
        const Value *v = &values[batch->from[i]];
        if (numbers == NODE_BATCH_UNIFORM)
            continue;
        if (v->kind != VALUE_NUMBERS)
            return false;
        if (v->len == 1 && numbers == 1) {
            *row++ = v->as.number;
        } else if (numbers == NODE_BATCH_COUNTING) {
            double next = number_counted(batch->node.attrs[i].value.as.number, batch->count);
            if (v->len != 1 || number_bits(v->as.number) != number_bits(next))
                return false;
        } else {
            if (v->len != numbers)
                return false;
            for (uint32_t k = 0; k < numbers; k++)
                *row++ = v->as.numbers[k];
        }
    }
    batch->count++;
    return true;
}

void node_batch_open(const NodeBatch *batch, NodeRow *row) {
    row->node = batch->node;
    row->node.is_batch = row->node.has_batches = false;
    row->node.attrs = row->attrs;
    memcpy(row->attrs, batch->node.attrs, batch->node.attr_count * sizeof *row->attrs);
}

void node_batch_row(const NodeBatch *batch, uint32_t number, NodeRow *row) {
    const double *at = batch->rows + (size_t)batch->stride * number;
    for (uint32_t i = 0; i < batch->node.attr_count; i++) {
        uint32_t numbers = batch->numbers[i];
        Value *value = &row->attrs[i].value;
        if (numbers == 1) {
            value->as.number = *at++;
        } else if (numbers == NODE_BATCH_COUNTING) {
            value->as.number = number_counted(batch->node.attrs[i].value.as.number, number);
        } else if (numbers != NODE_BATCH_UNIFORM) {
            value->as.numbers = at;
            at += numbers;
        }
    }
}

uint64_t node_child_count(const Node *node) {
    uint64_t count = node->child_count;
    for (uint32_t i = 0; node->has_batches && i < node->child_count; i++)
        if (node->children[i]->is_batch)
            count += node_batch(node->children[i])->count - 1;
    return count;
}

// Creates the nodes of a batch and stores their addresses in an array, starting at `to`. Returns the position after the
// last address.
static const Node **make_row_nodes(Arena *arena, const NodeBatch *batch, const Node **to) {
    uint32_t attr_count = batch->node.attr_count;
    NodeRow row;
    node_batch_open(batch, &row);
    for (uint32_t i = 0; i < batch->count; i++) {
        arena_charge(arena, BATCH_NODE_WORK);
        Node *node = arena_alloc(arena, sizeof *node + attr_count * sizeof(Attr));
        node_batch_row(batch, i, &row);
        *node = row.node;
        node->attrs = memcpy(node + 1, row.attrs, attr_count * sizeof(Attr));
        *to++ = node;
    }
    return to;
}

const Node *const *node_children(Arena *arena, const Node *node, uint32_t *count) {
    uint64_t all = node_child_count(node);
    *count = (uint32_t)all;
    if (all == node->child_count && !node->has_batches)
        return node->children;
    if (all > UINT32_MAX) // more than can fit into memory
        arena_exhausted(arena);
    const Node **nodes = arena_alloc_array(arena, *count, sizeof *nodes), **to = nodes;
    for (uint32_t i = 0; i < node->child_count; i++)
        if (node->children[i]->is_batch)
            to = make_row_nodes(arena, node_batch(node->children[i]), to);
        else
            *to++ = node->children[i];
    return nodes;
}

// The recursion depth is limited by NODE_MAX_HEIGHT.
static const Node *expand_batches(Arena *arena, const Node *node) {
    if (!node->has_batches)
        return node;
    Node *copy = arena_copy(arena, node, sizeof *node);
    Attr *attrs = arena_copy(arena, node->attrs, node->attr_count * sizeof *attrs);
    for (uint32_t i = 0; i < node->attr_count; i++)
        attrs[i].value = value_expand_batches(arena, attrs[i].value);
    uint32_t count;
    const Node *const *nodes = node_children(arena, node, &count);
    const Node **children = arena_copy(arena, nodes, count * sizeof(const Node *));
    for (uint32_t i = 0; i < count; i++)
        children[i] = expand_batches(arena, children[i]);
    copy->attrs = attrs;
    copy->children = children;
    copy->child_count = count;
    copy->program_lifetime = copy->program_lifetime_children = copy->has_batches = false;
    return copy;
}

Value value_expand_batches(Arena *arena, Value v) {
    if (v.kind != VALUE_MIXED || !value_has_batches(v))
        return v;
    Item *items = arena_copy(arena, v.as.items, v.len * sizeof *items);
    for (uint32_t i = 0; i < v.len; i++)
        if (items[i].type == ITEM_NODE)
            items[i].as.node = expand_batches(arena, items[i].as.node);
    v.as.items = items;
    return v;
}
