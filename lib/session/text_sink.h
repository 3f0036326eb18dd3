// text_sink.h: text output to a callback of the host, in chunks.
#pragma once

#include "base/sha256.h"
#include "base/str.h"
#include "petri.h"
#include "value/node.h"

typedef struct TextSink {
    Text text;                 // text not flushed yet
    PetriWriteCallback *write; // callback of the host; NULL: the text is discarded
    void *user_data;
    bool stopped;             // true if the host stopped the output, or it was truncated
    const Node *truncated_at; // root of the tree that was truncated, or NULL
    size_t written;           // bytes flushed so far
    Sha256 *hash;             // hash that receives the same text; NULL: none
    bool muted;               // true: only the hash receives the text, not the host
} TextSink;

// Passes the accumulated text to the host (unless muted or stopped) and to the hash.
void text_sink_flush(TextSink *out);
// Ends a line; flushes if enough text has accumulated.
void text_sink_end_line(TextSink *out);
// Adds a tree as text. Shared nodes are written each time they occur, so even a small tree may result in a huge output.
// The output is truncated at 512 MiB.
void text_sink_add_tree(TextSink *out, const SymbolTable *symbols, const Node *node);

// Calls `print` within a protected call, with a sink that passes the text to `write`. `selection` is passed on. Returns
// PETRI_INVALID if the host stopped the output, PETRI_LIMIT_EXCEEDED if a tree was truncated, or the reason for an
// abort; the latter two are reported.
typedef void TextSinkPrint(TextSink *out, PetriSession *session, unsigned selection);
PetriStatus text_sink_run(PetriSession *session, TextSinkPrint *print, unsigned selection, PetriWriteCallback *write,
                          void *user_data);
