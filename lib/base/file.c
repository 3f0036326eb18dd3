// file.c: see file.h.
#include "base/file.h"

#include "base/source.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static Str version_of(Arena *arena, const struct stat *info) {
    return str_format(arena, "%lld.%ld %lld %llu", (long long)info->st_mtim.tv_sec, (long)info->st_mtim.tv_nsec,
                      (long long)info->st_size, (unsigned long long)info->st_ino);
}

bool file_exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

bool file_version(Arena *arena, const char *path, Str *version) {
    struct stat info;
    if (stat(path, &info) != 0)
        return false;
    *version = version_of(arena, &info);
    return true;
}

typedef struct Reading {
    Arena *arena;
    int file;
    size_t expected;
    size_t limit;
    Str bytes;
    const char *problem; // NULL: all was read
} Reading;

// Reads to the end of the file, or to just beyond the limit.
static void read_all(void *context) {
    Reading *reading = context;
    size_t capacity = reading->expected + 1, len = 0;
    char *buffer = arena_alloc(reading->arena, capacity);
    for (;;) {
        if (len + 1 >= capacity) {
            buffer = arena_grow(reading->arena, buffer, capacity, capacity * 2);
            capacity *= 2;
        }
        ssize_t got = read(reading->file, buffer + len, capacity - len - 1);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            reading->problem = strerror(errno);
        else if ((len += (size_t)got) > reading->limit)
            reading->problem = "it is too large";
        if (got <= 0 || reading->problem)
            break;
    }
    buffer[len] = 0;
    reading->bytes = (Str){buffer, len};
}

bool file_read(Arena *arena, const char *path, bool regular, size_t limit, Str *bytes, Str *version,
               const char **problem) {
    int file = open(path, O_RDONLY | O_CLOEXEC | (regular ? O_NONBLOCK : 0)); // opening a pipe must not wait
    struct stat info;
    if (file < 0 || fstat(file, &info) != 0) {
        *problem = strerror(errno);
        if (file >= 0)
            close(file);
        return false;
    }
    Reading reading = {arena, file, info.st_size > 0 ? (size_t)info.st_size + 1 : 4096, limit, {0}, NULL};
    ArenaEnd end = ARENA_DONE;
    if (version)
        *version = (Str){0};
    if (S_ISDIR(info.st_mode)) {
        reading.problem = "it is a directory";
    } else if (regular && !S_ISREG(info.st_mode)) {
        reading.problem = "it is not a regular file";
    } else if (info.st_size > 0 && (size_t)info.st_size > limit) {
        reading.problem = "it is too large";
    } else {
        end = arena_protect(&arena, 1, read_all, &reading);
    }
    close(file);
    if (end != ARENA_DONE)
        arena_leave(arena, end); // now that the file is closed
    if (version && !reading.problem)
        *version = version_of(arena, &info);
    *bytes = reading.bytes;
    *problem = reading.problem;
    return !reading.problem;
}

static bool write_all(int file, Str bytes) {
    while (bytes.len > 0) {
        ssize_t put = write(file, bytes.bytes, bytes.len);
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            return false;
        bytes = (Str){bytes.bytes + put, bytes.len - (size_t)put};
    }
    return true;
}

// The directory entry must reach the disk too; some file systems refuse to sync a directory, which is no failure.
static void sync_directory(const char *directory) {
    int file = open(directory, O_RDONLY | O_CLOEXEC | O_DIRECTORY);
    if (file >= 0) {
        fsync(file);
        close(file);
    }
}

bool file_replace(Arena *arena, const char *path, Str bytes, const char **problem) {
    Str canonical = file_canonical(arena, path); // a symbolic link stays one
    const char *target = canonical.bytes;
    Str folder = path_directory(canonical);
    const char *directory = folder.len ? str_to_c(arena, folder) : "."; // all memory is had before anything is done
    char *beside = str_to_c(arena, str_format(arena, "%s.%ld.tmp", target, (long)getpid()));
    int file = open(beside, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) {
        *problem = strerror(errno);
        return false;
    }
    struct stat info;
    if (stat(target, &info) == 0)
        (void)!fchmod(file, info.st_mode & 07777);
    bool written = write_all(file, bytes) && fsync(file) == 0;
    int error = errno; // of what failed first
    if (close(file) != 0 && written) {
        written = false;
        error = errno;
    }
    if (written && rename(beside, target) == 0) {
        sync_directory(directory);
        return true;
    }
    *problem = strerror(written ? errno : error);
    unlink(beside);
    return false;
}

Str file_canonical(Arena *arena, const char *path) {
    char resolved[PATH_MAX];
    return str_copy(arena, str_from(realpath(path, resolved) ? resolved : path));
}
