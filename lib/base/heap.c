// heap.c: see heap.h.
//
// Blocks are counted, because the allocator can be changed only while there is none.
#include "base/heap.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// The only mutable global state outside sessions. It is global because some callers have no session, such as painters
// that share a shader.
static HeapAllocator current_allocator; // if `allocate` is NULL, the C library is used
static atomic_size_t block_count;       // number of allocated blocks

static void *count_block(void *block) {
    if (block)
        atomic_fetch_add_explicit(&block_count, 1, memory_order_relaxed);
    return block;
}

bool heap_set_allocator(const HeapAllocator *allocator) {
    if (atomic_load(&block_count) > 0)
        return false;
    current_allocator = allocator ? *allocator : (HeapAllocator){0};
    return true;
}

void *heap_alloc(size_t size) {
    if (size == 0)
        size = 1;
    return count_block(current_allocator.allocate ? current_allocator.allocate(current_allocator.user_data, size)
                                                  : malloc(size));
}

void *heap_calloc(size_t count, size_t size) {
    if (!current_allocator.allocate)
        return count_block(calloc(count ? count : 1, size ? size : 1)); // calloc need not clear fresh pages
    if (size && count > SIZE_MAX / size)
        return NULL;
    void *block = heap_alloc(count * size);
    return block ? memset(block, 0, count * size) : NULL;
}

void *heap_resize(void *block, size_t size) {
    if (!block)
        return heap_alloc(size);
    return current_allocator.allocate ? current_allocator.resize(current_allocator.user_data, block, size)
                                      : realloc(block, size);
}

void heap_free(void *block) {
    if (!block)
        return;
    atomic_fetch_sub_explicit(&block_count, 1, memory_order_relaxed);
    if (current_allocator.allocate)
        current_allocator.release(current_allocator.user_data, block);
    else
        free(block);
}
