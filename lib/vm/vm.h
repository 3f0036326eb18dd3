// vm.h: the machine that evaluates a compiled program for one frame.
//
// Evaluation never fails: every fault has a value, nearly always null, and is reported through the host (spec
// language.md L15). Results live in the frame's arena. Limits of depth are diagnostics too. Work and memory are charged
// to that arena; when they are used up, control leaves through its escape, and `at` tells what asked for them.
#ifndef PETRI_VM_VM_H
#define PETRI_VM_VM_H

#include "base/diag.h"
#include "builtin/builtin.h"
#include "program/program.h"
#include "state/state.h"
#include "vm/profile.h"

enum {
    VM_CLOSURE_DEPTH = 500, // active calls of one closure object (L9.4)
    VM_CALL_DEPTH = 8192,   // nested calls of user functions
    VM_IMPORT_DEPTH = 500,  // modules that import each other in turn
    VM_REPORTED = 1024,     // distinct faults that one frame reports; a power of two
};

typedef struct VmHost {
    void *user_data;
    void (*report)(void *host, const Diag *diag);
    void (*log)(void *host, Str text);
    // The compiled module at a path, or NULL with the reason in *why (borrowed).
    const Program *(*module)(void *host, Str path, Str *reason);
} VmHost;

typedef struct ImportLink ImportLink;

// A place and the kind of its fault.
typedef struct Reported {
    const Origin *at;
    uint64_t what;
} Reported;

// What a look-up in the state found when it was last made for the first, second, … time in a frame: most scripts look
// up the same keys in the same order in every frame. Only a guess, which is checked.
typedef struct InlineCache {
    StateSlot *slots; // heap
    uint32_t count;
    uint32_t capacity;
    uint32_t next;
} InlineCache;

typedef struct Vm {
    Arena *arena; // the frame's: results and temporaries
    Arena slots;  // frames of slots, a stack
    SymbolTable *symbols;
    const State *state; // NULL: look-ups give null (modules, static evaluation)
    Value globals[ENGINE_NAME_COUNT];
    BuiltinContext builtins; // arena, files, directory of the program being evaluated
    VmHost host;
    const Origin *at; // what is at work: a built-in's fault belongs to it, and so does a limit. NULL: nothing yet
    uint32_t depth;
    uint64_t evaluation_id; // number of the evaluation, unique over a session's machines: closures may outlive a frame
    bool is_static;         // evaluating ahead: dynamic things have no value yet
    bool met_dynamic;       // … and one was met
    size_t stack_bytes;     // of the C stack that evaluation may use
    const char *stack_base;
    const ImportLink *imports;      // modules being evaluated, innermost first
    Reported reported[VM_REPORTED]; // hash set of the faults of this frame
    uint32_t reported_count;
    bool speculative;            // what is run may be run again, in another order: a fault that would be reported
    bool speculation_failed;     // … is only noted here
    uint64_t batched_iterations; // of loops that were run many at once, ever
    InlineCache *inline_caches;  // of the main program's look-ups by number; heap
    uint32_t inline_cache_count;
    Profile *profile; // borrowed; NULL: nothing is measured
} Vm;

// Prepares a machine; `stack_bytes` is what it may use of the caller's stack. Free with vm_free.
// The runs of a machine made for static evaluation are numbered apart from those of the one for frames.
void vm_init(Vm *vm, Arena *arena, SymbolTable *symbols, VmHost host, size_t stack_bytes, bool is_static);
void vm_free(Vm *vm);

// Evaluates a main program: the composition of its statements. `given` are the values of its parameters (NULL if it has
// none); what its exports are bound to in the end is stored in `exports`, unless that is NULL.
Value vm_run(Vm *vm, const Program *program, const Value *arguments, Value *exports);
// Runs code that is no program's in a fresh frame; the value lives in
// `arena`. False, and *value null, if that met anything dynamic (L17.2), a fault or a limit. For machines that run
// nothing else.
bool vm_run_static(Vm *vm, Arena *arena, const Code *code, Value *value);

#endif
