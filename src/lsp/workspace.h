// workspace.h: opens a script and all scripts related to it by imports and includes, and resolves names across them.
#pragma once

#include "lsp/server.h"

// Identifies a binding in a document.
typedef struct BindingRef {
    size_t file; // index in Workspace.documents
    size_t name; // index in Document.names
} BindingRef;

enum { MAX_BINDINGS = 32 };

// The bindings that a name may refer to. There is usually one. If an included file uses a name without binding it,
// there may be one for each script that includes the file.
typedef struct BindingSet {
    BindingRef items[MAX_BINDINGS];
    size_t count;
} BindingSet;

typedef struct Workspace {
    Server *server;
    Document **documents; // the requested document is the first
    bool *own;            // for each document: true if the workspace frees it
    size_t *main;         // for each document: index of the script whose chain of links led to it; itself if none did
    bool *included;       // for each document: true if another document includes it
    size_t count;
    bool all;          // true if scripts without imports and includes are also searched for
    size_t files_left; // number of directory entries that the search may still visit before it stops
} Workspace;

// Opens the document, the editor's open documents and the files that they import and include. If `whole`, also opens
// the scripts in the editor's folders, or in the document's folder if the editor has none. Finally drops every document
// that is not connected with `document` by a chain of imports and includes.
void workspace_open(Workspace *workspace, Server *server, Document *document, bool whole);
// Opens the editor's open documents and all scripts in the editor's folders.
void workspace_open_all(Workspace *workspace, Server *server);
void workspace_close(Workspace *workspace);
// Replaces the text of a document within the workspace only.
void workspace_replace(Workspace *workspace, size_t file, const Text *text);

// Returns the bindings that a name refers to.
BindingSet workspace_bindings(const Workspace *workspace, size_t file, size_t name);
// Returns the bindings that a token of the first document refers to. Also finds bindings for a token in a statement
// with a syntax error.
BindingSet workspace_resolve(const Workspace *workspace, size_t token);
bool binding_sets_overlap(const BindingSet *a, const BindingSet *b);
// Adds the bindings in `more` that `senses` does not contain. Returns true if any were added.
bool binding_set_add(BindingSet *senses, const BindingSet *more);

// Returns the binding that the name `text` refers to at the place where the document includes a file (`link`). Returns
// NULL if no binding is visible there.
const PetriBinding *workspace_visible(const Document *document, const Link *link, Str text);
const PetriBinding *workspace_name(const Workspace *workspace, BindingRef sense);
