// ast.h: the syntax tree, as the parser builds it and the program compiler reads it.
//
// Nodes are immutable once built, live in the program's arena and know their place in the source. ast_list.h says for
// each kind what its children are.
#ifndef PETRI_AST_AST_H
#define PETRI_AST_AST_H

#include "base/source.h"
#include "value/value.h"

typedef enum AstKind {
#define AST(kind, text) AST_##kind,
#include "ast/ast_list.h"
#undef AST
} AstKind;

typedef struct Ast Ast;
struct Ast {
    AstKind kind;
    uint32_t count;  // children
    uint32_t height; // 1 + the greatest height of a child
    Span span;
    const Symbol *name; // of the kinds that have one, else NULL
    Value value;        // of LITERAL
    Ast *const *children;
};

// Deeper trees are refused, so that walking one never exhausts the stack.
enum { AST_MAX_HEIGHT = 2000 };

// Children under construction.
typedef struct AstList {
    Arena *arena;
    Ast **items;
    uint32_t count;
    uint32_t capacity;
} AstList;

AstList *ast_list_new(Arena *arena);
// Appends and returns the list.
AstList *ast_list_add(AstList *list, Ast *item);
AstList *ast_list_add_all(AstList *list, const AstList *more);

Ast *ast_new(Arena *arena, AstKind kind, Span span, const Symbol *name, Ast *const *children, uint32_t count);
Ast *ast_from_list(Arena *arena, AstKind kind, Span span, const Symbol *name, const AstList *children);
Ast *ast_literal(Arena *arena, Span span, Value value);

const char *ast_kind_name(AstKind kind);
// The tree as indented text with line numbers, for --dump=ast.
void ast_print(Text *out, const SymbolTable *symbols, const Source *source, const Ast *ast);

#endif
