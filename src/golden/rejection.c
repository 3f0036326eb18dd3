// rejection.c: tests of scripts that must be rejected (golden.h).
#include "base/file.h"
#include "cli/subprocess.h"
#include "golden/golden.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

enum { ANY_LINE = -1, NO_LINE = 0 };

// Returns the line number in the .err file, or ANY_LINE for `line *`. On failure, adds the reason to error_text and
// returns NO_LINE.
static long read_line_number(const char *path, Text *error_text) {
    SCOPED_TEXT text = {0};
    long line = NO_LINE;
    char rest = '\0';
    const char *problem = text_read_file(&text, path, SIZE_MAX);
    if (problem) {
        text_add_format(error_text, "cannot read %s: %s", path, problem);
        return NO_LINE;
    }
    const char *line_text = text.bytes + (strncmp(text.bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0);
    if (strncmp(line_text, "line *", 6) == 0 && sscanf(line_text + 6, " %c", &rest) != 1) {
        line = ANY_LINE;
    } else if (sscanf(line_text, "line %ld %c", &line, &rest) != 1 || line < 1) {
        text_add_format(error_text, "cannot read %s: expected 'line N' or 'line *'", path);
        line = NO_LINE;
    }
    return line;
}

// Finds the next `NAME:LINE:` at or after *at, in the error messages of a run. Returns LINE and moves *at to the colon
// after it. Returns NO_LINE if there is none.
static long next_reported_line(const char **at, const char *name) {
    size_t length = strlen(name);
    for (const char *found = strstr(*at, name); found; found = strstr(found + 1, name)) {
        char *end = NULL;
        long line = found[length] == ':' ? strtol(found + length + 1, &end, 10) : NO_LINE;
        if (line > 0 && *end == ':') {
            *at = end;
            return line;
        }
    }
    return NO_LINE;
}

bool rejection_check(const char *path, const char *name, int status, const Text *errors, Text *error_text) {
    long wanted = read_line_number(path, error_text);
    if (wanted == NO_LINE)
        return false;
    if (!WIFEXITED(status)) {
        subprocess_describe(status, errors, error_text);
        return false;
    }
    char place[32] = "any line";
    if (wanted != ANY_LINE)
        snprintf(place, sizeof place, "line %ld", wanted);
    text_add_format(error_text, "expected an error in %s, got ", place);
    if (WEXITSTATUS(status) == 0) {
        text_add_format(error_text, "none");
        return false;
    }
    const char *at = errors->bytes;
    long first = next_reported_line(&at, name);
    for (long line = first; line != NO_LINE; line = next_reported_line(&at, name)) {
        if (wanted == ANY_LINE || line == wanted) {
            text_free(error_text);
            return true;
        }
    }
    if (first == NO_LINE)
        subprocess_describe(status, errors, error_text);
    else
        text_add_format(error_text, "one in line %ld", first);
    return false;
}
