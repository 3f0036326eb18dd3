// rows.c: loops whose rounds make one node each, kept as runs (value/run.h); see machine.h.
#include "vm/machine.h"

enum {
    FEWEST_ROUNDS = 16, // that are worth a run
    FEWEST_ROWS = 8,    // a run of fewer came to little
    MOST_TRIES = 4,
};

// How a run keeps an attribute; false if it cannot.
static bool choose_column(const Loop *loop, const Instr *instr, int32_t operand, const Value *value,
                          uint32_t *numbers) {
    if (operand < 0) {
        *numbers = NODE_RUN_COMMON;
        return value->kind != VALUE_MIXED || value_height(*value) == 0;
    }
    *numbers = (uint32_t)operand == instr->target && !loop->counts_otherwise ? NODE_RUN_COUNTS : value->len;
    return value->kind == VALUE_NUMBERS && value->len > 0 && value->len <= NODE_RUN_NUMBERS;
}

// A run that begins with this node; NULL if there is to be none.
static NodeRun *begin_run(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, const Loop *loop) {
    uint32_t rounds = loop->source.len - loop->at, numbers[NODE_RUN_ATTRS] = {0}, count = 0;
    int32_t from[NODE_RUN_ATTRS];
    Attr attrs[NODE_RUN_ATTRS] = {{0}};
    if (rounds < FEWEST_ROUNDS || loop->tries >= MOST_TRIES)
        return NULL;
    for (uint32_t i = 0; i < instr->count; i++) {
        const Value *value = &slots[list[i]];
        if (list[i] < 0 && value->len == 0)
            continue; // null and streams are left out (L7.2)
        if (!choose_column(loop, instr, list[i], value, &numbers[count]))
            return NULL;
        from[count] = list[i];
        attrs[count++] = (Attr){instr->as.node->names[i], *value};
    }
    vm_work(vm, instr->at, 1 + instr->count / 4);
    NodeRun *run = node_run_new(vm->arena, instr->as.node->base, attrs, numbers, count, rounds);
    for (uint32_t i = 0; i < count; i++)
        run->from[i] = from[i];
    return run;
}

// Ends a run that the next node does not belong to.
static void end_run(Loop *loop) {
    NodeRun *run = loop->run;
    if (!run || run->count == run->capacity)
        return;
    if (run->count == 1 && !loop->counts_otherwise)
        loop->counts_otherwise = true; // which may be why
    else
        loop->tries += run->count < FEWEST_ROWS;
}

void vm_add_row(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, Loop *loop) {
    if (loop->run && loop->run->count < loop->run->capacity) {
        vm_work(vm, instr->at, 1 + instr->count / 4);
        if (node_run_add(loop->run, slots)) {
            // What the round has made besides is of no use to anybody, unless it was told as a fault.
            if (instr->d && vm->reported_count == loop->reported)
                arena_rewind(vm->arena, loop->mark);
            return;
        }
    }
    end_run(loop);
    loop->run = begin_run(vm, list, slots, instr, loop);
    vector_add(&loop->result,
               loop->run ? (Value){.len = 1,
                                   .kind = VALUE_MIXED,
                                   .as.items = arena_copy(vm->arena, &(Item){ITEM_NODE, .as.node = &loop->run->node},
                                                          sizeof(Item))}
                         : vm_make_node(vm, list, slots, instr));
    loop->mark = arena_mark(vm->arena);
    loop->reported = vm->reported_count;
}
