// tokens.c: see tokens.h.
#include "syntax/tokens.h"

#include "parser.h"

#include <string.h>

typedef struct Taking {
    Str text;
    uint32_t at; // what is before it was given
    TokensTake *take;
    void *host;
} Taking;

// Between tokens are blanks, line ends, continuations and comments.
static void take_comments(Taking *taking, uint32_t end) {
    const char *text = taking->text.bytes;
    while (taking->at < end) {
        uint32_t start = taking->at++;
        if (strchr(" \t\n\\", text[start]))
            continue;
        taking->at = (uint32_t)((const char *)memchr(text + start, '\n', taking->text.len - start) - text);
        taking->take(taking->host, TOKEN_COMMENT, (Span){start, taking->at});
    }
}

static TokenKind kind_of(int kind) {
    switch (kind) {
    case NAME:
        return TOKEN_NAME;
    case NUMBER:
    case TIMECODE:
        return TOKEN_NUMBER;
    case STRING:
        return TOKEN_STRING;
    case SYMBOL:
        return TOKEN_SYMBOL;
    case NODE:
        return TOKEN_NODE;
    case TAG:
        return TOKEN_TAG;
    case INDENT:
        return TOKEN_INDENT;
    case DEDENT:
        return TOKEN_DEDENT;
    case GR_UNDEF:
        return TOKEN_WRONG;
    default: // bison numbers them in the order of parser.y
        return kind >= PRAGMA && kind <= NOT ? TOKEN_KEYWORD : TOKEN_OPERATOR;
    }
}

static void take(void *host, const Token *token) {
    Taking *taking = host;
    Span span = token->span;
    if (token->kind == NEWLINE) {
        taking->take(taking->host, TOKEN_LINE_END, (Span){span.start, span.start});
        take_comments(taking, span.end);
        return;
    }
    take_comments(taking, span.start);
    if (token->kind != END)
        taking->take(taking->host, kind_of(token->kind), span);
    taking->at = span.end;
}

const Ast *tokens_read(Arena *arena, SymbolTable *symbols, const Source *source, TokensTake *take_token, void *host) {
    Taking taking = {.text = source->text, .take = take_token, .host = host};
    return parse_loosely(arena, symbols, source, take, &taking);
}
