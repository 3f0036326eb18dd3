// allocations.c: see allocations.h. The linker redirects calls of malloc to __wrap_malloc.
#include "allocations.h"

#include <stdatomic.h>
#include <stddef.h>

// clang-format off
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_realloc(void *block, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
int __real_posix_memalign(void **block, size_t alignment, size_t size);
int __wrap_posix_memalign(void **block, size_t alignment, size_t size);
// clang-format on

// Atomic, because worker threads also allocate.
static atomic_uint_fast64_t count;

static void count_allocation(void) {
    atomic_fetch_add_explicit(&count, 1, memory_order_relaxed);
}

uint64_t allocations_so_far(void) {
    return atomic_load_explicit(&count, memory_order_relaxed);
}

void *__wrap_malloc(size_t size) {
    count_allocation();
    return __real_malloc(size);
}

void *__wrap_calloc(size_t number, size_t size) {
    count_allocation();
    return __real_calloc(number, size);
}

void *__wrap_realloc(void *block, size_t size) {
    count_allocation();
    return __real_realloc(block, size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    count_allocation();
    return __real_aligned_alloc(alignment, size);
}

int __wrap_posix_memalign(void **block, size_t alignment, size_t size) {
    count_allocation();
    return __real_posix_memalign(block, alignment, size);
}
