// machine.h: what the machine's files share.
#ifndef PETRI_VM_MACHINE_H
#define PETRI_VM_MACHINE_H

#include "vm/vm.h"

// A user function as a value: its code with what it captured. Lives as long as the frame, or the program if it was made
// ahead.
typedef struct Closure {
    Function base; // first: a Function * to a closure is a Closure *
    const FunctionCode *code;
    const Value *captures;
    const Value *defaults;
    uint32_t active; // calls that have not returned, in evaluation `run`
    uint64_t run;
    Value self; // the vector of this one function
} Closure;

// The running function: its slots and itself (NULL in the main program and in modules).
typedef struct Frame {
    Value *slots;
    Closure *closure;
} Frame;

struct ImportLink {
    const ImportLink *outer;
    const Source *source;
};

Value vm_eval(Vm *vm, Frame *frame, const Expr *expr);
Value vm_call_expr(Vm *vm, Frame *frame, const Expr *expr);
Value vm_make_closure(Vm *vm, Frame *frame, const Expr *expr);
void vm_import(Vm *vm, Frame *frame, const Expr *expr);

// Stores a value in `count` slots from `slot` on, unpacking it if there are several (L8.3).
void vm_bind(Vm *vm, Frame *frame, uint32_t slot, uint32_t count, Value value);
// Reports a run-time fault at an expression: of each kind (`format`, a literal) the first at that place in the frame.
// The text is made up only then: a recursion that runs into its limit does so a million times.
void vm_fault(Vm *vm, const Expr *at, const char *code, const char *format, ...) __attribute__((format(printf, 4, 5)));
// The same for a text that is there already: each text once at that place in the frame.
void vm_fault_text(Vm *vm, const Expr *at, const char *code, Str text);
// vector_finish, with a report if the vector was too long.
Value vm_finish(Vm *vm, const Expr *at, Vector *vector);
// Counts one call or loop round; false once the frame's work is used up (reported once).
bool vm_work(Vm *vm, const Expr *at);
// Is there enough of the C stack left for one more call?
bool vm_stack_left(const Vm *vm);

#endif
