// fold.c: the simplifier: what does not depend on the frame is evaluated once, when the program is loaded.
//
// An expression can be evaluated ahead if nothing in it is dynamic and it reads no slot but its own, that is, none
// below the slot that was free when it began: slots are handed out like a stack, so what it binds itself lies above.
// The machine that runs the program does it, with the same functions; if on its way it meets something dynamic (inside
// a function that is called, say), a fault or a limit, the expression stays as it is. So a value is the same with and
// without the simplifier, to the last bit, and nothing is re-associated.
//
// A name bound to a constant is that constant from then on, which is how constants spread through a program, and how a
// static particle tree comes to be one constant vector of nodes that all frames share.
#include "program/compile.h"
#include "program/lower.h"
#include "value/value_hash.h"

// More elements than this are worth the time of evaluating them again rather than the memory of keeping them.
enum { MAX_ELEMENTS = 1 << 22 };

void fold_add_dependency(Expr *expr, const Expr *child) {
    expr->dynamic |= child->dynamic;
    expr->uses_closure |= child->uses_closure;
    if (child->lowest_slot < expr->lowest_slot)
        expr->lowest_slot = child->lowest_slot;
}

void fold_set_dependencies(Expr *expr) {
    expr->lowest_slot = UINT32_MAX;
    switch (expr->kind) {
    case EXPR_SLOT:
        expr->lowest_slot = expr->slot;
        break;
    case EXPR_CAPTURE:
    case EXPR_SELF:
        expr->uses_closure = true;
        break;
    case EXPR_LOOKUP:
    case EXPR_IMPORT:
    case EXPR_UNBOUND:
        expr->dynamic = true;
        break;
    default:
        break;
    }
    for (uint32_t i = 0; i < expr->count; i++)
        fold_add_dependency(expr, expr->children[i]);
}

// Kinds that act on the frame, are constants already, or are as quick as one.
static bool is_candidate(const Compiler *compiler, const Expr *expr) {
    switch (expr->kind) {
    case EXPR_CONST:
    case EXPR_BIND:
    case EXPR_LET:
    case EXPR_IMPORT:
    case EXPR_SLOT:
        return false;
    case EXPR_FUNC:
        return compiler->repeats == 0; // see may_keep
    default:
        return true;
    }
}

// Does a value reach a closure? Gives up with yes where there is very much to look at.
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

// Each evaluation makes closures that equal no others and count their own calls, so an expression that may be evaluated
// several times in a frame must not be replaced by one that shares them.
static bool can_fold(const Compiler *compiler, Value value) {
    uint32_t visits = 0;
    return value.len <= MAX_ELEMENTS && (compiler->repeats == 0 || !reaches_closure(value, &visits));
}

// A constant in the place of an expression. What the expression depended on, it is still taken to depend on.
static const Expr *replace_with_constant(Compiler *compiler, const Expr *expr, Value value) {
    Expr *folded = arena_copy(compiler->scratch, expr, sizeof *expr);
    folded->kind = EXPR_CONST;
    folded->count = 0;
    folded->as.value = value;
    fold_set_dependencies(folded);
    value_mark_program_lifetime(value);
    return folded;
}

// Constant children are one array that every frame's parent shares.
static void share_constant_children(Compiler *compiler, Expr *expr) {
    if (expr->kind != EXPR_APPEND || expr->children[1]->kind != EXPR_CONST)
        return;
    NodeList *list = arena_alloc(compiler->arena, sizeof *list);
    *list = node_list(compiler->arena, expr->children[1]->as.value);
    list->program_lifetime = true;
    expr->as.constant_children = list;
}

// An `if` whose first test is known comes down to one branch or starts with the next test.
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
    fold_set_dependencies(rest);
    return rest;
}

// The value of an expression that reads no slot from outside; false, with nothing left of it, if it is not known yet or
// must not be kept.
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
        expr->dynamic = true; // what encloses it need not try
        return expr;
    }
    return replace_with_constant(compiler, expr, value);
}

Value compile_unpack(Compiler *compiler, Value value, uint32_t element, uint32_t count) {
    if (count == 1)
        return value;
    if (value.kind == VALUE_STREAM)
        return value_number(value_stream_item(value, element));
    return value_element(compiler->arena, value, element);
}

void compile_set_constant(Compiler *compiler, uint32_t count, Value value) {
    Binding *binding = compiler->function->scope;
    for (uint32_t i = count; i > 0; i--, binding = binding->outer) {
        binding->is_constant = true;
        binding->constant = compile_unpack(compiler, value, i - 1, count);
    }
}
