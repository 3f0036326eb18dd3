// parse.h: parser from source text to syntax tree.
#ifndef PETRI_SYNTAX_PARSE_H
#define PETRI_SYNTAX_PARSE_H

#include "ast/parse_context.h"

// Parses a program. Returns a SUITE in the arena, whose first children are the PRAGMAs, and adds names and symbols to
// the table. Errors are reported to the sink, also several per call. Returns NULL if there was an error.
const Ast *parse_program(Arena *arena, SymbolTable *symbols, const Source *source, DiagSink *diags);
// Like parse_program, but for editors: reports no errors and omits statements that have errors. Returns NULL if nothing
// is left. `seen` is called with each token; NULL: not called.
const Ast *parse_tolerant(Arena *arena, SymbolTable *symbols, const Source *source, ParseTokenCallback *seen,
                          void *user_data);

// Completeness of a text typed at a prompt.
typedef enum ParseCompleteness {
    PARSE_COMPLETE,    // complete, or invalid whatever follows
    PARSE_EXTENDABLE,  // complete, but indented lines may follow
    PARSE_NEEDS_BLOCK, // indented lines must follow
    PARSE_INCOMPLETE,  // ends inside parentheses, a string or a continued line
} ParseCompleteness;
// Reports no errors. The syntax tree is allocated in the arena and not used.
ParseCompleteness parse_completeness(Arena *arena, SymbolTable *symbols, const Source *source);

#endif
