// memory.c: see memory.h.
#include "cli/memory.h"

#include "base/heap.h"
#include "base/source.h"

#include <stdlib.h>
#include <string.h>

static void *exit_if_null(void *block) {
    if (!block)
        heap_exhausted();
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

char *memory_folder(const char *path) {
    size_t length = path_directory(str_from(path)).len;
    return length == 0 ? memory_strdup(".") : memory_strndup(path, length);
}

void memory_free_string(char **text) {
    free(*text);
}

bool text_collect(void *text, const char *more, size_t length) {
    text_add(text, (Str){more, length});
    return true;
}

bool text_next_line(const Text *text, size_t *at, Str *line) {
    if (*at >= text->len)
        return false;
    const char *start = text->bytes + *at, *end = memchr(start, '\n', text->len - *at);
    *line = (Str){start, !end ? text->len - *at : (size_t)(end - start)};
    *at += line->len + 1;
    return true;
}

void text_add_uri(Text *text, const char *path) {
    text_add_c(text, path[0] == '/' ? "file://" : "");
    for (const char *c = path; *c != '\0'; c++) {
        bool plain =
            (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') || strchr("/-._~", *c);
        text_add_format(text, plain ? "%c" : "%%%02X", (unsigned char)*c);
    }
}

void texts_add(TextList *list, const char *text) {
    // There is room for the lowest power of two that is greater than `count`.
    if ((list->count & (list->count + 1)) == 0)
        list->items = memory_realloc(list->items, 2 * (list->count + 1) * sizeof *list->items);
    list->items[list->count++] = memory_strdup(text);
    list->items[list->count] = NULL;
}

void texts_add_format(TextList *list, const char *format, ...) {
    SCOPED_TEXT text = {0};
    va_list arguments;
    va_start(arguments, format);
    text_add_va(&text, format, arguments);
    va_end(arguments);
    texts_add(list, text.bytes);
}

bool texts_contain(const TextList *list, const char *text) {
    size_t i = 0;
    while (i < list->count && strcmp(list->items[i], text) != 0)
        i++;
    return i < list->count;
}

void texts_remove(TextList *list, const char *text) {
    size_t kept = 0;
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->items[i], text) == 0)
            free(list->items[i]);
        else
            list->items[kept++] = list->items[i];
    if (list->items)
        list->items[kept] = NULL;
    list->count = kept;
}

void texts_free(TextList *list) {
    while (list->count > 0)
        free(list->items[--list->count]);
    free(list->items);
    list->items = NULL;
}
