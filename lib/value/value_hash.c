// value_hash.c: see value_hash.h.
//
// A hash does not depend on how a value was made: attributes are hashed in the order of their names, and children in
// batches like other children.
#include "value/value_hash.h"

#include "base/number.h"
#include "maths/random.h"
#include "value/node_batch.h"
#include "value/tree_memo.h"

#include <math.h>

typedef struct Hashing {
    Arena *arena; // NULL: nothing is charged
    TreeMemo memo;
} Hashing;

static uint64_t hash_vector(Hashing *hashing, Value v, bool floored);

static uint64_t hash_node(Hashing *hashing, const Node *node) {
    uint64_t hash;
    if (tree_memo_find(&hashing->memo, hashing->arena, node, NULL, &hash))
        return hash;
    hash = random_hash_step(RANDOM_HASH_START, symbol_hash(node->kind->name));
    for (uint32_t i = 0; i < node->tag_count; i++)
        hash = random_hash_step(hash, symbol_hash(node->tags[i]->name));
    // Attributes are hashed in the order of their names, not in the order in which they were set.
    const Symbol *last = NULL;
    for (uint32_t done = 0; done < node->attr_count; done++) {
        const Attr *next = NULL;
        if (hashing->arena)
            arena_charge(hashing->arena, node->attr_count / 4);
        for (uint32_t i = 0; i < node->attr_count; i++) {
            const Attr *attr = &node->attrs[i];
            if ((!last || str_compare(attr->name->name, last->name) > 0) &&
                (!next || str_compare(attr->name->name, next->name->name) < 0))
                next = attr;
        }
        if (!next)
            break;
        hash = random_hash_step(hash, symbol_hash(next->name->name));
        hash = random_hash_step(hash, hash_vector(hashing, next->value, false));
        last = next->name;
    }
    uint32_t count;
    const Node *const *children = node_children(hashing->arena, node, &count);
    for (uint32_t i = 0; i < count; i++)
        hash = random_hash_step(hash, hash_node(hashing, children[i]));
    tree_memo_store(&hashing->memo, node, NULL, hash);
    return hash;
}

static uint64_t hash_item(Hashing *hashing, Item item, bool floored) {
    switch (item.type) {
    case ITEM_NUMBER:
        return floored || isnan(item.as.number) ? random_hash_number(item.as.number) : number_bits(item.as.number);
    case ITEM_STRING:
        return symbol_hash(item.as.string->text);
    case ITEM_NODE:
        return hash_node(hashing, item.as.node);
    default:
        return symbol_hash(item.as.function->name); // hashes of functions are not specified; the name is reproducible
    }
}

static uint64_t hash_vector(Hashing *hashing, Value v, bool floored) {
    uint64_t hash = RANDOM_HASH_START;
    for (uint32_t i = 0; i < v.len; i++) {
        if (i % BUDGET_CHUNK == BUDGET_CHUNK - 1 && hashing->arena)
            arena_charge(hashing->arena, BUDGET_CHUNK / 4);
        hash = random_hash_step(hash, hash_item(hashing, value_at(&v, i), floored));
    }
    return hash;
}

static uint64_t hash_all(Arena *arena, Value seed, bool floored) {
    Hashing hashing = {arena, {0}};
    ArenaMark mark = arena ? arena_mark(arena) : (ArenaMark){0};
    uint64_t hash = hash_vector(&hashing, seed, floored);
    if (hashing.memo.entries)
        arena_rewind(arena, mark);
    return hash;
}

uint64_t value_exact_hash(Arena *arena, Value seed) {
    return hash_all(arena, seed, false);
}

uint64_t value_seed_hash(Arena *arena, Value seed) {
    return hash_all(arena, seed, true);
}
