// together.c: instructions that make something for many rounds of a loop at once; see columns.h.
#include "vm/columns.h"

#include "builtin/noise.h"

#include <math.h>
#include <string.h>

enum { MOST_IN_SLICE = 16 }; // for which one array is worth it

// --- built-ins

// A built-in that is element-wise is called once, with vectors.
static bool run_each(Block *block, const Instr *instr) {
    enum { MOST = 4 };
    const Builtin *builtin = instr->as.builtin;
    const int32_t *list = block->code->operands + instr->list;
    double room[MOST][COLUMN_ROUNDS];
    Value args[MOST];
    if (builtin->each == 0 || instr->count < builtin->each || instr->count > MOST)
        return false;
    for (uint32_t i = 0; i < instr->count; i++) {
        const double *x = vm_column_numbers(block, list[i], room[i]);
        if (!x)
            return false;
        args[i] = value_numbers_view(x, column_of(block, list[i]) ? block->active_count : 1);
    }
    vm_work(block->vm, instr->at, block->active_count);
    block->vm->builtins.called = builtin;
    Value result = builtin->call(&block->vm->builtins, args, instr->count);
    if (result.kind != VALUE_NUMBERS || result.len != block->active_count)
        return false;
    vm_columns_store_numbers(block, instr->d, value_numbers(&result));
    return true;
}

// A built-in that is not element-wise.
static bool run_calls(Block *block, const Instr *instr) {
    enum { MOST = 8 };
    const int32_t *list = block->code->operands + instr->list;
    const Column *columns[MOST];
    Value args[MOST], values[COLUMN_ROUNDS];
    uint32_t different = 0;
    for (uint32_t i = 0; i < instr->count && i < MOST; i++) {
        columns[i] = column_of(block, list[i]);
        different += columns[i] != NULL;
        if (!columns[i])
            args[i] = block->frame->slots[list[i]];
    }
    if (instr->count > MOST || different == 0)
        return false;
    block->vm->builtins.called = instr->as.builtin;
    for (uint32_t k = 0; k < block->active_count; k++) {
        for (uint32_t i = 0; i < instr->count; i++)
            if (columns[i])
                args[i] = column_value(columns[i], block->active[k]);
        vm_may_call(block->vm, instr->as.builtin, instr->at, args, instr->count);
        values[k] = instr->as.builtin->call(&block->vm->builtins, args, instr->count);
    }
    vm_columns_store(block, instr->d, values);
    return true;
}

// The noise at one point of the plane in each round.
static bool run_noise(Block *block, const Instr *instr) {
    const int32_t *list = block->code->operands + instr->list;
    double left[COLUMN_ROUNDS], right[COLUMN_ROUNDS], to[COLUMN_ROUNDS];
    if (instr->as.builtin->each != BUILTIN_EACH_POINT || instr->count != 3 || column_of(block, list[0]))
        return false;
    const double *x = vm_column_numbers(block, list[1], left), *y = x ? vm_column_numbers(block, list[2], right) : NULL;
    if (!y)
        return false;
    vm_work(block->vm, instr->at, block->active_count);
    builtin_noise_points(&block->vm->builtins, block->frame->slots[list[0]], x, y, block->active_count, to);
    vm_columns_store_numbers(block, instr->d, to);
    return true;
}

// Parts that are numbers, as rows of one array.
static bool run_compose(Block *block, const Instr *instr) {
    enum { MOST = 8 };
    const int32_t *list = block->code->operands + instr->list;
    double room[MOST][COLUMN_ROUNDS];
    const double *parts[MOST];
    uint32_t width = instr->count, count = block->active_count;
    Value values[COLUMN_ROUNDS];
    for (uint32_t i = 0; i < width; i++)
        if (width > MOST || width < 2 || !(parts[i] = vm_column_numbers(block, list[i], room[i])))
            return false;
    block->vm->at = instr->at;
    double *rows = arena_alloc(block->vm->arena, (size_t)count * width * sizeof *rows);
    for (uint32_t k = 0; k < count; k++) {
        for (uint32_t i = 0; i < width; i++)
            rows[k * width + i] = parts[i][k];
        values[k] = (Value){.len = width, .as.numbers = rows + k * width};
    }
    vm_columns_store(block, instr->d, values);
    return true;
}

// Slices of one length of one vector of numbers, copied into one array.
static bool run_slice(Block *block, const Instr *instr) {
    double left[COLUMN_ROUNDS], right[COLUMN_ROUNDS];
    const double *from = vm_column_numbers(block, instr->b, left);
    const double *to = from ? vm_column_numbers(block, instr->c, right) : NULL;
    const Value vector = block->frame->slots[instr->a];
    uint32_t count = block->active_count, most = vector.len;
    if (!to || column_of(block, instr->a) || vector.kind != VALUE_NUMBERS)
        return false;
    double len = to[0] - from[0];
    bool fits = len >= 2 && len <= MOST_IN_SLICE;
    for (uint32_t k = 0; fits && k < count; k++)
        fits = from[k] >= 0 && to[k] <= most && to[k] - from[k] == len && floor(from[k]) == from[k];
    if (!fits || floor(len) != len)
        return false;
    uint32_t width = (uint32_t)len;
    block->vm->at = instr->as.inner;
    double *rows = arena_alloc(block->vm->arena, (size_t)count * width * sizeof *rows);
    Value values[COLUMN_ROUNDS];
    for (uint32_t k = 0; k < count; k++, rows += width) {
        const double *numbers = vector.as.numbers + (uint32_t)from[k];
        for (uint32_t i = 0; i < width; i++)
            rows[i] = numbers[i];
        values[k] = (Value){.len = width, .as.numbers = rows};
    }
    vm_columns_store(block, instr->d, values);
    return true;
}

