// columns.c: one instruction for many rounds of a loop; see columns.h.
#include "vm/columns.h"

#include "value/seed.h"

#include <string.h>

static Column *column_to_write(const Block *block, int32_t d) {
    return &block->columns[block->plan->columns[d - block->plan->first] - 1];
}

static bool all_active(const Block *block) {
    return block->active_count == block->count;
}

// Makes a column one of values, for some of them to be written.
static void make_values(const Block *block, int32_t d, Column *column) {
    Value same = column->kind == COLUMN_SAME ? block->frame->slots[d] : VALUE_NULL;
    if (column->kind == COLUMN_VALUES)
        return;
    for (uint32_t i = block->count; i-- > 0;)
        column->as.values[i] = column->kind == COLUMN_NUMBERS ? value_number(column->as.numbers[i]) : same;
    column->kind = COLUMN_VALUES;
}

void vm_columns_store_numbers(Block *block, int32_t d, const double *numbers) {
    Column *column = column_to_write(block, d);
    if (all_active(block)) {
        column->kind = COLUMN_NUMBERS;
        memcpy(column->as.numbers, numbers, block->count * sizeof *numbers);
        return;
    }
    if (column->kind == COLUMN_NONE) {
        column->kind = COLUMN_NUMBERS;
        memset(column->as.numbers, 0, block->count * sizeof *numbers);
    } else if (column->kind != COLUMN_NUMBERS) {
        make_values(block, d, column);
        for (uint32_t k = 0; k < block->active_count; k++)
            column->as.values[block->active[k]] = value_number(numbers[k]);
        return;
    }
    for (uint32_t k = 0; k < block->active_count; k++)
        column->as.numbers[block->active[k]] = numbers[k];
}

void vm_columns_store(Block *block, int32_t d, const Value *values) {
    uint32_t count = block->active_count, single = 0;
    double numbers[COLUMN_ROUNDS];
    while (single < count && is_number(&values[single])) {
        numbers[single] = values[single].as.number;
        single++;
    }
    if (single == count) {
        vm_columns_store_numbers(block, d, numbers);
        return;
    }
    Column *column = column_to_write(block, d);
    if (all_active(block)) {
        column->kind = COLUMN_VALUES;
        memcpy(column->as.values, values, count * sizeof *values);
        return;
    }
    make_values(block, d, column);
    for (uint32_t k = 0; k < count; k++)
        column->as.values[block->active[k]] = values[k];
}

// The same value for all active rounds.
static void store_same(Block *block, int32_t d, Value value) {
    Column *column = column_to_write(block, d);
    if (all_active(block)) {
        column->kind = COLUMN_SAME;
        block->frame->slots[d] = value;
        return;
    }
    Value values[COLUMN_ROUNDS];
    for (uint32_t k = 0; k < block->active_count; k++)
        values[k] = value;
    vm_columns_store(block, d, values);
}

// The numbers that an operand is in the active rounds, perhaps in `room`; NULL if it is not one number in each.
const double *vm_column_numbers(const Block *block, int32_t operand, double room[COLUMN_ROUNDS]) {
    const Column *column = column_of(block, operand);
    if (column && column->kind != COLUMN_NUMBERS)
        return NULL;
    if (column && all_active(block))
        return column->as.numbers;
    if (!column && !is_number(&block->frame->slots[operand]))
        return NULL;
    for (uint32_t k = 0; k < block->active_count; k++)
        room[k] = column ? column->as.numbers[block->active[k]] : block->frame->slots[operand].as.number;
    return room;
}

// --- numbers

#define EACH(opcode, result)                                                                                           \
    case opcode:                                                                                                       \
        for (uint32_t k = 0; k < count; k++)                                                                           \
            to[k] = result;                                                                                            \
        break;

