// batch_ops.c: execution of one instruction for a batch of iterations; see batch_columns.h.
#include "builtin/noise.h"
#include "value/value_hash.h"
#include "vm/batch_columns.h"

#include <math.h>
#include <string.h>

// --- numbers

// Applies the formula of an instruction (opcode_list.h) to arrays of numbers. Returns false if an operand is not a
// single number in all iterations.
static bool run_numbers(LoopBatch *batch, const Instr *instr) {
    double left[BATCH_SIZE], right[BATCH_SIZE], to[BATCH_SIZE];
    const double *xs = vm_batch_numbers(batch, instr->a, left);
    const double *ys = xs ? vm_batch_numbers(batch, instr->b, right) : NULL;
    uint32_t count = batch->selected_count;
    if (!ys)
        return false;
    switch ((Opcode)instr->op) {
#define OPCODE(id, name, operands, batch)
#define NUMBERS(id, name, operands, formula, function)                                                                 \
    case OP_##id:                                                                                                      \
        for (uint32_t k = 0; k < count; k++) {                                                                         \
            const double x = xs[k], y = ys[k];                                                                         \
            (void)y;                                                                                                   \
            to[k] = formula;                                                                                           \
        }                                                                                                              \
        break;
#include "program/opcode_list.h"
    default:
        return false;
    }
    vm_batch_store_numbers(batch, instr->d, to);
    return true;
}

// Computes the powers of all selected iterations with one vector operation, which is faster than one operation each.
static bool run_powers(LoopBatch *batch, const Instr *instr) {
    double left[BATCH_SIZE], right[BATCH_SIZE];
    const double *x = vm_batch_numbers(batch, instr->a, left);
    const double *y = x ? vm_batch_numbers(batch, instr->b, right) : NULL;
    if (!y)
        return false;
    uint32_t count = batch->selected_count;
    batch->vm->at = instr->at;
    Value powers = op_arith(batch->vm->arena, ARITH_POW, value_numbers_view(x, count),
                            value_numbers_view(y, column_of(batch, instr->b) ? count : 1));
    vm_batch_store_numbers(batch, instr->d, value_numbers(&powers));
    return true;
}

// Executes an INDEX whose vector is the same in all iterations. Returns false if the vector differs or is neither a
// stream nor numeric, or if an index is not a single number.
static bool run_index(LoopBatch *batch, const Instr *instr) {
    double buffer[BATCH_SIZE], to[BATCH_SIZE];
    const double *at = vm_batch_numbers(batch, instr->b, buffer);
    const Value *vector = &batch->frame->slots[instr->a];
    if (at && !column_of(batch, instr->a) && vector->kind == VALUE_STREAM) {
        value_stream_items(*vector, at, batch->selected_count, to);
        vm_batch_store_numbers(batch, instr->d, to);
        return true;
    }
    if (!at || column_of(batch, instr->a) || vector->kind != VALUE_NUMBERS || vector->len == 0)
        return false;
    const double *from = value_numbers(vector);
    for (uint32_t k = 0; k < batch->selected_count; k++)
        to[k] = from[at[k] >= 0 && at[k] < vector->len ? (uint32_t)at[k] : value_wrap_index(at[k], vector->len)];
    vm_batch_store_numbers(batch, instr->d, to);
    return true;
}

// --- lists of operands

// Sets parts[i] to the numbers of operand i of the list in the selected iterations. They may be in buffers[i]. Returns
// false if there are more than `max` operands, or if an operand is not a single number in all iterations.
static bool read_list(const LoopBatch *batch, const Instr *instr, uint32_t max, double (*buffers)[BATCH_SIZE],
                      const double **parts) {
    const int32_t *list = batch->frame->operands + instr->list;
    for (uint32_t i = 0; i < instr->count; i++)
        if (instr->count > max || !(parts[i] = vm_batch_numbers(batch, list[i], buffers[i])))
            return false;
    return true;
}

