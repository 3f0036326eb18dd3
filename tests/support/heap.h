// heap.h: allocations that fail at will. The test is linked with --wrap for malloc, calloc, realloc, aligned_alloc and
// arena_alloc_slow: in sanitizer and stress builds (nearly) every allocation in an arena comes there.
#ifndef PETRI_TESTS_HEAP_H
#define PETRI_TESTS_HEAP_H

#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__real_realloc(void *bytes, size_t size);
void *__wrap_realloc(void *bytes, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void *__real_arena_alloc_slow(Arena *arena, size_t size);
void *__wrap_arena_alloc_slow(Arena *arena, size_t size);

typedef struct Heap {
    bool counts;  // allocations are those of libpetri, not of the test
    bool all;     // … and those after it fail, too
    long fail_at; // the number of the allocation that fails
    long count;
} Heap;

static Heap heap;

// From now on allocations are counted from 0, and that of a number fails, or all from there on.
static inline void heap_fail(long number, bool all) {
    heap = (Heap){.counts = true, .all = all, .fail_at = number};
}

// Allocations are as usual again.
static inline void heap_restore(void) {
    heap.counts = false;
}

static inline bool heap_must_fail(void) {
    if (!heap.counts)
        return false;
    long number = heap.count++;
    return number == heap.fail_at || (heap.all && number > heap.fail_at);
}

void *__wrap_malloc(size_t size) {
    return heap_must_fail() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
    return heap_must_fail() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *bytes, size_t size) {
    return heap_must_fail() ? NULL : __real_realloc(bytes, size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return heap_must_fail() ? NULL : __real_aligned_alloc(alignment, size);
}

void *__wrap_arena_alloc_slow(Arena *arena, size_t size) {
    if (heap_must_fail())
        arena_exhausted(arena);
    return __real_arena_alloc_slow(arena, size);
}

#endif
