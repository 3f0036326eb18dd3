// script.c: loads and reloads the script, describes its changes, and saves and restores the state.
#include "cli/script.h"

#include "base/file.h"
#include "petri-inspect.h"
#include "repl/repl.h"

#include <errno.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_CELLS = 4000000, MAX_NAMES = 6 };

typedef struct Lines {
    Str *items;
    size_t count;
} Lines;

static Lines split_lines(const Text *text) {
    Lines lines = {0};
    Str line;
    size_t at = 0, capacity = 0;
    while (text_next_line(text, &at, &line)) {
        if (lines.count == capacity) {
            capacity = capacity == 0 ? 64 : capacity * 2;
            lines.items = memory_realloc(lines.items, capacity * sizeof *lines.items);
        }
        lines.items[lines.count++] = line;
    }
    return lines;
}

// Returns the name that a line seems to bind, or an empty string.
static Str bound_name(Str line) {
    static const char *const words[] = {"let ", "func "};
    size_t at = 0;
    while (at < line.len && (line.bytes[at] == ' ' || line.bytes[at] == '\t'))
        at++;
    for (size_t i = 0; i < 2; i++) {
        size_t length = strlen(words[i]);
        at += line.len - at > length && memcmp(line.bytes + at, words[i], length) == 0 ? length : 0;
    }
    size_t end = at;
    while (end < line.len && (line.bytes[end] == '_' || (unsigned char)line.bytes[end] >= 0x80 ||
                              !strchr("=(;!@#$:%&|<>*/+-.,)[]{}'\" \t", line.bytes[end])))
        end++;
    bool binds = end > at && end < line.len && strchr("=(;", line.bytes[end]);
    return (Str){line.bytes + at, binds ? end - at : 0};
}

typedef struct Names {
    Str items[MAX_NAMES];
    size_t count;
} Names;

static void add_name(Names *names, const Str *line) {
    Str name = bound_name(*line);
    bool known = name.len == 0 || names->count == MAX_NAMES;
    for (size_t i = 0; i < names->count && !known; i++)
        known = str_equal(names->items[i], name);
    if (!known)
        names->items[names->count++] = name;
}

// Returns a table of (rows + 1) x (columns + 1) lengths. The entry in row i and column j is the length of the longest
// common subsequence of two texts: the lines of `a` from line i on, and the lines of `b` from line j on.
static uint32_t *common_lengths(const Str *a, size_t rows, const Str *b, size_t columns) {
    uint32_t *lengths = memory_calloc((rows + 1) * (columns + 1) * sizeof *lengths);
    for (size_t i = rows; i-- > 0;) {
        uint32_t *row = lengths + i * (columns + 1), *next = row + columns + 1;
        for (size_t j = columns; j-- > 0;)
            row[j] = str_equal(a[i], b[j]) ? next[j + 1] + 1 : next[j] > row[j + 1] ? next[j] : row[j + 1];
    }
    return lengths;
}

typedef struct Counts {
    size_t added;
    size_t removed;
} Counts;

static Counts diff_lines(const Str *a, size_t rows, const Str *b, size_t columns, Names *names) {
    Counts counts = {0};
    bool small = rows == 0 || columns < MAX_CELLS / rows;
    uint32_t *lengths = small ? common_lengths(a, rows, b, columns) : NULL;
    size_t i = 0, j = 0;
    while (i < rows || j < columns) {
        if (lengths && i < rows && j < columns && str_equal(a[i], b[j])) {
            i++;
            j++;
        } else if (j < columns && (i == rows || !lengths ||
                                   lengths[i * (columns + 1) + j + 1] >= lengths[(i + 1) * (columns + 1) + j])) {
            add_name(names, &b[j++]);
            counts.added++;
        } else {
            add_name(names, &a[i++]);
            counts.removed++;
        }
    }
    free(lengths);
    return counts;
}

static void add_count(Text *what, size_t count, const char *verb) {
    bool first = what->len == 0;
    if (count > 0) {
        text_add_format(what, "%s%zu %s%s", first ? "" : ", ", count,
                        !first       ? ""
                        : count == 1 ? "line "
                                     : "lines ",
                        verb);
    }
}

// Appends a summary of the changed lines and the names that they bind, such as `2 lines added, 1 removed (COUNT,
// start)`. Appends nothing if the texts are equal.
static void describe_changes(const Text *before, const Text *after, Text *what) {
    Lines a = split_lines(before), b = split_lines(after);
    size_t start = 0, rows = a.count, columns = b.count;
    while (start < rows && start < columns && str_equal(a.items[start], b.items[start]))
        start++;
    while (rows > start && columns > start && str_equal(a.items[rows - 1], b.items[columns - 1])) {
        rows--;
        columns--;
    }
    Names names = {0};
    Counts counts = {0};
    if (rows > start || columns > start)
        counts = diff_lines(a.items + start, rows - start, b.items + start, columns - start, &names);
    add_count(what, counts.added, "added");
    add_count(what, counts.removed, "removed");
    for (size_t i = 0; i < names.count; i++)
        text_add_format(what, "%s%.*s", i == 0 ? " (" : ", ", (int)names.items[i].len, names.items[i].bytes);
    text_add_c(what, names.count == 0 ? "" : ")");
    free(a.items);
    free(b.items);
}

