// files.c: the file cache, read and read_bytes (spec builtins.md B13.1, B13.3, B13.4); see files.h.
#include "builtin/files.h"

#include "base/hash_index.h"
#include "base/os.h"
#include "base/source.h"
#include "builtin/family.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    MAX_NAME_LENGTH = 4096,
    MAX_FILE_SIZE = 1 << 30,   // bytes
    MAX_CACHE_ENTRIES = 16384, // limited, because a script can generate any number of file names
};
static const size_t MAX_CACHED_BYTES = (size_t)2 << 30; // limit of the total size of all entries, in bytes

// File attributes that are compared to detect whether a file has changed.
typedef struct Stamp {
    int error; // errno of stat, or 0
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec modified;
    struct timespec changed; // time of the last change of content or permissions
} Stamp;

typedef struct FileEntry {
    Str path;
    FileParse *parse;
    Stamp stamp;
    bool tried;         // an attempt to read the file has finished: `stamp` and `parsed` are valid
    const void *parsed; // result of the parser, in `arena`; NULL: the file is unreadable
    Arena arena;
} FileEntry;

struct FileCache {
    Arena arena;     // owns the entries, the paths and the cache itself
    ArenaMark empty; // position in `arena` after the cache itself
    FileEntry **entries;
    uint32_t count;
    uint32_t capacity;
    HashIndex index;
};

FileCache *file_cache_new(void) {
    Arena arena;
    arena_init(&arena, "files", SIZE_MAX);
    FileCache *cache = arena_try_alloc(&arena, sizeof *cache);
    if (!cache)
        return NULL;
    *cache = (FileCache){.arena = arena};
    cache->empty = arena_mark(&cache->arena);
    return cache;
}

void file_cache_clear(FileCache *cache) {
    for (uint32_t i = 0; i < cache->count; i++)
        arena_free(&cache->entries[i]->arena);
    cache->entries = NULL;
    cache->count = cache->capacity = 0;
    hash_index_clear(&cache->index);
    arena_rewind(&cache->arena, cache->empty);
}

void file_cache_free(FileCache *cache) {
    if (!cache)
        return;
    file_cache_clear(cache);
    hash_index_free(&cache->index);
    Arena arena = cache->arena; // copied, because freeing the arena frees the cache
    arena_free(&arena);
}

// --- reading

static Stamp read_stamp(const FileAccess *file_access, const char *path) {
    struct stat info;
    Str bytes;
    if (file_access && file_access->read_file)
        return file_access_read(file_access, path, &bytes)
                   ? (Stamp){.inode = (ino_t)(uintptr_t)bytes.bytes, .size = (off_t)bytes.len}
                   : (Stamp){.error = errno};
    if (stat(path, &info) != 0)
        return (Stamp){.error = errno};
    return (Stamp){0, info.st_dev, info.st_ino, info.st_size, os_time_modified(&info), os_time_changed(&info)};
}

static bool same_time(struct timespec a, struct timespec b) {
    return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

static bool stamp_equal(const Stamp *a, const Stamp *b) {
    return a->error == b->error && a->device == b->device && a->inode == b->inode && a->size == b->size &&
           same_time(a->modified, b->modified) && same_time(a->changed, b->changed);
}

static const char *describe_error(int error) {
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "no such file";
    case EACCES:
    case EPERM:
        return "permission denied";
    case ELOOP:
        return "too many symbolic links";
    case ENAMETOOLONG:
        return "the name is too long";
    default:
        return "it cannot be opened";
    }
}

