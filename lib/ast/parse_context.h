// parse_context.h: data shared by the grammar's actions and the driver of the parser (syntax/parse.c). The actions
// record errors here, and the driver reports them.
#pragma once

#include "ast/ast.h"
#include "ast/token.h"
#include "base/diag.h"

enum { PARSE_ALTERNATIVES = 4 }; // maximum number of expected tokens that are recorded

// A token that is not allowed where it occurs.
typedef struct Unexpected {
    const char *found; // name of the token; NULL: no error
    Span span;
    const char *expected[PARSE_ALTERNATIVES]; // names of tokens that could follow
    int expected_count;                       // number of names in `expected`; 0: there are too many
    bool value_expected;                      // true if a value is allowed at this place
} Unexpected;

// Called with each token that is passed to the grammar. A word that is a keyword in its context has the keyword's kind.
typedef void ParseTokenCallback(void *user_data, const Token *token);

typedef struct ParseContext {
    Arena *arena; // arena in which the program is allocated
    SymbolTable *symbols;
    const Source *source;
    DiagSink *diags;
    Ast *program;        // the resulting syntax tree
    bool failed;         // an error was reported
    uint32_t error_line; // line of the last error
    uint32_t let_line;   // last line known to continue the `let` in line error_line; 0: none
    bool too_deep;       // a nesting limit was exceeded and reported, so parsing stops
    bool reported;       // an invalid token was already reported, so the parser's error about it is dropped
    // The next three fields are set by the grammar while it processes a token.
    Unexpected unexpected;
    bool overflow;                // the tree is too high, or the parser's stack is full
    Span overflow_at;             // location of the overflow
    bool error_tolerant;          // for editors: parse as much as possible despite errors
    ParseTokenCallback *on_token; // called with each token; NULL: none
    void *user_data;              // passed to on_token
} ParseContext;
