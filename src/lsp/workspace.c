// workspace.c: see workspace.h.
//
// What is imported means the last binding of its name at the top level of its file. What is included is a block of its
// own: it sees the names above it, and nothing sees its own.
#include "lsp/workspace.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/source.h"

enum {
    MOST_FILES = 5000,
    MOST_FOLDERS = 12, // within each other
    MOST_LINKS = 16    // from file to file
};

static size_t find(const Workspace *workspace, const char *path) {
    for (size_t i = 0; i < workspace->count; i++) {
        if (strcmp(workspace->documents[i]->canonical, path) == 0) {
            return i;
        }
    }
    return SIZE_MAX;
}

static void add(Workspace *workspace, Document *document, bool own) {
    size_t count = workspace->count++;
    workspace->documents = memory_resized(workspace->documents, workspace->count * sizeof(Document *));
    workspace->own = memory_resized(workspace->own, workspace->count * sizeof *workspace->own);
    workspace->documents[count] = document;
    workspace->own[count] = own;
    server_read(workspace->server, document);
}

// What is imported and included, and so on.
static void follow(Workspace *workspace) {
    for (size_t i = 0; i < workspace->count; i++) {
        for (size_t k = 0; k < workspace->documents[i]->link_count; k++) {
            const char *path = workspace->documents[i]->links[k].path;
            bool own = false;
            Document *document = find(workspace, path) == SIZE_MAX && workspace->count < MOST_FILES
                                     ? server_file(workspace->server, path, &own)
                                     : NULL;
            if (document != NULL) {
                add(workspace, document, own);
            }
            workspace->documents[i]->links[k].target = find(workspace, path);
        }
    }
}

