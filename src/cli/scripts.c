// scripts.c: see scripts.h.
#include "cli/scripts.h"

#include "base/source.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/script.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void add_script(ScriptList *list, const char *path, size_t below) {
    if (list->count == list->capacity) {
        list->capacity = list->capacity == 0 ? 64 : 2 * list->capacity;
        list->items = memory_realloc(list->items, list->capacity * sizeof *list->items);
    }
    list->items[list->count++] = (Script){.path = memory_strdup(path), .relative_start = below};
}

static bool cannot_read(const char *path) {
    if (path[0] == '\0') {
        message("the script name is empty");
        return false;
    }
    message("cannot read %s: %s", path, strerror(errno));
    return false;
}

static bool search_folder(ScriptList *list, const char *folder, size_t below);

// Adds an entry of a folder. Symbolic links to folders are not followed, because they can form a cycle.
static bool add_entry(ScriptList *list, const char *path, const char *name, size_t below) {
    struct stat about;
    if (lstat(path, &about) != 0)
        return cannot_read(path);
    if (S_ISDIR(about.st_mode))
        return search_folder(list, path, below);
    bool wanted = str_ends_with(str_from(name), STR(".fl"));
    for (const char *const *suffix = list->suffixes; suffix && *suffix && !wanted; suffix++)
        wanted = str_ends_with(str_from(name), str_from(*suffix));
    // Reading a pipe or device could block.
    if (wanted && stat(path, &about) == 0 && S_ISREG(about.st_mode))
        add_script(list, path, below);
    return true;
}

static bool search_folder(ScriptList *list, const char *folder, size_t below) {
    DIR *entries = opendir(folder);
    if (!entries)
        return cannot_read(folder);
    bool done = true;
    for (struct dirent *entry = readdir(entries); entry; entry = readdir(entries)) {
        if (entry->d_name[0] == '.')
            continue;
        SCOPED_TEXT path = {0};
        size_t length = strlen(folder);
        text_add_format(&path, "%s%s%s", folder, length > 0 && folder[length - 1] == '/' ? "" : "/", entry->d_name);
        done = add_entry(list, path.bytes, entry->d_name, below) && done;
    }
    closedir(entries);
    return done;
}

void scripts_add(ScriptList *list, const char *path) {
    add_script(list, path, 0);
}

bool scripts_find(ScriptList *list, const char *path) {
    struct stat about;
    if (stat(path, &about) != 0) {
        cannot_read(path);
        script_suggest(path);
        return false;
    }
    size_t length = strlen(path);
    if (S_ISDIR(about.st_mode))
        return search_folder(list, path, length > 0 && path[length - 1] == '/' ? length : length + 1);
    add_script(list, path, path_directory(str_from(path)).len);
    return true;
}

static int compare_paths(const void *a, const void *b) {
    const Script *first = a;
    const Script *second = b;
    return strcmp(first->path, second->path);
}

void scripts_sort(ScriptList *list) {
    if (list->count == 0)
        return;
    qsort(list->items, list->count, sizeof *list->items, compare_paths);
    size_t kept = 1;
    for (size_t i = 1; i < list->count; i++)
        if (strcmp(list->items[i].path, list->items[kept - 1].path) == 0)
            free(list->items[i].path);
        else
            list->items[kept++] = list->items[i];
    list->count = kept;
}

void scripts_free(ScriptList *list) {
    for (size_t i = 0; i < list->count; i++)
        free(list->items[i].path);
    free(list->items);
    *list = (ScriptList){0};
}
