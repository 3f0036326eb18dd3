// file.h: whole files in and out.
#ifndef PETRI_BASE_FILE_H
#define PETRI_BASE_FILE_H

#include "base/file_access.h"

#include <sys/types.h>

// Reads a file of at most `limit` bytes into the arena, followed by a NUL byte; a pipe too unless it must be `regular`.
// False with a reason (borrowed) if that cannot be done. *version, if not NULL, gets a text that changes when the file
// does. Only within `reach`, unless that is NULL.
bool file_read(Arena *arena, const FileAccess *file_access, const char *path, bool regular, size_t limit, Str *bytes,
               Str *version, const char **problem);
bool file_exists(const char *path);
// The version that file_read would give; false if there is no such file.
bool file_version(Arena *arena, const FileAccess *file_access, const char *path, Str *version);
// Replaces a file as a whole, with the flags of replace.h. NULL, or why that failed.
const char *file_replace(const char *path, Str bytes, unsigned flags);
// The same for a file that is begun, which is ended in any case.
const char *file_finish(Replacement *replacement, Str bytes);
// openat, in spite of signals, of a file that no other program is given. Folder AT_FDCWD: the current one.
int file_open_at(int folder, const char *name, int flags, mode_t mode);
// Writes all bytes to an open file; false with errno set.
bool file_write(int file, const char *bytes, size_t len);
// Cuts off what comes after the first `len` bytes. False with errno if that fails.
bool file_truncate(int file, size_t len);
// Where the path leads, without links and dots, even if there is nothing yet; false with errno set if its folder is not
// there.
bool file_resolve(const char *path, char resolved[PATH_MAX]);
// The path without links and dots, or as it is if it does not exist; NUL-terminated. Of a host's files it is the name.
Str file_canonical(Arena *arena, const FileAccess *file_access, const char *path);

#endif
