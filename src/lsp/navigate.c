// navigate.c: definitions, references and renaming.
#include "base/source.h"
#include "lsp/workspace.h"

#include <stdlib.h>
#include <string.h>

// Returns the index of the name token at the request's position, or SIZE_MAX if there is none.
static size_t token_of(const RequestContext *request) {
    const Document *document = request->document;
    size_t token = document_token_at(document, request->offset);
    bool touches = token > 0 && document->tokens[token - 1].end == request->offset &&
                   document->tokens[token - 1].kind == PETRI_TOKEN_NAME; // the cursor is at the end of the name
    token -= touches ? 1 : 0;
    return token < document->token_count && document->tokens[token].kind == PETRI_TOKEN_NAME ? token : SIZE_MAX;
}

static BindingSet bindings_at(const RequestContext *request, const Workspace *workspace) {
    size_t token = token_of(request);
    return token == SIZE_MAX ? (BindingSet){.count = 0} : workspace_resolve(workspace, token);
}

static void put_location(JsonWriter *json, const Server *server, const Document *document, size_t start, size_t end) {
    json_open(json, NULL, "{");
    json_put_text(json, "uri", document->uri);
    document_put_range(json, "range", document, start, end, server->utf8);
    json_close(json, "}");
}

// If the position is in the file name of an import or include, adds the location of the start of that file.
static void put_file_location(JsonWriter *json, const RequestContext *request) {
    const Link *link = document_link(request->document, request->offset);
    bool own = false;
    Document *file = !link ? NULL : server_file(request->server, link->path, request->document, &own);
    if (file)
        put_location(json, request->server, file, 0, 0);
    if (own)
        document_free(file);
}

// Adds the location of the definition, or a list of locations if several scripts that include this script bind the
// name. Returns false if there is no definition.
static bool put_definitions(JsonWriter *json, const RequestContext *request, bool whole) {
    Workspace workspace;
    workspace_open(&workspace, request->server, request->document, whole);
    BindingSet meant = bindings_at(request, &workspace);
    if (meant.count > 1)
        json_open(json, NULL, "[");
    for (size_t i = 0; i < meant.count; i++) {
        const PetriBinding *name = workspace_name(&workspace, meant.items[i]);
        put_location(json, request->server, workspace.documents[meant.items[i].file], name->start, name->end);
    }
    if (meant.count > 1)
        json_close(json, "]");
    workspace_close(&workspace);
    return meant.count > 0;
}

void answer_definition(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    if (!put_definitions(result, request, false) &&
        (token_of(request) == SIZE_MAX || !put_definitions(result, request, true)))
        put_file_location(result, request);
}

// --- links

void answer_links(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const Document *document = request->document;
    json_open(result, NULL, "[");
    for (size_t i = 0; i < document->link_count; i++) {
        const Link *link = &document->links[i];
        const PetriToken *token = &document->tokens[link->token];
        bool own = false;
        Document *file = server_file(request->server, link->path, document, &own);
        if (file) {
            json_open(result, NULL, "{");
            document_put_range(result, "range", document, token->start, token->end, request->server->utf8);
            json_put_text(result, "target", file->uri);
            json_close(result, "}");
        }
        if (own)
            document_free(file);
    }
    json_close(result, "]");
}

// --- references

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
    uses->items = memory_realloc(uses->items, (uses->count + 1) * sizeof *uses->items);
    uses->items[uses->count++] = use;
}

static int compare_uses(const void *a, const void *b) {
    const Use *one = a, *other = b;
    return one->file != other->file ? (one->file < other->file ? -1 : 1)
                                    : (one->start > other->start) - (one->start < other->start);
}

static bool is_named(const Document *document, size_t number, Str text) {
    const PetriBinding *name = &document->names[number];
    return str_equal(document_slice(document, name->start, name->end), text);
}

// A name in an included file can refer to one binding in each script that includes the file. Adds all these bindings to
// `meant`, because they must be renamed together.
static void merge_includer_bindings(const Workspace *workspace, BindingSet *meant, Str text) {
    for (bool more = meant->count > 0; more;) {
        more = false;
        for (size_t file = 0; file < workspace->count; file++) {
            for (size_t i = 0; i < workspace->documents[file]->name_count; i++) {
                if (is_named(workspace->documents[file], i, text)) {
                    BindingSet senses = workspace_bindings(workspace, file, i);
                    more = (binding_sets_overlap(&senses, meant) && binding_set_add(meant, &senses)) || more;
                }
            }
        }
    }
}

