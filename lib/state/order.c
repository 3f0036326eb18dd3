// order.c: sorting of slots, the canonical order of all slots (spec digest.md 2) as a list of runs, and iteration.
//
// A key range is one run, because its keys count up. Other slots are sorted and joined to runs. Lists are merged run by
// run. So ordering consecutive particle ids takes little time and memory, however many there are.
#include "base/heap.h"
#include "state/internal.h"
#include "value/format.h"

#include <string.h>

static bool comes_after(const State *state, const SymbolTable *symbols, StateSlot one, StateSlot other) {
    double buffers[2][STATE_KEY_BUFFER];
    return format_key_compare(symbols, state_slot_key_in(state, one, buffers[0]),
                              state_slot_key_in(state, other, buffers[1])) > 0;
}

// Sorts with a merge sort, which is stable and, unlike qsort, can pass the state to the comparison. Particles with
// ascending ids are already in order, so merging is often skipped.
void state_sort_slots(const State *state, const SymbolTable *symbols, StateSlot *slots, StateSlot *scratch,
                      uint32_t count) {
    if (count < 2)
        return;
    uint32_t half = count / 2;
    state_sort_slots(state, symbols, slots, scratch, half);
    state_sort_slots(state, symbols, slots + half, scratch, count - half);
    if (!comes_after(state, symbols, slots[half - 1], slots[half]))
        return;
    memcpy(scratch, slots, half * sizeof *slots);
    for (uint32_t left = 0, right = half, to = 0; left < half; to++)
        if (right < count && comes_after(state, symbols, scratch[left], slots[right]))
            slots[to] = slots[right++];
        else
            slots[to] = scratch[left++];
}

bool state_grow(State *state, void **array, uint32_t *capacity, uint32_t count, size_t size) {
    enum { MIN_CAPACITY = 16 };
    if (count < *capacity)
        return true;
    uint32_t larger = *capacity ? 2 * *capacity : MIN_CAPACITY;
    size_t added = (size_t)(larger - *capacity) * size;
    void *moved = budget_reserve(state->budget, added) ? heap_resize(*array, larger * size) : NULL;
    if (!moved) {
        state->exhausted = true;
        return false;
    }
    *array = moved;
    *capacity = larger;
    return true;
}

static void free_runs(State *state, SlotRuns *runs) {
    budget_release(state->budget, runs->capacity * sizeof *runs->items);
    heap_free(runs->items);
    *runs = (SlotRuns){0};
}

// Adds a run to a list. Extends the last run if the new one continues it.
static bool add_run(State *state, SlotRuns *runs, SlotRun run) {
    SlotRun *last = runs->count ? &runs->items[runs->count - 1] : NULL;
    if (last && last->first + last->count == run.first) {
        last->count += run.count;
        return true;
    }
    if (!state_grow(state, (void **)&runs->items, &runs->capacity, runs->count, sizeof run))
        return false;
    runs->items[runs->count++] = run;
    return true;
}

