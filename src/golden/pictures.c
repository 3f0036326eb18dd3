// pictures.c: goldens of `petri render`; see suite.h.
//
// NAME.golden begins with `# render` and options. Its body lists the pictures, such as NAME.0001.png, which are beside
// it. Bits are the same everywhere except where OpenGL draws; `# tolerance N` then allows each channel of a pixel to
// differ by N of 255. A picture that differs is kept in NAME.0001.failed.png, between the recorded one and the
// difference.
#include "base/file.h"
#include "base/source.h"
#include "cli/script.h"
#include "golden/suite.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const char FAILED[] = ".failed.png";

// --- the folder that the run draws into

bool pictures_begin(const Options *options, TestCase *test, TextList *words) {
    const char *folder = getenv("TMPDIR");
    Text path = {0};
    text_add_format(&path, "%s/petri-XXXXXX", !folder || folder[0] == '\0' ? "/tmp" : folder);
    if (!mkdtemp(path.bytes)) {
        text_add_format(&test->result.error_text, "cannot create the folder %s: %s", path.bytes, strerror(errno));
        text_free(&path);
        return false;
    }
    test->drawn = path.bytes;
    texts_add(words, "render");
    texts_add(words, "--threads=1");
    for (size_t i = 0; i < test->golden.options.count; i++)
        texts_add(words, test->golden.options.items[i]);
    texts_add_format(words, "--output=%s/%%04d.png", test->drawn);
    run_add_common(options, test, words);
    return true;
}

