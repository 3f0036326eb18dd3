// plain.c: lines without an editor: from files, pipes, and terminals where there is no libedit.
#include "repl/plain.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <unistd.h>

enum { BLOCK = 1 << 16, MOST_ECHOED = 4000 };

PlainWait plain_wait(Repl *repl) {
    for (;;) {
        struct pollfd files[2] = {{STDIN_FILENO, POLLIN, 0}, {-1, POLLIN, 0}};
        files[1].fd = repl->files == NULL ? -1 : watch_descriptor(repl->files);
        int ready = poll(files, 2, repl->files != NULL && files[1].fd < 0 ? 200 : -1);
        if (ready < 0 && errno == EINTR) {
            if (repl_interrupted()) {
                return WAIT_INTERRUPTED;
            }
            continue;
        }
        if (files[0].revents != 0 || ready < 0) {
            return WAIT_INPUT;
        }
        if (repl_notice(repl, true)) {
            return WAIT_NOTICED;
        }
    }
}

// Takes the first line of what was read; false if there is no whole one.
static bool take_line(PlainReader *reader, Bytes *line) {
    const char *start = reader->text.data + reader->at;
    size_t length = reader->text.length - reader->at;
    const char *end = length == 0 ? NULL : memchr(start + reader->searched, '\n', length - reader->searched);
    reader->searched = length;
    if (end == NULL && !(reader->ended && length > 0)) {
        return false;
    }
    size_t taken = end == NULL ? length : (size_t)(end - start);
    bytes_add(line, start, taken);
    reader->at += taken + (end != NULL);
    reader->searched = 0;
    if (line->length > 0 && line->data[line->length - 1] == '\r') {
        line->data[--line->length] = '\0';
    }
    return true;
}

static void echo(Repl *repl, const Bytes *line) {
    if (line->length <= MOST_ECHOED) {
        output_write(&repl->output, line->data, line->length);
        output_write(&repl->output, "\n", 1);
    } else {
        output_write(&repl->output, line->data, 60);
        output_format(&repl->output, "... (%zu bytes)\n", line->length);
    }
}

LineStatus plain_read(PlainReader *reader, Repl *repl, const char *prompt, Bytes *line) {
    bytes_add(line, "", 0);
    output_format(&repl->output, "%s", prompt);
    bool typed = isatty(STDIN_FILENO);
    while (!take_line(reader, line)) {
        if (reader->ended) {
            output_write(&repl->output, "\n", 1);
            return LINE_END;
        }
        output_flush(&repl->output);
        PlainWait wait = plain_wait(repl);
        if (wait == WAIT_INTERRUPTED) {
            output_write(&repl->output, "\n", 1);
            return LINE_INTERRUPTED;
        }
        if (wait == WAIT_NOTICED) {
            output_format(&repl->output, "%s", prompt);
            continue;
        }
        if (reader->at > 0) {
            memmove(reader->text.data, reader->text.data + reader->at, reader->text.length - reader->at);
            reader->text.length -= reader->at;
            reader->at = 0;
        }
        char block[BLOCK];
        ssize_t got = read(STDIN_FILENO, block, sizeof block);
        reader->ended = got == 0 || (got < 0 && errno != EINTR);
        bytes_add(&reader->text, block, got > 0 ? (size_t)got : 0);
    }
    if (!typed) {
        echo(repl, line);
    }
    return LINE_READ;
}
