// workspace.c: see workspace.h.
//
// An imported name refers to the last top-level binding of that name in the imported file. An included file is a
// separate block: names bound before the include are visible in it, but its bindings are not visible outside.
#include "lsp/workspace.h"

#include "base/file.h"
#include "base/source.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    MAX_FILES = 5000,
    MAX_FOLDERS = 12, // depth of nested folders
    MAX_LINKS = 16    // length of a chain of imports or includes
};

static size_t find_document(const Workspace *workspace, const char *path) {
    for (size_t i = 0; i < workspace->count; i++)
        if (strcmp(workspace->documents[i]->canonical, path) == 0)
            return i;
    return SIZE_MAX;
}

// `main` is the index of the script whose links led to the document; SIZE_MAX: none.
static void add_document(Workspace *workspace, Document *document, bool own, size_t main) {
    size_t count = workspace->count++;
    workspace->documents = memory_realloc(workspace->documents, workspace->count * sizeof(Document *));
    workspace->own = memory_realloc(workspace->own, workspace->count * sizeof *workspace->own);
    workspace->main = memory_realloc(workspace->main, workspace->count * sizeof *workspace->main);
    workspace->documents[count] = document;
    workspace->own[count] = own;
    workspace->main[count] = main == SIZE_MAX ? count : main;
    server_read(workspace->server, document);
}

// Adds all files that the documents import or include, directly or indirectly.
static void follow_links(Workspace *workspace) {
    for (size_t i = 0; i < workspace->count; i++) {
        for (size_t k = 0; k < workspace->documents[i]->link_count; k++) {
            const char *path = workspace->documents[i]->links[k].path;
            bool own = false;
            Document *document =
                find_document(workspace, path) == SIZE_MAX && workspace->count < MAX_FILES
                    ? server_file(workspace->server, path, workspace->documents[workspace->main[i]], &own)
                    : NULL;
            if (document)
                add_document(workspace, document, own, workspace->main[i]);
            workspace->documents[i]->links[k].target = find_document(workspace, path);
        }
    }
}

// Removes documents that no chain of links connects with the first document.
static void drop_unconnected(Workspace *workspace) {
    size_t kept = 0;
    bool *connected = memory_calloc(workspace->count);
    connected[0] = true;
    for (bool more = true; more;) {
        more = false;
        for (size_t i = 0; i < workspace->count; i++) {
            for (size_t k = 0; k < workspace->documents[i]->link_count; k++) {
                size_t target = workspace->documents[i]->links[k].target;
                if (target != SIZE_MAX && connected[i] != connected[target])
                    connected[i] = connected[target] = more = true;
            }
        }
    }
    for (size_t i = 0; i < workspace->count; i++) {
        if (connected[i]) {
            workspace->documents[kept] = workspace->documents[i];
            workspace->own[kept++] = workspace->own[i];
        } else if (workspace->own[i]) {
            document_free(workspace->documents[i]);
        }
    }
    workspace->count = kept;
    free(connected);
}

// Sets the target of each link, and the array workspace->included.
static void find_targets(Workspace *workspace) {
    free(workspace->included);
    workspace->included = memory_calloc(workspace->count);
    for (size_t i = 0; i < workspace->count; i++) {
        for (size_t k = 0; k < workspace->documents[i]->link_count; k++) {
            Link *link = &workspace->documents[i]->links[k];
            link->target = find_document(workspace, link->path);
            if (link->include && link->target != SIZE_MAX)
                workspace->included[link->target] = true;
        }
    }
}

// Adds a script if it may contain imports or includes, or if all scripts are searched for.
static void add_candidate(Workspace *workspace, const char *path) {
    SCOPED_TEXT text = {0};
    if (find_document(workspace, path) != SIZE_MAX || workspace->count >= MAX_FILES ||
        text_read_file(&text, path, SERVER_MAX_FILE_BYTES) || text.len == 0 ||
        (!workspace->all && !strstr(text.bytes, "import") && !strstr(text.bytes, "%include")))
        return;
    SCOPED_STRING uri = uri_of(path);
    add_document(workspace, document_new(uri, text_str(&text), -1), true, SIZE_MAX);
}

