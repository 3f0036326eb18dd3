// file_access.h: which files a script may use: those below some folders.
//
// A path is resolved first, links and dots and all; what it leads to must lie below one of the folders, and is then
// opened from there without following any link, so that nothing changes its meaning in between.
#ifndef PETRI_BASE_FILE_ACCESS_H
#define PETRI_BASE_FILE_ACCESS_H

#include "base/replace.h"
#include "base/str.h"

typedef enum FileAccessKind { FILE_ACCESS_READ, FILE_ACCESS_WRITE, FILE_ACCESS_KIND_COUNT } FileAccessKind;

typedef struct FileAccess {
    const Str *folders[FILE_ACCESS_KIND_COUNT]; // canonical; NUL-terminated
    uint32_t counts[FILE_ACCESS_KIND_COUNT];
    Str script_folder; // the script's, for both; empty: none
    Str directory;     // what relative names start from, as the user gave it
    bool no_files;     // no file at all
    // Where what is read comes from, whatever the folders; NULL: the disk. The bytes stay as they are as long as the
    // same ones are given again.
    const char *(*read_file)(void *user_data, const char *name, size_t *length);
    void *read_user_data;
    // What stands for a file on the disk, by its canonical path; NULL gives none.
    const char *(*read_unsaved)(void *user_data, const char *name, size_t *length);
} FileAccess;

// Adds folders, by name, to those of a kind; NULL or a list that ends in NULL.
void file_access_add(Arena *arena, FileAccess *file_access, FileAccessKind kind, const char *const *names);
// The canonical path of the folder that a file's name begins with; empty if it is not there.
Str file_access_folder(Arena *arena, Str directory);
FileAccess file_access_copy(Arena *arena, const FileAccess *file_access);

// Whether a canonical path lies within. NULL: everything does.
bool file_access_allows(const FileAccess *file_access, FileAccessKind kind, const char *path);
// The canonical path; false with errno set, EXDEV if it lies outside.
bool file_access_resolve(const FileAccess *file_access, FileAccessKind kind, const char *path, char resolved[PATH_MAX]);
// The bytes that `read` gives for a path, which it gets without dots and double slashes; false with errno set if there
// are none, or the path is too long.
bool file_access_read(const FileAccess *file_access, const char *path, Str *bytes);
// The text that stands for the file, if there is one.
bool file_access_read_unsaved(const FileAccess *file_access, const char *path, Str *bytes);
// A path without dots and double slashes, whatever there is on the disk; false with errno set if it is too long.
bool file_access_normalise(const char *path, char normal[PATH_MAX]);
// Opens a file for reading, or as `flags` say; -1 with errno set likewise.
int file_access_open(const FileAccess *file_access, const char *path, int flags);
// replace_begin for a regular file, or a new one, within; false with errno set likewise.
bool file_access_replace(const FileAccess *file_access, const char *path, Replacement *replacement);
// Makes the folders that a file is to be in, as far as they are missing. False if it lies outside.
bool file_access_make_folders(const FileAccess *file_access, const char *path);
// Why a path is out of reach, and what would change that.
const char *file_access_reason(Arena *arena, const FileAccess *file_access, FileAccessKind kind, const char *path);

#endif
