// read_files.c: see read_files.h.
#include "sweep/read_files.h"

#include "base/file.h"
#include "base/os.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct KnownHash {
    char *path;
    struct stat info; // of the file when it was hashed
    char hash[SHA256_DIGITS + 1];
};

void read_files_add(ReadFiles *files, const char *name, const char *bytes, size_t length) {
    ReadFile read = {.hash = "-"};
    if (bytes) // the digits are followed by zeros
        sha256_of(bytes, length, read.hash);
    files->changed = files->changed || str_ends_with(str_from(name), STR("/"));
    for (size_t i = 0; i < files->count; i++) {
        ReadFile *file = &files->items[i];
        if (strcmp(file->name, name) == 0) {
            files->changed = files->changed || strcmp(file->hash, read.hash) != 0;
            memcpy(file->hash, read.hash, sizeof read.hash);
            return;
        }
    }
    read.name = memory_strdup(name);
    files->items = memory_realloc(files->items, (files->count + 1) * sizeof read);
    files->items[files->count++] = read;
}

void read_files_free(ReadFiles *files) {
    for (size_t i = 0; i < files->count; i++)
        free(files->items[i].name);
    free(files->items);
    *files = (ReadFiles){0};
}

bool read_files_write(const ReadFiles *files, Text *text) {
    bool good = true;
    for (size_t i = 0; i < files->count; i++) {
        good = good && !strchr(files->items[i].name, '\n');
        text_add_format(text, "file %s %s\n", files->items[i].hash, files->items[i].name);
    }
    return good;
}

static bool same_time(struct timespec a, struct timespec b) {
    return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

static bool is_same_version(const struct stat *a, const struct stat *b) {
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino && a->st_size == b->st_size &&
           same_time(os_time_modified(a), os_time_modified(b)) && same_time(os_time_changed(a), os_time_changed(b));
}

// Hashes a regular file. Returns false if it cannot be read or is too large.
static bool hash_contents(KnownHashes *known, const char *path, char hash[SHA256_DIGITS + 1]) {
    enum { BLOCK = 1 << 16, MAX_FILE_BYTES = 1 << 30 }; // the limit of `read` and `csv`
    const uint64_t max_entry_bytes = UINT64_C(4) << 30;
    char block[BLOCK];
    struct stat info;
    Sha256 sum = sha256_new();
    int file = file_open_at(AT_FDCWD, path, O_RDONLY | O_NONBLOCK, 0);
    if (file < 0)
        return false;
    ssize_t got = fstat(file, &info) == 0 && S_ISREG(info.st_mode) && info.st_size <= MAX_FILE_BYTES ? 1 : -1;
    for (size_t length = 0; got > 0; length += (size_t)got) {
        got = length > MAX_FILE_BYTES || known->hashed > max_entry_bytes ? -1 : file_read_some(file, block, BLOCK);
        if (got > 0)
            sha256_add(&sum, block, (size_t)got);
        known->hashed += got > 0 ? (size_t)got : 0;
    }
    close(file);
    sha256_end(&sum, hash);
    hash[SHA256_DIGITS] = '\0';
    return got == 0;
}

// Returns the hash of a file, or "-" if it cannot be read.
static const char *hash_file(KnownHashes *known, const char *path) {
    struct stat info;
    char hash[SHA256_DIGITS + 1];
    KnownHash *found = NULL;
    if (stat(path, &info) != 0)
        return "-";
    for (size_t i = 0; i < known->count && !found; i++)
        found = strcmp(known->items[i].path, path) == 0 ? &known->items[i] : NULL;
    if (found && is_same_version(&found->info, &info))
        return found->hash;
    if (!hash_contents(known, path, hash))
        return "-";
    if (!found) {
        known->items = memory_realloc(known->items, (known->count + 1) * sizeof *found);
        found = &known->items[known->count++];
        *found = (KnownHash){.path = memory_strdup(path)};
    }
    found->info = info;
    memcpy(found->hash, hash, sizeof hash);
    return found->hash;
}

bool read_file_is_unchanged(KnownHashes *known, Str folder, Str line) {
    SCOPED_STRING copy = memory_strndup(line.bytes, line.len);
    SCOPED_TEXT path = {0};
    const size_t start = strlen("file ");
    char *hash = line.len > start ? copy + start : copy + line.len, *name = strchr(hash, ' ');
    if (!name)
        return false;
    *name++ = '\0';
    text_add_format(&path, "%.*s%s", name[0] == '/' ? 0 : (int)folder.len, folder.len ? folder.bytes : "", name);
    return strcmp(hash, hash_file(known, path.bytes)) == 0;
}

void known_hashes_free(KnownHashes *known) {
    for (size_t i = 0; i < known->count; i++)
        free(known->items[i].path);
    free(known->items);
    *known = (KnownHashes){0};
}
