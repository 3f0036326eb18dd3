// rounds.c: many rounds of a loop at once; see machine.h and columns.h.
#include "vm/columns.h"

#include <string.h>

enum {
    FEWEST_ROUNDS = 8, // that are worth it
    MOST_FAILURES = 4, // of blocks, in a run of a loop
};

// The elements that the rounds bind.
static void bind_rounds(Block *block, const Instr *start, const Loop *loop) {
    Value values[COLUMN_ROUNDS];
    if (start->count == 1 && loop->source.kind == VALUE_ABSENT) {
        double numbers[COLUMN_ROUNDS];
        for (uint32_t k = 0; k < block->count; k++)
            numbers[k] = op_span_number(&loop->span, loop->at + k);
        vm_columns_store_numbers(block, start->d, numbers);
        return;
    }
    for (uint32_t i = 0; i < start->count; i++) {
        for (uint32_t k = 0; k < block->count; k++)
            values[k] = vm_loop_element(block->vm, loop, loop->at + k * start->count + i);
        vm_columns_store(block, start->d + (int32_t)i, values);
    }
}

// --- branches

// The active rounds for which `goes_on` is not set become inactive until instruction `target`.
static void deactivate(Block *block, uint32_t target, const bool *goes_on) {
    uint32_t stay = 0;
    for (uint32_t k = 0; k < block->active_count; k++) {
        uint8_t round = block->active[k];
        if (goes_on && goes_on[k])
            block->active[stay++] = round;
        else
            block->resume[round] = target;
    }
    if (stay < block->active_count && target < block->landing)
        block->landing = target;
    block->active_count = stay;
}

static void activate(Block *block, uint32_t at) {
    block->active_count = 0;
    block->landing = UINT32_MAX;
    for (uint32_t i = 0; i < block->count; i++)
        if (block->resume[i] <= at)
            block->active[block->active_count++] = (uint8_t)i;
        else if (block->resume[i] < block->landing)
            block->landing = block->resume[i];
}

static void jump(Block *block, const Instr *instr) {
    bool goes_on[COLUMN_ROUNDS];
    for (uint32_t k = 0; instr->op != OP_JUMP && k < block->active_count; k++) {
        Value test = column_read(block, instr->a, block->active[k]);
        goes_on[k] = vm_is_true(&test) == (instr->op == OP_JUMP_FALSE);
    }
    deactivate(block, instr->target, instr->op == OP_JUMP ? NULL : goes_on);
}

// --- parts

static void note_parts(Block *block, const Instr *instr) {
    const Column *column = column_of(block, instr->a);
    const Value same = column ? VALUE_NULL : block->frame->slots[instr->a];
    for (uint32_t k = 0; k < block->active_count; k++) {
        uint32_t round = block->active[k];
        Value *part = &block->parts[round * block->plan->part_count + block->part_counts[round]++];
        *part = column ? column_value(column, round) : same;
    }
}

// The row that each round ends with.
static void add_rows(Block *block, const Instr *instr, Loop *loop) {
    int32_t reads[CODE_MOST_READ];
    uint32_t count = program_reads(block->code->operands, instr, reads);
    Value *slots = block->frame->slots;
    Instr row = *instr;
    row.d = 0; // what the rounds have made stays until all are added
    ArenaMark before = loop->mark;
    const NodeRun *run = loop->run;
    for (uint32_t round = 0; round < block->count; round++) {
        for (uint32_t i = 0; i < count; i++)
            if (column_of(block, reads[i]))
                slots[reads[i]] = column_read(block, reads[i], round);
        vm_add_row(block->vm, block->code->operands + instr->list, slots, &row, loop);
    }
    if (instr->d && run && run == loop->run && block->vm->reported_count == loop->reported)
        arena_rewind(block->vm->arena, before);
}

static void add_parts(Block *block, Loop *loop) {
    const Instr *last = &block->code->instrs[block->plan->end - 1];
    for (uint32_t i = 0; i < block->count; i++)
        for (uint32_t k = 0; k < block->part_counts[i]; k++)
            vector_add_part(&loop->result, &block->parts[i * block->plan->part_count + k]);
    if (last->op == OP_ADD_ROW)
        add_rows(block, last, loop);
}

// --- blocks

static void run_body(Block *block, uint32_t at) {
    for (; at < block->plan->end && !block->vm->failed; at++) {
        if (at == block->landing)
            activate(block, at);
        const Instr *instr = &block->code->instrs[at];
        if (block->active_count == 0)
            continue;
        if (instr->op == OP_JUMP || instr->op == OP_JUMP_TRUE || instr->op == OP_JUMP_FALSE)
            jump(block, instr);
        else if (instr->op == OP_ADD_PART)
            note_parts(block, instr);
        else if (instr->op != OP_ADD_ROW)
            vm_columns_run(block, instr);
    }
}

// False if a round has a fault to report: then they must be run one by one.
static bool run_block(Block *block, const Instr *start, Loop *loop) {
    Vm *vm = block->vm;
    uint32_t first = (uint32_t)(start - block->code->instrs) + 1;
    // One by one most of the work is charged in the body: that is what a limit should point at.
    vm_work(vm, block->code->instrs[first].at,
            block->count * (1 + (uint64_t)(block->plan->end - first) / VM_INSTRS_A_UNIT));
    for (uint32_t i = 0; i < block->plan->column_count; i++)
        block->columns[i].kind = COLUMN_NONE;
    memset(block->resume, 0, sizeof block->resume);
    memset(block->part_counts, 0, sizeof block->part_counts);
    activate(block, first);
    vm->trying = true;
    vm->failed = false;
    bind_rounds(block, start, loop);
    run_body(block, first);
    vm->trying = false;
    if (vm->failed)
        return false;
    vm->rounds += block->count;
    add_parts(block, loop);
    return true;
}

void vm_rounds(Vm *vm, Frame *frame, const Code *code, const Instr *start, Loop *loop) {
    const RoundsCode *plan = start->as.rounds;
    uint32_t rounds = loop->source.kind == VALUE_STREAM ? 0 : (loop->source.len - loop->at) / start->count;
    if (rounds < FEWEST_ROUNDS)
        return;
    ArenaMark mark = arena_mark(&vm->slots);
    Block *block = arena_alloc(&vm->slots, sizeof *block);
    block->vm = vm;
    block->frame = frame;
    block->code = code;
    block->plan = plan;
    block->columns = arena_alloc(&vm->slots, plan->column_count * sizeof(Column));
    block->parts = arena_alloc(&vm->slots, (size_t)plan->part_count * COLUMN_ROUNDS * sizeof(Value));
    loop->again = 0;
    while (rounds > 0 && !loop->result.overflow) {
        block->count = rounds < COLUMN_ROUNDS ? rounds : COLUMN_ROUNDS;
        rounds -= block->count;
        if (!run_block(block, start, loop)) {
            loop->again = loop->failures++ < MOST_FAILURES ? loop->at + block->count * start->count : 0;
            break;
        }
        loop->at += block->count * start->count;
    }
    arena_rewind(&vm->slots, mark);
}
