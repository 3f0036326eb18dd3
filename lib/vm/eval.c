// eval.c: the instruction loop of the VM; see vm.h, and program/code.h for the instructions.
//
// The most frequent cases are inlined. Long or rare cases are separate functions, so that the loop needs few processor
// registers.
#include "vm/machine.h"

#define NOINLINE __attribute__((noinline))

// --- loops and imports

NOINLINE static void unpack_value(Value *slots, uint32_t count, Value value) {
    for (uint32_t i = 0; i < count; i++)
        slots[i] = value_element(value, i);
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

// The functions that compute an instruction's value. Batches execute an instruction with them once per iteration if
// they have no faster way; they get the table from here, so that they do not call this file.
static VmFunction *const functions[OP_COUNT] = {
#define OPCODE(id, name, operands, batch)
#define FUNCTION(id, name, operands, batch, function) [OP_##id] = vm_##function,
#include "program/opcode_list.h"
};

#define OPCODE(id, name, operands, batch) _Static_assert(BATCH_##batch < BATCH_PURE, name " needs a function");
#define FUNCTION(id, name, operands, batch, function)
#include "program/opcode_list.h"

NOINLINE static void run_batches(Vm *vm, Frame *frame, const Code *code, const Instr *start, Loop *loop) {
    vm_run_batches(vm, frame, code, start, loop, functions);
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
                run_batches(vm, frame, code, instr, loop);
            if (!next_iteration(vm, instr, loop, slots, 1))
                instr = code->instrs + instr->target - 1;
            break;
        }
        case OP_RANGE_INIT:
            vm_range_init(vm, instr->at, &frame->loops[instr->loop], A, B, C);
            break;
        case OP_FOR_RANGE:
            if (instr->as.batch_plan)
                run_batches(vm, frame, code, instr, &frame->loops[instr->loop]);
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
                run_batches(vm, frame, code, code->instrs + instr->target - 1, loop);
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
