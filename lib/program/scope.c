// scope.c: scopes and name resolution; see compile.h.
#include "builtin/builtin.h"
#include "program/compile.h"

ScopeMark compile_scope_open(Compiler *compiler) {
    return (ScopeMark){compiler->function->scope, compiler->function->next_slot};
}

// The slots of a closed scope can be reused, because closures have copied the values that they need.
void compile_scope_close(Compiler *compiler, ScopeMark mark) {
    lint_unused(compiler, compiler->function->scope, mark.scope);
    compiler->function->scope = mark.scope;
    compiler->function->next_slot = mark.next_slot;
}

static Binding *add_binding(Compiler *compiler, BindingKind kind, const Symbol *name, Span span) {
    FunctionScope *function = compiler->function;
    Binding *binding = arena_alloc(compiler->scratch, sizeof *binding);
    *binding =
        (Binding){.outer = function->scope, .name = name, .slot = function->next_slot++, .span = span, .kind = kind};
    function->scope = binding;
    lint_bind(compiler, binding);
    compile_note_define(compiler, binding);
    if (function->next_slot > function->frame_size)
        function->frame_size = function->next_slot;
    return binding;
}

uint32_t compile_bind(Compiler *compiler, BindingKind kind, const Symbol *name, Span span, const Ast *value) {
    Binding *binding = add_binding(compiler, kind, name, span);
    binding->value = value;
    return binding->slot;
}

uint32_t compile_bind_names(Compiler *compiler, BindingKind kind, const Ast *names, const Ast *value) {
    uint32_t slot = compiler->function->next_slot;
    Traits traits = value ? lint_traits(compiler, value) : (Traits){0};
    for (uint32_t i = 0; i < names->count; i++) {
        Binding *binding = add_binding(compiler, kind, names->children[i]->name, names->children[i]->span);
        binding->value = names->count == 1 && kind == BINDING_LET ? value : NULL;
        binding->traits = traits;
    }
    return slot;
}

void compile_function_open(Compiler *compiler, FunctionScope *function, const Symbol *self) {
    *function = (FunctionScope){.outer = compiler->function, .self = self};
    compiler->function = function;
}

void compile_function_close(Compiler *compiler, FunctionScope *function) {
    lint_unused(compiler, function->scope, NULL);
    compiler->function = function->outer;
}

static Expr *slot_expr(Compiler *compiler, ExprKind kind, const Ast *ast, uint32_t slot) {
    Expr *expr = compile_expr_new(compiler, kind, ast, NULL, 0);
    expr->slot = slot;
    fold_set_dependencies(expr);
    return expr;
}

static Binding *find_binding(Binding *scope, const Symbol *name) {
    while (scope && scope->name != name)
        scope = scope->outer;
    return scope;
}

const Binding *compile_find_binding(const Compiler *compiler, const Symbol *name) {
    for (const FunctionScope *function = compiler->function; function; function = function->outer) {
        const Binding *binding = find_binding(function->scope, name);
        if (binding || function->self == name)
            return binding;
    }
    return NULL;
}

// Makes `function` capture a name, unless it already does, and returns a CAPTURE expression. `outer` is the expression
// to which the name is resolved in the enclosing function.
static const Expr *add_capture(Compiler *compiler, FunctionScope *function, const Ast *ast, const Expr *outer) {
    Capture wanted = {outer->kind == EXPR_SLOT      ? CAPTURE_SLOT
                      : outer->kind == EXPR_CAPTURE ? CAPTURE_OUTER
                                                    : CAPTURE_SELF,
                      outer->slot};
    for (uint32_t i = 0; i < function->capture_count; i++)
        if (function->capture_names[i] == ast->name && function->captures[i].kind == wanted.kind &&
            function->captures[i].slot == wanted.slot)
            return slot_expr(compiler, EXPR_CAPTURE, ast, i);
    uint32_t capacity = function->capture_capacity, count = function->capture_count;
    function->captures = arena_grow_array(compiler->scratch, function->captures, count, &capacity, sizeof(Capture));
    function->capture_names = arena_grow_array(compiler->scratch, function->capture_names, count,
                                               &function->capture_capacity, sizeof(const Symbol *));
    function->captures[function->capture_count] = wanted;
    function->capture_names[function->capture_count] = ast->name;
    return slot_expr(compiler, EXPR_CAPTURE, ast, function->capture_count++);
}

