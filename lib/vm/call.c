// call.c: closures and calls (spec language.md L9), and imports, which evaluate a module as a call evaluates a
// function.
#include "vm/machine.h"

// Returns true if enough of the C stack is left for another call.
static bool has_stack_left(const Vm *vm) {
    const char *here = __builtin_frame_address(0);
    // The stack grows down on all supported machines; the absolute distance works in either direction.
    size_t used = vm->stack_base > here ? (size_t)(vm->stack_base - here) : (size_t)(here - vm->stack_base);
    // Calls use at most half of the stack. The rest is reserved for evaluating the expressions of one function, whose
    // nesting is limited (AST_MAX_HEIGHT), and for the C functions that this evaluation calls.
    return used < vm->stack_bytes / 2;
}

// Returns the value to which `capture` refers, for a new closure. `frame` is the frame of the enclosing function.
static Value outer_value(const Frame *frame, const Capture *capture) {
    switch (capture->kind) {
    case CAPTURE_SLOT:
        return frame->slots[capture->slot];
    case CAPTURE_OUTER:
        return frame->closure->captures[capture->slot];
    case CAPTURE_SELF:
        break;
    }
    return frame->closure->self;
}

// Copies the values of an instruction's list of operands to `values`.
static const Value *gather_operands(const Frame *frame, const Instr *instr, Value *values) {
    for (uint32_t i = 0; i < instr->count; i++)
        values[i] = frame->slots[frame->operands[instr->list + i]];
    return values;
}

Value vm_closure(Vm *vm, const Frame *frame, const Instr *instr) {
    const FunctionCode *code = instr->as.function;
    Value *defaults = arena_alloc_array(vm->arena, instr->count, sizeof *defaults);
    Closure *closure = arena_alloc(vm->arena, sizeof *closure);
    Value *captures = arena_alloc_array(vm->arena, code->capture_count, sizeof *captures);
    for (uint32_t i = 0; i < code->capture_count; i++)
        captures[i] = outer_value(frame, &code->captures[i]);
    *closure = (Closure){.base = {.name = code->name},
                         .code = code,
                         .captures = captures,
                         .defaults = gather_operands(frame, instr, defaults),
                         .self = value_function(vm->arena, &closure->base)};
    return closure->self;
}

// The argument values of one call.
typedef struct Arguments {
    const Value *positional;
    uint32_t count;
    const Symbol *const *names; // names of the named arguments
    const Value *named;         // values of the named arguments
    uint32_t named_count;
} Arguments;

static Value argument(const Closure *closure, const Arguments *args, uint32_t i) {
    if (i < args->count)
        return args->positional[i];
    for (uint32_t k = args->named_count; k > 0; k--)
        if (args->names[k - 1] == closure->code->params[i])
            return args->named[k - 1];
    return closure->defaults[i];
}

// Returns the work units that one execution of `code` costs, except those that its instructions charge themselves.
static uint64_t cost_of(const Code *code) {
    return 1 + (code->count + code->constant_count) / VM_INSTRS_A_UNIT;
}

static bool can_enter(Vm *vm, const Closure *closure, const Origin *at) {
    enum { CALL_WORK = 1 }; // work units of preparing the frame and the arguments
    vm_charge(vm, at, CALL_WORK + cost_of(closure->code->code));
    const char *limit = closure->active_calls >= VM_CLOSURE_DEPTH ? "limit of 500 calls of one function"
                        : vm->depth >= VM_CALL_DEPTH              ? "limit of 8192 nested calls"
                        : !has_stack_left(vm)                     ? "stack limit"
                                                                  : NULL;
    if (limit)
        vm_report(vm, at, "recursion-depth", "recursion too deep in '%.*s': %s reached", STR_ARGS(closure->base.name),
                  limit);
    return !limit;
}

