// parse.h: source text to syntax tree.
#ifndef PETRI_SYNTAX_PARSE_H
#define PETRI_SYNTAX_PARSE_H

#include "base/diag.h"
#include "syntax/ast.h"

// Parses a whole program into a SUITE whose first children are the PRAGMAs. The tree lives in the arena; names and
// symbols are added to the table. Errors go to the sink, several from one run where recovery is safe; the result is
// NULL if there was any.
const Ast *parse_program(Arena *arena, SymbolTable *symbols, const Source *source, DiagSink *diags);

#endif
