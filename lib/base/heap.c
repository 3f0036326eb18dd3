// heap.c: see heap.h.
#include "base/heap.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// The one thing that changes and is no session's: blocks are asked for where none is at hand (a number is read, a
// program of the GPU is shared by painters).
static HeapSource memory;  // `take` is NULL: the C library
static atomic_size_t held; // blocks

static void *counted(void *block) {
    if (block)
        atomic_fetch_add_explicit(&held, 1, memory_order_relaxed);
    return block;
}

bool heap_from(const HeapSource *source) {
    if (atomic_load(&held) > 0)
        return false;
    memory = source ? *source : (HeapSource){0};
    return true;
}

void *heap_take(size_t size) {
    if (size == 0)
        size = 1;
    return counted(memory.take ? memory.take(memory.host, size) : malloc(size));
}

void *heap_zeroed(size_t count, size_t size) {
    if (!memory.take)
        return counted(calloc(count ? count : 1, size ? size : 1)); // the kernel's pages are cleared already
    if (size && count > SIZE_MAX / size)
        return NULL;
    void *block = heap_take(count * size);
    return block ? memset(block, 0, count * size) : NULL;
}

void *heap_resize(void *block, size_t size) {
    if (!block)
        return heap_take(size);
    return memory.take ? memory.resize(memory.host, block, size) : realloc(block, size);
}

void heap_give(void *block) {
    if (!block)
        return;
    atomic_fetch_sub_explicit(&held, 1, memory_order_relaxed);
    if (memory.take)
        memory.give(memory.host, block);
    else
        free(block);
}

char *heap_text(const char *bytes, size_t length) {
    char *copy = length < SIZE_MAX ? heap_take(length + 1) : NULL;
    if (!copy)
        return NULL;
    if (length)
        memcpy(copy, bytes, length);
    copy[length] = 0;
    return copy;
}

bool heap_reserve(void **array, uint32_t *capacity, uint32_t count, size_t size) {
    if (count < *capacity)
        return true;
    uint32_t wanted = count < 16 ? 16 : count + count / 2;
    void *larger = heap_resize(*array, wanted * size);
    if (!larger)
        return false;
    *array = larger;
    *capacity = wanted;
    return true;
}
