// message.c: messages of the command itself, and the search for what a mistyped word was meant to be.
#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

void message(const char *format, ...) {
    // One write for the whole line, so that messages of parallel processes do not mix.
    char line[1024];
    size_t length = (size_t)snprintf(line, sizeof line, "petri: ");
    va_list list;
    va_start(list, format);
    int written = vsnprintf(line + length, sizeof line - length, format, list);
    va_end(list);
    length = written < 0 ? length : length + (size_t)written;
    if (length > sizeof line - 2) {
        length = sizeof line - 2;
    }
    line[length] = '\n';
    length++;
    // Not by stdio, which drops what a signal interrupts: Ctrl-C comes just when there is something to say about it.
    for (size_t done = 0; done < length;) {
        ssize_t put = write(STDERR_FILENO, line + done, length - done);
        if (put < 0 && errno != EINTR) {
            break;
        }
        done += put < 0 ? 0 : (size_t)put;
    }
}

enum { LONGEST_WORD = 32 };

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

// Changes of one letter (insert, remove, replace, swap with its neighbour) that turn one word into the other; SIZE_MAX
// for long words.
static size_t edit_distance(const char *a, const char *b) {
    size_t rows = strlen(a);
    size_t columns = strlen(b);
    if (rows > LONGEST_WORD || columns > LONGEST_WORD) {
        return SIZE_MAX;
    }
    size_t table[LONGEST_WORD + 1][LONGEST_WORD + 1];
    for (size_t j = 0; j <= columns; j++) {
        table[0][j] = j;
    }
    for (size_t i = 1; i <= rows; i++) {
        table[i][0] = i;
        for (size_t j = 1; j <= columns; j++) {
            size_t replaced = table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            table[i][j] = least(replaced, least(table[i - 1][j], table[i][j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                table[i][j] = least(table[i][j], table[i - 2][j - 2] + 1);
            }
        }
    }
    return table[rows][columns];
}

bool is_nearer(const char *word, const char *candidate, size_t *best) {
    size_t length = strlen(word);
    size_t distance = edit_distance(word, candidate);
    // A shortened word counts as near: `--def` for `--define`.
    if (length >= 3 && strncmp(word, candidate, length) == 0) {
        distance = 1;
    }
    if (distance > 1 + length / 5 || distance >= *best) {
        return false;
    }
    *best = distance;
    return true;
}
