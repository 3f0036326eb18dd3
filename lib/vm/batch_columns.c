// batch_columns.c: execution of one instruction for a batch of iterations; see batch_columns.h.
#include "vm/batch_columns.h"

#include "value/value_hash.h"

#include <string.h>

static Column *column_to_write(const LoopBatch *batch, int32_t d) {
    return &batch->columns[batch->plan->columns[d - batch->plan->first_register] - 1];
}

static bool all_selected(const LoopBatch *batch) {
    return batch->selected_count == batch->count;
}

// Converts a column to COLUMN_VALUES, so that values of any kind can be written for some of the iterations.
static void make_values(const LoopBatch *batch, int32_t d, Column *column) {
    Value same = column->kind == COLUMN_UNIFORM ? batch->frame->slots[d] : VALUE_NULL;
    if (column->kind == COLUMN_VALUES)
        return;
    for (uint32_t i = batch->count; i-- > 0;)
        column->as.values[i] = column->kind == COLUMN_NUMBERS ? value_number(column->as.numbers[i]) : same;
    column->kind = COLUMN_VALUES;
}

void vm_batch_store_numbers(LoopBatch *batch, int32_t d, const double *numbers) {
    Column *column = column_to_write(batch, d);
    if (all_selected(batch)) {
        column->kind = COLUMN_NUMBERS;
        memcpy(column->as.numbers, numbers, batch->count * sizeof *numbers);
        return;
    }
    if (column->kind == COLUMN_NONE) {
        column->kind = COLUMN_NUMBERS;
        memset(column->as.numbers, 0, batch->count * sizeof *numbers);
    } else if (column->kind != COLUMN_NUMBERS) {
        make_values(batch, d, column);
        for (uint32_t k = 0; k < batch->selected_count; k++)
            column->as.values[batch->selection[k]] = value_number(numbers[k]);
        return;
    }
    for (uint32_t k = 0; k < batch->selected_count; k++)
        column->as.numbers[batch->selection[k]] = numbers[k];
}

void vm_batch_store(LoopBatch *batch, int32_t d, const Value *values) {
    uint32_t count = batch->selected_count, single = 0;
    double numbers[BATCH_SIZE];
    while (single < count && is_number(&values[single])) {
        numbers[single] = values[single].as.number;
        single++;
    }
    if (single == count) {
        vm_batch_store_numbers(batch, d, numbers);
        return;
    }
    Column *column = column_to_write(batch, d);
    if (all_selected(batch)) {
        column->kind = COLUMN_VALUES;
        memcpy(column->as.values, values, count * sizeof *values);
        return;
    }
    make_values(batch, d, column);
    for (uint32_t k = 0; k < count; k++)
        column->as.values[batch->selection[k]] = values[k];
}

// Writes the same value for all selected iterations.
static void store_uniform(LoopBatch *batch, int32_t d, Value value) {
    Column *column = column_to_write(batch, d);
    if (all_selected(batch)) {
        column->kind = COLUMN_UNIFORM;
        batch->frame->slots[d] = value;
        return;
    }
    Value values[BATCH_SIZE];
    for (uint32_t k = 0; k < batch->selected_count; k++)
        values[k] = value;
    vm_batch_store(batch, d, values);
}

const double *vm_batch_numbers(const LoopBatch *batch, int32_t operand, double buffer[BATCH_SIZE]) {
    const Column *column = column_of(batch, operand);
    if (column && column->kind != COLUMN_NUMBERS)
        return NULL;
    if (column && all_selected(batch))
        return column->as.numbers;
    if (!column && !is_number(&batch->frame->slots[operand]))
        return NULL;
    for (uint32_t k = 0; k < batch->selected_count; k++)
        buffer[k] = column ? column->as.numbers[batch->selection[k]] : batch->frame->slots[operand].as.number;
    return buffer;
}

// --- numbers

#define EACH(opcode, result)                                                                                           \
    case opcode:                                                                                                       \
        for (uint32_t k = 0; k < count; k++)                                                                           \
            to[k] = result;                                                                                            \
        break;

