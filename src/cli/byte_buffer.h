// byte_buffer.h: growable text buffers and memory for the command.
//
// If out of memory, these functions print a message and end the process, so they never return NULL.
#ifndef PETRI_SRC_BYTE_BUFFER_H
#define PETRI_SRC_BYTE_BUFFER_H

#include "base/str.h"

void *memory_calloc(size_t size);
void *memory_realloc(void *block, size_t size);
char *memory_strndup(const char *text, size_t length);
char *memory_strdup(const char *text);

typedef struct ByteBuffer {
    char *data;    // NULL until something is added, even if it is empty; then NUL-terminated
    size_t length; // bytes, without the NUL
    size_t capacity;
} ByteBuffer;

void byte_buffer_add(ByteBuffer *text, const char *more, size_t length);
void byte_buffer_add_text(ByteBuffer *text, const char *more);
__attribute__((format(printf, 2, 3))) void byte_buffer_format(ByteBuffer *text, const char *format, ...);
__attribute__((format(printf, 2, 0))) void byte_buffer_format_list(ByteBuffer *text, const char *format, va_list list);
// Adds text to the ByteBuffer that `bytes` points to. Can be used as a PetriWriteCallback.
bool byte_buffer_collect(void *bytes, const char *text, size_t length);
// Sets *line to the line at *at without its newline and moves *at to the next line. Returns false at the end of the
// text.
bool byte_buffer_next_line(const ByteBuffer *text, size_t *at, Str *line);
// Adds everything that can be read from `fd`. Stops soon after the text is longer than max_bytes. Returns false and
// sets errno on failure.
bool byte_buffer_read(ByteBuffer *text, int fd, size_t max_bytes);
// Adds a file's contents. Returns false and sets errno on failure.
bool byte_buffer_read_file(ByteBuffer *text, const char *path);
// Adds a path as a URI reference: with `file://` if it is absolute, else relative.
void byte_buffer_add_uri(ByteBuffer *text, const char *path);
void byte_buffer_free(ByteBuffer *text);
void memory_free_text(char **text);

// A list that owns copies of its texts.
typedef struct TextList {
    char **items; // NUL-terminated texts, then NULL; NULL if the list is empty
    size_t count;
} TextList;

void texts_add(TextList *list, const char *text);
bool texts_contain(const TextList *list, const char *text);
void texts_free(TextList *list);

// Types for variables that are freed at the end of their block, such as `SCOPED_BYTE_BUFFER name = {0};` or
// `SCOPED_TEXT name = memory_strdup(path);`.
#define SCOPED_BYTE_BUFFER __attribute__((cleanup(byte_buffer_free))) ByteBuffer
#define SCOPED_TEXT __attribute__((cleanup(memory_free_text))) char *

#endif
