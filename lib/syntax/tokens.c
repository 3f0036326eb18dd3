// tokens.c: see tokens.h.
//
// The scanner has no tokens for comments. They are found between two tokens, where all else is white space.
#include "syntax/tokens.h"

#include "parser.h"

#include <string.h>

typedef struct TokenReader {
    Str text;
    uint32_t at; // end of the last reported token
    TokenCallback *callback;
    void *user_data;
} TokenReader;

// Reports the comments between the last token and `end`. Skips blanks, newlines and line continuations.
static void emit_comments(TokenReader *reader, uint32_t end) {
    const char *text = reader->text.bytes;
    while (reader->at < end) {
        uint32_t start = reader->at++;
        if (strchr(" \t\n\\", text[start]))
            continue;
        reader->at = (uint32_t)((const char *)memchr(text + start, '\n', reader->text.len - start) - text);
        reader->callback(reader->user_data, TOKEN_COMMENT, (Span){start, reader->at});
    }
}

static TokenKind token_kind(int kind) {
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
        return TOKEN_INVALID;
    default: // bison numbers the kinds in the order in which parser.y declares them
        return kind >= PRAGMA && kind <= NOT ? TOKEN_KEYWORD : TOKEN_OPERATOR;
    }
}

static void handle_token(void *user_data, const Token *token) {
    TokenReader *reader = user_data;
    Span span = token->span;
    if (token->kind == NEWLINE) {
        reader->callback(reader->user_data, TOKEN_NEWLINE, (Span){span.start, span.start});
        emit_comments(reader, span.end);
        return;
    }
    emit_comments(reader, span.start);
    if (token->kind != END)
        reader->callback(reader->user_data, token_kind(token->kind), span);
    reader->at = span.end;
}

const Ast *tokens_read(Arena *arena, SymbolTable *symbols, const Source *source, TokenCallback *callback,
                       void *user_data) {
    TokenReader reader = {.text = source->text, .callback = callback, .user_data = user_data};
    return parse_tolerant(arena, symbols, source, handle_token, &reader);
}
