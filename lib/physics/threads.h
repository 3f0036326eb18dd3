// threads.h: work that is shared by threads.
//
// A few threads wait for work. Work comes in shares, which are claimed one after the other by whoever is free, the
// caller included: so on a busy machine, where a thread may not get a processor for milliseconds, the others do without
// it, and the caller never waits for a thread that has not begun. What a share is depends on its number only.
#ifndef PETRI_PHYSICS_THREADS_H
#define PETRI_PHYSICS_THREADS_H

#include "physics/system.h"

enum {
    PHYS_MOST_THREADS = 64,
    PHYS_MOST_SHARES = 64,
    PHYS_SHARES_EACH = 4, // shares for each thread, if the work can be cut freely
};

typedef void PhysWork(void *context, int share, int shares);

// Calls `work` for share 0 … shares - 1 on all threads of the system, in any order.
void phys_parallel(const PhysSystem *system, int shares, PhysWork *work, void *context);
// The same for shares that wait for those before them: they begin in ascending order.
void phys_parallel_in_order(const PhysSystem *system, int shares, PhysWork *work, void *context);

// The number of shares for `count` things: 1 if fewer than `least`, which are not worth waking a thread.
int phys_shares(const PhysSystem *system, size_t count, size_t least);

// Where share number `share` of so many begins, if `count` things are dealt out in equal runs.
static inline size_t phys_share(size_t count, int share, int shares) {
    return (size_t)((unsigned long long)count * (unsigned)share / (unsigned)shares);
}

#endif
