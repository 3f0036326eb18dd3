// expr.c: makes expressions, and reports what is wrong with them; see expr.h and compile.h.
//
// What an expression depends on is computed from its children when it is made, so that no other function walks the tree
// for it.
#include "program/compile.h"

static void add_dependency(Expr *expr, const Expr *child) {
    expr->dynamic |= child->dynamic;
    expr->uses_closure |= child->uses_closure;
    if (child->lowest_slot < expr->lowest_slot)
        expr->lowest_slot = child->lowest_slot;
}

void compile_set_dependencies(Expr *expr) {
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
        add_dependency(expr, expr->children[i]);
}

Expr *compile_expr_new(Compiler *compiler, ExprKind kind, const Ast *ast, const Expr *const *children, uint32_t count) {
    Expr *expr = arena_alloc(compiler->scratch, sizeof *expr);
    *expr = (Expr){.kind = kind,
                   .count = count,
                   .origin = {compiler->source, ast->span},
                   .children = arena_copy(compiler->scratch, children, count * sizeof *children)};
    for (uint32_t i = 0; kind == EXPR_COMPOSE && i < count; i++)
        expr->slot += !expr_only_binds(children[i]);
    compile_set_dependencies(expr);
    return expr;
}

Expr *compile_constant(Compiler *compiler, const Ast *ast, Value value) {
    Expr *expr = compile_expr_new(compiler, EXPR_CONST, ast, NULL, 0);
    expr->as.value = value;
    return expr;
}

void compile_report(Compiler *compiler, Span span, DiagLevel level, const char *code, Str text, Str hint) {
    diag_report(compiler->diags, &(Diag){level, {compiler->source, span}, text, .hint = hint, .code = code});
}
