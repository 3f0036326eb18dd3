// publish.c: sending the diagnostics of documents to the editor.
//
// A check may also report diagnostics of included files. Each document stores the diagnostics of its last check,
// grouped by file. For each file, the editor receives the diagnostics that all documents together store for that file.
#include "lsp/server.h"

#include <stdlib.h>
#include <string.h>

static void put_diagnostic(Text *out, const Server *server, const Document *document, const PetriDiagnostic *diagnostic,
                           size_t start, size_t end) {
    SCOPED_TEXT text = {0};
    text_add_format(&text, "%s%s%s", diagnostic->text, diagnostic->hint[0] != '\0' ? "\n" : "", diagnostic->hint);
    JsonWriter json = rpc_writer(out);
    json_open(&json, NULL, "{");
    document_put_range(&json, "range", document, start, end, server->utf8);
    json_put_integer(&json, "severity", diagnostic->level + 1);
    JSON_PUT_TEXTS(&json, "source", "petri", "message", text.bytes);
    if (diagnostic->code)
        json_put_text(&json, "code", diagnostic->code);
    if (diagnostic->code && strcmp(diagnostic->code, "unused-name") == 0) {
        json_open(&json, "tags", "[");
        json_put_integer(&json, NULL, 1); // unnecessary: editors grey out the name
        json_close(&json, "]");
    }
    json_close(&json, "}");
}

static void store_diagnostic(Document *document, const PetriDiagnostic *diagnostic, size_t start, size_t end) {
    DiagnosticList *list = &document->diagnostics;
    list->items = memory_realloc(list->items, (list->count + 1) * sizeof *list->items);
    list->items[list->count++] = (DocumentDiagnostic){
        .level = diagnostic->level,
        .start = start,
        .end = end,
        .text = memory_strdup(diagnostic->text),
        .hint = memory_strdup(diagnostic->hint),
        .code = !diagnostic->code ? NULL : memory_strdup(diagnostic->code),
    };
}

// Returns the diagnostics of a file, or NULL.
static const TextList *find_items(const FileDiagnosticsList *list, const char *uri) {
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->items[i].uri, uri) == 0)
            return &list->items[i].items;
    return NULL;
}

// Returns the diagnostics of a file, which are added to the list if needed.
static TextList *items_for(FileDiagnosticsList *list, const char *uri) {
    if (!find_items(list, uri)) {
        list->items = memory_realloc(list->items, (list->count + 1) * sizeof *list->items);
        list->items[list->count++] = (FileDiagnostics){.uri = memory_strdup(uri)};
    }
    return (TextList *)find_items(list, uri);
}

void diagnostics_collect(void *user_data, const PetriDiagnostic *diagnostic) {
    Server *server = user_data;
    Document *document = server->checked;
    if (!server->checking)
        return;
    bool own = !diagnostic->file || strcmp(diagnostic->file, document->path) == 0, read = false;
    Document *other = own ? document : server_file(server, diagnostic->file, document, &read);
    if (!other)
        return;
    size_t start = document_offset_at(other, diagnostic->line, diagnostic->column);
    size_t end = document_offset_at(other, diagnostic->end_line, diagnostic->end_column);
    end = end > start ? end : start;
    SCOPED_TEXT item = {0};
    put_diagnostic(&item, server, other, diagnostic, start, end);
    texts_add(items_for(&server->found, other->uri), item.bytes);
    if (own)
        store_diagnostic(document, diagnostic, start, end);
    if (read)
        document_free(other);
}

// Sends the diagnostics of a file, collected from all documents.
static void publish_file(Server *server, const char *uri) {
    TextList all = {0};
    SCOPED_TEXT params = {0};
    JsonWriter json = rpc_writer(&params);
    json_open(&json, NULL, "{");
    json_put_text(&json, "uri", uri);
    json_open(&json, "diagnostics", "[");
    for (size_t i = 0; i < server->document_count; i++) {
        const TextList *items = find_items(&server->documents[i]->published, uri);
        for (size_t k = 0; items && k < items->count; k++) {
            if (texts_contain(&all, items->items[k]))
                continue;
            texts_add(&all, items->items[k]);
            json_put_written(&json, NULL, str_from(items->items[k]));
        }
    }
    json_close(&json, "]");
    const Document *document = server_document(server, uri);
    if (document)
        json_put_integer(&json, "version", document->version);
    json_close(&json, "}");
    rpc_notify("textDocument/publishDiagnostics", &params);
    texts_free(&all);
}

// Publishes each file that occurs in a document's new diagnostics (`now`) or old diagnostics (`before`). Frees
// `before`.
static void publish_changes(Server *server, const FileDiagnosticsList *now, FileDiagnosticsList *before) {
    for (size_t i = 0; i < now->count; i++)
        publish_file(server, now->items[i].uri);
    for (size_t i = 0; i < before->count; i++)
        if (!find_items(now, before->items[i].uri))
            publish_file(server, before->items[i].uri);
    file_diagnostics_free(before);
}

// Checks a document and stores its diagnostics in server->found and in the document.
static PetriStatus check_document(Server *server, Document *document, PetriSession *session) {
    document->diagnostics = (DiagnosticList){.count = 0};
    texts_free(&document->used);
    document->used = (TextList){0};
    server->checking = true;
    server->checked = document;
    server->found = (FileDiagnosticsList){0};
    items_for(&server->found, document->uri);
    PetriStatus status =
        !session ? PETRI_OK : petri_check_text(session, document->path, document->text.bytes, document->text.len);
    golden_tests_report(server, document);
    server->checking = false;
    return status;
}

void diagnostics_publish(Server *server, Document *document) {
    bool full = document->exceeded;
    DiagnosticList last = document->diagnostics;
    PetriStatus status = check_document(server, document, full ? server->session : server->quick);
    if (status == PETRI_INTERRUPTED || (status == PETRI_LIMIT_EXCEEDED && !full)) {
        // The check is incomplete, so the diagnostics of the last complete check are kept.
        diagnostic_list_free(&document->diagnostics);
        document->diagnostics = last;
        document->exceeded = true;
        file_diagnostics_free(&server->found);
        return;
    }
    diagnostic_list_free(&last);
    document->unchecked = false;
    FileDiagnosticsList before = document->published;
    document->published = server->found;
    publish_changes(server, &document->published, &before);
}

void diagnostics_withdraw(Server *server, Document *document) {
    FileDiagnosticsList before = document->published;
    document->published = (FileDiagnosticsList){0};
    publish_changes(server, &document->published, &before);
}
