// large_stack.h: a large C stack. Scripts can nest thousands of calls, so evaluation needs more than the main thread
// has.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// Calls `run` once on a large stack and waits until it returns. `stack_bytes` is the size that `run` may use. Returns
// false, without the call, if no thread can be started.
bool large_stack_run(void (*run)(void *context, size_t stack_bytes), void *context);
