// batch_ops.c: batched versions of calls of built-ins, compositions, lookups and nodes; see batch_columns.h.
#include "builtin/noise.h"
#include "vm/batch_columns.h"

#include <math.h>
#include <string.h>

enum { MAX_SLICE_LENGTH = 16 }; // maximum length of slices that run_slice copies

// --- built-ins

// Calls an element-wise built-in once for all selected iterations. An argument is a vector with one number per
// iteration, or a single number if it is the same in all iterations.
static bool run_each(LoopBatch *batch, const Instr *instr) {
    enum { MAX_OPERANDS = 4 };
    const Builtin *builtin = instr->as.builtin;
    const int32_t *list = batch->code->operands + instr->list;
    double buffers[MAX_OPERANDS][BATCH_SIZE];
    Value args[MAX_OPERANDS];
    if (builtin->each == 0 || instr->count < builtin->each || instr->count > MAX_OPERANDS)
        return false;
    for (uint32_t i = 0; i < instr->count; i++) {
        const double *x = vm_batch_numbers(batch, list[i], buffers[i]);
        if (!x)
            return false;
        args[i] = value_numbers_view(x, column_of(batch, list[i]) ? batch->selected_count : 1);
    }
    vm_charge(batch->vm, instr->at, batch->selected_count);
    batch->vm->builtins.called = builtin;
    Value result = builtin->call(&batch->vm->builtins, args, instr->count);
    if (result.kind != VALUE_NUMBERS || result.len != batch->selected_count)
        return false;
    vm_batch_store_numbers(batch, instr->d, value_numbers(&result));
    return true;
}

