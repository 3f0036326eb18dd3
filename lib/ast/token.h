// token.h: what the scanner yields, and the scanner's interface (grammar/lexer.re).
#ifndef PETRI_AST_TOKEN_H
#define PETRI_AST_TOKEN_H

#include "base/source.h"
#include "value/value.h"

typedef struct Token {
    int kind;    // a token of grammar/parser.y
    int keyword; // for a name spelled like a keyword: that keyword, else 0
    Span span;
    const char *error; // of the layout: what is wrong, besides the token or, if that is GR_UNDEF, with it
    bool fatal;        // … and a limit was reached: parsing stops
} Token;

typedef struct Lexer {
    const Source *source;
    uint32_t at; // offset of the next character
} Lexer;

// Starts a scan: refuses nothing, skips the hashbang.
Lexer lexer_new(const Source *source);
// The next token. White space, comments and line continuations are skipped; newlines are tokens (NEWLINE, spanning
// blank and comment lines and the indentation of the next line); at the end of the text END, again and again.
Token lexer_next(Lexer *lexer);

#endif