// Calls an element-wise built-in once for all selected iterations. An argument is a vector with one number per
// iteration, or a single number if it is the same in all iterations.
static bool run_each(LoopBatch *batch, const Instr *instr) {
    enum { MAX_OPERANDS = 4 };
    const Builtin *builtin = instr->as.builtin;
    const int32_t *list = batch->frame->operands + instr->list;
    double buffers[MAX_OPERANDS][BATCH_SIZE];
    const double *parts[MAX_OPERANDS];
    Value args[MAX_OPERANDS];
    if (builtin->each == 0 || instr->count < builtin->each || !read_list(batch, instr, MAX_OPERANDS, buffers, parts))
        return false;
    for (uint32_t i = 0; i < instr->count; i++)
        args[i] = value_numbers_view(parts[i], column_of(batch, list[i]) ? batch->selected_count : 1);
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
    const int32_t *list = batch->frame->operands + instr->list;
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
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        for (uint32_t i = 0; i < instr->count; i++)
            if (columns[i])
                args[i] = column_value(columns[i], batch->selection[k]);
        values[k] = vm_call_builtin(batch->vm, instr, args);
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Computes noise at one point of the plane per iteration.
static bool run_noise(LoopBatch *batch, const Instr *instr) {
    const int32_t *list = batch->frame->operands + instr->list;
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
    double buffers[MAX_OPERANDS][BATCH_SIZE];
    const double *parts[MAX_OPERANDS];
    uint32_t width = instr->count, count = batch->selected_count;
    Value values[BATCH_SIZE];
    if (!read_list(batch, instr, MAX_OPERANDS, buffers, parts))
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

// Slices a vector that is the same in all iterations.
static bool run_slice(LoopBatch *batch, const Instr *instr) {
    double left[BATCH_SIZE], right[BATCH_SIZE];
    Value values[BATCH_SIZE];
    const double *from = vm_batch_numbers(batch, instr->b, left);
    const double *to = from ? vm_batch_numbers(batch, instr->c, right) : NULL;
    if (!to || column_of(batch, instr->a))
        return false;
    batch->vm->at = instr->as.inner_origin;
    for (uint32_t k = 0; k < batch->selected_count; k++)
        if (!vm_slice_numbers(batch->vm, &batch->frame->slots[instr->a], from[k], to[k], &values[k]))
            return false;
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Looks up one key per selected iteration. The keys must consist of numbers.
static bool run_lookups(LoopBatch *batch, const Instr *instr) {
    enum { MAX_OPERANDS = 4 };
    double buffers[MAX_OPERANDS][BATCH_SIZE], key[MAX_OPERANDS];
    const double *parts[MAX_OPERANDS];
    Value values[BATCH_SIZE];
    if (!batch->vm->state || !read_list(batch, instr, MAX_OPERANDS, buffers, parts))
        return false;
    batch->vm->at = instr->at;
    batch->vm->met_dynamic = true;
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        for (uint32_t i = 0; i < instr->count; i++)
            key[i] = parts[i][k];
        values[k] = vm_lookup_numbers(batch->vm, instr->target, key, instr->count);
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Creates nodes without children. Creates one for the first selected iteration, and copies with other attributes.
// Returns false if some iterations lack an attribute, or if an attribute that differs may contain nodes.
static bool run_nodes(LoopBatch *batch, const Instr *instr) {
    const int32_t *list = batch->frame->operands + instr->list;
    const Column *columns[CODE_MAX_READ];
    uint32_t count = 0, active = batch->selected_count;
    if (instr->b != CODE_NO_OPERAND)
        return false;
    for (uint32_t i = 0; i < instr->count; i++) {
        const Column *column = columns[count] = column_of(batch, list[i]);
        for (uint32_t k = 0; column && column->kind == COLUMN_VALUES && k < active; k++) {
            const Value *value = &column->as.values[batch->selection[k]];
            if (value->len == 0 || value->kind == VALUE_MIXED)
                return false;
        }
        if (column)
            batch->frame->slots[list[i]] = column_value(column, batch->selection[0]);
        count += batch->frame->slots[list[i]].len > 0; // null and streams are omitted (L7.2)
    }
    const Value first = vm_node(batch->vm, batch->frame, instr);
    const Node *node = first.as.items[0].as.node;
    vm_charge(batch->vm, instr->at, (uint64_t)(active - 1) * (1 + instr->count / 4));
    NodeValue *made = arena_alloc(batch->vm->arena, active * sizeof *made);
    Attr *attrs = arena_alloc(batch->vm->arena, (size_t)active * count * sizeof *attrs);
    Value values[BATCH_SIZE];
    for (uint32_t k = 0; k < active; k++, attrs += count) {
        made[k].node = *node;
        made[k].node.attrs = attrs;
        for (uint32_t i = 0; i < node->attr_count; i++) {
            attrs[i] = node->attrs[i];
            if (columns[i])
                attrs[i].value = column_value(columns[i], batch->selection[k]);
        }
        made[k].item = (Item){ITEM_NODE, .as.node = &made[k].node};
        values[k] = (Value){.len = 1, .kind = VALUE_MIXED, .as.items = &made[k].item};
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

static bool run_builtin(LoopBatch *batch, const Instr *instr) {
    return run_each(batch, instr) || run_noise(batch, instr) || run_calls(batch, instr);
}

// --- any instruction

// The functions that compute an instruction's value for one iteration.
static VmFunction *const functions[OP_COUNT] = {
#define OPCODE(id, name, operands, batch)
#define FUNCTION(id, name, operands, batch, function) [OP_##id] = vm_##function,
#include "program/opcode_list.h"
};

#define OPCODE(id, name, operands, batch) _Static_assert(BATCH_##batch < BATCH_PURE, name " needs a function");
#define FUNCTION(id, name, operands, batch, function)
#include "program/opcode_list.h"

// Faster versions of some functions, which compute the values of all selected iterations. They return false if that is
// not possible for these operands.
static bool (*const columnar[OP_COUNT])(LoopBatch *batch, const Instr *instr) = {
#define OPCODE(id, name, operands, batch)
#define NUMBERS(id, name, operands, formula, function) [OP_##id] = run_numbers,
#include "program/opcode_list.h"
    [OP_POW] = run_powers,     [OP_INDEX] = run_index, [OP_BUILTIN] = run_builtin, [OP_COMPOSE] = run_compose,
    [OP_LOOKUP] = run_lookups, [OP_SLICE] = run_slice, [OP_NODE] = run_nodes,
};

void vm_batch_call(LoopBatch *batch, const Instr *instr) {
    if (columnar[instr->op] && columnar[instr->op](batch, instr))
        return;
    VmFunction *function = functions[instr->op];
    int32_t reads[CODE_MAX_READ];
    Value *registers[CODE_MAX_READ], values[BATCH_SIZE];
    const Column *columns[CODE_MAX_READ];
    uint32_t read = program_operands_read(batch->frame->operands, instr, reads), count = 0;
    for (uint32_t i = 0; i < read; i++) {
        columns[count] = reads[i] == CODE_NO_OPERAND ? NULL : column_of(batch, reads[i]);
        registers[count] = &batch->frame->slots[columns[count] ? reads[i] : 0];
        count += columns[count] != NULL;
    }
    if (count == 0 && program_batch_kinds[instr->op] == BATCH_PURE) {
        vm_batch_store_uniform(batch, instr->d, function(batch->vm, batch->frame, instr));
        return;
    }
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        for (uint32_t i = 0; i < count; i++)
            if (columns[i]->kind == COLUMN_NUMBERS)
                vm_set_number(registers[i], columns[i]->as.numbers[batch->selection[k]]);
            else
                *registers[i] = columns[i]->as.values[batch->selection[k]];
        values[k] = function(batch->vm, batch->frame, instr);
    }
    vm_batch_store(batch, instr->d, values);
}

void vm_batch_unpack(LoopBatch *batch, const Instr *instr) {
    Value whole[BATCH_SIZE], values[BATCH_SIZE];
    for (uint32_t k = 0; k < batch->selected_count; k++)
        whole[k] = column_read(batch, instr->a, batch->selection[k]);
    for (uint32_t i = 0; i < instr->count; i++) {
        for (uint32_t k = 0; k < batch->selected_count; k++)
            values[k] = vm_unpack_element(batch->vm, whole[k], i);
        vm_batch_store(batch, instr->d + (int32_t)i, values);
    }
}

void vm_batch_move(LoopBatch *batch, const Instr *instr) {
    Value values[BATCH_SIZE];
    if (!column_of(batch, instr->a)) {
        vm_batch_store_uniform(batch, instr->d, batch->frame->slots[instr->a]);
        return;
    }
    for (uint32_t k = 0; k < batch->selected_count; k++)
        values[k] = column_read(batch, instr->a, batch->selection[k]);
    vm_batch_store(batch, instr->d, values);
}
