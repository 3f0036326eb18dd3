// batch_columns.h: columnar (SIMD-style) execution of a batch of up to 64 loop iterations; see vm_run_batches.
//
// The registers that the body writes become columns. Each instruction is executed for all selected iterations before
// the next instruction. At first, all iterations are selected. If iterations take different branches, those that skip
// the next instructions leave the selection, and join it again where their execution continues. Arithmetic and other
// frequent instructions process arrays; the rest are executed as in vm_eval, once per selected iteration.
#ifndef PETRI_VM_BATCH_COLUMNS_H
#define PETRI_VM_BATCH_COLUMNS_H

#include "vm/machine.h"

enum { BATCH_SIZE = 64 }; // maximum number of iterations in a batch

typedef enum ColumnKind {
    COLUMN_NONE,    // not written yet
    COLUMN_UNIFORM, // the same value in all iterations, stored in the register
    COLUMN_NUMBERS, // one number per iteration
    COLUMN_VALUES,  // one value per iteration
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
    uint32_t count;                    // number of iterations
    uint32_t selected_count;           // number of elements of `selection`
    uint8_t selection[BATCH_SIZE];     // selected iterations, ascending
    uint32_t resume_at[BATCH_SIZE];    // by iteration: instruction at which the iteration joins the selection
    uint32_t reconverge_at;            // next instruction at which iterations join the selection
    uint32_t yield_counts[BATCH_SIZE]; // by iteration: number of yielded values
    Value *yields;                     // yielded values: room for plan->yield_count per iteration
} LoopBatch;

// Returns the column of an operand, or NULL if its value is the same in all iterations.
static inline Column *column_of(const LoopBatch *batch, int32_t operand) {
    uint32_t at = (uint32_t)(operand - batch->plan->first_register);
    if (operand < batch->plan->first_register || at >= batch->plan->register_count || !batch->plan->columns[at])
        return NULL;
    Column *column = &batch->columns[batch->plan->columns[at] - 1];
    return column->kind == COLUMN_UNIFORM ? NULL : column;
}

// Returns the value of a column in an iteration.
static inline Value column_value(const Column *column, uint32_t iteration) {
    return column->kind == COLUMN_NUMBERS ? value_number(column->as.numbers[iteration]) : column->as.values[iteration];
}

// Returns the value of an operand in an iteration.
static inline Value column_read(const LoopBatch *batch, int32_t operand, uint32_t iteration) {
    const Column *column = column_of(batch, operand);
    return column ? column_value(column, iteration) : batch->frame->slots[operand];
}

// Writes values[k] to register d of the selected iteration number k, for all k.
void vm_batch_store(LoopBatch *batch, int32_t d, const Value *values);
// Like vm_batch_store, for numbers.
void vm_batch_store_numbers(LoopBatch *batch, int32_t d, const double *numbers);
// Returns the numbers of an operand, one per selected iteration, or NULL if they are not stored as single numbers. The
// numbers are copied to `buffer` if necessary.
const double *vm_batch_numbers(const LoopBatch *batch, int32_t operand, double buffer[BATCH_SIZE]);
// Executes an operator on numbers for all selected iterations at once. Returns false if that is not possible.
bool vm_batch_try_operator(LoopBatch *batch, const Instr *instr);
// Like vm_batch_try_operator, but also accepts calls of built-ins, compositions, lookups, slices and nodes
// (batch_ops.c).
bool vm_batch_try_op(LoopBatch *batch, const Instr *instr);
// Executes any instruction except jumps and yields for all selected iterations, one by one if necessary.
void vm_batch_run_instr(LoopBatch *batch, const Instr *instr);

#endif
