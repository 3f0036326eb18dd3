// file.h: functions that read and write whole files.
#pragma once

#include "base/file_access.h"

#include <sys/types.h>

// Reads a file of at most `limit` bytes into the arena. Sets *bytes to its contents, which are followed by a NUL byte.
// If `regular` is true, only regular files are accepted. If it is false, pipes and devices are accepted too. On failure
// returns false and sets *problem to the reason, a constant string or one in the arena. If `version` is not NULL, sets
// *version to a string that changes when the file changes. file_access restricts which files can be read; NULL: no
// restriction.
bool file_read(Arena *arena, const FileAccess *file_access, const char *path, bool regular, size_t limit, Str *bytes,
               Str *version, const char **problem);
// Calls read, and repeats it if interrupted by a signal.
ssize_t file_read_some(int file, void *bytes, size_t len);
// Reads exactly `len` bytes. Returns false if the file ends earlier, or with errno set on failure.
bool file_read_bytes(int file, void *bytes, size_t len);
// Reads `file` to its end and adds the bytes to `text`. Stops early once text->len exceeds max_len. On failure returns
// false with errno set.
bool text_read(Text *text, int file, size_t max_len);
// Adds the contents of a regular file of at most `limit` bytes. Returns NULL on success. On failure, returns the
// reason: a string that stays valid until the next call of strerror. For a pipe or a device, fails at once instead of
// waiting for data.
const char *text_read_file(Text *text, const char *path, size_t limit);
// Like text_read_file, for a file that was opened with O_NONBLOCK. Closes `file`, which may be the negative result of a
// failed open: this function then returns the reason that errno gives.
const char *text_read_regular(Text *text, int file, size_t limit);
bool file_exists(const char *path);
// Sets *version to the same string as file_read would. Returns false if the file does not exist or cannot be accessed.
bool file_version(Arena *arena, const FileAccess *file_access, const char *path, Str *version);
// Replaces the contents of a file by `bytes` atomically. `flags` are ReplaceFlags. Returns NULL on success, else the
// reason for the failure.
const char *file_replace(const char *path, Str bytes, unsigned flags);
// Writes `bytes` to a replacement and commits it. Returns NULL on success. On failure aborts the replacement and
// returns the reason.
const char *file_finish(Replacement *replacement, Str bytes);
// Calls openat with O_CLOEXEC and O_NOCTTY, and retries if interrupted by a signal. `folder` may be AT_FDCWD.
int file_open_at(int folder, const char *name, int flags, mode_t mode);
// Writes all bytes to an open file. On failure returns false with errno set.
bool file_write(int file, const char *bytes, size_t len);
// Truncates a file to `len` bytes. On failure returns false with errno set.
bool file_truncate(int file, size_t len);
// Sets `resolved` to the path with symbolic links, "." and ".." resolved. The file itself need not exist, but its
// folder must. On failure returns false with errno set.
bool file_resolve(const char *path, char resolved[PATH_MAX]);
// Returns a NUL-terminated path with symbolic links, "." and ".." resolved. A path that does not exist is copied
// unchanged. If the host provides the files (FileAccess.read_file), the path is only normalised.
Str file_canonical(Arena *arena, const FileAccess *file_access, const char *path);
