// batch_ops.c: execution of one instruction for a batch of iterations; see batch_columns.h.
//
// A function for columns that returns false has changed no column. vm_batch_call then executes the instruction once for
// each selected iteration, with the same result.
#include "builtin/noise.h"
#include "value/stream.h"
#include "vm/batch_columns.h"

#include <string.h>

enum { MAX_OPERANDS = 8 }; // maximum number of operands of an instruction that is executed on columns

// The numbers of operands in the selected iterations.
typedef struct Numbers {
    const double *of[MAX_OPERANDS]; // by operand; may point to its buffer
    double buffers[MAX_OPERANDS][BATCH_SIZE];
} Numbers;

// Reads the numbers of operands. Returns false if there are too many operands, or if an operand is not a single number
// in all iterations.
static bool read_column_numbers(const LoopBatch *batch, const int32_t *operands, uint32_t count, Numbers *numbers) {
    for (uint32_t i = 0; i < count; i++)
        if (count > MAX_OPERANDS || !(numbers->of[i] = vm_batch_numbers(batch, operands[i], numbers->buffers[i])))
            return false;
    return true;
}

static const int32_t *operand_list(const LoopBatch *batch, const Instr *instr) {
    return batch->frame->operands + instr->list;
}

// --- numbers

// Applies the formula of an instruction (opcode_list.h) to arrays of numbers.
static bool run_numbers(LoopBatch *batch, const Instr *instr) {
    Numbers numbers;
    double to[BATCH_SIZE];
    if (!read_column_numbers(batch, (int32_t[]){instr->a, instr->b}, 2, &numbers))
        return false;
    const double *xs = numbers.of[0], *ys = numbers.of[1];
    const uint32_t count = batch->selected_count;
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
    Numbers numbers;
    uint32_t count = batch->selected_count;
    if (!read_column_numbers(batch, (int32_t[]){instr->a, instr->b}, 2, &numbers))
        return false;
    batch->vm->at = instr->at;
    Value powers = op_arith(batch->vm->arena, ARITH_POW, value_numbers_view(numbers.of[0], count),
                            value_numbers_view(numbers.of[1], column_of(batch, instr->b) ? count : 1));
    vm_batch_store_numbers(batch, instr->d, value_numbers(&powers));
    return true;
}

// --- elements

// Reads elements of a stream or numeric vector that is the same in all iterations.
static bool run_index(LoopBatch *batch, const Instr *instr) {
    Numbers numbers;
    double to[BATCH_SIZE];
    const Value *vector = &batch->frame->slots[instr->a];
    if (column_of(batch, instr->a) || !read_column_numbers(batch, &instr->b, 1, &numbers))
        return false;
    const double *at = numbers.of[0], *from = value_numbers(vector);
    if (vector->kind == VALUE_STREAM)
        value_stream_items(*vector, at, batch->selected_count, to);
    else if (vector->kind == VALUE_NUMBERS && vector->len > 0)
        for (uint32_t k = 0; k < batch->selected_count; k++)
            to[k] = from[at[k] >= 0 && at[k] < vector->len ? (uint32_t)at[k] : value_wrap_index(at[k], vector->len)];
    else
        return false;
    vm_batch_store_numbers(batch, instr->d, to);
    return true;
}

