// compile.c: compilation of syntax trees to expressions and code; see program.h.
//
// The tree is compiled in the order of evaluation. The scope of a binding starts directly after its value has been
// compiled (spec language.md L8.2).
#include "program/compile.h"

#include "program/lower.h"

// Returns true if the value of an expression is or contains the value of its child i. If the expression's value becomes
// children of a node, so does the value of this child. `count` is the number of children.
static bool is_part(ExprKind kind, uint32_t i, uint32_t count) {
    return kind == EXPR_COMPOSE || (kind == EXPR_IF && (i % 2 == 1 || i + 1 == count));
}

static const Expr *compile_expr(Compiler *compiler, const Ast *ast);

static const Expr *compile_part(Compiler *compiler, const Ast *ast, bool in_children) {
    compiler->in_children = in_children;
    return compile_expr(compiler, ast);
}

// Compiles the children of a syntax tree node in order. Returns an expression of the given kind with these children.
static Expr *compile_children(Compiler *compiler, ExprKind kind, const Ast *ast, bool in_children) {
    const Expr **children = arena_alloc_array(compiler->scratch, ast->count, sizeof *children);
    for (uint32_t i = 0; i < ast->count; i++)
        children[i] = compile_part(compiler, ast->children[i],
                                   kind == EXPR_APPEND ? i == 1 : in_children && is_part(kind, i, ast->count));
    return compile_expr_new(compiler, kind, ast, children, ast->count);
}

// Compiles a syntax tree node to an expression of the same kind with the same children (SAME in expr_list.h).
static Expr *compile_same(Compiler *compiler, const Ast *ast, bool in_children) {
    static const ExprKind kinds[] = {
#define EXPR(kind)
#define SAME(kind) [AST_##kind] = EXPR_##kind,
#include "program/expr_list.h"
    };
    return compile_children(compiler, kinds[ast->kind], ast, in_children);
}

static const Expr *compile_arith(Compiler *compiler, const Ast *ast) {
    const Expr *expr = compile_same(compiler, ast, false);
    lint_arith(compiler, ast, expr);
    return expr;
}

// Compiles <, >, <= or >=. Sets `slot` to 1 if a name is compared with itself: both operands are then the same object,
// so even NaN equals itself (L5.5).
static const Expr *compile_order(Compiler *compiler, const Ast *ast) {
    const Ast *left = ast->children[0], *right = ast->children[1];
    lint_streams(compiler, ast);
    Expr *expr = compile_same(compiler, ast, false);
    expr->slot = left->kind == AST_NAME && right->kind == AST_NAME && left->name == right->name;
    return expr;
}

static const Expr *compile_range(Compiler *compiler, const Ast *ast) {
    const Expr *parts[3];
    for (int i = 0; i < 3; i++)
        parts[i] =
            ast->children[i] ? compile_expr(compiler, ast->children[i]) : compile_constant(compiler, ast, VALUE_NULL);
    return compile_expr_new(compiler, EXPR_RANGE, ast, parts, 3);
}

static const Expr *compile_node(Compiler *compiler, const Ast *ast) {
    Expr *expr = compile_expr_new(compiler, EXPR_NODE, ast, NULL, 0);
    expr->as.name = ast->name;
    return expr;
}

static const Expr *compile_if(Compiler *compiler, const Ast *ast, bool in_children) {
    bool varies = false;
    for (uint32_t i = 0; i + 1 < ast->count; i += 2) {
        varies = varies || !lint_is_fixed(compiler, ast->children[i]);
        compile_note_test(compiler, ast->children[i]);
    }
    compiler->varies += varies;
    const Expr *expr = compile_same(compiler, ast, in_children);
    compiler->varies -= varies;
    lint_branches(compiler, expr);
    return expr;
}

// Compiles `then if test else other` to an IF with one test.
static const Expr *compile_cond(Compiler *compiler, const Ast *ast, bool in_children) {
    bool varies = !lint_is_fixed(compiler, ast->children[1]);
    compile_note_test(compiler, ast->children[1]);
    compiler->varies += varies;
    const Expr *test = compile_expr(compiler, ast->children[1]);
    const Expr *parts[3] = {test, compile_part(compiler, ast->children[0], in_children)};
    if (ast->children[2])
        parts[2] = compile_part(compiler, ast->children[2], in_children);
    compiler->varies -= varies;
    const Expr *expr = compile_expr_new(compiler, EXPR_IF, ast, parts, ast->children[2] ? 3 : 2);
    lint_branches(compiler, expr);
    return expr;
}

