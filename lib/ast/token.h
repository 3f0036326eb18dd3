// token.h: tokens, and the interface of the scanner (grammar/lexer.re).
#ifndef PETRI_AST_TOKEN_H
#define PETRI_AST_TOKEN_H

#include "base/source.h"
#include "value/value.h"

typedef struct Token {
    int kind;    // a token of grammar/parser.y
    int keyword; // keyword that a NAME is spelled like; 0: none
    Span span;
    const char *error; // error found by the layout; concerns the token itself if its kind is GR_UNDEF; NULL: none
    bool fatal;        // a limit was exceeded, so parsing stops
} Token;

typedef struct Lexer {
    const Source *source;
    uint32_t at; // offset of the next character
} Lexer;

// Returns a scanner at the start of the text, after a hashbang line.
Lexer lexer_new(const Source *source);
// Returns the next token. Skips white space, comments and line continuations. A NEWLINE token spans blank and comment
// lines and the indentation of the next line. At the end of the text, every call returns END.
Token lexer_next(Lexer *lexer);

#endif
