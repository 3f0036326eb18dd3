// captured.h: capture of output to a file descriptor, for tests of messages.
//
// Assert only after captured_end, because a failed assertion would leave the descriptor redirected.
#pragma once

#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct Captured {
    int fd;
    int saved; // the original file
    FILE *file;
    char text[8192];
} Captured;

static inline void captured_begin(Captured *captured, int fd) {
    fflush(NULL);
    captured->fd = fd;
    captured->saved = dup(fd);
    captured->file = tmpfile();
    if (captured->saved < 0 || !captured->file || dup2(fileno(captured->file), fd) < 0)
        abort();
}

// Restores the descriptor and returns what was written: captured->text.
static inline const char *captured_end(Captured *captured) {
    fflush(NULL);
    dup2(captured->saved, captured->fd);
    close(captured->saved);
    rewind(captured->file);
    captured->text[fread(captured->text, 1, sizeof captured->text - 1, captured->file)] = '\0';
    fclose(captured->file);
    return captured->text;
}
