// allocator.c: memory functions of the host (petri_set_allocator).
#include "base/heap.h"
#include "petri.h"

PetriStatus petri_set_allocator(const PetriAllocator *allocator) {
    if (!allocator)
        return heap_set_allocator(NULL) ? PETRI_OK : PETRI_INVALID;
    if (allocator->size != sizeof *allocator || !allocator->allocate || !allocator->resize || !allocator->release)
        return PETRI_INVALID;
    HeapAllocator source = {allocator->allocate, allocator->resize, allocator->release, allocator->user_data};
    return heap_set_allocator(&source) ? PETRI_OK : PETRI_INVALID;
}
