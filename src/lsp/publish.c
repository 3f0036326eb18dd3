// publish.c: sending the diagnostics of documents to the editor.
//
// A check may also report diagnostics of included files. Each document stores the diagnostics of its last check,
// grouped by file. For each file, the editor receives the diagnostics that all documents together store for that file.
#include "lsp/server.h"

#include <stdlib.h>
#include <string.h>

static Json *diagnostic_json(const Server *server, const Document *document, const PetriDiagnostic *diagnostic,
                             size_t start, size_t end) {
    SCOPED_TEXT text = {0};
    text_add_format(&text, "%s%s%s", diagnostic->text, diagnostic->hint[0] != '\0' ? "\n" : "", diagnostic->hint);
    Json *json = json_put(json_object_new_object(), "range", document_range(document, start, end, server->utf8));
    json_put_number(json, "severity", diagnostic->level + 1);
    json_put_text(json_put_text(json, "source", "petri"), "message", text.bytes);
    if (diagnostic->code) {
        json_put_text(json, "code", diagnostic->code);
        if (strcmp(diagnostic->code, "unused-name") == 0) { // tag 1 (unnecessary): editors grey out the name
            Json *tags = json_object_new_array();
            json_object_array_add(tags, json_object_new_int(1));
            json_put(json, "tags", tags);
        }
    }
    return json;
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

static Json *list_for(Json *found, const char *uri) {
    Json *list = json_get(found, uri);
    if (!list)
        json_put(found, uri, list = json_object_new_array());
    return list;
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
    json_object_array_add(list_for(server->found, other->uri), diagnostic_json(server, other, diagnostic, start, end));
    if (own)
        store_diagnostic(document, diagnostic, start, end);
    if (read)
        document_free(other);
}

static bool contains_item(const Json *list, Json *item) {
    for (size_t i = 0; i < json_object_array_length(list); i++)
        if (json_object_equal(json_object_array_get_idx(list, i), item))
            return true;
    return false;
}

// Sends the diagnostics of a file, collected from all documents.
static void publish_file(Server *server, const char *uri) {
    Json *all = json_object_new_array();
    for (size_t i = 0; i < server->document_count; i++) {
        Json *list = json_get(server->documents[i]->published, uri);
        for (size_t k = 0; list && k < json_object_array_length(list); k++) {
            Json *item = json_object_array_get_idx(list, k);
            if (!contains_item(all, item))
                json_object_array_add(all, json_object_get(item));
        }
    }
    Json *params = json_put(json_put_text(json_object_new_object(), "uri", uri), "diagnostics", all);
    const Document *document = server_document(server, uri);
    if (document)
        json_put_number(params, "version", document->version);
    rpc_notify("textDocument/publishDiagnostics", params);
}

// Publishes each file that occurs in a document's new diagnostics (`now`) or old diagnostics (`before`). Frees
// `before`.
static void publish_changes(Server *server, const Json *now, Json *before) {
    json_object_object_foreach((Json *)now, uri, list) {
        (void)list;
        publish_file(server, uri);
    }
    json_object_object_foreach(before, old_uri, old_list) {
        (void)old_list;
        if (!json_get(now, old_uri))
            publish_file(server, old_uri);
    }
    json_object_put(before);
}

// Checks a document and stores its diagnostics in server->found and in the document.
static PetriStatus check_document(Server *server, Document *document, PetriSession *session) {
    document->diagnostics = (DiagnosticList){.count = 0};
    texts_free(&document->used);
    document->used = (TextList){0};
    server->checking = true;
    server->checked = document;
    server->found = json_object_new_object();
    list_for(server->found, document->uri);
    PetriStatus status =
        !session ? PETRI_OK : petri_check_text(session, document->path, document->text.bytes, document->text.len);
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
        json_object_put(server->found);
        return;
    }
    diagnostic_list_free(&last);
    document->unchecked = false;
    Json *before = document->published;
    document->published = server->found;
    publish_changes(server, document->published, before);
}

void diagnostics_withdraw(Server *server, Document *document) {
    Json *before = document->published, *nothing = json_object_new_object();
    document->published = NULL;
    publish_changes(server, nothing, before);
    document->published = nothing;
}
