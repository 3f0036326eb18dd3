// cache.c: see cache.h.
#include "sweep/cache.h"

#include "base/file.h"
#include "base/replace.h"
#include "base/source.h"
#include "cli/state_text.h"
#include "sweep/options.h"
#include "sweep/table.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { KEY_PREFIX = 2, MAX_ENTRY_BYTES = 256 << 20 };

static bool make_folder(const char *path) {
    return mkdir(path, 0777) == 0 || errno == EEXIST;
}

bool cache_open(const Sweep *sweep) {
    const char *folder = sweep->own->cache;
    struct stat info;
    bool good = !folder || (make_folder(folder) && stat(folder, &info) == 0 && S_ISDIR(info.st_mode));
    if (!good)
        message("cannot use the cache '%s': %s", folder, errno == EEXIST ? "it is not a folder" : strerror(errno));
    return good;
}

static void add_text(Sha256 *hash, const char *text) {
    sha256_add(hash, text, strlen(text) + 1);
}

void cache_key(const Sweep *sweep, size_t run, char key[SHA256_DIGITS + 1]) {
    Sha256 hash = sha256_new();
    add_text(&hash, "petri sweep result 2");
    add_text(&hash, sweep->settings);
    for (size_t i = 0; i < sweep->design.axis_count; i++)
        add_text(&hash, design_value(&sweep->design, run, i));
    sha256_end(&hash, key);
    key[SHA256_DIGITS] = '\0';
}

// Opens the folder of an entry. `create`: if it does not exist, it is created. Does not follow a symbolic link, because
// the cache can be from someone else. Returns -1 with errno set on failure.
static int open_folder(const Sweep *sweep, const char *key, bool create) {
    char name[KEY_PREFIX + 1] = "";
    memcpy(name, key, KEY_PREFIX);
    int cache = file_open_at(AT_FDCWD, sweep->own->cache, O_RDONLY | O_DIRECTORY, 0), folder = -1;
    if (cache < 0)
        return -1;
    if (!create || mkdirat(cache, name, 0777) == 0 || errno == EEXIST)
        folder = file_open_at(cache, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW, 0);
    int error = errno;
    close(cache);
    errno = error;
    return folder;
}

static void add_head(const char *key, Text *text) {
    text_add_format(text, "petri sweep result 2\nkey %s\n", key);
}

// Removes the checksum at the end of an entry. Returns false if it is not that of the text before it.
static bool remove_checksum(Text *text) {
    static const char name[] = "sha256 ";
    const size_t length = sizeof name - 1 + SHA256_DIGITS + 1;
    char digits[SHA256_DIGITS];
    if (text->len < length || memcmp(text->bytes + text->len - length, name, sizeof name - 1) != 0)
        return false;
    sha256_of(text->bytes, text->len - length, digits);
    bool good = memcmp(digits, text->bytes + text->len - SHA256_DIGITS - 1, SHA256_DIGITS) == 0;
    text->len -= length;
    return good;
}

static void add_checksum(Text *text) {
    char digits[SHA256_DIGITS];
    sha256_of(text->bytes, text->len, digits);
    text_add_format(text, "sha256 %.*s\n", SHA256_DIGITS, digits);
}

// Reads the lines of an entry after its files. Returns false if they are not valid.
static bool read_result(const Sweep *sweep, const Text *text, size_t at, CacheEntry *entry) {
    size_t length = 0;
    int used = -1;
    text->bytes[text->len] = '\0';
    if (sscanf(text->bytes + at, "frames %" SCNd64 "\ndigest %32[0-9a-f]\nrows %zu%n", &entry->frames, entry->digest,
               &length, &used) != 3 ||
        used < 0 || text->bytes[at + (size_t)used] != '\n' || strlen(entry->digest) != CACHE_DIGEST_DIGITS)
        return false;
    at += (size_t)used + 1;
    Str rows = {text->bytes + at, length};
    if (at == text->len || text->len - at - 1 != length || text->bytes[text->len - 1] != '\n' ||
        !rows_are_valid(sweep, rows))
        return false;
    text_add(&entry->rows, rows);
    return true;
}

// Reads an entry whose checksum was correct.
static CacheAnswer read_entry(const Sweep *sweep, const char *key, KnownHashes *known, const Text *text,
                              CacheEntry *entry) {
    SCOPED_TEXT head = {0};
    Str folder = path_directory(str_from(sweep->options->script)), line;
    add_head(key, &head);
    if (text->len < head.len || memcmp(text->bytes, head.bytes, head.len) != 0)
        return CACHE_DAMAGED;
    size_t at = head.len, next = at;
    for (; text_next_line(text, &next, &line) && str_starts_with(line, STR("file ")); at = next)
        if (!read_file_is_unchanged(known, folder, line))
            return CACHE_MISSING;
    return read_result(sweep, text, at, entry) ? CACHE_FOUND : CACHE_DAMAGED;
}

