// read_files.c: see read_files.h.
#include "sweep/read_files.h"

#include "base/file.h"
#include "base/os.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

// Returns the hash of a file, or "-" if it cannot be read.
static const char *hash_file(KnownHashes *known, const char *path) {
    struct stat info;
    SCOPED_TEXT text = {0};
    KnownHash *found = NULL;
    if (stat(path, &info) != 0)
        return "-";
    for (size_t i = 0; i < known->count && !found; i++)
        found = strcmp(known->items[i].path, path) == 0 ? &known->items[i] : NULL;
    if (found && is_same_version(&found->info, &info))
        return found->hash;
    if (text_read_file(&text, path, SIZE_MAX))
        return "-";
    if (!found) {
        known->items = memory_realloc(known->items, (known->count + 1) * sizeof *found);
        found = &known->items[known->count++];
        *found = (KnownHash){.path = memory_strdup(path)};
    }
    found->info = info;
    sha256_of(text.bytes, text.len, found->hash);
    found->hash[SHA256_DIGITS] = '\0';
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
