// watch.c: `petri test --watch`: which tests a changed file affects; see suite.h.
//
// A test depends on its script, its recorded output and each file that a string in one of its scripts names, such as a
// module, a script that it includes, or data.
#include "base/file.h"
#include "base/os.h"
#include "base/source.h"
#include "cli/file_watch.h"
#include "golden/suite.h"

#include <limits.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { POLL_MS = 100 };

static struct stat about_file(const char *path) {
    struct stat about;
    if (stat(path, &about) != 0)
        memset(&about, 0, sizeof about);
    return about;
}

static bool same_version(const struct stat *a, const struct stat *b) {
    struct timespec first = os_time_modified(a), second = os_time_modified(b);
    return a->st_ino == b->st_ino && a->st_size == b->st_size && first.tv_sec == second.tv_sec &&
           first.tv_nsec == second.tv_nsec;
}

static void add_file(Watch *watch, const char *path) {
    for (size_t i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0)
            return;
    if ((watch->count & (watch->count + 1)) == 0) // there is room for the next power of two
        watch->files = memory_realloc(watch->files, 2 * (watch->count + 1) * sizeof *watch->files);
    watch->files[watch->count] = (WatchedFile){.path = memory_strdup(path), .version = about_file(path)};
    file_watch_add(watch->watch, path);
    watch->count++;
}

static void add_names(TextList *files, const char *script);

// Adds a file that a string in a script names, and what it names in turn.
static void add_name(TextList *files, const char *folder, Str name) {
    SCOPED_TEXT path = {0};
    if (name.len == 0 || name.len > NAME_MAX || memchr(name.bytes, '\0', name.len))
        return;
    bool below = name.bytes[0] != '/' && strcmp(folder, ".") != 0;
    text_add_format(&path, "%s%.*s", below ? folder : "", STR_ARGS(name));
    struct stat about = about_file(path.bytes);
    if (!S_ISREG(about.st_mode) || texts_contain(files, path.bytes))
        return;
    texts_add(files, path.bytes);
    if (str_ends_with(name, STR(".fl")))
        add_names(files, path.bytes);
}

// Adds the files that the strings of a script name. Strings within comments do no harm.
static void add_names(TextList *files, const char *script) {
    enum { MAX_BYTES = 1 << 24 };
    SCOPED_STRING folder = memory_folder(script);
    SCOPED_TEXT text = {0};
    if (text_read_file(&text, script, MAX_BYTES))
        return;
    text_add_c(&text, "");
    for (const char *at = strpbrk(text.bytes, "'\""); at; at = strpbrk(at, "'\"")) {
        size_t length = strcspn(at + 1, at[0] == '"' ? "\"\n" : "'\n");
        add_name(files, folder, (Str){at + 1, length});
        at += at[length + 1] == at[0] ? length + 2 : 1;
    }
}

// Returns the files on which a test depends.
static TextList files_of(const TestCase *test) {
    TextList files = {0};
    texts_add(&files, test->script);
    texts_add(&files, test->recorded);
    add_names(&files, test->script);
    return files;
}

Watch *watch_new(const TestList *tests) {
    Watch *watch = memory_calloc(sizeof *watch);
    watch->watch = file_watch_new();
    for (size_t i = 0; i < tests->count; i++) {
        TextList files = files_of(&tests->items[i]);
        for (size_t k = 0; k < files.count; k++)
            add_file(watch, files.items[k]);
        texts_free(&files);
    }
    return watch;
}

// Marks the files that have changed since the last call. Returns true if there are any.
static bool find_changes(Watch *watch) {
    bool found = false;
    for (size_t i = 0; i < watch->count; i++) {
        struct stat now = about_file(watch->files[i].path);
        watch->files[i].changed = !same_version(&now, &watch->files[i].version);
        watch->files[i].version = now;
        found = found || watch->files[i].changed;
    }
    return found;
}

void watch_wait(Watch *watch) {
    int descriptor = file_watch_descriptor(watch->watch);
    for (;;) {
        struct pollfd place = {.fd = descriptor, .events = POLLIN};
        poll(&place, descriptor < 0 ? 0 : 1, POLL_MS);
        if (file_watch_changed(watch->watch) && find_changes(watch))
            return;
    }
}

// Returns true if a changed file affects the test.
static bool affects(const Watch *watch, const TextList *files) {
    for (size_t i = 0; i < watch->count; i++)
        if (watch->files[i].changed && texts_contain(files, watch->files[i].path))
            return true;
    return false;
}

void watch_select(Watch *watch, TestList *tests) {
    size_t kept = 0;
    for (size_t i = 0; i < tests->count; i++) {
        TextList files = files_of(&tests->items[i]);
        if (affects(watch, &files)) {
            for (size_t k = 0; k < files.count; k++)
                add_file(watch, files.items[k]);
            tests->items[kept++] = tests->items[i];
        } else {
            test_free(&tests->items[i]);
        }
        texts_free(&files);
    }
    tests->count = kept;
    tests->untested = 0;
}

void watch_free(Watch *watch) {
    for (size_t i = 0; i < watch->count; i++)
        free(watch->files[i].path);
    free(watch->files);
    file_watch_free(watch->watch);
    free(watch);
}
