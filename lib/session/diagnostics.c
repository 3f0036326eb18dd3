// diagnostics.c: implementation of diagnostics.h.
#include "base/heap.h"
#include "base/host_struct.h"
#include "session/session.h"

#include <stdio.h>
#include <string.h>

enum { MAX_REPORTED = 1000 };

static void clear_retained(Diagnostics *diagnostics) {
    for (uint32_t i = 0; i < MAX_RETAINED; i++) {
        heap_free(diagnostics->retained[i]);
        diagnostics->retained[i] = NULL;
    }
    diagnostics->retained_first = diagnostics->retained_count = 0;
}

// Copies a string to *end and advances *end past the copy. Returns the copy. If `text` is NULL, returns NULL.
static const char *add_report_text(char **end, const char *text) {
    size_t size = text ? strlen(text) + 1 : 0;
    const char *copy = text ? memcpy(*end, text, size) : NULL;
    *end += size;
    return copy;
}

static size_t text_size(const char *text) {
    return text ? strlen(text) + 1 : 0;
}

PetriDiagnostic *diagnostics_copy(const PetriDiagnostic *diagnostic) {
    PetriDiagnostic *copy =
        heap_alloc(sizeof *copy + text_size(diagnostic->file) + text_size(diagnostic->text) +
                   text_size(diagnostic->code) + text_size(diagnostic->rendered) + text_size(diagnostic->hint));
    if (!copy)
        return NULL;
    char *end = (char *)(copy + 1);
    *copy = *diagnostic;
    copy->file = add_report_text(&end, diagnostic->file);
    copy->text = add_report_text(&end, diagnostic->text);
    copy->code = add_report_text(&end, diagnostic->code);
    copy->rendered = add_report_text(&end, diagnostic->rendered);
    copy->hint = add_report_text(&end, diagnostic->hint);
    return copy;
}

// Stores a copy of a diagnostic for petri_diagnostic, unless out of memory.
static void retain_diagnostic(Diagnostics *diagnostics, const PetriDiagnostic *diagnostic) {
    PetriDiagnostic *copy = diagnostics_copy(diagnostic);
    if (!copy)
        return;
    bool full = diagnostics->retained_count == MAX_RETAINED;
    PetriDiagnostic **place =
        &diagnostics->retained[(diagnostics->retained_first + diagnostics->retained_count) % MAX_RETAINED];
    heap_free(*place);
    *place = copy;
    diagnostics->retained_first = (diagnostics->retained_first + full) % MAX_RETAINED;
    diagnostics->retained_count += !full;
}

bool petri_diagnostic(const PetriSession *session, size_t number, PetriDiagnostic *diagnostic, size_t size) {
    if (!session || number >= session->diagnostics.retained_count)
        return false;
    PetriDiagnostic found =
        *session->diagnostics.retained[(session->diagnostics.retained_first + number) % MAX_RETAINED];
    found.size = size < sizeof found ? size : sizeof found;
    return host_struct_write(diagnostic, size, &found, sizeof found);
}

void petri_clear_diagnostics(PetriSession *session) {
    if (session)
        clear_retained(&session->diagnostics);
}

void diagnostics_free(Diagnostics *diagnostics) {
    clear_retained(diagnostics);
    hash_index_free(&diagnostics->reported_index);
    heap_free(diagnostics->reported);
}

void diagnostics_begin_load(Diagnostics *diagnostics) {
    diagnostics->reported_count = 0;
    hash_index_clear(&diagnostics->reported_index);
}

bool diagnostics_repeat(Diagnostics *diagnostics, bool repeat) {
    bool before = diagnostics->repeat;
    diagnostics->repeat = repeat;
    return before;
}

static bool has_hash(const void *owner, uint32_t entry, const void *key) {
    return ((const Diagnostics *)owner)->reported[entry] == *(const uint64_t *)key;
}

// Returns true if a diagnostic must be suppressed: it was reported before, or MAX_REPORTED diagnostics were reported.
static bool is_reported(const Diagnostics *diagnostics, uint64_t hash) {
    return diagnostics->reported_count >= MAX_REPORTED ||
           hash_index_find(&diagnostics->reported_index, hash, has_hash, diagnostics, &hash) != HASH_INDEX_NONE;
}

// Remembers a reported diagnostic. If out of memory, it may be reported again.
static void store_hash(Diagnostics *diagnostics, uint64_t hash) {
    if (!heap_reserve((void **)&diagnostics->reported, &diagnostics->reported_capacity, diagnostics->reported_count,
                      sizeof hash))
        return;
    diagnostics->reported[diagnostics->reported_count] = hash;
    if (hash_index_add(&diagnostics->reported_index, hash, diagnostics->reported_count))
        diagnostics->reported_count++;
}

