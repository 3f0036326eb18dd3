// workspace.h: the scripts that one script is written together with, and what names mean in all of them.
#ifndef PETRI_SRC_LSP_WORKSPACE_H
#define PETRI_SRC_LSP_WORKSPACE_H

#include "lsp/server.h"

// A name of a document: a binding is what its uses mean.
typedef struct Sense {
    size_t file; // number of the document
    size_t name; // in its names
} Sense;

enum { MOST_SENSES = 32 };

// What a name means: one binding, or one for each script that includes its own.
typedef struct Senses {
    Sense items[MOST_SENSES];
    size_t count;
} Senses;

typedef struct Workspace {
    Server *server;
    Document **documents; // the one asked about is the first
    bool *own;            // those that are freed with the workspace
    bool *included;       // by another of them
    size_t count;
    size_t left; // files that may still be read
} Workspace;

// The document, those that the editor has open, and what they import and include; if `whole`, scripts of the editor's
// folders (without any: of the document's own) as well. In either case only those that have to do with the document.
void workspace_open(Workspace *workspace, Server *server, Document *document, bool whole);
void workspace_close(Workspace *workspace);
// The same with another text of one document.
void workspace_replace(Workspace *workspace, size_t file, const Bytes *text);

Senses workspace_senses(const Workspace *workspace, size_t file, size_t name);
// Of a token of the first document, which may be in a statement that does not parse.
Senses workspace_meaning(const Workspace *workspace, size_t token);
bool senses_meet(const Senses *a, const Senses *b);
// Adds what is not among them yet; false if nothing is new.
bool senses_add(Senses *senses, const Senses *more);

// What a name means where a document includes a file.
const PetriTextName *workspace_visible(const Document *document, const Link *link, Str text);
const PetriTextName *workspace_name(const Workspace *workspace, Sense sense);

#endif
