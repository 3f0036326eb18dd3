// vm.c: running whole programs and importing modules; see vm.h.
#include "vm/machine.h"

#include <string.h>

// A built-in's own complaint belongs to the call that is being made.
static void builtin_fault_here(void *host, Str text) {
    Vm *vm = host;
    vm_fault_text(vm, vm->calling, "bad-call", text);
}

static void builtin_log(void *host, Str text) {
    const Vm *vm = host;
    vm->host.log(vm->host.host, text);
}

void vm_init(Vm *vm, Arena *arena, SymbolTable *symbols, VmHost host, size_t stack_bytes, bool is_static) {
    *vm = (Vm){.arena = arena,
               .symbols = symbols,
               .host = host,
               .stack_bytes = stack_bytes,
               .work_limit = is_static ? VM_STATIC_WORK_LIMIT : VM_WORK_LIMIT,
               .run = is_static,
               .is_static = is_static};
    arena_init(&vm->slots, "call frames", SIZE_MAX);
    vm->builtins = (BuiltinContext){
        .arena = arena, .symbols = symbols, .fault = builtin_fault_here, .log = builtin_log, .host = vm};
}

void vm_free(Vm *vm) {
    arena_free(&vm->slots);
}

static Frame new_frame(Vm *vm, uint32_t size) {
    Frame frame = {arena_alloc_array(&vm->slots, size, sizeof(Value)), NULL};
    for (uint32_t i = 0; i < size; i++)
        frame.slots[i] = VALUE_NULL;
    return frame;
}

// Fresh limits; nothing is left over from an evaluation that was escaped from.
static void begin(Vm *vm, const char *stack_base) {
    arena_reset(&vm->slots);
    vm->slots.escape = vm->arena->escape;
    vm->stack_base = stack_base;
    vm->run += 2;
    vm->depth = 0;
    vm->work = 0;
    vm->stopped = false;
    vm->imports = NULL;
    if (vm->reported_count > 0)
        memset(vm->reported, 0, sizeof vm->reported);
    vm->reported_count = 0;
}

Value vm_run(Vm *vm, const Program *program, const Value *given, Value *exports) {
    begin(vm, __builtin_frame_address(0));
    ImportLink self = {NULL, program->source};
    vm->imports = &self;
    vm->builtins.directory = program->source->directory;
    Frame frame = new_frame(vm, program->frame_size);
    for (uint32_t i = 0; i < program->param_count; i++)
        frame.slots[i] = given[i];
    Value result = vm_eval(vm, &frame, program->body);
    for (uint32_t i = 0; exports && i < program->export_count; i++)
        exports[i] = frame.slots[program->exports[i].slot];
    vm->imports = NULL;
    return vm->stopped ? VALUE_NULL : result;
}

bool vm_run_static(Vm *vm, Arena *arena, const Expr *expr, uint32_t frame_size, Value *value) {
    vm->arena = vm->builtins.arena = arena;
    begin(vm, __builtin_frame_address(0));
    vm->met_dynamic = false;
    vm->builtins.directory = expr->source->directory;
    Frame frame = new_frame(vm, frame_size);
    *value = vm_eval(vm, &frame, expr);
    if (!vm->met_dynamic && !vm->stopped && vm->reported_count == 0)
        return true;
    *value = VALUE_NULL;
    return false;
}

static bool being_imported(const Vm *vm, const Source *source) {
    for (const ImportLink *link = vm->imports; link; link = link->outer)
        if (str_equal(link->source->path, source->path))
            return true;
    return false;
}

// Evaluates a module in a frame of its own, with only the built-ins visible and without state (L13.2).
static void run_module(Vm *vm, Frame *frame, const Program *module, const Expr *expr) {
    ImportLink link = {vm->imports, module->source};
    const State *state = vm->state;
    Str directory = vm->builtins.directory;
    ArenaMark mark = arena_mark(&vm->slots);
    vm->imports = &link;
    vm->state = NULL;
    vm->builtins.directory = module->source->directory;
    Frame inner = new_frame(vm, module->frame_size);
    vm_eval(vm, &inner, module->body);
    vm->imports = link.outer;
    vm->state = state;
    vm->builtins.directory = directory;
    Text missing = text_new(vm->arena);
    for (uint32_t i = 0; i < expr->slot_count; i++) {
        const Symbol *name = expr->as.import->names[i];
        const Export *found = program_find_export(module, name);
        if (found)
            frame->slots[expr->slot + i] = inner.slots[found->slot];
        else
            text_add_format(&missing, " '%.*s'", (int)name->name.len, name->name.bytes);
    }
    if (missing.len)
        vm_fault(vm, expr, "no-such-name", "'%.*s' does not bind%.*s", (int)module->source->name.len,
                 module->source->name.bytes, (int)missing.len, missing.bytes);
    arena_rewind(&vm->slots, mark);
}

void vm_import(Vm *vm, Frame *frame, const Expr *expr) {
    Value file = vm_eval(vm, frame, expr->children[0]);
    for (uint32_t i = 0; i < expr->slot_count; i++)
        frame->slots[expr->slot + i] = VALUE_NULL;
    Str name = value_text(vm->arena, vm->symbols, file);
    Str path = path_join(vm->arena, expr->source->directory, name);
    Str why = {0};
    const Program *module = name.len ? vm->host.module(vm->host.host, path, &why) : NULL;
    if (!module) {
        if (!name.len)
            why = STR("no file name");
        vm_fault(vm, expr, "cannot-import", "cannot import '%.*s': %.*s", (int)path.len, path.bytes, (int)why.len,
                 why.bytes);
    } else if (being_imported(vm, module->source)) {
        vm_fault(vm, expr, "circular-import", "circular import of '%.*s'", (int)path.len, path.bytes);
    } else if (!vm_stack_left(vm)) {
        vm_fault(vm, expr, "recursion-depth", "imports nested too deeply");
    } else {
        run_module(vm, frame, module, expr);
    }
}