void repl_watch_files(Repl *repl) {
    if (repl->options->replayed)
        return; // its files do not change
    if (repl->script)
        file_watch_add(repl->files, repl->script);
    const char *path;
    for (size_t i = 0; (path = petri_source_file(repl->session, i)); i++)
        file_watch_add(repl->files, path);
}

static void store_script_text(Repl *repl) {
    text_free(&repl->script_text);
    if (repl->script)
        text_read_file(&repl->script_text, repl->script, SCRIPT_MAX_BYTES);
}

static bool finish_load(Repl *repl, PetriStatus status) {
    repl_watch_files(repl);
    repl->changed = false;
    if (status == PETRI_OK) {
        store_script_text(repl);
        repl->loaded = true;
    }
    repl->failed = repl->failed || status != PETRI_OK;
    return status == PETRI_OK;
}

bool repl_replay(Repl *repl) {
    return finish_load(repl, options_load(repl->options, repl->session));
}

bool repl_load(Repl *repl, const char *file) {
    PetriStatus status = script_load(repl->session, file);
    repl->rates_changed = repl->rates_changed && status != PETRI_OK;
    if (status == PETRI_OK && file != repl->script) {
        free(repl->script);
        repl->script = memory_strdup(file);
    }
    return finish_load(repl, status);
}

static bool run_reload(Repl *repl, const char *rest) {
    (void)rest;
    if (!repl->script)
        return repl_fail(repl, "no script loaded; run .load FILE");
    // A script that has never run has no state to keep.
    PetriStatus status =
        repl->loaded ? petri_reload(repl->session, repl->script) : petri_load(repl->session, repl->script);
    bool first = !repl->loaded;
    if (!finish_load(repl, status))
        return false;
    if (first && !repl_status(repl, petri_history_start(repl->history, NULL)))
        return false;
    repl_note(repl, "%s reloaded", repl->script);
    return true;
}

void repl_refresh(Repl *repl) {
    repl_report_changes(repl, false);
    if (repl->changed) {
        repl->changed = false;
        if (!run_reload(repl, ""))
            repl_note(repl, repl->loaded ? "the previous script continues" : "no script is running");
    }
}

bool repl_report_changes(Repl *repl, bool at_prompt) {
    if (!file_watch_changed(repl->files))
        return false;
    SCOPED_TEXT now = {0}, what = {0};
    bool changed = repl->script && !text_read_file(&now, repl->script, SCRIPT_MAX_BYTES);
    if (changed) {
        repl->changed = true;
        describe_changes(&repl->script_text, &now, &what);
        if (at_prompt)
            output_write(&repl->output, "\n", 1);
        // If the text of the script itself is unchanged, a file that it includes or imports has changed.
        repl_note(repl, "%s%s changed%s%s; it is reloaded before the next step", what.len == 0 ? "a file used by " : "",
                  repl->script, what.len == 0 ? "" : ": ", what.len == 0 ? "" : what.bytes);
        output_flush(&repl->output);
    }
    return changed;
}

static bool run_drop(Repl *repl, const char *rest) {
    if (rest[0] != '\0' && strcmp(rest, "all") != 0)
        return repl_fail(repl, "invalid argument: '%s'; .drop removes nodes, and .drop all removes nodes and names",
                         rest);
    uint32_t count = petri_prompt_clear(repl->session, rest[0] != '\0');
    repl_note(repl, "%" PRIu32 " statement%s removed", count, count == 1 ? "" : "s");
    return true;
}

static bool run_load(Repl *repl, const char *rest) {
    if (script_is_stdin(rest))
        return repl_fail(repl, "cannot read the script from standard input: the prompt uses it");
    if (!repl_load(repl, rest))
        return false;
    petri_reset(repl->session);
    return repl_status(repl, petri_history_start(repl->history, NULL));
}

static bool run_save(Repl *repl, const char *rest) {
    if (!repl_status(repl, petri_save(repl->session, rest)))
        return false;
    repl_note(repl, "state after frame %" PRId64 " written to %s", petri_frame_number(repl->session), rest);
    return true;
}

static bool run_restore(Repl *repl, const char *rest) {
    if (access(rest, R_OK) != 0)
        return repl_fail(repl, "cannot read '%s': %s", rest, strerror(errno));
    if (!repl_status(repl, petri_restore(repl->session, rest)))
        return false;
    repl_note(repl, "restored the state after frame %" PRId64, petri_frame_number(repl->session));
    return repl_status(repl, petri_history_start(repl->history, "a state was restored"));
}

const ReplCommand SCRIPT_COMMANDS[] = {
    {".drop", "[all]", NULL, "remove nodes added at the prompt; with `all`, also names", run_drop, COMPLETE_LANGUAGE},
    {".load", "FILE", "a file", "load another script and start with an empty state", run_load, COMPLETE_FILES},
    {".reload", "", NULL, "reload the script; keep state and frame number", run_reload, COMPLETE_LANGUAGE},
    {".save", "FILE", "a file", "write the state to a file", run_save, COMPLETE_FILES},
    {".restore", "FILE", "a file", "load the state from a file and restart the history", run_restore, COMPLETE_FILES},
    {0},
};
