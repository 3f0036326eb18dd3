// scripts.h: finding the scripts that are meant by files and folders on the command line.
#ifndef PETRI_SRC_SCRIPTS_H
#define PETRI_SRC_SCRIPTS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Script {
    char *path;
    size_t relative_start; // where the part of the path begins that was found below the folder asked for
} Script;

typedef struct ScriptList {
    Script *items;
    size_t count;
    size_t capacity;
} ScriptList;

// Adds a file, or each file named *.fl in a folder and the folders in it. False, after a message, if something cannot
// be read. Hidden files and folders are passed by.
bool scripts_find(ScriptList *list, const char *path);
// Adds a name that is taken as it is, such as `-`.
void scripts_add(ScriptList *list, const char *path);
// By path; what was named twice stays once.
void scripts_sort(ScriptList *list);
void scripts_free(ScriptList *list);

#endif