// Compiles a BINDING. Its value is compiled before its names become visible.
static const Expr *compile_binding(Compiler *compiler, const Ast *binding) {
    const Ast *names = binding->children[0];
    const Expr *value = compile_expr(compiler, binding->children[1]);
    Expr *bind = compile_expr_new(compiler, EXPR_BIND, binding, &value, 1);
    bind->slot = compile_bind_names(compiler, BINDING_LET, names, binding->children[1]);
    bind->slot_count = names->count;
    if (value->kind == EXPR_CONST)
        compile_set_constant(compiler, names->count, value->as.value);
    return bind;
}

static const Expr *compile_let(Compiler *compiler, const Ast *ast) {
    const Expr **binds = arena_alloc_array(compiler->scratch, ast->count, sizeof *binds);
    for (uint32_t i = 0; i < ast->count; i++) {
        compile_note_parameter(compiler, ast->children[i]);
        binds[i] = compile_binding(compiler, ast->children[i]);
    }
    return ast->count == 1 ? binds[0] : compile_expr_new(compiler, EXPR_LET, ast, binds, ast->count);
}

static const Expr *compile_where(Compiler *compiler, const Ast *ast, bool in_children) {
    ScopeMark mark = compile_scope_open(compiler);
    const Expr **parts = arena_alloc_array(compiler->scratch, ast->count, sizeof *parts);
    for (uint32_t i = 1; i < ast->count; i++)
        parts[i - 1] = compile_binding(compiler, ast->children[i]);
    parts[ast->count - 1] = compile_part(compiler, ast->children[0], in_children);
    compile_scope_close(compiler, mark);
    return compile_expr_new(compiler, EXPR_COMPOSE, ast, parts, ast->count);
}

static const Expr *compile_for(Compiler *compiler, const Ast *ast, bool in_children) {
    // A loop over a range never builds a vector, so even a constant range is not folded to one.
    const Ast *source = ast->children[1];
    const Expr *parts[2] = {source->kind == AST_RANGE ? compile_range(compiler, source)
                                                      : compile_expr(compiler, source)};
    ScopeMark mark = compile_scope_open(compiler);
    uint32_t slot = compile_bind_names(compiler, BINDING_LOOP, ast->children[0], source);
    bool varies = !compiler->function->scope->traits.is_fixed;
    compiler->repeats++;
    compiler->varies += varies;
    parts[1] = compile_part(compiler, ast->children[2], in_children);
    compiler->varies -= varies;
    compiler->repeats--;
    compile_scope_close(compiler, mark);
    Expr *expr = compile_expr_new(compiler, EXPR_FOR, ast, parts, 2);
    expr->can_batch = in_children;
    expr->slot = slot;
    expr->slot_count = ast->children[0]->count;
    return expr;
}

static const Expr *compile_suite(Compiler *compiler, const Ast *ast, bool in_children) {
    ScopeMark mark = compile_scope_open(compiler);
    const Expr *expr = compile_children(compiler, EXPR_COMPOSE, ast, in_children);
    compile_scope_close(compiler, mark);
    return expr;
}

static const Expr *compile_decorate(Compiler *compiler, const Ast *ast) {
    Decoration *code = arena_alloc(compiler->scratch, sizeof *code);
    const Symbol **tags = arena_alloc_array(compiler->scratch, ast->count, sizeof *tags);
    const Symbol **names = arena_alloc_array(compiler->scratch, ast->count, sizeof *names);
    Span *spans = arena_alloc_array(compiler->scratch, ast->count, sizeof *spans);
    const Expr **children = arena_alloc_array(compiler->scratch, ast->count, sizeof *children);
    *code = (Decoration){.code = {.tags = tags, .names = names}, .spans = spans};
    compiler->subject = ast->children[0];
    children[0] = compile_expr(compiler, ast->children[0]);
    for (uint32_t i = 1; i < ast->count; i++) {
        const Ast *decoration = ast->children[i];
        if (decoration->kind == AST_TAG) {
            tags[code->code.tag_count++] = decoration->name;
        } else {
            lint_negation(compiler, decoration->children[0]);
            lint_stream(compiler, decoration->children[0]);
            if (str_equal(decoration->name->name, STR("state")))
                compiler->state_attr = decoration->children[0];
            spans[code->attr_count] = decoration->span;
            names[code->attr_count++] = decoration->name;
            children[code->attr_count] = compile_expr(compiler, decoration->children[0]);
        }
    }
    lint_node(compiler, ast);
    Expr *expr = compile_expr_new(compiler, EXPR_DECORATE, ast, children, code->attr_count + 1);
    expr->as.decorate = code;
    return expr;
}

