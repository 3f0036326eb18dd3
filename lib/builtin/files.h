// files.h: contents of files for built-ins, re-read when a file changes (spec builtins.md B13.1).
//
// Each combination of a path and a way to read it has one entry, in an arena of its own. A failure is kept like a
// success, so a missing file is reported once and tried again when it appears. Nothing that a script gets points into
// the cache: results are copied, so an entry may be dropped at any call.
#ifndef PETRI_BUILTIN_FILES_H
#define PETRI_BUILTIN_FILES_H

#include "builtin/builtin.h"

// NULL if memory is used up.
FileCache *file_cache_new(void);
void file_cache_free(FileCache *cache);
// Forgets all files, for when others may be used.
void file_cache_clear(FileCache *cache);

// Turns the bytes of a file, which lie in `arena` and may be changed, into what is kept: something in `arena`. NULL
// with *problem set means that the file counts as unreadable.
typedef const void *FileParse(Arena *arena, char *bytes, size_t len, const char **problem);

// What `parse` makes of the file named by `name`, valid until the next call with this cache; NULL if it cannot be read,
// of which the first attempt is reported as a fault of `function`.
const void *file_cache_get(BuiltinContext *context, const char *function, FileParse *parse, Value name);

// For parsers: true if the bytes are UTF-8.
bool file_is_text(const char *bytes, size_t len, const char **problem);

#endif
