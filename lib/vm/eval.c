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

static inline bool is_true(const Value *v) {
    return is_number(v) ? v->as.number != 0 : value_true(*v);
}

bool vm_is_true(const Value *v) {
    return is_true(v);
}

// Returns null for a stream, because != treats streams as null (L5.4).
static Value stream_as_null(Value v) {
    return v.kind == VALUE_STREAM ? VALUE_NULL : v;
}

NOINLINE static Value compare(Vm *vm, const Instr *instr, Value a, Value b) {
    vm->at = instr->at;
    if (instr->op == OP_EQ)
        return truth(value_equal(vm->arena, a, b));
    if (instr->op == OP_NE)
        return truth(!value_equal(vm->arena, stream_as_null(a), stream_as_null(b)));
    int order = instr->c ? 0 : value_compare(vm->arena, a, b);
    if (order == VALUE_INCOMPARABLE)
        return VALUE_NULL;
    switch (instr->op) {
    case OP_LT:
        return truth(order == -1);
    case OP_GT:
        return truth(order == 1);
    case OP_LE:
        return truth(order != 1);
    default:
        return truth(order != -1);
    }
}

Value vm_unpack_element(Vm *vm, Value value, uint32_t i) {
    return value.kind == VALUE_STREAM ? value_number(value_stream_item(value, i)) : value_element(vm->arena, value, i);
}

NOINLINE static void unpack_value(Vm *vm, Value *slots, uint32_t count, Value value) {
    for (uint32_t i = 0; i < count; i++)
        slots[i] = vm_unpack_element(vm, value, i);
}

Value vm_loop_element(Vm *vm, const Loop *loop, uint32_t i) {
    return i >= loop->source.len               ? VALUE_NULL
           : loop->source.kind == VALUE_ABSENT ? value_number(op_range_number(&loop->span, i))
                                               : value_element(vm->arena, loop->source, i);
}

// Binds the loop's names, in slots[0] to slots[count - 1], to the elements of one iteration (L10.1). Names for which no
// element is left are null.
NOINLINE static void bind_elements(Vm *vm, const Loop *loop, Value *slots, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        slots[i] = vm_loop_element(vm, loop, loop->at + i);
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
        bind_elements(vm, loop, slots + instr->d, instr->count);
    return true;
}

NOINLINE static Value arithmetic(Vm *vm, const Instr *instr, ArithOp op, Value a, Value b) {
    vm->at = instr->at;
    return op_arith(vm->arena, op, a, b);
}

enum { MAX_STACK_ARGUMENTS = 8 };

// Returns the values of a list of operands as an array. The array is `buffer` if they fit in it.
static const Value *gather_operands(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr,
                                    Value *buffer) {
    Value *values =
        instr->count <= MAX_STACK_ARGUMENTS ? buffer : arena_alloc_array(vm->arena, instr->count, sizeof *values);
    for (uint32_t i = 0; i < instr->count; i++)
        values[i] = slots[list[i]];
    return values;
}

NOINLINE static Value eval_call(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr) {
    Value buffer[MAX_STACK_ARGUMENTS];
    const Value *values = gather_operands(vm, list, slots, instr, buffer);
    return vm_call(vm, instr, slots[instr->b], values);
}

NOINLINE Value vm_call_builtin(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr) {
    Value buffer[MAX_STACK_ARGUMENTS];
    const Value *values = gather_operands(vm, list, slots, instr, buffer);
    if (!vm_can_call(vm, instr->as.builtin, instr->at, values, instr->count))
        return VALUE_NULL;
    vm->builtins.called = instr->as.builtin;
    return instr->as.builtin->call(&vm->builtins, values, instr->count);
}

NOINLINE static Value make_closure(Vm *vm, const int32_t *list, const Frame *frame, const Instr *instr) {
    Value *defaults = arena_alloc_array(vm->arena, instr->count, sizeof *defaults);
    for (uint32_t i = 0; i < instr->count; i++)
        defaults[i] = frame->slots[list[i]];
    return vm_make_closure(vm, frame, instr->as.function, defaults);
}

