// replace.h: atomic replacement of files.
//
// The bytes are written to an unnamed file in the target's folder (O_TMPFILE). If the system does not support that, the
// new file has a random temporary name. Once the bytes are on disk, the new file is renamed to the target. Readers see
// either the complete old file or the complete new one, even after a crash or kill -9. Owner and permissions are kept.
// A symbolic link is kept and its target is replaced. A target is written to directly if it is not a regular file (a
// device, a pipe) or if it is the file to which stdout or stderr is connected.
#pragma once

#include <limits.h>
#include <stdbool.h>

typedef enum ReplaceFlags {
    REPLACE_CREATE_ONLY = 1, // fail if the target exists, even as a symbolic link
    REPLACE_NAMED = 2,       // use a temporary name even if unnamed files are supported
} ReplaceFlags;

typedef struct Replacement {
    int file;                          // descriptor to which the new bytes are written; -1: not begun
    int folder;                        // descriptor of the target's folder
    bool direct;                       // true if `file` is the target itself, not a new file
    bool only_new;                     // true if the target must not exist (REPLACE_CREATE_ONLY)
    char name[NAME_MAX + 1];           // name of the target in its folder
    char temporary_name[NAME_MAX + 1]; // name of the new file until it is renamed; "": it has no name
} Replacement;

// Unless stated otherwise, the functions return false with errno set on failure. All functions except replace_begin and
// replace_begin_in are safe in a signal handler.

// Begins a replacement. The caller ends it with replace_commit, replace_end or replace_abort.
bool replace_begin(Replacement *replacement, const char *path, unsigned flags);
// Like replace_begin, but for a name without slashes in an open folder. Takes ownership of the descriptor `folder`,
// even on failure. Fails if the target exists and is not a regular file, for example a symbolic link.
bool replace_begin_in(Replacement *replacement, int folder, const char *name, unsigned flags);
// Writes the new file to disk and renames it to the target. On failure the old file is unchanged and the replacement
// is aborted.
bool replace_commit(Replacement *replacement);
// The three steps of replace_commit: flush the new file to disk; rename it; flush the folder and end the replacement.
bool replace_flush(Replacement *replacement);
bool replace_rename(Replacement *replacement);
bool replace_end(Replacement *replacement);
// Removes the new file and closes the descriptors.
void replace_abort(Replacement *replacement);
// Flushes a file or folder to disk. Also returns true if the file system does not support this.
bool replace_sync(int file);
