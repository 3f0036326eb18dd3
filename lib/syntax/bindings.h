// bindings.h: name resolution for editors. It follows the rules of the compiler (lib/program/compile.c), but also
// accepts incomplete syntax trees.
#ifndef PETRI_SYNTAX_BINDINGS_H
#define PETRI_SYNTAX_BINDINGS_H

#include "ast/ast.h"

// Must match PetriNameKind of petri.h.
typedef enum NameKind { NAME_USE, NAME_LET, NAME_FUNC, NAME_PARAM, NAME_LOOP, NAME_IMPORT } NameKind;

#define NAME_FREE UINT32_MAX // binding_start of a name that is not bound in the text

typedef struct BindingInfo {
    NameKind kind;
    Span span;              // location of the name
    uint32_t binding_start; // start of the name that binds it; NAME_FREE: none
    // The other fields are set for all kinds except NAME_USE.
    Span scope;     // text in which the name is visible
    Span value;     // text of the bound value, function or file name
    bool is_sole;   // the value is bound to this name only
    uint32_t depth; // number of enclosing blocks and functions
} BindingInfo;

typedef void BindingCallback(void *user_data, const BindingInfo *info);
// Calls `callback` for each name that is bound or used, in the order of evaluation.
void bindings_read(Arena *arena, const Source *source, const Ast *ast, BindingCallback *callback, void *user_data);

#endif
