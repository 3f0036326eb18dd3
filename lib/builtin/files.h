// files.h: a cache of file contents for built-ins, which reads a file again when it changes (spec builtins.md B13.1).
//
// Each combination of a path and a parser has one entry with its own arena. Failures are also cached: a missing file is
// reported only once, and is read when it appears. Built-ins return copies of cached data, because any later call can
// evict entries.
#pragma once

#include "builtin/builtin.h"

// Returns NULL if out of memory.
FileCache *file_cache_new(void);
void file_cache_free(FileCache *cache);
// Discards all entries. Must be called when file access rights change.
void file_cache_clear(FileCache *cache);

// Parses the bytes of a file. The bytes are in `arena`, and the parser is allowed to change them. The result must also
// be in `arena`. Returns NULL and sets *problem if the bytes are invalid.
typedef const void *FileParse(Arena *arena, char *bytes, size_t len, const char **problem);

// Returns the result of `parse` for the file `name`. The result is valid until the next call of file_cache_get with the
// same cache. Returns NULL if the file cannot be read; the first failure is reported as an error of `function`.
const void *file_cache_get(BuiltinContext *context, const char *function, FileParse *parse, Value name);

// For parsers: returns true if the bytes are UTF-8, else sets *problem.
bool file_is_text(const char *bytes, size_t len, const char **problem);
