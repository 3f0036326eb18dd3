// columns.h: what the files that run many rounds of a loop at once share; see vm_rounds in machine.h.
//
// A block of rounds is run instruction by instruction. What the body writes is kept in columns, a value for each round;
// branches make some of the rounds inactive until their instruction comes. Numbers are computed with in simple loops;
// for anything else the instruction is done as ever, for one active round after the other.
#ifndef PETRI_VM_COLUMNS_H
#define PETRI_VM_COLUMNS_H

#include "vm/machine.h"

enum { COLUMN_ROUNDS = 64 }; // of a block, at most

typedef enum ColumnKind {
    COLUMN_NONE,    // nothing has been written yet
    COLUMN_SAME,    // the same in all rounds: it is in the register
    COLUMN_NUMBERS, // one number each
    COLUMN_VALUES,
} ColumnKind;

typedef struct Column {
    ColumnKind kind;
    union {
        double numbers[COLUMN_ROUNDS];
        Value values[COLUMN_ROUNDS];
    } as;
} Column;

typedef struct Block {
    Vm *vm;
    Frame *frame;
    const Code *code;
    const RoundsCode *plan;
    Column *columns;
    uint32_t count; // of rounds
    uint32_t active_count;
    uint8_t active[COLUMN_ROUNDS];       // those, ascending
    uint32_t resume[COLUMN_ROUNDS];      // of each round: the instruction from which on it is active
    uint32_t landing;                    // the first of those that are ahead
    uint32_t part_counts[COLUMN_ROUNDS]; // of each round
    Value *parts;                        // … plan->part_count of each round
} Block;

// The column that an operand is, or NULL if its value is the same in all rounds.
static inline Column *column_of(const Block *block, int32_t operand) {
    uint32_t at = (uint32_t)(operand - block->plan->first);
    if (operand < block->plan->first || at >= block->plan->range || !block->plan->columns[at])
        return NULL;
    Column *column = &block->columns[block->plan->columns[at] - 1];
    return column->kind == COLUMN_SAME ? NULL : column;
}

static inline Value column_value(const Column *column, uint32_t round) {
    return column->kind == COLUMN_NUMBERS ? value_number(column->as.numbers[round]) : column->as.values[round];
}

// The value of an operand in a round.
static inline Value column_read(const Block *block, int32_t operand, uint32_t round) {
    const Column *column = column_of(block, operand);
    return column ? column_value(column, round) : block->frame->slots[operand];
}

// Writes a value for each active round, in their order.
void vm_columns_store(Block *block, int32_t d, const Value *values);
void vm_columns_store_numbers(Block *block, int32_t d, const double *numbers);
// The numbers that an operand is in the active rounds, perhaps in `room`; NULL if it is not one number in each.
const double *vm_column_numbers(const Block *block, int32_t operand, double room[COLUMN_ROUNDS]);
// Does an instruction for all active rounds at once; false if there is no way to. The first is for operators over
// numbers, the second, in together.c, for all.
bool vm_columns_operate(Block *block, const Instr *instr);
bool vm_columns_make(Block *block, const Instr *instr);
// Runs an instruction, which is no jump and adds no part, for all active rounds.
void vm_columns_run(Block *block, const Instr *instr);

#endif