// Applies an arithmetic or comparison operator to arrays of numbers. Returns false for other instructions.
static bool apply_operator(uint16_t op, uint32_t count, const double *x, const double *y, double *to) {
    switch ((Opcode)op) {
        EACH(OP_ADD, x[k] + y[k])
        EACH(OP_SUB, x[k] - y[k])
        EACH(OP_MUL, x[k] * y[k])
        EACH(OP_DIV, x[k] / y[k])
        EACH(OP_FLOORDIV, op_number(ARITH_FLOORDIV, x[k], y[k]))
        EACH(OP_MOD, op_number(ARITH_MOD, x[k], y[k]))
        EACH(OP_EQ, x[k] == y[k])
        EACH(OP_NE, x[k] != y[k])
        EACH(OP_LT, x[k] < y[k])
        EACH(OP_GT, !(x[k] <= y[k]))
        EACH(OP_LE, x[k] <= y[k])
        EACH(OP_GE, !(x[k] < y[k]))
    default:
        return false;
    }
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

bool vm_batch_try_operator(LoopBatch *batch, const Instr *instr) {
    if (instr->op == OP_INDEX)
        return run_index(batch, instr);
    if (instr->op == OP_POW)
        return run_powers(batch, instr);
    double left[BATCH_SIZE], right[BATCH_SIZE], to[BATCH_SIZE];
    if (instr->op < OP_EQ || instr->op > OP_MOD)
        return false;
    bool compares = instr->op >= OP_LT && instr->op <= OP_GE;
    const double *x = vm_batch_numbers(batch, instr->a, left), *y = x ? vm_batch_numbers(batch, instr->b, right) : NULL;
    if (!y || (compares && instr->c) || !apply_operator(instr->op, batch->selected_count, x, y, to))
        return false;
    vm_batch_store_numbers(batch, instr->d, to);
    return true;
}

// --- other instructions

// Executes one instruction with vm_eval and returns its result.
static Value run_alone(LoopBatch *batch, const Instr *instr) {
    const Code *code = batch->code;
    const Instr instrs[2] = {*instr, {.op = OP_RETURN, .a = instr->d, .at = instr->at}};
    const Code alone = {.source = code->source, .instrs = instrs, .count = 2, .operands = code->operands};
    return vm_eval(batch->vm, batch->frame, &alone);
}

static Value run_once(LoopBatch *batch, const Instr *instr) {
    const Value *slots = batch->frame->slots;
    const int32_t *list = batch->code->operands + instr->list;
    switch ((Opcode)instr->op) {
    case OP_NODE:
        return vm_make_node(batch->vm, list, slots, instr);
    case OP_LOOKUP:
        return vm_lookup(batch->vm, list, slots, instr);
    case OP_COMPOSE:
        return vm_compose(batch->vm, list, slots, instr, instr->at);
    case OP_BUILTIN:
        return vm_call_builtin(batch->vm, list, slots, instr);
    case OP_SLICE:
        return vm_slice(batch->vm, instr->as.inner_origin, slots[instr->a], slots[instr->b], slots[instr->c]);
    default:
        return run_alone(batch, instr);
    }
}

// Returns true if the result depends only on the operands and can be shared by all iterations.
static bool can_share(const Instr *instr) {
    return instr->op != OP_NODE && instr->op != OP_APPEND && instr->op != OP_DECORATE && instr->op != OP_LOOKUP;
}

// Executes an instruction once per selected iteration, with the registers set to the iteration's values. If no operand
// is a column and the result can be shared, executes it only once.
static void run_each_iteration(LoopBatch *batch, const Instr *instr) {
    int32_t reads[CODE_MAX_READ];
    Value *registers[CODE_MAX_READ], values[BATCH_SIZE];
    const Column *columns[CODE_MAX_READ];
    uint32_t read = program_operands_read(batch->code->operands, instr, reads), count = 0;
    for (uint32_t i = 0; i < read; i++) {
        columns[count] = reads[i] == CODE_NO_OPERAND ? NULL : column_of(batch, reads[i]);
        registers[count] = &batch->frame->slots[columns[count] ? reads[i] : 0];
        count += columns[count] != NULL;
    }
    if (count == 0 && can_share(instr)) {
        store_uniform(batch, instr->d, run_once(batch, instr));
        return;
    }
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        for (uint32_t i = 0; i < count; i++)
            if (columns[i]->kind == COLUMN_NUMBERS)
                vm_set_number(registers[i], columns[i]->as.numbers[batch->selection[k]]);
            else
                *registers[i] = columns[i]->as.values[batch->selection[k]];
        values[k] = run_once(batch, instr);
    }
    vm_batch_store(batch, instr->d, values);
}

static void run_unpack(LoopBatch *batch, const Instr *instr) {
    Value whole[BATCH_SIZE], values[BATCH_SIZE];
    for (uint32_t k = 0; k < batch->selected_count; k++)
        whole[k] = column_read(batch, instr->a, batch->selection[k]);
    for (uint32_t i = 0; i < instr->count; i++) {
        for (uint32_t k = 0; k < batch->selected_count; k++)
            values[k] = vm_unpack_element(batch->vm, whole[k], i);
        vm_batch_store(batch, instr->d + (int32_t)i, values);
    }
}

static void run_move(LoopBatch *batch, const Instr *instr) {
    Value values[BATCH_SIZE];
    if (!column_of(batch, instr->a)) {
        store_uniform(batch, instr->d, batch->frame->slots[instr->a]);
        return;
    }
    for (uint32_t k = 0; k < batch->selected_count; k++)
        values[k] = column_read(batch, instr->a, batch->selection[k]);
    vm_batch_store(batch, instr->d, values);
}

void vm_batch_run_instr(LoopBatch *batch, const Instr *instr) {
    if (instr->op == OP_MOVE)
        run_move(batch, instr);
    else if (instr->op == OP_UNPACK)
        run_unpack(batch, instr);
    else if (!vm_batch_try_op(batch, instr))
        run_each_iteration(batch, instr);
}