// The values under keys of numbers, copied into one array, as vm_lookup copies each.
static bool run_lookups(Block *block, const Instr *instr) {
    enum { MOST = 4 };
    Vm *vm = block->vm;
    const int32_t *list = block->code->operands + instr->list;
    double room[MOST][COLUMN_ROUNDS], key[MOST];
    const double *parts[MOST];
    Value values[COLUMN_ROUNDS];
    size_t numbers = 0;
    for (uint32_t i = 0; i < instr->count; i++)
        if (instr->count > MOST || !vm->state || !(parts[i] = vm_column_numbers(block, list[i], room[i])))
            return false;
    vm->at = instr->at;
    vm->met_dynamic = true;
    for (uint32_t k = 0; k < block->active_count; k++) {
        for (uint32_t i = 0; i < instr->count; i++)
            key[i] = parts[i][k];
        values[k] = vm_get(vm, instr->target, key, instr->count);
        numbers += values[k].kind == VALUE_NUMBERS && values[k].len > 1 ? values[k].len : 0;
    }
    arena_charge(vm->arena, numbers / METER_NUMBERS);
    double *copy = arena_alloc(vm->arena, numbers * sizeof *copy);
    for (uint32_t k = 0; k < block->active_count; k++) {
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
    vm_columns_store(block, instr->d, values);
    return true;
}

// --- nodes

// The attributes that nodes have in common, and the columns of the others; false if some nodes lack one, or if one
// holds nodes.
static bool plan_attributes(const Block *block, const Instr *instr, Attr *attrs, const Column **columns,
                            uint32_t *count) {
    const int32_t *list = block->code->operands + instr->list;
    *count = 0;
    for (uint32_t i = 0; i < instr->count; i++) {
        const Column *column = column_of(block, list[i]);
        const Value *same = column ? NULL : &block->frame->slots[list[i]];
        for (uint32_t k = 0; column && column->kind == COLUMN_VALUES && k < block->active_count; k++) {
            const Value *value = &column->as.values[block->active[k]];
            if (value->len == 0 || value->kind == VALUE_MIXED)
                return false;
        }
        if (same && same->kind == VALUE_MIXED)
            return false;
        if (same && same->len == 0)
            continue; // null and streams are left out (L7.2)
        attrs[*count] = (Attr){instr->as.node->names[i], same ? *same : VALUE_NULL};
        columns[(*count)++] = column;
    }
    return true;
}

// Nodes without children, in one allocation.
static bool run_nodes(Block *block, const Instr *instr) {
    Attr attrs[CODE_MOST_READ];
    const Column *columns[CODE_MOST_READ];
    uint32_t count, active = block->active_count;
    if (instr->b != CODE_NO_OPERAND || instr->as.node->kept || !plan_attributes(block, instr, attrs, columns, &count))
        return false;
    vm_work(block->vm, instr->at, (uint64_t)active * (1 + instr->count / 4));
    NodeValue *made = arena_alloc(block->vm->arena, active * sizeof *made);
    Attr *own = arena_alloc(block->vm->arena, (size_t)active * count * sizeof *own);
    Node base = *instr->as.node->base;
    base.program_lifetime = base.program_lifetime_children = false;
    base.attr_count = count;
    Value values[COLUMN_ROUNDS];
    for (uint32_t k = 0; k < active; k++, own += count) {
        uint32_t round = block->active[k];
        for (uint32_t i = 0; i < count; i++) {
            own[i].name = attrs[i].name;
            if (!columns[i])
                own[i].value = attrs[i].value;
            else if (columns[i]->kind == COLUMN_NUMBERS)
                vm_set_number(&own[i].value, columns[i]->as.numbers[round]);
            else
                own[i].value = columns[i]->as.values[round];
        }
        made[k].node = base;
        made[k].node.attrs = own;
        made[k].item = (Item){ITEM_NODE, .as.node = &made[k].node};
        values[k] = (Value){.len = 1, .kind = VALUE_MIXED, .as.items = &made[k].item};
    }
    vm_columns_store(block, instr->d, values);
    return true;
}

bool vm_columns_make(Block *block, const Instr *instr) {
    switch ((Opcode)instr->op) {
    case OP_BUILTIN:
        return run_each(block, instr) || run_noise(block, instr) || run_calls(block, instr);
    case OP_COMPOSE:
        return run_compose(block, instr);
    case OP_LOOKUP:
        return run_lookups(block, instr);
    case OP_SLICE:
        return run_slice(block, instr);
    case OP_NODE:
        return run_nodes(block, instr);
    default:
        return vm_columns_operate(block, instr);
    }
}
