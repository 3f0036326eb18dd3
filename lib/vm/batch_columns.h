// batch_columns.h: columnar (SIMD-style) execution of a batch of up to 64 loop iterations; see vm_run_batches.
//
// A register that the loop's body writes becomes a column, which holds the register's values in all iterations. Each
// instruction is executed for all selected iterations before the next instruction. At first, all iterations are
// selected. When iterations take different branches, those that skip the next instructions are removed from the
// selection. They are selected again at the instruction at which they continue. Arithmetic and other frequent
// instructions process arrays. Others are executed by the functions that vm_eval uses, once per selected iteration.
#pragma once

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
    VmFunction *const *functions; // by opcode: computes the value for one iteration
    Column *columns;
    uint32_t count;                // number of iterations
    uint32_t selected_count;       // number of elements of `selection`
    uint8_t selection[BATCH_SIZE]; // numbers of the selected iterations, ascending
    // By iteration: index of the instruction at which the iteration is selected again.
    uint32_t resume_at[BATCH_SIZE];
    // Index of the next instruction at which iterations will be selected again; UINT32_MAX: none.
    uint32_t reconverge_at;
    uint32_t yield_counts[BATCH_SIZE]; // by iteration: number of yielded values
    Value *yields;                     // yielded values; each iteration has plan->yield_count elements
} LoopBatch;

// Returns the column of an operand, or NULL if the operand has the same value in all iterations.
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

// For each k, sets register d of iteration selection[k] to values[k].
void vm_batch_store(LoopBatch *batch, int32_t d, const Value *values);
// Like vm_batch_store, for numbers.
void vm_batch_store_numbers(LoopBatch *batch, int32_t d, const double *numbers);
// Sets register d of all selected iterations to the same value.
void vm_batch_store_uniform(LoopBatch *batch, int32_t d, Value value);
// Returns an array with the operand's number in each selected iteration, or NULL if its values are not stored as single
// numbers. The array is `buffer` if the numbers are not already stored in this form.
const double *vm_batch_numbers(const LoopBatch *batch, int32_t operand, double buffer[BATCH_SIZE]);

// batch_ops.c: these functions execute an instruction for all selected iterations. vm_batch_call is for instructions
// that have a function in opcode_list.h.
void vm_batch_move(LoopBatch *batch, const Instr *instr);
void vm_batch_unpack(LoopBatch *batch, const Instr *instr);
void vm_batch_call(LoopBatch *batch, const Instr *instr);