static void send_diagnostic(PetriSession *session, const Diag *diag, Str rendered) {
    Arena *arena = &session->text_arena;
    SourcePosition place = {0}, end = {0};
    if (diag->at.source) {
        place = source_locate(diag->at.source, diag->at.span.start);
        end = source_locate(diag->at.source, diag->at.span.end);
    }
    PetriDiagnostic public_diag = {.size = sizeof public_diag,
                                   .level = (PetriLevel)diag->level,
                                   .file = diag->at.source ? str_to_c(arena, diag->at.source->name) : NULL,
                                   .line = place.line,
                                   .column = place.column,
                                   .text = str_to_c(arena, diag_text(diag)),
                                   .code = diag->code,
                                   .rendered = str_to_c(arena, rendered),
                                   .hint = str_to_c(arena, diag->hint),
                                   .end_line = end.line,
                                   .end_column = end.column};
    diagnostics_forward(session, &public_diag);
}

void diagnostics_forward(PetriSession *session, const PetriDiagnostic *diagnostic) {
    const Diagnostics *all = &session->diagnostics;
    if (all->filter && !all->filter(all->filter_context, diagnostic))
        return;
    session->diagnostics.counts[diagnostic->level]++;
    retain_diagnostic(&session->diagnostics, diagnostic);
    if (session->options.on_diagnostic)
        session->options.on_diagnostic(session->options.user_data, diagnostic);
}

typedef struct PendingReport {
    const Diag *diag;
    Str key;
} PendingReport;

static PetriStatus report_diagnostic(PetriSession *session, void *context) {
    const PendingReport *pending = context;
    Diagnostics *diagnostics = &session->diagnostics;
    Str key = pending->key;
    uint64_t hash = hash_bytes(0, key.bytes, key.len);
    if (key.len && is_reported(diagnostics, hash))
        return PETRI_OK; // not rendered, because a diagnostic that recurs in every frame must cost little
    ArenaMark mark = arena_mark(&session->text_arena);
    Text rendered = text_new(&session->text_arena);
    diag_format(&rendered, pending->diag, session->options.colour);
    if (!key.len)
        hash = hash_bytes(0, rendered.bytes, rendered.len);
    bool already_reported = !key.len && is_reported(diagnostics, hash);
    if (!already_reported || diagnostics->repeat)
        send_diagnostic(session, pending->diag, text_str(&rendered));
    if (!already_reported) {
        store_hash(diagnostics, hash);
        if (diagnostics->reported_count == MAX_REPORTED) {
            Diag last = {.level = DIAG_NOTE, .text = STR("1000 diagnostics reported; further ones are not shown")};
            rendered.len = 0;
            diag_format(&rendered, &last, session->options.colour);
            send_diagnostic(session, &last, text_str(&rendered));
        }
    }
    arena_rewind(&session->text_arena, mark);
    return PETRI_OK;
}

// Reports a diagnostic without allocating from arenas, so that an out-of-memory error can be reported.
static void report_without_memory(PetriSession *session, const Diag *diag) {
    static const char *const levels[] = {"error", "warning", "note"};
    char text[200], rendered[240];
    snprintf(text, sizeof text, "%.*s", STR_ARGS(str_truncate(diag->text, sizeof text - 1)));
    snprintf(rendered, sizeof rendered, "%s: %s\n", levels[diag->level], text);
    PetriDiagnostic plain = {
        .level = (PetriLevel)diag->level, .text = text, .code = diag->code, .rendered = rendered, .hint = ""};
    diagnostics_forward(session, &plain);
}

// If called within a protected call, that call is aborted when memory runs out here.
void session_report_keyed(PetriSession *session, const Diag *diag, Str key) {
    PendingReport pending = {diag, key};
    if (session->text_arena.escape)
        report_diagnostic(session, &pending);
    else if (session_attempt(session, NULL, report_diagnostic, &pending) == PETRI_OUT_OF_MEMORY)
        report_without_memory(session, diag);
}

void session_report(PetriSession *session, const Diag *diag) {
    session_report_keyed(session, diag, (Str){0});
}

void session_report_all(PetriSession *session, const DiagSink *sink) {
    for (uint32_t i = 0; i < sink->count; i++)
        session_report(session, &sink->items[i]);
    session_report_dropped(session, sink);
}

void session_report_dropped(PetriSession *session, const DiagSink *sink) {
    char text[64];
    if (!sink->dropped)
        return;
    snprintf(text, sizeof text, "%u more diagnostics are not shown", sink->dropped);
    session_report_text(session, DIAG_NOTE, NULL, str_from(text));
}

uint64_t petri_diagnostic_count(const PetriSession *session, PetriLevel level) {
    if (!session || (unsigned)level > PETRI_NOTE)
        return 0;
    return session->diagnostics.counts[level];
}
