// arguments.c: parsing the operands of commands.
#include "prompt/prompt.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const char BLANKS[] = " \t\r\n";

static bool is_blank(char c) {
    return c != '\0' && strchr(BLANKS, c);
}

static void trim_end(char *text) {
    size_t length = strlen(text);
    while (length > 0 && is_blank(text[length - 1]))
        length--;
    text[length] = '\0';
}

char *argument_trimmed(const char *text) {
    text += strspn(text, BLANKS);
    char *copy = memory_strdup(text);
    trim_end(copy);
    return copy;
}

static bool read_count(const char *text, int64_t *count) {
    char *end = NULL;
    errno = 0;
    intmax_t value = strtoimax(text, &end, 10);
    *count = value;
    return end != text && *end == '\0' && errno == 0 && !is_blank(text[0]) && text[0] != '+';
}

// Parses a number or evaluates an expression. *number may be infinite or NaN. On failure, writes a message and returns
// false.
static bool evaluate_number(Prompt *prompt, const char *text, double *number) {
    PetriEvaluation result;
    if (petri_parse_number(text, number) && isfinite(*number))
        return true;
    prompt_busy(prompt);
    PetriStatus status =
        petri_evaluate(prompt->session, text, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
    prompt_idle(prompt);
    if (!prompt_status(prompt, status))
        return false;
    *number = result.number;
    return true;
}

bool argument_number(Prompt *prompt, const char *text, double *number) {
    return evaluate_number(prompt, text, number) &&
           (isfinite(*number) || prompt_fail(prompt, "not a number: '%.40s'", text));
}

bool argument_count(Prompt *prompt, const char *text, int64_t min, int64_t *count) {
    static const double max = 9007199254740992; // 2^53: above it, doubles cannot represent every integer
    double value = 0;
    if (text[0] == '\0' || (read_count(text, count) && *count >= min))
        return true;
    if (!evaluate_number(prompt, text, &value))
        return false;
    if (!(value == floor(value) && value >= (double)min && value <= max))
        return prompt_fail(prompt, "not an integer >= %" PRId64 ": '%.40s'", min, text);
    *count = (int64_t)value;
    return true;
}

bool argument_limit(Prompt *prompt, char *text, int64_t *limit) {
    static const char option[] = "--limit";
    char *at = text;
    while ((at = strstr(at, option))) {
        char *word = at + sizeof option - 1 + strspn(at + sizeof option - 1, " \t=");
        char *end = word + strcspn(word, BLANKS);
        char *after = end + strspn(end, BLANKS);
        if ((at == text || is_blank(at[-1])) && (at == text || *after == '\0')) {
            SCOPED_STRING number = memory_strndup(word, (size_t)(end - word));
            bool good = number[0] != '\0' ? argument_count(prompt, number, 1, limit)
                                          : prompt_fail(prompt, "--limit needs a number of frames");
            memmove(at, after, strlen(after) + 1);
            trim_end(text);
            return good;
        }
        at++;
    }
    return true;
}

static char *last_word(char *text) {
    char *last = text + strlen(text);
    while (last > text && !is_blank(last[-1]))
        last--;
    return last;
}

void argument_last_count(char *text, int64_t *count) {
    char *last = last_word(text);
    int64_t value = 0;
    if (last > text && read_count(last, &value) && value > 0) {
        *count = value;
        *last = '\0';
        trim_end(text);
    }
}

static size_t screen_lines(Prompt *prompt, size_t around) {
    enum { MIN_LINES = 5 };
    size_t rows = prompt->host->rows ? prompt->host->rows(prompt) : SIZE_MAX;
    return rows == SIZE_MAX ? rows : rows > around + MIN_LINES ? rows - around : MIN_LINES;
}

size_t argument_lines(Prompt *prompt, char *text, size_t around) {
    char *last = last_word(text), *before = last;
    while (before > text && is_blank(before[-1]))
        before--;
    int64_t count = 0;
    // After a semicolon, a number is part of a key, as in `:p; 2`.
    bool all = strcmp(last, "all") == 0, open = before > text && before[-1] == ';';
    if (open || (!all && !(read_count(last, &count) && count > 0)))
        return screen_lines(prompt, around);
    *before = '\0';
    return all ? SIZE_MAX : (size_t)count;
}