CacheAnswer cache_find(const Sweep *sweep, const char *key, KnownHashes *known, CacheEntry *entry) {
    SCOPED_TEXT text = {0};
    *entry = (CacheEntry){0};
    int folder = open_folder(sweep, key, false);
    int file = folder < 0 ? -1 : file_open_at(folder, key, O_RDONLY | O_NOFOLLOW | O_NONBLOCK, 0);
    bool missing = file < 0 && errno == ENOENT;
    if (folder >= 0)
        close(folder);
    if (missing)
        return CACHE_MISSING;
    known->hashed = 0;
    CacheAnswer answer = text_read_regular(&text, file, MAX_ENTRY_BYTES) || !remove_checksum(&text)
                             ? CACHE_DAMAGED
                             : read_entry(sweep, key, known, &text, entry);
    if (answer != CACHE_FOUND)
        cache_entry_free(entry);
    return answer;
}

// Returns why an entry cannot be written, from errno. The folder of the entry is open or, if `folder` < 0, is not.
static const char *write_problem(int folder) {
    if (folder < 0 && (errno == ELOOP || errno == ENOTDIR))
        return "one of its folders is a file or a symbolic link";
    if (folder >= 0 && errno == ELOOP)
        return "one of its entries is a symbolic link";
    return folder >= 0 && (errno == ENXIO || errno == EISDIR) ? "one of its entries is not a regular file"
                                                              : strerror(errno);
}

const char *cache_store(const Sweep *sweep, const char *key, const ReadFiles *files, const CacheEntry *entry) {
    SCOPED_TEXT text = {0};
    Replacement replacement;
    add_head(key, &text);
    if (files->changed || !read_files_write(files, &text))
        return NULL;
    text_add_format(&text, "frames %" PRId64 "\ndigest %s\nrows %zu\n", entry->frames, entry->digest, entry->rows.len);
    text_add(&text, text_str(&entry->rows));
    text_add_char(&text, '\n');
    add_checksum(&text);
    if (text.len > MAX_ENTRY_BYTES)
        return "a result has more than 256 MiB";
    int folder = open_folder(sweep, key, true);
    if (folder < 0 || !replace_begin_in(&replacement, folder, key, 0))
        return write_problem(folder);
    return file_finish(&replacement, (Str){text.bytes, text.len});
}

void cache_entry_free(CacheEntry *entry) {
    text_free(&entry->rows);
}

bool cache_should_verify(const Sweep *sweep, const char *key) {
    uint32_t number = 0;
    sscanf(key, "%8" SCNx32, &number);
    return number < sweep->own->verify_cache / 100 * 0x1p32;
}

// Appends the first metric that differs in two rows, of which the frames were read. Returns false if none differs; the
// rows were then read.
static bool add_metric(const Sweep *sweep, int64_t frame, Str rows[2], Text *report) {
    static const char *const no_positions[2];
    Cell cell;
    for (size_t i = 0; i < sweep->metric_count; i++) {
        SCOPED_TEXT stored = {0}, computed = {0};
        if (cell_next(&rows[0], &cell))
            row_add_text(sweep, i, cell, &stored);
        if (cell_next(&rows[1], &cell))
            row_add_text(sweep, i, cell, &computed);
        Str values[] = {text_str(&stored), text_str(&computed)};
        if (!str_equal(values[0], values[1])) {
            text_add_format(report, "frame %" PRId64 ": metric %s\n", frame, sweep->metrics[i].name);
            state_add_values(report, values, no_positions);
            return true;
        }
    }
    return !cell_next(&rows[0], &cell) || !cell_next(&rows[1], &cell); // the errors
}

// Appends the first row that differs.
static void add_row(const Sweep *sweep, const CacheEntry *stored, const CacheEntry *computed, Text *report) {
    Str rows[2] = {text_str(&stored->rows), text_str(&computed->rows)};
    Cell frames[2];
    while (cell_next(&rows[0], &frames[0]) && cell_next(&rows[1], &frames[1]) &&
           frames[0].as.integer == frames[1].as.integer)
        if (add_metric(sweep, frames[0].as.integer, rows, report))
            return;
    if (stored->frames != computed->frames)
        text_add_format(report, "the run has %" PRId64 " frames, not %" PRId64 "\n", computed->frames, stored->frames);
    else
        text_add_format(report, "the metrics are the same, but the state after frame %" PRId64 " differs\n",
                        stored->frames - 1);
}

void cache_compare(const Sweep *sweep, size_t run, const CacheEntry *stored, const CacheEntry *computed, Text *report) {
    bool same = stored->frames == computed->frames && strcmp(stored->digest, computed->digest) == 0 &&
                str_equal(text_str(&stored->rows), text_str(&computed->rows));
    if (same)
        return;
    text_add_format(report, "petri: run %zu differs from its result in the cache\n--- cache\n+++ computed\n", run + 1);
    add_row(sweep, stored, computed, report);
    text_add_c(report, "  to find the first force that differs, run: ");
    int64_t frames = stored->frames > computed->frames ? stored->frames : computed->frames;
    table_diff_command(sweep, run, frames, report);
    text_add_c(report, " --with PROGRAM, where PROGRAM is the petri that filled the cache\n");
}
