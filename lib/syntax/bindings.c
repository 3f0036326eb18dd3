// bindings.c: see bindings.h.
//
// The scope is a stack of entries. Each name has a chain in a hash table, which begins with its innermost entry. A
// value is walked before its name is bound, because the value does not see the name.
#include "syntax/bindings.h"

#include <ctype.h>
#include <string.h>

typedef struct ScopeEntry ScopeEntry;
struct ScopeEntry {
    ScopeEntry *outer; // the entry that was added before this one
    ScopeEntry *next;  // the next entry in the same chain of the hash table
    const Symbol *name;
    uint32_t at;         // start of the name in the text
    const Ast *function; // FUNC node that the name is bound to; NULL: another value
};

typedef struct Walker {
    Arena *arena;
    const Source *source;
    BindingCallback *callback;
    void *user_data;
    ScopeEntry *scope;   // the last entry
    ScopeEntry **chains; // hash table of all entries in the scope; the last entry of each chain is its first
    size_t chain_count;
    uint32_t end;   // end of the current scope in the text
    uint32_t depth; // current value of BindingInfo.depth
} Walker;

static void walk_ast(Walker *walker, const Ast *ast);

static ScopeEntry **find_chain(const Walker *walker, const Symbol *name) {
    return &walker->chains[((uintptr_t)name >> 4) % walker->chain_count];
}

static ScopeEntry *push_entry(Walker *walker, const Symbol *name, uint32_t at, const Ast *function) {
    ScopeEntry *entry = arena_alloc(walker->arena, sizeof *entry), **chain = find_chain(walker, name);
    *entry = (ScopeEntry){walker->scope, *chain, name, at, function};
    return walker->scope = *chain = entry;
}

// Removes the entries that were added after `outer`.
static void leave_scope(Walker *walker, ScopeEntry *outer) {
    for (; walker->scope != outer; walker->scope = walker->scope->outer)
        *find_chain(walker, walker->scope->name) = walker->scope->next;
}

// Reports a binding. Its name is at offset `at` and is visible from `start` to the end of the current scope.
static void report_binding(Walker *walker, NameKind kind, const Symbol *name, uint32_t at, uint32_t start,
                           Span value_span, bool is_sole) {
    BindingInfo info = {.kind = kind,
                        .span = {at, at + (uint32_t)name->name.len},
                        .binding_start = at,
                        .scope = {start, walker->end},
                        .value = value_span,
                        .is_sole = is_sole,
                        .depth = walker->depth};
    walker->callback(walker->user_data, &info);
}

static const ScopeEntry *find_scope_entry(const Walker *walker, const Symbol *name) {
    const ScopeEntry *entry = *find_chain(walker, name);
    while (entry && entry->name != name)
        entry = entry->next;
    return entry;
}

// Reports a use of a name at offset `at`. `entry` is BindingInfo.binding_start.
static void report_use(const Walker *walker, const Symbol *name, uint32_t at, uint32_t entry) {
    BindingInfo info = {.kind = NAME_USE, .span = {at, at + (uint32_t)name->name.len}, .binding_start = entry};
    walker->callback(walker->user_data, &info);
}

static void bind_names(Walker *walker, NameKind kind, const Ast *names, uint32_t start, const Ast *value) {
    for (uint32_t i = 0; i < names->count; i++) {
        const Ast *name = names->children[i];
        report_binding(walker, kind, name->name, name->span.start, start, value->span, names->count == 1);
        push_entry(walker, name->name, name->span.start, names->count == 1 && value->kind == AST_FUNC ? value : NULL);
    }
}

static void walk_binding(Walker *walker, const Ast *binding) {
    walk_ast(walker, binding->children[1]);
    bind_names(walker, NAME_LET, binding->children[0], binding->span.end, binding->children[1]);
}

// Returns the offset of a FUNC's name: skips the word func, blanks and line continuations.
static uint32_t function_name_start(const Walker *walker, const Ast *ast) {
    const char *text = walker->source->text.bytes;
    uint32_t at = ast->span.start + 4;
    while (isspace((unsigned char)text[at]) || text[at] == '\\')
        at++;
    return at;
}

static void walk_function(Walker *walker, const Ast *ast) {
    const Ast *params = ast->children[0], *body = ast->children[1];
    ScopeEntry *outer = walker->scope;
    uint32_t end = walker->end, at = ast->name ? function_name_start(walker, ast) : 0;
    for (uint32_t i = 0; i < params->count; i++)
        if (params->children[i]->count)
            walk_ast(walker, params->children[i]->children[0]);
    ScopeEntry *self = NULL;
    if (ast->name) {
        report_binding(walker, NAME_FUNC, ast->name, at, body->span.start, ast->span, true);
        self = push_entry(walker, ast->name, at, ast);
    }
    walker->end = body->span.end;
    walker->depth++;
    for (uint32_t i = 0; i < params->count; i++) {
        const Ast *param = params->children[i];
        report_binding(walker, NAME_PARAM, param->name, param->span.start, body->span.start, param->span, true);
        push_entry(walker, param->name, param->span.start, NULL);
    }
    walk_ast(walker, body);
    walker->depth--;
    walker->end = end;
    leave_scope(walker, self ? self : outer);
}