// Resolves a name that is used in `function`. Returns NULL if the program does not bind the name.
static const Expr *find_in_program(Compiler *compiler, FunctionScope *function, const Ast *ast) {
    if (!function)
        return NULL;
    Binding *binding = find_binding(function->scope, ast->name);
    if (binding) {
        binding->used = true;
        return binding->is_constant ? compile_constant(compiler, ast, binding->constant)
                                    : slot_expr(compiler, EXPR_SLOT, ast, binding->slot);
    }
    if (function->self == ast->name)
        return slot_expr(compiler, EXPR_SELF, ast, 0);
    const Expr *outer = find_in_program(compiler, function->outer, ast);
    if (!outer || outer->kind == EXPR_CONST)
        return outer;
    return add_capture(compiler, function, ast, outer);
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

bool engine_name_exists(Str name) {
    for (uint32_t i = 0; i < ENGINE_NAME_COUNT; i++)
        if (str_equal(name, str_from(engine_names[i].name)))
            return true;
    return false;
}

const Builtin *compile_find_builtin(const Compiler *compiler, Str name) {
    for (uint32_t i = 0; i < compiler->options->function_count; i++)
        if (str_equal(str_from(compiler->options->functions[i]->name), name))
            return compiler->options->functions[i];
    return builtin_find(name);
}

bool compile_is_free(const Compiler *compiler, const Symbol *name) {
    Value value;
    return !compile_find_binding(compiler, name) && !compile_find_builtin(compiler, name->name) &&
           !builtin_constant(name->name, &value) && (compiler->options->module || !engine_name_exists(name->name));
}

// Resolves a name of the engine, of a definition (-D) or of a built-in, in this order (L8.1). Returns NULL if the name
// is none of these.
static const Expr *find_predefined(Compiler *compiler, const Ast *ast) {
    Str name = ast->name->name;
    const CompileOptions *options = compiler->options;
    for (uint32_t i = 0; !options->module && i < ENGINE_NAME_COUNT; i++)
        if (str_equal(name, str_from(engine_names[i].name))) {
            Expr *expr = slot_expr(compiler, EXPR_GLOBAL, ast, i);
            expr->dynamic = !engine_names[i].is_static;
            return expr;
        }
    for (uint32_t i = options->module ? 0 : options->define_count; i > 0; i--)
        if (options->defines[i - 1].name == ast->name) {
            compiler->define_uses[i - 1].read = true;
            return compile_constant(compiler, ast, options->defines[i - 1].value);
        }
    Value value;
    if (builtin_constant(name, &value))
        return compile_constant(compiler, ast, value);
    const Builtin *builtin = compile_find_builtin(compiler, name);
    if (!builtin)
        return NULL;
    Function *function = arena_alloc(compiler->arena, sizeof *function);
    *function = (Function){.name = str_from(builtin->name), .builtin = builtin};
    Expr *expr = compile_constant(compiler, ast, value_function(compiler->arena, function));
    expr->dynamic = !builtin->pure;
    return expr;
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

// Returns a hint about the probable cause of an unbound name, or an empty string.
static Str unbound_hint(Compiler *compiler, const Ast *ast) {
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
    return nearest.found.len > 0 || unbound_hint(compiler, use).len > 0;
}

static const Expr *compile_unbound(Compiler *compiler, const Ast *ast) {
    Str name = ast->name->name;
    if (ast == compiler->parameter_use || ast == compiler->parameter_test)
        return compile_constant(compiler, ast, VALUE_NULL);
    if (compiler->options->module) {
        Expr *expr = compile_expr_new(compiler, EXPR_UNBOUND, ast, NULL, 0);
        expr->as.name = ast->name;
        return expr;
    }
    Str hint = unbound_hint(compiler, ast);
    if (hint.len || !compile_is_tested(compiler, ast))
        compile_report(compiler, ast->span, DIAG_WARNING, "unbound-name",
                       str_format(compiler->arena, "unbound name '%.*s' is null", STR_ARGS(name)), hint);
    else if (compiler->options->lint && compile_list_optional(compiler, ast->name))
        compile_report(compiler, ast->span, DIAG_NOTE, "optional-definition",
                       str_format(compiler->arena, "'%.*s' is optional; to set it, use -D %.*s=VALUE", STR_ARGS(name),
                                  STR_ARGS(name)),
                       (Str){0});
    return compile_constant(compiler, ast, VALUE_NULL);
}

const Expr *compile_name(Compiler *compiler, const Ast *ast) {
    const Expr *expr = find_in_program(compiler, compiler->function, ast);
    if (!expr)
        expr = find_predefined(compiler, ast);
    return expr ? expr : compile_unbound(compiler, ast);
}
