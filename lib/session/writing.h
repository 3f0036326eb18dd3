// writing.h: text on its way to the host, handed over in pieces as it comes.
#ifndef PETRI_SESSION_WRITING_H
#define PETRI_SESSION_WRITING_H

#include "petri.h"

#include "base/sha256.h"
#include "value/format.h"

typedef struct Writing {
    Text text;
    PetriWrite *write; // NULL: to nobody
    void *host;
    bool stopped;    // the host takes no more, or it is enough
    const Node *cut; // the tree that it was enough of, or NULL
    size_t written;  // bytes
    Sha256 *hash;    // takes the text as well, or NULL
    bool hidden;     // from the host
} Writing;

void writing_flush(Writing *out);
void writing_line_end(Writing *out);
// Nodes that are shared come wherever they are, so the text of a small tree may have no end worth waiting for: it is
// cut.
void writing_tree(Writing *out, const SymbolTable *symbols, const Node *node);
// What came of it, after the last flush: tells of a text that was cut.
PetriStatus writing_end(PetriSession *session, const Writing *out);

#endif
