// byte_buffer.h: growable text and memory for the command. Where memory is used up, a message is given and the process
// ends.
#ifndef PETRI_SRC_BYTE_BUFFER_H
#define PETRI_SRC_BYTE_BUFFER_H

#include "base/str.h"

void *memory_calloc(size_t size);
void *memory_realloc(void *block, size_t size);
char *memory_strndup(const char *text, size_t length);
char *memory_strdup(const char *text);

// `data` ends in a NUL that `length` does not count, once something was added.
typedef struct ByteBuffer {
    char *data;
    size_t length;
    size_t capacity;
} ByteBuffer;

void byte_buffer_add(ByteBuffer *text, const char *more, size_t length);
void byte_buffer_add_text(ByteBuffer *text, const char *more);
__attribute__((format(printf, 2, 3))) void byte_buffer_format(ByteBuffer *text, const char *format, ...);
__attribute__((format(printf, 2, 0))) void byte_buffer_format_list(ByteBuffer *text, const char *format, va_list list);
// A PetriWriteCallback; `bytes` is the ByteBuffer.
bool byte_buffer_collect(void *bytes, const char *text, size_t length);
// The line at *at without its end, and on to the next; false at the end of the text.
bool byte_buffer_next_line(const ByteBuffer *text, size_t *at, Str *line);
// Adds all that can be read from the descriptor, or little more than `most`; or from the file. False with errno set.
bool byte_buffer_read(ByteBuffer *text, int fd, size_t max_bytes);
bool byte_buffer_read_file(ByteBuffer *text, const char *path);
// Adds a path as a URI reference, `file:` if it is absolute.
void byte_buffer_add_uri(ByteBuffer *text, const char *path);
void byte_buffer_free(ByteBuffer *text);
void memory_free_text(char **text);

// Texts of its own, each ended by NUL.
typedef struct TextList {
    char **items; // NULL is behind the last, or in their place
    size_t count;
} TextList;

void texts_add(TextList *list, const char *text);
bool texts_contain(const TextList *list, const char *text);
void texts_free(TextList *list);

// Variables that free what they hold at the end of their block: `SCOPED_BYTE_BUFFER name = {0};`, `SCOPED_TEXT name =
// …;`.
#define SCOPED_BYTE_BUFFER __attribute__((cleanup(byte_buffer_free))) ByteBuffer
#define SCOPED_TEXT __attribute__((cleanup(memory_free_text))) char *

#endif