NOINLINE static Value report_unbound(Vm *vm, const Instr *instr) {
    Str name = instr->as.name->name;
    vm_fault(vm, instr->at, "unbound-name", "unbound name '%.*s' is null", STR_ARGS(name));
    return VALUE_NULL;
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

// An operation on two numbers is executed inline. Other operands are passed to the function `arithmetic`.
#define ARITHMETIC(opcode, arith, operator)                                                                            \
    case opcode: {                                                                                                     \
        const Value *a = &A, *b = &B;                                                                                  \
        if (is_number(a) && is_number(b))                                                                              \
            vm_set_number(&D, a->as.number operator b->as.number);                                                     \
        else                                                                                                           \
            D = arithmetic(vm, instr, arith, *a, *b);                                                                  \
        break;                                                                                                         \
    }

// `claim` is an expression that compares the numbers x and y. If one of them is NaN, > and >= are true (L5.5).
#define COMPARISON(opcode, claim)                                                                                      \
    case opcode: {                                                                                                     \
        const Value *a = &A, *b = &B;                                                                                  \
        if (is_number(a) && is_number(b) && !instr->c) {                                                               \
            double x = a->as.number, y = b->as.number;                                                                 \
            D = truth(claim);                                                                                          \
        } else {                                                                                                       \
            D = compare(vm, instr, *a, *b);                                                                            \
        }                                                                                                              \
        break;                                                                                                         \
    }

// The instruction loop. It is compiled twice, with and without profiling, so that profiling costs nothing when it is
// off.
static inline __attribute__((always_inline)) Value eval_code(Vm *vm, Frame *frame, const Code *code,
                                                             const bool profiled) {
    Value *const slots = frame->slots;
    const Instr *instr = code->instrs;
    ProfilePosition place = {0};
    for (;; instr++) {
        if (profiled)
            vm_profile_at(vm->profile, instr->at->source, code->lines[instr - code->instrs]);
        switch ((Opcode)instr->op) {
        case OP_MOVE:
            D = A;
            break;
        case OP_CAPTURE:
            D = frame->closure->captures[instr->target];
            break;
        case OP_SELF:
            D = frame->closure->self;
            break;
        case OP_GLOBAL:
            vm->met_dynamic |= instr->a;
            D = vm->globals[instr->target];
            break;
        case OP_UNBOUND:
            D = report_unbound(vm, instr);
            break;
        case OP_COMPOSE:
            D = vm_compose(vm, code->operands + instr->list, slots, instr, instr->at);
            break;
        case OP_UNPACK:
            unpack_value(vm, &D, instr->count, A);
            break;
        case OP_CLOSURE:
            D = make_closure(vm, code->operands + instr->list, frame, instr);
            break;
        case OP_IMPORT:
            place = profiled ? vm->profile->position : place;
            eval_import(vm, frame, instr, A);
            if (profiled)
                vm_profile_return(vm->profile, place);
            break;
        case OP_FOR: {
            Loop *loop = &frame->loops[instr->loop];
            *loop = (Loop){.source = A, .result = vector_new(vm->arena)};
            if (instr->as.batch_plan && !profiled)
                vm_run_batches(vm, frame, code, instr, loop);
            if (!next_iteration(vm, instr, loop, slots, 1))
                instr = code->instrs + instr->target - 1;
            break;
        }
        case OP_RANGE_INIT:
            vm_range_init(vm, instr->at, &frame->loops[instr->loop], A, B, C);
            break;
        case OP_FOR_RANGE:
            if (instr->as.batch_plan && !profiled)
                vm_run_batches(vm, frame, code, instr, &frame->loops[instr->loop]);
            if (!next_iteration(vm, instr, &frame->loops[instr->loop], slots, 1))
                instr = code->instrs + instr->target - 1;
            break;
        case OP_YIELD:
            vector_add_part(&frame->loops[instr->loop].result, &A);
            break;
        case OP_YIELD_NODE:
            vm_yield_node(vm, code->operands + instr->list, slots, instr, &frame->loops[instr->loop]);
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
            if (is_true(&A))
                instr = code->instrs + instr->target - 1;
            break;
        case OP_JUMP_FALSE:
            if (!is_true(&A))
                instr = code->instrs + instr->target - 1;
            break;
        case OP_NODE:
            D = vm_make_node(vm, code->operands + instr->list, slots, instr);
            break;
        case OP_APPEND:
            D = vm_append(vm, instr, A, instr->b == CODE_NO_OPERAND ? VALUE_NULL : B);
            break;
        case OP_DECORATE:
            D = vm_decorate(vm, code->operands + instr->list, slots, instr);
            break;
        case OP_CALL:
            place = profiled ? vm->profile->position : place;
            D = eval_call(vm, code->operands + instr->list, slots, instr);
            if (profiled)
                vm_profile_return(vm->profile, place);
            break;
        case OP_BUILTIN:
            D = vm_call_builtin(vm, code->operands + instr->list, slots, instr);
            break;
        case OP_XOR:
            D = !is_true(&A) ? B : is_true(&B) ? value_number(0) : A;
            break;
        case OP_NOT:
            D = truth(!is_true(&A));
            break;
            COMPARISON(OP_EQ, x == y)
            COMPARISON(OP_NE, x != y)
            COMPARISON(OP_LT, x < y)
            COMPARISON(OP_GT, !(x <= y))
            COMPARISON(OP_LE, x <= y)
            COMPARISON(OP_GE, !(x < y))
        case OP_IN:
            vm->at = instr->at;
            D = truth(value_contains(vm->arena, A, B));
            break;
        case OP_RANGE:
            vm->at = instr->at;
            D = vm_range(vm, instr->at, A, B, C);
            break;
            ARITHMETIC(OP_ADD, ARITH_ADD, +)
            ARITHMETIC(OP_SUB, ARITH_SUB, -)
            ARITHMETIC(OP_MUL, ARITH_MUL, *)
            ARITHMETIC(OP_DIV, ARITH_DIV, /)
        case OP_FLOORDIV:
            D = arithmetic(vm, instr, ARITH_FLOORDIV, A, B);
            break;
        case OP_MOD:
            D = arithmetic(vm, instr, ARITH_MOD, A, B);
            break;
        case OP_POW:
            D = arithmetic(vm, instr, ARITH_POW, A, B);
            break;
        case OP_NEG:
            vm->at = instr->at;
            D = op_negate(vm->arena, A);
            break;
        case OP_POS:
            D = op_plus(A);
            break;
        case OP_INDEX: {
            const Value *vector = &A, *index = &B;
            if (is_number(index) && vector->kind == VALUE_NUMBERS && index->as.number >= 0 &&
                index->as.number < vector->len)
                vm_set_number(&D, value_numbers(vector)[(uint32_t)index->as.number]);
            else
                vm->at = instr->at, D = vm_index(vm, *vector, *index);
            break;
        }
        case OP_SLICE:
            D = vm_slice(vm, instr->as.inner_origin, A, B, C);
            break;
        case OP_LOOKUP:
            D = vm_lookup(vm, code->operands + instr->list, slots, instr);
            break;
        case OP_RETURN:
            return A;
        default:
            __builtin_unreachable();
        }
    }
}

NOINLINE static Value eval_profiled(Vm *vm, Frame *frame, const Code *code) {
    return eval_code(vm, frame, code, true);
}

Value vm_eval(Vm *vm, Frame *frame, const Code *code) {
    if (vm->profile && code->lines)
        return eval_profiled(vm, frame, code);
    return eval_code(vm, frame, code, false);
}
