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
    for (size_t i = 0; (path = petri_source_file(repl->prompt.session, i)); i++)
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
    repl->prompt.failed = repl->prompt.failed || status != PETRI_OK;
    return status == PETRI_OK;
}

bool repl_replay(Repl *repl) {
    return finish_load(repl, options_load(repl->options, repl->prompt.session));
}

bool repl_load(Repl *repl, const char *file) {
    PetriStatus status = script_load(repl->prompt.session, file);
    repl->prompt.rates_changed = repl->prompt.rates_changed && status != PETRI_OK;
    if (status == PETRI_OK && file != repl->script) {
        free(repl->script);
        repl->script = memory_strdup(file);
    }
    return finish_load(repl, status);
}

bool repl_run_reload(Prompt *prompt, const char *rest) {
    Repl *repl = prompt->user_data;
    (void)rest;
    if (!repl->script)
        return prompt_fail(prompt, "no script loaded; run .load FILE");
    // A script that has never run has no state to keep.
    PetriStatus status =
        repl->loaded ? petri_reload(prompt->session, repl->script) : petri_load(prompt->session, repl->script);
    bool first = !repl->loaded;
    if (!finish_load(repl, status))
        return false;
    if (first && !prompt_status(prompt, petri_history_start(prompt->history, NULL)))
        return false;
    prompt_note(prompt, "%s reloaded", repl->script);
    return true;
}

void repl_refresh(Prompt *prompt) {
    Repl *repl = prompt->user_data;
    repl_report_changes(repl, false);
    if (repl->changed) {
        repl->changed = false;
        if (!repl_run_reload(prompt, ""))
            prompt_note(prompt, repl->loaded ? "the previous script continues" : "no script is running");
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
        prompt_note(&repl->prompt, "%s%s changed%s%s; it is reloaded before the next step",
                    what.len == 0 ? "a file used by " : "", repl->script, what.len == 0 ? "" : ": ",
                    what.len == 0 ? "" : what.bytes);
        output_flush(&repl->output);
    }
    return changed;
}

bool repl_run_load(Prompt *prompt, const char *rest) {
    Repl *repl = prompt->user_data;
    if (script_is_stdin(rest))
        return prompt_fail(prompt, "cannot read the script from standard input: the prompt uses it");
    if (!repl_load(repl, rest))
        return false;
    petri_reset(prompt->session);
    return prompt_status(prompt, petri_history_start(prompt->history, NULL));
}

bool repl_run_save(Prompt *prompt, const char *rest) {
    if (!prompt_status(prompt, petri_save(prompt->session, rest)))
        return false;
    prompt_note(prompt, "state after frame %" PRId64 " written to %s", petri_frame_number(prompt->session), rest);
    return true;
}

bool repl_run_restore(Prompt *prompt, const char *rest) {
    if (access(rest, R_OK) != 0)
        return prompt_fail(prompt, "cannot read '%s': %s", rest, strerror(errno));
    if (!prompt_status(prompt, petri_restore(prompt->session, rest)))
        return false;
    prompt_note(prompt, "restored the state after frame %" PRId64, petri_frame_number(prompt->session));
    return prompt_status(prompt, petri_history_start(prompt->history, "a state was restored"));
}
