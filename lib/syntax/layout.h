// layout.h: newlines and indentation to NEWLINE, INDENT and DEDENT tokens (spec language.md L2.10).
//
// Sits between the scanner and the parser: inside round parentheses newline tokens vanish; elsewhere the indentation of
// the next line is compared with a stack of indentations.
#ifndef PETRI_SYNTAX_LAYOUT_H
#define PETRI_SYNTAX_LAYOUT_H

#include "ast/token.h"
#include "base/arena.h"

enum { LAYOUT_MAX_DEPTH = 1000 }; // indentations, and separately parentheses, open at a time

typedef struct LayoutLevel {
    uint32_t indent;
    bool rejected; // the INDENT was refused by the parser, so no DEDENT follows
} LayoutLevel;

typedef struct Layout {
    Lexer lexer;
    uint32_t level_count; // of levels[], the bottom level of indentation 0 included
    LayoutLevel levels[LAYOUT_MAX_DEPTH + 1];
    uint32_t paren_count;
    uint32_t parens[LAYOUT_MAX_DEPTH]; // offsets of the open ones
    Span line;                         // the newline token that is being turned into INDENT or DEDENTs
    uint32_t indent;                   // of the line after it
    bool indent_pending;               // INDENT or DEDENTs of `line` are still due
    bool indent_mismatch;              // … and then the complaint that it is indented like no line above
} Layout;

void layout_init(Layout *layout, const Source *source);
// The next token. A line that is indented like none above shows in the `error` of the token that it begins with; a
// limit is a token of kind GR_UNDEF.
Token layout_next(Layout *layout);
// Scans again from `offset`, inside or before the last token returned, which must not have been a newline or
// parenthesis.
void layout_resume(Layout *layout, uint32_t offset);
// After a syntax error at `token`: forgets open parentheses, so that the next line starts afresh, and a refused INDENT.
void layout_recover(Layout *layout, const Token *token);

#endif
