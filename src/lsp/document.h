// document.h: a script that an editor has open, or a file that one of them refers to.
#ifndef PETRI_SRC_LSP_DOCUMENT_H
#define PETRI_SRC_LSP_DOCUMENT_H

#include "lsp/rpc.h"
#include "petri.h"

// A diagnostic of the document's own text.
typedef struct DocumentDiagnostic {
    PetriLevel level;
    size_t start; // in the text
    size_t end;
    char *text;
    char *hint;
    char *code; // or NULL
} DocumentDiagnostic;

// A file that a script imports or includes.
typedef struct Link {
    size_t token; // the string
    bool include;
    char *path;    // canonical, if the file is there
    size_t target; // see workspace.h
} Link;

typedef struct Document {
    char *uri;
    char *path;      // what petri calls it: the file, or the URI if that is none
    char *canonical; // … without links and dots, if it is there
    int64_t version;
    ByteBuffer text; // lines end in LF
    size_t *lines;
    size_t line_count;
    bool is_file;
    bool unread;        // tokens and names are of an older text
    bool unchecked;     // … and diagnostics
    PetriToken *tokens; // but for LINE_END, INDENT and DEDENT
    size_t token_count;
    size_t *levels; // of the block that each is in; SIZE_MAX - level if it begins a statement
    PetriBinding *names;
    size_t name_count;
    Link *links;
    size_t link_count;
    DocumentDiagnostic *diagnostics;
    size_t diagnostic_count;
    TextList used;   // the files that the last check read
    Json *published; // URIs and what was told of them
    Json *values;    // of constant names, by name; NULL: not looked at yet
} Document;

Document *document_new(const char *uri, Str text, int64_t version);
void document_free(Document *document);
void document_set_text(Document *document, Str text);
// Applies one change of textDocument/didChange.
void document_change(Document *document, const Json *change, bool utf8);
// Reads tokens and names, if they are of an older text.
void document_read(Document *document, PetriSession *session);
void document_clear_diagnostics(Document *document);

// Places. Those beyond the text are at its end.
size_t document_offset(const Document *document, const Json *position, bool utf8);
size_t document_offset_at(const Document *document, uint32_t line, uint32_t column); // from 1, as petri counts
Json *document_range(const Document *document, size_t start, size_t end, bool utf8);
void document_position(const Document *document, size_t offset, bool utf8, size_t *line, size_t *character);
Str document_slice(const Document *document, size_t start, size_t end);
Str document_token(const Document *document, size_t token);
bool document_is(const Document *document, size_t token, const char *text);
bool document_begins(const Document *document, size_t token); // a statement
size_t document_level(const Document *document, size_t token);
// The first token that ends behind the offset; token_count if none does.
size_t document_token_at(const Document *document, size_t offset);
// The name that stands at an offset, or NULL; and the one that binds it, or NULL.
const PetriBinding *document_name_at(const Document *document, size_t offset);
const PetriBinding *document_binding(const Document *document, const PetriBinding *name);

// The import or include whose file is named at an offset; NULL: none is.
const Link *document_link(const Document *document, size_t offset);

// What the name that a token is stands for: its binding, or, in a statement that does not parse, the one that is
// visible there; NULL if it is not the text's.
const PetriBinding *document_resolve(const Document *document, size_t token);

// file:///a%20b to /a b; NULL if it is no file. To be freed, as what the other gives.
char *uri_path(const char *uri);
char *uri_of(const char *path);
// The file's one name; the path itself if there is none. To be freed.
char *path_canonical(const char *path);

#endif
