// navigate.c: from a name to what it means, and to all that mean the same.
#include <stdlib.h>
#include <string.h>

#include "base/source.h"
#include "lsp/server.h"

static const PetriTextName *name_of(const Place *place) {
    const Document *document = place->document;
    size_t token = document_token_at(document, place->offset);
    bool behind = token > 0 && document->tokens[token - 1].end == place->offset &&
                  document->tokens[token - 1].kind == PETRI_TOKEN_NAME; // the cursor is behind it
    token -= behind ? 1 : 0;
    return token < document->token_count && document->tokens[token].kind == PETRI_TOKEN_NAME
               ? document_meaning(document, token)
               : NULL;
}

static Json *location(const Server *server, const Document *document, size_t start, size_t end) {
    return json_put(json_put_text(json_object_new_object(), "uri", document->uri), "range",
                    document_range(document, start, end, server->utf8));
}

// The file that a string names, if there is one: its first line.
static Json *file_location(const Place *place) {
    Document *document = place->document;
    size_t token = document_token_at(document, place->offset);
    if (token >= document->token_count || document->tokens[token].kind != PETRI_TOKEN_STRING || !document->is_file) {
        return NULL;
    }
    // As if a name were imported from it.
    PetriTextName import = {.kind = PETRI_NAME_IMPORT,
                            .value_start = document->tokens[token].start,
                            .value_end = document->tokens[token].end};
    bool read;
    Document *file = explain_module(place->server, document, &import, &read);
    Json *result = file == NULL ? NULL : location(place->server, file, 0, 0);
    if (read) {
        document_free(file);
    }
    return result;
}

Json *answer_definition(const Place *place, const char **problem) {
    (void)problem;
    const PetriTextName *name = name_of(place);
    if (name == NULL) {
        return file_location(place);
    }
    bool read;
    Document *module = explain_module(place->server, place->document, name, &read);
    const PetriTextName *meant =
        module == NULL ? NULL : explain_export(module, document_part(place->document, name->start, name->end));
    Json *result = meant != NULL ? location(place->server, module, meant->start, meant->end)
                                 : location(place->server, place->document, name->start, name->end);
    if (read) {
        document_free(module);
    }
    return result;
}

// Does the name mean what `bound` binds? The NAME in the value of a parameter, which -D gives, does.
static bool means(const Document *document, const PetriTextName *name, const PetriTextName *bound) {
    bool given =
        name->kind == PETRI_NAME_USE && name->bound == PETRI_Z && name->start == bound->value_start &&
        bound->kind == PETRI_NAME_LET &&
        str_equal(document_part(document, name->start, name->end), document_part(document, bound->start, bound->end));
    return name == bound || (name->kind == PETRI_NAME_USE && name->bound == bound->start) || given;
}

Json *answer_references(const Place *place, const char **problem) {
    (void)problem;
    const Document *document = place->document;
    const PetriTextName *bound = name_of(place);
    bool declares = json_object_get_boolean(json_path(place->params, "context.includeDeclaration"));
    Json *list = json_object_new_array();
    for (size_t i = 0; bound != NULL && i < document->name_count; i++) {
        const PetriTextName *name = &document->names[i];
        if (means(document, name, bound) && (declares || name != bound)) {
            json_object_array_add(list, location(place->server, document, name->start, name->end));
        }
    }
    return list;
}

Json *answer_highlight(const Place *place, const char **problem) {
    (void)problem;
    const Document *document = place->document;
    const PetriTextName *bound = name_of(place);
    Json *list = json_object_new_array();
    for (size_t i = 0; bound != NULL && i < document->name_count; i++) {
        const PetriTextName *name = &document->names[i];
        if (means(document, name, bound)) {
            Json *range = document_range(document, name->start, name->end, place->server->utf8);
            Json *item = json_put(json_object_new_object(), "range", range);
            json_object_array_add(list, json_put_number(item, "kind", name == bound ? 3 : 2));
        }
    }
    return list;
}

// The name at the place, of which others than `name_of` are uses; NULL with a problem if it cannot be renamed.
static const PetriTextName *to_rename(const Place *place, const char **problem) {
    const PetriTextName *name = name_of(place), *at = document_name_at(place->document, place->offset);
    if (name == NULL) {
        *problem = "only names that the script binds can be renamed";
    } else if (name->kind == PETRI_NAME_IMPORT) {
        *problem = "an imported name is renamed in its own file";
    } else if (at == NULL) {
        *problem = "there is an error in this statement";
    }
    return *problem == NULL ? at : NULL;
}

Json *answer_prepare_rename(const Place *place, const char **problem) {
    const PetriTextName *at = to_rename(place, problem);
    return at == NULL ? NULL : document_range(place->document, at->start, at->end, place->server->utf8);
}

static bool is_name(Server *server, const char *text) {
    Document *document = document_new("name", str_from(text), 0);
    server_read(server, document);
    bool good = document->token_count == 1 && document->tokens[0].kind == PETRI_TOKEN_NAME &&
                document->tokens[0].start == 0 && document->tokens[0].end == strlen(text);
    document_free(document);
    return good;
}

// The number of the name that binds another, or SIZE_MAX.
static size_t bound_number(const Document *document, size_t name) {
    const PetriTextName *bound = document_binding(document, &document->names[name]);
    return bound == NULL ? SIZE_MAX : (size_t)(bound - document->names);
}

// Do the names of both texts hang together in the same way?
static bool same_names(Server *server, const Document *before, const Bytes *text) {
    Document *after = document_new("renamed", (Str){text->data, text->length}, 0);
    server_read(server, after);
    bool same = before->name_count == after->name_count && before->token_count == after->token_count;
    for (size_t i = 0; same && i < before->name_count; i++) {
        same = before->names[i].kind == after->names[i].kind && bound_number(before, i) == bound_number(after, i);
    }
    document_free(after);
    return same;
}

Json *answer_rename(const Place *place, const char **problem) {
    Document *document = place->document;
    const PetriTextName *at = to_rename(place, problem), *bound = name_of(place);
    const char *wanted = json_text(place->params, "newName");
    if (at != NULL && (wanted == NULL || !is_name(place->server, wanted))) {
        *problem = "this is no name";
    }
    if (*problem != NULL) {
        return NULL;
    }
    Json *edits = json_object_new_array();
    SCOPED_BYTES text = {0};
    size_t done = 0;
    for (size_t i = 0; i < document->name_count; i++) { // they are in the order of the text
        const PetriTextName *name = &document->names[i];
        if (means(document, name, bound)) {
            Json *range = document_range(document, name->start, name->end, place->server->utf8);
            Json *edit = json_put(json_object_new_object(), "range", range);
            json_object_array_add(edits, json_put_text(edit, "newText", wanted));
            bytes_add(&text, document->text.data + done, name->start - done);
            bytes_add_text(&text, wanted);
            done = name->end;
        }
    }
    bytes_add(&text, document->text.data + done, document->text.length - done);
    if (!same_names(place->server, document, &text)) {
        *problem = "the name is taken: the script would mean something else";
    }
    Json *changes = json_put(json_object_new_object(), document->uri, edits);
    return json_put(json_object_new_object(), "changes", changes);
}