// Walks the children of a node in a new scope that ends with the node.
static void walk_scope(Walker *walker, const Ast *ast) {
    ScopeEntry *outer = walker->scope;
    uint32_t end = walker->end;
    walker->end = ast->span.end;
    walker->depth++;
    for (uint32_t i = 0; i < ast->count; i++)
        walk_ast(walker, ast->children[i]);
    walker->depth--;
    walker->end = end;
    leave_scope(walker, outer);
}

static void walk_for(Walker *walker, const Ast *ast) {
    const Ast *body = ast->children[2];
    walk_ast(walker, ast->children[1]);
    ScopeEntry *outer = walker->scope;
    uint32_t end = walker->end;
    walker->end = body->span.end;
    bind_names(walker, NAME_LOOP, ast->children[0], body->span.start, ast->children[1]);
    walk_ast(walker, body);
    walker->end = end;
    leave_scope(walker, outer);
}

static void walk_where(Walker *walker, const Ast *ast) {
    ScopeEntry *outer = walker->scope;
    uint32_t end = walker->end;
    walker->end = ast->children[0]->span.end;
    for (uint32_t i = 1; i < ast->count; i++) {
        const Ast *binding = ast->children[i];
        walk_ast(walker, binding->children[1]);
        bind_names(walker, NAME_LET, binding->children[0], ast->span.start, binding->children[1]);
    }
    walk_ast(walker, ast->children[0]);
    walker->end = end;
    leave_scope(walker, outer);
}

// Reports names of named arguments as uses of the called function's parameters.
static void walk_call(Walker *walker, const Ast *ast) {
    const Ast *callee = ast->children[0];
    const ScopeEntry *entry = callee->kind == AST_NAME ? find_scope_entry(walker, callee->name) : NULL;
    const Ast *params = entry && entry->function ? entry->function->children[0] : NULL;
    walk_ast(walker, callee);
    for (uint32_t i = 1; i < ast->count; i++) {
        const Ast *argument = ast->children[i];
        bool named = argument->kind == AST_NAMED || argument->kind == AST_ATTR;
        for (uint32_t k = 0; named && params && k < params->count; k++)
            if (params->children[k]->name == argument->name)
                report_use(walker, argument->name, argument->span.start, params->children[k]->span.start);
        walk_ast(walker, named ? argument->children[0] : argument);
    }
}

static void walk_ast(Walker *walker, const Ast *ast) {
    const ScopeEntry *entry;
    if (!ast)
        return;
    arena_charge(walker->arena, 1);
    switch (ast->kind) {
    case AST_NAME:
        entry = find_scope_entry(walker, ast->name);
        report_use(walker, ast->name, ast->span.start, entry ? entry->at : NAME_FREE);
        break;
    case AST_BINDING:
        walk_binding(walker, ast);
        break;
    case AST_FUNC:
        walk_function(walker, ast);
        break;
    case AST_IMPORT:
        walk_ast(walker, ast->children[1]);
        bind_names(walker, NAME_IMPORT, ast->children[0], ast->span.end, ast->children[1]);
        break;
    case AST_FOR:
        walk_for(walker, ast);
        break;
    case AST_WHERE:
        walk_where(walker, ast);
        break;
    case AST_SUITE:
        walk_scope(walker, ast);
        break;
    case AST_CALL:
    case AST_TEMPLATE:
        walk_call(walker, ast);
        break;
    default:
        for (uint32_t i = 0; i < ast->count; i++)
            walk_ast(walker, ast->children[i]);
        break;
    }
}

void bindings_read(Arena *arena, const Source *source, const Ast *ast, BindingCallback *callback, void *user_data) {
    Walker walker = {.arena = arena,
                     .source = source,
                     .callback = callback,
                     .user_data = user_data,
                     .chain_count = 1 + source->text.len / 8,
                     .end = (uint32_t)source->text.len};
    walker.chains = arena_alloc_array(arena, walker.chain_count, sizeof *walker.chains);
    memset(walker.chains, 0, walker.chain_count * sizeof *walker.chains);
    for (uint32_t i = 0; ast && i < ast->count; i++)
        walk_ast(&walker, ast->children[i]);
}
