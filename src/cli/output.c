// output.c: buffered writing to standard output that notices when it fails.
#include "cli/output.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

void output_start(Output *output, int fd) {
    output->fd = fd;
    output->error = 0;
    output->used = 0;
}

static void write_all(Output *output, const char *text, size_t length) {
    while (length > 0 && output->error == 0) {
        ssize_t written = write(output->fd, text, length);
        if (written >= 0) {
            text += written;
            length -= (size_t)written;
        } else if (errno != EINTR) {
            output->error = errno;
        }
    }
}

bool output_flush(Output *output) {
    write_all(output, output->buffer, output->used);
    output->used = 0;
    return output->error == 0;
}

bool output_write(void *host, const char *text, size_t length) {
    Output *output = host;
    if (output->used + length > sizeof output->buffer) {
        output_flush(output);
    }
    if (length > sizeof output->buffer) {
        write_all(output, text, length);
    } else {
        memcpy(output->buffer + output->used, text, length);
        output->used += length;
    }
    return output->error == 0;
}

bool output_format(Output *output, const char *format, ...) {
    char line[512];
    va_list list;
    va_start(list, format);
    int length = vsnprintf(line, sizeof line, format, list);
    va_end(list);
    if (length < 0) {
        return false;
    }
    if ((size_t)length < sizeof line) {
        return output_write(output, line, (size_t)length);
    }
    char *text = malloc((size_t)length + 1);
    if (text == NULL) {
        return false;
    }
    va_start(list, format);
    vsnprintf(text, (size_t)length + 1, format, list);
    va_end(list);
    bool written = output_write(output, text, (size_t)length);
    free(text);
    return written;
}

int output_finish(Output *output, int status) {
    output_flush(output);
    if (output->error == 0 || output->error == EPIPE) {
        return status;
    }
    message("cannot write standard output: %s", strerror(output->error));
    return STATUS_FAILED;
}
