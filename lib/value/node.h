// node.h: immutable tree nodes (spec language.md L7), and functions as values.
//
// Every operation returns a new node and leaves its operand alone; children and attribute values are shared. Who goes
// through the children of any node takes node_children (value/node_batch.h), as some may be kept as rows.
#ifndef PETRI_VALUE_NODE_H
#define PETRI_VALUE_NODE_H

#include "base/source.h"
#include "value/value.h"

#include <stdbool.h>

typedef struct Attr {
    const Symbol *name;
    Value value; // never null
} Attr;

// Where a node came from in a script.
typedef struct NodeOrigin {
    Origin origin;
    const struct AttrOrigin {
        const Symbol *name;
        Span span;
    } * attrs; // those that were written with it, in the same text
    uint32_t attr_count;
} NodeOrigin;

struct Node {
    const Symbol *kind;
    const Symbol *const *tags; // ascending by bytes
    const Attr *attrs;         // in the order in which they were first set
    const Node *const *children;
    const NodeOrigin *origin; // lives as long as the program that made the node; NULL: unknown
    uint32_t tag_count;
    uint32_t attr_count;
    uint32_t child_count;
    uint16_t height; // 1 + the greatest height of a child or of a node in an attribute
    // Lives as long as the program that made it, not only for a frame: as long as no program is dropped, the same
    // address means the same node with everything in it. The children may live so long though the node does not: then
    // the same `children` and `child_count` mean the same children.
    bool program_lifetime : 1;
    bool program_lifetime_children : 1;
    bool is_batch : 1;    // stands for several children of its parent: value/node_batch.h
    bool has_batches : 1; // there is such a node below, or in an attribute
};

_Static_assert(sizeof(Node) <= 56, "scripts make thousands of nodes a frame");

enum { NODE_MAX_HEIGHT = 12000 }; // deeper trees are refused, so that walking one never exhausts the stack

// What a function value is. The machine extends it for closures, whose identity is the address.
struct Function {
    Str name;            // for printing; "<anon>" without one
    const void *builtin; // the row of a built-in, or NULL for a user function
};

Node *node_new(Arena *arena, const Symbol *kind);
Node *node_add_tag(Arena *arena, const Node *node, const Symbol *tag);
// Sets attributes in order; a null or stream value removes one (L7.2). NULL if the tree would be too high.
Node *node_set_attrs(Arena *arena, const Node *node, const Attr *attrs, uint32_t count);
// The nodes of a vector, ready to be appended; other elements are ignored. A node that has no children yet shares the
// array.
typedef struct NodeList {
    const Node *const *nodes;
    uint32_t count;
    uint16_t height;       // the greatest of a node
    bool program_lifetime; // as in Node
    bool has_batches;      // one of them is a run, or has some
} NodeList;
NodeList node_list(Arena *arena, Value children);
// The same in an array that has room for as many nodes as there are elements.
NodeList node_list_in(const Node **nodes, Value children);
// The greatest height of the nodes in a vector, 0 if there are none; and whether one of them has runs.
uint32_t value_height(Value v);
bool value_has_batches(Value v);
// NULL if the tree would be too high.
Node *node_append_list(Arena *arena, const Node *node, const NodeList *list);
// Marks the nodes of a value that lives as long as its program, and all that are in them.
void value_mark_program_lifetime(Value v);
// The attribute's value, or null.
Value node_get(const Node *node, const Symbol *name);
// Where the attribute of this name was written, or else the node; the source is NULL if that is unknown, too.
Origin node_origin(const Node *node, const Symbol *attr);
// Structural equality (L7.5); the arena is as for value_equal.
bool node_equal(Arena *arena, const Node *a, const Node *b);
const Node *node_copy(Arena *arena, const Node *node);

// The same over every node element of a vector, other elements untouched.
Value value_add_tag(Arena *arena, Value v, const Symbol *tag);
// In these two *too_high is set if a node could not be extended and was left as it was.
Value value_set_attrs(Arena *arena, Value v, const Attr *attrs, uint32_t count, bool *too_high);
Value value_append(Arena *arena, Value v, const NodeList *list, bool *too_high);

#endif
