// replace.h: the one way to write a file: as a whole, or not at all.
//
// The bytes go to a file without a name in the target's folder (where the system has no such thing: to one with a name
// that nobody can guess) and when they are on the disk that takes the target's name. Readers see the old bytes or the
// new ones, whatever happens, and after a crash or kill -9 one of the two is there. Permissions and owner stay, a
// symbolic link stays one and its target is replaced. What is no regular file (a device, a pipe, /dev/stdout) is never
// replaced: the bytes are written to it.
#ifndef PETRI_BASE_REPLACE_H
#define PETRI_BASE_REPLACE_H

#include <limits.h>
#include <stdbool.h>

typedef enum ReplaceFlags {
    REPLACE_CREATE_ONLY = 1, // only if nothing is there, a link neither
    REPLACE_NAMED = 2,       // the new file has a name from the start
} ReplaceFlags;

typedef struct Replacement {
    int file;    // takes the bytes; -1: nothing is begun
    int folder;  // the target's
    bool direct; // `file` is the target itself, which is no regular file
    bool only_new;
    char name[NAME_MAX + 1];           // the target's in its folder
    char temporary_name[NAME_MAX + 1]; // the new file's meanwhile; "": none
} Replacement;

// Each is false with errno set if it failed; what is begun is to be ended by replace_commit, replace_end or
// replace_abort.
bool replace_begin(Replacement *replacement, const char *path, unsigned flags);
// The same in an open folder, which it takes and closes in any case; `name` has no slash. Refuses what is there and no
// regular file, symbolic links too.
bool replace_begin_in(Replacement *replacement, int folder, const char *name, unsigned flags);
// Puts the new file in its place, once all is on the disk; the old file is untouched if that fails.
bool replace_commit(Replacement *replacement);
// The same in three steps: all is brought to the disk; it is put in its place; so is its name, and what was begun ends.
bool replace_flush(Replacement *replacement);
bool replace_rename(Replacement *replacement);
bool replace_end(Replacement *replacement);
void replace_abort(Replacement *replacement);
// Brings a file or folder to the disk. True where the file system cannot do that.
bool replace_sync(int file);
// What ends a replacement, and this, may be called from a signal handler.

#endif
