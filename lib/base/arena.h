// arena.h: a bump allocator, whose allocations all have the same lifetime.
//
// Each frame, program and session has an arena, and everything allocated from it is freed together. Individual
// allocations are never freed. arena_alloc never returns NULL. If the arena's limit, the budget or the machine's memory
// is exhausted, it escapes: it jumps (longjmp) to the enclosing arena_protect, which returns the reason. Public
// functions, such as those that load a script or compute a frame, convert the reason to a status. If no arena_protect
// encloses the call, which is a bug in petri, the process is aborted.
#pragma once

#include "base/budget.h"

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// With AddressSanitizer, all bytes of a block that are not allocated are poisoned.
#if defined(__SANITIZE_ADDRESS__)
#define ARENA_POISONS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ARENA_POISONS 1
#endif
#endif
#ifndef ARENA_POISONS
#define ARENA_POISONS 0
#endif

enum { ARENA_ALIGNMENT = 16 };

typedef struct ArenaBlock ArenaBlock;
struct ArenaBlock {
    ArenaBlock *next;
    size_t capacity; // size of `bytes`; a multiple of ARENA_ALIGNMENT
    size_t fill;     // number of bytes allocated so far; a multiple of ARENA_ALIGNMENT
    size_t padding;  // keeps `bytes` aligned
    unsigned char bytes[];
};

_Static_assert(offsetof(ArenaBlock, bytes) % ARENA_ALIGNMENT == 0, "block payload must be aligned");

typedef struct Arena {
    ArenaBlock *first;   // linked list of blocks, oldest first; a reset does not free them
    ArenaBlock *current; // the block that is being filled
    size_t used;         // bytes allocated since the last reset, including alignment padding
    size_t high_water;   // largest value that `used` had when a rewind or reset began
    size_t limit;        // maximum of `used`, in bytes
    jmp_buf *escape;     // jump target on failure, in the innermost arena_protect; NULL: a failure aborts the process
    Budget *budget;      // budget that is charged for blocks and work; NULL: nothing is charged
    const char *name;    // name of the arena in error messages
} Arena;

// A point in the sequence of allocations, to which arena_rewind returns.
typedef struct ArenaMark {
    ArenaBlock *block;
    size_t fill;
    size_t used;
} ArenaMark;

// Result of a protected call.
typedef enum ArenaOutcome {
    ARENA_OK,
    ARENA_OUT_OF_MEMORY, // the machine is out of memory
    ARENA_MEMORY_LIMIT,  // the arena's limit or the budget's memory limit was exceeded
    ARENA_WORK_LIMIT,    // the budget's work limit was exceeded
    ARENA_INTERRUPTED,   // the host requested an interrupt
} ArenaOutcome;

enum { ARENA_MAX_PROTECTED = 8 };
// Calls `call`. If an allocation or charge of one of the arenas fails, `call` is aborted and the reason is returned.
// NULL arenas are ignored. If calls of arena_protect are nested, a failure ends the innermost one that lists the arena.
// Heap blocks that `call` allocates must be reachable from `context`, so that the caller can free them if
// `call` is aborted.
ArenaOutcome arena_protect(Arena *const arenas[], size_t count, void (*call)(void *context), void *context);
// Like arena_alloc, but returns NULL on failure.
void *arena_try_alloc(Arena *arena, size_t size);

// Initialises an empty arena that may allocate `limit` bytes between resets. `name` must outlive it.
void arena_init(Arena *arena, const char *name, size_t limit);

// Frees all blocks.
void arena_free(Arena *arena);

// Like arena_free, but if budget->retains is true, the blocks are moved to budget->retained instead of being freed.
// Their bytes stay unchanged and charged to the budget, because the host may still read them.
void arena_retire(Arena *arena);
// Frees the blocks that arena_retire has retained.
void arena_free_retained(Budget *budget);

// Releases the arena's memory from its budget and sets the budget to NULL.
void arena_detach_budget(Arena *arena);

// Drops all allocations but keeps the blocks for reuse. Unoptimised builds overwrite the bytes, and the address
// sanitizer poisons them.
void arena_reset(Arena *arena);

// The slow path of arena_alloc: continues with another block, or escapes if a limit is exceeded.
void *arena_alloc_slow(Arena *arena, size_t size);

// Returns `size` bytes, aligned to 16, uninitialised. Size 0 returns a valid pointer that must not be dereferenced.
static inline void *arena_alloc(Arena *arena, size_t size) {
    ArenaBlock *block = arena->current;
    if (!block || size > block->capacity - block->fill || arena->used + size > arena->limit || ARENA_POISONS)
        return arena_alloc_slow(arena, size);
    size_t rounded = (size + ARENA_ALIGNMENT - 1) & ~(size_t)(ARENA_ALIGNMENT - 1);
    void *bytes = block->bytes + block->fill;
    block->fill += rounded;
    arena->used += rounded;
    return bytes;
}

// Escapes with the reason given by `outcome`, a result of budget_charge other than BUDGET_OK. Returns only if no
// arena_protect encloses the call.
void arena_check(Arena *arena, BudgetOutcome outcome);
// Charges work (budget.h). Escapes if the work limit is exceeded or the host requested an interrupt.
static inline void arena_charge(Arena *arena, uint64_t units) {
    BudgetOutcome outcome = budget_charge(arena->budget, units);
    if (outcome != BUDGET_OK)
        arena_check(arena, outcome);
}

// Charges the work of a long loop, `units_each` for each element. The loop calls this function for each index i,
// starting at 0. Work is charged after every BUDGET_CHUNK elements, so an incomplete last chunk is not charged.
static inline void arena_charge_chunk(Arena *arena, size_t i, unsigned units_each) {
    if (i % BUDGET_CHUNK == BUDGET_CHUNK - 1)
        arena_charge(arena, (uint64_t)BUDGET_CHUNK * units_each);
}

// Allocates `count` elements of `size` bytes each and charges the work of filling them. Escapes with
// ARENA_MEMORY_LIMIT if count * size overflows.
void *arena_alloc_array(Arena *arena, size_t count, size_t size);

// Copies `size` bytes to the arena. Returns the copy.
void *arena_copy(Arena *arena, const void *bytes, size_t size);

// Enlarges the allocation `bytes` from old_size to new_size bytes. If it is the most recent allocation and its block
// has space, it is enlarged in place. Otherwise returns a larger copy.
void *arena_grow(Arena *arena, void *bytes, size_t old_size, size_t new_size);

// Ensures that the array `items` of `count` elements, each of `size` bytes, has capacity for one more element. If it is
// full, doubles *capacity. Returns `items` or a larger copy of it.
void *arena_grow_array(Arena *arena, void *items, uint32_t count, uint32_t *capacity, size_t size);

// Escapes with ARENA_OUT_OF_MEMORY. Called if a heap allocation fails while the arena is in use.
_Noreturn void arena_exhausted(const Arena *arena);
// Escapes with the given outcome, for example the result of an inner arena_protect. Aborts the process if no
// arena_protect encloses the call.
_Noreturn void arena_escape(const Arena *arena, ArenaOutcome end);

ArenaMark arena_mark(const Arena *arena);
// Drops all allocations made since the mark. Pointers to them become invalid.
void arena_rewind(Arena *arena, ArenaMark mark);
