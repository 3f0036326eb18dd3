// cache.h: results of runs that are stored in a folder by content (petri sweep --cache).
//
// The key of a run is the SHA-256 of everything that determines its result and is known before it: the version of
// petri, the sources, the options, the metrics and the values. The entry of the key is the file KK/KEY in the folder,
// where KK are the first two digits. It lists the other files that the run has read, with their SHA-256, and applies
// only if they have not changed. Entries are replaced atomically, and a checksum detects damage, so several processes
// and machines can share a folder. Failed runs are not stored. Symbolic links below the folder are not followed, and
// entries are bounded, because a folder can be from someone else.
//
// An entry has these lines:
//
//     petri sweep result 2
//     key KEY
//     file HASH NAME             for each file
//     frames N
//     digest DIGEST              of the state after the last frame (spec digest.md)
//     rows LENGTH                then the rows (Result.rows), which have LENGTH bytes, and a line feed
//     sha256 HASH                of everything before this line
#pragma once

#include "sweep/read_files.h"
#include "sweep/sweep.h"

enum { CACHE_DIGEST_DIGITS = 32 };

// The result of a run in the form in which it is stored.
typedef struct CacheEntry {
    int64_t frames;
    char digest[CACHE_DIGEST_DIGITS + 1];
    Text rows;
} CacheEntry;

typedef enum CacheAnswer { CACHE_MISSING, CACHE_DAMAGED, CACHE_FOUND } CacheAnswer;

// Creates the folder if it does not exist. Returns false after a message if it cannot be used.
bool cache_open(const Sweep *sweep);
// Computes the key of a run from the hash of the settings that all runs share (Sweep.settings).
void cache_key(const Sweep *sweep, size_t run, char key[SHA256_DIGITS + 1]);
// Looks up a run. If it returns CACHE_FOUND, sets *entry, which the caller frees with cache_entry_free.
CacheAnswer cache_find(const Sweep *sweep, const char *key, KnownHashes *known, CacheEntry *entry);
// Stores a result, unless the files have changed during the run. Returns NULL, or the reason of a failure.
const char *cache_store(const Sweep *sweep, const char *key, const ReadFiles *files, const CacheEntry *entry);
void cache_entry_free(CacheEntry *entry);
// Returns true if a result that was found must be computed again (--verify-cache). Depends only on the key.
bool cache_should_verify(const Sweep *sweep, const char *key);
// Appends a report of the differences between a stored and a computed result of a run. Appends nothing if they are the
// same.
void cache_compare(const Sweep *sweep, size_t run, const CacheEntry *stored, const CacheEntry *computed, Text *report);
