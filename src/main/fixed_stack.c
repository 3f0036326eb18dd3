// fixed_stack.c: large_stack.h for WebAssembly, where there are no threads. src/web/meson.build sets the size of the
// stack.
#include "main/large_stack.h"

bool large_stack_run(void (*run)(void *context, size_t stack_bytes), void *context) {
    run(context, (size_t)PETRI_STACK_BYTES - ((size_t)1 << 20));
    return true;
}
