// heap_array.c: the functions of heap.h that have no state, so that each shared library can have a copy.
#include "base/heap.h"

#include <stdlib.h>
#include <string.h>

__attribute__((weak)) void heap_exhausted(void) {
    abort();
}

char *heap_strndup(const char *bytes, size_t length) {
    char *copy = length < SIZE_MAX ? heap_alloc(length + 1) : NULL;
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