// Compiles a CALL or TEMPLATE. Its first child is the callee. `args` are the positional and named arguments.
static const Expr *compile_call(Compiler *compiler, const Ast *ast, const Ast *const *args, uint32_t count) {
    CallCode *code = arena_alloc(compiler->scratch, sizeof *code);
    const Symbol **names = arena_alloc_array(compiler->scratch, count, sizeof *names);
    const Expr **children = arena_alloc_array(compiler->scratch, count + 1, sizeof *children);
    *code = (CallCode){.names = names};
    children[0] = compile_expr(compiler, ast->children[0]);
    for (uint32_t i = 0; i < count; i++) {
        bool named = args[i]->kind == AST_NAMED || args[i]->kind == AST_ATTR;
        if (named)
            names[code->named_count++] = args[i]->name;
        else
            code->arg_count++;
        children[i + 1] = compile_expr(compiler, named ? args[i]->children[0] : args[i]);
    }
    Expr *expr = compile_expr_new(compiler, EXPR_CALL, ast, children, count + 1);
    expr->as.call = code;
    lint_call(compiler, ast, children[0], code);
    lint_call_angles(compiler, ast);
    return expr;
}

// Compiles a TEMPLATE. If there is a suite below it, the suite is the first positional argument.
static const Expr *compile_template(Compiler *compiler, const Ast *ast) {
    uint32_t count = ast->count - 1;
    const Ast **args = arena_alloc_array(compiler->scratch, ast->count, sizeof *args);
    bool suite = count > 0 && ast->children[count]->kind == AST_SUITE;
    if (suite)
        args[0] = ast->children[count];
    for (uint32_t i = 0; i < count - suite; i++)
        args[i + suite] = ast->children[i + 1];
    return compile_call(compiler, ast, args, count);
}

// Adds the dependencies of a new closure on the values that it captures. Its dependencies on the defaults are already
// set, because the defaults are its children. Values that the body reads during a call are not dependencies.
static void describe_closure(Expr *expr) {
    const FunctionCode *code = expr->as.function;
    for (uint32_t i = 0; i < code->capture_count; i++) {
        const Capture *capture = &code->captures[i];
        if (capture->kind != CAPTURE_SLOT)
            expr->uses_closure = true;
        else if (capture->slot < expr->lowest_slot)
            expr->lowest_slot = capture->slot;
    }
}

// Lowers an expression to code with `slot_count` slots.
static const Code *compile_code(Compiler *compiler, const Expr *expr, uint32_t slot_count) {
    LowerOptions options = {.arena = compiler->arena,
                            .values = compiler->arena,
                            .scratch = compiler->scratch,
                            .lookup_count = &compiler->lookup_count,
                            .lines = compiler->options->lines};
    return program_lower(&options, expr, slot_count);
}