// Returns the function that a parameter belongs to, or NULL.
static const PetriBinding *function_of(const Document *document, const PetriBinding *parameter) {
    const PetriBinding *found = NULL;
    for (const PetriBinding *name = document->names; name < parameter; name++) {
        bool around =
            name->kind == PETRI_NAME_FUNC && name->value_start < parameter->start && parameter->end <= name->value_end;
        found = around ? name : found;
    }
    return parameter->kind == PETRI_NAME_PARAMETER ? found : NULL;
}

// Adds the arguments called `text` in one call, `f(NAME=…)` or `@f NAME=…`. `token` is the name of the function in the
// call. The call is in another file than the function.
static void add_arguments(Uses *uses, const Workspace *workspace, size_t file, size_t token, Str text) {
    const Document *document = workspace->documents[file];
    bool template = token > 0 && document_is(document, token - 1, "@");
    size_t depth = 0;
    for (size_t i = token + 1; i < document->token_count && (depth > 0 || !document_begins(document, i)); i++) {
        depth += document_is(document, i, "(") || document_is(document, i, "[");
        bool level = depth == (template ? 0U : 1U);
        if (level && str_equal(document_token(document, i), text) && document_is(document, i + 1, "="))
            add_use(uses, (Use){file, document->tokens[i].start, document->tokens[i].end, false});
        depth -= depth > 0 && (document_is(document, i, ")") || document_is(document, i, "]"));
        if (depth == 0 && (!template || document_is(document, i, ">>") || document_is(document, i, "<<")))
            break;
    }
}

static void find_arguments(Uses *uses, const Workspace *workspace, BindingRef parameter, Str text) {
    const Document *owner = workspace->documents[parameter.file];
    const PetriBinding *function = function_of(owner, workspace_name(workspace, parameter));
    if (!function)
        return;
    BindingSet called = {.items = {{parameter.file, (size_t)(function - owner->names)}}, .count = 1};
    Str name = document_slice(owner, function->start, function->end);
    for (size_t file = 0; file < workspace->count; file++) {
        const Document *document = workspace->documents[file];
        for (size_t i = 0; file != parameter.file && i < document->name_count; i++) {
            if (document->names[i].kind != PETRI_NAME_USE || !is_named(document, i, name))
                continue;
            BindingSet senses = workspace_bindings(workspace, file, i);
            if (binding_sets_overlap(&senses, &called))
                add_arguments(uses, workspace, file, document_token_at(document, document->names[i].start), text);
        }
    }
}

// Returns all names with the same binding as the name at the position, sorted by file and offset. The caller frees
// `items`.
static Uses uses_of(const RequestContext *request, const Workspace *workspace) {
    Uses uses = {0};
    BindingSet meant = bindings_at(request, workspace);
    if (meant.count == 0)
        return uses;
    Str text = document_token(request->document, token_of(request));
    merge_includer_bindings(workspace, &meant, text);
    for (size_t file = 0; file < workspace->count; file++) {
        const Document *document = workspace->documents[file];
        for (size_t i = 0; i < document->name_count; i++) {
            const PetriBinding *name = &document->names[i];
            BindingSet senses =
                is_named(document, i, text) ? workspace_bindings(workspace, file, i) : (BindingSet){.count = 0};
            if (binding_sets_overlap(&senses, &meant))
                add_use(&uses, (Use){file, name->start, name->end, name->kind != PETRI_NAME_USE});
        }
    }
    for (size_t i = 0; i < meant.count; i++)
        find_arguments(&uses, workspace, meant.items[i], text);
    if (uses.count > 0)
        qsort(uses.items, uses.count, sizeof *uses.items, compare_uses);
    return uses;
}

void answer_references(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    bool declares = json_is(json_path(request->params, "context.includeDeclaration"), JSON_TRUE);
    json_open(result, NULL, "[");
    Workspace workspace;
    workspace_open(&workspace, request->server, request->document, true);
    Uses uses = uses_of(request, &workspace);
    for (size_t i = 0; i < uses.count; i++) {
        const Use *use = &uses.items[i];
        if (declares || !use->binds)
            put_location(result, request->server, workspace.documents[use->file], use->start, use->end);
    }
    free(uses.items);
    workspace_close(&workspace);
    json_close(result, "]");
}

void answer_highlight(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    json_open(result, NULL, "[");
    Workspace workspace;
    workspace_open(&workspace, request->server, request->document, false);
    Uses uses = uses_of(request, &workspace);
    for (size_t i = 0; i < uses.count && uses.items[i].file == 0; i++) {
        const Use *use = &uses.items[i];
        json_open(result, NULL, "{");
        document_put_range(result, "range", request->document, use->start, use->end, request->server->utf8);
        json_put_integer(result, "kind", use->binds ? 3 : 2);
        json_close(result, "}");
    }
    free(uses.items);
    workspace_close(&workspace);
    json_close(result, "]");
}