static void search_folder(Workspace *workspace, const char *folder, unsigned depth) {
    DIR *entries = opendir(folder);
    for (struct dirent *entry; entries && workspace->files_left > 0 && (entry = readdir(entries));) {
        SCOPED_TEXT path = {0};
        struct stat about;
        text_add_format(&path, "%s/%s", folder, entry->d_name);
        workspace->files_left--;
        if (entry->d_name[0] == '.' || strcmp(entry->d_name, "node_modules") == 0 || lstat(path.bytes, &about) != 0)
            continue;
        if (S_ISDIR(about.st_mode) && depth > 0)
            search_folder(workspace, path.bytes, depth - 1);
        else if (S_ISREG(about.st_mode) && str_ends_with(str_from(path.bytes), STR(".fl")))
            add_candidate(workspace, path.bytes);
    }
    if (entries)
        closedir(entries);
}

static void search_roots(Workspace *workspace) {
    const TextList *roots = &workspace->server->roots;
    workspace->files_left = (size_t)10 * MAX_FILES;
    for (size_t i = 0; i < roots->count; i++)
        search_folder(workspace, roots->items[i], MAX_FOLDERS);
}

static void search_workspace(Workspace *workspace, const Document *document) {
    const TextList *roots = &workspace->server->roots;
    search_roots(workspace);
    Str folder = path_directory(str_from(document->canonical));
    if (roots->count == 0 && document->is_file && folder.len > 1) {
        SCOPED_STRING own = memory_strndup(folder.bytes, folder.len - 1);
        search_folder(workspace, own, 0);
    }
}

void workspace_open(Workspace *workspace, Server *server, Document *document, bool whole) {
    *workspace = (Workspace){.server = server};
    add_document(workspace, document, false, SIZE_MAX);
    for (size_t i = 0; i < server->document_count; i++)
        if (server->documents[i] != document)
            add_document(workspace, server->documents[i], false, SIZE_MAX);
    if (whole && !server->access.no_files)
        search_workspace(workspace, document);
    follow_links(workspace);
    drop_unconnected(workspace);
    find_targets(workspace);
}

void workspace_open_all(Workspace *workspace, Server *server) {
    *workspace = (Workspace){.server = server, .all = true};
    for (size_t i = 0; i < server->document_count; i++)
        add_document(workspace, server->documents[i], false, SIZE_MAX);
    if (!server->access.no_files)
        search_roots(workspace);
}

void workspace_close(Workspace *workspace) {
    for (size_t i = 0; i < workspace->count; i++)
        if (workspace->own[i])
            document_free(workspace->documents[i]);
    free(workspace->documents);
    free(workspace->own);
    free(workspace->main);
    free(workspace->included);
}

void workspace_replace(Workspace *workspace, size_t file, const Text *text) {
    Document *before = workspace->documents[file];
    Document *after = document_new(before->uri, text_str(text), before->version);
    if (workspace->own[file])
        document_free(before);
    workspace->documents[file] = after;
    workspace->own[file] = true;
    server_read(workspace->server, after);
    find_targets(workspace);
}

const PetriBinding *workspace_name(const Workspace *workspace, BindingRef sense) {
    return &workspace->documents[sense.file]->names[sense.name];
}

bool binding_sets_overlap(const BindingSet *a, const BindingSet *b) {
    for (size_t i = 0; i < a->count; i++) {
        for (size_t k = 0; k < b->count; k++)
            if (a->items[i].file == b->items[k].file && a->items[i].name == b->items[k].name)
                return true;
    }
    return false;
}

bool binding_set_add(BindingSet *senses, const BindingSet *more) {
    bool any = false;
    for (size_t i = 0; i < more->count && senses->count < MAX_BINDINGS; i++) {
        BindingSet one = {.items = {more->items[i]}, .count = 1};
        if (!binding_sets_overlap(senses, &one)) {
            senses->items[senses->count++] = more->items[i];
            any = true;
        }
    }
    return any;
}

// --- bindings of names

