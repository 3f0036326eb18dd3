// diagnostics.c: see diagnostics.h.
#include "session/session.h"

#include "base/heap.h"

#include <stdio.h>
#include <string.h>

enum { MOST_TOLD = 1000 };

static void forget_kept(Diagnostics *diagnostics) {
    for (uint32_t i = 0; i < MOST_KEPT; i++) {
        heap_give(diagnostics->kept[i]);
        diagnostics->kept[i] = NULL;
    }
    diagnostics->kept_first = diagnostics->kept_count = 0;
}

// Copies a text to the end of a block.
static const char *add_text(char **end, const char *text) {
    size_t size = text ? strlen(text) + 1 : 0;
    const char *copy = text ? memcpy(*end, text, size) : NULL;
    *end += size;
    return copy;
}

static size_t text_size(const char *text) {
    return text ? strlen(text) + 1 : 0;
}

// One that there is no memory for is not kept.
static void keep(Diagnostics *diagnostics, const PetriDiagnostic *diagnostic) {
    PetriDiagnostic *copy =
        heap_take(sizeof *copy + text_size(diagnostic->file) + text_size(diagnostic->text) +
                  text_size(diagnostic->code) + text_size(diagnostic->rendered) + text_size(diagnostic->hint));
    if (!copy)
        return;
    char *end = (char *)(copy + 1);
    *copy = *diagnostic;
    copy->file = add_text(&end, diagnostic->file);
    copy->text = add_text(&end, diagnostic->text);
    copy->code = add_text(&end, diagnostic->code);
    copy->rendered = add_text(&end, diagnostic->rendered);
    copy->hint = add_text(&end, diagnostic->hint);
    bool full = diagnostics->kept_count == MOST_KEPT;
    PetriDiagnostic **place = &diagnostics->kept[(diagnostics->kept_first + diagnostics->kept_count) % MOST_KEPT];
    heap_give(*place);
    *place = copy;
    diagnostics->kept_first = (diagnostics->kept_first + full) % MOST_KEPT;
    diagnostics->kept_count += !full;
}

bool petri_diagnostic(const PetriSession *session, size_t number, PetriDiagnostic *diagnostic) {
    if (!session || !diagnostic || number >= session->diagnostics.kept_count)
        return false;
    *diagnostic = *session->diagnostics.kept[(session->diagnostics.kept_first + number) % MOST_KEPT];
    return true;
}

void petri_forget_diagnostics(PetriSession *session) {
    if (session)
        forget_kept(&session->diagnostics);
}

void diagnostics_free(Diagnostics *diagnostics) {
    forget_kept(diagnostics);
    index_free(&diagnostics->told_index);
    heap_give(diagnostics->told);
}

void diagnostics_begin_load(Diagnostics *diagnostics) {
    diagnostics->told_count = 0;
    index_clear(&diagnostics->told_index);
}

bool diagnostics_repeat(Diagnostics *diagnostics, bool repeat) {
    bool before = diagnostics->repeat;
    diagnostics->repeat = repeat;
    return before;
}

static bool told_same(const void *owner, uint32_t entry, const void *key) {
    return ((const Diagnostics *)owner)->told[entry] == *(const uint64_t *)key;
}

// Whether something was told before, or too much was.
static bool is_told(const Diagnostics *diagnostics, uint64_t hash) {
    return diagnostics->told_count >= MOST_TOLD ||
           index_find(&diagnostics->told_index, hash, told_same, diagnostics, &hash) != INDEX_NONE;
}

// What cannot be remembered is told again.
static void remember(Diagnostics *diagnostics, uint64_t hash) {
    if (!heap_reserve((void **)&diagnostics->told, &diagnostics->told_capacity, diagnostics->told_count, sizeof hash))
        return;
    diagnostics->told[diagnostics->told_count] = hash;
    if (index_add(&diagnostics->told_index, hash, diagnostics->told_count))
        diagnostics->told_count++;
}

