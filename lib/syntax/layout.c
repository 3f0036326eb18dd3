// layout.c: see layout.h.
//
// Each INDENT is followed by one DEDENT, even after errors. A level whose INDENT the parser has rejected ends without
// one.
#include "syntax/layout.h"

#include "parser.h"

void layout_init(Layout *layout, const Source *source) {
    layout->lexer = lexer_new(source);
    layout->level_count = 1;
    layout->levels[0] = (LayoutLevel){0};
    layout->paren_count = 0;
    layout->indent_pending = layout->indent_mismatch = layout->dropping = false;
}

// Returns the indentation after a newline token: spaces plus eight per tab, without tab stops.
static uint32_t line_indentation(const Source *source, Span newline) {
    uint32_t indent = 0;
    for (uint32_t at = newline.end; at > newline.start && source->text.bytes[at - 1] != '\n'; at--)
        indent += source->text.bytes[at - 1] == '\t' ? 8 : 1;
    return indent;
}

static Token fatal_token(Span span, const char *error) {
    return (Token){.kind = GR_UNDEF, .span = span, .error = error, .fatal = true};
}

// Returns the next INDENT or DEDENT after the newline in layout->line, or a token of kind GR_EMPTY if there is none.
static Token newline_token(Layout *layout) {
    Span here = {layout->line.end, layout->line.end};
    LayoutLevel *top = &layout->levels[layout->level_count - 1];
    while (layout->indent < top->indent) {
        bool silent = top->rejected;
        top = &layout->levels[--layout->level_count - 1];
        if (layout->indent > top->indent) {
            // An indentation between two levels is treated as the outer level, so that the following lines still parse.
            layout->indent = top->indent;
            layout->indent_mismatch = true;
        }
        if (!silent)
            return (Token){.kind = DEDENT, .span = here};
    }
    layout->indent_pending = false;
    if (layout->indent == top->indent)
        return (Token){.kind = GR_EMPTY};
    if (layout->level_count > LAYOUT_MAX_DEPTH)
        return fatal_token(here, "indented too deeply: the limit is 1000 levels");
    layout->levels[layout->level_count++] = (LayoutLevel){.indent = layout->indent};
    return (Token){.kind = INDENT, .span = here};
}

static Token begin_newline(Layout *layout, Token token) {
    layout->line = token.span;
    layout->indent = line_indentation(layout->lexer.source, token.span);
    layout->indent_pending = true;
    return token;
}

// Returns true if the line after a newline is omitted.
static bool is_dropped(Layout *layout, const Token *newline) {
    if (layout->dropping)
        layout->dropping =
            line_indentation(layout->lexer.source, newline->span) > layout->levels[layout->level_count - 1].indent;
    return layout->dropping;
}

static Token next_token(Layout *layout) {
    if (layout->indent_pending) {
        Token token = newline_token(layout);
        if (token.kind != GR_EMPTY)
            return token;
    }
    for (;;) {
        Token token = lexer_next(&layout->lexer);
        switch (token.kind) {
        case NEWLINE:
            if (layout->paren_count > 0 || is_dropped(layout, &token))
                continue;
            return begin_newline(layout, token);
        case '(':
            if (layout->paren_count == LAYOUT_MAX_DEPTH)
                return fatal_token(token.span, "parentheses nested too deeply: the limit is 1000");
            layout->parens[layout->paren_count++] = token.span.start;
            return token;
        case ')':
            layout->paren_count -= layout->paren_count > 0;
            return token;
        default:
            return token;
        }
    }
}

Token layout_next(Layout *layout) {
    Token token = next_token(layout);
    if (layout->indent_mismatch && !token.error)
        token.error = "this line's indentation matches none of the lines above";
    layout->indent_mismatch = false;
    return token;
}

void layout_resume(Layout *layout, uint32_t offset) {
    layout->lexer.at = offset;
}

void layout_recover(Layout *layout, const Token *token, bool drop) {
    layout->paren_count = 0;
    layout->dropping = drop;
    if (token->kind == INDENT)
        layout->levels[layout->level_count - 1].rejected = true;
}
