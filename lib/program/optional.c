// optional.c: optional definitions: names that only -D binds, and that the script tests before it uses them.
#include "program/compile.h"

#include <stdlib.h>

// A use of a name in the syntax tree.
typedef struct NameUse {
    const Symbol *name;
    const Ast *ast; // the name in the tree
    bool tested;    // true if it does not matter here whether the name is bound
    bool listed;    // true if this is the first use of its name and compile_list_optional has returned true
} NameUse;

// The uses in the script and in the files that it has included so far.
struct NameUses {
    Arena *arena;
    NameUse *items;
    uint32_t count;
    uint32_t capacity;
    bool sorted; // true if `items` is sorted by name, tested uses first, and address
};

static void add_use(NameUses *uses, const Ast *ast, bool tested) {
    uses->items = arena_grow_array(uses->arena, uses->items, uses->count, &uses->capacity, sizeof *uses->items);
    uses->items[uses->count++] = (NameUse){.name = ast->name, .ast = ast, .tested = tested};
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
        add_use(uses, ast, tested);
    for (uint32_t i = 0; i < ast->count && ast->kind != AST_NAMES; i++) // NAMES are bound, not used
        if (ast->children[i])
            collect_uses(uses, ast->children[i], is_tested(ast, i, tested));
}

static int by_name(const void *a, const void *b) {
    const NameUse *first = a, *second = b;
    if (first->name != second->name)
        return first->name->number < second->name->number ? -1 : 1;
    if (first->tested != second->tested)
        return first->tested ? -1 : 1;
    return ((uintptr_t)first->ast > (uintptr_t)second->ast) - ((uintptr_t)first->ast < (uintptr_t)second->ast);
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

// Returns the first element that is not less than a tested use of `name` at `ast`, or NULL if its name is different.
// With `ast` NULL, that is the first use of the name. Sets *left to the number of elements from there to the end.
static NameUse *find_use(Compiler *compiler, const Symbol *name, const Ast *ast, uint32_t *left) {
    if (!compiler->uses)
        compile_add_uses(compiler, &(Ast){.kind = AST_SUITE});
    NameUses *uses = compiler->uses;
    if (!uses->sorted && uses->count) {
        arena_charge(uses->arena, uses->count);
        qsort(uses->items, uses->count, sizeof *uses->items, by_name);
        uses->sorted = true;
    }
    const NameUse key = {.name = name, .ast = ast, .tested = true};
    uint32_t low = 0, high = uses->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (by_name(&uses->items[middle], &key) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    *left = uses->count - low;
    return *left && uses->items[low].name == name ? &uses->items[low] : NULL;
}

bool compile_is_tested(Compiler *compiler, const Ast *ast) {
    uint32_t left;
    const NameUse *use = find_use(compiler, ast->name, ast, &left);
    return use && use->tested && use->ast == ast;
}

bool compile_list_optional(Compiler *compiler, const Symbol *name) {
    uint32_t left;
    NameUse *use = find_use(compiler, name, NULL, &left);
    if (!use || !use->tested || use->listed)
        return false;
    use->listed = true;
    return true;
}

uint32_t compile_count_uses(Compiler *compiler, const Symbol *name) {
    enum { MAX_COUNTED = 3 };
    uint32_t left, count = 0;
    const NameUse *use = find_use(compiler, name, NULL, &left);
    while (use && count < MAX_COUNTED && count < left && use[count].name == name)
        count++;
    return count;
}