static Value call_closure(Vm *vm, Closure *closure, const Arguments *args, const Origin *at) {
    const FunctionCode *code = closure->code;
    // First call in this evaluation; an earlier, aborted evaluation may have left active_calls > 0.
    if (closure->evaluation_id != vm->evaluation_id) {
        closure->evaluation_id = vm->evaluation_id;
        closure->active_calls = 0;
    }
    if (!can_enter(vm, closure, at))
        return VALUE_NULL;
    ArenaMark mark = arena_mark(&vm->slots);
    Frame frame = vm_frame(vm, code->code, closure);
    for (uint32_t i = 0; i < code->param_count; i++)
        frame.slots[i] = argument(closure, args, i);
    closure->active_calls++;
    vm->depth++;
    Value result = vm_eval(vm, &frame, code->code);
    vm->depth--;
    closure->active_calls--;
    arena_rewind(&vm->slots, mark);
    return result;
}

static Value call_item(Vm *vm, Item item, const Arguments *args, const Origin *at) {
    if (item.type != ITEM_FUNCTION) {
        static const char *const texts[] = {"a number cannot be called", "a string cannot be called",
                                            "a node cannot be called; write attributes without parentheses: !name a=1"};
        vm_report_text(vm, at, "not-callable", str_from(texts[item.type]));
        return VALUE_NULL;
    }
    const Builtin *builtin = item.as.function->builtin;
    if (!builtin)
        return call_closure(vm, (Closure *)item.as.function, args, at);
    // The named arguments are stored directly after the positional ones.
    if (!vm_can_call(vm, builtin, at, args->positional, args->count + args->named_count))
        return VALUE_NULL;
    return builtin_call(&vm->builtins, builtin, args->positional, args->count, args->names, args->named,
                        args->named_count);
}

enum { MAX_STACK_ARGUMENTS = 8 };

// Returns the values of an instruction's list of operands as an array. The array is `buffer` if they fit in it.
static const Value *gather_arguments(Vm *vm, const Frame *frame, const Instr *instr, Value *buffer) {
    bool fits = instr->count <= MAX_STACK_ARGUMENTS;
    return gather_operands(frame, instr, fits ? buffer : arena_alloc_array(vm->arena, instr->count, sizeof *buffer));
}

Value vm_builtin(Vm *vm, const Frame *frame, const Instr *instr) {
    Value buffer[MAX_STACK_ARGUMENTS];
    return vm_call_builtin(vm, instr, gather_arguments(vm, frame, instr, buffer));
}

Value vm_call(Vm *vm, const Frame *frame, const Instr *instr) {
    const CallCode *code = instr->as.call;
    const Value callee = frame->slots[instr->b];
    Value buffer[MAX_STACK_ARGUMENTS];
    const Value *values = gather_arguments(vm, frame, instr, buffer);
    if (callee.kind != VALUE_MIXED) // calling null, a stream or numbers results in null without an error (L9.3)
        return VALUE_NULL;
    Arguments args = {values, code->arg_count, code->names, values + code->arg_count, code->named_count};
    if (callee.len == 1)
        return call_item(vm, callee.as.items[0], &args, instr->at);
    Vector vector = vector_new(vm->arena);
    for (uint32_t i = 0; i < callee.len; i++)
        vector_add(&vector, call_item(vm, callee.as.items[i], &args, instr->at));
    return vm_finish(vm, instr->at, &vector);
}

Value vm_call_function(Vm *vm, const Function *function, const Value *args, uint32_t count, const Origin *at) {
    Arguments arguments = {.positional = args, .count = count};
    return call_item(vm, (Item){ITEM_FUNCTION, .as.function = function}, &arguments, at);
}

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
        vm_report(vm, instr->at, "unknown-import", "'%.*s' does not bind%.*s", STR_ARGS(module->source->name),
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
        vm_report(vm, instr->at, "cannot-import", "cannot import '%.*s': %.*s", STR_ARGS(path), STR_ARGS(reason));
    } else if (is_importing(vm, module->source)) {
        vm_report(vm, instr->at, "circular-import", "circular import of '%.*s'", STR_ARGS(path));
    } else if (vm->imports->depth >= VM_IMPORT_DEPTH || !has_stack_left(vm)) {
        vm_report(vm, instr->at, "recursion-depth", "imports nested too deeply");
    } else {
        run_module(vm, frame, module, instr);
    }
}