static int compare_words(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

// Returns the names of the drawn pictures, such as 0001.png, sorted.
static TextList drawn_names(const TestCase *test) {
    TextList names = {0};
    DIR *folder = opendir(test->drawn);
    for (struct dirent *entry = folder ? readdir(folder) : NULL; entry; entry = readdir(folder))
        if (str_ends_with(str_from(entry->d_name), STR(".png")))
            texts_add(&names, entry->d_name);
    if (folder)
        closedir(folder);
    if (names.count > 1)
        qsort(names.items, names.count, sizeof *names.items, compare_words);
    return names;
}

static char *drawn_path(const TestCase *test, const char *name) {
    Text path = {0};
    text_add_format(&path, "%s/%s", test->drawn, name);
    return path.bytes;
}

// Returns the path of a recorded picture, for a name such as 0001.png.
static char *recorded_path(const TestCase *test, const char *name) {
    SCOPED_TEXT suffix = {0};
    text_add_format(&suffix, ".%s", name);
    return kind_path(test->recorded, suffix.bytes);
}

// Returns the path of the comparison of a picture.
static char *failed_path(const TestCase *test, const char *name) {
    SCOPED_STRING number = memory_strndup(name, strlen(name) - strlen(".png"));
    SCOPED_TEXT suffix = {0};
    text_add_format(&suffix, ".%s%s", number, FAILED);
    return kind_path(test->recorded, suffix.bytes);
}

static void remove_drawn(TestCase *test, const TextList *names) {
    for (size_t i = 0; i < names->count; i++) {
        SCOPED_STRING path = drawn_path(test, names->items[i]);
        unlink(path);
    }
    rmdir(test->drawn);
    memory_free_string(&test->drawn);
}

// --- comparison

// Adds the body of the golden: the names of its pictures.
static void add_listing(const TestCase *test, const TextList *names, Text *text) {
    for (size_t i = 0; i < names->count; i++) {
        SCOPED_STRING path = recorded_path(test, names->items[i]);
        text_add_format(text, "%s\n", path + path_directory(str_from(path)).len);
    }
}

static bool same_bytes(const char *a, const char *b) {
    SCOPED_TEXT first = {0}, second = {0};
    return !text_read_file(&first, a, SIZE_MAX) && !text_read_file(&second, b, SIZE_MAX) &&
           str_equal(text_str(&first), text_str(&second));
}

// Compares two pictures. Returns the exit status of `petri --compare-pictures`, whose text is added to `found`, or -1.
static int compare_pixels(const TestCase *test, const char *recorded, const char *drawn, const char *comparison,
                          Text *found) {
    SCOPED_TEXT errors = {0};
    TextList words = {0};
    texts_add(&words, "petri");
    texts_add(&words, "--compare-pictures");
    const char *files[] = {recorded, drawn};
    for (int i = 0; i < 2; i++) {
        char resolved[PATH_MAX];
        texts_add(&words, file_resolve(files[i], resolved) ? resolved : files[i]);
    }
    texts_add_format(&words, "%d", (int)test->golden.tolerance);
    if (comparison)
        texts_add(&words, comparison);
    int status = subprocess_run(test->host->program, ".", words.items, SUBPROCESS_MAX_SECONDS, found, &errors);
    texts_free(&words);
    status = status >= 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (status != 0 && status != 1)
        text_add(found, text_str(&errors));
    return status;
}

// Compares one picture. Adds to the details if it differs.
static void compare_picture(TestCase *test, const char *name) {
    Result *result = &test->result;
    SCOPED_STRING recorded = recorded_path(test, name);
    SCOPED_STRING drawn = drawn_path(test, name);
    SCOPED_STRING failed = failed_path(test, name);
    SCOPED_TEXT found = {0};
    unlink(failed);
    if (same_bytes(recorded, drawn) || compare_pixels(test, recorded, drawn, failed, &found) == 0)
        return;
    size_t length = found.len > 0 ? strcspn(found.bytes, "\n") : 0;
    text_add_format(&result->details, "%s: %.*s\n", recorded, (int)length, found.len > 0 ? found.bytes : "");
    if (file_exists(failed))
        text_add_format(&result->details, "old, new and difference: %s\n", failed);
    if (result->passed)
        text_add_format(&result->error_text, "%s: %.*s", recorded + path_directory(str_from(recorded)).len, (int)length,
                        found.len > 0 ? found.bytes : "");
    result->passed = false;
    result->differs = true;
}

static void check_pictures(TestCase *test, const TextList *names) {
    SCOPED_TEXT listing = {0};
    double tolerance = test->golden.tolerance;
    add_listing(test, names, &listing);
    text_add_c(&listing, "");
    test->golden.tolerance = 0;
    test->result.passed = golden_compare(&test->golden, &listing, &test->result);
    test->golden.tolerance = tolerance;
    test->result.differs = !test->result.passed;
    for (size_t i = 0; i < names->count; i++)
        compare_picture(test, names->items[i]);
}

// --- recording

// Copies a drawn picture unless its pixels are those that are recorded: other versions of libraries compress them in
// another way.
static const char *record_picture(TestCase *test, const char *name) {
    SCOPED_STRING recorded = recorded_path(test, name);
    SCOPED_STRING drawn = drawn_path(test, name);
    SCOPED_STRING failed = failed_path(test, name);
    SCOPED_TEXT bytes = {0}, found = {0};
    unlink(failed);
    if (same_bytes(recorded, drawn) ||
        (file_exists(recorded) && compare_pixels(test, recorded, drawn, NULL, &found) == 0))
        return NULL;
    test->result.updated = true;
    const char *problem = text_read_file(&bytes, drawn, SIZE_MAX);
    return problem ? problem : file_replace(recorded, text_str(&bytes), 0);
}

// Deletes the pictures that the golden lists and that are no longer drawn.
static void delete_others(const TestCase *test, const Text *listing) {
    const Golden *golden = &test->golden;
    const Text body = {.bytes = golden->text.bytes + golden->body, .len = golden->text.len - golden->body};
    SCOPED_STRING start = kind_path(test->name, ".");
    size_t at = 0;
    for (Str line; text_next_line(&body, &at, &line);) {
        SCOPED_STRING name = memory_strndup(line.bytes, line.len);
        SCOPED_STRING folder = memory_folder(test->recorded);
        SCOPED_TEXT path = {0};
        // Another author's golden must not delete other files.
        bool own = strncmp(name, start, strlen(start)) == 0 && !strchr(name, '/') && str_ends_with(line, STR(".png"));
        text_add_format(&path, "%s/%s", folder, name);
        if (own && !strstr(listing->bytes, name))
            unlink(path.bytes);
    }
}

static void record_pictures(TestCase *test, const TextList *names) {
    Result *result = &test->result;
    SCOPED_TEXT listing = {0};
    const char *problem = NULL;
    bool changed = false;
    add_listing(test, names, &listing);
    text_add_c(&listing, "");
    for (size_t i = 0; i < names->count && !problem; i++)
        problem = record_picture(test, names->items[i]);
    if (problem) {
        text_add_format(&result->error_text, "cannot write the pictures of %s: %s", test->recorded, problem);
        return;
    }
    result->passed = golden_update(&test->golden, test->recorded, &listing, &changed, &result->error_text);
    result->updated = result->updated || changed;
    if (changed)
        delete_others(test, &listing);
}

void pictures_end(const Options *options, TestCase *test, const RunOutput *run) {
    TextList names = drawn_names(test);
    if (!run_is_complete(run->status, &run->errors))
        run_describe(test, run);
    else if (names.count == 0)
        text_add_c(&test->result.error_text, "the run has drawn no pictures");
    else if (test_options(options)->update)
        record_pictures(test, &names);
    else
        check_pictures(test, &names);
    remove_drawn(test, &names);
    texts_free(&names);
}

// --- review

// Calls `visit` for the comparison of each recorded picture that has one. Returns the number of comparisons.
static size_t for_failed(const TestCase *test, void (*visit)(const TestCase *test, const char *path, Output *output),
                         Output *output) {
    Golden golden;
    SCOPED_TEXT problem = {0};
    SCOPED_STRING folder = memory_folder(test->recorded);
    size_t count = 0;
    if (golden_read(&golden, test->recorded, &problem) && golden.renders) {
        const Text body = {.bytes = golden.text.bytes + golden.body, .len = golden.text.len - golden.body};
        size_t at = 0;
        for (Str line; text_next_line(&body, &at, &line);) {
            SCOPED_TEXT path = {0};
            size_t length = line.len > strlen(".png") ? line.len - strlen(".png") : 0;
            text_add_format(&path, "%s%s%.*s%s", folder, strcmp(folder, ".") == 0 ? "/" : "", (int)length, line.bytes,
                            FAILED);
            if (memchr(line.bytes, '/', line.len) || !file_exists(path.bytes))
                continue;
            visit(test, path.bytes, output);
            count++;
        }
    }
    golden_free(&golden);
    return count;
}

static void discard_one(const TestCase *test, const char *path, Output *output) {
    (void)test;
    (void)output;
    unlink(path);
}

void pictures_discard(TestCase *test) {
    for_failed(test, discard_one, NULL);
}

// Shows a comparison in the terminal, with `petri run --show` of a script that contains it.
static void show_one(const TestCase *test, const char *path, Output *output) {
    output_format(output, "old, new and difference: %s\n", path);
    output_flush(output);
    char resolved[PATH_MAX];
    SCOPED_TEXT script = {0};
    int input = isatty(STDOUT_FILENO) && file_resolve(path, resolved) ? subprocess_temporary_file() : -1;
    if (input < 0)
        return;
    text_add_c(&script, "!window size=960;320\n    !canvas\n        !image fit=960;320 filename='");
    for (const char *c = resolved; *c != '\0'; c++)
        text_add_format(&script, *c == '\'' || *c == '\\' ? "\\%c" : *c == '\n' ? "\\n" : "%c", *c);
    text_add_c(&script, "'\n");
    const char *const words[] = {"petri", "run", "-", "--show", "--frames=1", "--quiet", "--allow-read=all", NULL};
    if (file_write(input, script.bytes, script.len) && lseek(input, 0, SEEK_SET) == 0) {
        pid_t pid =
            subprocess_spawn(test->host->program, words, (const int[]){input, STDOUT_FILENO, STDERR_FILENO}, 3, false);
        if (pid > 0)
            subprocess_wait_for(pid);
    }
    close(input);
}

bool pictures_show(Output *output, TestCase *test) {
    return for_failed(test, show_one, output) > 0;
}
