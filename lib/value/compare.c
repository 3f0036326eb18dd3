// compare.c: equality and order of vectors and nodes (spec language.md L5.4 to L5.6, L7.5).
//
// Nodes are shared, so 60 nodes in memory can form a tree of 2^60 nodes. Comparisons therefore remember pairs of nodes
// that were found equal (tree_memo.h), and charge each visited pair.
#include "value/node_batch.h"
#include "value/tree_memo.h"

typedef struct Comparison {
    Arena *arena; // NULL: nothing is charged
    TreeMemo memo;
} Comparison;

static bool equal_values(Comparison *comparison, Value a, Value b);

static bool equal_attrs(Comparison *comparison, const Node *a, const Node *b) {
    for (uint32_t i = 0; i < a->attr_count; i++) {
        uint32_t at = i; // attributes are nearly always in the same order
        if (b->attrs[at].name != a->attrs[i].name) {
            if (comparison->arena)
                arena_charge(comparison->arena, b->attr_count / 4);
            for (at = 0; at < b->attr_count && b->attrs[at].name != a->attrs[i].name;)
                at++;
        }
        if (at == b->attr_count || !equal_values(comparison, a->attrs[i].value, b->attrs[at].value))
            return false;
    }
    return true;
}

static bool equal_nodes(Comparison *comparison, const Node *a, const Node *b) {
    if (a == b && a->attr_count == 0 && a->child_count == 0)
        return true;
    if (a->kind != b->kind || a->tag_count != b->tag_count || a->attr_count != b->attr_count ||
        node_child_count(a) != node_child_count(b))
        return false;
    uint64_t known;
    if (tree_memo_find(&comparison->memo, comparison->arena, a, b, &known))
        return true;
    for (uint32_t i = 0; i < a->tag_count; i++)
        if (a->tags[i] != b->tags[i])
            return false;
    if (!equal_attrs(comparison, a, b))
        return false;
    uint32_t count;
    const Node *const *ours = node_children(comparison->arena, a, &count);
    const Node *const *theirs = node_children(comparison->arena, b, &count);
    for (uint32_t i = 0; i < count; i++)
        if (!equal_nodes(comparison, ours[i], theirs[i]))
            return false;
    tree_memo_store(&comparison->memo, a, b, true);
    return true;
}

static bool equal_items(Comparison *comparison, Item a, Item b) {
    if (a.type != b.type)
        return false;
    switch (a.type) {
    case ITEM_NUMBER:
        return a.as.number == b.as.number;
    case ITEM_STRING:
        return str_equal(a.as.string->text, b.as.string->text);
    case ITEM_NODE:
        return equal_nodes(comparison, a.as.node, b.as.node);
    default:
        // Closures are compared by address, built-in functions by table row.
        return a.as.function == b.as.function ||
               (a.as.function->builtin && a.as.function->builtin == b.as.function->builtin);
    }
}

// Returns how many pairs of the first `len` elements of a and b are equal before the first difference.
static uint32_t equal_prefix_length(Comparison *comparison, Value a, Value b, uint32_t len) {
    for (uint32_t i = 0; i < len; i++) {
        if (i % BUDGET_CHUNK == 0 && comparison->arena)
            arena_charge(comparison->arena, (len - i < BUDGET_CHUNK ? len - i : BUDGET_CHUNK) / 4);
        if (!equal_items(comparison, value_at(&a, i), value_at(&b, i)))
            return i;
    }
    return len;
}

static bool equal_values(Comparison *comparison, Value a, Value b) {
    if (a.kind == VALUE_STREAM || b.kind == VALUE_STREAM)
        return a.kind == b.kind && a.stream == b.stream && a.as.key == b.as.key;
    return a.len == b.len && equal_prefix_length(comparison, a, b, a.len) == a.len;
}

bool value_equal(Arena *arena, Value a, Value b) {
    Comparison comparison = {arena, {0}};
    ArenaMark mark = arena ? arena_mark(arena) : (ArenaMark){0};
    bool equal = equal_values(&comparison, a, b);
    if (comparison.memo.entries)
        arena_rewind(arena, mark);
    return equal;
}

bool item_equal(Arena *arena, Item a, Item b) {
    Value x = {.len = 1, .kind = VALUE_MIXED, .as.items = &a}, y = {.len = 1, .kind = VALUE_MIXED, .as.items = &b};
    return value_equal(arena, x, y);
}

// Compares two elements that are not equal.
static int item_compare_unequal(Item a, Item b) {
    if (a.type == ITEM_NUMBER && b.type == ITEM_NUMBER)
        return a.as.number < b.as.number ? -1 : 1; // 1 if either number is NaN
    if (a.type == ITEM_STRING && b.type == ITEM_STRING)
        return str_compare(a.as.string->text, b.as.string->text);
    return VALUE_INCOMPARABLE;
}

int value_compare(Arena *arena, Value a, Value b) {
    if (a.len == 0 || b.len == 0)
        return (a.len > 0) - (b.len > 0);
    if (a.kind != b.kind)
        return VALUE_INCOMPARABLE;
    if (a.len == b.len && a.len > 1 && a.as.items == b.as.items)
        return 0; // identical vectors are equal (L5.5 rule 1)
    Comparison comparison = {arena, {0}};
    ArenaMark mark = arena ? arena_mark(arena) : (ArenaMark){0};
    uint32_t len = a.len < b.len ? a.len : b.len, same = equal_prefix_length(&comparison, a, b, len);
    if (comparison.memo.entries)
        arena_rewind(arena, mark);
    return same < len ? item_compare_unequal(value_at(&a, same), value_at(&b, same))
                      : (a.len > b.len) - (a.len < b.len);
}

bool value_contains(Arena *arena, Value x, Value y) {
    if (x.len == 0)
        return true;
    Comparison comparison = {arena, {0}};
    ArenaMark mark = arena ? arena_mark(arena) : (ArenaMark){0};
    bool found = false;
    uint32_t looked_at = 0;
    for (uint32_t start = 0; !found && start + x.len <= y.len && y.len; start++) {
        uint32_t i = 0;
        for (; i < x.len; i++) {
            if (looked_at++ >= BUDGET_CHUNK && arena) {
                arena_charge(arena, BUDGET_CHUNK / 2);
                looked_at = 0;
            }
            if (!equal_items(&comparison, value_at(&x, i), value_at(&y, start + i)))
                break;
        }
        found = i == x.len;
    }
    if (comparison.memo.entries)
        arena_rewind(arena, mark);
    return found;
}
