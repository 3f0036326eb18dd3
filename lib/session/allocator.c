// allocator.c: memory from the host; see petri.h.
#include "petri.h"

#include "base/heap.h"

PetriStatus petri_set_allocator(const PetriAllocator *allocator) {
    if (!allocator)
        return heap_from(NULL) ? PETRI_OK : PETRI_INVALID;
    if (allocator->size != sizeof *allocator || !allocator->allocate || !allocator->resize || !allocator->release)
        return PETRI_INVALID;
    HeapSource source = {allocator->allocate, allocator->resize, allocator->release, allocator->host};
    return heap_from(&source) ? PETRI_OK : PETRI_INVALID;
}
