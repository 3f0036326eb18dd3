// server.h: internal declarations of the language server. Its files, from those that call to those that are called:
//
//   lsp.c              messages of the editor
//   complete.c, navigate.c, outline.c, inlay_hints.c, format.c   answers to its requests
//   selection.c, lenses.c   ranges to select; commands above the script
//   hover.c            help and values of words; publish.c: diagnostics
//   golden_tests.c     failed tests
//   workspace.c        names in several files
//   server.c           open documents, other files, sessions
//   document.c, rpc.c  texts and positions; messages
#pragma once

#include "base/file_access.h"
#include "cli/options.h"
#include "lsp/document.h"

enum { SERVER_MAX_FILE_BYTES = 16 << 20 }; // maximum size of a file that is not open in the editor

typedef struct Server {
    const CommandContext *host;
    Options *options;
    // Receives the diagnostics of both sessions, with the server as user data.
    void (*collect)(void *server, const PetriDiagnostic *diagnostic);
    PetriSession *session; // session in which documents are tokenised and checked
    PetriSession *quick;   // session for first checks, with a small work limit
    Arena arena;           // holds the folders of `access`
    FileAccess access;     // files that scripts may read, apart from their own folders
    Text input;            // received bytes of messages that have not been handled
    size_t read;           // number of bytes that the sessions have tokenised
    TextList roots;        // workspace folders of the editor
    TextList commands;     // commands that the editor executes for code lenses
    Document **documents;
    size_t document_count;
    bool utf8;      // true if positions count UTF-8 bytes, false if they count UTF-16 code units
    bool can_watch; // true if the editor can report changes of files on request
    bool initialized;
    bool shutting_down; // true after the shutdown request
    bool checking;      // true while the document `checked` is being checked
    Document *checked;
    FileDiagnosticsList found; // diagnostics of the current check
} Server;

// Returns an open document, or NULL.
Document *server_document(const Server *server, const char *uri);
// Returns the open document of a file. If the file is not open, reads it and sets *read to true, which means that the
// caller must free the document. Returns NULL if the file cannot be read, or if petri would not let the script `main`
// read it.
Document *server_file(Server *server, const char *path, const Document *main, bool *read);
// For PetriOptions.read_unsaved: returns the text of the file if it is open in the editor, else NULL. During a check,
// adds the path to `used` of the document that is being checked.
const char *server_unsaved(void *server, const char *path, size_t *length);
// Sets Server.access: scripts may read below the current folder and the folders of --allow-read, as in a session.
void server_init_access(Server *server);
// Opens both sessions. Returns false, after a message, if the options are wrong.
bool server_open_session(Server *server);
// Updates tokens and names of a document.
void server_read(Server *server, Document *document);

// Diagnostics (publish.c).
// Checks a document and sends the diagnostics to the editor. The first check has a small work limit. If the script
// exceeds it, the document stays unchecked and the next call makes a full check. The next message from the editor
// interrupts it.
void diagnostics_publish(Server *server, Document *document);
// Stores a diagnostic of the current check. For PetriOptions.on_diagnostic.
void diagnostics_collect(void *server, const PetriDiagnostic *diagnostic);
// Returns true if a file with recorded output is beside a script (golden_tests.c).
bool golden_tests_exist(const char *path);
// Runs the tests beside a script that was saved, and stores those that fail (golden_tests.c).
void golden_tests_run(Server *server, Document *document);
// Adds the failed tests to the diagnostics of the current check.
void golden_tests_report(Server *server, Document *document);
// Removes the document's diagnostics from the editor.
void diagnostics_withdraw(Server *server, Document *document);

// The parameters of a request.
typedef struct RequestContext {
    Server *server;
    Document *document; // NULL: the request is about the workspace
    const Json *params;
    size_t offset; // offset of params.position; 0: the request has no position
} RequestContext;

// Request handlers. They write the result; if they write nothing, it is null. On failure they set *problem to a
// message, and what they have written is not sent.
typedef void RequestHandler(const RequestContext *request, JsonWriter *result, const char **problem);
RequestHandler answer_completion, answer_hover, answer_signature, answer_definition, answer_references,
    answer_highlight, answer_prepare_rename, answer_rename, answer_symbols, answer_folding, answer_tokens, answer_hints,
    answer_colours, answer_presentations, answer_actions, answer_format, answer_range_format, answer_links,
    answer_selection, answer_lenses, answer_workspace_symbols;
// Adds a TextEdit that replaces a part of the document.
void request_put_edit(JsonWriter *json, const char *name, const RequestContext *request, size_t start, size_t end,
                      Str text);
// Returns the text offset of a position. `position` is the path of its JSON value in the request's parameters.
size_t request_offset(const RequestContext *request, const char *position);
// Adds the names of the classes and modifiers of semantic tokens, as announced in the server's capabilities.
void tokens_put_legend(JsonWriter *json);

// Information about a word (hover.c).

// Returns the index of the node kind to which an attribute at `token` belongs, or SIZE_MAX if there is none. Sets *name
// to the name of the kind, or to NULL if it is unknown.
size_t hover_node_of(const Document *document, size_t token, const char **name);
void hover_attribute(Text *out, const PetriNodeAttribute *attribute);
// Appends the definition of a name as a code block, its value if it is constant, and its comment.
void hover_binding(Text *out, Server *server, Document *document, const PetriBinding *name);
// Returns the value of a constant. Returns NULL if the name is not constant or its evaluation exceeds the work limit.
const char *hover_value(Server *server, Document *document, const PetriBinding *name);
