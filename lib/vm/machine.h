// machine.h: internal declarations of the virtual machine.
#pragma once

#include "program/code.h"
#include "value/node_batch.h"
#include "value/ops.h"
#include "vm/vm.h"

#include <string.h>

// A user function as a value: its code, captured values and defaults. A closure lives until the frame's arena is reset.
// A closure that was folded at load time lives as long as the program.
typedef struct Closure {
    Function base; // first member, so that a Function pointer can be cast to Closure
    const FunctionCode *code;
    const Value *captures;
    const Value *defaults;  // by parameter: value of an omitted argument
    uint32_t active_calls;  // number of calls in evaluation `evaluation_id` that have not returned
    uint64_t evaluation_id; // number of the evaluation that last called the closure (Vm.evaluation_id)
    Value self;             // a vector whose only element is this closure
} Closure;

// A node and the item that refers to it. As a value, the node is a vector whose only element is this item.
typedef struct NodeValue {
    Node node;
    Item item;
} NodeValue;

// State of a running loop.
typedef struct Loop {
    Value source;  // vector to iterate over; if its kind is VALUE_ABSENT, only its `len` is used
    OpRange span;  // range to iterate over if source.kind is VALUE_ABSENT; source.len is its length
    uint32_t at;   // index in the source of the first element of the current iteration
    Vector result; // values yielded so far
    // Used by batch_nodes.c:
    NodeBatch *batch;       // node batch with the last node; NULL: the last node is in no batch, or there is none yet
    uint32_t short_batches; // number of node batches that ended with fewer than MIN_ROWS rows
    bool not_counting;      // assume that the loop variable does not increase by 1 from one node to the next
    ArenaMark mark;         // position in Vm.arena to which it can be rewound after a node was added to `batch`
    uint32_t reported;      // value of Vm.reported_count when `mark` was set
    // Used by batch.c:
    uint32_t retry_at;       // batches of iterations are tried again once `at` reaches this value; 0: never
    uint32_t failed_batches; // number of batches whose iterations had to be executed one by one
} Loop;

// The memory of one execution of a Code.
typedef struct Frame {
    Value *slots;            // registers; the constants of the Code are stored directly before them
    const int32_t *operands; // Code.operands
    Loop *loops;             // running loops, indexed by nesting depth
    Closure *closure;        // NULL in the main program and in modules
} Frame;

// A program that is being evaluated: the main program or a module.
struct ImportLink {
    const ImportLink *outer; // program that imports this module; NULL: this is the main program
    const Source *source;
    uint32_t depth; // number of imports between the main program and this module
};

// Allocates a frame in which `code` can be executed, and copies the constants to it. The slots are not initialised.
Frame vm_frame(Vm *vm, const Code *code, Closure *closure);
// Like vm_frame for code that is not in a closure, and sets the slots to null.
Frame vm_null_frame(Vm *vm, const Code *code);
// Executes a code and returns its result.
Value vm_eval(Vm *vm, Frame *frame, const Code *code);
// Executes the IMPORT instruction `instr`: stores values of the module at path `file` in registers of `frame`, which
// must be null.
void vm_import(Vm *vm, Frame *frame, const Instr *instr, Value file);

// Each of these functions computes the value that an instruction writes (operators.c, construct.c, lookup.c, call.c).
// They do not write to registers.
typedef Value VmFunction(Vm *vm, const Frame *frame, const Instr *instr);
#define OPCODE(id, name, operands, batch)
#define FUNCTION(id, name, operands, batch, function) VmFunction vm_##function;
#include "program/opcode_list.h"