// Compiles a FUNC, named or anonymous, to a closure.
static const Expr *compile_closure(Compiler *compiler, const Ast *ast) {
    const Ast *params = ast->children[0];
    const Symbol **names = arena_alloc_array(compiler->arena, params->count, sizeof *names);
    const Expr **defaults = arena_alloc_array(compiler->scratch, params->count, sizeof *defaults);
    for (uint32_t i = 0; i < params->count; i++) {
        const Ast *param = params->children[i];
        names[i] = param->name;
        defaults[i] =
            param->count ? compile_expr(compiler, param->children[0]) : compile_constant(compiler, param, VALUE_NULL);
    }
    FunctionScope function;
    compile_function_open(compiler, &function, ast->name);
    for (uint32_t i = 0; i < params->count; i++)
        compile_bind(compiler, BINDING_PARAM, names[i], params->children[i]->span, NULL);
    compiler->repeats++;
    compiler->varies++;
    const Expr *body = compile_expr(compiler, ast->children[1]);
    compiler->varies--;
    compiler->repeats--;
    compile_function_close(compiler, &function);
    FunctionCode *code = arena_alloc(compiler->arena, sizeof *code);
    *code = (FunctionCode){.name = ast->name ? ast->name->name : STR("<anon>"),
                           .params = names,
                           .param_count = params->count,
                           .capture_count = function.capture_count,
                           .captures =
                               arena_copy(compiler->arena, function.captures, function.capture_count * sizeof(Capture)),
                           .code = compile_code(compiler, body, function.frame_size)};
    Expr *expr = compile_expr_new(compiler, EXPR_FUNC, ast, defaults, params->count);
    expr->as.function = code;
    describe_closure(expr);
    return fold_expr(compiler, expr, compiler->function->next_slot);
}

// Compiles a `func` statement. `func name(…)` binds the name. Without a name, the closure is the value of the
// statement.
static const Expr *compile_func_statement(Compiler *compiler, const Ast *ast) {
    const Expr *closure = compile_closure(compiler, ast);
    if (!ast->name)
        return closure;
    Expr *bind = compile_expr_new(compiler, EXPR_BIND, ast, &closure, 1);
    bind->slot = compile_bind(compiler, BINDING_FUNC, ast->name, ast->span, ast);
    bind->slot_count = 1;
    if (closure->kind == EXPR_CONST)
        compile_set_constant(compiler, 1, closure->as.value);
    return bind;
}

static void note_import(Compiler *compiler, const Expr *file) {
    if (compiler->depth != 1 || file->kind != EXPR_CONST)
        return;
    size_t size = compiler->import_count * sizeof(Str);
    compiler->imports = arena_grow(compiler->arena, compiler->imports, size, size + sizeof(Str));
    Str name = value_text(compiler->arena, compiler->symbols, file->as.value);
    compiler->imports[compiler->import_count++] = path_join(compiler->arena, compiler->source->directory, name);
}

static const Expr *compile_import(Compiler *compiler, const Ast *ast) {
    const Ast *names = ast->children[0];
    const Expr *file = compile_expr(compiler, ast->children[1]);
    compiler->keys.incomplete = true; // the module may contain any symbol
    note_import(compiler, file);
    lint_import(compiler, ast, file);
    const Symbol **symbols = arena_alloc_array(compiler->scratch, names->count, sizeof *symbols);
    for (uint32_t i = 0; i < names->count; i++)
        symbols[i] = names->children[i]->name;
    Expr *expr = compile_expr_new(compiler, EXPR_IMPORT, ast, &file, 1);
    expr->slot = compile_bind_names(compiler, BINDING_IMPORT, names, NULL);
    expr->slot_count = names->count;
    expr->as.names = symbols;
    return expr;
}

static Include find_include(Compiler *compiler, const Ast *ast, const Expr *file) {
    if (file->kind != EXPR_CONST)
        return (Include){.span = file->origin.span, .error = STR("the file name of an %include must be constant")};
    Include include = {.span = ast->span};
    if (file->as.value.len == 0)
        return include;
    Str name = value_text(compiler->arena, compiler->symbols, file->as.value), reason = {0};
    Str path = path_join(compiler->arena, compiler->source->directory, name);
    const CompileHost *host = &compiler->options->host;
    include.ast = host->include(host->user_data, path, &include.source, &reason);
    if (!include.ast)
        include.error = str_format(compiler->arena, "cannot include '%.*s': %.*s", STR_ARGS(path), STR_ARGS(reason));
    return include;
}

// Compiles an %include to the statements of the included file.
static const Expr *compile_include(Compiler *compiler, const Ast *ast, bool in_children) {
    compiler->in_include_path = true;
    const Expr *file = compile_expr(compiler, ast->children[0]);
    compiler->in_include_path = false;
    Include include = compiler->folding_pass ? compiler->folding_pass->includes[compiler->include_count]
                                             : find_include(compiler, ast, file);
    size_t size = compiler->include_count++ * sizeof include;
    compiler->includes = arena_grow(compiler->scratch, compiler->includes, size, size + sizeof include);
    compiler->includes[compiler->include_count - 1] = include;
    if (include.error.len)
        compile_report(compiler, include.span, DIAG_WARNING, "cannot-include", include.error, (Str){0});
    if (!include.ast)
        return compile_constant(compiler, ast, VALUE_NULL);
    const Source *outer = compiler->source;
    compile_add_uses(compiler, include.ast);
    compiler->source = include.source;
    compiler->depth--; // the included statements have the depth of the directive
    const Expr *expr = compile_suite(compiler, include.ast, in_children);
    compiler->depth++;
    compiler->source = outer;
    return expr;
}