// Drops what is not connected with the first document by any chain of links.
static void keep_connected(Workspace *workspace) {
    size_t kept = 0;
    bool *connected = memory_zeroed(workspace->count);
    connected[0] = true;
    for (bool more = true; more;) {
        more = false;
        for (size_t i = 0; i < workspace->count; i++) {
            for (size_t k = 0; k < workspace->documents[i]->link_count; k++) {
                size_t target = workspace->documents[i]->links[k].target;
                if (target != SIZE_MAX && connected[i] != connected[target]) {
                    connected[i] = connected[target] = more = true;
                }
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

// All links lead to documents that are there.
static void find_targets(Workspace *workspace) {
    free(workspace->included);
    workspace->included = memory_zeroed(workspace->count);
    for (size_t i = 0; i < workspace->count; i++) {
        for (size_t k = 0; k < workspace->documents[i]->link_count; k++) {
            Link *link = &workspace->documents[i]->links[k];
            link->target = find(workspace, link->path);
            if (link->include && link->target != SIZE_MAX) {
                workspace->included[link->target] = true;
            }
        }
    }
}

// A script that may have to do with others: most have not.
static void look_into(Workspace *workspace, const char *path) {
    SCOPED_BYTES text = {0};
    bool own = false;
    if (find(workspace, path) != SIZE_MAX || !bytes_read_file(&text, path) || text.length == 0 ||
        (strstr(text.data, "import") == NULL && strstr(text.data, "%include") == NULL)) {
        return;
    }
    Document *document = server_file(workspace->server, path, &own);
    if (document != NULL) {
        add(workspace, document, own);
    }
}

static void look_through(Workspace *workspace, const char *folder, unsigned depth) {
    DIR *entries = opendir(folder);
    for (struct dirent *entry; entries != NULL && workspace->left > 0 && (entry = readdir(entries)) != NULL;) {
        SCOPED_BYTES path = {0};
        struct stat about;
        bytes_format(&path, "%s/%s", folder, entry->d_name);
        workspace->left--;
        if (entry->d_name[0] == '.' || strcmp(entry->d_name, "node_modules") == 0 || lstat(path.data, &about) != 0) {
            continue;
        }
        if (S_ISDIR(about.st_mode) && depth > 0) {
            look_through(workspace, path.data, depth - 1);
        } else if (S_ISREG(about.st_mode) && str_ends_with(str_from(path.data), STR(".fl"))) {
            look_into(workspace, path.data);
        }
    }
    if (entries != NULL) {
        closedir(entries);
    }
}

static void look_around(Workspace *workspace, const Document *document) {
    const TextList *roots = &workspace->server->roots;
    workspace->left = (size_t)10 * MOST_FILES;
    for (size_t i = 0; i < roots->count; i++) {
        look_through(workspace, roots->items[i], MOST_FOLDERS);
    }
    Str folder = path_directory(str_from(document->canonical));
    if (roots->count == 0 && document->is_file && folder.len > 1) {
        SCOPED_TEXT own = memory_copied(folder.bytes, folder.len - 1);
        look_through(workspace, own, 0);
    }
}

void workspace_open(Workspace *workspace, Server *server, Document *document, bool whole) {
    *workspace = (Workspace){.server = server};
    add(workspace, document, false);
    for (size_t i = 0; i < server->document_count; i++) {
        if (server->documents[i] != document) {
            add(workspace, server->documents[i], false);
        }
    }
    if (whole) {
        look_around(workspace, document);
    }
    follow(workspace);
    keep_connected(workspace);
    find_targets(workspace);
}

void workspace_close(Workspace *workspace) {
    for (size_t i = 0; i < workspace->count; i++) {
        if (workspace->own[i]) {
            document_free(workspace->documents[i]);
        }
    }
    free(workspace->documents);
    free(workspace->own);
    free(workspace->included);
}

void workspace_replace(Workspace *workspace, size_t file, const Bytes *text) {
    Document *before = workspace->documents[file];
    Document *after = document_new(before->uri, (Str){text->data, text->length}, before->version);
    if (workspace->own[file]) {
        document_free(before);
    }
    workspace->documents[file] = after;
    workspace->own[file] = true;
    server_read(workspace->server, after);
    find_targets(workspace);
}

const PetriTextName *workspace_name(const Workspace *workspace, Sense sense) {
    return &workspace->documents[sense.file]->names[sense.name];
}

bool senses_meet(const Senses *a, const Senses *b) {
    for (size_t i = 0; i < a->count; i++) {
        for (size_t k = 0; k < b->count; k++) {
            if (a->items[i].file == b->items[k].file && a->items[i].name == b->items[k].name) {
                return true;
            }
        }
    }
    return false;
}

bool senses_add(Senses *senses, const Senses *more) {
    bool any = false;
    for (size_t i = 0; i < more->count && senses->count < MOST_SENSES; i++) {
        Senses one = {.items = {more->items[i]}, .count = 1};
        if (!senses_meet(senses, &one)) {
            senses->items[senses->count++] = more->items[i];
            any = true;
        }
    }
    return any;
}

// --- what a name means

static Senses of_binding(const Workspace *workspace, size_t file, size_t name, unsigned depth) {
    const Document *document = workspace->documents[file];
    const PetriTextName *bound = &document->names[name];
    const Link *link = bound->kind == PETRI_NAME_IMPORT ? document_link(document, bound->value_start) : NULL;
    const Document *module =
        link == NULL || link->target == SIZE_MAX || depth > MOST_LINKS ? NULL : workspace->documents[link->target];
    const PetriTextName *found =
        module == NULL ? NULL : explain_export(module, document_part(document, bound->start, bound->end));
    return found != NULL ? of_binding(workspace, link->target, (size_t)(found - module->names), depth + 1)
                         : (Senses){.items = {{file, name}}, .count = 1};
}

const PetriTextName *workspace_visible(const Document *document, const Link *link, Str text) {
    size_t at = document->tokens[link->token].start;
    const PetriTextName *found = NULL;
    for (size_t i = 0; i < document->name_count && document->names[i].start < at; i++) {
        const PetriTextName *name = &document->names[i];
        bool seen = name->kind != PETRI_NAME_USE && name->scope_start <= at && at <= name->scope_end;
        found = seen && str_equal(document_part(document, name->start, name->end), text) ? name : found;
    }
    return found;
}

// What a name means that the file does not bind: what the scripts bind that include it, where they do.
static Senses of_includers(const Workspace *workspace, size_t file, Str text, unsigned depth) {
    Senses all = {.count = 0};
    for (size_t i = 0; workspace->included[file] && depth <= MOST_LINKS && i < workspace->count; i++) {
        const Document *document = workspace->documents[i];
        for (size_t k = 0; k < document->link_count; k++) {
            const Link *link = &document->links[k];
            if (link->include && link->target == file && i != file) {
                const PetriTextName *bound = workspace_visible(document, link, text);
                Senses more = bound != NULL ? of_binding(workspace, i, (size_t)(bound - document->names), 0)
                                            : of_includers(workspace, i, text, depth + 1);
                senses_add(&all, &more);
            }
        }
    }
    return all;
}

static Senses look_up(const Workspace *workspace, size_t file, Str text, const PetriTextName *bound) {
    return bound != NULL ? of_binding(workspace, file, (size_t)(bound - workspace->documents[file]->names), 0)
                         : of_includers(workspace, file, text, 0);
}

Senses workspace_senses(const Workspace *workspace, size_t file, size_t number) {
    const Document *document = workspace->documents[file];
    const PetriTextName *name = &document->names[number], *before = number > 0 ? name - 1 : NULL;
    Str text = document_part(document, name->start, name->end);
    if (name->kind != PETRI_NAME_USE) {
        return of_binding(workspace, file, number, 0);
    }
    Senses found = look_up(workspace, file, text, document_binding(document, name));
    // The NAME in the value of a parameter, which -D gives, is that of the parameter.
    bool given = found.count == 0 && before != NULL && before->kind == PETRI_NAME_LET &&
                 before->value_start == name->start &&
                 str_equal(document_part(document, before->start, before->end), text);
    return given ? of_binding(workspace, file, number - 1, 0) : found;
}

Senses workspace_meaning(const Workspace *workspace, size_t token) {
    const Document *document = workspace->documents[0];
    const PetriTextName *name = document_name_at(document, document->tokens[token].start);
    if (name != NULL) {
        return workspace_senses(workspace, 0, (size_t)(name - document->names));
    }
    if (document->tokens[token].kind != PETRI_TOKEN_NAME || document_is(document, token + 1, "=")) {
        return (Senses){.count = 0};
    }
    return look_up(workspace, 0, document_token(document, token), document_meaning(document, token));
}
