// lint.c: lints of code that is valid but unlikely to be intended; see compile.h.
//
// Lints never change the code. Those that need names as they are written take the syntax tree; those that need
// constants take the folded expression.
#include "base/file.h"
#include "builtin/builtin.h"
#include "program/compile.h"
#include "value/format.h"

static bool lint_enabled(const Compiler *compiler) {
    return compiler->options->lint && !compiler->in_include_path;
}

static void add_warning(Compiler *compiler, Span span, const char *code, Str text) {
    compile_report(compiler, span, DIAG_WARNING, code, text, (Str){0});
}

static void add_warning_with_hint(Compiler *compiler, Span span, const char *code, Str text, Str hint) {
    compile_report(compiler, span, DIAG_WARNING, code, text, hint);
}

static bool is_builtin(const Compiler *compiler, Str name) {
    Value value;
    return compile_find_builtin(compiler, name) || builtin_constant(name, &value);
}

void lint_bind(Compiler *compiler, const Binding *binding) {
    Str name = binding->name->name;
    if (lint_enabled(compiler) && is_builtin(compiler, name))
        compile_report(compiler, binding->span, DIAG_NOTE, "shadowed-builtin",
                       str_format(compiler->arena, "this '%.*s' hides the built-in of the same name", STR_ARGS(name)),
                       (Str){0});
}

// Returns true for the name of a loop, because some loops only repeat their body. Also returns true for names that
// start with an underscore.
static bool can_be_unused(const Binding *binding) {
    return binding->kind == BINDING_LOOP || binding->name->name.bytes[0] == '_';
}

// Returns true if an expression uses a name.
static bool mentions(const Ast *ast, const Symbol *name) {
    bool found = ast->kind == AST_NAME && ast->name == name;
    for (uint32_t i = 0; i < ast->count && !found; i++)
        found = ast->children[i] && mentions(ast->children[i], name);
    return found;
}

static Str unused_hint(const Binding *binding, bool top_level) {
    if (binding->value && mentions(binding->value, binding->name))
        return STR("a 'let' binds a new name and changes no other one; to add up numbers, write 'sum(x for x in v)'");
    if (top_level && (binding->kind == BINDING_FUNC || binding->kind == BINDING_LET))
        return STR("if only --metric or the prompt uses it, begin its name with '_'");
    return (Str){0};
}

void lint_unused(Compiler *compiler, const Binding *scope, const Binding *end) {
    static const char *const kinds[] = {"let", "func", "parameter", "loop name", "import"};
    bool top_level = !compiler->function->outer && compiler->function->scope == scope &&
                     (!end || end->kind == BINDING_PARAM); // parameters of the file
    // A file that only binds names is a module, whose top-level names are used by other files.
    if (!lint_enabled(compiler) || (top_level && !end && compiler->is_module))
        return;
    for (const Binding *binding = scope; binding != end; binding = binding->outer)
        if (!binding->used && !can_be_unused(binding))
            add_warning_with_hint(
                compiler, binding->span, "unused-name",
                str_format(compiler->arena, "unused %s '%.*s'", kinds[binding->kind], STR_ARGS(binding->name->name)),
                unused_hint(binding, top_level));
}

// Reports a wrong number of arguments. If the first frame executes the call, lib/builtin reports the same error with
// the same text. The diagnostic sink then drops this second report as a duplicate.
static void lint_builtin_call(Compiler *compiler, const Ast *ast, const Builtin *builtin, const CallCode *code) {
    uint32_t count = code->arg_count + code->named_count;
    bool few = count < builtin->required;
    if (few || (!builtin->variadic && count > builtin->fixed))
        add_warning(compiler, ast->span, "bad-call",
                    str_format(compiler->arena, "%s: too %s arguments: %u given to %s(%s)", builtin->name,
                               few ? "few" : "many", count, builtin->name, builtin->parameters));
}

