// output.c: see output.h.
#include "cli/output.h"

#include "base/file.h"
#include "base/number.h"
#include "cli/cli.h"
#include "cli/memory.h"

#include <errno.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void output_start(Output *output, int fd) {
    output->fd = fd;
    output->send = NULL;
    output->error = 0;
    output->written = output->used = 0;
}

static void write_all(Output *output, const char *text, size_t length) {
    if (output->error == 0 &&
        !(output->send ? output->send(output->user_data, text, length) : file_write(output->fd, text, length)))
        output->error = errno;
}

// `used` is cleared before `written` grows, so a signal handler that reads both never counts bytes twice.
bool output_flush(Output *output) {
    size_t used = output->used;
    write_all(output, output->buffer, used);
    output->used = 0;
    atomic_signal_fence(memory_order_seq_cst);
    output->written += used;
    return output->error == 0;
}

bool output_write(void *user_data, const char *text, size_t length) {
    Output *output = user_data;
    if (output->used + length > sizeof output->buffer)
        output_flush(output);
    if (length > sizeof output->buffer) {
        write_all(output, text, length);
        output->written += length;
    } else {
        memcpy(output->buffer + output->used, text, length);
        atomic_signal_fence(memory_order_seq_cst);
        output->used += length;
    }
    return output->error == 0;
}

bool output_number(Output *output, char before, double x) {
    if (output->used + 1 + NUMBER_TEXT > sizeof output->buffer)
        output_flush(output);
    char *at = output->buffer + output->used;
    *at = before;
    size_t length = 1 + number_format(x, at + 1);
    atomic_signal_fence(memory_order_seq_cst);
    output->used += length;
    return output->error == 0;
}

bool output_format(Output *output, const char *format, ...) {
    size_t available = sizeof output->buffer - output->used;
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int length = vsnprintf(output->buffer + output->used, available, format, list);
    if (length >= 0 && (size_t)length < available) {
        output->used += (size_t)length;
    } else {
        SCOPED_TEXT text = {0};
        text_add_va(&text, format, again);
        output_write(output, text.bytes, text.len);
    }
    va_end(again);
    va_end(list);
    return output->error == 0;
}

int output_finish(Output *output, int status) {
    output_flush(output);
    if (output->error == 0 || output->error == EPIPE)
        return status;
    message("cannot write standard output: %s", strerror(output->error));
    return STATUS_FAILED;
}

bool output_file(const char *path, Str text) {
    const char *problem = file_replace(path, text, 0);
    if (problem)
        message("cannot write %s: %s", path, problem);
    return !problem;
}

int output_text(const char *text, size_t length, int status) {
    Output *output = memory_calloc(sizeof *output);
    output_start(output, STDOUT_FILENO);
    output_write(output, text, length);
    status = output_finish(output, status);
    free(output);
    return status;
}
