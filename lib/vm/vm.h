// vm.h: the virtual machine (VM), which evaluates compiled programs.
//
// Evaluation never fails. An expression with an error has a value, nearly always null, and the error is reported
// through the host (spec language.md L15). Exceeded limits of depth are such errors, too. Results are allocated in the
// frame's arena, which is charged for work and memory. If the arena's budget is exceeded, control leaves through the
// arena's escape, and Vm.at is the position that exceeded the budget.
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
    VM_IMPORT_DEPTH = 500,  // nested imports
    VM_REPORTED = 1024,     // size of the hash set of reported errors; a power of two
};

typedef struct VmHost {
    void *user_data;
    void (*report)(void *host, const Diag *diag);
    void (*log)(void *host, Str text);
    // Returns the compiled module at a path. On failure, returns NULL and sets *reason, which belongs to the host.
    const Program *(*module)(void *host, Str path, Str *reason);
} VmHost;

typedef struct ImportLink ImportLink;

// A reported error: its position and kind.
typedef struct Reported {
    const Origin *at;
    uint64_t what; // identifies the error: address of the format or hash of the text
} Reported;

// Inline cache of one LOOKUP instruction: slots[i] is the slot of the state that execution i in the last frame found.
// Most scripts look up the same keys in the same order in every frame. Each slot is verified before use.
typedef struct InlineCache {
    StateSlot *slots; // heap
    uint32_t count;
    uint32_t capacity;
    uint32_t next; // index of the slot for the next execution
} InlineCache;

typedef struct Vm {
    Arena *arena; // arena of the frame: results and temporary values
    Arena slots;  // stack of call frames
    SymbolTable *symbols;
    const State *state; // NULL: lookups result in null (modules, folding)
    Value globals[ENGINE_NAME_COUNT];
    BuiltinContext builtins; // arena, files, and the directory of the current program
    VmHost host;
    const Origin *at;               // current position, for errors of built-ins and for limits; NULL: none yet
    uint32_t depth;                 // number of active calls of user functions
    uint64_t evaluation_id;         // number of the evaluation; differs between the VMs of a session, because closures
                                    // can live longer than a frame
    bool is_static;                 // for folding expressions; dynamic values are not available
    bool met_dynamic;               // something dynamic was evaluated
    size_t stack_bytes;             // bytes of C stack that evaluation may use
    const char *stack_base;         // address in the C stack at which the evaluation started
    const ImportLink *imports;      // modules being evaluated, innermost first
    Reported reported[VM_REPORTED]; // hash set of the errors of this frame
    uint32_t reported_count;
    // If true, an error is not reported but sets speculation_failed. The caller then executes the instructions again.
    bool speculative;
    bool speculation_failed;     // an error would have been reported
    uint64_t batched_iterations; // total number of iterations executed in batches
    InlineCache *inline_caches;  // one per lookup of the main program, on the heap
    uint32_t inline_cache_count;
    Profile *profile; // borrowed; NULL: profiling is off
} Vm;

// Initialises a VM that may use `stack_bytes` of the caller's stack. Free it with vm_free. A VM with `is_static` is
// used for folding; its evaluation ids differ from those of the VM that evaluates frames.
void vm_init(Vm *vm, Arena *arena, SymbolTable *symbols, VmHost host, size_t stack_bytes, bool is_static);
void vm_free(Vm *vm);

// Evaluates a main program and returns the composition of its statements. `arguments` are the values of
// CompileOptions.params, or NULL if there are none. Stores the values of its exports in `exports`, unless that is NULL.
Value vm_run(Vm *vm, const Program *program, const Value *arguments, Value *exports);
// Evaluates the code of an expression at load time. The value is allocated in `arena`. Returns false, with *value null,
// if the code is dynamic (L17.2) or reports an error. Only for VMs initialised with `is_static`.
bool vm_run_static(Vm *vm, Arena *arena, const Code *code, Value *value);

#endif
