// read_files.h: the files that a session has read, for the entries of a cache.
#pragma once

#include "base/sha256.h"
#include "cli/memory.h"

typedef struct ReadFile {
    char *name;                   // relative to the script's folder, unless it is absolute
    char hash[SHA256_DIGITS + 1]; // SHA-256 of the contents; "-": the file could not be read
} ReadFile;

typedef struct ReadFiles {
    ReadFile *items;
    size_t count;
    bool changed; // true if a file was read again with other contents, or a folder was searched
} ReadFiles;

// Adds a file that the session has read; `bytes` is NULL if it could not be read. A name that ends in a slash is a
// folder.
void read_files_add(ReadFiles *files, const char *name, const char *bytes, size_t length);
void read_files_free(ReadFiles *files);
// Appends a line `file HASH NAME` for each file. Returns false if a name contains a line feed.
bool read_files_write(const ReadFiles *files, Text *text);

// Hashes of files on disk, which are computed again only if a file changes.
typedef struct KnownHash KnownHash;
typedef struct KnownHashes {
    KnownHash *items;
    size_t count;
    size_t hashed; // number of bytes hashed for the current entry
} KnownHashes;

// Checks a line of read_files_write. Returns true if the file still has the same contents. `folder` is the folder of
// the script, with a slash at the end, or empty. Returns false if the file has more than 1 GiB, which scripts cannot
// read, or if more than 4 GiB were hashed for one entry.
bool read_file_is_unchanged(KnownHashes *known, Str folder, Str line);
void known_hashes_free(KnownHashes *known);
