// text_sink.c: text output to a callback of the host, in chunks; see text_sink.h.
#include "session/text_sink.h"

#include "session/session.h"
#include "value/format.h"

#include <stdio.h>

enum { FLUSH_SIZE = 64 << 10 };
#define MAX_BYTES ((size_t)512 << 20) // maximum size of an output that contains trees

void text_sink_flush(TextSink *out) {
    if (out->hash)
        sha256_add(out->hash, out->text.bytes, out->text.len);
    if (out->text.len && !out->stopped && !out->muted && out->write)
        out->stopped = !out->write(out->user_data, out->text.bytes, out->text.len);
    out->written += out->text.len;
    out->text.len = 0;
}

void text_sink_end_line(TextSink *out) {
    text_add_char(&out->text, '\n');
    if (out->text.len >= FLUSH_SIZE)
        text_sink_flush(out);
}

static bool flush_tree_line(void *host, Text *text) {
    TextSink *out = host;
    if (text->len < FLUSH_SIZE)
        return true;
    text_sink_flush(out);
    return !out->stopped && out->written <= MAX_BYTES;
}

void text_sink_add_tree(TextSink *out, const SymbolTable *symbols, const Node *node) {
    if (format_tree(&out->text, symbols, node, 0, flush_tree_line, out) || out->stopped)
        return;
    out->truncated_at = node;
    out->stopped = true;
}

// Returns the status of the whole output, and reports an error if a tree was truncated. Called after the last flush.
static PetriStatus finish(PetriSession *session, const TextSink *out) {
    if (!out->truncated_at)
        return out->stopped ? PETRI_INVALID : PETRI_OK;
    char text[80];
    snprintf(text, sizeof text, "the printed tree exceeds %zu MiB: truncated here", MAX_BYTES >> 20);
    Origin place = node_origin(out->truncated_at, NULL);
    session_report(session, &(Diag){DIAG_ERROR, place, str_from(text), .code = "memory-limit"});
    return PETRI_LIMIT_EXCEEDED;
}

// Arguments and result of text_sink_run.
typedef struct Printing {
    TextSinkPrint *print;
    unsigned selection;
    PetriWriteCallback *write;
    void *user_data;
    PetriStatus status;
} Printing;

static PetriStatus run_print(PetriSession *session, void *context) {
    Printing *printing = context;
    arena_reset(&session->text_arena);
    TextSink out = {.text = text_new(&session->text_arena), .write = printing->write, .user_data = printing->user_data};
    printing->print(&out, session, printing->selection);
    text_sink_flush(&out);
    printing->status = finish(session, &out); // not returned, because it is reported already
    return PETRI_OK;
}

PetriStatus text_sink_run(PetriSession *session, TextSinkPrint *print, unsigned selection, PetriWriteCallback *write,
                          void *user_data) {
    Printing printing = {print, selection, write, user_data, PETRI_OK};
    PetriStatus status = session_protect(session, NULL, run_print, &printing);
    return status == PETRI_OK ? printing.status : session_report_abort(session, status, "the output");
}
