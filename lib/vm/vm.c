// vm.c: evaluation of programs; see vm.h.
//
// Every evaluation begins with reset_evaluation, so that nothing is left of an evaluation that was aborted by a
// longjmp.
#include "vm/machine.h"

#include <math.h>
#include <string.h>

// Reports an error of a built-in at the position of its call.
static void report_builtin_error(void *host, Str text) {
    Vm *vm = host;
    vm_report_text(vm, vm->at, "bad-call", text);
}

static void log_of_builtin(void *host, Str text) {
    const Vm *vm = host;
    vm->host.log(vm->host.user_data, text);
}

void vm_init(Vm *vm, Arena *arena, SymbolTable *symbols, VmHost host, size_t stack_bytes, bool is_static) {
    *vm = (Vm){.arena = arena,
               .symbols = symbols,
               .host = host,
               .stack_bytes = stack_bytes,
               .evaluation_id = is_static,
               .is_static = is_static};
    arena_init(&vm->slots, "call frames", SIZE_MAX);
    vm->slots.budget = arena->budget;
    vm->builtins = (BuiltinContext){.arena = arena,
                                    .symbols = symbols,
                                    .report_error = report_builtin_error,
                                    .log = log_of_builtin,
                                    .user_data = vm};
}

void vm_free(Vm *vm) {
    arena_free(&vm->slots);
    vm_inline_cache_free(vm);
}

// Prepares the VM for an evaluation. Discards the data that an earlier, aborted evaluation has left.
static void reset_evaluation(Vm *vm, const char *stack_base) {
    arena_reset(&vm->slots);
    vm->slots.escape = vm->arena->escape;
    vm->at = NULL;
    vm->stack_base = stack_base;
    vm->evaluation_id += 2;
    vm->depth = 0;
    vm->imports = NULL;
    if (vm->reported_count > 0)
        memset(vm->reported, 0, sizeof vm->reported);
    vm->reported_count = 0;
    vm->speculative = vm->speculation_failed = false;
}

Value vm_run(Vm *vm, const Program *program, const Value *arguments, Value *exports) {
    reset_evaluation(vm, __builtin_frame_address(0));
    ImportLink self = {NULL, program->source, 0};
    vm->imports = &self;
    vm->builtins.directory = program->source->directory;
    vm_inline_cache_reset(vm, program->lookup_count);
    if (vm->profile)
        vm_profile_begin(vm->profile, vm->arena->escape);
    Frame frame = vm_null_frame(vm, program->code);
    for (uint32_t i = 0; i < program->param_count; i++)
        frame.slots[i] = arguments[i];
    Value result = vm_eval(vm, &frame, program->code);
    if (vm->profile)
        vm_profile_end(vm->profile);
    for (uint32_t i = 0; exports && i < program->export_count; i++)
        exports[i] = frame.slots[program->exports[i].slot];
    vm->imports = NULL;
    vm->at = NULL;
    return result;
}

uint32_t vm_sample(Vm *vm, Arena *arena, VmSamples *samples) {
    Arena *before = vm->arena;
    ImportLink self = {NULL, samples->program->source, 0};
    uint32_t i = 0;
    vm->arena = vm->builtins.arena = arena;
    reset_evaluation(vm, __builtin_frame_address(0));
    vm->imports = &self;
    vm->builtins.directory = samples->program->source->directory;
    vm_inline_cache_reset(vm, samples->program->lookup_count);
    if (vm->profile)
        vm_profile_begin(vm->profile, arena->escape);
    for (ArenaMark mark = arena_mark(arena); i < samples->count; i++, arena_rewind(arena, mark)) {
        const Value point = {.len = 3, .as.numbers = samples->points[i]};
        samples->wrong = vm_call_function(vm, samples->function, &point, 1, samples->at);
        if (!value_is_number(samples->wrong) || !isfinite(samples->wrong.as.number))
            break;
        samples->numbers[i] = samples->wrong.as.number;
    }
    if (vm->profile)
        vm_profile_end(vm->profile);
    samples->failed = vm->reported_count > 0;
    vm->arena = vm->builtins.arena = before;
    vm->imports = NULL;
    vm->at = NULL;
    return i;
}

bool vm_run_static(Vm *vm, Arena *arena, const Code *code, Value *value) {
    vm->arena = vm->builtins.arena = arena;
    reset_evaluation(vm, __builtin_frame_address(0));
    vm->met_dynamic = false;
    vm->builtins.directory = code->source->directory;
    Frame frame = vm_null_frame(vm, code);
    *value = vm_eval(vm, &frame, code);
    if (!vm->met_dynamic && vm->reported_count == 0)
        return true;
    *value = VALUE_NULL;
    return false;
}
