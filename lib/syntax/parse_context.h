// parse_context.h: what the grammar's actions share with the parser's driver (parse.c).
#ifndef PETRI_SYNTAX_PARSE_CONTEXT_H
#define PETRI_SYNTAX_PARSE_CONTEXT_H

#include "base/diag.h"
#include "syntax/ast.h"

typedef struct ParseContext {
    Arena *arena; // the program's
    SymbolTable *symbols;
    const Source *source;
    DiagSink *diags;
    Ast *program;         // the result
    bool failed;          // an error was reported
    uint32_t faulty_line; // of the last error
    bool too_deep;        // … that of nesting; reported once, and parsing stops
    bool reported;        // the lexer or the layout has explained the present error already
} ParseContext;

// The node itself, unless the tree has become too high (then the error is reported once).
Ast *parse_checked(ParseContext *context, Ast *ast);
// Reports a token that cannot continue the program. `expected` lists some alternatives by name; none if there are many,
// of which a value is the one to tell if `wants_value`.
void parse_syntax_error(ParseContext *context, Span span, const char *found, const char *const *expected, int count,
                        bool wants_value);
void parse_too_deep(ParseContext *context, Span span);

#endif