static const Ast *find_param(const Ast *params, const Symbol *name) {
    for (uint32_t i = 0; i < params->count; i++)
        if (params->children[i]->name == name)
            return params->children[i];
    return NULL;
}

static bool is_named(const CallCode *code, const Symbol *name) {
    for (uint32_t i = 0; i < code->named_count; i++)
        if (code->names[i] == name)
            return true;
    return false;
}

// Lints a call of a function that the program binds. At run time, extra arguments are ignored, and missing arguments
// are null (L9.2).
static void lint_user_call(Compiler *compiler, const Ast *ast, const Ast *function, const CallCode *code) {
    const Ast *params = function->children[0];
    Arena *arena = compiler->arena;
    if (code->arg_count > params->count)
        add_warning(compiler, ast->span, "wrong-arguments",
                    str_format(arena, "too many arguments: %u; the function takes %u", code->arg_count, params->count));
    for (uint32_t i = 0; i < code->named_count; i++)
        if (!find_param(params, code->names[i]))
            add_warning(compiler, ast->span, "wrong-arguments",
                        str_format(arena, "the function has no parameter '%.*s'", STR_ARGS(code->names[i]->name)));
    // Missing arguments of templates are not reported, because a template without a suite may omit its first argument.
    for (uint32_t i = code->arg_count; i < params->count && ast->kind == AST_CALL; i++) {
        const Ast *param = params->children[i];
        if (param->count == 0 && !is_named(code, param->name))
            add_warning(
                compiler, ast->span, "wrong-arguments",
                str_format(arena, "missing argument '%.*s', which has no default", STR_ARGS(param->name->name)));
    }
}

void lint_call(Compiler *compiler, const Ast *ast, const Expr *callee, const CallCode *code) {
    if (!lint_enabled(compiler))
        return;
    const Binding *binding =
        ast->children[0]->kind == AST_NAME ? compile_find_binding(compiler, ast->children[0]->name) : NULL;
    if (binding && binding->value && binding->value->kind == AST_FUNC)
        lint_user_call(compiler, ast, binding->value, code);
    if (callee->kind != EXPR_CONST || callee->as.value.kind != VALUE_MIXED || callee->as.value.len != 1)
        return;
    Item item = callee->as.value.as.items[0];
    if (item.type == ITEM_FUNCTION && item.as.function->builtin)
        lint_builtin_call(compiler, ast, item.as.function->builtin, code);
}

static void warn_negation(Compiler *compiler, Span span, Str name) {
    add_warning_with_hint(compiler, span, "node-as-condition",
                          str_format(compiler->arena, "'!%.*s' is a node, which is always true", STR_ARGS(name)),
                          str_format(compiler->arena, "write 'not %.*s' to negate a value", STR_ARGS(name)));
}

static const Node *is_constant_node(const Expr *expr) {
    bool node = expr->kind == EXPR_CONST && expr->as.value.kind == VALUE_MIXED && expr->as.value.len == 1 &&
                expr->as.value.as.items[0].type == ITEM_NODE;
    return node ? expr->as.value.as.items[0].as.node : NULL;
}

// Warns about tests that are nodes, and about branches after a test that is always true.
void lint_branches(Compiler *compiler, const Expr *expr) {
    if (!lint_enabled(compiler))
        return;
    for (uint32_t i = 0; i + 1 < expr->count; i += 2) {
        const Node *node = is_constant_node(expr->children[i]);
        if (node) {
            warn_negation(compiler, expr->children[i]->origin.span, node->kind->name);
            return;
        }
    }
    for (uint32_t i = 0; i + 2 < expr->count; i += 2)
        if (expr->children[i]->kind == EXPR_CONST && value_true(expr->children[i]->as.value)) {
            add_warning(compiler, expr->children[i]->origin.span, "unreachable",
                        STR("this condition is always true, so the branches after it are never reached"));
            return;
        }
}

