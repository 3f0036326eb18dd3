// parse.h: source text to syntax tree.
#ifndef PETRI_SYNTAX_PARSE_H
#define PETRI_SYNTAX_PARSE_H

#include "ast/parse_context.h"

// Parses a whole program into a SUITE whose first children are the PRAGMAs. The tree lives in the arena; names and
// symbols are added to the table. Errors go to the sink, several from one run where recovery is safe; the result is
// NULL if there was any.
const Ast *parse_program(Arena *arena, SymbolTable *symbols, const Source *source, DiagSink *diags);
// The same for editors, without a word on what is wrong: the tree is what is left without the statements that have
// errors, NULL if nothing is. `seen` takes the tokens.
const Ast *parse_tolerant(Arena *arena, SymbolTable *symbols, const Source *source, ParseTokenCallback *seen,
                          void *user_data);

// Whether more lines can follow what was typed so far.
typedef enum ParseCompleteness {
    PARSE_COMPLETE,    // it is complete, or wrong whatever follows
    PARSE_EXTENDABLE,  // it is complete, and indented lines would go on with it
    PARSE_NEEDS_BLOCK, // indented lines must follow
    PARSE_INCOMPLETE,  // it cannot end here
} ParseCompleteness;
// Reports nothing. The arena takes what the parser builds by the way.
ParseCompleteness parse_completeness(Arena *arena, SymbolTable *symbols, const Source *source);

#endif
