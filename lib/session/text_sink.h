// text_sink.h: text on its way to the host, handed over in pieces as it comes.
#ifndef PETRI_SESSION_TEXT_SINK_H
#define PETRI_SESSION_TEXT_SINK_H

#include "base/sha256.h"
#include "petri.h"
#include "value/format.h"

typedef struct TextSink {
    Text text;
    PetriWriteCallback *write; // NULL: to nobody
    void *user_data;
    bool stopped;             // the host takes no more, or it is enough
    const Node *truncated_at; // the tree that it was enough of, or NULL
    size_t written;           // bytes
    Sha256 *hash;             // takes the text as well, or NULL
    bool muted;               // from the host
} TextSink;

void text_sink_flush(TextSink *out);
void text_sink_end_line(TextSink *out);
// Nodes that are shared come wherever they are, so the text of a small tree may have no end worth waiting for: it is
// cut.
void text_sink_add_tree(TextSink *out, const SymbolTable *symbols, const Node *node);
// What came of it, after the last flush: tells of a text that was cut.
PetriStatus text_sink_finish(PetriSession *session, const TextSink *out);

#endif
