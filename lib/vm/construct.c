// construct.c: instructions that create vectors and nodes, or look up values; see machine.h.
#include "base/heap.h"
#include "value/value_hash.h"
#include "vm/machine.h"

#include <string.h>

enum { MAX_ON_STACK = 8 };

static uint32_t add_numbers(double *numbers, uint32_t at, const Value *part) {
    if (part->len == 1) {
        numbers[at] = part->as.number;
        return at + 1;
    }
    if (part->len)
        memcpy(numbers + at, part->as.numbers, part->len * sizeof *numbers);
    return at + part->len;
}

// If all parts are numbers, composes them in one allocation. Otherwise adds the parts to a Vector.
Value vm_compose(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, const Origin *at) {
    vm->at = at;
    uint64_t len = 0;
    bool numeric = true;
    for (uint32_t i = 0; i < instr->count; i++) {
        const Value *part = &slots[list[i]];
        numeric = numeric && part->kind == VALUE_NUMBERS;
        len += part->len;
    }
    if (numeric && len > 1 && len <= VALUE_MAX_LEN) {
        double *numbers = arena_alloc_array(vm->arena, (size_t)len, sizeof *numbers);
        uint32_t filled = 0;
        for (uint32_t i = 0; i < instr->count; i++)
            filled = add_numbers(numbers, filled, &slots[list[i]]);
        return (Value){.len = filled, .as.numbers = numbers};
    }
    Vector vector = vector_new(vm->arena);
    for (uint32_t i = 0; i < instr->count; i++)
        vector_add(&vector, slots[list[i]]);
    return vm_finish(vm, at, &vector);
}

// --- nodes

Value vm_append(Vm *vm, const Instr *instr, Value parent, Value children) {
    vm->at = instr->at;
    NodeList list = instr->as.constant_children ? *instr->as.constant_children : node_list(vm->arena, children);
    bool too_high = false;
    Value result = value_append(vm->arena, parent, &list, &too_high);
    if (too_high)
        vm_fault(vm, instr->at, "too-deep", "node tree too deep: the limit is 12000 levels; the node is not appended");
    return result;
}

static void attributes_too_deep(Vm *vm, const Origin *at) {
    vm_fault(vm, at, "too-deep",
             "nodes in attributes nested too deeply: the limit is 12000 levels; the attribute is not set");
}

Value vm_decorate(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr) {
    const DecorateCode *decorate = instr->as.decorate;
    vm->at = instr->at;
    Value subject = slots[instr->b];
    Attr *attrs = arena_alloc_array(vm->arena, instr->count, sizeof *attrs);
    for (uint32_t i = 0; i < instr->count; i++)
        attrs[i] = (Attr){decorate->names[i], slots[list[i]]};
    for (uint32_t i = 0; i < decorate->tag_count; i++)
        subject = value_add_tag(vm->arena, subject, decorate->tags[i]);
    bool too_high = false;
    if (instr->count)
        subject = value_set_attrs(vm->arena, subject, attrs, instr->count, &too_high);
    if (too_high)
        attributes_too_deep(vm, instr->at);
    return subject;
}

// Sets the attributes of a new node. All names differ, so no attribute replaces another. Attributes that are null or
// streams are omitted (L7.2).
static void set_attributes(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, Node *node,
                           Attr *attrs) {
    uint32_t count = 0, height = node->height;
    bool has_runs = false;
    for (uint32_t i = 0; i < instr->count; i++) {
        const Value *value = &slots[list[i]];
        if (value->len == 0)
            continue;
        if (value->kind == VALUE_MIXED && value_height(*value) >= height)
            height = value_height(*value) + 1;
        has_runs |= value->kind == VALUE_MIXED && value_has_batches(*value);
        attrs[count++] = (Attr){instr->as.node->names[i], *value};
    }
    if (height > NODE_MAX_HEIGHT) {
        attributes_too_deep(vm, instr->as.node->decorated);
        return;
    }
    node->attrs = attrs;
    node->attr_count = count;
    node->height = (uint16_t)height;
    node->has_batches = has_runs;
}

static void set_children(Vm *vm, const Instr *instr, Node *node, const NodeList *list) {
    if (list->height >= NODE_MAX_HEIGHT) {
        vm_fault(vm, instr->at, "too-deep", "node tree too deep: the limit is 12000 levels; the node is not appended");
        return;
    }
    if (list->count == 0)
        return;
    node->children = list->nodes;
    node->child_count = list->count;
    node->program_lifetime_children = list->program_lifetime;
    node->has_batches |= list->has_batches;
    if (list->height >= node->height)
        node->height = (uint16_t)(list->height + 1);
}

// Creates a node, its attributes, its list of children and the vector that contains it, all in one allocation.
Value vm_make_node(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr) {
    const NodeCode *plan = instr->as.node;
    const Value *children = instr->b == CODE_NO_OPERAND ? NULL : &slots[instr->b];
    uint32_t room = children && children->kind == VALUE_MIXED ? children->len : 0;
    vm_charge(vm, instr->at, 1 + (instr->count + room) / 4);
    NodeValue *made = arena_alloc(vm->arena, sizeof *made + instr->count * sizeof(Attr) + room * sizeof(const Node *));
    Attr *attrs = (Attr *)(made + 1);
    const Node **nodes = (const Node **)(attrs + instr->count);
    made->node = *plan->base;
    made->node.program_lifetime = made->node.program_lifetime_children = false;
    made->item = (Item){ITEM_NODE, .as.node = &made->node};
    if (instr->count)
        set_attributes(vm, list, slots, instr, &made->node, attrs);
    if (plan->constant_children) {
        set_children(vm, instr, &made->node, plan->constant_children);
    } else if (room) {
        NodeList given = node_list_in(nodes, *children);
        set_children(vm, instr, &made->node, &given);
    }
    return (Value){.len = 1, .kind = VALUE_MIXED, .as.items = &made->item};
}

