// expr.h: expressions, which stand between the syntax tree and the code: names are slots, constants are in place.
//
// The compiler makes them, the simplifier replaces some (fold.c), lowering reads them (lower.c); then they are dropped.
#ifndef PETRI_PROGRAM_EXPR_H
#define PETRI_PROGRAM_EXPR_H

#include "program/code.h"

typedef enum ExprKind {
#define EXPR(kind) EXPR_##kind,
#include "program/expr_list.h"
    EXPR_COUNT
} ExprKind;

// What DECORATE adds, and where its attributes stand.
typedef struct Decoration {
    DecorateCode code;
    uint32_t attr_count;
    const Span *spans;
} Decoration;

typedef struct Expr Expr;
struct Expr {
    ExprKind kind;
    uint32_t count; // children
    uint32_t slot;
    uint32_t slot_count;
    // For the simplifier (fold.c): what the value depends on.
    bool dynamic;         // something that may change from frame to frame
    bool uses_closure;    // the running closure: its captures or itself
    bool can_batch;       // FOR: what it makes becomes children, so it may be in runs (value/node_batch.h)
    uint32_t lowest_slot; // the lowest slot that is read, UINT32_MAX if none
    Origin origin;
    union {
        Value value;                // CONST
        const Symbol *name;         // NODE, UNBOUND
        const Symbol *const *names; // IMPORT
        const FunctionCode *function;
        const CallCode *call;
        const Decoration *decorate;
        const NodeList *constant_children; // APPEND: the children, if they are constant; or NULL
    } as;
    const Expr *const *children;
};

// Is an expression a statement that binds names and has no value of its own?
static inline bool expr_only_binds(const Expr *expr) {
    return expr->kind == EXPR_BIND || expr->kind == EXPR_LET || expr->kind == EXPR_IMPORT;
}

#endif
