// arena.c: see arena.h.
//
// The blocks form a list. `current` is the block that is being filled, and all blocks after it are empty. They are used
// again, so a frame that needs no more memory than an earlier one allocates none.
#include "base/arena.h"

#include "base/heap.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if ARENA_POISONS
#include <sanitizer/asan_interface.h>
#define POISON(address, size) ASAN_POISON_MEMORY_REGION(address, size)
#define UNPOISON(address, size) ASAN_UNPOISON_MEMORY_REGION(address, size)
#else
#define POISON(address, size) ((void)(address), (void)(size))
#define UNPOISON(address, size) ((void)(address), (void)(size))
#endif

// The stress build uses tiny blocks, so that all code that allocates crosses block boundaries.
#ifdef PETRI_STRESS
enum { MIN_BLOCK_SIZE = 64, MAX_BLOCK_SIZE = 1024 };
#else
enum { MIN_BLOCK_SIZE = 16 << 10, MAX_BLOCK_SIZE = 4 << 20 };
#endif

void arena_init(Arena *arena, const char *name, size_t limit) {
    *arena = (Arena){.limit = limit, .name = name};
}

static void free_blocks(Budget *budget, ArenaBlock *block) {
    for (ArenaBlock *next; block; block = next) {
        next = block->next;
        UNPOISON(block->bytes, block->capacity);
        budget_release(budget, sizeof *block + block->capacity);
        heap_free(block);
    }
}

void arena_free(Arena *arena) {
    free_blocks(arena->budget, arena->first);
    arena->first = arena->current = NULL;
    arena->used = 0;
}

void arena_retire(Arena *arena) {
    Budget *budget = arena->budget;
    for (ArenaBlock *block = arena->first, *next; block && budget && budget->retains; block = next) {
        next = block->next;
        block->next = budget->retained;
        budget->retained = block;
        arena->first = next;
    }
    arena_free(arena);
}

void arena_free_retained(Budget *budget) {
    ArenaBlock *retained = budget->retained;
    budget->retained = NULL;
    free_blocks(budget, retained);
}

void arena_detach_budget(Arena *arena) {
    for (const ArenaBlock *block = arena->first; block; block = block->next)
        budget_release(arena->budget, sizeof *block + block->capacity);
    arena->budget = NULL;
}

static void block_truncate(ArenaBlock *block, size_t fill) {
#ifndef __OPTIMIZE__
    UNPOISON(block->bytes + fill, block->capacity - fill);
    if (block->fill > fill)
        memset(block->bytes + fill, 0xdb, block->fill - fill);
#endif
    POISON(block->bytes + fill, block->capacity - fill);
    block->fill = fill;
}

void arena_rewind(Arena *arena, ArenaMark mark) {
    if (arena->used > arena->high_water)
        arena->high_water = arena->used;
    ArenaBlock *block = mark.block ? mark.block->next : arena->first;
    ArenaBlock *end = arena->current ? arena->current->next : NULL; // later blocks are already empty
    for (; block != end && arena->current != mark.block; block = block->next)
        block_truncate(block, 0);
    if (mark.block)
        block_truncate(mark.block, mark.fill);
    arena->current = mark.block ? mark.block : arena->first;
    arena->used = mark.used;
}

void arena_reset(Arena *arena) {
    arena_rewind(arena, (ArenaMark){0});
}

ArenaMark arena_mark(const Arena *arena) {
    return (ArenaMark){arena->current, arena->current ? arena->current->fill : 0, arena->used};
}

_Noreturn void arena_escape(const Arena *arena, ArenaOutcome end) {
    if (arena->escape)
        longjmp(*arena->escape, (int)end);
    fprintf(stderr, "petri: out of memory (%s)\n", arena->name);
    abort();
}

void arena_check(Arena *arena, BudgetOutcome outcome) {
    if (arena->escape)
        arena_escape(arena, outcome == BUDGET_EXCEEDED ? ARENA_WORK_LIMIT : ARENA_INTERRUPTED);
}

_Noreturn void arena_exhausted(const Arena *arena) {
    arena_escape(arena, ARENA_OUT_OF_MEMORY);
}

// A separate function, so that no local variable of arena_protect can be clobbered by longjmp.
static ArenaOutcome call_with(jmp_buf *escape, void (*call)(void *context), void *context) {
    switch (setjmp(*escape)) {
    case 0:
        call(context);
        return ARENA_OK;
    case ARENA_OUT_OF_MEMORY:
        return ARENA_OUT_OF_MEMORY;
    case ARENA_MEMORY_LIMIT:
        return ARENA_MEMORY_LIMIT;
    case ARENA_WORK_LIMIT:
        return ARENA_WORK_LIMIT;
    default:
        return ARENA_INTERRUPTED;
    }
}

