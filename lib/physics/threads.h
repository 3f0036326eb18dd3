// threads.h: work that is shared by threads.
//
// A few threads wait for work. Work comes in shares, which are claimed one after the other by whoever is free, the
// caller included: so on a busy machine, where a thread may not get a processor for milliseconds, the others do without
// it, and the caller never waits for a thread that has not begun. Where it has to wait too long for one that has, it
// does without help for a while (backoff.h). What a share is depends on its number only.
//
// Threads look for the next job for a while before they sleep. A job that is over before a sleeping thread would be
// awake is given to those that are (phys_short_job_threads).
#ifndef PETRI_PHYSICS_THREADS_H
#define PETRI_PHYSICS_THREADS_H

#include "physics/system.h"

enum {
    PHYS_MAX_THREADS = 64,
    PHYS_MAX_CHUNKS = 64,
    PHYS_CHUNKS_PER_THREAD = 4, // shares for each thread, if the work can be cut freely
};

typedef void PhysTask(void *context, int chunk, int chunks);

// Calls `work` for share 0 … shares - 1 on all threads of the system, in any order; share 0 on the caller's.
void phys_parallel(const PhysSystem *system, int chunks, PhysTask *work, void *context);

// For jobs of some 10 to 50 microseconds, over before somebody who sleeps would be awake: how many threads are to do
// the next one, of so many units of work: those that are awake, if help pays; 1 only to time it, by
// phys_parallel_short, too; 0: alone, in whatever way is best then. Wakes somebody for the next ones if such jobs come
// in quick succession.
int phys_short_job_threads(const PhysSystem *system, uint64_t units);
void phys_parallel_short(const PhysSystem *system, int chunks, uint64_t units, PhysTask *work, void *context);

// Waiting within a share for what another thread has claimed: `wait` begins as {0}, and phys_spin_wait is called until
// it is over. It gives the processor away when that takes long. Share 0, which is always the caller's, then tells of
// it.
typedef struct PhysSpinWait {
    int spins;
    uint64_t since;
} PhysSpinWait;
void phys_spin_wait(PhysSpinWait *wait);
void phys_spin_wait_end(PhysThreads *threads, const PhysSpinWait *wait);

// The number of shares for `count` things: 1 if fewer than `least`, which are not worth waking a thread.
int phys_chunk_count(const PhysSystem *system, size_t count, size_t min_count);

// Where share number `share` of so many begins, if `count` things are dealt out in equal runs.
static inline size_t phys_chunk_begin(size_t count, int chunk, int chunks) {
    return (size_t)((unsigned long long)count * (unsigned)chunk / (unsigned)chunks);
}

#endif
