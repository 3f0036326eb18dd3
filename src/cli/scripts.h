// scripts.h: the list of scripts in the files and folders on a command line.
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct Script {
    char *path;
    size_t relative_start; // offset in `path` of the part below the folder that was searched
} Script;

typedef struct ScriptList {
    Script *items;
    size_t count;
    size_t capacity;
    const char *const *suffixes; // of other files that scripts_find adds in folders, then NULL; NULL: none
} ScriptList;

// Adds a file, or all files named *.fl below a folder except hidden ones. Returns false after a message if something
// cannot be read.
bool scripts_find(ScriptList *list, const char *path);
// Adds a name, such as `-`, without looking for a file.
void scripts_add(ScriptList *list, const char *path);
// Sorts by path and removes duplicates.
void scripts_sort(ScriptList *list);
void scripts_free(ScriptList *list);
