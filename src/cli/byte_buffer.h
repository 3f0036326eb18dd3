// byte_buffer.h: growable buffers, lists of strings, and memory allocation for the command.
//
// If memory runs out, these functions print a message and exit. They never return NULL.
#pragma once

#include "base/str.h"

// The caller frees the results with free. memory_calloc and memory_realloc accept a size of 0.
void *memory_calloc(size_t size); // zeroed
void *memory_realloc(void *block, size_t size);
char *memory_strndup(const char *text, size_t length); // copies `length` bytes and adds a NUL
char *memory_strdup(const char *text);

typedef struct ByteBuffer {
    char *data;    // NUL-terminated; NULL until the first text is added, which may be empty
    size_t length; // bytes, without the NUL
    size_t capacity;
} ByteBuffer;

void byte_buffer_add(ByteBuffer *text, const char *more, size_t length);
void byte_buffer_add_text(ByteBuffer *text, const char *more);
__attribute__((format(printf, 2, 3))) void byte_buffer_format(ByteBuffer *text, const char *format, ...);
__attribute__((format(printf, 2, 0))) void byte_buffer_format_list(ByteBuffer *text, const char *format, va_list list);
// Adds text to the ByteBuffer that `bytes` points to. Always returns true. Can be used as a PetriWriteCallback.
bool byte_buffer_collect(void *bytes, const char *text, size_t length);
// Sets *line to the line at offset *at, without its newline, and moves *at to the next line. Returns false at the end
// of the text.
bool byte_buffer_next_line(const ByteBuffer *text, size_t *at, Str *line);
// Reads `fd` to its end and adds the data to `text`. Stops early once text->length exceeds max_bytes. Returns false and
// sets errno on failure.
bool byte_buffer_read(ByteBuffer *text, int fd, size_t max_bytes);
// Adds the contents of a regular file of at most max_bytes. Returns NULL on success. On failure, returns the reason: a
// string that stays valid until the next call of strerror. For a pipe or a device, fails at once instead of waiting for
// data.
const char *byte_buffer_read_file(ByteBuffer *text, const char *path, size_t max_bytes);
// Like byte_buffer_read_file, for a file that was opened with O_NONBLOCK. Closes `fd`. `fd` may be the negative result
// of a failed open: this function then returns the reason that errno gives.
const char *byte_buffer_read_regular(ByteBuffer *text, int fd, size_t max_bytes);
// Adds a path as a percent-encoded URI: a `file://` URI if the path is absolute, else a relative reference.
void byte_buffer_add_uri(ByteBuffer *text, const char *path);
void byte_buffer_free(ByteBuffer *text);
void memory_free_text(char **text);

// A list of strings. The list owns copies of them.
typedef struct TextList {
    char **items; // `count` strings, then a null pointer; NULL before the first texts_add
    size_t count;
} TextList;

void texts_add(TextList *list, const char *text);
bool texts_contain(const TextList *list, const char *text);
void texts_free(TextList *list);

// Types for variables that are freed at the end of their block, such as `SCOPED_BYTE_BUFFER name = {0};` or
// `SCOPED_TEXT name = memory_strdup(path);`.
#define SCOPED_BYTE_BUFFER __attribute__((cleanup(byte_buffer_free))) ByteBuffer
#define SCOPED_TEXT __attribute__((cleanup(memory_free_text))) char *
