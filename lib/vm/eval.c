// eval.c: the instruction loop of the VM; see vm.h, and program/code.h for the instructions.
//
// The most frequent cases are inlined. Long or rare cases are separate functions, so that the loop needs few processor
// registers.
#include "value/value_hash.h"
#include "vm/machine.h"

#include <string.h>

#define NOINLINE __attribute__((noinline))

static Value truth(bool x) {
    return value_number(x ? 1 : 0);
}

// --- names and operators

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
    vm_fault(vm, instr->at, "unbound-name", "unbound name '%.*s' is null", STR_ARGS(name));
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

// --- loops and imports

NOINLINE static void unpack_value(Value *slots, uint32_t count, Value value) {
    for (uint32_t i = 0; i < count; i++)
        slots[i] = value_element(value, i);
}

Value vm_loop_element(const Loop *loop, uint32_t i) {
    return i >= loop->source.len               ? VALUE_NULL
           : loop->source.kind == VALUE_ABSENT ? value_number(op_range_number(&loop->span, i))
                                               : value_element(loop->source, i);
}

// Binds the loop's names, in slots[0] to slots[count - 1], to the elements of one iteration (L10.1). Names for which no
// element is left are null.
NOINLINE static void bind_elements(const Loop *loop, Value *slots, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        slots[i] = vm_loop_element(loop, loop->at + i);
}

// Starts the next iteration of a loop. Returns false if there is none.
static bool next_iteration(Vm *vm, const Instr *instr, const Loop *loop, Value *slots, uint64_t cost) {
    if (loop->at >= loop->source.len)
        return false;
    vm_charge(vm, instr->at, cost);
    if (instr->count == 1 && loop->source.kind == VALUE_ABSENT)
        vm_set_number(&slots[instr->d], op_range_number(&loop->span, loop->at));
    else if (instr->count == 1 && loop->source.kind == VALUE_NUMBERS)
        vm_set_number(&slots[instr->d], value_numbers(&loop->source)[loop->at]);
    else
        bind_elements(loop, slots + instr->d, instr->count);
    return true;
}

NOINLINE static void eval_import(Vm *vm, Frame *frame, const Instr *instr, Value file) {
    vm->met_dynamic = true;
    for (uint32_t i = 0; i < instr->count; i++)
        frame->slots[(uint32_t)instr->d + i] = VALUE_NULL;
    if (!vm->is_static) // while folding: continue with null, because the result will be discarded
        vm_import(vm, frame, instr, file);
}

#define A slots[instr->a]
#define B slots[instr->b]
#define C slots[instr->c]
#define D slots[instr->d]

// The instruction loop. It is compiled twice, with and without profiling, so that profiling costs nothing when it is
// off.
static inline __attribute__((always_inline)) Value eval_code(Vm *vm, Frame *frame, const Code *code,
                                                             const bool profiled) {
    Value *const slots = frame->slots;
    const Instr *instr = code->instrs;
    for (;; instr++) {
        if (profiled)
            vm_profile_at(vm->profile, instr->at->source, code->lines[instr - code->instrs]);
        if (instr->op >= OP_COUNT) // tells the compiler that the switch needs no range check
            __builtin_unreachable();
        switch ((Opcode)instr->op) {
#define OPCODE(id, name, operands, batch)
#define FUNCTION(id, name, operands, batch, function)                                                                  \
    case OP_##id:                                                                                                      \
        D = vm_##function(vm, frame, instr);                                                                           \
        break;
#define NUMBERS(id, name, operands, formula, function)                                                                 \
    case OP_##id: {                                                                                                    \
        const Value *a = &A, *b = &B;                                                                                  \
        if (is_number(a) && is_number(b)) {                                                                            \
            const double x = a->as.number, y = b->as.number;                                                           \
            (void)y;                                                                                                   \
            vm_set_number(&D, formula);                                                                                \
        } else {                                                                                                       \
            D = vm_##function(vm, frame, instr);                                                                       \
        }                                                                                                              \
        break;                                                                                                         \
    }
#include "program/opcode_list.h"
        case OP_MOVE:
            D = A;
            break;
        case OP_UNPACK:
            unpack_value(&D, instr->count, A);
            break;
        case OP_IMPORT:
            eval_import(vm, frame, instr, A);
            break;
        case OP_FOR: {
            Loop *loop = &frame->loops[instr->loop];
            *loop = (Loop){.source = A, .result = vector_new(vm->arena)};
            if (instr->as.batch_plan)
                vm_run_batches(vm, frame, code, instr, loop);
            if (!next_iteration(vm, instr, loop, slots, 1))
                instr = code->instrs + instr->target - 1;
            break;
        }
        case OP_RANGE_INIT:
            vm_range_init(vm, instr->at, &frame->loops[instr->loop], A, B, C);
            break;
        case OP_FOR_RANGE:
            if (instr->as.batch_plan)
                vm_run_batches(vm, frame, code, instr, &frame->loops[instr->loop]);
            if (!next_iteration(vm, instr, &frame->loops[instr->loop], slots, 1))
                instr = code->instrs + instr->target - 1;
            break;
        case OP_YIELD:
            vector_add_part(&frame->loops[instr->loop].result, &A);
            break;
        case OP_YIELD_NODE:
            vm_yield_node(vm, frame, instr);
            break;
        case OP_NEXT: {
            Loop *loop = &frame->loops[instr->loop];
            loop->at += instr->count;
            if (loop->at == loop->retry_at)
                vm_run_batches(vm, frame, code, code->instrs + instr->target - 1, loop);
            // Work units of executing the body once.
            uint64_t cost = 1 + (uint64_t)(instr - code->instrs - instr->target) / VM_INSTRS_A_UNIT;
            if (!loop->result.overflow && next_iteration(vm, instr, loop, slots, cost))
                instr = code->instrs + instr->target - 1;
            break;
        }
        case OP_END_LOOP:
            D = vm_finish(vm, instr->at, &frame->loops[instr->loop].result);
            break;
        case OP_JUMP:
            instr = code->instrs + instr->target - 1;
            break;
        case OP_JUMP_TRUE:
            if (vm_is_true(&A))
                instr = code->instrs + instr->target - 1;
            break;
        case OP_JUMP_FALSE:
            if (!vm_is_true(&A))
                instr = code->instrs + instr->target - 1;
            break;
        case OP_RETURN:
            return A;
        case OP_COUNT:
            __builtin_unreachable();
        }
    }
}

NOINLINE static Value eval_profiled(Vm *vm, Frame *frame, const Code *code) {
    ProfilePosition caller = vm->profile->position;
    Value result = eval_code(vm, frame, code, true);
    vm_profile_return(vm->profile, caller);
    return result;
}

Value vm_eval(Vm *vm, Frame *frame, const Code *code) {
    if (vm->profile && code->lines)
        return eval_profiled(vm, frame, code);
    return eval_code(vm, frame, code, false);
}
