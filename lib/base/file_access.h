// file_access.h: access control for the files that a script reads and writes.
//
// A script may use only files below certain folders. A path is first made canonical: symbolic links, "." and
// ".." are resolved. The canonical path must be below one of the folders. The file is then opened relative to that
// folder without following links, so that a link created in the meantime cannot redirect it.
#pragma once

#include "base/replace.h"
#include "base/str.h"

#include <sys/types.h>

typedef enum FileAccessKind { FILE_ACCESS_READ, FILE_ACCESS_WRITE, FILE_ACCESS_KIND_COUNT } FileAccessKind;

typedef struct FileAccess {
    const Str *folders[FILE_ACCESS_KIND_COUNT]; // by kind: canonical, NUL-terminated paths of the allowed folders
    uint32_t counts[FILE_ACCESS_KIND_COUNT];    // number of allowed folders by kind
    Str script_folder;                          // canonical folder of the script, readable and writable; empty: none
    Str directory; // path, as the user gave it, of the folder that relative paths in scripts start from
    bool no_files; // true: all files on disk are denied
    // If not NULL, the host provides all files for reading, and the folders do not restrict reading. Returns the bytes
    // of a file, or NULL if it does not exist. If the bytes of a file change, the returned pointer must change too.
    const char *(*read_file)(void *user_data, const char *name, size_t *length);
    void *read_user_data; // passed to read_file and read_unsaved
    // If not NULL, returns the unsaved text of an existing file, or NULL if it has none. `name` is the canonical path
    // of the file.
    const char *(*read_unsaved)(void *user_data, const char *name, size_t *length);
    // If not NULL, receives the contents of each file that was read, and the names in each folder that was listed, in
    // the form that read_file returns. Receives NULL bytes if there is no such file. `path` of a folder ends in a
    // slash.
    void (*on_read)(void *user_data, const char *path, Str bytes);
    void *on_read_user_data;
} FileAccess;

// Allows a kind of access to the folders in `names`, a NULL-terminated list. If `names` is NULL, does nothing. Folders
// that cannot be resolved are ignored.
void file_access_add(Arena *arena, FileAccess *file_access, FileAccessKind kind, const char *const *names);
// Returns the canonical path of a directory; an empty name means the working directory. Returns an empty string if the
// directory does not exist.
Str file_access_folder(Arena *arena, Str directory);
// Returns a copy whose strings are also copied to the arena. The copy has no on_read.
FileAccess file_access_copy(Arena *arena, const FileAccess *file_access);

// Returns true if access to a canonical path is allowed. If file_access is NULL, all paths are allowed.
bool file_access_allows(const FileAccess *file_access, FileAccessKind kind, const char *path);
// Sets `resolved` to the canonical form of `path` and checks access to it. On failure returns false with errno set;
// EXDEV means that access is not allowed.
bool file_access_resolve(const FileAccess *file_access, FileAccessKind kind, const char *path, char resolved[PATH_MAX]);
// Sets *bytes to the result of the read_file callback for the normalised path. On failure returns false with errno set.
bool file_access_read(const FileAccess *file_access, const char *path, Str *bytes);
// Sets *bytes to the unsaved text of a file. Returns false if there is none or if reading the file is not allowed.
bool file_access_read_unsaved(const FileAccess *file_access, const char *path, Str *bytes);
// Removes ".", ".." and double slashes from a path without accessing the disk. Returns false with errno set if the path
// is too long.
bool file_access_normalise(const char *path, char normal[PATH_MAX]);
// Calls on_read, if there is one. NULL is ignored.
void file_access_report(const FileAccess *file_access, const char *path, Str bytes);
// Opens a file if reading it is allowed. `flags` are those of open. On failure returns -1 with errno set (EXDEV: not
// allowed).
int file_access_open(const FileAccess *file_access, const char *path, int flags);
// Opens the relative path `rest` below an open folder, one component at a time and without following links. If
// `make_folders` is true, creates missing folders. Modifies `rest` and closes `folder`. On failure returns -1 with
// errno set.
int file_open_below(int folder, char *rest, int flags, mode_t mode, bool make_folders);
// Like replace_begin, but only for a regular or new file, and only if writing it is allowed. On failure returns false
// with errno set (EXDEV: not allowed).
bool file_access_replace(const FileAccess *file_access, const char *path, Replacement *replacement);
// Creates the missing folders that will contain the file `path`. Returns false if writing the file is not allowed.
bool file_access_make_folders(const FileAccess *file_access, const char *path);
// Returns why access to a path is denied and which option would allow it, as a constant string or one in the arena.
const char *file_access_reason(Arena *arena, const FileAccess *file_access, FileAccessKind kind, const char *path);
