// parse_context.h: what the grammar's actions share with the parser's driver (syntax/parse.c): they note what they come
// upon, the driver tells it.
#ifndef PETRI_AST_PARSE_CONTEXT_H
#define PETRI_AST_PARSE_CONTEXT_H

#include "ast/ast.h"
#include "ast/token.h"
#include "base/diag.h"

enum { PARSE_ALTERNATIVES = 4 };

// A token that cannot continue the program.
typedef struct Unexpected {
    const char *found; // its name; NULL: none was met
    Span span;
    const char *expected[PARSE_ALTERNATIVES]; // by name
    int expected_count;                       // 0: none or too many
    bool value_expected;                      // a value is one of them
} Unexpected;

// Takes each token as the grammar sees it: a word that is a keyword where it stands has its kind.
typedef void ParseTokenCallback(void *user_data, const Token *token);

typedef struct ParseContext {
    Arena *arena; // the program's
    SymbolTable *symbols;
    const Source *source;
    DiagSink *diags;
    Ast *program;        // the result
    bool failed;         // an error was reported
    uint32_t error_line; // of the last error
    bool too_deep;       // … that of nesting; reported once, and parsing stops
    bool reported;       // the lexer or the layout has explained the present error already
    // Noted by the grammar while it takes one token.
    Unexpected unexpected;
    bool overflow; // the tree has become too high, or the parser's stack is full
    Span overflow_at;
    bool error_tolerant;          // for editors: as much as there is is read
    ParseTokenCallback *on_token; // NULL: nobody wants the tokens
    void *user_data;
} ParseContext;

#endif
