// batch_nodes.c: loops that create one node per iteration, stored as node batches (value/node_batch.h).
#include "vm/machine.h"

enum {
    MIN_NODE_BATCH = 16,   // minimum number of remaining iterations for which a batch is started
    MIN_ROWS = 8,          // a batch with fewer rows is short
    MAX_SHORT_BATCHES = 4, // after this number of short batches, a loop creates only single nodes
};

// Sets *numbers to the way in which a batch stores an attribute with this value (NodeBatch.numbers). Returns false if a
// batch cannot store the attribute.
static bool choose_column(const Loop *loop, const Instr *instr, int32_t operand, const Value *value,
                          uint32_t *numbers) {
    if (operand < 0) {
        *numbers = NODE_BATCH_UNIFORM;
        return value->kind != VALUE_MIXED || value_height(*value) == 0;
    }
    *numbers = (uint32_t)operand == instr->target && !loop->not_counting ? NODE_BATCH_COUNTING : value->len;
    return value->kind == VALUE_NUMBERS && value->len > 0 && value->len <= NODE_BATCH_MAX_NUMBERS;
}

// Starts a batch whose first node is the node of the current iteration. Returns NULL if this node should be created
// alone.
static NodeBatch *begin_batch(Vm *vm, const Frame *frame, const Instr *instr, const Loop *loop) {
    const int32_t *list = frame->operands + instr->list;
    uint32_t iterations = loop->source.len - loop->at, numbers[NODE_BATCH_MAX_ATTRS] = {0}, count = 0;
    int32_t from[NODE_BATCH_MAX_ATTRS];
    Attr attrs[NODE_BATCH_MAX_ATTRS] = {{0}};
    if (iterations < MIN_NODE_BATCH || loop->short_batches >= MAX_SHORT_BATCHES || vm->no_batches)
        return NULL;
    for (uint32_t i = 0; i < instr->count; i++) {
        const Value *value = &frame->slots[list[i]];
        if (list[i] < 0 && value->len == 0)
            continue; // null and streams are omitted (L7.2)
        if (!choose_column(loop, instr, list[i], value, &numbers[count]))
            return NULL;
        from[count] = list[i];
        attrs[count++] = (Attr){instr->as.node->names[i], *value};
    }
    vm_charge(vm, instr->at, 1 + instr->count / 4);
    NodeBatch *batch = node_batch_new(vm->arena, instr->as.node->base, attrs, numbers, count, iterations);
    for (uint32_t i = 0; i < count; i++)
        batch->from[i] = from[i];
    return batch;
}

// Called when the next node cannot be added to the current batch, or when there is no batch. If the batch is not full,
// notes in the loop why the next batches may also end early.
static void end_batch(Loop *loop) {
    NodeBatch *batch = loop->batch;
    if (!batch || batch->count == batch->capacity)
        return;
    if (batch->count == 1 && !loop->not_counting)
        loop->not_counting = true; // this is probably why the second node could not be added
    else
        loop->short_batches += batch->count < MIN_ROWS;
}

void vm_yield_node(Vm *vm, const Frame *frame, const Instr *instr) {
    Loop *loop = &frame->loops[instr->loop];
    if (loop->batch && loop->batch->count < loop->batch->capacity) {
        vm_charge(vm, instr->at, 1 + instr->count / 4);
        if (node_batch_add(loop->batch, frame->slots)) {
            // Free the temporary data of the iteration, unless a reported error may refer to it.
            if (instr->d && vm->reported_count == loop->reported)
                arena_rewind(vm->arena, loop->mark);
            return;
        }
    }
    end_batch(loop);
    loop->batch = begin_batch(vm, frame, instr, loop);
    vector_add(&loop->result,
               loop->batch ? (Value){.len = 1,
                                     .kind = VALUE_MIXED,
                                     .as.items = arena_copy(
                                         vm->arena, &(Item){ITEM_NODE, .as.node = &loop->batch->node}, sizeof(Item))}
                           : vm_node(vm, frame, instr));
    loop->mark = arena_mark(vm->arena);
    loop->reported = vm->reported_count;
}
