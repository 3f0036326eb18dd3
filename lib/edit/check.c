// check.c: checks of scripts (petri_check).
#include "base/heap.h"
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
    PetriDiagnostic **items;
    uint32_t count;
    uint32_t capacity;
    bool incomplete; // true if diagnostics are missing because memory ran out
} CheckLog;

static void log_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    CheckLog *log = host;
    PetriDiagnostic *copy = diagnostics_copy(diagnostic);
    if (copy && heap_reserve((void **)&log->items, &log->capacity, log->count, sizeof *log->items)) {
        log->items[log->count++] = copy;
    } else {
        log->incomplete = true;
        heap_free(copy);
    }
}

static bool comes_before(const PetriDiagnostic *a, const PetriDiagnostic *b) {
    return a->file && b->file && strcmp(a->file, b->file) == 0 && a->line < b->line;
}

// Reports and frees the diagnostics. Those of one file are sorted by line.
static void report_in_order(PetriSession *session, CheckLog *log) {
    for (uint32_t i = 0; i < log->count; i++) {
        PetriDiagnostic *item = log->items[i];
        uint32_t at = i;
        for (; at > 0 && comes_before(item, log->items[at - 1]); at--)
            log->items[at] = log->items[at - 1];
        log->items[at] = item;
    }
    for (uint32_t i = 0; i < log->count; i++) {
        diagnostics_forward(session, log->items[i]);
        heap_free(log->items[i]);
    }
    heap_free(log->items);
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
    open_scratch(session, &log);
    bool opened = log.scratch;
    if (opened)
        status = run_checks(log.scratch, file, text, length);
    petri_close(&log.scratch);
    report_in_order(session, &log);
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
