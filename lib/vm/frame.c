// frame.c: call frames.
#include "vm/machine.h"

Frame vm_frame(Vm *vm, const Code *code, Closure *closure) {
    size_t constants = code->constant_count, registers = code->register_count;
    Value *memory = arena_alloc(&vm->slots, (constants + registers) * sizeof *memory + code->loop_count * sizeof(Loop));
    for (size_t i = 0; i < constants; i++)
        memory[i] = code->constants[i];
    Value *slots = memory + constants;
    return (Frame){slots, code->operands, (Loop *)(void *)(slots + registers), closure};
}

Frame vm_null_frame(Vm *vm, const Code *code) {
    Frame frame = vm_frame(vm, code, NULL);
    for (uint32_t i = 0; i < code->slot_count; i++)
        frame.slots[i] = VALUE_NULL;
    return frame;
}
