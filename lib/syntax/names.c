// names.c: see names.h.
#include "syntax/names.h"

#include <ctype.h>

typedef struct Bound Bound;
struct Bound {
    Bound *outer;
    const Symbol *name;
    uint32_t at;
    const Ast *function; // what it is bound to, if that is a function
};

typedef struct Walker {
    Arena *arena;
    const Source *source;
    NamesTake *take;
    void *host;
    Bound *scope;
    uint32_t end; // of the innermost suite or expression that bindings hold in
    uint32_t height;
} Walker;

static void walk(Walker *walker, const Ast *ast);

static Bound *push(Walker *walker, const Symbol *name, uint32_t at, const Ast *function) {
    Bound *bound = arena_alloc(walker->arena, sizeof *bound);
    *bound = (Bound){walker->scope, name, at, function};
    return walker->scope = bound;
}

// A name that is visible from `from` to the end of what is around it. Its span may hold more behind it.
static void bind(Walker *walker, NameKind kind, const Symbol *name, uint32_t at, uint32_t from, Span whole,
                 bool alone) {
    NameNote note = {.kind = kind,
                     .span = {at, at + (uint32_t)name->name.len},
                     .bound = at,
                     .scope = {from, walker->end},
                     .whole = whole,
                     .alone = alone,
                     .height = walker->height};
    walker->take(walker->host, &note);
}

static const Bound *find(const Walker *walker, const Symbol *name) {
    const Bound *bound = walker->scope;
    while (bound && bound->name != name)
        bound = bound->outer;
    return bound;
}

static void use(const Walker *walker, const Symbol *name, uint32_t at, uint32_t bound) {
    NameNote note = {.kind = NAME_USE, .span = {at, at + (uint32_t)name->name.len}, .bound = bound};
    walker->take(walker->host, &note);
}

static void bind_names(Walker *walker, NameKind kind, const Ast *names, uint32_t from, const Ast *value) {
    for (uint32_t i = 0; i < names->count; i++) {
        const Ast *name = names->children[i];
        bind(walker, kind, name->name, name->span.start, from, value->span, names->count == 1);
        push(walker, name->name, name->span.start, names->count == 1 && value->kind == AST_FUNC ? value : NULL);
    }
}

static void walk_binding(Walker *walker, const Ast *binding) {
    walk(walker, binding->children[1]);
    bind_names(walker, NAME_LET, binding->children[0], binding->span.end, binding->children[1]);
}

// Where the name of a FUNC stands: behind the word, blanks and lines that go on.
static uint32_t function_name(const Walker *walker, const Ast *ast) {
    const char *text = walker->source->text.bytes;
    uint32_t at = ast->span.start + 4;
    while (isspace((unsigned char)text[at]) || text[at] == '\\')
        at++;
    return at;
}

static void walk_function(Walker *walker, const Ast *ast) {
    const Ast *params = ast->children[0], *body = ast->children[1];
    Bound *outer = walker->scope;
    uint32_t end = walker->end, at = ast->name ? function_name(walker, ast) : 0;
    for (uint32_t i = 0; i < params->count; i++)
        if (params->children[i]->count)
            walk(walker, params->children[i]->children[0]);
    Bound *self = NULL;
    if (ast->name) {
        bind(walker, NAME_FUNC, ast->name, at, body->span.start, ast->span, true);
        self = push(walker, ast->name, at, ast);
    }
    walker->end = body->span.end;
    walker->height++;
    for (uint32_t i = 0; i < params->count; i++) {
        const Ast *param = params->children[i];
        bind(walker, NAME_PARAM, param->name, param->span.start, body->span.start, param->span, true);
        push(walker, param->name, param->span.start, NULL);
    }
    walk(walker, body);
    walker->height--;
    walker->end = end;
    walker->scope = self ? self : outer;
}

// The children of an AST from `first` on, in a scope of their own that ends with it.
static void walk_scope(Walker *walker, const Ast *ast, uint32_t first) {
    Bound *outer = walker->scope;
    uint32_t end = walker->end;
    walker->end = ast->span.end;
    walker->height++;
    for (uint32_t i = first; i < ast->count; i++)
        walk(walker, ast->children[i]);
    walker->height--;
    walker->end = end;
    walker->scope = outer;
}

static void walk_for(Walker *walker, const Ast *ast) {
    const Ast *body = ast->children[2];
    walk(walker, ast->children[1]);
    Bound *outer = walker->scope;
    uint32_t end = walker->end;
    walker->end = body->span.end;
    bind_names(walker, NAME_LOOP, ast->children[0], body->span.start, ast->children[1]);
    walk(walker, body);
    walker->end = end;
    walker->scope = outer;
}

static void walk_where(Walker *walker, const Ast *ast) {
    Bound *outer = walker->scope;
    uint32_t end = walker->end;
    walker->end = ast->children[0]->span.end;
    for (uint32_t i = 1; i < ast->count; i++) {
        const Ast *binding = ast->children[i];
        walk(walker, binding->children[1]);
        bind_names(walker, NAME_LET, binding->children[0], ast->span.start, binding->children[1]);
    }
    walk(walker, ast->children[0]);
    walker->end = end;
    walker->scope = outer;
}

// The names of arguments are those of the parameters.
static void walk_call(Walker *walker, const Ast *ast) {
    const Ast *callee = ast->children[0];
    const Bound *bound = callee->kind == AST_NAME ? find(walker, callee->name) : NULL;
    const Ast *params = bound && bound->function ? bound->function->children[0] : NULL;
    walk(walker, callee);
    for (uint32_t i = 1; i < ast->count; i++) {
        const Ast *argument = ast->children[i];
        bool named = argument->kind == AST_NAMED || argument->kind == AST_ATTR;
        for (uint32_t k = 0; named && params && k < params->count; k++)
            if (params->children[k]->name == argument->name)
                use(walker, argument->name, argument->span.start, params->children[k]->span.start);
        walk(walker, named ? argument->children[0] : argument);
    }
}

static void walk(Walker *walker, const Ast *ast) {
    const Bound *bound;
    if (!ast)
        return;
    arena_charge(walker->arena, 1);
    switch (ast->kind) {
    case AST_NAME:
        bound = find(walker, ast->name);
        use(walker, ast->name, ast->span.start, bound ? bound->at : NAME_FREE);
        break;
    case AST_BINDING:
        walk_binding(walker, ast);
        break;
    case AST_FUNC:
        walk_function(walker, ast);
        break;
    case AST_IMPORT:
        walk(walker, ast->children[1]);
        bind_names(walker, NAME_IMPORT, ast->children[0], ast->span.end, ast->children[1]);
        break;
    case AST_FOR:
        walk_for(walker, ast);
        break;
    case AST_WHERE:
        walk_where(walker, ast);
        break;
    case AST_SUITE:
        walk_scope(walker, ast, 0);
        break;
    case AST_CALL:
    case AST_TEMPLATE:
        walk_call(walker, ast);
        break;
    default:
        for (uint32_t i = 0; i < ast->count; i++)
            walk(walker, ast->children[i]);
        break;
    }
}

void names_read(Arena *arena, const Source *source, const Ast *ast, NamesTake *take, void *host) {
    Walker walker = {.arena = arena, .source = source, .take = take, .host = host, .end = (uint32_t)source->text.len};
    for (uint32_t i = 0; ast && i < ast->count; i++)
        walk(&walker, ast->children[i]);
}
