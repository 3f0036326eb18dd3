// tokens.h: tokens for syntax highlighting and other editor features. Comments are included.
#pragma once

#include "syntax/parse.h"

// Must match PetriTokenKind of petri.h.
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
// Calls `callback` for each token in order. Returns the result of parse_tolerant.
const Ast *tokens_read(Arena *arena, SymbolTable *symbols, const Source *source, TokenCallback *callback,
                       void *user_data);
