// threads.h: work that is shared by threads.
#ifndef PETRI_PHYSICS_THREADS_H
#define PETRI_PHYSICS_THREADS_H

#include <stddef.h>

// Calls `work` for worker 0 … workers - 1 at the same time; there are at most `threads` of them, and at least one.
void phys_parallel(int threads, void (*work)(void *context, int worker, int workers), void *context);

// Where worker number `worker` of so many begins, if `count` things are dealt out in equal runs.
static inline size_t phys_share(size_t count, int worker, int workers) {
    return (size_t)((unsigned long long)count * (unsigned)worker / (unsigned)workers);
}

#endif
