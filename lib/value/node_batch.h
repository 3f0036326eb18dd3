// node_batch.h: compact storage of similar nodes that a loop creates.
//
// If a loop creates one child of a node per iteration, all of the same kind and with the same number of values in each
// attribute, the nodes form a batch. Attribute values that are equal in all nodes are stored once. The other values are
// numeric, and each node has a row of these numbers. In `children` a batch is a single node, marked with `is_batch`,
// that has the attributes of the first node. Batches occur only in `children`, never in a vector visible to scripts.
// They have no children themselves. node_children converts rows to nodes; for large batches, node_batch_row reads one
// row at a time.
#pragma once

#include "value/node.h"

enum {
    NODE_BATCH_MAX_ATTRS = 12,         // maximum number of attributes of a node
    NODE_BATCH_MAX_ROWS = 1 << 16,     // maximum number of nodes in a batch
    NODE_BATCH_MAX_BYTES = 1000 << 10, // maximum size of the rows; less than a quarter of the largest arena block
    NODE_BATCH_MAX_NUMBERS = 16,       // maximum count of numbers in a row that belong to one attribute
    NODE_BATCH_UNIFORM = 0,            // in `numbers`: the attribute has the same value in all nodes
    NODE_BATCH_COUNTING = NODE_BATCH_MAX_ROWS, // in `numbers`: the attribute increases by 1 from node to node
};

typedef struct NodeBatch {
    Node node;         // first member, so that a pointer to it can be cast to NodeBatch * if is_batch is set
    uint32_t count;    // number of nodes
    uint32_t capacity; // number of rows allocated
    uint32_t stride;   // number of doubles per row; at least 1, so that each row has a distinct address
    double *rows;
    // For each attribute: how many numbers of a row belong to it, or NODE_BATCH_UNIFORM or NODE_BATCH_COUNTING.
    uint32_t numbers[NODE_BATCH_MAX_ATTRS];
    // For each attribute: the index of its value in the parameter `values` of node_batch_add.
    int32_t from[NODE_BATCH_MAX_ATTRS];
} NodeBatch;

static inline const NodeBatch *node_batch(const Node *node) {
    return (const NodeBatch *)node;
}

// Returns a batch of one node: `first` with the given attributes. Its capacity is `capacity` nodes, or fewer if that
// exceeds the limits. Attributes whose `numbers` is not NODE_BATCH_UNIFORM must be numeric. The caller must then set
// `from`.
NodeBatch *node_batch_new(Arena *arena, const Node *first, const Attr *attrs, const uint32_t *numbers,
                          uint32_t attr_count, uint32_t capacity);
// Adds a node whose attribute i is values[from[i]]. The batch must not be full. Returns false if a value does not fit
// the layout of the batch.
bool node_batch_add(NodeBatch *batch, const Value *values);

// A node of a batch, for reading one row at a time. Its vectors point into the batch.
typedef struct NodeRow {
    Node node;
    Attr attrs[NODE_BATCH_MAX_ATTRS];
} NodeRow;
// Initialises `row` for reading a batch with node_batch_row.
void node_batch_open(const NodeBatch *batch, NodeRow *row);
// Sets `row` to node `number` of the batch.
void node_batch_row(const NodeBatch *batch, uint32_t number, NodeRow *row);
// Returns a unique address for a node of a batch. It is only compared, never dereferenced.
static inline const Node *node_batch_identity(const NodeBatch *batch, uint32_t number) {
    return (const Node *)(const void *)(batch->rows + (size_t)batch->stride * number);
}

// Returns the children of a node, with batches expanded to nodes in the arena. The arena may be NULL if the node has no
// batches.
const Node *const *node_children(Arena *arena, const Node *node, uint32_t *count);
// Returns the number of children, counting each node of a batch.
uint64_t node_child_count(const Node *node);
// Returns a vector whose nodes contain no batches. Returns v itself if it contains none.
Value value_expand_batches(Arena *arena, Value v);