// Returns how many slots of a run come before a slot.
static uint32_t count_before(const State *state, SlotRun run, StateSlot slot) {
    if (!comes_after(state, NULL, run.first + run.count - 1, slot))
        return run.count;
    uint32_t low = 0, high = run.count - 1; // the first `low` slots come before, slot `high` comes after
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (comes_after(state, NULL, run.first + middle, slot))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

// Moves the slots before `limit` from the start of a run to the end of a list. Returns false if out of memory.
static bool move_before(State *state, SlotRun **from, StateSlot limit, SlotRuns *to) {
    SlotRun *run = *from;
    uint32_t count = count_before(state, *run, limit);
    if (count && !add_run(state, to, (SlotRun){run->first, count}))
        return false;
    run->first += count;
    run->count -= count;
    *from += run->count == 0;
    return true;
}

// Merges `other` into `runs`. Frees the items of `other`. Returns false if out of memory.
static bool merge_runs(State *state, SlotRuns *runs, SlotRuns *other) {
    if (other->count == 0)
        return true;
    if (runs->count == 0) {
        free_runs(state, runs);
        *runs = *other;
        return true;
    }
    SlotRuns merged = {0};
    SlotRun *a = runs->items, *b = other->items, *a_end = a + runs->count, *b_end = b + other->count;
    bool done = true;
    while (done && a < a_end && b < b_end) {
        done = move_before(state, &a, b->first, &merged);
        if (done && a < a_end)
            done = move_before(state, &b, a->first, &merged);
    }
    for (; done && a < a_end; a++)
        done = add_run(state, &merged, *a);
    for (; done && b < b_end; b++)
        done = add_run(state, &merged, *b);
    free_runs(state, runs);
    free_runs(state, other);
    *runs = merged;
    return done;
}

// Appends a run whose keys all come after those of the list, or merges it with the list.
static bool merge_run(State *state, SlotRuns *runs, SlotRun run) {
    SlotRuns other = {0};
    const SlotRun *last = runs->count ? &runs->items[runs->count - 1] : NULL;
    if (!last || comes_after(state, NULL, run.first, last->first + last->count - 1))
        return add_run(state, runs, run);
    return add_run(state, &other, run) && merge_runs(state, runs, &other);
}

// Merges the new slots that are not in a range.
static bool order_entries(State *state, StateSlot *slots, uint32_t count) {
    SlotRuns runs = {0};
    bool done = true;
    state_sort_slots(state, NULL, slots, slots + count, count);
    for (uint32_t i = 0; done && i < count; i++)
        done = add_run(state, &runs, (SlotRun){slots[i], 1});
    if (done)
        return merge_runs(state, &state->digest.order, &runs);
    free_runs(state, &runs);
    return false;
}

bool state_update_order(State *state) {
    Digest *digest = &state->digest;
    uint32_t count = 0, new_count = state->count - digest->ordered;
    size_t bytes = 2 * (new_count < state->entry_count ? new_count : state->entry_count) * sizeof(StateSlot);
    if (new_count == 0)
        return true;
    StateSlot *slots = budget_reserve(state->budget, bytes) ? heap_alloc(bytes + 1) : NULL;
    bool done = slots;
    for (StateSlot slot = digest->ordered; done && slot < state->count;) {
        const KeyRange *range = state_key_range(state, slot);
        if (range) {
            uint32_t rest = range->first + range->count - slot;
            done = merge_run(state, &digest->order, (SlotRun){slot, rest});
            slot += rest;
        } else {
            slots[count++] = slot++;
        }
    }
    done = done && order_entries(state, slots, count);
    if (slots)
        budget_release(state->budget, bytes);
    heap_free(slots);
    digest->ordered = state->count;
    digest->last_run = digest->last_position = 0;
    digest->current = false;
    if (!done) {
        state->exhausted = true;
        state_forget_order(state);
    }
    return done;
}

void state_forget_order(State *state) {
    state->digest.order.count = state->digest.ordered = 0;
    state->digest.last_run = state->digest.last_position = 0;
    state->digest.current = false;
}

// Returns the slot at a position of the canonical order. Starts at the run of the last call, because callers iterate.
static StateSlot slot_at(Digest *digest, uint32_t position) {
    const SlotRun *run = &digest->order.items[digest->last_run];
    while (position < digest->last_position)
        digest->last_position -= (--run)->count;
    while (position - digest->last_position >= run->count)
        digest->last_position += (run++)->count;
    digest->last_run = (uint32_t)(run - digest->order.items);
    return run->first + (position - digest->last_position);
}

StateSlot state_next_slot(State *state, uint32_t *cursor) {
    if (!state_update_order(state))
        return STATE_NO_SLOT;
    while (*cursor < state->count) {
        StateSlot slot = slot_at(&state->digest, (*cursor)++);
        if (state_slot_get(state, slot).len > 0)
            return slot;
    }
    return STATE_NO_SLOT;
}

bool state_next(State *state, uint32_t *cursor, Value *key, Value *value, double buffer[STATE_KEY_BUFFER]) {
    StateSlot slot = state_next_slot(state, cursor);
    if (slot == STATE_NO_SLOT)
        return false;
    *key = state_slot_key_in(state, slot, buffer);
    *value = state_slot_get(state, slot);
    return true;
}
