// bindings.h: what the names of a syntax tree stand for, for editors. The rules are those by which programs are
// compiled (lib/program/compile.c); here they hold for trees with gaps, too.
#ifndef PETRI_SYNTAX_BINDINGS_H
#define PETRI_SYNTAX_BINDINGS_H

#include "ast/ast.h"

// As PetriNameKind of petri.h.
typedef enum NameKind { NAME_USE, NAME_LET, NAME_FUNC, NAME_PARAM, NAME_LOOP, NAME_IMPORT } NameKind;

#define NAME_FREE UINT32_MAX

typedef struct BindingInfo {
    NameKind kind;
    Span span;              // of the name
    uint32_t binding_start; // of a use: where the name stands that it means; NAME_FREE: nowhere in the text
    Span scope;             // of others: where they are visible
    Span value;             // … and what they are bound to: a value, a function with its body, a file
    bool is_sole;           // … the value is bound to this name alone
    uint32_t depth;         // … in so many blocks and functions
} BindingInfo;

typedef void BindingCallback(void *user_data, const BindingInfo *info);
// Gives each name that binds or is used, in the order in which a program is evaluated.
void bindings_read(Arena *arena, const Source *source, const Ast *ast, BindingCallback *callback, void *user_data);

#endif
