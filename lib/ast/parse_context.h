// parse_context.h: data shared by the grammar's actions and the parser's driver (syntax/parse.c). The actions record
// errors here and the driver reports them.
#ifndef PETRI_AST_PARSE_CONTEXT_H
#define PETRI_AST_PARSE_CONTEXT_H

#include "ast/ast.h"
#include "ast/token.h"
#include "base/diag.h"

enum { PARSE_ALTERNATIVES = 4 };

// A token that cannot continue the program.
typedef struct Unexpected {
    const char *found; // name of the token; NULL: no error
    Span span;
    const char *expected[PARSE_ALTERNATIVES]; // names of tokens that could follow
    int expected_count;                       // 0: none, or more than PARSE_ALTERNATIVES
    bool value_expected;                      // a value could follow
} Unexpected;

// Called with each token as the grammar sees it. A word that is a keyword in its context has the keyword's kind.
typedef void ParseTokenCallback(void *user_data, const Token *token);

typedef struct ParseContext {
    Arena *arena; // holds the program
    SymbolTable *symbols;
    const Source *source;
    DiagSink *diags;
    Ast *program;        // the result
    bool failed;         // an error was reported
    uint32_t error_line; // line of the last error
    bool too_deep;       // a nesting limit was exceeded; it is reported once and parsing stops
    bool reported;       // the scanner or the layout has already reported the current error
    // Set by the grammar while it processes a token.
    Unexpected unexpected;
    bool overflow;                // the tree is too high, or the parser's stack is full
    Span overflow_at;             // location of the overflow
    bool error_tolerant;          // for editors: parse as much as possible despite errors
    ParseTokenCallback *on_token; // NULL: not called
    void *user_data;              // passed to on_token
} ParseContext;

#endif
