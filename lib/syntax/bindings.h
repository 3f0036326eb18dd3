// bindings.h: name resolution for editors. The rules are those of the compiler (lib/program/compile.c), but incomplete
// syntax trees are accepted, too.
#pragma once

#include "ast/ast.h"

// Must match PetriNameKind of petri.h.
typedef enum NameKind { NAME_USE, NAME_LET, NAME_FUNC, NAME_PARAM, NAME_LOOP, NAME_IMPORT } NameKind;

#define NAME_FREE UINT32_MAX // value of binding_start if the script does not bind the name

typedef struct BindingInfo {
    NameKind kind;
    Span span;              // location of the name
    uint32_t binding_start; // offset of the place where the name is bound; NAME_FREE: none
    // The other fields are set for all kinds except NAME_USE.
    Span scope;     // where the name is visible
    Span value;     // location of the bound value or function, or of an import's file name
    bool is_sole;   // the value is bound to this name only
    uint32_t depth; // number of enclosing blocks and functions
} BindingInfo;

typedef void BindingCallback(void *user_data, const BindingInfo *info);
// Calls `callback` for each name that is bound or used, in the order of evaluation.
void bindings_read(Arena *arena, const Source *source, const Ast *ast, BindingCallback *callback, void *user_data);
