// import.c: import of modules. Importing evaluates the module, which may import others.
#include "vm/machine.h"

static bool is_importing(const Vm *vm, const Source *source) {
    for (const ImportLink *link = vm->imports; link; link = link->outer)
        if (str_equal(link->source->path, source->path))
            return true;
    return false;
}

enum { IMPORT_WORK = 100 }; // work units of checking the file of a module

// Evaluates a module in a separate frame and stores the imported values in registers of `frame`. The module sees only
// built-ins and no state (L13.2).
static void run_module(Vm *vm, Frame *frame, const Program *module, const Instr *instr) {
    ImportLink link = {vm->imports, module->source, vm->imports->depth + 1};
    vm_charge(vm, instr->at, IMPORT_WORK + module->code->count / VM_INSTRS_A_UNIT + link.depth / 8);
    const State *state = vm->state;
    Str directory = vm->builtins.directory;
    ArenaMark mark = arena_mark(&vm->slots);
    vm->imports = &link;
    vm->state = NULL;
    vm->builtins.directory = module->source->directory;
    Frame inner = vm_null_frame(vm, module->code);
    vm_eval(vm, &inner, module->code);
    vm->imports = link.outer;
    vm->state = state;
    vm->builtins.directory = directory;
    Text missing = text_new(vm->arena);
    for (uint32_t i = 0; i < instr->count; i++) {
        const Symbol *name = instr->as.names[i];
        const Export *found = program_find_export(module, name);
        if (found)
            frame->slots[(uint32_t)instr->d + i] = inner.slots[found->slot];
        else
            text_add_format(&missing, " '%.*s'", STR_ARGS(name->name));
    }
    if (missing.len)
        vm_fault(vm, instr->at, "unknown-import", "'%.*s' does not bind%.*s", STR_ARGS(module->source->name),
                 STR_ARGS(missing));
    arena_rewind(&vm->slots, mark);
}

void vm_import(Vm *vm, Frame *frame, const Instr *instr, Value file) {
    Str name = value_text(vm->arena, vm->symbols, file);
    Str path = path_join(vm->arena, instr->at->source->directory, name);
    Str reason = {0};
    const Program *module = name.len ? vm->host.module(vm->host.user_data, path, &reason) : NULL;
    if (!module) {
        if (!name.len)
            reason = STR("no file name");
        vm_fault(vm, instr->at, "cannot-import", "cannot import '%.*s': %.*s", STR_ARGS(path), STR_ARGS(reason));
    } else if (is_importing(vm, module->source)) {
        vm_fault(vm, instr->at, "circular-import", "circular import of '%.*s'", STR_ARGS(path));
    } else if (vm->imports->depth >= VM_IMPORT_DEPTH || !vm_stack_left(vm)) {
        vm_fault(vm, instr->at, "recursion-depth", "imports nested too deeply");
    } else {
        run_module(vm, frame, module, instr);
    }
}
