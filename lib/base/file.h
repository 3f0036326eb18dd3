// file.h: functions that read and write whole files.
#ifndef PETRI_BASE_FILE_H
#define PETRI_BASE_FILE_H

#include "base/file_access.h"

#include <sys/types.h>

// Reads a file of at most `limit` bytes into the arena, followed by a NUL byte. Pipes are accepted unless `regular` is
// set. On failure returns false and sets *problem to the reason, a constant or in the arena. If version is not NULL,
// *version is set to a text that changes when the file changes. file_access restricts what can be read; NULL: no limit.
bool file_read(Arena *arena, const FileAccess *file_access, const char *path, bool regular, size_t limit, Str *bytes,
               Str *version, const char **problem);
bool file_exists(const char *path);
// Gets the version that file_read would return. Returns false if the file does not exist or cannot be accessed.
bool file_version(Arena *arena, const FileAccess *file_access, const char *path, Str *version);
// Replaces a file atomically; flags as in replace.h. Returns NULL, or the reason for the failure.
const char *file_replace(const char *path, Str bytes, unsigned flags);
// Writes `bytes` to a replacement that was begun and commits it; aborts it on failure. Returns NULL or the reason.
const char *file_finish(Replacement *replacement, Str bytes);
// Calls openat with O_CLOEXEC and O_NOCTTY, and repeats it if a signal interrupts it. AT_FDCWD: the working directory.
int file_open_at(int folder, const char *name, int flags, mode_t mode);
// Writes all bytes to an open file. On failure returns false with errno set.
bool file_write(int file, const char *bytes, size_t len);
// Truncates a file to `len` bytes. On failure returns false with errno set.
bool file_truncate(int file, size_t len);
// Resolves symbolic links and dots in a path. The file itself need not exist, but its folder must. On failure returns
// false with errno set.
bool file_resolve(const char *path, char resolved[PATH_MAX]);
// Returns the path with symbolic links and dots resolved, NUL-terminated. A path that does not exist is copied
// unchanged. If the host provides the files (FileAccess.read_file), the path is only normalised.
Str file_canonical(Arena *arena, const FileAccess *file_access, const char *path);

#endif
