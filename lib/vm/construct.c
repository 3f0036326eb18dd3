// construct.c: instructions that create vectors and nodes, or take their elements; see machine.h.
//
// vm_node allocates a node together with its attributes and children. An attribute or child that would make a tree
// higher than NODE_MAX_HEIGHT is reported and left out, because functions that walk trees are recursive.
#include "value/stream.h"
#include "vm/machine.h"

#include <string.h>

static uint32_t add_vector_numbers(double *numbers, uint32_t at, const Value *part) {
    if (part->len == 1) {
        numbers[at] = part->as.number;
        return at + 1;
    }
    if (part->len)
        memcpy(numbers + at, part->as.numbers, part->len * sizeof *numbers);
    return at + part->len;
}

// If all parts are numbers, composes them in one allocation. Otherwise adds the parts to a Vector.
Value vm_compose_at(Vm *vm, const Frame *frame, const Instr *instr, const Origin *at) {
    const Value *slots = frame->slots;
    const int32_t *list = frame->operands + instr->list;
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
            filled = add_vector_numbers(numbers, filled, &slots[list[i]]);
        return (Value){.len = filled, .as.numbers = numbers};
    }
    Vector vector = vector_new(vm->arena);
    for (uint32_t i = 0; i < instr->count; i++)
        vector_add(&vector, slots[list[i]]);
    return vm_finish(vm, at, &vector);
}

Value vm_compose(Vm *vm, const Frame *frame, const Instr *instr) {
    return vm_compose_at(vm, frame, instr, instr->at);
}

// --- nodes

Value vm_append(Vm *vm, const Frame *frame, const Instr *instr) {
    vm->at = instr->at;
    NodeList list =
        instr->as.constant_children ? *instr->as.constant_children : node_list(vm->arena, frame->slots[instr->b]);
    bool too_high = false;
    Value result = value_append(vm->arena, frame->slots[instr->a], &list, &too_high);
    if (too_high)
        vm_report(vm, instr->at, "too-deep", "node tree too deep: the limit is 12000 levels; the node is not appended");
    return result;
}

static void attributes_too_deep(Vm *vm, const Origin *at) {
    vm_report(vm, at, "too-deep",
              "nodes in attributes nested too deeply: the limit is 12000 levels; the attribute is not set");
}

Value vm_decorate(Vm *vm, const Frame *frame, const Instr *instr) {
    const DecorateCode *decorate = instr->as.decorate;
    const int32_t *list = frame->operands + instr->list;
    vm->at = instr->at;
    Value subject = frame->slots[instr->b];
    Attr *attrs = arena_alloc_array(vm->arena, instr->count, sizeof *attrs);
    for (uint32_t i = 0; i < instr->count; i++)
        attrs[i] = (Attr){decorate->names[i], frame->slots[list[i]]};
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
static void set_attributes(Vm *vm, const Frame *frame, const Instr *instr, Node *node, Attr *attrs) {
    const Value *slots = frame->slots;
    const int32_t *list = frame->operands + instr->list;
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
        vm_report(vm, instr->at, "too-deep", "node tree too deep: the limit is 12000 levels; the node is not appended");
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
Value vm_node(Vm *vm, const Frame *frame, const Instr *instr) {
    const NodeCode *plan = instr->as.node;
    const Value *children = instr->b == CODE_NO_OPERAND ? NULL : &frame->slots[instr->b];
    uint32_t room = children && children->kind == VALUE_MIXED ? children->len : 0;
    vm_charge(vm, instr->at, 1 + (instr->count + room) / 4);
    NodeValue *value =
        arena_alloc(vm->arena, sizeof *value + instr->count * sizeof(Attr) + room * sizeof(const Node *));
    Attr *attrs = (Attr *)(value + 1);
    const Node **nodes = (const Node **)(attrs + instr->count);
    value->node = *plan->base;
    value->node.program_lifetime = value->node.program_lifetime_children = false;
    value->item = (Item){ITEM_NODE, .as.node = &value->node};
    if (instr->count)
        set_attributes(vm, frame, instr, &value->node, attrs);
    if (plan->constant_children) {
        set_children(vm, instr, &value->node, plan->constant_children);
    } else if (room) {
        NodeList given = node_list_in(nodes, *children);
        set_children(vm, instr, &value->node, &given);
    }
    return (Value){.len = 1, .kind = VALUE_MIXED, .as.items = &value->item};
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

Value vm_index_value(Vm *vm, Value vector, Value index) {
    return vector.kind == VALUE_STREAM ? index_stream(vm, vector, index) : value_index(vm->arena, vector, index);
}

static void range_too_long(Vm *vm, const Origin *at) {
    vm_report(vm, at, "too-long", "range too long: the limit is 134217728 elements");
}

static Value make_range(Vm *vm, const Origin *at, Value start, Value stop, Value step) {
    vm->at = at;
    bool too_long = false;
    Value range = op_range(vm->arena, start, stop, step, &too_long);
    if (too_long)
        range_too_long(vm, at);
    return range;
}

Value vm_range(Vm *vm, const Frame *frame, const Instr *instr) {
    const Value *slots = frame->slots;
    return make_range(vm, instr->at, slots[instr->a], slots[instr->b], slots[instr->c]);
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
bool vm_slice_numbers(Vm *vm, const Value *vector, double from, double to, Value *slice) {
    if (vector->kind != VALUE_NUMBERS || !(from >= 0 && to <= vector->len && to - from >= 2) ||
        (double)(uint32_t)from != from || (double)(uint32_t)to != to)
        return false;
    uint32_t len = (uint32_t)to - (uint32_t)from;
    double *numbers = arena_alloc_array(vm->arena, (size_t)len, sizeof *numbers);
    memcpy(numbers, vector->as.numbers + (uint32_t)from, len * sizeof *numbers);
    *slice = (Value){.len = len, .as.numbers = numbers};
    return true;
}

Value vm_slice(Vm *vm, const Frame *frame, const Instr *instr) {
    const Value vector = frame->slots[instr->a], start = frame->slots[instr->b], stop = frame->slots[instr->c];
    vm->at = instr->as.inner_origin;
    Value slice;
    if (is_number(&stop) && (is_number(&start) || start.len == 0) &&
        vm_slice_numbers(vm, &vector, start.len ? start.as.number : 0, stop.as.number, &slice))
        return slice;
    return vm_index_value(vm, vector, make_range(vm, vm->at, start, stop, VALUE_NULL));
}