// Slices a vector that is the same in all iterations.
static bool run_slice(LoopBatch *batch, const Instr *instr) {
    Numbers numbers;
    Value values[BATCH_SIZE];
    const Value *vector = &batch->frame->slots[instr->a];
    if (column_of(batch, instr->a) || !read_column_numbers(batch, (int32_t[]){instr->b, instr->c}, 2, &numbers))
        return false;
    batch->vm->at = instr->as.inner_origin;
    for (uint32_t k = 0; k < batch->selected_count; k++)
        if (!vm_slice_numbers(batch->vm, vector, numbers.of[0][k], numbers.of[1][k], &values[k]))
            return false;
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Looks up one key per selected iteration. The keys must consist of numbers.
static bool run_lookups(LoopBatch *batch, const Instr *instr) {
    Numbers numbers;
    double key[MAX_OPERANDS];
    Value values[BATCH_SIZE];
    if (!batch->vm->state || !read_column_numbers(batch, operand_list(batch, instr), instr->count, &numbers))
        return false;
    batch->vm->at = instr->at;
    batch->vm->met_dynamic = true;
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        for (uint32_t i = 0; i < instr->count; i++)
            key[i] = numbers.of[i][k];
        values[k] = vm_lookup_numbers(batch->vm, instr->target, key, instr->count);
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// --- built-ins

// Calls an element-wise built-in once for all selected iterations. An argument is a vector with one number per
// iteration, or a single number if it is the same in all iterations.
static bool run_each(LoopBatch *batch, const Instr *instr) {
    const Builtin *builtin = instr->as.builtin;
    const int32_t *list = operand_list(batch, instr);
    Numbers numbers;
    Value args[MAX_OPERANDS];
    if (builtin->each == 0 || instr->count < builtin->each || !read_column_numbers(batch, list, instr->count, &numbers))
        return false;
    for (uint32_t i = 0; i < instr->count; i++)
        args[i] = value_numbers_view(numbers.of[i], column_of(batch, list[i]) ? batch->selected_count : 1);
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
    const int32_t *list = operand_list(batch, instr);
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
    const int32_t *list = operand_list(batch, instr);
    Numbers numbers;
    double to[BATCH_SIZE];
    if (instr->as.builtin->each != BUILTIN_EACH_POINT || instr->count != 3 || column_of(batch, list[0]) ||
        !read_column_numbers(batch, list + 1, 2, &numbers))
        return false;
    vm_charge(batch->vm, instr->at, batch->selected_count);
    builtin_noise_points(&batch->vm->builtins, batch->frame->slots[list[0]], numbers.of[0], numbers.of[1],
                         batch->selected_count, to);
    vm_batch_store_numbers(batch, instr->d, to);
    return true;
}

static bool run_builtin(LoopBatch *batch, const Instr *instr) {
    return run_each(batch, instr) || run_noise(batch, instr) || run_calls(batch, instr);
}

// --- vectors and nodes

// Composes one vector of numbers per selected iteration. All vectors have the same length and are rows of one array.
static bool run_compose(LoopBatch *batch, const Instr *instr) {
    Numbers numbers;
    uint32_t width = instr->count, count = batch->selected_count;
    Value values[BATCH_SIZE];
    if (!read_column_numbers(batch, operand_list(batch, instr), width, &numbers))
        return false;
    batch->vm->at = instr->at;
    double *rows = arena_alloc(batch->vm->arena, (size_t)count * width * sizeof *rows);
    for (uint32_t k = 0; k < count; k++) {
        for (uint32_t i = 0; i < width; i++)
            rows[k * width + i] = numbers.of[i][k];
        values[k] = (Value){.len = width, .as.numbers = rows + k * width};
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// Creates nodes without children. Creates one for the first selected iteration, and copies with other attributes.
// Returns false if some iterations lack an attribute, or if an attribute that differs may contain nodes.
static bool run_nodes(LoopBatch *batch, const Instr *instr) {
    const int32_t *list = operand_list(batch, instr);
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
    NodeValue *nodes = arena_alloc(batch->vm->arena, active * sizeof *nodes);
    Attr *attrs = arena_alloc(batch->vm->arena, (size_t)active * count * sizeof *attrs);
    Value values[BATCH_SIZE];
    for (uint32_t k = 0; k < active; k++, attrs += count) {
        nodes[k].node = *node;
        nodes[k].node.attrs = attrs;
        for (uint32_t i = 0; i < node->attr_count; i++) {
            attrs[i] = node->attrs[i];
            if (columns[i])
                attrs[i].value = column_value(columns[i], batch->selection[k]);
        }
        nodes[k].item = (Item){ITEM_NODE, .as.node = &nodes[k].node};
        values[k] = (Value){.len = 1, .kind = VALUE_MIXED, .as.items = &nodes[k].item};
    }
    vm_batch_store(batch, instr->d, values);
    return true;
}

// --- any instruction

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
    VmFunction *function = batch->functions[instr->op];
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
            values[k] = value_element(whole[k], i);
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
