// batch_columns.c: reading and writing of columns; see batch_columns.h.
//
// If only some iterations are selected, the values of the others must be kept. If the kind of a column does not suit
// the new values, its values are first converted to the most general kind (make_values).
#include "vm/batch_columns.h"

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

void vm_batch_store_uniform(LoopBatch *batch, int32_t d, Value value) {
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
