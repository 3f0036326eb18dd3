// operators.c: instructions that read names, compute operators, or take the element of a loop; see machine.h.
//
// An instruction sets Vm.at before it calls a function that can exceed the budget, because the host reports that
// position.
#include "vm/machine.h"

static Value truth(bool x) {
    return value_number(x ? 1 : 0);
}

Value vm_capture(Vm *vm, const Frame *frame, const Instr *instr) {
    (void)vm;
    return frame->closure->captures[instr->target];
}

Value vm_self(Vm *vm, const Frame *frame, const Instr *instr) {
    (void)vm, (void)instr;
    return frame->closure->self;
}

Value vm_global(Vm *vm, const Frame *frame, const Instr *instr) {
    (void)frame;
    vm->met_dynamic |= instr->a;
    return vm->globals[instr->target];
}

Value vm_unbound(Vm *vm, const Frame *frame, const Instr *instr) {
    (void)frame;
    Str name = instr->as.name->name;
    vm_report(vm, instr->at, "unbound-name", "unbound name '%.*s' is null", STR_ARGS(name));
    return VALUE_NULL;
}

Value vm_xor(Vm *vm, const Frame *frame, const Instr *instr) {
    (void)vm;
    const Value *a = &frame->slots[instr->a], *b = &frame->slots[instr->b];
    return !vm_is_true(a) ? *b : vm_is_true(b) ? value_number(0) : *a;
}

Value vm_not(Vm *vm, const Frame *frame, const Instr *instr) {
    (void)vm;
    return truth(!vm_is_true(&frame->slots[instr->a]));
}

// Returns null for a stream, because != treats streams as null (L5.4).
static Value stream_as_null(Value v) {
    return v.kind == VALUE_STREAM ? VALUE_NULL : v;
}

Value vm_equal(Vm *vm, const Frame *frame, const Instr *instr) {
    Value a = frame->slots[instr->a], b = frame->slots[instr->b];
    vm->at = instr->at;
    return truth(instr->op == OP_EQ ? value_equal(vm->arena, a, b)
                                    : !value_equal(vm->arena, stream_as_null(a), stream_as_null(b)));
}

Value vm_order(Vm *vm, const Frame *frame, const Instr *instr) {
    vm->at = instr->at;
    int order = value_compare(vm->arena, frame->slots[instr->a], frame->slots[instr->b]);
    bool holds = instr->op == OP_LT   ? order == -1
                 : instr->op == OP_GT ? order == 1
                 : instr->op == OP_LE ? order != 1
                                      : order != -1;
    return order == VALUE_INCOMPARABLE ? VALUE_NULL : truth(holds);
}

Value vm_in(Vm *vm, const Frame *frame, const Instr *instr) {
    vm->at = instr->at;
    return truth(value_contains(vm->arena, frame->slots[instr->a], frame->slots[instr->b]));
}

Value vm_arith(Vm *vm, const Frame *frame, const Instr *instr) {
    _Static_assert(OP_POW - OP_ADD == (int)ARITH_POW, "opcodes in the order of ArithOp");
    vm->at = instr->at;
    return op_arith(vm->arena, (ArithOp)(instr->op - OP_ADD), frame->slots[instr->a], frame->slots[instr->b]);
}

Value vm_negate(Vm *vm, const Frame *frame, const Instr *instr) {
    vm->at = instr->at;
    return op_negate(vm->arena, frame->slots[instr->a]);
}

Value vm_plus(Vm *vm, const Frame *frame, const Instr *instr) {
    (void)vm;
    return op_plus(frame->slots[instr->a]);
}

Value vm_index(Vm *vm, const Frame *frame, const Instr *instr) {
    const Value *vector = &frame->slots[instr->a], *index = &frame->slots[instr->b];
    if (is_number(index) && vector->kind == VALUE_NUMBERS && index->as.number >= 0 && index->as.number < vector->len)
        return value_number(value_numbers(vector)[(uint32_t)index->as.number]);
    vm->at = instr->at;
    return vm_index_value(vm, *vector, *index);
}

Value vm_loop_element(const Loop *loop, uint32_t i) {
    return i >= loop->source.len               ? VALUE_NULL
           : loop->source.kind == VALUE_ABSENT ? value_number(op_range_number(&loop->span, i))
                                               : value_element(loop->source, i);
}
