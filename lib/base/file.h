// file.h: whole files in and out.
#ifndef PETRI_BASE_FILE_H
#define PETRI_BASE_FILE_H

#include "base/str.h"

// Reads a file of at most `limit` bytes into the arena, followed by a NUL byte; a pipe too unless it must be `regular`.
// False with a reason (borrowed) if that cannot be done. *version, if not NULL, gets a text that changes when the file
// does.
bool file_read(Arena *arena, const char *path, bool regular, size_t limit, Str *bytes, Str *version,
               const char **problem);
bool file_exists(const char *path);
// The version that file_read would give; false if there is no such file.
bool file_version(Arena *arena, const char *path, Str *version);
// Replaces a file as a whole: readers see the old bytes or the new ones, and after a crash one of the two is there.
// Written beside it, synchronised, renamed. False with a reason if that failed; the old file is then untouched.
bool file_replace(Arena *arena, const char *path, Str bytes, const char **problem);
// The path without links and dots, or as it is if it does not exist; NUL-terminated.
Str file_canonical(Arena *arena, const char *path);

#endif
