// machine.h: internal declarations of the virtual machine.
#ifndef PETRI_VM_MACHINE_H
#define PETRI_VM_MACHINE_H

#include "program/code.h"
#include "value/node_batch.h"
#include "value/ops.h"
#include "vm/vm.h"

#include <string.h>

// A user function as a value: its code and captured values. Lives until the arena of the frame is reset, or as long as
// the program if it was folded at load time.
typedef struct Closure {
    Function base; // first member, so that a Function pointer can be cast to Closure
    const FunctionCode *code;
    const Value *captures;
    const Value *defaults;
    uint32_t active_calls; // number of calls that have not returned, in evaluation `evaluation_id`
    uint64_t evaluation_id;
    Value self; // a vector with this function as its only element
} Closure;

// A node and an item that refers to it. The item is the only element of the vector that is the node's value.
typedef struct NodeValue {
    Node node;
    Item item;
} NodeValue;

// State of a running loop.
typedef struct Loop {
    Value source; // vector that is iterated over; VALUE_ABSENT: the range `span`, whose length is source.len
    OpRange span;
    uint32_t at; // index of the next element
    Vector result;
    // batch_nodes.c
    NodeBatch *batch;       // node batch to which the next node can be added; NULL: none
    uint32_t short_batches; // number of node batches with few rows
    bool not_counting;      // the values of the loop's name do not increase by 1 from node to node
    ArenaMark mark;         // end of Vm.arena after the last node
    uint32_t reported;      // Vm.reported_count when `mark` was set
    // batch.c
    uint32_t retry_at;       // value of `at` at which batches are tried again; 0: never
    uint32_t failed_batches; // number of batches of iterations that had to be executed one by one
} Loop;

// Activation record of a code.
typedef struct Frame {
    Value *slots;     // registers; the constants are stored directly before them
    Loop *loops;      // one per nesting depth
    Closure *closure; // NULL in the main program and in modules
} Frame;

// A program that is being evaluated: the main program or a module.
struct ImportLink {
    const ImportLink *outer;
    const Source *source;
    uint32_t depth; // 0: the main program
};

// Allocates a frame for a code. Its slots are not initialised.
Frame vm_frame(Vm *vm, const Code *code, Closure *closure);
// Executes a code and returns its result.
Value vm_eval(Vm *vm, Frame *frame, const Code *code);
// Executes a CALL. `values` are the positional arguments, followed by the named ones.
Value vm_call(Vm *vm, const Instr *instr, Value callee, const Value *values);
Value vm_make_closure(Vm *vm, const Frame *frame, const FunctionCode *code, const Value *defaults);
// Executes an IMPORT from the module at path `file`.
void vm_import(Vm *vm, Frame *frame, const Instr *instr, Value file);

// Instructions that create or look up values (construct.c, eval.c). `slots` are the registers. `list` is the list of
// operands of the instruction.
Value vm_make_node(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
Value vm_call_builtin(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
bool vm_is_true(const Value *v);
// vm_unpack_element returns element i of a value that is bound to several names. vm_loop_element returns element i of a
// loop's source, or null past its end.
Value vm_unpack_element(Vm *vm, Value value, uint32_t i);
Value vm_loop_element(Vm *vm, const Loop *loop, uint32_t i);
// batch.c: executes as many of the loop's remaining iterations as possible in batches. `start` is its FOR or FOR_RANGE,
// which has a BatchPlan. Called again when loop->at reaches loop->retry_at.
void vm_run_batches(Vm *vm, Frame *frame, const Code *code, const Instr *start, Loop *loop);
// Prepares a loop over a range.
void vm_range_init(Vm *vm, const Origin *at, Loop *loop, Value start, Value stop, Value step);
// batch_nodes.c: yields the node of an iteration, as a row of a node batch or alone.
void vm_yield_node(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, Loop *loop);
Value vm_decorate(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
Value vm_append(Vm *vm, const Instr *instr, Value parent, Value children);
Value vm_compose(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, const Origin *at);
Value vm_lookup(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
// Returns the value in the state for a key of numbers. The value is not copied. `lookup` is the number of the lookup
// (Instr.target).
Value vm_lookup_numbers(Vm *vm, uint32_t lookup, const double *numbers, uint32_t len);
Value vm_range(Vm *vm, const Origin *at, Value start, Value stop, Value step);
Value vm_index(Vm *vm, Value vector, Value index);
Value vm_slice(Vm *vm, const Origin *at, Value vector, Value start, Value stop);

// Prepares the inline caches for `count` lookups of a program, and rewinds each to its first entry.
void vm_inline_cache_reset(Vm *vm, uint32_t count);
void vm_inline_cache_free(Vm *vm);

// Returns true for a single number, the most frequent kind of value.
static inline bool is_number(const Value *v) {
    return v->len == 1 && v->kind == VALUE_NUMBERS;
}

// Stores a number with a single store of 16 bytes. After two stores of 8 bytes, a 16-byte load could not use store
// forwarding and would stall.
static inline void vm_set_number(Value *to, double x) {
    typedef double Halves __attribute__((vector_size(16)));
    static const union {
        Value value;
        double head;
    } one = {.value = {.len = 1}};
    Halves whole = {one.head, x};
    memcpy(to, &whole, sizeof *to);
}

// Reports a run-time error at a position. The address of the literal `format` identifies the error, which is reported
// once per position and frame. The text is formatted only if it is reported, because a deep recursion may fail a
// million times.
void vm_fault(Vm *vm, const Origin *at, const char *code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// Like vm_fault, but takes a complete text, which is reported once per position and frame.
void vm_fault_text(Vm *vm, const Origin *at, const char *code, Str text);
// Like vector_finish, but reports an error if the vector was too long.
Value vm_finish(Vm *vm, const Origin *at, Vector *vector);
// Returns true if enough of the C stack is left for another call.
bool vm_stack_left(const Vm *vm);

enum { VM_INSTRS_A_UNIT = 8 }; // instructions per unit of work
// Charges work for an operation at a position.
static inline void vm_charge(Vm *vm, const Origin *at, uint64_t units) {
    vm->at = at;
    arena_charge(vm->arena, units);
}

// Charges for the call of a built-in and returns true if the call is allowed. Errors of the built-in are reported at
// `at`. While folding, impure built-ins are not called, so that nothing is logged and no file is read.
static inline bool vm_can_call(Vm *vm, const Builtin *builtin, const Origin *at, const Value *values, uint32_t count) {
    vm->met_dynamic |= !builtin->pure;
    if (vm->is_static && vm->met_dynamic)
        return false;
    uint64_t numbers = 0;
    for (uint32_t i = 0; i < count; i++)
        numbers += values[i].len;
    vm_charge(vm, at, 1 + numbers / BUDGET_NUMBERS);
    return true;
}

#endif
