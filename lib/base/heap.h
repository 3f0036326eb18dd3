// heap.h: the heap allocator.
//
// Memory comes from the C library or from the functions set by petri_set_allocator. All libraries allocate through this
// file, which tests/lint/check_allocators.sh enforces. Blocks are aligned to 16 bytes. Allocations return NULL if out
// of memory. Any thread may call these functions, except heap_set_allocator.
#pragma once

#include "base/private_api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct HeapAllocator {
    void *(*allocate)(void *user_data, size_t size);
    void *(*resize)(void *user_data, void *block, size_t size);
    void (*release)(void *user_data, void *block);
    void *user_data;
} HeapAllocator;

// Sets the functions for all later allocations; the struct is copied. NULL selects the C library. Returns false, with
// nothing changed, if any block is still allocated. No other thread may call a function of this file at the same time.
bool heap_set_allocator(const HeapAllocator *allocator);

void *heap_alloc(size_t size) PRIVATE_API(heap_alloc);
// Allocates a zeroed array.
void *heap_calloc(size_t count, size_t size) PRIVATE_API(heap_calloc);
// Resizes a block, which may move. `size` must not be 0. On failure returns NULL, and the block is unchanged. If
// `block` is NULL, allocates a new block.
void *heap_resize(void *block, size_t size) PRIVATE_API(heap_resize);
// Frees a block. NULL is ignored.
void heap_free(void *block) PRIVATE_API(heap_free);
// Called if memory for a Text on the heap (base/str.h) runs out. In the library, which has no such texts, this function
// aborts the process. The command replaces it by a function that prints a message and exits.
_Noreturn void heap_exhausted(void);
// Returns a copy of `length` bytes, followed by a NUL byte.
char *heap_strndup(const char *bytes, size_t length);
// Ensures that the heap array *array can hold at least count + 1 elements of `size` bytes each. Updates *capacity if
// the array grows. Returns false, with nothing changed, if out of memory.
bool heap_reserve(void **array, uint32_t *capacity, uint32_t count, size_t size);
