// lookup.c: look-ups in the state, `$(...)`, and their inline caches. Each execution of an instruction in a frame has
// its own cache entry, the slot in which the key was in the frame before, so a script that runs the same way again
// finds its values without hashing.
#include "base/heap.h"
#include "vm/machine.h"

#include <string.h>

enum { MAX_INDICES_ON_STACK = 8 };

void vm_inline_cache_reset(Vm *vm, uint32_t count) {
    if (count > vm->inline_cache_count) {
        InlineCache *caches = heap_resize(vm->inline_caches, count * sizeof *caches);
        if (caches) {
            memset(caches + vm->inline_cache_count, 0, (count - vm->inline_cache_count) * sizeof *caches);
            vm->inline_caches = caches;
            vm->inline_cache_count = count;
        }
    }
    for (uint32_t i = 0; i < vm->inline_cache_count; i++)
        vm->inline_caches[i].next = 0;
}

void vm_inline_cache_free(Vm *vm) {
    for (uint32_t i = 0; i < vm->inline_cache_count; i++)
        heap_free(vm->inline_caches[i].slots);
    heap_free(vm->inline_caches);
    vm->inline_caches = NULL;
    vm->inline_cache_count = 0;
}

// Maximum number of entries in an inline cache. If a lookup is executed more often in a frame, the rest is not cached.
enum { MAX_CACHED = 1 << 22 };

// Returns the cache entry for the next execution of a lookup, or NULL if this execution is not cached.
static StateSlot *next_guess(Vm *vm, uint32_t lookup) {
    if (lookup >= vm->inline_cache_count)
        return NULL;
    InlineCache *cache = &vm->inline_caches[lookup];
    if (cache->next == cache->count) {
        if (cache->count == MAX_CACHED ||
            !heap_reserve((void **)&cache->slots, &cache->capacity, cache->count, sizeof *cache->slots))
            return NULL;
        cache->slots[cache->count++] = STATE_NO_SLOT;
    }
    return &cache->slots[cache->next++];
}

// Returns a copy of a value of the state, because physics and other systems may overwrite it after the evaluation.
static Value copy_of(Vm *vm, Value v) {
    if (v.len >= BUDGET_NUMBERS)
        arena_charge(vm->arena, v.len / BUDGET_NUMBERS);
    return value_copy(vm->arena, v);
}

// Returns the place of the current lookup in the log, or NULL if there are too many places.
static MissedLookup *log_place(Vm *vm, LookupLog *log, const Origin *at) {
    if (log->last < log->count && log->places[log->last].at == at)
        return &log->places[log->last];
    for (log->last = 0; log->last < log->count; log->last++)
        if (log->places[log->last].at == at)
            return &log->places[log->last];
    if (log->count == LOOKUP_LOG_PLACES)
        return NULL;
    log->places = arena_grow_array(vm->arena, log->places, log->count, &log->capacity, sizeof *log->places);
    log->places[log->count] = (MissedLookup){.at = at};
    return &log->places[log->count++];
}

// Records a lookup that found nothing. Returns null.
static Value miss(Vm *vm, Value key) {
    MissedLookup *place = vm->missed ? log_place(vm, vm->missed, vm->at) : NULL;
    if (place && place->count < LOOKUP_LOG_KEYS)
        place->keys[place->count] = value_copy(vm->arena, key);
    if (place)
        place->count++;
    return VALUE_NULL;
}

Value vm_lookup_numbers(Vm *vm, uint32_t lookup, const double *numbers, uint32_t len) {
    StateSlot *guess = next_guess(vm, lookup), slot = guess ? *guess : STATE_NO_SLOT;
    if (slot == STATE_NO_SLOT || !state_slot_has_key(vm->state, slot, value_numbers_view(numbers, len))) {
        slot = state_find(vm->state, value_numbers_view(numbers, len));
        if (guess)
            *guess = slot;
    }
    Value found = slot == STATE_NO_SLOT ? VALUE_NULL : copy_of(vm, state_slot_get(vm->state, slot));
    return found.len > 0 ? found : miss(vm, value_numbers_view(numbers, len));
}

// Most keys are a few numbers, for which no key vector needs to be built.
Value vm_lookup(Vm *vm, const Frame *frame, const Instr *instr) {
    const Value *slots = frame->slots;
    const int32_t *list = frame->operands + instr->list;
    vm->met_dynamic = true;
    vm->at = instr->at;
    double buffer[MAX_INDICES_ON_STACK];
    uint32_t count = 0;
    while (count < instr->count && count < MAX_INDICES_ON_STACK && is_number(&slots[list[count]])) {
        buffer[count] = slots[list[count]].as.number;
        count++;
    }
    if (count == instr->count && vm->state)
        return vm_lookup_numbers(vm, instr->target, buffer, count);
    Value key = instr->count == 1 ? slots[list[0]] : vm_compose_at(vm, frame, instr, instr->as.inner_origin);
    vm->at = instr->at;
    if (!vm->state)
        return VALUE_NULL;
    if (key.kind == VALUE_NUMBERS && key.len > 0)
        return vm_lookup_numbers(vm, instr->target, value_numbers(&key), key.len);
    Value found = copy_of(vm, state_get(vm->state, key));
    return found.len > 0 ? found : miss(vm, key);
}
