// bytes.c: growable text and memory for the command.
#include "cli/bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "cli/cli.h"

enum { READ_BLOCK = 1 << 16 };

static void *or_exit(void *block) {
    if (block == NULL) {
        message("out of memory");
        exit(STATUS_FAILED);
    }
    return block;
}

void *memory_zeroed(size_t size) {
    return or_exit(calloc(1, size == 0 ? 1 : size));
}

void *memory_resized(void *block, size_t size) {
    return or_exit(realloc(block, size));
}

char *memory_copied(const char *text, size_t length) {
    char *copy = or_exit(malloc(length + 1));
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

char *memory_text(const char *text) {
    return memory_copied(text, strlen(text));
}

static void reserve(Bytes *text, size_t more) {
    size_t needed = text->length + more + 1;
    if (needed > text->capacity) {
        text->capacity = needed > 2 * text->capacity ? needed : 2 * text->capacity;
        text->data = memory_resized(text->data, text->capacity);
    }
}

void bytes_add(Bytes *text, const char *more, size_t length) {
    reserve(text, length);
    memcpy(text->data + text->length, more, length);
    text->length += length;
    text->data[text->length] = '\0';
}

void bytes_add_text(Bytes *text, const char *more) {
    bytes_add(text, more, strlen(more));
}

void bytes_format_list(Bytes *text, const char *format, va_list list) {
    va_list again;
    va_copy(again, list);
    int length = vsnprintf(NULL, 0, format, list);
    reserve(text, length < 0 ? 0 : (size_t)length);
    vsnprintf(text->data + text->length, (size_t)(length < 0 ? 0 : length) + 1, format, again);
    va_end(again);
    text->length += length < 0 ? 0 : (size_t)length;
}

void bytes_format(Bytes *text, const char *format, ...) {
    va_list list;
    va_start(list, format);
    bytes_format_list(text, format, list);
    va_end(list);
}

bool bytes_collect(void *bytes, const char *text, size_t length) {
    bytes_add(bytes, text, length);
    return true;
}

bool bytes_line(const Bytes *text, size_t *at, Str *line) {
    if (*at >= text->length) {
        return false;
    }
    const char *start = text->data + *at, *end = memchr(start, '\n', text->length - *at);
    *line = (Str){start, end == NULL ? text->length - *at : (size_t)(end - start)};
    *at += line->len + 1;
    return true;
}

bool bytes_read(Bytes *text, int fd, size_t most) {
    ssize_t got = 1;
    bytes_add_text(text, "");
    while (got != 0 && text->length <= most) {
        reserve(text, READ_BLOCK);
        got = read(fd, text->data + text->length, READ_BLOCK);
        if (got < 0 && errno != EINTR) {
            return false;
        }
        text->length += got > 0 ? (size_t)got : 0;
        text->data[text->length] = '\0';
    }
    return true;
}

bool bytes_read_file(Bytes *text, const char *path) {
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        return false;
    }
    bool done = bytes_read(text, fd, SIZE_MAX);
    int error = errno;
    close(fd);
    errno = error;
    return done;
}

void bytes_add_uri(Bytes *text, const char *path) {
    bytes_add_text(text, path[0] == '/' ? "file://" : "");
    for (const char *c = path; *c != '\0'; c++) {
        bool plain = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
                     strchr("/-._~", *c) != NULL;
        bytes_format(text, plain ? "%c" : "%%%02X", (unsigned char)*c);
    }
}

void bytes_free(Bytes *text) {
    free(text->data);
    *text = (Bytes){0};
}

void memory_drop(char **text) {
    free(*text);
}

void texts_add(TextList *list, const char *text) {
    list->items = memory_resized(list->items, (list->count + 2) * sizeof *list->items);
    list->items[list->count++] = memory_text(text);
    list->items[list->count] = NULL;
}

bool texts_hold(const TextList *list, const char *text) {
    size_t i = 0;
    while (i < list->count && strcmp(list->items[i], text) != 0) {
        i++;
    }
    return i < list->count;
}

void texts_free(TextList *list) {
    while (list->count > 0) {
        free(list->items[--list->count]);
    }
    free(list->items);
    list->items = NULL;
}
