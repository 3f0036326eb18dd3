// golden.c: reads and updates goldens; see golden.h.
#include "golden/golden.h"

#include "base/file.h"
#include "base/source.h"
#include "render/options.h"
#include "run/options.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_word(TextList *words, Text *word) {
    text_add_c(word, ""); // makes word->bytes a string even if the word is empty
    texts_add(words, word->bytes);
}

// Splits a line into words like a shell: at spaces, except in '...' or "..." or after a backslash. In '...', a
// backslash has no special meaning.
static bool split_options(Golden *golden, const char *line, size_t length, Text *error_text) {
    SCOPED_TEXT word = {0};
    char quote = '\0';
    bool in_word = false;
    for (size_t i = 0; i < length; i++) {
        char c = line[i];
        if (c == '\\' && quote != '\'' && i + 1 < length) {
            text_add_char(&word, line[++i]);
            in_word = true;
        } else if (quote != '\0' ? c == quote : c == '\'' || c == '"') {
            quote = quote != '\0' ? '\0' : c;
            in_word = true;
        } else if (quote == '\0' && (c == ' ' || c == '\t')) {
            if (in_word)
                add_word(&golden->options, &word);
            word.len = 0;
            in_word = false;
        } else {
            text_add_char(&word, c);
            in_word = true;
        }
    }
    if (in_word)
        add_word(&golden->options, &word);
    if (quote != '\0')
        text_add_format(error_text, "line 1: missing closing quote");
    return quote == '\0';
}

// Reads a remark such as `# tolerance 1e-9`. Ignores all other remarks, which are comments.
static bool read_remark(Golden *golden, const char *line, size_t length, Text *error_text) {
    char copy[128];
    size_t kept = length < sizeof copy - 1 ? length : sizeof copy - 1;
    memcpy(copy, line, kept);
    copy[kept] = '\0';
    char rest = '\0';
    if (strncmp(copy, "# tolerance", 11) == 0) {
        int count = sscanf(copy, "# tolerance %lf %c", &golden->tolerance, &rest);
        if (count == 1 && golden->tolerance >= 0 && isfinite(golden->tolerance))
            return true;
    } else if (strncmp(copy, "# horizon", 9) == 0) {
        int count =
            sscanf(copy, "# horizon %" SCNd64 " strict %" SCNd64 " %c", &golden->horizon, &golden->strict, &rest);
        if (count == 1) {
            golden->strict = golden->horizon;
            // sscanf also returns 1 if text other than `strict N` follows the number, which is an error.
            if (sscanf(copy, "# horizon %*d %c", &rest) != 1)
                return true;
        } else if (count == 2) {
            return true;
        }
    } else {
        return true;
    }
    text_add_format(error_text, "line %" PRIu32 ": cannot read '%s'", golden->body_line, copy);
    return false;
}

const OptionSpec *golden_option(const OptionSpec *rows, const char *word) {
    size_t length = strcspn(word, "=");
    if (word[0] != '-' || length < 2)
        return NULL;
    for (const OptionSpec *spec = rows; spec->name; spec++) {
        bool same = word[1] == '-' ? strlen(spec->name) == length - 2 && memcmp(spec->name, word + 2, length - 2) == 0
                                   : spec->letter == word[1];
        if (same)
            return spec;
    }
    return NULL;
}

const OptionSpec *golden_rows(const Golden *golden) {
    return golden->renders ? RENDER_OPTIONS.rows : RUN_OPTIONS.rows;
}

bool golden_option_is_alone(const char *word) {
    size_t length = strcspn(word, "=");
    return word[length] == '\0' && (word[1] == '-' || length == 2);
}

bool golden_check_options(const OptionSpec *rows, const TextList *words, Text *error_text) {
    for (size_t i = 0; i < words->count; i++) {
        const char *word = words->items[i];
        const OptionSpec *spec = golden_option(rows, word);
        if (spec && spec->not_in_goldens) {
            text_add_format(error_text, "option '--%s' is not allowed in goldens: tests write no files", spec->name);
            return false;
        }
        i += spec && spec->value && golden_option_is_alone(word) ? 1 : 0;
    }
    return true;
}

static bool read_head_line(Golden *golden, const char *line, size_t length, Text *error_text) {
    if (golden->body_line > 1)
        return read_remark(golden, line, length, error_text);
    static const char *const commands[] = {"# run", "# render"};
    size_t start = 0;
    for (int i = 0; i < 2; i++) {
        size_t end = strlen(commands[i]);
        if (length >= end && memcmp(line, commands[i], end) == 0 && (length == end || line[end] == ' ')) {
            start = end;
            golden->renders = i == 1;
        }
    }
    if (start == 0) {
        text_add_format(error_text, "line 1: expected '# run' or '# render', and the options");
        return false;
    }
    SCOPED_TEXT problem = {0};
    if (!split_options(golden, line + start, length - start, error_text))
        return false;
    if (!golden_check_options(golden_rows(golden), &golden->options, &problem))
        text_add_format(error_text, "line 1: %s", problem.bytes);
    return problem.len == 0;
}

bool golden_read_text(Text *text, const char *path, Text *error_text) {
    static const char mark[] = "\xef\xbb\xbf";
    const char *problem = text_read_file(text, path, SIZE_MAX);
    if (problem) {
        text_add_format(error_text, "cannot read %s: %s", path, problem);
        return false;
    }
    size_t skip = text->len >= 3 && memcmp(text->bytes, mark, 3) == 0 ? 3 : 0;
    if (text->len > 0) {
        memmove(text->bytes, text->bytes + skip, text->len - skip);
        text->len = source_unify_lines(text->bytes, text->len - skip);
        text->bytes[text->len] = '\0';
    }
    return true;
}

bool golden_read(Golden *golden, const char *path, Text *error_text) {
    *golden = (Golden){.horizon = INT64_MAX, .strict = INT64_MAX, .body_line = 1};
    if (!golden_read_text(&golden->text, path, error_text))
        return false;
    const char *data = golden->text.bytes;
    while (golden->body < golden->text.len && (golden->body_line == 1 || data[golden->body] == '#')) {
        const char *line = data + golden->body;
        const char *end = memchr(line, '\n', golden->text.len - golden->body);
        size_t length = !end ? golden->text.len - golden->body : (size_t)(end - line);
        if (!read_head_line(golden, line, length, error_text))
            return false;
        golden->body += length + (!end ? 0 : 1);
        golden->body_line++;
    }
    if (golden->body_line == 1)
        text_add_format(error_text, "the golden is empty; start it with '# run' and the options");
    return golden->body_line > 1;
}

void golden_free(Golden *golden) {
    texts_free(&golden->options);
    text_free(&golden->text);
    *golden = (Golden){0};
}

bool golden_update(const Golden *golden, const char *path, const Text *output, bool *changed, Text *error_text) {
    size_t recorded = golden->text.len - golden->body;
    *changed = recorded != output->len || memcmp(golden->text.bytes + golden->body, output->bytes, recorded) != 0;
    if (!*changed)
        return true;
    SCOPED_TEXT updated = {0};
    text_add(&updated, (Str){golden->text.bytes, golden->body});
    if (golden->body > 0 && golden->text.bytes[golden->body - 1] != '\n')
        text_add_c(&updated, "\n");
    text_add(&updated, text_str(output));
    const char *problem = file_replace(path, text_str(&updated), 0);
    if (problem)
        text_add_format(error_text, "cannot write %s: %s", path, problem);
    return !problem;
}