static const Expr *compile_kind(Compiler *compiler, const Ast *ast, bool in_children) {
    switch (ast->kind) {
    case AST_LITERAL:
        compile_note_literal(compiler, ast);
        return compile_constant(compiler, ast, value_copy(compiler->arena, ast->value)); // the value outlives the tree
    case AST_NODE:
        return compile_node(compiler, ast);
    case AST_NAME:
        return compile_name(compiler, ast);
    case AST_SUITE:
        return compile_suite(compiler, ast, in_children);
    case AST_LET:
    case AST_LET_STABLE:
        return compile_let(compiler, ast);
    case AST_FUNC:
        return compile_func_statement(compiler, ast);
    case AST_IMPORT:
        return compile_import(compiler, ast);
    case AST_INCLUDE:
        return compile_include(compiler, ast, in_children);
    case AST_FOR:
        return compile_for(compiler, ast, in_children);
    case AST_COND:
        return compile_cond(compiler, ast, in_children);
    case AST_WHERE:
        return compile_where(compiler, ast, in_children);
    case AST_DECORATE:
        return compile_decorate(compiler, ast);
    case AST_CALL:
        return compile_call(compiler, ast, (const Ast *const *)ast->children + 1, ast->count - 1);
    case AST_TEMPLATE:
        return compile_template(compiler, ast);
    case AST_RANGE:
        return compile_range(compiler, ast);
    case AST_COMPOSE:
        lint_streams(compiler, ast);
        compile_note_vector(compiler, ast);
        return compile_same(compiler, ast, in_children);
    case AST_ADD:
    case AST_SUB:
    case AST_MUL:
    case AST_DIV:
    case AST_FLOORDIV:
    case AST_MOD:
    case AST_POW:
        return compile_arith(compiler, ast);
    case AST_APPEND:
        compiler->subject = ast->children[0];
        return compile_same(compiler, ast, false);
    case AST_LOOKUP: {
        compiler->key = ast->children[0];
        compiler->lookups++;
        const Expr *expr = compile_same(compiler, ast, false);
        compiler->lookups--;
        return expr;
    }
    case AST_IF:
        return compile_if(compiler, ast, in_children);
    case AST_AND:
    case AST_OR:
    case AST_XOR:
    case AST_NOT:
    case AST_EQ:
    case AST_NE:
        for (uint32_t i = 0; i < ast->count; i++) {
            compile_note_test(compiler, ast->children[i]);
            if (ast->kind != AST_EQ && ast->kind != AST_NE)
                lint_negation(compiler, ast->children[i]);
        }
        return compile_same(compiler, ast, false);
    case AST_LT:
    case AST_GT:
    case AST_LE:
    case AST_GE:
        return compile_order(compiler, ast);
    default:
        return compile_same(compiler, ast, in_children);
    }
}

static const Expr *compile_expr(Compiler *compiler, const Ast *ast) {
    uint32_t mark = compiler->function->next_slot;
    bool in_children = compiler->in_children;
    compiler->in_children = false;
    compiler->depth++;
    arena_charge(compiler->scratch, 2);
    const Expr *expr = fold_expr(compiler, (Expr *)compile_kind(compiler, ast, in_children), mark);
    compiler->depth--;
    if (ast == compiler->parameter_default)
        compile_note_default(compiler, expr);
    return expr;
}

static void collect_pragmas(Compiler *compiler, const Ast *ast, Program *program) {
    Pragma *pragmas = arena_alloc_array(compiler->arena, ast->count, sizeof *pragmas);
    for (uint32_t i = 0; i < ast->count && ast->children[i]->kind == AST_PRAGMA; i++) {
        const Ast *pragma = ast->children[i];
        lint_pragma(compiler, pragma);
        pragmas[program->pragma_count++] = (Pragma){
            pragma->name, value_copy(compiler->arena, pragma->children[0]->value), compiler->source, pragma->span};
    }
    program->pragmas = pragmas;
}

