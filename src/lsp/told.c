// told.c: what petri check has to say of documents, to the editor.
//
// A check may tell of files that the script includes, too. Each document remembers what was told of which file, and an
// editor hears for each file all that is known of it.
#include <stdlib.h>
#include <string.h>

#include "lsp/server.h"

static Json *as_json(const Server *server, const Document *document, const PetriDiagnostic *diagnostic, size_t start,
                     size_t end) {
    SCOPED_BYTES text = {0};
    bytes_format(&text, "%s%s%s", diagnostic->text, diagnostic->hint[0] != '\0' ? "\n" : "", diagnostic->hint);
    Json *json = json_put(json_object_new_object(), "range", document_range(document, start, end, server->utf8));
    json_put_number(json, "severity", diagnostic->level + 1);
    json_put_text(json_put_text(json, "source", "petri"), "message", text.data);
    if (diagnostic->code != NULL) {
        json_put_text(json, "code", diagnostic->code);
        if (strcmp(diagnostic->code, "unused-name") == 0) { // editors grey it out
            Json *tags = json_object_new_array();
            json_object_array_add(tags, json_object_new_int(1));
            json_put(json, "tags", tags);
        }
    }
    return json;
}

static void keep(Document *document, const PetriDiagnostic *diagnostic, size_t start, size_t end) {
    document->told = memory_resized(document->told, (document->told_count + 1) * sizeof *document->told);
    document->told[document->told_count++] = (Told){
        .level = diagnostic->level,
        .start = start,
        .end = end,
        .text = memory_text(diagnostic->text),
        .hint = memory_text(diagnostic->hint),
        .code = diagnostic->code == NULL ? NULL : memory_text(diagnostic->code),
    };
}

static Json *list_of(Json *found, const char *uri) {
    Json *list = json_get(found, uri);
    if (list == NULL) {
        json_put(found, uri, list = json_object_new_array());
    }
    return list;
}

void told_take(void *host, const PetriDiagnostic *diagnostic) {
    Server *server = host;
    Document *document = server->checked;
    if (!server->checking) {
        return;
    }
    bool own = diagnostic->file == NULL || strcmp(diagnostic->file, document->path) == 0, read = false;
    Document *other = own ? document : server_file(server, diagnostic->file, &read);
    if (other == NULL) {
        return;
    }
    size_t start = document_offset_at(other, diagnostic->line, diagnostic->column);
    size_t end = document_offset_at(other, diagnostic->end_line, diagnostic->end_column);
    end = end > start ? end : start;
    json_object_array_add(list_of(server->found, other->uri), as_json(server, other, diagnostic, start, end));
    if (own) {
        keep(document, diagnostic, start, end);
    }
    if (read) {
        document_free(other);
    }
}

static bool has(const Json *list, Json *item) {
    for (size_t i = 0; i < json_object_array_length(list); i++) {
        if (json_object_equal(json_object_array_get_idx(list, i), item)) {
            return true;
        }
    }
    return false;
}

// All that documents have to say of a file.
static void publish(Server *server, const char *uri) {
    Json *all = json_object_new_array();
    for (size_t i = 0; i < server->document_count; i++) {
        Json *list = json_get(server->documents[i]->published, uri);
        for (size_t k = 0; list != NULL && k < json_object_array_length(list); k++) {
            Json *item = json_object_array_get_idx(list, k);
            if (!has(all, item)) {
                json_object_array_add(all, json_object_get(item));
            }
        }
    }
    Json *params = json_put(json_put_text(json_object_new_object(), "uri", uri), "diagnostics", all);
    const Document *document = server_document(server, uri);
    if (document != NULL) {
        json_put_number(params, "version", document->version);
    }
    rpc_notify("textDocument/publishDiagnostics", params);
}

// The document says something else now; `before` is what it said, which is freed.
static void publish_changes(Server *server, const Json *now, Json *before) {
    json_object_object_foreach((Json *)now, uri, list) {
        (void)list;
        publish(server, uri);
    }
    json_object_object_foreach(before, old_uri, old_list) {
        (void)old_list;
        if (json_get(now, old_uri) == NULL) {
            publish(server, old_uri);
        }
    }
    json_object_put(before);
}

void told_check(Server *server, Document *document) {
    document->unchecked = false;
    document_forget_told(document);
    texts_free(&document->used);
    document->used = (TextList){0};
    server->checking = true;
    server->checked = document;
    server->found = json_object_new_object();
    list_of(server->found, document->uri);
    if (server->session != NULL) {
        petri_check_text(server->session, document->path, document->text.data, document->text.length);
    }
    server->checking = false;
    Json *before = document->published;
    document->published = server->found;
    publish_changes(server, document->published, before);
}

void told_drop(Server *server, Document *document) {
    Json *before = document->published, *nothing = json_object_new_object();
    document->published = NULL;
    publish_changes(server, nothing, before);
    document->published = nothing;
}
