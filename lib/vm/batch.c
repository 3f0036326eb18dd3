// batch.c: execution of loops in batches of iterations; see batch_columns.h.
//
// A batch never reports an error. If one of its iterations would, the batch is discarded (Vm.speculative) and its
// iterations are executed one by one. So values and diagnostics do not depend on batches.
#include "vm/batch_columns.h"

#include <string.h>

enum {
    MIN_BATCH = 8,    // minimum number of remaining iterations for which batches are used
    MAX_FAILURES = 4, // after more failed batches than this, the rest of a loop is executed iteration by iteration
};

// Binds the loop's names to their values in each iteration of the batch.
static void bind_iterations(LoopBatch *batch, const Instr *start, const Loop *loop) {
    Value values[BATCH_SIZE];
    if (start->count == 1 && loop->source.kind == VALUE_ABSENT) {
        double numbers[BATCH_SIZE];
        for (uint32_t k = 0; k < batch->count; k++)
            numbers[k] = op_range_number(&loop->span, loop->at + k);
        vm_batch_store_numbers(batch, start->d, numbers);
        return;
    }
    for (uint32_t i = 0; i < start->count; i++) {
        for (uint32_t k = 0; k < batch->count; k++)
            values[k] = vm_loop_element(loop, loop->at + k * start->count + i);
        vm_batch_store(batch, start->d + (int32_t)i, values);
    }
}

// --- branches

// Removes iterations from the selection until execution reaches instruction `target`. Iteration selection[k] remains
// selected if continues[k] is true. If `continues` is NULL, no iteration remains selected.
static void deselect_iterations(LoopBatch *batch, uint32_t target, const bool *continues) {
    uint32_t remaining = 0;
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        uint8_t iteration = batch->selection[k];
        if (continues && continues[k])
            batch->selection[remaining++] = iteration;
        else
            batch->resume_at[iteration] = target;
    }
    if (remaining < batch->selected_count && target < batch->reconverge_at)
        batch->reconverge_at = target;
    batch->selected_count = remaining;
}

// Selects the iterations that execute instruction `at`.
static void select_iterations(LoopBatch *batch, uint32_t at) {
    batch->selected_count = 0;
    batch->reconverge_at = UINT32_MAX;
    for (uint32_t i = 0; i < batch->count; i++)
        if (batch->resume_at[i] <= at)
            batch->selection[batch->selected_count++] = (uint8_t)i;
        else if (batch->resume_at[i] < batch->reconverge_at)
            batch->reconverge_at = batch->resume_at[i];
}

static void run_jump(LoopBatch *batch, const Instr *instr) {
    bool continues[BATCH_SIZE];
    for (uint32_t k = 0; instr->op != OP_JUMP && k < batch->selected_count; k++) {
        Value test = column_read(batch, instr->a, batch->selection[k]);
        continues[k] = vm_is_true(&test) == (instr->op == OP_JUMP_FALSE);
    }
    deselect_iterations(batch, instr->target, instr->op == OP_JUMP ? NULL : continues);
}

// --- yielded values

static void store_yields(LoopBatch *batch, const Instr *instr) {
    const Column *column = column_of(batch, instr->a);
    const Value same = column ? VALUE_NULL : batch->frame->slots[instr->a];
    for (uint32_t k = 0; k < batch->selected_count; k++) {
        uint32_t iteration = batch->selection[k];
        Value *yield = &batch->yields[iteration * batch->plan->yield_count + batch->yield_counts[iteration]++];
        *yield = column ? column_value(column, iteration) : same;
    }
}

// Executes YIELD_NODE, the last instruction of the body, for all iterations.
static void yield_nodes(LoopBatch *batch, const Instr *instr, Loop *loop) {
    int32_t reads[CODE_MAX_READ];
    uint32_t count = program_operands_read(batch->frame->operands, instr, reads);
    Value *slots = batch->frame->slots;
    Instr row = *instr;
    row.d = 0; // do not free temporary data before all iterations have been added
    ArenaMark before = loop->mark;
    const NodeBatch *nodes = loop->batch;
    for (uint32_t iteration = 0; iteration < batch->count; iteration++) {
        for (uint32_t i = 0; i < count; i++)
            if (column_of(batch, reads[i]))
                slots[reads[i]] = column_read(batch, reads[i], iteration);
        vm_yield_node(batch->vm, batch->frame, &row);
    }
    if (instr->d && nodes && nodes == loop->batch && batch->vm->reported_count == loop->reported)
        arena_rewind(batch->vm->arena, before);
}

