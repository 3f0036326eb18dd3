// arena.h: bump allocation with one lifetime.
//
// A frame, a program and a session are regions: what they allocate is dropped as a whole. Nobody frees a single
// value. An allocation never returns NULL: when the budget or the machine's memory is used up, control leaves through
// the arena's escape, a jump to the arena_protect at the boundary of a frame, a load or another public call, where it
// becomes a status. An arena without an escape aborts: that is a bug of ours.
#ifndef PETRI_BASE_ARENA_H
#define PETRI_BASE_ARENA_H

#include "base/budget.h"

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Under the address sanitizer what is not handed out is poisoned.
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
    size_t capacity; // of bytes; a multiple of the alignment, as is `fill`
    size_t fill;
    size_t padding; // keeps `bytes` aligned
    unsigned char bytes[];
};

_Static_assert(offsetof(ArenaBlock, bytes) % ARENA_ALIGNMENT == 0, "block payload must be aligned");

typedef struct Arena {
    ArenaBlock *first;   // chain of blocks, oldest first; kept over a reset
    ArenaBlock *current; // the block that is being filled
    size_t used;         // bytes handed out since the last reset, block remainders included
    size_t high_water;   // most that `used` has ever been, up to the last rewind or reset
    size_t limit;        // bytes allowed between two resets
    jmp_buf *escape;     // where to go when memory is used up, or NULL to abort
    Budget *budget;      // that blocks and work are charged to, or NULL
    const char *name;    // for messages
} Arena;

typedef struct ArenaMark {
    ArenaBlock *block;
    size_t fill;
    size_t used;
} ArenaMark;

// How a protected call ended.
typedef enum ArenaOutcome {
    ARENA_OK,
    ARENA_OUT_OF_MEMORY, // the machine's memory is used up
    ARENA_MEMORY_LIMIT,  // or what the arena may hand out, or all that the meter allows
    ARENA_WORK_LIMIT,    // work is
    ARENA_INTERRUPTED,   // the host has asked for an end
} ArenaOutcome;

enum { ARENA_MAX_PROTECTED = 8 };
// Calls `call`; if one of the arenas (NULL: none) runs out meanwhile, what it was doing is given up and this returns.
// Within another protected call the inner one has precedence. What the call knows of heap blocks must be reachable from
// `context`, so that the caller can free them.
ArenaOutcome arena_protect(Arena *const arenas[], size_t count, void (*call)(void *context), void *context);
// Allocates like arena_alloc, but returns NULL when memory or budget is used up.
void *arena_try_alloc(Arena *arena, size_t size);

// Prepares an empty arena that may hand out `budget` bytes between resets. `name` must outlive it.
void arena_init(Arena *arena, const char *name, size_t limit);

// Returns all blocks to the system.
void arena_free(Arena *arena);

// The same, once the host does not look at the blocks any more: while its meter keeps them, they stay as they are, and
// charged.
void arena_retire(Arena *arena);
// Returns what was kept so.
void arena_free_retained(Budget *budget);

// What the arena holds is charged to nobody from here on.
void arena_detach_budget(Arena *arena);

// Drops everything allocated since the last reset but keeps the blocks. Unoptimised and sanitizer builds poison the
// bytes.
void arena_reset(Arena *arena);

// The same as arena_alloc, for when the block at hand has no room.
void *arena_alloc_slow(Arena *arena, size_t size);

// `size` bytes, aligned to 16, not cleared. Size 0 gives a valid pointer that must not be read.
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

// What arena_charge does when it is time to look, or memory is.
void arena_check(Arena *arena, BudgetOutcome answer);
// Charges work (budget.h); if that is used up, or the host has asked for an end, control leaves through the escape.
static inline void arena_charge(Arena *arena, uint64_t units) {
    BudgetOutcome answer = budget_charge(arena->budget, units);
    if (answer != BUDGET_OK)
        arena_check(arena, answer);
}

// Charges for a portion at the end of each, in a loop over many elements that is at number i.
static inline void arena_charge_chunk(Arena *arena, size_t i, unsigned units_each) {
    if (i % BUDGET_CHUNK == BUDGET_CHUNK - 1)
        arena_charge(arena, (uint64_t)BUDGET_CHUNK * units_each);
}

// The same for `count` elements of `size` bytes each, with the work of filling them; an overflowing product counts as
// used-up memory.
void *arena_alloc_array(Arena *arena, size_t count, size_t size);

// A copy of `size` bytes.
void *arena_copy(Arena *arena, const void *bytes, size_t size);

// Extends the most recent allocation in place if it is `bytes` and there is room, else returns a larger copy.
void *arena_grow(Arena *arena, void *bytes, size_t old_size, size_t new_size);

// An array of `count` elements of `size` bytes with room for one more: `items`, or a copy that is twice as large.
void *arena_grow_array(Arena *arena, void *items, uint32_t count, uint32_t *capacity, size_t size);

// What arena_alloc does when the machine has nothing left; for other allocations that belong to the arena's region.
_Noreturn void arena_exhausted(const Arena *arena);
// The same in the way in which an inner protected call has ended.
_Noreturn void arena_escape(const Arena *arena, ArenaOutcome end);

ArenaMark arena_mark(const Arena *arena);
// Drops what was allocated since the mark. Pointers into it dangle from here on.
void arena_rewind(Arena *arena, ArenaMark mark);

#endif
