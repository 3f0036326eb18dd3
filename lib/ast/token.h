// token.h: tokens, and the interface of the lexer (grammar/lexer.re).
#pragma once

#include "base/source.h"
#include "value/value.h"

typedef struct Token {
    int kind;    // token number from grammar/parser.y, such as NAME
    int keyword; // for a NAME: token number of the keyword with this spelling; 0: none
    Span span;
    const char *error; // error in the indentation or nesting (layout.h); NULL: none
    bool fatal;        // a limit was exceeded, so parsing stops
} Token;

typedef struct Lexer {
    const Source *source;
    uint32_t at; // offset of the next character
} Lexer;

// Returns a lexer at the start of the source. A hashbang line is skipped.
Lexer lexer_new(const Source *source);
// Returns the next token. Skips white space, comments and line continuations. A NEWLINE token includes
// subsequent blank and comment lines and the indentation of the next line. At the end of the source, every call returns
// END.
Token lexer_next(Lexer *lexer);
