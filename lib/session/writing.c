// writing.c: see writing.h.
#include "session/session.h"

#include <stdio.h>

enum { PIECE = 64 << 10 };
#define MOST_BYTES ((size_t)512 << 20) // of the trees of one text

void writing_flush(Writing *out) {
    if (out->hash)
        sha256_add(out->hash, out->text.bytes, out->text.len);
    if (out->text.len && !out->stopped && !out->hidden && out->write)
        out->stopped = !out->write(out->host, out->text.bytes, out->text.len);
    out->written += out->text.len;
    out->text.len = 0;
}

void writing_line_end(Writing *out) {
    text_add_char(&out->text, '\n');
    if (out->text.len >= PIECE)
        writing_flush(out);
}

static bool line_of_tree(void *host, Text *text) {
    Writing *out = host;
    if (text->len < PIECE)
        return true;
    writing_flush(out);
    return !out->stopped && out->written <= MOST_BYTES;
}

void writing_tree(Writing *out, const SymbolTable *symbols, const Node *node) {
    if (format_tree(&out->text, symbols, node, 0, line_of_tree, out) || out->stopped)
        return;
    out->cut = node;
    out->stopped = true;
}

PetriStatus writing_end(PetriSession *session, const Writing *out) {
    if (!out->cut)
        return out->stopped ? PETRI_INVALID : PETRI_OK;
    char text[80];
    snprintf(text, sizeof text, "the text of the tree is longer than %zu MiB; it is cut here", MOST_BYTES >> 20);
    Origin place = node_place(out->cut, NULL);
    session_tell(session, &(Diag){.level = DIAG_ERROR,
                                  .source = place.source,
                                  .span = place.span,
                                  .text = str_from(text),
                                  .code = "memory-limit"});
    return PETRI_LIMIT;
}