// Returns the vector of the operands of a COMPOSE or LOOKUP instruction. Errors are reported at `at`.
Value vm_compose_at(Vm *vm, const Frame *frame, const Instr *instr, const Origin *at);
// Returns vector[index].
Value vm_index_value(Vm *vm, Value vector, Value index);
// If from..to are whole numbers within a numeric vector, and at least two, sets *slice to these elements and returns
// true.
bool vm_slice_numbers(Vm *vm, const Value *vector, double from, double to, Value *slice);
// Calls a function with positional arguments. Errors are reported at `at`.
Value vm_call_function(Vm *vm, const Function *function, const Value *args, uint32_t count, const Origin *at);
// Returns element i of the loop's source, or null if the source has fewer elements.
Value vm_loop_element(const Loop *loop, uint32_t i);
// batch.c: executes as many of the loop's remaining iterations as possible in batches. `start` is the FOR or FOR_RANGE
// instruction of the loop, and must have a BatchPlan. Called when the loop starts, and again when loop->at reaches
// loop->retry_at. functions[op] computes the value of an instruction for one iteration.
void vm_run_batches(Vm *vm, Frame *frame, const Code *code, const Instr *start, Loop *loop,
                    VmFunction *const functions[OP_COUNT]);
// Prepares a loop over a range.
void vm_range_init(Vm *vm, const Origin *at, Loop *loop, Value start, Value stop, Value step);
// batch_nodes.c: executes a YIELD_NODE. It adds the node to the loop's result, as a row of a node batch or as a single
// node.
void vm_yield_node(Vm *vm, const Frame *frame, const Instr *instr);
// Returns a copy of the value that the state has for the key of `len` numbers. `lookup` is the number of the LOOKUP
// instruction (Instr.target).
Value vm_lookup_numbers(Vm *vm, uint32_t lookup, const double *numbers, uint32_t len);

// Prepares the inline caches of a program with `count` lookups: adds missing caches and rewinds each to its first
// entry.
void vm_inline_cache_reset(Vm *vm, uint32_t count);
void vm_inline_cache_free(Vm *vm);

// Returns true for a single number, the most frequent kind of value.
static inline bool is_number(const Value *v) {
    return v->len == 1 && v->kind == VALUE_NUMBERS;
}

static inline bool vm_is_true(const Value *v) {
    return is_number(v) ? v->as.number != 0 : value_true(*v);
}

// Sets *to to the number x with a single 16-byte store. After two 8-byte stores, a 16-byte load of *to would stall,
// because the processor forwards data to a load only from a single store.
static inline void vm_set_number(Value *to, double x) {
    typedef double Halves __attribute__((vector_size(16)));
    static const union {
        Value value;
        double head;
    } one = {.value = {.len = 1}};
    Halves whole = {one.head, x};
    memcpy(to, &whole, sizeof *to);
}

// Reports a run-time error at the source position `at`. The address of the literal `format` identifies the error. The
// same error is reported only once per position and frame. Repeated errors are not even formatted, because a deep
// recursion may fail a million times.
void vm_report(Vm *vm, const Origin *at, const char *code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// Like vm_report, but takes the complete text, which also identifies the error.
void vm_report_text(Vm *vm, const Origin *at, const char *code, Str text);
// Like vector_finish, but reports an error if the vector was too long.
Value vm_finish(Vm *vm, const Origin *at, Vector *vector);

enum { VM_INSTRS_A_UNIT = 8 }; // number of instructions that cost one unit of work
// Charges `units` of work for an operation at the source position `at`.
static inline void vm_charge(Vm *vm, const Origin *at, uint64_t units) {
    vm->at = at;
    arena_charge(vm->arena, units);
}

// Charges the work of calling a built-in with `count` arguments, and returns true if the call is allowed. The
// built-in's errors will be reported at `at`. While folding, impure built-ins are not called, so that nothing is logged
// and no file is read.
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

// Executes the BUILTIN instruction `instr` with the given arguments.
static inline Value vm_call_builtin(Vm *vm, const Instr *instr, const Value *values) {
    if (!vm_can_call(vm, instr->as.builtin, instr->at, values, instr->count))
        return VALUE_NULL;
    vm->builtins.called = instr->as.builtin;
    return instr->as.builtin->call(&vm->builtins, values, instr->count);
}