// Reads up to `size` bytes, which is the size in the file's stamp. If the file has grown since then, the next
// file_cache_get reads it again.
static bool read_file_bytes(const BuiltinContext *context, const char *path, char *bytes, size_t size, size_t *len,
                            const char **problem) {
    Str host_bytes;
    if (context->file_access && context->file_access->read_file) {
        *problem = file_access_read(context->file_access, path, &host_bytes) ? NULL : describe_error(errno);
        *len = !*problem && host_bytes.len < size ? host_bytes.len : !*problem ? size : 0;
        if (*len)
            memcpy(bytes, host_bytes.bytes, *len);
        return !*problem;
    }
    // Because of O_NONBLOCK, opening the file does not block even if it was replaced by a pipe.
    int file = file_access_open(context->file_access, path, O_RDONLY | O_NONBLOCK);
    struct stat info;
    if (file < 0 || fstat(file, &info) != 0) {
        *problem = context->file_access && errno == EXDEV
                       ? file_access_reason(context->arena, context->file_access, FILE_ACCESS_READ, path)
                       : describe_error(errno);
        if (file >= 0)
            close(file);
        return false;
    }
    bool good = S_ISREG(info.st_mode);
    *problem = good ? NULL : S_ISDIR(info.st_mode) ? "it is a directory" : "it is not a regular file";
    for (*len = 0; good && *len < size;) {
        ssize_t got = read(file, bytes + *len, size - *len);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0) {
            *problem = "it cannot be read";
            good = false;
        }
        if (got <= 0)
            break;
        *len += (size_t)got;
    }
    close(file);
    return good;
}

// Reads and parses the file of an entry. Allocates memory before opening the file, because a failed allocation does not
// return (base/arena.h) and would leave the file open.
static const void *load_entry(const BuiltinContext *context, FileEntry *entry, const char *path, const char **problem) {
    if (entry->stamp.error) {
        file_access_report(context->file_access, path, (Str){0});
        *problem = describe_error(entry->stamp.error);
        return NULL;
    }
    if (entry->stamp.size > MAX_FILE_SIZE) {
        *problem = "it is larger than 1 GiB";
        return NULL;
    }
    size_t size = (size_t)entry->stamp.size, len;
    char *bytes = arena_alloc(&entry->arena, size);
    bool read = read_file_bytes(context, path, bytes, size, &len, problem);
    file_access_report(context->file_access, path, read ? (Str){bytes, len} : (Str){0});
    if (!read)
        return NULL;
    return entry->parse(&entry->arena, bytes, len, problem);
}

// --- entries

typedef struct EntryKey {
    Str path;
    FileParse *parse;
} EntryKey;

static bool entry_matches(const void *owner, uint32_t entry, const void *key) {
    const FileEntry *found = ((const FileCache *)owner)->entries[entry];
    const EntryKey *wanted = key;
    return found->parse == wanted->parse && str_equal(found->path, wanted->path);
}

static FileEntry *entry_add(FileCache *cache, const EntryKey *key, uint64_t hash) {
    if (cache->count == MAX_CACHE_ENTRIES)
        file_cache_clear(cache);
    cache->entries =
        arena_grow_array(&cache->arena, cache->entries, cache->count, &cache->capacity, sizeof *cache->entries);
    FileEntry *entry = arena_alloc(&cache->arena, sizeof *entry);
    *entry = (FileEntry){.path = str_copy(&cache->arena, key->path), .parse = key->parse};
    arena_init(&entry->arena, "file", SIZE_MAX);
    if (!hash_index_add(&cache->index, hash, cache->count))
        arena_exhausted(&cache->arena);
    cache->entries[cache->count++] = entry;
    return entry;
}

static FileEntry *entry_get(FileCache *cache, Str path, FileParse *parse) {
    EntryKey key = {path, parse};
    uint64_t hash = hash_bytes(0, path.bytes, path.len);
    uint32_t found = hash_index_find(&cache->index, hash, entry_matches, cache, &key);
    return found != HASH_INDEX_NONE ? cache->entries[found] : entry_add(cache, &key, hash);
}

