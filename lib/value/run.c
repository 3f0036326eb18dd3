// run.c: see run.h.
#include "value/run.h"

#include "base/number.h"

#include <assert.h>
#include <string.h>

enum { NODE_WORK = 2 }; // of making one

static bool in_row(uint32_t numbers) {
    return numbers != NODE_RUN_COMMON && numbers != NODE_RUN_COUNTS;
}

NodeRun *node_run_new(Arena *arena, const Node *first, const Attr *attrs, const uint32_t *numbers, uint32_t attr_count,
                      uint32_t capacity) {
    NodeRun *run = arena_alloc(arena, sizeof *run + attr_count * sizeof *attrs);
    Attr *own = (Attr *)(run + 1);
    uint32_t stride = 0;
    assert(attr_count <= NODE_RUN_ATTRS);
    for (uint32_t i = 0; i < attr_count; i++)
        stride += in_row(numbers[i]) ? numbers[i] : 0;
    stride = stride ? stride : 1;
    uint32_t most = NODE_RUN_BYTES / sizeof(double) / stride;
    most = most < NODE_RUN_ROWS ? most : NODE_RUN_ROWS;
    *run = (NodeRun){.node = *first, .count = 1, .capacity = capacity < most ? capacity : most, .stride = stride};
    run->node.attrs = own;
    run->node.attr_count = attr_count;
    run->node.program_lifetime = run->node.program_lifetime_children = false;
    run->node.is_run = run->node.has_runs = true;
    memcpy(run->numbers, numbers, attr_count * sizeof *numbers);
    double *row = run->rows = arena_alloc_array(arena, (size_t)run->capacity * stride, sizeof *row);
    for (uint32_t i = 0; i < attr_count; i++) {
        own[i] = attrs[i];
        if (!in_row(numbers[i]))
            continue;
        memcpy(row, value_numbers(&attrs[i].value), numbers[i] * sizeof *row);
        own[i].value = value_numbers_view(row, numbers[i]);
        row += numbers[i];
    }
    return run;
}

bool node_run_add(NodeRun *run, const Value *values) {
    double *row = run->rows + (size_t)run->stride * run->count;
    for (uint32_t i = 0; i < run->node.attr_count; i++) {
        uint32_t numbers = run->numbers[i];
        const Value *v = &values[run->from[i]];
        if (numbers == NODE_RUN_COMMON)
            continue;
        if (v->kind != VALUE_NUMBERS)
            return false;
        if (v->len == 1 && numbers == 1) {
            *row++ = v->as.number;
        } else if (numbers == NODE_RUN_COUNTS) {
            double next = run->node.attrs[i].value.as.number + run->count;
            if (v->len != 1 || number_bits(v->as.number) != number_bits(next))
                return false;
        } else {
            if (v->len != numbers)
                return false;
            for (uint32_t k = 0; k < numbers; k++)
                *row++ = v->as.numbers[k];
        }
    }
    run->count++;
    return true;
}

const Node *node_run_copy(Arena *arena, const NodeRun *run) {
    uint32_t count = run->node.attr_count;
    Attr *attrs = arena_alloc_array(arena, count, sizeof *attrs);
    for (uint32_t i = 0; i < count; i++)
        attrs[i] = (Attr){run->node.attrs[i].name, value_copy(arena, run->node.attrs[i].value)};
    NodeRun *copy = node_run_new(arena, &run->node, attrs, run->numbers, count, run->count);
    copy->node.tags = arena_copy(arena, run->node.tags, run->node.tag_count * sizeof *run->node.tags);
    memcpy(copy->rows, run->rows, (size_t)run->stride * run->count * sizeof *run->rows);
    copy->count = run->count;
    return &copy->node;
}

void node_run_open(const NodeRun *run, NodeRow *row) {
    row->node = run->node;
    row->node.is_run = row->node.has_runs = false;
    row->node.attrs = row->attrs;
    memcpy(row->attrs, run->node.attrs, run->node.attr_count * sizeof *row->attrs);
}

void node_run_row(const NodeRun *run, uint32_t number, NodeRow *row) {
    const double *at = run->rows + (size_t)run->stride * number;
    for (uint32_t i = 0; i < run->node.attr_count; i++) {
        uint32_t numbers = run->numbers[i];
        Value *value = &row->attrs[i].value;
        if (numbers == 1) {
            value->as.number = *at++;
        } else if (numbers == NODE_RUN_COUNTS) {
            value->as.number = run->node.attrs[i].value.as.number + number;
        } else if (numbers != NODE_RUN_COMMON) {
            value->as.numbers = at;
            at += numbers;
        }
    }
}

uint64_t node_child_count(const Node *node) {
    uint64_t count = node->child_count;
    for (uint32_t i = 0; node->has_runs && i < node->child_count; i++)
        if (node->children[i]->is_run)
            count += node_run(node->children[i])->count - 1;
    return count;
}

// Makes the nodes of a run; returns the place behind the last.
static const Node **make_rows(Arena *arena, const NodeRun *run, const Node **to) {
    uint32_t attr_count = run->node.attr_count;
    NodeRow row;
    node_run_open(run, &row);
    for (uint32_t i = 0; i < run->count; i++) {
        arena_charge(arena, NODE_WORK);
        Node *node = arena_alloc(arena, sizeof *node + attr_count * sizeof(Attr));
        node_run_row(run, i, &row);
        *node = row.node;
        node->attrs = memcpy(node + 1, row.attrs, attr_count * sizeof(Attr));
        *to++ = node;
    }
    return to;
}

const Node *const *node_children(Arena *arena, const Node *node, uint32_t *count) {
    uint64_t all = node_child_count(node);
    *count = (uint32_t)all;
    if (all == node->child_count && !node->has_runs)
        return node->children;
    if (all > UINT32_MAX) // more than there can be memory for
        arena_exhausted(arena);
    const Node **nodes = arena_alloc_array(arena, *count, sizeof *nodes), **to = nodes;
    for (uint32_t i = 0; i < node->child_count; i++)
        if (node->children[i]->is_run)
            to = make_rows(arena, node_run(node->children[i]), to);
        else
            *to++ = node->children[i];
    return nodes;
}

// The depth is limited by NODE_MAX_HEIGHT.
static const Node *without_runs(Arena *arena, const Node *node) {
    if (!node->has_runs)
        return node;
    Node *copy = arena_copy(arena, node, sizeof *node);
    Attr *attrs = arena_copy(arena, node->attrs, node->attr_count * sizeof *attrs);
    for (uint32_t i = 0; i < node->attr_count; i++)
        attrs[i].value = value_without_runs(arena, attrs[i].value);
    uint32_t count;
    const Node *const *nodes = node_children(arena, node, &count);
    const Node **children = arena_copy(arena, nodes, count * sizeof(const Node *));
    for (uint32_t i = 0; i < count; i++)
        children[i] = without_runs(arena, children[i]);
    copy->attrs = attrs;
    copy->children = children;
    copy->child_count = count;
    copy->program_lifetime = copy->program_lifetime_children = copy->has_runs = false;
    return copy;
}

Value value_without_runs(Arena *arena, Value v) {
    if (v.kind != VALUE_MIXED || !value_has_runs(v))
        return v;
    Item *items = arena_copy(arena, v.as.items, v.len * sizeof *items);
    for (uint32_t i = 0; i < v.len; i++)
        if (items[i].type == ITEM_NODE)
            items[i].as.node = without_runs(arena, items[i].as.node);
    v.as.items = items;
    return v;
}
