// heap.h: where petri's memory comes from: the C library, or functions of the host's (petri_set_allocator). All rooms
// ask here and nowhere else, which tests/lint/check_allocators.sh sees to.
//
// A block is aligned for any type of C, 16 bytes. NULL if there is none. Any thread may call these functions.
#ifndef PETRI_BASE_HEAP_H
#define PETRI_BASE_HEAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct HeapAllocator {
    void *(*allocate)(void *user_data, size_t size);
    void *(*resize)(void *user_data, void *block, size_t size);
    void (*release)(void *user_data, void *block);
    void *user_data;
} HeapAllocator;

// From now on blocks come from `source`, which is copied; NULL: from the C library. False, and nothing changes, while a
// block is held that would go back to where it does not come from. No other thread may be in one of these functions.
bool heap_set_allocator(const HeapAllocator *allocator);

void *heap_alloc(size_t size);
// Cleared room for an array.
void *heap_calloc(size_t count, size_t size);
// The block with another size, which is not 0; the old one stays if there is none. NULL gives a new one.
void *heap_resize(void *block, size_t size);
// Gives a block back. NULL is fine.
void heap_free(void *block);
// A copy of a text, with a NUL byte behind it.
char *heap_strndup(const char *bytes, size_t length);
// Makes room for element number `count` of an array; false if there is none (then nothing has changed).
bool heap_reserve(void **array, uint32_t *capacity, uint32_t count, size_t size);

#endif
