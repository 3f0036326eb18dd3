// navigate.c: from a name to what it means, and to all that mean the same.
#include <stdlib.h>
#include <string.h>

#include "base/source.h"
#include "lsp/workspace.h"

// The token of a name at the place, or SIZE_MAX.
static size_t token_of(const Place *place) {
    const Document *document = place->document;
    size_t token = document_token_at(document, place->offset);
    bool behind = token > 0 && document->tokens[token - 1].end == place->offset &&
                  document->tokens[token - 1].kind == PETRI_TOKEN_NAME; // the cursor is behind it
    token -= behind ? 1 : 0;
    return token < document->token_count && document->tokens[token].kind == PETRI_TOKEN_NAME ? token : SIZE_MAX;
}

static Senses senses_of(const Place *place, const Workspace *workspace) {
    size_t token = token_of(place);
    return token == SIZE_MAX ? (Senses){.count = 0} : workspace_meaning(workspace, token);
}

static Json *location(const Server *server, const Document *document, size_t start, size_t end) {
    return json_put(json_put_text(json_object_new_object(), "uri", document->uri), "range",
                    document_range(document, start, end, server->utf8));
}

// The file that a string names, if there is one: its first line.
static Json *file_location(const Place *place) {
    const Link *link = document_link(place->document, place->offset);
    bool own = false;
    Document *file = link == NULL ? NULL : server_file(place->server, link->path, &own);
    Json *result = file == NULL ? NULL : location(place->server, file, 0, 0);
    if (own) {
        document_free(file);
    }
    return result;
}

// A place, or several if scripts that include this one bind the name each.
static Json *definitions(const Place *place, bool whole) {
    Workspace workspace;
    workspace_open(&workspace, place->server, place->document, whole);
    Senses meant = senses_of(place, &workspace);
    Json *list = json_object_new_array(), *one = NULL;
    for (size_t i = 0; i < meant.count; i++) {
        const PetriTextName *name = workspace_name(&workspace, meant.items[i]);
        one = location(place->server, workspace.documents[meant.items[i].file], name->start, name->end);
        json_object_array_add(list, meant.count > 1 ? one : json_object_get(one));
    }
    workspace_close(&workspace);
    if (meant.count > 1) {
        return list;
    }
    json_object_put(list);
    return one;
}

Json *answer_definition(const Place *place, const char **problem) {
    (void)problem;
    Json *result = definitions(place, false);
    if (result == NULL && token_of(place) != SIZE_MAX) {
        result = definitions(place, true);
    }
    return result == NULL ? file_location(place) : result;
}

// --- all that mean the same

typedef struct Use {
    size_t file;
    size_t start;
    size_t end;
    bool binds;
} Use;

typedef struct Uses {
    Use *items;
    size_t count;
} Uses;

static void add_use(Uses *uses, Use use) {
    uses->items = memory_resized(uses->items, (uses->count + 1) * sizeof *uses->items);
    uses->items[uses->count++] = use;
}

static int by_place(const void *a, const void *b) {
    const Use *one = a, *other = b;
    return one->file != other->file ? (one->file < other->file ? -1 : 1)
                                    : (one->start > other->start) - (one->start < other->start);
}

static bool is_named(const Document *document, size_t number, Str text) {
    const PetriTextName *name = &document->names[number];
    return str_equal(document_part(document, name->start, name->end), text);
}

// What a file that is included more than once takes from the one includer, it takes from the other: both must go by one
// name.
static void widen(const Workspace *workspace, Senses *meant, Str text) {
    for (bool more = meant->count > 0; more;) {
        more = false;
        for (size_t file = 0; file < workspace->count; file++) {
            for (size_t i = 0; i < workspace->documents[file]->name_count; i++) {
                if (is_named(workspace->documents[file], i, text)) {
                    Senses senses = workspace_senses(workspace, file, i);
                    more = (senses_meet(&senses, meant) && senses_add(meant, &senses)) || more;
                }
            }
        }
    }
}

// The function whose parameter a name is, or NULL.
static const PetriTextName *function_of(const Document *document, const PetriTextName *parameter) {
    const PetriTextName *found = NULL;
    for (const PetriTextName *name = document->names; name < parameter; name++) {
        bool around =
            name->kind == PETRI_NAME_FUNC && name->value_start < parameter->start && parameter->end <= name->value_end;
        found = around ? name : found;
    }
    return parameter->kind == PETRI_NAME_PARAMETER ? found : NULL;
}

