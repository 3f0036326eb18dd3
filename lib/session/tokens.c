// tokens.c: what editors ask for (petri.h).
#include "session/session.h"

#include "syntax/names.h"
#include "syntax/tokens.h"

#include <string.h>

typedef struct Reading {
    Str text;
    PetriTakeToken *take_token; // one of them
    PetriTakeName *take_name;
    void *host;
} Reading;

static void give_token(void *context, TokenKind kind, Span span) {
    const Reading *reading = context;
    PetriToken token = {(PetriTokenKind)kind, span.start, span.end};
    reading->take_token(reading->host, &token);
}

static void give_name(void *context, const NameNote *note) {
    const Reading *reading = context;
    PetriTextName name = {.kind = (PetriNameKind)note->kind,
                          .start = note->span.start,
                          .end = note->span.end,
                          .bound = note->bound == NAME_FREE ? PETRI_Z : note->bound,
                          .scope_start = note->scope.start,
                          .scope_end = note->scope.end,
                          .value_start = note->whole.start,
                          .value_end = note->whole.end,
                          .alone = note->alone,
                          .depth = note->height};
    reading->take_name(reading->host, &name);
}

static void read_text(PetriSession *session, void *context) {
    Reading *reading = context;
    Arena *arena = &session->prompt.arena;
    const Source *source = source_new(arena, STR("text"), STR("text"), reading->text);
    if (reading->take_token)
        tokens_read(arena, &session->symbols, source, give_token, reading);
    else
        names_read(arena, source, parse_loosely(arena, &session->symbols, source, NULL, NULL), give_name, reading);
}

static PetriStatus read_protected(PetriSession *session, Reading reading) {
    arena_reset(&session->prompt.arena);
    PetriStatus status = session_protect(session, NULL, read_text, &reading);
    arena_reset(&session->prompt.arena);
    return session_tell_end(session, status, "the text");
}

PetriStatus petri_tokens(PetriSession *session, const char *text, size_t length, PetriTakeToken *take, void *host) {
    if (!session || !text || !take)
        return PETRI_INVALID;
    return read_protected(session, (Reading){{text, length == PETRI_Z ? strlen(text) : length}, take, NULL, host});
}

PetriStatus petri_names(PetriSession *session, const char *text, size_t length, PetriTakeName *take, void *host) {
    if (!session || !text || !take)
        return PETRI_INVALID;
    return read_protected(session, (Reading){{text, length == PETRI_Z ? strlen(text) : length}, NULL, take, host});
}
