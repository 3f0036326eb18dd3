// vm.h: the virtual machine (VM), which evaluates compiled programs.
//
// Evaluation never fails. An expression with an error has a value, nearly always null, and the error is reported
// through the host (spec language.md L15). An exceeded depth limit is such an error, too. Results are allocated in the
// frame's arena, which is charged for work and memory. If the arena's budget is exceeded, the arena escapes with a
// longjmp (base/arena.h). Vm.at is then the position of the operation that exceeded the budget.
#pragma once

#include "base/diag.h"
#include "builtin/builtin.h"
#include "program/program.h"
#include "state/state.h"
#include "vm/profile.h"

enum {
    VM_CLOSURE_DEPTH = 500, // maximum number of active calls of one closure object (L9.4)
    VM_CALL_DEPTH = 8192,   // maximum depth of nested calls of user functions
    VM_IMPORT_DEPTH = 500,  // maximum depth of nested imports
    VM_REPORTED = 1024,     // number of places in the hash set Vm.reported; a power of two
};

// Functions of the host that the VM calls.
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

// Inline cache of one LOOKUP instruction. The LOOKUP may be executed several times per frame; slots[i] is the slot of
// the state that its execution i last found. Most scripts look up the same keys in the same order in every frame.
// Before a cached slot is used, its key is compared with the wanted key.
typedef struct InlineCache {
    StateSlot *slots; // on the heap
    uint32_t count;
    uint32_t capacity;
    uint32_t next; // index in `slots` for the next execution
} InlineCache;

// The lookups of an evaluation that found nothing, for lints.
enum { LOOKUP_LOG_PLACES = 256, LOOKUP_LOG_KEYS = 16 };
typedef struct MissedLookup {
    const Origin *at;
    uint32_t count; // number of lookups; only the first LOOKUP_LOG_KEYS keys are stored
    Value keys[LOOKUP_LOG_KEYS];
} MissedLookup;
typedef struct LookupLog LookupLog;
struct LookupLog {
    MissedLookup *places; // in the arena of the VM
    uint32_t count;
    uint32_t capacity;
    uint32_t last; // index of the place that was found last
};

typedef struct Vm {
    Arena *arena; // the frame's arena, with results and temporary values
    Arena slots;  // memory of the call frames (Frame), used as a stack
    SymbolTable *symbols;
    LookupLog *missed;  // records lookups that find nothing; NULL: they are not recorded
    const State *state; // state that LOOKUP reads; NULL in modules and while folding: lookups result in null
    Value globals[ENGINE_NAME_COUNT];
    BuiltinContext builtins; // context in which built-ins are called, with the directory of the current program
    VmHost host;
    // Position at which errors of built-ins and exceeded limits are reported; NULL: none yet.
    const Origin *at;
    uint32_t depth; // number of active calls of user functions
    // Number of the current evaluation; two VMs of a session never use the same number, because closures can live
    // longer than a frame.
    uint64_t evaluation_id;
    bool is_static;                 // the VM is used only for folding expressions; dynamic values are not available
    bool met_dynamic;               // something dynamic was evaluated (L17.2)
    size_t stack_bytes;             // bytes of C stack that evaluation may use
    const char *stack_base;         // address in the C stack at which the evaluation started
    const ImportLink *imports;      // programs being evaluated: the innermost module first, the main program last
    Reported reported[VM_REPORTED]; // hash set of the errors of this frame
    uint32_t reported_count;
    // If true, an error is not reported but sets speculation_failed. The caller then executes the instructions again.
    bool speculative;
    bool speculation_failed;     // while `speculative` was true, an error would have been reported
    bool no_batches;             // for tests: execute loops iteration by iteration and create no node batches
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
// CompileOptions.params, or NULL if there are none. Stores the values of the program's exports in `exports`, unless
// `exports` is NULL.
Value vm_run(Vm *vm, const Program *program, const Value *arguments, Value *exports);
// Calls a function value of the last evaluation for each of `count` points, with the point as a vector of three
// numbers, and stores the results in `numbers`. Returns the number of results: fewer than `count` if the next one is
// not a finite number. Temporary values are allocated in `arena`.
typedef struct VmSamples {
    const Program *program; // the main program
    const Function *function;
    const Origin *at; // where errors of the call itself are reported
    const double (*points)[3];
    uint32_t count;
    double *numbers;
    Value wrong; // the last result, if it is not a finite number; in `arena`
    bool failed; // true if an error was reported
} VmSamples;
uint32_t vm_sample(Vm *vm, Arena *arena, VmSamples *samples);
// Evaluates the code of an expression at load time. The value is allocated in `arena`. Returns false and sets *value to
// null if the code is dynamic (L17.2) or reports an error. Only for VMs initialised with `is_static`.
bool vm_run_static(Vm *vm, Arena *arena, const Code *code, Value *value);
