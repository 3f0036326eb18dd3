// names.c: bindings of names, and hints about names without one; see compile.h.
//
// compile_unbound_hint tries hints from the most certain to the least certain: words of other languages and colours,
// then mistakes that the syntax tree shows, then similar names.
#include "builtin/builtin.h"
#include "program/compile.h"

Binding *compile_scope_find(Binding *scope, const Symbol *name) {
    while (scope && scope->name != name)
        scope = scope->outer;
    return scope;
}

const Binding *compile_find_binding(const Compiler *compiler, const Symbol *name) {
    for (const FunctionScope *function = compiler->function; function; function = function->outer) {
        const Binding *binding = compile_scope_find(function->scope, name);
        if (binding || function->self == name)
            return binding;
    }
    return NULL;
}

static const struct {
    const char *name;
    bool is_static;
} engine_names[] = {
#define ENGINE_NAME(id, text, is_static) {text, is_static},
#include "program/engine_names.h"
#undef ENGINE_NAME
};

const char *engine_name_text(EngineName name) {
    return engine_names[name].name;
}

static int find_engine_name(Str name) {
    for (int i = 0; i < ENGINE_NAME_COUNT; i++)
        if (str_equal(name, str_from(engine_names[i].name)))
            return i;
    return -1;
}

bool engine_name_exists(Str name) {
    return find_engine_name(name) >= 0;
}

int compile_find_engine_name(const Compiler *compiler, Str name, bool *is_static) {
    int found = compiler->options->module ? -1 : find_engine_name(name);
    if (found >= 0)
        *is_static = engine_names[found].is_static;
    return found;
}

const Builtin *compile_find_builtin(const Compiler *compiler, Str name) {
    for (uint32_t i = 0; i < compiler->options->function_count; i++)
        if (str_equal(str_from(compiler->options->functions[i]->name), name))
            return compiler->options->functions[i];
    return builtin_find(name);
}

bool compile_is_free(const Compiler *compiler, const Symbol *name) {
    Value value;
    bool is_static;
    return !compile_find_binding(compiler, name) && !compile_find_builtin(compiler, name->name) &&
           !builtin_constant(name->name, &value) && compile_find_engine_name(compiler, name->name, &is_static) < 0;
}

static const struct {
    const char *names;
    Str hint;
} name_hints[] = {
#define HINT(names, hint) {names, {hint, sizeof hint - 1}},
#include "program/name_hint_list.h"
};

// Returns true if a name follows `//`, which is floor division in Flitter and not a comment.
static bool follows_slashes(const Compiler *compiler, Span span) {
    const char *text = compiler->source->text.bytes;
    uint32_t at = span.start;
    while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t'))
        at--;
    return at > 1 && text[at - 1] == '/' && text[at - 2] == '/';
}

// Returns a hint "did you mean 'x'?" if a visible name is similar, else an empty string.
static Str nearest_name(Compiler *compiler, Str wanted) {
    StrNearest nearest = str_nearest(wanted);
    for (const FunctionScope *function = compiler->function; function; function = function->outer) {
        for (const Binding *binding = function->scope; binding; binding = binding->outer)
            str_try_nearest(&nearest, binding->name->name);
        if (function->self)
            str_try_nearest(&nearest, function->self->name);
    }
    for (uint32_t i = 0; !compiler->options->module && i < ENGINE_NAME_COUNT; i++)
        str_try_nearest(&nearest, str_from(engine_names[i].name));
    for (uint32_t i = 0; i < builtin_table_count; i++)
        str_try_nearest(&nearest, str_from(builtin_table[i].name));
    for (uint32_t i = 0; i < compiler->options->function_count; i++)
        str_try_nearest(&nearest, str_from(compiler->options->functions[i]->name));
    return nearest.found.len ? str_format(compiler->arena, "did you mean '%.*s'?", STR_ARGS(nearest.found)) : (Str){0};
}

// Returns the last part of the innermost vector that contains a use of a name, if that part is a loop that binds the
// name. Such a loop repeats only its own part of the vector. Otherwise returns NULL.
static const Ast *loop_to_the_right(const Ast *ast, const Ast *use) {
    while (ast && ast != use) {
        const Ast *inner = NULL, *last = ast->count ? ast->children[ast->count - 1] : NULL;
        for (uint32_t i = 0; i < ast->count && !inner; i++)
            if (ast->children[i] && ast->children[i]->span.start <= use->span.start &&
                use->span.end <= ast->children[i]->span.end)
                inner = ast->children[i];
        if (ast->kind == AST_COMPOSE && last && last->kind == AST_FOR && last != inner)
            for (uint32_t i = 0; i < last->children[0]->count; i++)
                if (last->children[0]->children[i]->name == use->name)
                    return last;
        ast = inner;
    }
    return NULL;
}

// Returns true if a use of a name is in the source of a loop that binds this name, as in `(x for x in v if x > 3)`.
static bool in_own_source(const Ast *ast, const Ast *use) {
    while (ast && ast != use) {
        const Ast *inner = NULL;
        for (uint32_t i = 0; i < ast->count && !inner; i++)
            if (ast->children[i] && ast->children[i]->span.start <= use->span.start &&
                use->span.end <= ast->children[i]->span.end)
                inner = ast->children[i];
        if (ast->kind == AST_FOR && inner == ast->children[1] && inner->kind == AST_COND)
            for (uint32_t i = 0; i < ast->children[0]->count; i++)
                if (ast->children[0]->children[i]->name == use->name)
                    return true;
        ast = inner;
    }
    return false;
}

Str compile_unbound_hint(Compiler *compiler, const Ast *ast) {
    Str name = ast->name->name;
    for (size_t i = 0; i < sizeof name_hints / sizeof name_hints[0]; i++)
        if (str_word_number(name, name_hints[i].names) >= 0)
            return name_hints[i].hint;
    Str colour = str_named_colour(name);
    if (colour.len)
        return str_format(compiler->arena, "a colour is r;g;b, each from 0 to 1: %.*s is %.*s", STR_ARGS(name),
                          STR_ARGS(colour));
    if (compiler->state_attr == ast)
        return str_format(compiler->arena, "a name for the state is a symbol: state=:%.*s", STR_ARGS(name));
    if (loop_to_the_right(compiler->root, ast))
        return STR("'for' repeats only the part after the last semicolon; put what it should repeat in parentheses");
    if (in_own_source(compiler->root, ast))
        return str_format(compiler->arena, "write the test before 'for': (%.*s if TEST for %.*s in …)", STR_ARGS(name),
                          STR_ARGS(name));
    if (compiler->subject == ast)
        return str_format(compiler->arena, "a node is written !%.*s", STR_ARGS(name));
    if (compiler->key == ast)
        return str_format(compiler->arena, "write '$:%.*s' to read the state, or the name without '$'", STR_ARGS(name));
    Str nearest = nearest_name(compiler, name);
    return nearest.len ? nearest : follows_slashes(compiler, ast->span) ? STR("comments start with '--'") : (Str){0};
}

bool compile_has_hint(Compiler *compiler, const Ast *use, const Symbol *bound) {
    StrNearest nearest = str_nearest(use->name->name);
    str_try_nearest(&nearest, bound->name);
    return nearest.found.len > 0 || compile_unbound_hint(compiler, use).len > 0;
}
