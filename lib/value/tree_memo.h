// tree_memo.h: walking trees whose nodes are shared, so that a walk has more steps than there are nodes.
//
// A walk charges for each node that it comes to and, once they are many, remembers what it found out about the last
// ones. All zeros begins a walk; what it remembers lies in the arena, above whatever is there.
#ifndef PETRI_VALUE_TREE_MEMO_H
#define PETRI_VALUE_TREE_MEMO_H

#include "value/node.h"

typedef struct TreeMemoEntry {
    const Node *a;
    const Node *b;
    uint64_t value;
} TreeMemoEntry;

typedef struct Walk {
    TreeMemoEntry *entries; // by hash, the latest wins; NULL: it has not come far yet
    uint32_t visits;
} TreeMemo;

// Comes to a node, or to two at once (`b` may be NULL); true if their fact is known. Without an arena nothing is
// charged and nothing remembered.
bool tree_memo_find(TreeMemo *memo, Arena *arena, const Node *a, const Node *b, uint64_t *value);
void tree_memo_store(TreeMemo *memo, const Node *a, const Node *b, uint64_t value);

#endif
