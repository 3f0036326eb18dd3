// reach.h: which files a script may use: those below some folders.
//
// A path is resolved first, links and dots and all; what it leads to must lie below one of the folders, and is then
// opened from there without following any link, so that nothing changes its meaning in between.
#ifndef PETRI_BASE_REACH_H
#define PETRI_BASE_REACH_H

#include "base/replace.h"
#include "base/str.h"

typedef enum ReachKind { REACH_READ, REACH_WRITE, REACH_KIND_COUNT } ReachKind;

typedef struct Reach {
    const Str *folders[REACH_KIND_COUNT]; // canonical; NUL-terminated
    uint32_t counts[REACH_KIND_COUNT];
    Str own;       // the script's, for both; empty: none
    Str directory; // what relative names start from, as the user gave it
    bool nothing;  // no file at all
    // Where what is read comes from, whatever the folders; NULL: the disk. The bytes stay as they are as long as the
    // same ones are given again.
    const char *(*read)(void *host, const char *name, size_t *length);
    void *read_host;
    // What stands for a file on the disk, by its canonical path; NULL gives none.
    const char *(*unsaved)(void *host, const char *name, size_t *length);
} Reach;

// Adds folders, by name, to those of a kind; NULL or a list that ends in NULL.
void reach_add(Arena *arena, Reach *reach, ReachKind kind, const char *const *names);
// The canonical path of the folder that a file's name begins with; empty if it is not there.
Str reach_folder(Arena *arena, Str directory);
Reach reach_copy(Arena *arena, const Reach *reach);

// Whether a canonical path lies within. NULL: everything does.
bool reach_has(const Reach *reach, ReachKind kind, const char *path);
// The canonical path; false with errno set, EXDEV if it lies outside.
bool reach_resolve(const Reach *reach, ReachKind kind, const char *path, char resolved[PATH_MAX]);
// The bytes that `read` gives for a path, which it gets without dots and double slashes; false with errno set if there
// are none, or the path is too long.
bool reach_read(const Reach *reach, const char *path, Str *bytes);
// The text that stands for the file, if there is one.
bool reach_unsaved(const Reach *reach, const char *path, Str *bytes);
// A path without dots and double slashes, whatever there is on the disk; false with errno set if it is too long.
bool reach_normal(const char *path, char normal[PATH_MAX]);
// Opens a file for reading, or as `flags` say; -1 with errno set likewise.
int reach_open(const Reach *reach, const char *path, int flags);
// replace_begin for a regular file, or a new one, within; false with errno set likewise.
bool reach_replace(const Reach *reach, const char *path, Replacement *replacement);
// Makes the folders that a file is to be in, as far as they are missing. False if it lies outside.
bool reach_make_folders(const Reach *reach, const char *path);
// Why a path is out of reach, and what would change that.
const char *reach_refusal(Arena *arena, const Reach *reach, ReachKind kind, const char *path);

#endif
