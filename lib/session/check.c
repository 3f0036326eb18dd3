// check.c: checks of scripts (petri_check).
#include "session/session.h"

#include <string.h>

// Reads all windows in the same way as for drawing, to report errors in their nodes.
static PetriStatus lint_windows(PetriSession *session, void *context) {
    const Node *window;
    (void)context;
    for (uint32_t at = 0; (window = canvas_next_window(&session->schema, session->frame.tree, &at));)
        canvas_read(&session->schema, &session->frame.systems_arena, window);
    return PETRI_OK;
}

// Diagnostics of the scratch session, a temporary session that runs the checks. They are collected and then sorted by
// line, because each stage of the check goes through the whole script. In a line, causes come first: an unbound name is
// found by the compiler, and the system that it invalidates by the evaluation.
typedef struct CheckLog {
    PetriSession *scratch;
    Arena arena;
    PetriDiagnostic *items;
    size_t count;
    bool incomplete; // true if diagnostics are missing because memory ran out
} CheckLog;

static const char *copy_text(CheckLog *log, const char *text) {
    return text ? str_to_c(&log->arena, str_from(text)) : NULL;
}

typedef struct CheckLogEntry {
    CheckLog *log;
    const PetriDiagnostic *diagnostic;
} CheckLogEntry;

static void add_to_log(void *context) {
    const CheckLogEntry *entry = context;
    CheckLog *log = entry->log;
    size_t size = log->count * sizeof *log->items;
    log->items = arena_grow(&log->arena, log->items, size, size + sizeof *log->items);
    PetriDiagnostic *item = &log->items[log->count];
    *item = *entry->diagnostic;
    item->file = copy_text(log, item->file);
    item->text = copy_text(log, item->text);
    item->code = copy_text(log, item->code);
    item->rendered = copy_text(log, item->rendered);
    item->hint = copy_text(log, item->hint);
    log->count++;
}

static void log_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    CheckLog *log = host;
    Arena *arena = &log->arena;
    CheckLogEntry entry = {log, diagnostic};
    log->incomplete |= arena_protect(&arena, 1, add_to_log, &entry) != ARENA_OK;
}

static bool comes_before(const PetriDiagnostic *a, const PetriDiagnostic *b) {
    return a->file && b->file && strcmp(a->file, b->file) == 0 && a->line < b->line;
}

// Reports the diagnostics. Those of one file are sorted by line.
static void report_in_order(PetriSession *session, CheckLog *log) {
    for (size_t i = 0; i < log->count; i++) {
        PetriDiagnostic item = log->items[i];
        size_t at = i;
        for (; at > 0 && comes_before(&item, &log->items[at - 1]); at--)
            log->items[at] = log->items[at - 1];
        log->items[at] = item;
    }
    for (size_t i = 0; i < log->count; i++)
        diagnostics_forward(session, &log->items[i]);
}

static void open_scratch(PetriSession *session, CheckLog *log) {
    PetriOptions options = session->options;
    options.realtime = options.profile = options.rollback_frames = options.keep_forces = false;
    options.threads = 1;
    options.on_diagnostic = log_diagnostic;
    options.user_data = log;
    log->scratch = petri_open(&options);
    if (log->scratch) {
        log->scratch->interrupt_source = session->interrupt_source;
        log->scratch->budget.user_data = session->options.user_data; // for the host's should_interrupt
        // A shallow copy: its lists belong to `session`, which outlives the scratch session.
        log->scratch->reach = session->reach;
        session_copy_host_globals(session, log->scratch);
        log->scratch->functions = session->functions;
    }
    for (uint32_t i = 0; log->scratch && i < session->config.define_count; i++)
        if (petri_define(log->scratch, session->config.defines[i].text) == PETRI_OUT_OF_MEMORY)
            petri_close(&log->scratch);
}

static PetriStatus run_checks(PetriSession *scratch, const char *file, const char *text, size_t length) {
    scratch->loader.lint = scratch->schema.lint = true;
    PetriStatus status = text ? petri_load_text(scratch, file, text, length) : petri_load(scratch, file);
    // Modules that the frame imports are not linted, because each is checked separately, as a file.
    scratch->loader.lint = false;
    if (status == PETRI_OK)
        status = petri_step(scratch);
    if (status == PETRI_OK)
        status = session_run(scratch, lint_windows, NULL, "the check");
    return status;
}

// Checks the script in a file. If `text` is not NULL, checks that text instead, and `file` is its name in messages.
static PetriStatus check_script(PetriSession *session, const char *file, const char *text, size_t length) {
    CheckLog log = {0};
    PetriStatus status = PETRI_OUT_OF_MEMORY;
    arena_init(&log.arena, "check", SIZE_MAX);
    open_scratch(session, &log);
    bool opened = log.scratch;
    if (opened)
        status = run_checks(log.scratch, file, text, length);
    petri_close(&log.scratch);
    report_in_order(session, &log);
    arena_free(&log.arena);
    return log.incomplete || !opened ? session_report_abort(session, PETRI_OUT_OF_MEMORY, "the check") : status;
}

PetriStatus petri_check(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    return check_script(session, file, NULL, 0);
}

PetriStatus petri_check_text(PetriSession *session, const char *name, const char *text, size_t length) {
    if (!session || !name || !text)
        return PETRI_INVALID;
    return check_script(session, name, text, length);
}
