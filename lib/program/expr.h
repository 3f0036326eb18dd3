// expr.h: expressions, the intermediate representation between syntax tree and code. Names are resolved to slots.
//
// The compiler creates expressions, the simplifier (fold.c) replaces some of them, and lowering (lower.c) translates
// them to code. After that, the expressions are freed.
#pragma once

#include "program/code.h"

typedef enum ExprKind {
#define EXPR(kind) EXPR_##kind,
#include "program/expr_list.h"
    EXPR_COUNT
} ExprKind;

// Tags and attributes that DECORATE adds, with the positions of the attributes.
typedef struct Decoration {
    DecorateCode code;
    uint32_t attr_count;
    const Span *spans;
} Decoration;

typedef struct Expr Expr;
struct Expr {
    ExprKind kind;
    uint32_t count; // number of children
    uint32_t slot;  // see expr_list.h
    uint32_t slot_count;
    // Dependencies of the value, for the simplifier (fold.c)
    bool dynamic;      // the value may change from frame to frame
    bool uses_closure; // the value depends on the running closure itself or on its captures
    // Used only for loops: true if the nodes of the loop become children of a node. They can then be batched.
    bool can_batch;
    uint32_t lowest_slot; // lowest slot that the expression reads; UINT32_MAX: none
    Origin origin;
    union {
        Value value;                // CONST
        const Symbol *name;         // NODE, UNBOUND
        const Symbol *const *names; // IMPORT
        const FunctionCode *function;
        const CallCode *call;
        const Decoration *decorate;
        const NodeList *constant_children; // APPEND; NULL: not constant
    } as;
    const Expr *const *children;
};

// Returns true for statements that only bind names and have no value.
static inline bool expr_only_binds(const Expr *expr) {
    return expr->kind == EXPR_BIND || expr->kind == EXPR_LET || expr->kind == EXPR_IMPORT;
}