// In other files arguments are named as the parameter is: `f(NAME=…)`, `@f NAME=…`.
static void add_arguments(Uses *uses, const Workspace *workspace, size_t file, size_t token, Str text) {
    const Document *document = workspace->documents[file];
    bool template = token > 0 && document_is(document, token - 1, "@");
    size_t depth = 0;
    for (size_t i = token + 1; i < document->token_count && (depth > 0 || !document_begins(document, i)); i++) {
        depth += document_is(document, i, "(") || document_is(document, i, "[");
        bool level = depth == (template ? 0U : 1U);
        if (level && str_equal(document_token(document, i), text) && document_is(document, i + 1, "=")) {
            add_use(uses, (Use){file, document->tokens[i].start, document->tokens[i].end, false});
        }
        depth -= depth > 0 && (document_is(document, i, ")") || document_is(document, i, "]"));
        if (depth == 0 && (!template || document_is(document, i, ">>") || document_is(document, i, "<<"))) {
            break;
        }
    }
}

static void find_arguments(Uses *uses, const Workspace *workspace, Sense parameter, Str text) {
    const Document *owner = workspace->documents[parameter.file];
    const PetriTextName *function = function_of(owner, workspace_name(workspace, parameter));
    if (function == NULL) {
        return;
    }
    Senses called = {.items = {{parameter.file, (size_t)(function - owner->names)}}, .count = 1};
    Str name = document_part(owner, function->start, function->end);
    for (size_t file = 0; file < workspace->count; file++) {
        const Document *document = workspace->documents[file];
        for (size_t i = 0; file != parameter.file && i < document->name_count; i++) {
            if (document->names[i].kind != PETRI_NAME_USE || !is_named(document, i, name)) {
                continue;
            }
            Senses senses = workspace_senses(workspace, file, i);
            if (senses_meet(&senses, &called)) {
                add_arguments(uses, workspace, file, document_token_at(document, document->names[i].start), text);
            }
        }
    }
}

// All names that mean what the one at the place means, by file and place; to be freed.
static Uses uses_of(const Place *place, const Workspace *workspace) {
    Uses uses = {0};
    Senses meant = senses_of(place, workspace);
    if (meant.count == 0) {
        return uses;
    }
    Str text = document_token(place->document, token_of(place));
    widen(workspace, &meant, text);
    for (size_t file = 0; file < workspace->count; file++) {
        const Document *document = workspace->documents[file];
        for (size_t i = 0; i < document->name_count; i++) {
            const PetriTextName *name = &document->names[i];
            Senses senses = is_named(document, i, text) ? workspace_senses(workspace, file, i) : (Senses){.count = 0};
            if (senses_meet(&senses, &meant)) {
                add_use(&uses, (Use){file, name->start, name->end, name->kind != PETRI_NAME_USE});
            }
        }
    }
    for (size_t i = 0; i < meant.count; i++) {
        find_arguments(&uses, workspace, meant.items[i], text);
    }
    if (uses.count > 0) {
        qsort(uses.items, uses.count, sizeof *uses.items, by_place);
    }
    return uses;
}

Json *answer_references(const Place *place, const char **problem) {
    (void)problem;
    bool declares = json_object_get_boolean(json_path(place->params, "context.includeDeclaration"));
    Json *list = json_object_new_array();
    Workspace workspace;
    workspace_open(&workspace, place->server, place->document, true);
    Uses uses = uses_of(place, &workspace);
    for (size_t i = 0; i < uses.count; i++) {
        const Use *use = &uses.items[i];
        if (declares || !use->binds) {
            json_object_array_add(list, location(place->server, workspace.documents[use->file], use->start, use->end));
        }
    }
    free(uses.items);
    workspace_close(&workspace);
    return list;
}

Json *answer_highlight(const Place *place, const char **problem) {
    (void)problem;
    Json *list = json_object_new_array();
    Workspace workspace;
    workspace_open(&workspace, place->server, place->document, false);
    Uses uses = uses_of(place, &workspace);
    for (size_t i = 0; i < uses.count && uses.items[i].file == 0; i++) {
        const Use *use = &uses.items[i];
        Json *range = document_range(place->document, use->start, use->end, place->server->utf8);
        Json *item = json_put(json_object_new_object(), "range", range);
        json_object_array_add(list, json_put_number(item, "kind", use->binds ? 3 : 2));
    }
    free(uses.items);
    workspace_close(&workspace);
    return list;
}

