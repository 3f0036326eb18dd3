// scope.c: scopes and name resolution; see compile.h.
//
// A name is searched from the innermost scope to the outermost, then among predefined names. A name of an enclosing
// function is captured by each function in between, so that a closure copies values only from the function that creates
// it.
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
    compile_set_dependencies(expr);
    return expr;
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
    Binding *binding = compile_scope_find(function->scope, ast->name);
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

// Resolves a name of the engine, of a definition (-D) or of a built-in, in this order (L8.1). Returns NULL if the name
// is none of these.
static const Expr *find_predefined(Compiler *compiler, const Ast *ast) {
    Str name = ast->name->name;
    const CompileOptions *options = compiler->options;
    bool is_static;
    int engine_name = compile_find_engine_name(compiler, name, &is_static);
    if (engine_name >= 0) {
        Expr *expr = slot_expr(compiler, EXPR_GLOBAL, ast, (uint32_t)engine_name);
        expr->dynamic = !is_static;
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

static const Expr *compile_unbound(Compiler *compiler, const Ast *ast) {
    Str name = ast->name->name;
    if (ast == compiler->parameter_use || ast == compiler->parameter_test)
        return compile_constant(compiler, ast, VALUE_NULL);
    if (compiler->options->module) {
        Expr *expr = compile_expr_new(compiler, EXPR_UNBOUND, ast, NULL, 0);
        expr->as.name = ast->name;
        return expr;
    }
    Str hint = compile_unbound_hint(compiler, ast);
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
