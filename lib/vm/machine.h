// machine.h: what the machine's files share.
#ifndef PETRI_VM_MACHINE_H
#define PETRI_VM_MACHINE_H

#include "program/code.h"
#include "value/node_batch.h"
#include "value/ops.h"
#include "vm/vm.h"

#include <string.h>

// A user function as a value: its code with what it captured. Lives as long as the frame, or the program if it was made
// ahead.
typedef struct Closure {
    Function base; // first: a Function * to a closure is a Closure *
    const FunctionCode *code;
    const Value *captures;
    const Value *defaults;
    uint32_t active_calls; // calls that have not returned, in evaluation `run`
    uint64_t evaluation_id;
    Value self; // the vector of this one function
} Closure;

// A node with the vector that holds it.
typedef struct NodeValue {
    Node node;
    Item item;
} NodeValue;

// A loop that is being run.
typedef struct Loop {
    Value source; // VALUE_ABSENT: `span`, of the same length
    OpRange span;
    uint32_t at;
    Vector result;
    // batch_nodes.c
    NodeBatch *batch;       // that the next row may belong to
    uint32_t short_batches; // runs that came to little
    bool not_counting;      // its name does not count up
    ArenaMark mark;         // after the last row
    uint32_t reported;      // faults by then
    // batch.c
    uint32_t retry_at;       // the round with which many are to be run at once again; 0: none
    uint32_t failed_batches; // blocks of rounds that had to be run one by one
} Loop;

// The running code: its registers, before which lie its constants, and loops, and its closure (NULL in the main program
// and in modules).
typedef struct Frame {
    Value *slots;
    Loop *loops;
    Closure *closure;
} Frame;

struct ImportLink {
    const ImportLink *outer;
    const Source *source;
    uint32_t depth; // 0: the main program
};

// A frame for a code; its slots are not cleared.
Frame vm_frame(Vm *vm, const Code *code, Closure *closure);
Value vm_eval(Vm *vm, Frame *frame, const Code *code);
// The call that an instruction is, of the callee with the values of its arguments.
Value vm_call(Vm *vm, const Instr *instr, Value callee, const Value *values);
Value vm_make_closure(Vm *vm, const Frame *frame, const FunctionCode *code, const Value *defaults);
void vm_import(Vm *vm, Frame *frame, const Instr *instr, Value file);

// construct.c: the instructions that make or look up something. `slots` are the registers, `list` the numbers of
// operands.
Value vm_make_node(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
Value vm_call_builtin(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
bool vm_is_true(const Value *v);
// Element i of what is unpacked; element i of what a loop goes over, or null beyond its end.
Value vm_unpack_element(Vm *vm, Value value, uint32_t i);
Value vm_loop_element(Vm *vm, const Loop *loop, uint32_t i);
// batch.c: runs as many rounds of a loop as it can, many at once, from where it is. `start`: its FOR or FOR_RANGE,
// which has a BatchPlan. To be called again when the loop comes to `again`.
void vm_run_batches(Vm *vm, Frame *frame, const Code *code, const Instr *start, Loop *loop);
// Prepares a loop over a range.
void vm_range_init(Vm *vm, const Origin *at, Loop *loop, Value start, Value stop, Value step);
// batch_nodes.c: the node of a round of a loop, as a row of a run or by itself.
void vm_yield_node(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, Loop *loop);
Value vm_decorate(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
Value vm_append(Vm *vm, const Instr *instr, Value parent, Value children);
Value vm_compose(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr, const Origin *at);
Value vm_lookup(Vm *vm, const int32_t *list, const Value *slots, const Instr *instr);
// What the state has for a key of numbers, borrowed, at the place with this number.
Value vm_lookup_numbers(Vm *vm, uint32_t lookup, const double *numbers, uint32_t len);
Value vm_range(Vm *vm, const Origin *at, Value start, Value stop, Value step);
Value vm_index(Vm *vm, Value vector, Value index);
Value vm_slice(Vm *vm, const Origin *at, Value vector, Value start, Value stop);

// Makes room for the look-ups of a program and goes to before the first of each.
void vm_inline_cache_reset(Vm *vm, uint32_t count);
void vm_inline_cache_free(Vm *vm);

// One number, as most values are.
static inline bool is_number(const Value *v) {
    return v->len == 1 && v->kind == VALUE_NUMBERS;
}

// One store of 16 bytes: after two of 8 bytes, a load of 16 waits until both are in the cache, as neither can be
// forwarded.
static inline void vm_set_number(Value *to, double x) {
    typedef double Halves __attribute__((vector_size(16)));
    static const union {
        Value value;
        double head;
    } one = {.value = {.len = 1}};
    Halves whole = {one.head, x};
    memcpy(to, &whole, sizeof *to);
}

// Reports a run-time fault at a place: of each kind (`format`, a literal) the first at that place in the frame.
// The text is made up only then: a recursion that runs into its limit does so a million times.
void vm_fault(Vm *vm, const Origin *at, const char *code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// The same for a text that is there already: each text once at that place in the frame.
void vm_fault_text(Vm *vm, const Origin *at, const char *code, Str text);
// vector_finish, with a report if the vector was too long.
Value vm_finish(Vm *vm, const Origin *at, Vector *vector);
// Is there enough of the C stack left for one more call?
bool vm_stack_left(const Vm *vm);

enum { VM_INSTRS_A_UNIT = 8 }; // of work
// Charges for something that is done at a place.
static inline void vm_charge(Vm *vm, const Origin *at, uint64_t units) {
    vm->at = at;
    arena_charge(vm->arena, units);
}

// May a built-in be called now? Charges for the call and for a look at its arguments. What it complains of will belong
// to `at`. Ahead, no debug line is written and no file is read.
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
