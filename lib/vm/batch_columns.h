// batch_columns.h: what the files that run many rounds of a loop at once share; see vm_run_batches in machine.h.
//
// A block of rounds is run instruction by instruction. What the body writes is kept in columns, a value for each round;
// branches make some of the rounds inactive until their instruction comes. Numbers are computed with in simple loops;
// for anything else the instruction is done as ever, for one active round after the other.
#ifndef PETRI_VM_BATCH_COLUMNS_H
#define PETRI_VM_BATCH_COLUMNS_H

#include "vm/machine.h"

enum { BATCH_SIZE = 64 }; // of a block, at most

typedef enum ColumnKind {
    COLUMN_NONE,    // nothing has been written yet
    COLUMN_UNIFORM, // the same in all rounds: it is in the register
    COLUMN_NUMBERS, // one number each
    COLUMN_VALUES,
} ColumnKind;

typedef struct Column {
    ColumnKind kind;
    union {
        double numbers[BATCH_SIZE];
        Value values[BATCH_SIZE];
    } as;
} Column;

typedef struct LoopBatch {
    Vm *vm;
    Frame *frame;
    const Code *code;
    const BatchPlan *plan;
    Column *columns;
    uint32_t count; // of rounds
    uint32_t selected_count;
    uint8_t selection[BATCH_SIZE];     // those, ascending
    uint32_t resume_at[BATCH_SIZE];    // of each round: the instruction from which on it is active
    uint32_t reconverge_at;            // the first of those that are ahead
    uint32_t yield_counts[BATCH_SIZE]; // of each round
    Value *yields;                     // … plan->part_count of each round
} LoopBatch;

// The column that an operand is, or NULL if its value is the same in all rounds.
static inline Column *column_of(const LoopBatch *batch, int32_t operand) {
    uint32_t at = (uint32_t)(operand - batch->plan->first_register);
    if (operand < batch->plan->first_register || at >= batch->plan->register_count || !batch->plan->columns[at])
        return NULL;
    Column *column = &batch->columns[batch->plan->columns[at] - 1];
    return column->kind == COLUMN_UNIFORM ? NULL : column;
}

static inline Value column_value(const Column *column, uint32_t iteration) {
    return column->kind == COLUMN_NUMBERS ? value_number(column->as.numbers[iteration]) : column->as.values[iteration];
}

// The value of an operand in a round.
static inline Value column_read(const LoopBatch *batch, int32_t operand, uint32_t iteration) {
    const Column *column = column_of(batch, operand);
    return column ? column_value(column, iteration) : batch->frame->slots[operand];
}

// Writes a value for each active round, in their order.
void vm_batch_store(LoopBatch *batch, int32_t d, const Value *values);
void vm_batch_store_numbers(LoopBatch *batch, int32_t d, const double *numbers);
// The numbers that an operand is in the active rounds, perhaps in `room`; NULL if it is not one number in each.
const double *vm_batch_numbers(const LoopBatch *batch, int32_t operand, double buffer[BATCH_SIZE]);
// Does an instruction for all active rounds at once; false if there is no way to. The first is for operators over
// numbers, the second, in batch_ops.c, for all.
bool vm_batch_try_operator(LoopBatch *batch, const Instr *instr);
bool vm_batch_try_op(LoopBatch *batch, const Instr *instr);
// Runs an instruction, which is no jump and adds no part, for all active rounds.
void vm_batch_run_instr(LoopBatch *batch, const Instr *instr);

#endif
