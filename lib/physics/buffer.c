// buffer.c: growing arrays whose memory is reused from frame to frame.
#include "physics/internal.h"

#include <string.h>

enum { GROWTH_DIVISOR = 16 }; // if nothing is retained, the capacity grows by at least 1/16

bool phys_buffer_reserve(PhysSystem *system, Buffer *buffer, uint64_t retained, uint64_t count, uint64_t size) {
    if (system->failed)
        return false;
    uint64_t needed;
    if (!__builtin_mul_overflow(count, size, &needed) && needed <= buffer->capacity)
        return true; // the usual case; must be fast, because this is called for every particle
    uint64_t others = system->bytes - buffer->capacity;
    if (size && count > (PHYS_MAX_BYTES - others) / size) {
        system->failed = true;
        return false;
    }
    // If contents are retained, the capacity is doubled, so that adding n single elements takes a time proportional to
    // n. Buffers that are refilled from scratch grow rarely and by little, so they are not doubled.
    uint64_t more = retained ? buffer->capacity : buffer->capacity / GROWTH_DIVISOR;
    uint64_t capacity = buffer->capacity + more > needed ? buffer->capacity + more : needed;
    if (!retained) // free the old block first, so that the old and the new block need not fit into memory together
        phys_buffer_free(buffer);
    if (capacity > PHYS_MAX_BYTES - others)
        capacity = needed;
    Buffer larger = {.capacity = capacity, .shown = buffer->shown};
    arena_init(&larger.arena, "physics", SIZE_MAX);
    larger.arena.budget = system->options.budget;
    // This is the arena's only block, so nothing needs to be freed on failure.
    larger.bytes = arena_try_alloc(&larger.arena, (size_t)capacity);
    if (!larger.bytes) {
        system->bytes = others + buffer->capacity;
        system->failed = true;
        return false;
    }
    if (retained)
        memcpy(larger.bytes, buffer->bytes, (size_t)retained);
    phys_buffer_free(buffer);
    *buffer = larger;
    system->bytes = others + capacity;
    return true;
}

bool phys_buffer_grow(PhysSystem *system, Buffer *buffer, uint64_t count, uint64_t size) {
    return phys_buffer_reserve(system, buffer, count * size, count + 1, size);
}

void phys_buffer_free(Buffer *buffer) {
    if (buffer->shown)
        arena_retire(&buffer->arena);
    else
        arena_free(&buffer->arena);
    buffer->bytes = NULL;
    buffer->capacity = 0;
}
