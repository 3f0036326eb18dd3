// tokens.h: a text as editors see it: tokens of a few kinds, comments among them.
#ifndef PETRI_SYNTAX_TOKENS_H
#define PETRI_SYNTAX_TOKENS_H

#include "syntax/parse.h"

// As PetriTokenKind of petri.h.
typedef enum TokenKind {
    TOKEN_NAME,
    TOKEN_KEYWORD,
    TOKEN_NUMBER,
    TOKEN_STRING,
    TOKEN_SYMBOL,
    TOKEN_NODE,
    TOKEN_TAG,
    TOKEN_OPERATOR,
    TOKEN_COMMENT,
    TOKEN_INVALID,
    TOKEN_NEWLINE,
    TOKEN_INDENT,
    TOKEN_DEDENT,
} TokenKind;

typedef void TokenCallback(void *user_data, TokenKind kind, Span span);
// Gives the tokens in order; returns what parse_tolerant does.
const Ast *tokens_read(Arena *arena, SymbolTable *symbols, const Source *source, TokenCallback *callback,
                       void *user_data);

#endif
