// tokens.c: what editors ask for (petri.h).
#include "session/session.h"

#include "syntax/tokens.h"

#include <string.h>

typedef struct Reading {
    Str text;
    PetriTakeToken *take;
    void *host;
} Reading;

static void give(void *context, TokenKind kind, Span span) {
    const Reading *reading = context;
    PetriToken token = {(PetriTokenKind)kind, span.start, span.end};
    reading->take(reading->host, &token);
}

static void read_tokens(PetriSession *session, void *context) {
    Reading *reading = context;
    Arena *arena = &session->prompt.arena;
    const Source *source = source_new(arena, STR("text"), STR("text"), reading->text);
    tokens_read(arena, &session->symbols, source, give, reading);
}

PetriStatus petri_tokens(PetriSession *session, const char *text, size_t length, PetriTakeToken *take, void *host) {
    if (!session || !text || !take)
        return PETRI_INVALID;
    Reading reading = {{text, length == PETRI_Z ? strlen(text) : length}, take, host};
    arena_reset(&session->prompt.arena);
    PetriStatus status = session_protect(session, NULL, read_tokens, &reading);
    arena_reset(&session->prompt.arena);
    return session_tell_end(session, status, "the text");
}
