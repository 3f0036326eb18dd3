// threads.h: a thread pool for physics.
//
// A job is divided into chunks, which idle threads and the caller claim in turn. The caller waits only for chunks that
// other threads have claimed. After long waits it works alone for a while (backoff.h). A chunk's work depends only on
// its number. Idle threads spin briefly before they sleep. Short jobs use only spinning threads.
#pragma once

#include "physics/system.h"

enum {
    PHYS_MAX_THREADS = 64,
    PHYS_MAX_CHUNKS = 64,
    PHYS_CHUNKS_PER_THREAD = 4, // number of chunks per thread, if the work can be divided freely
};

typedef void PhysTask(void *context, int chunk, int chunks);

// Calls `work` for chunks 0 to chunks - 1, in any order, on the caller's thread and idle threads of the pool. Chunk 0
// runs on the caller's thread. If there is only one chunk, `system` may be NULL.
void phys_parallel(const PhysSystem *system, int chunks, PhysTask *work, void *context);

// Like phys_parallel, for work that does not belong to a system. If `threads` is NULL, the caller does all of it.
void phys_threads_run(PhysThreads *threads, int chunks, PhysTask *work, void *context);
// Returns the number of chunks for work that can be divided freely: 1 if `threads` is NULL.
int phys_threads_chunks(const PhysThreads *threads);

// Returns how many threads to use for a job of `units` of work that takes 10 to 50 µs, which is too short to wake a
// sleeping thread. 0: do the work without phys_parallel_short. 1: call phys_parallel_short with one chunk, which runs
// on the caller's thread and is timed. If such jobs arrive in quick succession, wakes sleeping threads for later jobs.
int phys_short_job_threads(const PhysSystem *system, uint64_t units);
// Like phys_parallel, but for a short job. phys_short_job_threads must have returned at least 1 for these `units`.
void phys_parallel_short(const PhysSystem *system, int chunks, uint64_t units, PhysTask *work, void *context);

// State of a wait inside a chunk for work that another thread has claimed. Initialise it with {0}, then call
// phys_spin_wait until the work is done. phys_spin_wait yields the processor if the wait is long. If chunk 0 has
// waited, it must report this with phys_spin_wait_end, because it runs on the caller's thread.
typedef struct PhysSpinWait {
    int spins;
    uint64_t since;
} PhysSpinWait;
void phys_spin_wait(PhysSpinWait *wait);
void phys_spin_wait_end(PhysThreads *threads, const PhysSpinWait *wait);

// Returns the number of chunks for `count` elements: 1 if `count` is below `min_count`, because several threads would
// not pay off.
int phys_chunk_count(const PhysSystem *system, size_t count, size_t min_count);

// Returns the first element of a chunk if `count` elements are divided evenly.
static inline size_t phys_chunk_begin(size_t count, int chunk, int chunks) {
    return (size_t)((unsigned long long)count * (unsigned)chunk / (unsigned)chunks);
}