// Returns the definition of a binding: the definition of the imported name if the binding is an import, else the
// binding itself.
static BindingSet binding_definition(const Workspace *workspace, size_t file, size_t name, unsigned depth) {
    const Document *document = workspace->documents[file];
    const PetriBinding *bound = &document->names[name];
    const Link *link = bound->kind == PETRI_NAME_IMPORT ? document_link(document, bound->value_start) : NULL;
    const Document *module =
        !link || link->target == SIZE_MAX || depth > MAX_LINKS ? NULL : workspace->documents[link->target];
    const PetriBinding *found =
        !module ? NULL : document_export(module, document_slice(document, bound->start, bound->end));
    return found ? binding_definition(workspace, link->target, (size_t)(found - module->names), depth + 1)
                 : (BindingSet){.items = {{file, name}}, .count = 1};
}

const PetriBinding *workspace_visible(const Document *document, const Link *link, Str text) {
    size_t at = document->tokens[link->token].start;
    const PetriBinding *found = NULL;
    for (size_t i = 0; i < document->name_count && document->names[i].start < at; i++) {
        const PetriBinding *name = &document->names[i];
        bool seen = name->kind != PETRI_NAME_USE && name->scope_start <= at && at <= name->scope_end;
        found = seen && str_equal(document_slice(document, name->start, name->end), text) ? name : found;
    }
    return found;
}

// Returns the bindings of a name that the file does not bind: the bindings visible where other scripts include the
// file.
static BindingSet includer_bindings(const Workspace *workspace, size_t file, Str text, unsigned depth) {
    BindingSet all = {.count = 0};
    for (size_t i = 0; workspace->included[file] && depth <= MAX_LINKS && i < workspace->count; i++) {
        const Document *document = workspace->documents[i];
        for (size_t k = 0; k < document->link_count; k++) {
            const Link *link = &document->links[k];
            if (link->include && link->target == file && i != file) {
                const PetriBinding *bound = workspace_visible(document, link, text);
                BindingSet more = bound ? binding_definition(workspace, i, (size_t)(bound - document->names), 0)
                                        : includer_bindings(workspace, i, text, depth + 1);
                binding_set_add(&all, &more);
            }
        }
    }
    return all;
}

static BindingSet resolve_name(const Workspace *workspace, size_t file, Str text, const PetriBinding *bound) {
    return bound ? binding_definition(workspace, file, (size_t)(bound - workspace->documents[file]->names), 0)
                 : includer_bindings(workspace, file, text, 0);
}

BindingSet workspace_bindings(const Workspace *workspace, size_t file, size_t number) {
    const Document *document = workspace->documents[file];
    const PetriBinding *name = &document->names[number], *before = number > 0 ? name - 1 : NULL;
    // In `let NAME=NAME if NAME != null else DEFAULT`, another use may be in between.
    if (before && before > document->names && before->kind == PETRI_NAME_USE)
        before--;
    Str text = document_slice(document, name->start, name->end);
    if (name->kind != PETRI_NAME_USE)
        return binding_definition(workspace, file, number, 0);
    BindingSet found = resolve_name(workspace, file, text, document_binding(document, name));
    // In the parameter `let NAME=NAME or DEFAULT`, the second NAME means the value set with -D. It refers to the
    // first.
    bool given = found.count == 0 && before && before->kind == PETRI_NAME_LET && before->value_start <= name->start &&
                 name->start < before->value_end &&
                 str_equal(document_slice(document, before->start, before->end), text);
    return given ? binding_definition(workspace, file, (size_t)(before - document->names), 0) : found;
}

BindingSet workspace_resolve(const Workspace *workspace, size_t token) {
    const Document *document = workspace->documents[0];
    const PetriBinding *name = document_name_at(document, document->tokens[token].start);
    if (name)
        return workspace_bindings(workspace, 0, (size_t)(name - document->names));
    if (document->tokens[token].kind != PETRI_TOKEN_NAME || document_is(document, token + 1, "="))
        return (BindingSet){.count = 0};
    return resolve_name(workspace, 0, document_token(document, token), document_resolve(document, token));
}
