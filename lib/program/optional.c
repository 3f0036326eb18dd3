// optional.c: optional definitions: names that only -D binds, and that the script tests before it uses them.
#include "program/compile.h"

#include <stdlib.h>

// A use of a name in the syntax tree.
typedef struct NameUse {
    const Symbol *name;
    bool tested; // true if it does not matter whether the name is bound
} NameUse;

// The uses in the script and in the files that it has included so far.
struct NameUses {
    Arena *arena;
    NameUse *items;
    uint32_t count;
    uint32_t capacity;
    bool sorted; // true if `items` is sorted by name
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

void compile_add_uses(Compiler *compiler, const Ast *ast) {
    NameUses *uses = compiler->uses;
    if (!uses) {
        compiler->uses = uses = arena_alloc(compiler->scratch, sizeof *uses);
        *uses = (NameUses){.arena = compiler->scratch};
        collect_uses(uses, compiler->root, false);
    }
    collect_uses(uses, ast, false);
    uses->sorted = false;
}

// Returns the first use of a name and sets *count to the number of its uses.
static const NameUse *find_uses(Compiler *compiler, const Symbol *name, uint32_t *count) {
    *count = 0;
    if (!compiler->uses)
        compile_add_uses(compiler, &(Ast){.kind = AST_SUITE});
    NameUses *uses = compiler->uses;
    if (uses->count == 0)
        return NULL;
    if (!uses->sorted) {
        arena_charge(uses->arena, uses->count);
        qsort(uses->items, uses->count, sizeof *uses->items, by_name);
        uses->sorted = true;
    }
    const NameUse key = {.name = name}, *end = uses->items + uses->count;
    const NameUse *first = bsearch(&key, uses->items, uses->count, sizeof key, by_name);
    if (!first)
        return NULL;
    while (first > uses->items && first[-1].name == name)
        first--;
    while (first + *count < end && first[*count].name == name)
        ++*count;
    return first;
}

bool compile_is_optional(Compiler *compiler, const Symbol *name) {
    uint32_t count;
    const NameUse *uses = find_uses(compiler, name, &count);
    for (uint32_t i = 0; i < count; i++)
        if (!uses[i].tested)
            return false;
    return count > 0;
}

bool compile_is_used_once(Compiler *compiler, const Symbol *name) {
    uint32_t count;
    find_uses(compiler, name, &count);
    return count == 1;
}
