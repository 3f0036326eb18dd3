// ast.h: the syntax tree, which the parser builds and the compiler reads.
//
// Nodes are allocated in an arena, are immutable once built and store their location in the source. ast_list.h lists
// the children of each kind.
#pragma once

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
    uint32_t count;  // number of children
    uint32_t height; // 1 + maximum height of the children
    uint32_t end;    // of a statement in a suite: the end of its last line, which can be behind that of its span
    Span span;
    const Symbol *name; // NULL for kinds without a name
    Value value;        // value of a LITERAL
    Ast *const *children;
};

// Maximum height of a tree, so that recursion cannot overflow the stack. The parser rejects higher trees.
enum { AST_MAX_HEIGHT = 2000 };

// A growing list of nodes, which become the children of a node.
typedef struct AstList {
    Arena *arena;
    Ast **items;
    uint32_t count;
    uint32_t capacity;
} AstList;

AstList *ast_list_new(Arena *arena);
// The next two functions append to the list and return it.
AstList *ast_list_add(AstList *list, Ast *item);
AstList *ast_list_add_all(AstList *list, const AstList *more);

// Return a new node in the arena. The array of children is copied.
Ast *ast_new(Arena *arena, AstKind kind, Span span, const Symbol *name, Ast *const *children, uint32_t count);
Ast *ast_from_list(Arena *arena, AstKind kind, Span span, const Symbol *name, const AstList *children);
Ast *ast_literal(Arena *arena, Span span, Value value);

const char *ast_kind_name(AstKind kind);
// Appends the tree as indented text with line numbers, for --dump=ast.
void ast_print(Text *out, const SymbolTable *symbols, const Source *source, const Ast *ast);
