// message.c: messages of the command itself, and the search for what a mistyped word was meant to be.
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
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
    file_write(STDERR_FILENO, line, length);
}

bool nearest_offer(Nearest *nearest, const char *name) {
    const char *word = nearest->word;
    size_t length = strlen(word);
    size_t distance = (size_t)str_distance(str_from(word), str_from(name));
    // A shortened word counts as near: `--def` for `--define`.
    if (length >= 3 && strncmp(word, name, length) == 0) {
        distance = 1;
    }
    bool nearer = distance <= 1 + length / 5 && (nearest->name == NULL || distance < nearest->distance);
    if (nearer) {
        nearest->name = name;
        nearest->distance = distance;
    }
    return nearer;
}
