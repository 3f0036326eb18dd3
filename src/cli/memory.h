// memory.h: memory allocation, texts on the heap and lists of strings for the command.
//
// If memory runs out, these functions print a message and exit. They never return NULL.
#pragma once

#include "base/str.h"

// The caller frees the results with free. memory_calloc and memory_realloc accept a size of 0.
void *memory_calloc(size_t size); // zeroed
void *memory_realloc(void *block, size_t size);
char *memory_strndup(const char *text, size_t length); // copies `length` bytes and adds a NUL
char *memory_strdup(const char *text);
char *memory_folder(const char *path); // the folder of the path with its slash, or "." if the path has none
void memory_free_string(char **text);

// Adds text to the Text that `text` points to. Always returns true. Can be used as a PetriWriteCallback.
bool text_collect(void *text, const char *more, size_t length);
// Sets *line to the line at offset *at, without its newline, and moves *at to the next line. Returns false at the end
// of the text.
bool text_next_line(const Text *text, size_t *at, Str *line);
// Adds a path as a percent-encoded URI: a `file://` URI if the path is absolute, else a relative reference.
void text_add_uri(Text *text, const char *path);

// A list of strings. The list owns copies of them.
typedef struct TextList {
    char **items; // `count` strings, then a null pointer; NULL before the first texts_add
    size_t count;
} TextList;

void texts_add(TextList *list, const char *text);
__attribute__((format(printf, 2, 3))) void texts_add_format(TextList *list, const char *format, ...);
bool texts_contain(const TextList *list, const char *text);
// Removes each string that equals `text`.
void texts_remove(TextList *list, const char *text);
void texts_free(TextList *list);

// Types for variables that are freed at the end of their block, such as `SCOPED_TEXT name = {0};` or
// `SCOPED_STRING name = memory_strdup(path);`.
#define SCOPED_TEXT __attribute__((cleanup(text_free))) Text
#define SCOPED_STRING __attribute__((cleanup(memory_free_string))) char *