// An operator over numbers; false if it has no simple loop.
static bool operate(uint16_t op, uint32_t count, const double *x, const double *y, double *to) {
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

// Powers are quicker for a vector.
static bool run_powers(Block *block, const Instr *instr) {
    double left[COLUMN_ROUNDS], right[COLUMN_ROUNDS];
    const double *x = vm_column_numbers(block, instr->a, left);
    const double *y = x ? vm_column_numbers(block, instr->b, right) : NULL;
    if (!y)
        return false;
    uint32_t count = block->active_count;
    block->vm->at = instr->at;
    Value powers = op_arith(block->vm->arena, ARITH_POW, value_numbers_view(x, count),
                            value_numbers_view(y, column_of(block, instr->b) ? count : 1));
    vm_columns_store_numbers(block, instr->d, value_numbers(&powers));
    return true;
}

// Elements of one vector of numbers, or items of one stream.
static bool run_index(Block *block, const Instr *instr) {
    double room[COLUMN_ROUNDS], to[COLUMN_ROUNDS];
    const double *at = vm_column_numbers(block, instr->b, room);
    const Value *vector = &block->frame->slots[instr->a];
    if (at && !column_of(block, instr->a) && vector->kind == VALUE_STREAM) {
        value_stream_items(*vector, at, block->active_count, to);
        vm_columns_store_numbers(block, instr->d, to);
        return true;
    }
    if (!at || column_of(block, instr->a) || vector->kind != VALUE_NUMBERS || vector->len == 0)
        return false;
    const double *from = value_numbers(vector);
    for (uint32_t k = 0; k < block->active_count; k++)
        to[k] = from[at[k] >= 0 && at[k] < vector->len ? (uint32_t)at[k] : value_wrap_index(at[k], vector->len)];
    vm_columns_store_numbers(block, instr->d, to);
    return true;
}

bool vm_columns_operate(Block *block, const Instr *instr) {
    if (instr->op == OP_INDEX)
        return run_index(block, instr);
    if (instr->op == OP_POW)
        return run_powers(block, instr);
    double left[COLUMN_ROUNDS], right[COLUMN_ROUNDS], to[COLUMN_ROUNDS];
    if (instr->op < OP_EQ || instr->op > OP_MOD)
        return false;
    bool compares = instr->op >= OP_LT && instr->op <= OP_GE;
    const double *x = vm_column_numbers(block, instr->a, left),
                 *y = x ? vm_column_numbers(block, instr->b, right) : NULL;
    if (!y || (compares && instr->c) || !operate(instr->op, block->active_count, x, y, to))
        return false;
    vm_columns_store_numbers(block, instr->d, to);
    return true;
}

// --- anything

// An instruction by itself.
static Value run_alone(Block *block, const Instr *instr) {
    const Code *code = block->code;
    const Instr instrs[2] = {*instr, {.op = OP_RETURN, .a = instr->d, .at = instr->at}};
    const Code alone = {.source = code->source, .instrs = instrs, .count = 2, .operands = code->operands};
    return vm_eval(block->vm, block->frame, &alone);
}

static Value run_once(Block *block, const Instr *instr) {
    const Value *slots = block->frame->slots;
    const int32_t *list = block->code->operands + instr->list;
    switch ((Opcode)instr->op) {
    case OP_NODE:
        return vm_make_node(block->vm, list, slots, instr);
    case OP_LOOKUP:
        return vm_lookup(block->vm, list, slots, instr);
    case OP_COMPOSE:
        return vm_compose(block->vm, list, slots, instr, instr->at);
    case OP_BUILTIN:
        return vm_call_builtin(block->vm, list, slots, instr);
    case OP_SLICE:
        return vm_slice(block->vm, instr->as.inner, slots[instr->a], slots[instr->b], slots[instr->c]);
    default:
        return run_alone(block, instr);
    }
}

// Is its result the same for the same operands, and may it be shared?
static bool may_share(const Instr *instr) {
    return instr->op != OP_NODE && instr->op != OP_APPEND && instr->op != OP_DECORATE && instr->op != OP_LOOKUP;
}

// The instruction with the registers set to the values of each round.
static void run_each_round(Block *block, const Instr *instr) {
    int32_t reads[CODE_MOST_READ];
    Value *registers[CODE_MOST_READ], values[COLUMN_ROUNDS];
    const Column *columns[CODE_MOST_READ];
    uint32_t read = program_reads(block->code->operands, instr, reads), count = 0;
    for (uint32_t i = 0; i < read; i++) {
        columns[count] = reads[i] == CODE_NO_OPERAND ? NULL : column_of(block, reads[i]);
        registers[count] = &block->frame->slots[columns[count] ? reads[i] : 0];
        count += columns[count] != NULL;
    }
    if (count == 0 && may_share(instr)) {
        store_same(block, instr->d, run_once(block, instr));
        return;
    }
    for (uint32_t k = 0; k < block->active_count; k++) {
        for (uint32_t i = 0; i < count; i++)
            if (columns[i]->kind == COLUMN_NUMBERS)
                vm_set_number(registers[i], columns[i]->as.numbers[block->active[k]]);
            else
                *registers[i] = columns[i]->as.values[block->active[k]];
        values[k] = run_once(block, instr);
    }
    vm_columns_store(block, instr->d, values);
}

static void run_unpack(Block *block, const Instr *instr) {
    Value whole[COLUMN_ROUNDS], values[COLUMN_ROUNDS];
    for (uint32_t k = 0; k < block->active_count; k++)
        whole[k] = column_read(block, instr->a, block->active[k]);
    for (uint32_t i = 0; i < instr->count; i++) {
        for (uint32_t k = 0; k < block->active_count; k++)
            values[k] = vm_unpacked(block->vm, whole[k], i);
        vm_columns_store(block, instr->d + (int32_t)i, values);
    }
}

static void run_move(Block *block, const Instr *instr) {
    Value values[COLUMN_ROUNDS];
    if (!column_of(block, instr->a)) {
        store_same(block, instr->d, block->frame->slots[instr->a]);
        return;
    }
    for (uint32_t k = 0; k < block->active_count; k++)
        values[k] = column_read(block, instr->a, block->active[k]);
    vm_columns_store(block, instr->d, values);
}

void vm_columns_run(Block *block, const Instr *instr) {
    if (instr->op == OP_MOVE)
        run_move(block, instr);
    else if (instr->op == OP_UNPACK)
        run_unpack(block, instr);
    else if (!vm_columns_make(block, instr))
        run_each_round(block, instr);
}
