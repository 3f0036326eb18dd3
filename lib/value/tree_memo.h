// tree_memo.h: memoisation for traversals of trees with shared nodes, which may visit a node many times.
//
// A traversal charges for each visited node. After many visits it caches the results for recently visited nodes in the
// arena. Each traversal starts with a zero-initialised TreeMemo.
#pragma once

#include "value/node.h"

typedef struct TreeMemoEntry {
    const Node *a;
    const Node *b;
    uint64_t value;
} TreeMemoEntry;

typedef struct TreeMemo {
    TreeMemoEntry *entries; // cache indexed by hash, where a new entry overwrites an old one; NULL: few visits so far
    uint32_t visits;        // number of visits; counted only until `entries` is allocated
} TreeMemo;

// Charges the visit of a node, or of a pair of nodes (b may be NULL). If the result is cached, stores it in *value and
// returns true. If the arena is NULL, nothing is charged or cached.
bool tree_memo_find(TreeMemo *memo, Arena *arena, const Node *a, const Node *b, uint64_t *value);
// Caches the result for a node or a pair of nodes.
void tree_memo_store(TreeMemo *memo, const Node *a, const Node *b, uint64_t value);