static void append_yields(LoopBatch *batch, Loop *loop) {
    const Instr *last = &batch->code->instrs[batch->plan->end - 1];
    for (uint32_t i = 0; i < batch->count; i++)
        for (uint32_t k = 0; k < batch->yield_counts[i]; k++)
            vector_add_part(&loop->result, &batch->yields[i * batch->plan->yield_count + k]);
    if (last->op == OP_YIELD_NODE)
        yield_nodes(batch, last, loop);
}

// --- batches

static void run_body(LoopBatch *batch, uint32_t at) {
    for (; at < batch->plan->end && !batch->vm->speculation_failed; at++) {
        if (at == batch->reconverge_at)
            select_iterations(batch, at);
        const Instr *instr = &batch->code->instrs[at];
        if (batch->selected_count == 0)
            continue;
        switch (program_batch_kinds[instr->op]) {
        case BATCH_JUMP:
            run_jump(batch, instr);
            break;
        case BATCH_YIELD:
            store_yields(batch, instr);
            break;
        case BATCH_MOVE:
            vm_batch_move(batch, instr);
            break;
        case BATCH_UNPACK:
            vm_batch_unpack(batch, instr);
            break;
        case BATCH_PURE:
        case BATCH_DISTINCT:
            vm_batch_call(batch, instr);
            break;
        case BATCH_NEVER:
        case BATCH_LAST: // executed by append_yields
            break;
        }
    }
}

// Executes one batch. Returns false if an iteration would report an error. The caller then executes the iterations one
// by one.
static bool run_batch(LoopBatch *batch, const Instr *start, Loop *loop) {
    Vm *vm = batch->vm;
    uint32_t first = (uint32_t)(start - batch->code->instrs) + 1;
    // Charged at the position of the body's first instruction, because iteration-by-iteration execution charges most
    // work there.
    vm_charge(vm, batch->code->instrs[first].at,
              batch->count * (1 + (uint64_t)(batch->plan->end - first) / VM_INSTRS_A_UNIT));
    for (uint32_t i = 0; i < batch->plan->column_count; i++)
        batch->columns[i].kind = COLUMN_NONE;
    memset(batch->resume_at, 0, sizeof batch->resume_at);
    memset(batch->yield_counts, 0, sizeof batch->yield_counts);
    select_iterations(batch, first);
    vm->speculative = true;
    vm->speculation_failed = false;
    bind_iterations(batch, start, loop);
    run_body(batch, first);
    vm->speculative = false;
    if (vm->speculation_failed)
        return false;
    vm->batched_iterations += batch->count;
    append_yields(batch, loop);
    return true;
}

void vm_run_batches(Vm *vm, Frame *frame, const Code *code, const Instr *start, Loop *loop,
                    VmFunction *const functions[OP_COUNT]) {
    const BatchPlan *plan = start->as.batch_plan;
    uint32_t iterations = loop->source.kind == VALUE_STREAM ? 0 : (loop->source.len - loop->at) / start->count;
    if (iterations < MIN_BATCH || vm->no_batches || vm->profile) // the profile counts each iteration
        return;
    ArenaMark mark = arena_mark(&vm->slots);
    LoopBatch *batch = arena_alloc(&vm->slots, sizeof *batch);
    batch->vm = vm;
    batch->frame = frame;
    batch->code = code;
    batch->plan = plan;
    batch->functions = functions;
    batch->columns = arena_alloc(&vm->slots, plan->column_count * sizeof(Column));
    batch->yields = arena_alloc(&vm->slots, (size_t)plan->yield_count * BATCH_SIZE * sizeof(Value));
    loop->retry_at = 0;
    while (iterations > 0 && !loop->result.overflow) {
        batch->count = iterations < BATCH_SIZE ? iterations : BATCH_SIZE;
        iterations -= batch->count;
        if (!run_batch(batch, start, loop)) {
            loop->retry_at = loop->failed_batches++ < MAX_FAILURES ? loop->at + batch->count * start->count : 0;
            break;
        }
        loop->at += batch->count * start->count;
    }
    arena_rewind(&vm->slots, mark);
}
