// message.c: messages of the command and signal handlers (cli.h); what happens if memory runs out (base/heap.h).
#include "base/file.h"
#include "base/heap.h"
#include "base/str.h"
#include "cli/cli.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void signal_catch(int number, void (*handler)(int), int flags) {
    struct sigaction action = {.sa_handler = handler, .sa_flags = flags}, before;
    sigemptyset(&action.sa_mask);
    if (number != SIGHUP || (sigaction(number, NULL, &before) == 0 && before.sa_handler != SIG_IGN))
        sigaction(number, &action, NULL);
}

// Replaces control characters with `?`, so that a file name or link cannot send escape sequences to the terminal.
// Returns the new length.
static size_t without_controls(char *line, size_t length) {
    size_t kept = 0;
    for (size_t at = 0; at < length;) {
        size_t from = at;
        int32_t c = utf8_next((Str){line, length}, &at);
        if (c != '\t' && c != '\n' && utf8_is_control(c)) {
            line[kept++] = '?';
            continue;
        }
        memmove(line + kept, line + from, at - from);
        kept += at - from;
    }
    return kept;
}

void message(const char *format, ...) {
    // The line is written in one call, so that messages of parallel processes do not mix.
    char line[1024];
    size_t length = (size_t)snprintf(line, sizeof line, "petri: ");
    va_list list;
    va_start(list, format);
    int written = vsnprintf(line + length, sizeof line - length, format, list);
    va_end(list);
    length = written < 0 ? length : length + (size_t)written;
    if (length > sizeof line - 2)
        length = sizeof line - 2;
    length = without_controls(line, length);
    line[length] = '\n';
    length++;
    // stdio is not used, because it would lose output if a signal such as Ctrl-C interrupted the write.
    file_write(STDERR_FILENO, line, length);
}

void heap_exhausted(void) {
    message("out of memory");
    exit(STATUS_FAILED);
}
