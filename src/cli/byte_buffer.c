// byte_buffer.c: see byte_buffer.h.
#include "cli/byte_buffer.h"

#include "base/file.h"
#include "cli/cli.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { READ_BLOCK = 1 << 16 };

static void *exit_if_null(void *block) {
    if (!block) {
        message("out of memory");
        exit(STATUS_FAILED);
    }
    return block;
}

void *memory_calloc(size_t size) {
    return exit_if_null(calloc(1, size == 0 ? 1 : size));
}

void *memory_realloc(void *block, size_t size) {
    return exit_if_null(realloc(block, size));
}

char *memory_strndup(const char *text, size_t length) {
    char *copy = exit_if_null(malloc(length + 1));
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

char *memory_strdup(const char *text) {
    return memory_strndup(text, strlen(text));
}

static void reserve_bytes(ByteBuffer *text, size_t more) {
    size_t needed = text->length + more + 1;
    if (needed > text->capacity) {
        text->capacity = needed > 2 * text->capacity ? needed : 2 * text->capacity;
        text->data = memory_realloc(text->data, text->capacity);
    }
}

void byte_buffer_add(ByteBuffer *text, const char *more, size_t length) {
    reserve_bytes(text, length);
    memcpy(text->data + text->length, more, length);
    text->length += length;
    text->data[text->length] = '\0';
}

void byte_buffer_add_text(ByteBuffer *text, const char *more) {
    byte_buffer_add(text, more, strlen(more));
}

void byte_buffer_format_list(ByteBuffer *text, const char *format, va_list list) {
    va_list again;
    va_copy(again, list);
    int length = vsnprintf(NULL, 0, format, list);
    reserve_bytes(text, length < 0 ? 0 : (size_t)length);
    vsnprintf(text->data + text->length, (size_t)(length < 0 ? 0 : length) + 1, format, again);
    va_end(again);
    text->length += length < 0 ? 0 : (size_t)length;
}

void byte_buffer_format(ByteBuffer *text, const char *format, ...) {
    va_list list;
    va_start(list, format);
    byte_buffer_format_list(text, format, list);
    va_end(list);
}

bool byte_buffer_collect(void *bytes, const char *text, size_t length) {
    byte_buffer_add(bytes, text, length);
    return true;
}

bool byte_buffer_next_line(const ByteBuffer *text, size_t *at, Str *line) {
    if (*at >= text->length)
        return false;
    const char *start = text->data + *at, *end = memchr(start, '\n', text->length - *at);
    *line = (Str){start, !end ? text->length - *at : (size_t)(end - start)};
    *at += line->len + 1;
    return true;
}

bool byte_buffer_read(ByteBuffer *text, int fd, size_t max_bytes) {
    ssize_t got = 1;
    byte_buffer_add_text(text, "");
    while (got != 0 && text->length <= max_bytes) {
        reserve_bytes(text, READ_BLOCK);
        got = read(fd, text->data + text->length, READ_BLOCK);
        if (got < 0 && errno != EINTR)
            return false;
        text->length += got > 0 ? (size_t)got : 0;
        text->data[text->length] = '\0';
    }
    return true;
}

// Returns NULL if the file can be read as a whole, else the reason.
static const char *check_file(int fd, size_t max_bytes) {
    struct stat about;
    if (fd < 0 || fstat(fd, &about) != 0)
        return strerror(errno);
    if (S_ISDIR(about.st_mode))
        return strerror(EISDIR);
    if (!S_ISREG(about.st_mode))
        return "it is not a regular file";
    return (uintmax_t)about.st_size > max_bytes ? "it is too large" : NULL;
}

const char *byte_buffer_read_regular(ByteBuffer *text, int fd, size_t max_bytes) {
    size_t before = text->length, end = max_bytes > SIZE_MAX - before ? SIZE_MAX : before + max_bytes;
    const char *problem = check_file(fd, max_bytes);
    if (!problem && !byte_buffer_read(text, fd, end))
        problem = strerror(errno);
    else if (!problem && text->length > end) // the file has grown since check_file
        problem = "it is too large";
    if (fd >= 0)
        close(fd);
    return problem;
}

const char *byte_buffer_read_file(ByteBuffer *text, const char *path, size_t max_bytes) {
    return byte_buffer_read_regular(text, open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK), max_bytes);
}

void byte_buffer_add_uri(ByteBuffer *text, const char *path) {
    byte_buffer_add_text(text, path[0] == '/' ? "file://" : "");
    for (const char *c = path; *c != '\0'; c++) {
        bool plain =
            (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') || strchr("/-._~", *c);
        byte_buffer_format(text, plain ? "%c" : "%%%02X", (unsigned char)*c);
    }
}

void byte_buffer_free(ByteBuffer *text) {
    free(text->data);
    *text = (ByteBuffer){0};
}

void memory_free_text(char **text) {
    free(*text);
}

void texts_add(TextList *list, const char *text) {
    list->items = memory_realloc(list->items, (list->count + 2) * sizeof *list->items);
    list->items[list->count++] = memory_strdup(text);
    list->items[list->count] = NULL;
}

bool texts_contain(const TextList *list, const char *text) {
    size_t i = 0;
    while (i < list->count && strcmp(list->items[i], text) != 0)
        i++;
    return i < list->count;
}

void texts_free(TextList *list) {
    while (list->count > 0)
        free(list->items[--list->count]);
    free(list->items);
    list->items = NULL;
}
