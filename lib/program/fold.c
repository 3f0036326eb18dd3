// fold.c: the simplifier, which folds constant expressions at load time.
//
// An expression can be folded if nothing in it is dynamic and it reads only slots that it binds itself. Slots are
// allocated like a stack, so an expression's own slots are those >= mark, the first free slot before it was compiled.
// The expression is evaluated by the VM. If the VM meets something dynamic (for example in a called function), reports
// an error or exceeds a limit, the expression is not changed. Values are therefore bit-identical with and without the
// simplifier.
//
// A name that is bound to a constant is replaced by the constant. So constants propagate through a program, and a
// static tree of particles becomes one constant vector of nodes that all frames share.
#include "program/compile.h"
#include "program/lower.h"

// Vectors with more elements are not folded: evaluating them again costs less than keeping them in memory.
enum { MAX_ELEMENTS = 1 << 22 };

// Returns false for expressions of a kind that binds names, is already constant, or is evaluated as fast as a constant.
static bool is_candidate(const Compiler *compiler, const Expr *expr) {
    switch (expr->kind) {
    case EXPR_CONST:
    case EXPR_BIND:
    case EXPR_LET:
    case EXPR_IMPORT:
    case EXPR_SLOT:
        return false;
    case EXPR_FUNC:
        return compiler->repeats == 0; // see can_fold
    default:
        return true;
    }
}

// A search for closures in a value stops after this many nodes and assumes that the value contains a closure.
enum { MAX_VISITS = 100000 };

static bool node_reaches_closure(const Node *node, uint32_t *visits);

static bool reaches_closure(Value v, uint32_t *visits) {
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++) {
        const Item *item = &v.as.items[i];
        if (item->type == ITEM_FUNCTION && !item->as.function->builtin)
            return true;
        if (item->type == ITEM_NODE && node_reaches_closure(item->as.node, visits))
            return true;
    }
    return false;
}

static bool node_reaches_closure(const Node *node, uint32_t *visits) {
    if (++*visits > MAX_VISITS)
        return true;
    for (uint32_t i = 0; i < node->attr_count; i++)
        if (reaches_closure(node->attrs[i].value, visits))
            return true;
    for (uint32_t i = 0; i < node->child_count; i++)
        if (node_reaches_closure(node->children[i], visits))
            return true;
    return false;
}

// Returns false if an expression must not be replaced by its value. This is the case if the value is too long. It is
// also the case if the value contains closures and the expression may be evaluated several times per frame. Each
// evaluation must then create new closures, because a closure counts its own active calls.
static bool can_fold(const Compiler *compiler, Value value) {
    uint32_t visits = 0;
    return value.len <= MAX_ELEMENTS && (compiler->repeats == 0 || !reaches_closure(value, &visits));
}

// Returns a CONST that replaces an expression. It keeps the flags `dynamic` and `uses_closure` of the expression.
static const Expr *replace_with_constant(Compiler *compiler, const Expr *expr, Value value) {
    Expr *folded = arena_copy(compiler->scratch, expr, sizeof *expr);
    folded->kind = EXPR_CONST;
    folded->count = 0;
    folded->as.value = value;
    compile_set_dependencies(folded);
    value_mark_program_lifetime(value);
    return folded;
}

// If the children of an APPEND are constant, stores them in one array. All nodes that the APPEND creates, in all
// frames, share this array.
static void share_constant_children(Compiler *compiler, Expr *expr) {
    if (expr->kind != EXPR_APPEND || expr->children[1]->kind != EXPR_CONST)
        return;
    NodeList *list = arena_alloc(compiler->arena, sizeof *list);
    *list = node_list(compiler->arena, expr->children[1]->as.value);
    list->program_lifetime = true;
    expr->as.constant_children = list;
}

// Replaces an `if` whose first tests are constant with one of its branches, or with an `if` that starts with a later
// test. Returns the expression itself if its first test is not constant.
static const Expr *prune_branches(Compiler *compiler, const Expr *expr) {
    uint32_t skip = 0;
    while (skip + 1 < expr->count && expr->children[skip]->kind == EXPR_CONST) {
        if (value_true(expr->children[skip]->as.value))
            return expr->children[skip + 1];
        skip += 2;
    }
    if (skip == 0)
        return expr;
    if (skip == expr->count)
        return replace_with_constant(compiler, expr, VALUE_NULL);
    if (skip + 1 == expr->count)
        return expr->children[skip];
    Expr *rest = arena_copy(compiler->scratch, expr, sizeof *expr);
    rest->children += skip;
    rest->count -= skip;
    compile_set_dependencies(rest);
    return rest;
}

// Evaluates an expression that reads only its own slots. Returns false and frees the value if the evaluation fails or
// can_fold rejects the value.
static bool evaluate_expr(Compiler *compiler, const Expr *expr, Value *value) {
    const CompileHost *host = &compiler->options->host;
    ArenaMark before = arena_mark(compiler->arena), scratch = arena_mark(compiler->scratch);
    LowerOptions options = {.arena = compiler->scratch, .values = compiler->arena, .scratch = compiler->scratch};
    const Code *code = program_lower(&options, expr, compiler->function->frame_size);
    bool is_folded = host->evaluate(host->user_data, code, value) && can_fold(compiler, *value);
    arena_rewind(compiler->scratch, scratch);
    if (!is_folded)
        arena_rewind(compiler->arena, before);
    return is_folded;
}

const Expr *fold_expr(Compiler *compiler, Expr *expr, uint32_t mark) {
    if (!compiler->options->simplify)
        return expr;
    const Expr *pruned = expr->kind == EXPR_IF ? prune_branches(compiler, expr) : expr;
    if (pruned != expr)
        return pruned;
    share_constant_children(compiler, expr);
    if (expr->dynamic || expr->uses_closure || expr->lowest_slot < mark || !is_candidate(compiler, expr))
        return expr;
    Value value;
    if (!evaluate_expr(compiler, expr, &value)) {
        expr->dynamic = true; // prevents attempts to fold enclosing expressions
        return expr;
    }
    return replace_with_constant(compiler, expr, value);
}

void compile_set_constant(Compiler *compiler, uint32_t count, Value value) {
    Binding *binding = compiler->function->scope;
    for (uint32_t i = count; i > 0; i--, binding = binding->outer) {
        binding->is_constant = true;
        binding->constant = count == 1 ? value : value_element(value, i - 1);
    }
}