ArenaOutcome arena_protect(Arena *const arenas[], size_t count, void (*call)(void *context), void *context) {
    jmp_buf escape, *outer[ARENA_MAX_PROTECTED] = {NULL};
    assert(count <= ARENA_MAX_PROTECTED);
    for (size_t i = 0; i < count; i++)
        if (arenas[i]) {
            outer[i] = arenas[i]->escape;
            arenas[i]->escape = &escape;
        }
    ArenaOutcome end = call_with(&escape, call, context);
    for (size_t i = count; i-- > 0;) // in reverse order, so that an arena that is listed twice is restored
        if (arenas[i])
            arenas[i]->escape = outer[i];
    return end;
}

typedef struct Attempt {
    Arena *arena;
    size_t size;
    void *bytes;
} Attempt;

static void call_arena_alloc(void *context) {
    Attempt *this = context;
    this->bytes = arena_alloc(this->arena, this->size);
}

void *arena_try_alloc(Arena *arena, size_t size) {
    Attempt this = {arena, size, NULL};
    return arena_protect(&arena, 1, call_arena_alloc, &this) == ARENA_OK ? this.bytes : NULL;
}

// Sets `current` to a block with space for `size` bytes: the next existing block that is large enough, or a new one.
static void arena_next_block(Arena *arena, size_t size) {
    ArenaBlock *last = arena->current;
    for (ArenaBlock *block = last ? last->next : arena->first; block; block = block->next) {
        last = block;
        if (block->capacity - block->fill >= size) {
            arena->current = block;
            return;
        }
    }
    size_t capacity = last ? last->capacity * 2 : MIN_BLOCK_SIZE;
    if (capacity > MAX_BLOCK_SIZE)
        capacity = MAX_BLOCK_SIZE;
    if (capacity < size)
        capacity = size;
    if (!budget_reserve(arena->budget, sizeof(ArenaBlock) + capacity))
        arena_escape(arena, ARENA_MEMORY_LIMIT);
    ArenaBlock *block = heap_alloc(sizeof(ArenaBlock) + capacity);
    if (!block) {
        budget_release(arena->budget, sizeof(ArenaBlock) + capacity);
        arena_exhausted(arena);
    }
    *block = (ArenaBlock){.capacity = capacity};
    POISON(block->bytes, capacity);
    if (last)
        last->next = block;
    else
        arena->first = block;
    arena->current = block;
}

void *arena_alloc_slow(Arena *arena, size_t size) {
    if (size > SIZE_MAX / 2 || size > arena->limit || arena->used > arena->limit - size)
        arena_escape(arena, ARENA_MEMORY_LIMIT);
    size_t rounded = (size + ARENA_ALIGNMENT - 1) & ~(size_t)(ARENA_ALIGNMENT - 1);
    ArenaBlock *block = arena->current;
    if (!block || block->capacity - block->fill < rounded) {
        arena_next_block(arena, rounded);
        block = arena->current;
    }
    void *bytes = block->bytes + block->fill;
    UNPOISON(bytes, size);
    block->fill += rounded;
    arena->used += rounded;
    return bytes;
}

void *arena_alloc_array(Arena *arena, size_t count, size_t size) {
    if (size && count > SIZE_MAX / size)
        arena_escape(arena, ARENA_MEMORY_LIMIT);
    arena_charge(arena, count * size / BUDGET_BYTES);
    return arena_alloc(arena, count * size);
}

void *arena_copy(Arena *arena, const void *bytes, size_t size) {
    void *copy = arena_alloc(arena, size);
    if (size)
        memcpy(copy, bytes, size);
    return copy;
}

void *arena_grow(Arena *arena, void *bytes, size_t old_size, size_t new_size) {
    size_t old_rounded = (old_size + ARENA_ALIGNMENT - 1) & ~(size_t)(ARENA_ALIGNMENT - 1);
    size_t new_rounded = (new_size + ARENA_ALIGNMENT - 1) & ~(size_t)(ARENA_ALIGNMENT - 1);
    ArenaBlock *block = arena->current;
    if (block && old_rounded <= block->fill && (unsigned char *)bytes == block->bytes + block->fill - old_rounded &&
        block->capacity - block->fill >= new_rounded - old_rounded && new_size <= arena->limit &&
        arena->used <= arena->limit - (new_rounded - old_rounded)) {
        UNPOISON(bytes, new_size);
        block->fill += new_rounded - old_rounded;
        arena->used += new_rounded - old_rounded;
        return bytes;
    }
    void *larger = arena_alloc(arena, new_size);
    if (old_size)
        memcpy(larger, bytes, old_size);
    return larger;
}

void *arena_grow_array(Arena *arena, void *items, uint32_t count, uint32_t *capacity, size_t size) {
    if (count < *capacity)
        return items;
    uint32_t larger = *capacity ? *capacity * 2 : 8;
    items = arena_grow(arena, items, *capacity * size, larger * size);
    *capacity = larger;
    return items;
}