// --- renaming

// Returns the name at the position if it can be renamed. Otherwise sets *problem and returns NULL.
static const PetriBinding *rename_target(const RequestContext *request, const Workspace *workspace,
                                         const char **problem) {
    const PetriBinding *at = document_name_at(request->document, request->offset);
    if (bindings_at(request, workspace).count == 0)
        *problem = "cannot rename: the script does not bind this name";
    else if (!at)
        *problem = "cannot rename: the statement has an error";
    return !*problem ? at : NULL;
}

void answer_prepare_rename(const RequestContext *request, JsonWriter *result, const char **problem) {
    Workspace workspace;
    workspace_open(&workspace, request->server, request->document, true);
    const PetriBinding *at = rename_target(request, &workspace, problem);
    if (at)
        document_put_range(result, NULL, request->document, at->start, at->end, request->server->utf8);
    workspace_close(&workspace);
}

static bool is_name(Server *server, const char *text) {
    Document *document = document_new("name", str_from(text), 0);
    server_read(server, document);
    bool good = document->token_count == 1 && document->tokens[0].kind == PETRI_TOKEN_NAME &&
                document->tokens[0].start == 0 && document->tokens[0].end == strlen(text);
    document_free(document);
    return good;
}

// Returns an array with the bindings of every name in all files, in the order of the names. Sets *count to the number
// of names. The caller frees the array with free.
static BindingSet *all_bindings(const Workspace *workspace, size_t *count) {
    *count = 0;
    for (size_t file = 0; file < workspace->count; file++)
        *count += workspace->documents[file]->name_count;
    BindingSet *all = memory_calloc((*count + 1) * sizeof *all), *next = all;
    for (size_t file = 0; file < workspace->count; file++)
        for (size_t i = 0; i < workspace->documents[file]->name_count; i++)
            *next++ = workspace_bindings(workspace, file, i);
    return all;
}

static bool binding_sets_equal(const BindingSet *a, const BindingSet *b) {
    BindingSet both = *a;
    return a->count == b->count && !binding_set_add(&both, b);
}

// Adds the edits that rename the uses in one file, and appends the new text of the file to `text`. `uses` are sorted by
// offset.
static void put_edits(JsonWriter *json, bool utf8, const Document *document, const Use *uses, size_t count,
                      const char *wanted, Text *text) {
    json_open(json, document->uri, "[");
    size_t done = 0;
    for (size_t i = 0; i < count; i++) {
        json_open(json, NULL, "{");
        document_put_range(json, "range", document, uses[i].start, uses[i].end, utf8);
        json_put_text(json, "newText", wanted);
        json_close(json, "}");
        text_add(text, (Str){document->text.bytes + done, uses[i].start - done});
        text_add_c(text, wanted);
        done = uses[i].end;
    }
    text_add(text, (Str){document->text.bytes + done, document->text.len - done});
    json_close(json, "]");
}

// Adds the edits that rename the uses, and applies them to the workspace's own copies of the documents. Sets *problem
// if any name would refer to a different binding after renaming.
static void rename_uses(JsonWriter *json, bool utf8, Workspace *workspace, const Uses *uses, const char *wanted,
                        const char **problem) {
    size_t count, renamed;
    BindingSet *before = all_bindings(workspace, &count);
    json_open(json, NULL, "{");
    json_open(json, "changes", "{");
    for (size_t i = 0, next; i < uses->count; i = next) {
        size_t file = uses->items[i].file;
        for (next = i + 1; next < uses->count && uses->items[next].file == file;)
            next++;
        const Document *document = workspace->documents[file];
        SCOPED_TEXT text = {0};
        put_edits(json, utf8, document, uses->items + i, next - i, wanted, &text);
        workspace_replace(workspace, file, &text);
    }
    BindingSet *after = all_bindings(workspace, &renamed);
    bool same = count == renamed;
    for (size_t i = 0; same && i < count; i++)
        same = binding_sets_equal(&before[i], &after[i]);
    *problem = same ? NULL : "the name is in use: renaming would change the script's meaning";
    free(before);
    free(after);
    json_close(json, "}}");
}

void answer_rename(const RequestContext *request, JsonWriter *result, const char **problem) {
    const char *wanted = json_text(request->params, "newName");
    Workspace workspace;
    workspace_open(&workspace, request->server, request->document, true);
    if (rename_target(request, &workspace, problem) && (!wanted || !is_name(request->server, wanted)))
        *problem = "not a valid name";
    if (!*problem) {
        Uses uses = uses_of(request, &workspace);
        rename_uses(result, request->server->utf8, &workspace, &uses, wanted, problem);
        free(uses.items);
    }
    workspace_close(&workspace);
}
