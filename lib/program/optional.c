// optional.c: optional definitions: names that only -D binds, and that the script tests before it uses them.
#include "program/compile.h"

#include <stdlib.h>

// A use of a name in the syntax tree.
typedef struct NameUse {
    const Symbol *name;
    bool tested; // true if it does not matter whether the name is bound
} NameUse;

// The uses of a file, sorted by name.
struct NameUses {
    Arena *arena;
    NameUse *items;
    uint32_t count;
    uint32_t capacity;
};

static void add_use(NameUses *uses, const Symbol *name, bool tested) {
    uses->items = arena_grow_array(uses->arena, uses->items, uses->count, &uses->capacity, sizeof *uses->items);
    uses->items[uses->count++] = (NameUse){name, tested};
}

// Returns true if child `i` of a node is only tested, where `tested` is true if the node is only tested itself.
static bool is_tested(const Ast *ast, uint32_t i, bool tested) {
    switch (ast->kind) {
    case AST_OR:
    case AST_AND:
        return i == 0 || tested;
    case AST_NOT:
        return true;
    case AST_COND:
        return i == 1 || tested;
    case AST_IF:
        return i % 2 == 0 && i + 1 < ast->count;
    default:
        return false;
    }
}

static void collect_uses(NameUses *uses, const Ast *ast, bool tested) {
    if (ast->kind == AST_NAME)
        add_use(uses, ast->name, tested);
    for (uint32_t i = 0; i < ast->count && ast->kind != AST_NAMES; i++) // NAMES are bound, not used
        if (ast->children[i])
            collect_uses(uses, ast->children[i], is_tested(ast, i, tested));
}

static int by_name(const void *a, const void *b) {
    double first = ((const NameUse *)a)->name->number, second = ((const NameUse *)b)->name->number;
    return first < second ? -1 : first > second;
}

static NameUses *find_uses(Arena *arena, const Ast *ast) {
    NameUses *uses = arena_alloc(arena, sizeof *uses);
    *uses = (NameUses){.arena = arena};
    collect_uses(uses, ast, false);
    if (uses->count > 0)
        qsort(uses->items, uses->count, sizeof *uses->items, by_name);
    return uses;
}

bool compile_is_optional(Compiler *compiler, const Symbol *name) {
    if (!compiler->uses)
        compiler->uses = find_uses(compiler->scratch, compiler->root);
    const NameUses *uses = compiler->uses;
    const NameUse key = {.name = name}, *first = NULL;
    if (uses->count > 0)
        first = bsearch(&key, uses->items, uses->count, sizeof key, by_name);
    if (!first)
        return false; // the name is used in an included file only
    while (first > uses->items && first[-1].name == name)
        first--;
    for (; first < uses->items + uses->count && first->name == name; first++)
        if (!first->tested)
            return false;
    return true;
}