// --- elements

enum { STREAM_WORK = 4 }; // work units per item of a stream

static Value index_stream(Vm *vm, Value stream, Value index) {
    if (!value_is_numeric(index))
        return VALUE_NULL;
    const double *at = value_numbers(&index);
    if (index.len == 1)
        return value_number(value_stream_item(stream, value_stream_position(at[0])));
    double *items = arena_alloc_array(vm->arena, index.len, sizeof *items);
    for (uint32_t i = 0; i < index.len; i += BUDGET_CHUNK) {
        uint32_t count = index.len - i < BUDGET_CHUNK ? index.len - i : BUDGET_CHUNK;
        arena_charge(vm->arena, count == BUDGET_CHUNK ? BUDGET_CHUNK * STREAM_WORK : 0);
        value_stream_items(stream, at + i, count, items + i);
    }
    return value_numbers_view(items, index.len);
}

Value vm_index(Vm *vm, Value vector, Value index) {
    return vector.kind == VALUE_STREAM ? index_stream(vm, vector, index) : value_index(vm->arena, vector, index);
}

static void range_too_long(Vm *vm, const Origin *at) {
    vm_fault(vm, at, "too-long", "range too long: the limit is 134217728 elements");
}

Value vm_range(Vm *vm, const Origin *at, Value start, Value stop, Value step) {
    bool too_long = false;
    Value range = op_range(vm->arena, start, stop, step, &too_long);
    if (too_long)
        range_too_long(vm, at);
    return range;
}

void vm_range_init(Vm *vm, const Origin *at, Loop *loop, Value start, Value stop, Value step) {
    bool too_long = false;
    vm->at = at;
    *loop = (Loop){.span = op_range_bounds(start, stop, step, &too_long), .result = vector_new(vm->arena)};
    loop->source = (Value){.len = loop->span.len, .kind = VALUE_ABSENT};
    if (too_long)
        range_too_long(vm, at);
}

// If the bounds are integers within the vector, copies the elements without building a range.
Value vm_slice(Vm *vm, const Origin *at, Value vector, Value start, Value stop) {
    if (is_number(&stop) && (is_number(&start) || start.len == 0) && vector.kind == VALUE_NUMBERS) {
        double from = start.len ? start.as.number : 0, to = stop.as.number;
        if (from >= 0 && to <= vector.len && to - from >= 2 && (double)(uint32_t)from == from &&
            (double)(uint32_t)to == to) {
            uint32_t len = (uint32_t)to - (uint32_t)from;
            vm->at = at;
            double *numbers = arena_alloc_array(vm->arena, (size_t)len, sizeof *numbers);
            memcpy(numbers, vector.as.numbers + (uint32_t)from, len * sizeof *numbers);
            return (Value){.len = len, .as.numbers = numbers};
        }
    }
    vm->at = at;
    return vm_index(vm, vector, vm_range(vm, at, start, stop, VALUE_NULL));
}

// --- the state

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

Value vm_lookup_numbers(Vm *vm, uint32_t lookup, const double *numbers, uint32_t len) {
    StateSlot *guess = next_guess(vm, lookup), slot = guess ? *guess : STATE_NO_SLOT;
    if (slot == STATE_NO_SLOT || !state_slot_has_key(vm->state, slot, value_numbers_view(numbers, len))) {
        slot = state_find(vm->state, value_numbers_view(numbers, len));
        if (guess)
            *guess = slot;
    }
    return slot == STATE_NO_SLOT ? VALUE_NULL : state_slot_get(vm->state, slot);
}

static Value copy_of(Vm *vm, Value v) {
    if (v.len >= BUDGET_NUMBERS)
        arena_charge(vm->arena, v.len / BUDGET_NUMBERS);
    return value_copy(vm->arena, v);
}

// Most keys are a few numbers, for which no key vector needs to be built. The value found is copied, because physics
// and other systems may overwrite it in the state after the evaluation.
Value vm_lookup(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr) {
    vm->met_dynamic = true;
    vm->at = instr->at;
    double buffer[MAX_ON_STACK];
    uint32_t count = 0;
    while (count < instr->count && count < MAX_ON_STACK && is_number(&slots[list[count]])) {
        buffer[count] = slots[list[count]].as.number;
        count++;
    }
    if (count == instr->count && vm->state)
        return copy_of(vm, vm_lookup_numbers(vm, instr->target, buffer, count));
    Value key = instr->count == 1 ? slots[list[0]] : vm_compose(vm, list, slots, instr, instr->as.inner_origin);
    if (!vm->state)
        return VALUE_NULL;
    if (key.kind == VALUE_NUMBERS && key.len > 0)
        return copy_of(vm, vm_lookup_numbers(vm, instr->target, value_numbers(&key), key.len));
    return copy_of(vm, state_get(vm->state, key));
}
