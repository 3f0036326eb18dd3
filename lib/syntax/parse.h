// parse.h: the parser, which converts source code to a syntax tree.
#pragma once

#include "ast/parse_context.h"

// Parses a program. Returns a SUITE in the arena, whose first children are the PRAGMAs. Adds names and symbols to the
// table. Reports all errors to the sink. Returns NULL if there was an error.
const Ast *parse_program(Arena *arena, SymbolTable *symbols, const Source *source, DiagSink *diags);
// Like parse_program, but for editors: reports no errors and omits statements that have errors. Returns NULL if no tree
// could be built. Calls `seen` with each token, unless `seen` is NULL.
const Ast *parse_tolerant(Arena *arena, SymbolTable *symbols, const Source *source, ParseTokenCallback *seen,
                          void *user_data);

// Completeness of input at a prompt.
typedef enum ParseCompleteness {
    PARSE_COMPLETE,    // complete, or invalid no matter what follows
    PARSE_EXTENDABLE,  // complete, but indented lines can follow
    PARSE_NEEDS_BLOCK, // indented lines must follow
    PARSE_INCOMPLETE,  // ends inside parentheses, a string or a continued line
} ParseCompleteness;
// Returns the completeness of a source. Reports no errors. Temporary data is allocated in the arena.
ParseCompleteness parse_completeness(Arena *arena, SymbolTable *symbols, const Source *source);
