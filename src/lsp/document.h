// document.h: a script that is open in the editor, or a file that such a script refers to.
#pragma once

#include "lsp/rpc.h"
#include "petri-edit.h"

// A diagnostic of the document's own text. Diagnostics of included files are published, but not stored here.
typedef struct DocumentDiagnostic {
    PetriLevel level;
    size_t start; // offset in the text
    size_t end;
    char *text;
    char *hint;
    char *code; // NULL: none
} DocumentDiagnostic;

// Diagnostics of a file, as they are published.
typedef struct FileDiagnostics {
    char *uri;
    TextList items; // as JSON
} FileDiagnostics;

typedef struct FileDiagnosticsList {
    FileDiagnostics *items;
    size_t count;
} FileDiagnosticsList;

typedef struct DiagnosticList {
    DocumentDiagnostic *items;
    size_t count;
} DiagnosticList;

// A file that a script imports or includes.
typedef struct Link {
    size_t token;  // index of the string's token
    bool include;  // true for %include, false for import
    char *path;    // canonical if the file exists
    size_t target; // index in Workspace.documents; SIZE_MAX: not in the workspace
} Link;

// A failed test of a script.
typedef struct DocumentFailure {
    uint32_t line; // from 1; 0: not known
    char *text;
} DocumentFailure;

typedef struct Document {
    char *uri;       // as the editor writes it
    char *path;      // name in diagnostics: the path, or the URI if it is not a file URI
    char *canonical; // canonical path (symbolic links and dots resolved) if the file exists, else `path`
    int64_t version; // version number that the editor gave the document; sent with diagnostics
    Text text;       // lines end in LF
    size_t *lines;   // offset of each line
    size_t line_count;
    bool is_file;       // true if the URI is a file URI
    bool unread;        // true if tokens and names are outdated: the text has changed
    bool unchecked;     // true if diagnostics are outdated
    bool exceeded;      // true if the first check of this text exceeded its small work limit
    PetriToken *tokens; // without NEWLINE, INDENT and DEDENT
    size_t token_count;
    size_t *levels;      // indentation level of each token; SIZE_MAX - level if the token begins a statement
    PetriBinding *names; // bindings and uses of names, sorted by offset
    size_t name_count;
    Link *links;
    size_t link_count;
    DiagnosticList diagnostics;
    DocumentFailure *failures; // failed tests when the document was saved; none after a change
    size_t failure_count;
    TextList used;                 // files that the last check read
    FileDiagnosticsList published; // diagnostics of the last check
    char **values;                 // value of each of `names` if it is a constant, else NULL; NULL: not evaluated yet
} Document;

Document *document_new(const char *uri, Str text, int64_t version);
void document_free(Document *document);
// Applies one change of textDocument/didChange.
void document_change(Document *document, const Json *change, bool utf8);
// Updates tokens and names if they are outdated.
void document_read(Document *document, PetriSession *session);
void document_add_failure(Document *document, uint32_t line, const char *text);
void document_clear_failures(Document *document);
void diagnostic_list_free(DiagnosticList *list);
void file_diagnostics_free(FileDiagnosticsList *list);

// Positions. A position after the end of the text is moved to the end.
size_t document_offset(const Document *document, const Json *position, bool utf8);
size_t document_offset_at(const Document *document, uint32_t line, uint32_t column); // both count from 1
void document_put_position(JsonWriter *json, const char *name, const Document *document, size_t offset, bool utf8);
void document_put_range(JsonWriter *json, const char *name, const Document *document, size_t start, size_t end,
                        bool utf8);
void document_position(const Document *document, size_t offset, bool utf8, size_t *line, size_t *character);
Str document_slice(const Document *document, size_t start, size_t end);
// Returns the binding that scripts import under a name: the last top-level binding. Returns NULL if there is none.
const PetriBinding *document_export(const Document *document, Str name);
Str document_token(const Document *document, size_t token);
bool document_is(const Document *document, size_t token, const char *text);
bool document_begins(const Document *document, size_t token); // returns true if the token begins a statement
size_t document_level(const Document *document, size_t token);
// Returns the offset of the end of the statement that a token begins. The end includes the block of the statement.
size_t document_block_end(const Document *document, size_t token);
// Returns the first token that ends after the offset, or token_count.
size_t document_token_at(const Document *document, size_t offset);
// Returns the name at an offset, or NULL.
const PetriBinding *document_name_at(const Document *document, size_t offset);
// Returns the binding that a name refers to, or the name itself if it is a binding. Returns NULL if the document does
// not bind the name.
const PetriBinding *document_binding(const Document *document, const PetriBinding *name);

// Returns the import or include whose file name is at an offset, or NULL if there is none.
const Link *document_link(const Document *document, size_t offset);

// Returns the binding that the name at a token refers to. In a statement with a syntax error, returns the innermost
// binding of this name that is visible there. Returns NULL if the document does not bind the name.
const PetriBinding *document_resolve(const Document *document, size_t token);

// Converts a file URI such as file:///a%20b to a path such as /a b. Returns NULL if it is not a file URI. The caller
// frees it with free.
char *uri_path(const char *uri);
// Converts a path to a file URI. The caller frees it with free.
char *uri_of(const char *path);
// Returns the canonical path of a file, or a copy of the path if there is no such file. The caller frees it with free.
char *path_canonical(const char *path);
