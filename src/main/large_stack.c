// large_stack.c: runs on a thread with a large stack, whose unused pages take no memory. If the address space is
// limited, tries smaller stacks.
#include "main/large_stack.h"

#include <pthread.h>
#include <signal.h>

typedef struct Call {
    void (*run)(void *context, size_t stack_bytes);
    void *context;
    size_t stack_bytes;
} Call;

static void *execute(void *context) {
    const Call *call = context;
    call->run(call->context, call->stack_bytes);
    return NULL;
}

bool large_stack_run(void (*run)(void *context, size_t stack_bytes), void *context) {
    const size_t mebibyte = (size_t)1 << 20;
    for (size_t size = 512 * mebibyte; size >= 8 * mebibyte; size /= 2) {
        Call call = {run, context, size - mebibyte};
        pthread_attr_t attributes;
        pthread_t thread;
        if (pthread_attr_init(&attributes) != 0)
            return false;
        bool started = pthread_attr_setstacksize(&attributes, size) == 0 &&
                       pthread_create(&thread, &attributes, execute, &call) == 0;
        pthread_attr_destroy(&attributes);
        if (started) {
            sigset_t all; // all signals, blocked in this thread so that the new thread receives them
            sigfillset(&all);
            pthread_sigmask(SIG_BLOCK, &all, NULL);
            return pthread_join(thread, NULL) == 0;
        }
    }
    return false;
}
