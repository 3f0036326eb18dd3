// tree_memo.c: see tree_memo.h.
//
// The cache has one entry for each hash. A result that another one has overwritten is computed again.
#include "value/tree_memo.h"

#include "maths/random.h"

#include <string.h>

enum { ENTRIES = 4096, MIN_VISITS = 512 };

static TreeMemoEntry *entry_of(const TreeMemo *memo, const Node *a, const Node *b) {
    uint64_t hash = random_hash_step((uint64_t)(uintptr_t)a, (uint64_t)(uintptr_t)b);
    return &memo->entries[(hash >> 32) % ENTRIES];
}

bool tree_memo_find(TreeMemo *memo, Arena *arena, const Node *a, const Node *b, uint64_t *value) {
    if (!arena)
        return false;
    arena_charge(arena, 2 + (uint64_t)a->attr_count);
    if (!memo->entries && ++memo->visits > MIN_VISITS)
        memo->entries = memset(arena_alloc(arena, ENTRIES * sizeof(TreeMemoEntry)), 0, ENTRIES * sizeof(TreeMemoEntry));
    if (!memo->entries)
        return false;
    const TreeMemoEntry *known = entry_of(memo, a, b);
    *value = known->value;
    return known->a == a && known->b == b;
}

void tree_memo_store(TreeMemo *memo, const Node *a, const Node *b, uint64_t value) {
    if (memo->entries)
        *entry_of(memo, a, b) = (TreeMemoEntry){a, b, value};
}
