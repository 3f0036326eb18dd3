// node.h: immutable tree nodes (spec language.md L7) and function values.
//
// Every operation returns a new node and does not modify its operand. Children and attribute values are shared. To read
// the children of a node, use node_children (value/node_batch.h), because some children may be stored as batches.
#pragma once

#include "base/private_api.h"
#include "base/source.h"
#include "value/value.h"

#include <stdbool.h>

typedef struct Attr {
    const Symbol *name;
    Value value; // never null
} Attr;

// The location in a script that created a node.
typedef struct NodeOrigin {
    Origin origin;
    const struct AttrOrigin {
        const Symbol *name;
        Span span;
    } * attrs; // locations of the attributes that are written in the same source
    uint32_t attr_count;
} NodeOrigin;

struct Node {
    const Symbol *kind;
    const Symbol *const *tags; // sorted by the bytes of their names
    const Attr *attrs;         // in the order in which they were first set
    const Node *const *children;
    const NodeOrigin *origin; // valid as long as the program that created the node; NULL: unknown
    uint32_t tag_count;
    uint32_t attr_count;
    uint32_t child_count;
    uint16_t height; // 1 + maximum height of the children and of nodes in attributes
    // program_lifetime: the node lives as long as the program that created it, not only for a frame. Until that program
    // is freed, the node's address identifies its contents. program_lifetime_children: at least the children live that
    // long, so `children` and `child_count` identify the list of children.
    bool program_lifetime : 1;
    bool program_lifetime_children : 1;
    bool is_batch : 1;    // represents several children of its parent (value/node_batch.h)
    bool has_batches : 1; // this node, a descendant or a node in an attribute is a batch
};

_Static_assert(sizeof(Node) <= 56, "scripts create thousands of nodes per frame");

enum { NODE_MAX_HEIGHT = 12000 }; // taller trees are rejected, so that recursion cannot overflow the stack

// A function value. The virtual machine extends the struct for closures, which are identified by address.
struct Function {
    Str name;            // name that is printed; "<anon>": anonymous
    const void *builtin; // table row of a built-in function; NULL: defined by a script
};

// Returns a node of a kind, without tags, attributes or children.
Node *node_new(Arena *arena, const Symbol *kind);
// Returns a copy of a node with an additional tag.
Node *node_add_tag(Arena *arena, const Node *node, const Symbol *tag);
// Returns a copy of a node with attributes set, in the order of the array. A null or stream value removes the attribute
// (L7.2). Returns NULL if the tree would exceed NODE_MAX_HEIGHT.
Node *node_set_attrs(Arena *arena, const Node *node, const Attr *attrs, uint32_t count);
// Nodes that node_append_list will append to another node as children. If that node has no children yet, its extended
// copy uses the array `nodes` itself.
typedef struct NodeList {
    const Node *const *nodes;
    uint32_t count;
    uint16_t height;       // maximum height of the nodes
    bool program_lifetime; // as in Node, for all nodes and the array `nodes`
    bool has_batches;      // one of the nodes is a batch or contains one
} NodeList;
// Returns the nodes of a vector. Other elements are ignored.
NodeList node_list(Arena *arena, Value children);
// Like node_list, but stores the nodes in `nodes`, an array of the caller that is at least as long as the vector.
NodeList node_list_in(const Node **nodes, Value children);
// Returns the maximum height of the nodes in a vector, or 0 if it has none.
uint32_t value_height(Value v);
// Returns true if a node in a vector contains batches.
bool value_has_batches(Value v);
// Returns a copy of a node with the nodes of a list appended as children. Returns NULL if the tree would exceed
// NODE_MAX_HEIGHT.
Node *node_append_list(Arena *arena, const Node *node, const NodeList *list);
// Sets program_lifetime for all nodes of a value and their descendants.
void value_mark_program_lifetime(Value v);
// Returns the attribute's value, or null.
Value node_get(const Node *node, const Symbol *name) PRIVATE_API(node_get);
// Returns true if the node has an attribute, or if the script writes it and its value is null. Also returns true if the
// location of the node is unknown.
bool node_mentions(const Node *node, const Symbol *name);
// Returns the location of an attribute. If that is unknown, returns the location of the node. If that is
// unknown too, the source of the result is NULL.
Origin node_origin(const Node *node, const Symbol *attr);
// Returns a deep copy.
const Node *node_copy(Arena *arena, const Node *node);

// Each of these functions applies the corresponding node_ function above to every node of v. Other elements are kept.
Value value_add_tag(Arena *arena, Value v, const Symbol *tag);
// If a node would exceed NODE_MAX_HEIGHT, the next two functions keep it unchanged and set *too_high.
Value value_set_attrs(Arena *arena, Value v, const Attr *attrs, uint32_t count, bool *too_high);
Value value_append(Arena *arena, Value v, const NodeList *list, bool *too_high);