// Warns about `!x` if x is a bound name, because other languages write negations like this.
void lint_negation(Compiler *compiler, const Ast *ast) {
    if (lint_enabled(compiler) && ast->kind == AST_NODE &&
        (compile_find_binding(compiler, ast->name) || engine_name_exists(ast->name->name)))
        warn_negation(compiler, ast->span, ast->name->name);
}

static bool has_text(Value v) {
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        if (v.as.items[i].type == ITEM_STRING)
            return true;
    return false;
}

// Returns the call of a function of random numbers whose result, a stream, is the value of an expression. Returns NULL
// if there is none.
static const Ast *stream_of(const Compiler *compiler, const Ast *ast) {
    if (ast->kind == AST_NAME) {
        const Binding *binding = compile_find_binding(compiler, ast->name);
        bool is_let = binding && binding->kind == BINDING_LET && binding->value && binding->value->kind == AST_CALL;
        return is_let ? stream_of(compiler, binding->value) : NULL;
    }
    const Ast *callee = ast->kind == AST_CALL ? ast->children[0] : NULL;
    bool random = callee && callee->kind == AST_NAME &&
                  str_word_number(callee->name->name, "beta normal uniform") >= 0 &&
                  !compile_find_binding(compiler, callee->name);
    return random ? ast : NULL;
}

void lint_stream(Compiler *compiler, const Ast *ast) {
    if (compiler->in_include_path || !stream_of(compiler, ast))
        return;
    Str text = {compiler->source->text.bytes + ast->span.start, ast->span.end - ast->span.start};
    add_warning_with_hint(compiler, ast->span, "missing-index",
                          STR("a stream of random numbers without an index is null here"),
                          str_format(compiler->arena, "for its first number, write %.*s[0]", STR_ARGS(text)));
}

void lint_streams(Compiler *compiler, const Ast *ast) {
    for (uint32_t i = 0; i < ast->count; i++)
        lint_stream(compiler, ast->children[i]);
}

void lint_arith(Compiler *compiler, const Ast *ast, const Expr *expr) {
    lint_streams(compiler, ast);
    for (uint32_t i = 0; lint_enabled(compiler) && i < expr->count; i++)
        if (expr->children[i]->kind == EXPR_CONST && has_text(expr->children[i]->as.value)) {
            add_warning_with_hint(compiler, ast->span, "string-arithmetic",
                                  STR("the result of arithmetic on a string is null"),
                                  STR("join strings and values with semicolons: 'x=';x"));
            return;
        }
}

// Reports a missing module at compile time. The VM reports it only when it executes the import, which may be much
// later.
void lint_import(Compiler *compiler, const Ast *ast, const Expr *file) {
    if (!lint_enabled(compiler) || file->kind != EXPR_CONST || file->as.value.len == 0)
        return;
    Arena *arena = compiler->arena;
    Str name = value_text(arena, compiler->symbols, file->as.value);
    Str path = path_join(arena, compiler->source->directory, name);
    Str version;
    if (name.len && !file_version(arena, compiler->options->files, str_to_c(arena, path), &version))
        add_warning(compiler, ast->span, "cannot-import",
                    str_format(arena, "cannot import '%.*s': no such file", STR_ARGS(path)));
}

void lint_pragma(Compiler *compiler, const Ast *pragma) {
    static const Str known[] = {{"tempo", 5}, {"quantum", 7}, {"fps", 3}};
    Str name = pragma->name->name, hint = {0};
    StrNearest nearest = str_nearest(name);
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        str_try_nearest(&nearest, known[i]);
    if (str_equal(nearest.found, name))
        return;
    if (nearest.found.len)
        hint = str_format(compiler->arena, "did you mean '%.*s'?", STR_ARGS(nearest.found));
    if (lint_enabled(compiler))
        compile_report(compiler, pragma->span, DIAG_WARNING, "unknown-pragma",
                       str_format(compiler->arena, "unknown pragma '%.*s'", STR_ARGS(name)), hint);
}
