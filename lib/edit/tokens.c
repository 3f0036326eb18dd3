// tokens.c: tokens and bindings of a script, for editors (petri_tokenise, petri_bindings).
#include "syntax/tokens.h"

#include "session/session.h"
#include "syntax/bindings.h"

#include <string.h>

typedef struct TokenReading {
    Str text;
    PetriTokenCallback *token_callback; // NULL: report bindings instead
    PetriBindingCallback *binding_callback;
    void *user_data;
} TokenReading;

static void send_token(void *context, TokenKind kind, Span span) {
    const TokenReading *reading = context;
    // The source ends in a newline even if the text does not; the last dedent is after it.
    size_t len = reading->text.len;
    PetriToken token = {sizeof token, (PetriTokenKind)kind, span.start < len ? span.start : len,
                        span.end < len ? span.end : len};
    reading->token_callback(reading->user_data, &token);
}

static void send_binding(void *context, const BindingInfo *note) {
    const TokenReading *reading = context;
    PetriBinding name = {.size = sizeof name,
                         .kind = (PetriNameKind)note->kind,
                         .start = note->span.start,
                         .end = note->span.end,
                         .binding_start = note->binding_start == NAME_FREE ? PETRI_NUL_TERMINATED : note->binding_start,
                         .scope_start = note->scope.start,
                         .scope_end = note->scope.end,
                         .value_start = note->value.start,
                         .value_end = note->value.end,
                         .is_sole = note->is_sole,
                         .depth = note->depth};
    reading->binding_callback(reading->user_data, &name);
}

static PetriStatus read_text(PetriSession *session, void *context) {
    TokenReading *reading = context;
    Arena *arena = &session->prompt.arena;
    const Source *source = source_new(arena, STR("text"), STR("text"), reading->text);
    if (reading->token_callback)
        tokens_read(arena, &session->symbols, source, send_token, reading);
    else
        bindings_read(arena, source, parse_tolerant(arena, &session->symbols, source, NULL, NULL), send_binding,
                      reading);
    return PETRI_OK;
}

static PetriStatus read_protected(PetriSession *session, TokenReading reading) {
    arena_reset(&session->prompt.arena);
    PetriStatus status = session_run(session, read_text, &reading, "the input");
    arena_reset(&session->prompt.arena);
    return status;
}

PetriStatus petri_tokenise(PetriSession *session, const char *text, size_t length, PetriTokenCallback *callback,
                           void *host) {
    if (!session || !text || !callback)
        return PETRI_INVALID;
    return read_protected(
        session, (TokenReading){{text, length == PETRI_NUL_TERMINATED ? strlen(text) : length}, callback, NULL, host});
}

PetriStatus petri_bindings(PetriSession *session, const char *text, size_t length, PetriBindingCallback *callback,
                           void *host) {
    if (!session || !text || !callback)
        return PETRI_INVALID;
    return read_protected(
        session, (TokenReading){{text, length == PETRI_NUL_TERMINATED ? strlen(text) : length}, NULL, callback, host});
}
