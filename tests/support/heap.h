// heap.h: simulated allocation failures. The test must be linked with --wrap for malloc, calloc, realloc, aligned_alloc
// and arena_alloc_slow. In sanitizer and stress builds, nearly all arena allocations use arena_alloc_slow.
#pragma once

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
    bool counts;  // true while allocations are counted; false for the test's own allocations
    bool all;     // true: all allocations from number fail_at fail; false: only that one fails
    long fail_at; // number of the allocation that fails, counted from 0
    long count;   // number of allocations so far
} Heap;

static Heap heap;

// Starts to count allocations from 0. Allocation `number` fails. If `all` is true, all later ones also fail.
static inline void heap_fail(long number, bool all) {
    heap = (Heap){.counts = true, .all = all, .fail_at = number};
}

// Stops simulating failures.
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