static void give(PetriSession *session, const Diag *diag, Str rendered) {
    Arena *arena = &session->text_arena;
    SourcePlace place = {0}, end = {0};
    if (diag->source) {
        place = source_locate(diag->source, diag->span.start);
        end = source_locate(diag->source, diag->span.end);
    }
    PetriDiagnostic public_diag = {.level = (PetriLevel)diag->level,
                                   .file = diag->source ? str_to_c(arena, diag->source->name) : NULL,
                                   .line = place.line,
                                   .column = place.column,
                                   .text = str_to_c(arena, diag_text(diag)),
                                   .code = diag->code,
                                   .rendered = str_to_c(arena, rendered),
                                   .hint = str_to_c(arena, diag->hint),
                                   .end_line = end.line,
                                   .end_column = end.column};
    diagnostics_pass_on(session, &public_diag);
}

void diagnostics_pass_on(PetriSession *session, const PetriDiagnostic *diagnostic) {
    session->diagnostics.counts[diagnostic->level]++;
    keep(&session->diagnostics, diagnostic);
    if (session->options.diagnostic)
        session->options.diagnostic(session->options.host, diagnostic);
}

typedef struct Telling {
    const Diag *diag;
    Str key;
} Telling;

static void tell(PetriSession *session, void *context) {
    const Telling *telling = context;
    Diagnostics *diagnostics = &session->diagnostics;
    Str key = telling->key;
    uint64_t hash = hash_bytes(0, key.bytes, key.len);
    if (key.len && is_told(diagnostics, hash))
        return; // before anything is rendered: it may come in every frame
    ArenaMark mark = arena_mark(&session->text_arena);
    Text rendered = text_new(&session->text_arena);
    diag_format(&rendered, telling->diag, session->options.colour);
    if (!key.len)
        hash = hash_bytes(0, rendered.bytes, rendered.len);
    bool told = !key.len && is_told(diagnostics, hash);
    if (!told || diagnostics->repeat)
        give(session, telling->diag, text_str(&rendered));
    if (!told) {
        remember(diagnostics, hash);
        if (diagnostics->told_count == MOST_TOLD) {
            Diag last = {.level = DIAG_NOTE, .text = STR("1000 diagnostics were given; no more are shown")};
            rendered.len = 0;
            diag_format(&rendered, &last, session->options.colour);
            give(session, &last, text_str(&rendered));
        }
    }
    arena_rewind(&session->text_arena, mark);
}

// Takes no memory, so that a host hears that there is none.
static void tell_plainly(PetriSession *session, const Diag *diag) {
    static const char *const levels[] = {"error", "warning", "note"};
    char text[200], rendered[240];
    snprintf(text, sizeof text, "%.*s", STR_ARGS(str_cut(diag->text, sizeof text - 1)));
    snprintf(rendered, sizeof rendered, "%s: %s\n", levels[diag->level], text);
    PetriDiagnostic plain = {
        .level = (PetriLevel)diag->level, .text = text, .code = diag->code, .rendered = rendered, .hint = ""};
    diagnostics_pass_on(session, &plain);
}

// Within a protected call, one that cannot be made takes that call with it.
void session_tell_keyed(PetriSession *session, const Diag *diag, Str key) {
    Telling telling = {diag, key};
    if (session->text_arena.escape)
        tell(session, &telling);
    else if (session_protect(session, NULL, tell, &telling) == PETRI_MEMORY)
        tell_plainly(session, diag);
}

void session_tell(PetriSession *session, const Diag *diag) {
    session_tell_keyed(session, diag, (Str){0});
}

void session_tell_text(PetriSession *session, DiagLevel level, const char *code, Str text) {
    session_tell(session, &(Diag){.level = level, .text = text, .code = code});
}

void session_tell_all(PetriSession *session, const DiagSink *sink) {
    for (uint32_t i = 0; i < sink->count; i++)
        session_tell(session, &sink->items[i]);
    if (sink->dropped) {
        char text[64];
        snprintf(text, sizeof text, "%u more diagnostics are not shown", sink->dropped);
        session_tell_text(session, DIAG_NOTE, NULL, str_from(text));
    }
}

uint64_t petri_diagnostic_count(const PetriSession *session, PetriLevel level) {
    if (!session || (unsigned)level > PETRI_NOTE)
        return 0;
    return session->diagnostics.counts[level];
}