// Makes room for the file of the entry `kept`, which is about to be read. If the cache would exceed MAX_CACHED_BYTES,
// frees the contents of all other entries. They are read again when needed.
static void evict_entries(FileCache *cache, const FileEntry *kept) {
    size_t used = 0;
    for (uint32_t i = 0; i < cache->count; i++)
        used += cache->entries[i]->arena.used;
    if (used + (size_t)kept->stamp.size <= MAX_CACHED_BYTES)
        return;
    for (uint32_t i = 0; i < cache->count; i++)
        if (cache->entries[i] != kept && cache->entries[i]->parsed) {
            arena_free(&cache->entries[i]->arena);
            cache->entries[i]->parsed = NULL;
            cache->entries[i]->tried = false;
        }
}

static void report_unreadable(BuiltinContext *context, const char *function, Str name, const char *problem) {
    int len = name.len < 200 ? (int)name.len : 200;
    builtin_error(context, function, "cannot read '%.*s': %s", len, name.bytes, problem);
}

const void *file_cache_get(BuiltinContext *context, const char *function, FileParse *parse, Value name) {
    FileCache *cache = context->files;
    Str text = value_text(context->arena, context->symbols, name);
    bool nameable = text.len <= MAX_NAME_LENGTH && context->directory.len <= MAX_NAME_LENGTH &&
                    (text.len == 0 || !memchr(text.bytes, 0, text.len));
    if (!cache || !nameable) {
        report_unreadable(context, function, text,
                          cache ? "this cannot be a file name" : "files are not available here");
        return NULL;
    }
    // A failed allocation in the cache's arena must be handled like one in the call's arena.
    cache->arena.escape = context->arena->escape;
    Str path = path_join(context->arena, context->directory, text);
    const char *c_path = str_to_c(context->arena, path);
    FileEntry *entry = entry_get(cache, path, parse);
    Stamp stamp = read_stamp(context->file_access, c_path);
    if (entry->tried && stamp_equal(&entry->stamp, &stamp))
        return entry->parsed;
    arena_free(&entry->arena);
    entry->arena.escape = context->arena->escape;
    entry->tried = false;
    entry->stamp = stamp;
    entry->parsed = NULL;
    evict_entries(cache, entry);
    const char *problem = NULL;
    entry->parsed = load_entry(context, entry, c_path, &problem);
    entry->tried = true;
    if (!entry->parsed) {
        report_unreadable(context, function, text, problem);
        arena_free(&entry->arena); // can hold the text of the problem
    }
    return entry->parsed;
}

// --- parsers

bool file_is_text(const char *bytes, size_t len, const char **problem) {
    bool good = utf8_find_error((Str){bytes, len}) == len;
    if (!good)
        *problem = "it is not UTF-8 text";
    return good;
}

static const Str *contents_new(Arena *arena, const char *bytes, size_t len) {
    Str contents = {bytes, len};
    return arena_copy(arena, &contents, sizeof contents);
}

static const void *parse_text(Arena *arena, char *bytes, size_t len, const char **problem) {
    if (!file_is_text(bytes, len, problem))
        return NULL;
    return contents_new(arena, bytes, source_unify_lines(bytes, len));
}

static const void *parse_bytes(Arena *arena, char *bytes, size_t len, const char **problem) {
    return contents_new(arena, bytes, len);
}

Value builtin_read(BuiltinContext *context, const Value *args, uint32_t count) {
    if (value_text(context->arena, context->symbols, args[0]).len == 0)
        return VALUE_NULL;
    const Str *text = file_cache_get(context, "read", parse_text, args[0]);
    return text ? value_string(context->arena, *text) : VALUE_NULL;
}

Value builtin_read_bytes(BuiltinContext *context, const Value *args, uint32_t count) {
    const Str *contents = file_cache_get(context, "read_bytes", parse_bytes, args[0]);
    if (!contents || contents->len == 0)
        return VALUE_NULL;
    if (contents->len > VALUE_MAX_LEN)
        return builtin_too_long(context, "read_bytes");
    const unsigned char *bytes = (const unsigned char *)contents->bytes;
    double *result = arena_alloc_array(context->arena, contents->len, sizeof *result);
    for (size_t i = 0; i < contents->len; i++)
        result[i] = bytes[i];
    return value_numbers_view(result, (uint32_t)contents->len);
}