// --- renaming

// The name that can be renamed at the place; NULL with a problem if there is none.
static const PetriTextName *to_rename(const Place *place, const Workspace *workspace, const char **problem) {
    const PetriTextName *at = document_name_at(place->document, place->offset);
    if (senses_of(place, workspace).count == 0) {
        *problem = "only names that the script binds can be renamed";
    } else if (at == NULL) {
        *problem = "there is an error in this statement";
    }
    return *problem == NULL ? at : NULL;
}

Json *answer_prepare_rename(const Place *place, const char **problem) {
    Workspace workspace;
    workspace_open(&workspace, place->server, place->document, true);
    const PetriTextName *at = to_rename(place, &workspace, problem);
    Json *range = at == NULL ? NULL : document_range(place->document, at->start, at->end, place->server->utf8);
    workspace_close(&workspace);
    return range;
}

static bool is_name(Server *server, const char *text) {
    Document *document = document_new("name", str_from(text), 0);
    server_read(server, document);
    bool good = document->token_count == 1 && document->tokens[0].kind == PETRI_TOKEN_NAME &&
                document->tokens[0].start == 0 && document->tokens[0].end == strlen(text);
    document_free(document);
    return good;
}

// What each name of all files means, one after the other; to be freed.
static Senses *all_senses(const Workspace *workspace, size_t *count) {
    *count = 0;
    for (size_t file = 0; file < workspace->count; file++) {
        *count += workspace->documents[file]->name_count;
    }
    Senses *all = memory_zeroed((*count + 1) * sizeof *all), *next = all;
    for (size_t file = 0; file < workspace->count; file++) {
        for (size_t i = 0; i < workspace->documents[file]->name_count; i++) {
            *next++ = workspace_senses(workspace, file, i);
        }
    }
    return all;
}

static bool same_senses(const Senses *a, const Senses *b) {
    Senses both = *a;
    return a->count == b->count && !senses_add(&both, b);
}

// The edits of one file, of uses that follow each other, and its new text.
static Json *edits_of(const Place *place, const Document *document, const Use *uses, size_t count, const char *wanted,
                      Bytes *text) {
    Json *edits = json_object_new_array();
    size_t done = 0;
    for (size_t i = 0; i < count; i++) {
        Json *range = document_range(document, uses[i].start, uses[i].end, place->server->utf8);
        Json *edit = json_put(json_object_new_object(), "range", range);
        json_object_array_add(edits, json_put_text(edit, "newText", wanted));
        bytes_add(text, document->text.data + done, uses[i].start - done);
        bytes_add_text(text, wanted);
        done = uses[i].end;
    }
    bytes_add(text, document->text.data + done, document->text.length - done);
    return edits;
}

// Renames in all files, in the workspace too, in which names must hang together as they did.
static Json *rename_uses(const Place *place, Workspace *workspace, const Uses *uses, const char *wanted,
                         const char **problem) {
    size_t count, renamed;
    Senses *before = all_senses(workspace, &count);
    Json *changes = json_object_new_object();
    for (size_t i = 0, next; i < uses->count; i = next) {
        size_t file = uses->items[i].file;
        for (next = i + 1; next < uses->count && uses->items[next].file == file;) {
            next++;
        }
        const Document *document = workspace->documents[file];
        SCOPED_BYTES text = {0};
        json_put(changes, document->uri, edits_of(place, document, uses->items + i, next - i, wanted, &text));
        workspace_replace(workspace, file, &text);
    }
    Senses *after = all_senses(workspace, &renamed);
    bool same = count == renamed;
    for (size_t i = 0; same && i < count; i++) {
        same = same_senses(&before[i], &after[i]);
    }
    *problem = same ? NULL : "the name is taken: the script would mean something else";
    free(before);
    free(after);
    return json_put(json_object_new_object(), "changes", changes);
}

Json *answer_rename(const Place *place, const char **problem) {
    const char *wanted = json_text(place->params, "newName");
    Json *result = NULL;
    Workspace workspace;
    workspace_open(&workspace, place->server, place->document, true);
    if (to_rename(place, &workspace, problem) != NULL && (wanted == NULL || !is_name(place->server, wanted))) {
        *problem = "this is no name";
    }
    if (*problem == NULL) {
        Uses uses = uses_of(place, &workspace);
        result = rename_uses(place, &workspace, &uses, wanted, problem);
        free(uses.items);
    }
    workspace_close(&workspace);
    return result;
}
