// node_batch.h: nodes that a loop has made alike, as rows of numbers.
//
// Where a loop makes one child of a node in each round, all of a kind and with attributes of as many numbers each, they
// are a *run*: what they have in common is kept once, and of each only the numbers that differ. In `children` a run is
// one node that is marked (`is_run`) and has the attributes of the first. Runs are in children only, never in a vector
// that a script can look at; they have no children themselves. Who goes through children takes node_children, which
// makes nodes of rows, or, where there may be very many, reads one row after the other with node_batch_row.
#ifndef PETRI_VALUE_NODE_BATCH_H
#define PETRI_VALUE_NODE_BATCH_H

#include "value/node.h"

enum {
    NODE_BATCH_MAX_ATTRS = 12,         // that nodes of a run may have
    NODE_BATCH_MAX_ROWS = 1 << 16,     // nodes of one run, at most,
    NODE_BATCH_MAX_BYTES = 1000 << 10, // … and of their rows: blocks of an arena are a little larger than four of these
    NODE_BATCH_MAX_NUMBERS = 16,       // of an attribute
    NODE_BATCH_UNIFORM = 0,            // instead of how many numbers a row has: none, it is the same in all
    NODE_BATCH_COUNTING = NODE_BATCH_MAX_ROWS, // … or it is 1 more from row to row
};

typedef struct NodeBatch {
    Node node; // first: a Node * that is marked is a NodeBatch *
    uint32_t count;
    uint32_t capacity;
    uint32_t stride; // doubles of a row, at least 1: each has an address of its own
    double *rows;
    uint32_t numbers[NODE_BATCH_MAX_ATTRS]; // of a row, by attribute
    int32_t from[NODE_BATCH_MAX_ATTRS];     // where node_batch_add finds the attribute
} NodeBatch;

static inline const NodeBatch *node_batch(const Node *node) {
    return (const NodeBatch *)node;
}

// A run of one node that has room for `capacity`, or for as many as a run may have: `first` with these attributes. One
// whose `numbers` are not NODE_BATCH_UNIFORM is numeric. Its `from` are the caller's to set.
NodeBatch *node_batch_new(Arena *arena, const Node *first, const Attr *attrs, const uint32_t *numbers,
                          uint32_t attr_count, uint32_t capacity);
// Adds a node, for which there must be room, whose attributes are values[from[…]]; false if it is not like the others.
bool node_batch_add(NodeBatch *batch, const Value *values);
const Node *node_batch_copy(Arena *arena, const NodeBatch *batch);

// One node of a run at a time. Its vectors are in the run, all else here.
typedef struct NodeRow {
    Node node;
    Attr attrs[NODE_BATCH_MAX_ATTRS];
} NodeRow;
void node_batch_open(const NodeBatch *batch, NodeRow *row);
void node_batch_row(const NodeBatch *batch, uint32_t number, NodeRow *row);
// What the same node of the same run has, and no other node.
static inline const Node *node_batch_identity(const NodeBatch *batch, uint32_t number) {
    return (const Node *)(const void *)(batch->rows + (size_t)batch->stride * number);
}

// The children of a node: all of them are nodes. Those of runs are made in the arena, which may be NULL if there are no
// runs.
const Node *const *node_children(Arena *arena, const Node *node, uint32_t *count);
uint64_t node_child_count(const Node *node);
// A vector in which no node has runs below it; the same one if there were none.
Value value_expand_batches(Arena *arena, Value v);

#endif
