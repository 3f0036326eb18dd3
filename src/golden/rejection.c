// rejection.c: scripts that must be rejected.
#include "golden/golden.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "cli/child.h"

enum { ANY_LINE = -1, NO_LINE = 0 };

// The line that the .err file names, or NO_LINE after adding what is wrong with it.
static long read_line_number(const char *path, Bytes *trouble) {
    SCOPED_BYTES text = {0};
    long line = NO_LINE;
    char rest = '\0';
    if (!bytes_read_file(&text, path)) {
        bytes_format(trouble, "cannot read %s: %s", path, strerror(errno));
        return NO_LINE;
    }
    if (strncmp(text.data, "line *", 6) == 0 && sscanf(text.data + 6, " %c", &rest) != 1) {
        line = ANY_LINE;
    } else if (sscanf(text.data, "line %ld %c", &line, &rest) != 1 || line < 1) {
        bytes_format(trouble, "cannot read %s: expected 'line N' or 'line *'", path);
        line = NO_LINE;
    }
    return line;
}

// The line of the next `NAME:LINE:` in the errors; moves `at` behind it. NO_LINE if there is none.
static long next_reported_line(const char **at, const char *name) {
    size_t length = strlen(name);
    for (const char *found = strstr(*at, name); found != NULL; found = strstr(found + 1, name)) {
        char *end = NULL;
        long line = found[length] == ':' ? strtol(found + length + 1, &end, 10) : NO_LINE;
        if (line > 0 && *end == ':') {
            *at = end;
            return line;
        }
    }
    return NO_LINE;
}

bool rejection_check(const char *path, const char *name, int status, const Bytes *errors, Bytes *trouble) {
    long wanted = read_line_number(path, trouble);
    if (wanted == NO_LINE) {
        return false;
    }
    if (!WIFEXITED(status)) {
        child_describe(status, errors, trouble);
        return false;
    }
    char place[32] = "any line";
    if (wanted != ANY_LINE) {
        snprintf(place, sizeof place, "line %ld", wanted);
    }
    bytes_format(trouble, "expected an error in %s got ", place);
    if (WEXITSTATUS(status) == 0) {
        bytes_format(trouble, "none");
        return false;
    }
    const char *at = errors->data;
    long first = next_reported_line(&at, name);
    for (long line = first; line != NO_LINE; line = next_reported_line(&at, name)) {
        if (wanted == ANY_LINE || line == wanted) {
            bytes_free(trouble);
            return true;
        }
    }
    if (first == NO_LINE) {
        child_describe(status, errors, trouble);
    } else {
        bytes_format(trouble, "one in line %ld", first);
    }
    return false;
}