// Stores the top-level bindings that are visible at the end of the file, in source order. `params` is the innermost
// binding that is not exported.
static void collect_exports(Compiler *compiler, Program *program, const Binding *params) {
    uint32_t count = 0;
    for (const Binding *binding = compiler->function->scope; binding != params; binding = binding->outer)
        count++;
    Export *exports = arena_alloc_array(compiler->arena, count, sizeof *exports);
    program->export_count = count;
    for (const Binding *binding = compiler->function->scope; binding != params; binding = binding->outer)
        exports[--count] = (Export){binding->name, binding->slot};
    program->exports = exports;
}

// Returns true if a file only binds names at its top level.
static bool binds_only(const Ast *ast) {
    for (uint32_t i = 0; i < ast->count; i++) {
        AstKind kind = ast->children[i]->kind;
        bool binds = kind == AST_LET || kind == AST_LET_STABLE || kind == AST_IMPORT || kind == AST_PRAGMA ||
                     (kind == AST_FUNC && ast->children[i]->name);
        if (!binds)
            return false;
    }
    return true;
}

static const Program *compile_file(Compiler *compiler, const Ast *ast) {
    const CompileOptions *options = compiler->options;
    compiler->define_uses = arena_alloc_array(compiler->arena, options->define_count, sizeof *compiler->define_uses);
    for (uint32_t i = 0; i < options->define_count; i++)
        compiler->define_uses[i] = (DefineUse){0};
    FunctionScope function;
    compile_function_open(compiler, &function, NULL);
    compiler->repeats = options->module; // a module may be imported several times
    for (uint32_t i = 0; i < options->param_count; i++) {
        compile_bind(compiler, BINDING_PARAM, options->params[i], (Span){0}, NULL);
        compiler->function->scope->used = true; // passed to all scripts, so not reported as unused
    }
    const Binding *params = function.scope;
    Program *program = arena_alloc(compiler->arena, sizeof *program);
    *program = (Program){.source = compiler->source, .param_count = options->param_count};
    collect_pragmas(compiler, ast, program);
    uint32_t skip = program->pragma_count;
    Ast *body = ast_new(compiler->scratch, AST_SUITE, ast->span, NULL, ast->children + skip, ast->count - skip);
    const Expr *expr = compile_children(compiler, EXPR_COMPOSE, body, false);
    collect_exports(compiler, program, params);
    lint_unused(compiler, compiler->function->scope, params);
    program->code = compile_code(compiler, expr, function.frame_size);
    program->lookup_count = compiler->lookup_count;
    program->parameters = compiler->parameters;
    program->parameter_count = compiler->parameter_count;
    program->define_uses = compiler->define_uses;
    program->imports = compiler->imports;
    program->import_count = compiler->import_count;
    program->keys = arena_copy(compiler->arena, &compiler->keys, sizeof compiler->keys);
    return program;
}

const Program *program_compile(Arena *arena, Arena *scratch, SymbolTable *symbols, const Source *source, const Ast *ast,
                               const CompileOptions *options, DiagSink *diags) {
    Compiler compiler = {.arena = arena,
                         .scratch = scratch,
                         .symbols = symbols,
                         .source = source,
                         .options = options,
                         .diags = diags,
                         .root = ast,
                         .is_module = binds_only(ast)};
    if (options->simplify)
        return compile_file(&compiler, ast);
    CompileOptions simplifying = *options;
    simplifying.simplify = true;
    simplifying.lint = simplifying.lines = false;
    DiagSink discarded = diag_sink_new(scratch, 0);
    Compiler folding_pass = compiler;
    folding_pass.options = &simplifying;
    folding_pass.diags = &discarded;
    compile_file(&folding_pass, ast);
    compiler.folding_pass = &folding_pass;
    return compile_file(&compiler, ast);
}

const Export *program_find_export(const Program *program, const Symbol *name) {
    for (uint32_t i = program->export_count; i > 0; i--)
        if (program->exports[i - 1].name == name)
            return &program->exports[i - 1];
    return NULL;
}
