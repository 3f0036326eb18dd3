// file.c: see file.h.
//
// A failed allocation in an arena does not return. So while a file is open, functions allocate from an arena only
// within arena_protect, which lets them close the file.
#include "base/file.h"

#include "base/os.h"
#include "base/replace.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static Str version_of(Arena *arena, const struct stat *info) {
    struct timespec modified = os_time_modified(info);
    return str_format(arena, "%lld.%ld %lld %llu", (long long)modified.tv_sec, (long)modified.tv_nsec,
                      (long long)info->st_size, (unsigned long long)info->st_ino);
}

bool file_exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

// A host must not change the bytes of a file without returning a new pointer, so the pointer identifies the version.
static Str version_of_bytes(Arena *arena, Str bytes) {
    return str_format(arena, "%p %zu", (const void *)bytes.bytes, bytes.len);
}

bool file_version(Arena *arena, const FileAccess *file_access, const char *path, Str *version) {
    Str bytes;
    if (file_access && file_access->read_file) {
        bool exists = file_access_read(file_access, path, &bytes);
        if (exists)
            *version = version_of_bytes(arena, bytes);
        return exists;
    }
    if (file_access_read_unsaved(file_access, path, &bytes)) {
        *version = version_of_bytes(arena, bytes);
        return true;
    }
    struct stat info;
    int file = file_access ? file_access_open(file_access, path, O_RDONLY | O_NONBLOCK) : -1;
    bool found = file_access ? file >= 0 && fstat(file, &info) == 0 : stat(path, &info) == 0;
    if (file >= 0)
        close(file);
    if (found)
        *version = version_of(arena, &info);
    return found;
}

ssize_t file_read_some(int file, void *bytes, size_t len) {
    ssize_t got;
    do
        got = read(file, bytes, len);
    while (got < 0 && errno == EINTR);
    return got;
}

bool file_read_bytes(int file, void *bytes, size_t len) {
    for (char *at = bytes; len > 0;) {
        ssize_t got = file_read_some(file, at, len);
        if (got <= 0)
            return false;
        at += got;
        len -= (size_t)got;
    }
    return true;
}

bool text_read(Text *text, int file, size_t max_len) {
    enum { BLOCK = 1 << 16 };
    ssize_t got = 1;
    text_add_c(text, "");
    while (got != 0 && text->len <= max_len) {
        if (text->capacity - text->len < 2)
            text_reserve(text, text->len > BLOCK ? text->len : BLOCK);
        got = file_read_some(file, text->bytes + text->len, text->capacity - text->len - 1);
        if (got < 0)
            return false;
        text->len += (size_t)got;
        text->bytes[text->len] = 0;
    }
    return true;
}

// Returns the reason why a file cannot be read as a whole, or NULL.
static const char *check_file(const struct stat *info, bool regular, size_t limit) {
    if (S_ISDIR(info->st_mode))
        return "it is a directory";
    if (regular && !S_ISREG(info->st_mode))
        return "it is not a regular file";
    return info->st_size > 0 && (uintmax_t)info->st_size > limit ? "it is too large" : NULL;
}

// Adds at most `limit` bytes of an open file. Returns the reason for a failure, or NULL.
static const char *read_limited(Text *text, int file, size_t limit) {
    size_t end = limit > SIZE_MAX - text->len ? SIZE_MAX : text->len + limit;
    if (!text_read(text, file, end))
        return strerror(errno);
    return text->len > end ? "it is too large" : NULL;
}

const char *text_read_regular(Text *text, int file, size_t limit) {
    struct stat info;
    const char *problem = file < 0 || fstat(file, &info) != 0 ? strerror(errno) : check_file(&info, true, limit);
    text_add_c(text, "");
    if (!problem)
        problem = read_limited(text, file, limit);
    if (file >= 0)
        close(file);
    return problem;
}

const char *text_read_file(Text *text, const char *path, size_t limit) {
    return text_read_regular(text, file_open_at(AT_FDCWD, path, O_RDONLY | O_NONBLOCK, 0), limit);
}

typedef struct FileReading {
    Text text;
    int file;
    size_t expected;
    size_t limit;
    const char *problem; // NULL: success
} FileReading;

static void read_all(void *context) {
    FileReading *reading = context;
    text_reserve(&reading->text, reading->expected);
    reading->problem = read_limited(&reading->text, reading->file, reading->limit);
}

static bool copy_host_file(Arena *arena, Str host_bytes, size_t limit, Str *bytes, Str *version, const char **problem) {
    *problem = host_bytes.len > limit ? "it is too large" : NULL;
    if (*problem)
        return false;
    if (version)
        *version = version_of_bytes(arena, host_bytes);
    *bytes = str_copy(arena, host_bytes);
    return true;
}

