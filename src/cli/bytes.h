// bytes.h: growable text and memory for the command. Where memory is used up, a message is given and the process ends.
#ifndef PETRI_SRC_BYTES_H
#define PETRI_SRC_BYTES_H

#include "base/str.h"

void *memory_zeroed(size_t size);
void *memory_resized(void *block, size_t size);
char *memory_copied(const char *text, size_t length);
char *memory_text(const char *text);

// `data` ends in a NUL that `length` does not count, once something was added.
typedef struct Bytes {
    char *data;
    size_t length;
    size_t capacity;
} Bytes;

void bytes_add(Bytes *text, const char *more, size_t length);
void bytes_add_text(Bytes *text, const char *more);
__attribute__((format(printf, 2, 3))) void bytes_format(Bytes *text, const char *format, ...);
__attribute__((format(printf, 2, 0))) void bytes_format_list(Bytes *text, const char *format, va_list list);
// A PetriWrite; `bytes` is the Bytes.
bool bytes_collect(void *bytes, const char *text, size_t length);
// The line at *at without its end, and on to the next; false at the end of the text.
bool bytes_line(const Bytes *text, size_t *at, Str *line);
// Adds all that can be read from the descriptor, or little more than `most`; or from the file. False with errno set.
bool bytes_read(Bytes *text, int fd, size_t most);
bool bytes_read_file(Bytes *text, const char *path);
// Adds a path as a URI reference, `file:` if it is absolute.
void bytes_add_uri(Bytes *text, const char *path);
void bytes_free(Bytes *text);
void memory_drop(char **text);

// Texts of its own, each ended by NUL.
typedef struct TextList {
    char **items; // NULL is behind the last, or in their place
    size_t count;
} TextList;

void texts_add(TextList *list, const char *text);
bool texts_hold(const TextList *list, const char *text);
void texts_free(TextList *list);

// Variables that free what they hold at the end of their block: `SCOPED_BYTES name = {0};`, `SCOPED_TEXT name = …;`.
#define SCOPED_BYTES __attribute__((cleanup(bytes_free))) Bytes
#define SCOPED_TEXT __attribute__((cleanup(memory_drop))) char *

#endif
