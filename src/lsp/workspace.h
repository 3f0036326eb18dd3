// workspace.h: the scripts that one script is written together with, and what names mean in all of them.
#ifndef PETRI_SRC_LSP_WORKSPACE_H
#define PETRI_SRC_LSP_WORKSPACE_H

#include "lsp/server.h"

// A name of a document: a binding is what its uses mean.
typedef struct BindingRef {
    size_t file; // number of the document
    size_t name; // in its names
} BindingRef;

enum { MAX_BINDINGS = 32 };

// What a name means: one binding, or one for each script that includes its own.
typedef struct BindingSet {
    BindingRef items[MAX_BINDINGS];
    size_t count;
} BindingSet;

typedef struct Workspace {
    Server *server;
    Document **documents; // the one asked about is the first
    bool *own;            // those that are freed with the workspace
    bool *included;       // by another of them
    size_t count;
    size_t files_left; // files that may still be read
} Workspace;

// The document, those that the editor has open, and what they import and include; if `whole`, scripts of the editor's
// folders (without any: of the document's own) as well. In either case only those that have to do with the document.
void workspace_open(Workspace *workspace, Server *server, Document *document, bool whole);
void workspace_close(Workspace *workspace);
// The same with another text of one document.
void workspace_replace(Workspace *workspace, size_t file, const ByteBuffer *text);

BindingSet workspace_bindings(const Workspace *workspace, size_t file, size_t name);
// Of a token of the first document, which may be in a statement that does not parse.
BindingSet workspace_resolve(const Workspace *workspace, size_t token);
bool binding_sets_overlap(const BindingSet *a, const BindingSet *b);
// Adds what is not among them yet; false if nothing is new.
bool binding_set_add(BindingSet *senses, const BindingSet *more);

// What a name means where a document includes a file.
const PetriBinding *workspace_visible(const Document *document, const Link *link, Str text);
const PetriBinding *workspace_name(const Workspace *workspace, BindingRef sense);

#endif
