// server.h: what the parts of the language server share.
#ifndef PETRI_SRC_LSP_SERVER_H
#define PETRI_SRC_LSP_SERVER_H

#include "cli/options.h"
#include "lsp/document.h"

typedef struct Server {
    const CommandContext *host;
    Options *options;
    PetriSession *session; // for tokens, names and checks
    size_t read;           // bytes since it was opened
    TextList roots;        // the editor's folders
    Document **documents;
    size_t document_count;
    bool utf8; // how the editor counts characters: UTF-8 or UTF-16
    bool initialized;
    bool shutting_down; // shutdown was asked for
    bool checking;      // diagnostics go to `checked`
    Document *checked;
    Json *found; // … and here, by URI
} Server;

// NULL if the editor has not opened it.
Document *server_document(const Server *server, const char *uri);
// The document, or the file read into one that is to be freed if `*read` is set. NULL if there is none.
Document *server_file(Server *server, const char *path, bool *read);
// For petri_open: what is open stands for its file, and whatever the document at work asks for is noted.
const char *server_unsaved(void *server, const char *path, size_t *length);
// Tokens and names of the present text.
void server_read(Server *server, Document *document);
bool server_open_session(Server *server);

// What petri check has to say, to the editor (publish.c).
void diagnostics_publish(Server *server, Document *document);
void diagnostics_collect(void *server, const PetriDiagnostic *diagnostic);
void diagnostics_withdraw(Server *server, Document *document);

// Where a request asks about something.
typedef struct Place {
    Server *server;
    Document *document;
    const Json *params;
    size_t offset; // of params.position, if there is one
} RequestContext;

// Requests: each gives the result, or NULL for null. An error is a text in *problem.
typedef Json *RequestHandler(const RequestContext *request, const char **problem);
RequestHandler answer_completion, answer_hover, answer_signature, answer_definition, answer_references,
    answer_highlight, answer_prepare_rename, answer_rename, answer_symbols, answer_folding, answer_tokens, answer_hints,
    answer_colours, answer_presentations, answer_actions, answer_format;
// Of semantic tokens, for the capabilities.
Json *tokens_legend(void);

// What is known of a word (hover.c).

// The number of the node kind to which an attribute that begins at the token belongs, or SIZE_MAX.
size_t hover_node_of(const Document *document, size_t token, const char **name);
// Kinds of one name stand in several areas: the one in `area`, or any.
bool hover_kind(Str name, size_t *number, PetriNodeKind *kind);
bool hover_builtin(Str name, PetriBuiltin *builtin);
void hover_attribute(ByteBuffer *out, const PetriNodeAttribute *attribute);
// The statement or value of a name, as a block of code, with its value if it is a constant.
void hover_binding(ByteBuffer *out, Server *server, Document *document, const PetriBinding *name);
// The value of a name that is the same in each frame; NULL if it is none, or more than a frame may take.
const char *hover_value(Server *server, Document *document, const PetriBinding *name);
// The binding of a name at the top level, the last that counts.
const PetriBinding *hover_export(const Document *document, Str name);

#endif
