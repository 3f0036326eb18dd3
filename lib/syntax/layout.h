// layout.h: conversion of newlines and indentation to NEWLINE, INDENT and DEDENT tokens (spec language.md L2.10).
//
// The layout filters the tokens between lexer and parser. Inside parentheses it removes newline tokens. Elsewhere it
// compares the indentation of the next line with a stack of indentations, and inserts an INDENT or DEDENTs if they
// differ.
#pragma once

#include "ast/token.h"
#include "base/arena.h"

enum { LAYOUT_MAX_DEPTH = 1000 }; // maximum nesting of indentations, and of parentheses

typedef struct LayoutLevel {
    uint32_t indent; // indentation in columns
    bool rejected;   // the parser rejected the INDENT, so its DEDENT is omitted
} LayoutLevel;

typedef struct Layout {
    Lexer lexer;
    uint32_t level_count;                     // number of levels, including the first with indentation 0
    LayoutLevel levels[LAYOUT_MAX_DEPTH + 1]; // stack of indentations
    uint32_t paren_count;                     // number of open parentheses
    uint32_t parens[LAYOUT_MAX_DEPTH];        // offsets of the open parentheses
    Span line;                                // span of the newline token after which an INDENT or DEDENTs are inserted
    uint32_t indent;                          // indentation of the line after `line`
    bool indent_pending;                      // the INDENT or DEDENTs of `line` have not all been returned yet
    bool dropping;                            // omits lines that are further indented than the level
    bool indent_mismatch;                     // the indentation matches no line above; the next token gets an error
} Layout;

void layout_init(Layout *layout, const Source *source);
// Returns the next token. If the indentation of a line matches no line above, sets `error` of its first token. If a
// nesting limit is exceeded, returns a token of kind GR_UNDEF.
Token layout_next(Layout *layout);
// Continues scanning at `offset`, which is inside or before the last returned token. That token must not be a newline
// or parenthesis.
void layout_resume(Layout *layout, uint32_t offset);
// Recovers from a syntax error at `token`: closes all parentheses, so that the next line is parsed normally. With
// `drop`, the lines below that are further indented belong to the broken statement. If `token` is an INDENT, its DEDENT
// will be omitted.
void layout_recover(Layout *layout, const Token *token, bool drop);