static bool read_file(Arena *arena, const FileAccess *file_access, const char *path, bool regular, size_t limit,
                      Str *bytes, Str *version, const char **problem) {
    Str host_bytes;
    if (file_access && file_access->read_file && !file_access_read(file_access, path, &host_bytes)) {
        *problem = strerror(errno);
        return false;
    }
    if (file_access && (file_access->read_file || file_access_read_unsaved(file_access, path, &host_bytes)))
        return copy_host_file(arena, host_bytes, limit, bytes, version, problem);
    int file =
        file_access_open(file_access, path, O_RDONLY | (regular ? O_NONBLOCK : 0)); // opening a pipe must not block
    struct stat info;
    if (file < 0 || fstat(file, &info) != 0) {
        *problem = file_access && errno == EXDEV ? file_access_reason(arena, file_access, FILE_ACCESS_READ, path)
                                                 : strerror(errno);
        if (file >= 0)
            close(file);
        return false;
    }
    FileReading reading = {.text = text_new(arena),
                           .file = file,
                           .expected = info.st_size > 0 ? (size_t)info.st_size + 1 : 4096,
                           .limit = limit,
                           .problem = check_file(&info, regular, limit)};
    ArenaOutcome outcome = ARENA_OK;
    if (version)
        *version = (Str){0};
    if (!reading.problem)
        outcome = arena_protect(&arena, 1, read_all, &reading);
    close(file);
    if (outcome != ARENA_OK)
        arena_escape(arena, outcome); // does not return, so the file was closed before
    if (version && !reading.problem)
        *version = version_of(arena, &info);
    *bytes = text_str(&reading.text);
    *problem = reading.problem;
    return !reading.problem;
}

bool file_read(Arena *arena, const FileAccess *file_access, const char *path, bool regular, size_t limit, Str *bytes,
               Str *version, const char **problem) {
    bool read = read_file(arena, file_access, path, regular, limit, bytes, version, problem);
    file_access_report(file_access, path, read ? *bytes : (Str){0});
    return read;
}

int file_open_at(int folder, const char *name, int flags, mode_t mode) {
    int file;
    do
        file = openat(folder, name, flags | O_CLOEXEC | O_NOCTTY, mode);
    while (file < 0 && errno == EINTR);
    return file;
}

bool file_write(int file, const char *bytes, size_t len) {
    while (len > 0) {
        ssize_t put = write(file, bytes, len);
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            return false;
        bytes += put;
        len -= (size_t)put;
    }
    return true;
}

bool file_truncate(int file, size_t len) {
    int result;
    do
        result = ftruncate(file, (off_t)len);
    while (result != 0 && errno == EINTR);
    return result == 0;
}

const char *file_replace(const char *path, Str bytes, unsigned flags) {
    Replacement replacement;
    if (!replace_begin(&replacement, path, flags))
        return strerror(errno);
    return file_finish(&replacement, bytes);
}

const char *file_finish(Replacement *replacement, Str bytes) {
    if (file_write(replacement->file, bytes.bytes, bytes.len))
        return replace_commit(replacement) ? NULL : strerror(errno);
    const char *problem = strerror(errno);
    replace_abort(replacement);
    return problem;
}

bool file_resolve(const char *path, char resolved[PATH_MAX]) {
    enum { MAX_LINKS = 40 };
    char at[PATH_MAX], link[PATH_MAX];
    if (snprintf(at, sizeof at, "%s", path) >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return false;
    }
    for (int i = 0; i < MAX_LINKS; i++) {
        if (realpath(at, resolved))
            return true;
        // The last component is allowed to be missing, or to be a link to a missing file.
        char *slash = strrchr(at, '/'), *name = slash ? slash + 1 : at;
        if (errno != ENOENT || name[0] == '\0' || strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
            return false;
        char first = name[0];
        name[0] = '\0';
        if (!realpath(slash ? at : ".", resolved))
            return false;
        name[0] = first;
        size_t folder = strcmp(resolved, "/") == 0 ? 0 : strlen(resolved);
        if (folder + 1 + strlen(name) >= PATH_MAX) {
            errno = ENAMETOOLONG;
            return false;
        }
        resolved[folder] = '/';
        memcpy(resolved + folder + 1, name, strlen(name) + 1);
        ssize_t length = readlink(resolved, link, sizeof link - 1);
        if (length < 0)
            return errno == ENOENT;
        link[length] = '\0';
        resolved[folder + 1] = '\0';
        if (snprintf(at, sizeof at, "%s%s", link[0] == '/' ? "" : resolved, link) >= PATH_MAX) {
            errno = ENAMETOOLONG;
            return false;
        }
    }
    errno = ELOOP;
    return false;
}

Str file_canonical(Arena *arena, const FileAccess *file_access, const char *path) {
    char resolved[PATH_MAX];
    if (file_access && file_access->read_file)
        return str_copy(arena, str_from(file_access_normalise(path, resolved) ? resolved : path));
    return str_copy(arena, str_from(realpath(path, resolved) ? resolved : path));
}