// Calls a built-in once per selected iteration, with the arguments of this iteration. Returns false if the arguments
// are the same in all iterations, because one call may then be sufficient.
static bool run_calls(LoopBatch *batch, const Instr *instr) {
    enum { MAX_OPERANDS = 8 };
    const int32_t *list = batch->code->operands + instr->list;
    const Column *columns[MAX_OPERANDS];
    Value args[MAX_OPERANDS], values[BATCH_SIZE];
    uint32_t different = 0;
    for (uint32_t i = 0; i < instr->count && i < MAX_OPERANDS; i++) {
        columns[i] = column_of(batch, list[i]);
        different += columns[i] != NULL;
        if (!columns[i])
            args[i] = batch->frame->slots[list[i]];
    }
    if (instr->count > MAX_OPERANDS || different == 0)
        return false;
    batch->vm->builtins.called = instr->as.builtin;
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        for (uint32_t i = 0; i < instr->count; i++)
            if (columns[i])
                args[i] = column_value(columns[i], batch->selection[k]);
        vm_can_call(batch->vm, instr->as.builtin, instr->at, args, instr->count);
        values[k] = instr->as.builtin->call(&batch->vm->builtins, args, instr->count);
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Computes noise at one point of the plane per iteration.
static bool run_noise(LoopBatch *batch, const Instr *instr) {
    const int32_t *list = batch->code->operands + instr->list;
    double left[BATCH_SIZE], right[BATCH_SIZE], to[BATCH_SIZE];
    if (instr->as.builtin->each != BUILTIN_EACH_POINT || instr->count != 3 || column_of(batch, list[0]))
        return false;
    const double *x = vm_batch_numbers(batch, list[1], left), *y = x ? vm_batch_numbers(batch, list[2], right) : NULL;
    if (!y)
        return false;
    vm_charge(batch->vm, instr->at, batch->selected_count);
    builtin_noise_points(&batch->vm->builtins, batch->frame->slots[list[0]], x, y, batch->selected_count, to);
    vm_batch_store_numbers(batch, instr->d, to);
    return true;
}

// Composes one vector of numbers per selected iteration. All vectors have the same length and are rows of one array.
static bool run_compose(LoopBatch *batch, const Instr *instr) {
    enum { MAX_OPERANDS = 8 };
    const int32_t *list = batch->code->operands + instr->list;
    double buffers[MAX_OPERANDS][BATCH_SIZE];
    const double *parts[MAX_OPERANDS];
    uint32_t width = instr->count, count = batch->selected_count;
    Value values[BATCH_SIZE];
    for (uint32_t i = 0; i < width; i++)
        if (width > MAX_OPERANDS || width < 2 || !(parts[i] = vm_batch_numbers(batch, list[i], buffers[i])))
            return false;
    batch->vm->at = instr->at;
    double *rows = arena_alloc(batch->vm->arena, (size_t)count * width * sizeof *rows);
    for (uint32_t k = 0; k < count; k++) {
        for (uint32_t i = 0; i < width; i++)
            rows[k * width + i] = parts[i][k];
        values[k] = (Value){.len = width, .as.numbers = rows + k * width};
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Slices a vector of numbers that is the same in all iterations. The slices must have the same length. They are copied
// to one array.
static bool run_slice(LoopBatch *batch, const Instr *instr) {
    double left[BATCH_SIZE], right[BATCH_SIZE];
    const double *from = vm_batch_numbers(batch, instr->b, left);
    const double *to = from ? vm_batch_numbers(batch, instr->c, right) : NULL;
    const Value vector = batch->frame->slots[instr->a];
    uint32_t count = batch->selected_count, limit = vector.len;
    if (!to || column_of(batch, instr->a) || vector.kind != VALUE_NUMBERS)
        return false;
    double len = to[0] - from[0];
    bool fits = len >= 2 && len <= MAX_SLICE_LENGTH;
    for (uint32_t k = 0; fits && k < count; k++)
        fits = from[k] >= 0 && to[k] <= limit && to[k] - from[k] == len && floor(from[k]) == from[k];
    if (!fits || floor(len) != len)
        return false;
    uint32_t width = (uint32_t)len;
    batch->vm->at = instr->as.inner_origin;
    double *rows = arena_alloc(batch->vm->arena, (size_t)count * width * sizeof *rows);
    Value values[BATCH_SIZE];
    for (uint32_t k = 0; k < count; k++, rows += width) {
        const double *numbers = vector.as.numbers + (uint32_t)from[k];
        for (uint32_t i = 0; i < width; i++)
            rows[i] = numbers[i];
        values[k] = (Value){.len = width, .as.numbers = rows};
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Looks up one key per selected iteration. The keys must consist of numbers. Like vm_lookup, copies the values that it
// finds. All numeric vectors are copied to one array.
static bool run_lookups(LoopBatch *batch, const Instr *instr) {
    enum { MAX_OPERANDS = 4 };
    Vm *vm = batch->vm;
    const int32_t *list = batch->code->operands + instr->list;
    double buffers[MAX_OPERANDS][BATCH_SIZE], key[MAX_OPERANDS];
    const double *parts[MAX_OPERANDS];
    Value values[BATCH_SIZE];
    size_t numbers = 0;
    for (uint32_t i = 0; i < instr->count; i++)
        if (instr->count > MAX_OPERANDS || !vm->state || !(parts[i] = vm_batch_numbers(batch, list[i], buffers[i])))
            return false;
    vm->at = instr->at;
    vm->met_dynamic = true;
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        for (uint32_t i = 0; i < instr->count; i++)
            key[i] = parts[i][k];
        values[k] = vm_lookup_numbers(vm, instr->target, key, instr->count);
        numbers += values[k].kind == VALUE_NUMBERS && values[k].len > 1 ? values[k].len : 0;
    }
    arena_charge(vm->arena, numbers / BUDGET_NUMBERS);
    double *copy = arena_alloc(vm->arena, numbers * sizeof *copy);
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        Value *value = &values[k];
        if (value->kind != VALUE_NUMBERS)
            *value = value_copy(vm->arena, *value);
        if (value->kind != VALUE_NUMBERS || value->len < 2)
            continue;
        for (uint32_t i = 0; i < value->len; i++)
            copy[i] = value->as.numbers[i];
        value->as.numbers = copy;
        copy += value->len;
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// --- nodes

// Collects the attributes of the nodes that `instr` creates. attrs[i].value is the value of attribute i if it is the
// same in all iterations. Otherwise columns[i] holds its values. Returns false if some iterations lack an attribute, or
// if an attribute may contain nodes.
static bool plan_attributes(const LoopBatch *batch, const Instr *instr, Attr *attrs, const Column **columns,
                            uint32_t *count) {
    const int32_t *list = batch->code->operands + instr->list;
    *count = 0;
    for (uint32_t i = 0; i < instr->count; i++) {
        const Column *column = column_of(batch, list[i]);
        const Value *same = column ? NULL : &batch->frame->slots[list[i]];
        for (uint32_t k = 0; column && column->kind == COLUMN_VALUES && k < batch->selected_count; k++) {
            const Value *value = &column->as.values[batch->selection[k]];
            if (value->len == 0 || value->kind == VALUE_MIXED)
                return false;
        }
        if (same && same->kind == VALUE_MIXED)
            return false;
        if (same && same->len == 0)
            continue; // null and streams are omitted (L7.2)
        attrs[*count] = (Attr){instr->as.node->names[i], same ? *same : VALUE_NULL};
        columns[(*count)++] = column;
    }
    return true;
}

// Creates nodes without children in one allocation.
static bool run_nodes(LoopBatch *batch, const Instr *instr) {
    Attr attrs[CODE_MAX_READ];
    const Column *columns[CODE_MAX_READ];
    uint32_t count, active = batch->selected_count;
    if (instr->b != CODE_NO_OPERAND || instr->as.node->constant_children ||
        !plan_attributes(batch, instr, attrs, columns, &count))
        return false;
    vm_charge(batch->vm, instr->at, (uint64_t)active * (1 + instr->count / 4));
    NodeValue *made = arena_alloc(batch->vm->arena, active * sizeof *made);
    Attr *own = arena_alloc(batch->vm->arena, (size_t)active * count * sizeof *own);
    Node base = *instr->as.node->base;
    base.program_lifetime = base.program_lifetime_children = false;
    base.attr_count = count;
    Value values[BATCH_SIZE];
    for (uint32_t k = 0; k < active; k++, own += count) {
        uint32_t iteration = batch->selection[k];
        for (uint32_t i = 0; i < count; i++) {
            own[i].name = attrs[i].name;
            if (!columns[i])
                own[i].value = attrs[i].value;
            else if (columns[i]->kind == COLUMN_NUMBERS)
                vm_set_number(&own[i].value, columns[i]->as.numbers[iteration]);
            else
                own[i].value = columns[i]->as.values[iteration];
        }
        made[k].node = base;
        made[k].node.attrs = own;
        made[k].item = (Item){ITEM_NODE, .as.node = &made[k].node};
        values[k] = (Value){.len = 1, .kind = VALUE_MIXED, .as.items = &made[k].item};
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

bool vm_batch_try_op(LoopBatch *batch, const Instr *instr) {
    switch ((Opcode)instr->op) {
    case OP_BUILTIN:
        return run_each(batch, instr) || run_noise(batch, instr) || run_calls(batch, instr);
    case OP_COMPOSE:
        return run_compose(batch, instr);
    case OP_LOOKUP:
        return run_lookups(batch, instr);
    case OP_SLICE:
        return run_slice(batch, instr);
    case OP_NODE:
        return run_nodes(batch, instr);
    default:
        return vm_batch_try_operator(batch, instr);
    }
}
