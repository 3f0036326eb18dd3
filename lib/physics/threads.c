// threads.c: see threads.h.
#include "physics/threads.h"

#include "base/heap.h"
#include "physics/internal.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <unistd.h>

// What there is to claim, in one word: number of the job, whether it must be begun in order, its shares, and those
// claimed already from its front and from its back. Every other thread takes from the back, so that a thread meets much
// the same particles in each job and finds them in its cache.
enum { COUNT_BITS = 8, BACK_SHIFT = COUNT_BITS, SHARES_SHIFT = 2 * COUNT_BITS, ORDER_SHIFT = 3 * COUNT_BITS };
enum { JOB_SHIFT = ORDER_SHIFT + 1 };
_Static_assert(PHYS_MOST_SHARES < 1 << COUNT_BITS, "the number of claimed shares must fit");

enum {
    LINE_BYTES = 64, // of the cache
    PATIENCE = 4000, // looks for new work before a thread goes to sleep, and at others before it leaves the processor
};

struct PhysThreads {
    int count; // that are running, without the caller
    atomic_int serving;
    pthread_t threads[PHYS_MOST_THREADS];
    pid_t process; // which they are of: a child that was forked off has none of them
    bool started;
    void *block; // that this lies in
    int wanted;
    // the job
    PhysWork *work;
    void *context;
    _Alignas(LINE_BYTES) atomic_uint_fast64_t ticket;
    _Alignas(LINE_BYTES) atomic_int done;
    // sleep
    _Alignas(LINE_BYTES) atomic_int sleeping;
    bool stop;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
};

static int count_at(uint64_t ticket, int shift) {
    return (int)(ticket >> shift & ((1u << COUNT_BITS) - 1));
}

static bool any_left(uint64_t ticket) {
    return count_at(ticket, 0) + count_at(ticket, BACK_SHIFT) < count_at(ticket, SHARES_SHIFT);
}

// Claims a share; false if there is none. A claim keeps the job alive, so its fields may be read afterwards.
static bool claim(PhysThreads *threads, bool from_back, int *share, int *shares) {
    uint64_t ticket = atomic_load_explicit(&threads->ticket, memory_order_acquire);
    while (any_left(ticket)) {
        bool back = from_back && !(ticket >> ORDER_SHIFT & 1);
        uint64_t next = ticket + (back ? UINT64_C(1) << BACK_SHIFT : 1);
        if (atomic_compare_exchange_weak_explicit(&threads->ticket, &ticket, next, memory_order_acq_rel,
                                                  memory_order_acquire)) {
            *shares = count_at(ticket, SHARES_SHIFT);
            *share = back ? *shares - 1 - count_at(ticket, BACK_SHIFT) : count_at(ticket, 0);
            return true;
        }
    }
    return false;
}

static bool work_some(PhysThreads *threads, bool from_back) {
    int share, shares;
    bool any = false;
    while (claim(threads, from_back, &share, &shares)) {
        threads->work(threads->context, share, shares);
        atomic_fetch_add_explicit(&threads->done, 1, memory_order_release);
        any = true;
    }
    return any;
}

static inline void pause_a_little(void) {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

static bool has_work(PhysThreads *threads) {
    return any_left(atomic_load(&threads->ticket));
}

// False if the threads are to end.
static bool sleep_until_work(PhysThreads *threads) {
    pthread_mutex_lock(&threads->mutex);
    atomic_fetch_add(&threads->sleeping, 1);
    while (!threads->stop && !has_work(threads))
        pthread_cond_wait(&threads->wake, &threads->mutex);
    atomic_fetch_sub(&threads->sleeping, 1);
    bool go_on = !threads->stop;
    pthread_mutex_unlock(&threads->mutex);
    return go_on;
}

static void *serve(void *argument) {
    PhysThreads *threads = argument;
    bool from_back = atomic_fetch_add(&threads->serving, 1) % 2 == 0;
    for (;;) {
        for (int looks = 0; looks < PATIENCE; looks++) {
            if (work_some(threads, from_back))
                looks = 0;
            pause_a_little();
        }
        if (!sleep_until_work(threads))
            return NULL;
    }
}

PhysThreads *phys_threads_new(int count) {
    unsigned char *block = heap_take(sizeof(PhysThreads) + LINE_BYTES);
    if (!block)
        return NULL;
    PhysThreads *threads = (PhysThreads *)(block + LINE_BYTES - (uintptr_t)block % LINE_BYTES);
    *threads = (PhysThreads){.block = block, .process = getpid(), .wanted = count <= 0 ? cpu_count() : count};
    if (threads->wanted > PHYS_MOST_THREADS)
        threads->wanted = PHYS_MOST_THREADS;
    pthread_mutex_init(&threads->mutex, NULL);
    pthread_cond_init(&threads->wake, NULL);
    return threads;
}

// Threads that cannot be had are done without. They take no signals: those are for the host's threads.
static void start(PhysThreads *threads) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    threads->started = true;
    while (threads->count + 1 < threads->wanted &&
           pthread_create(&threads->threads[threads->count], NULL, serve, threads) == 0)
        threads->count++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void phys_threads_free(PhysThreads *threads) {
    if (!threads)
        return;
    if (threads->process != getpid()) {
        heap_give(threads->block);
        return;
    }
    pthread_mutex_lock(&threads->mutex);
    threads->stop = true;
    pthread_cond_broadcast(&threads->wake);
    pthread_mutex_unlock(&threads->mutex);
    for (int i = 0; i < threads->count; i++)
        pthread_join(threads->threads[i], NULL);
    pthread_cond_destroy(&threads->wake);
    pthread_mutex_destroy(&threads->mutex);
    heap_give(threads->block);
}

static void publish(PhysThreads *threads, bool in_order, int shares, PhysWork *work, void *context) {
    threads->work = work;
    threads->context = context;
    atomic_store_explicit(&threads->done, 0, memory_order_relaxed);
    uint64_t job = (atomic_load(&threads->ticket) >> JOB_SHIFT) + 1;
    atomic_store(&threads->ticket,
                 job << JOB_SHIFT | (uint64_t)in_order << ORDER_SHIFT | (uint64_t)shares << SHARES_SHIFT);
    if (atomic_load(&threads->sleeping) == 0)
        return;
    pthread_mutex_lock(&threads->mutex);
    pthread_cond_broadcast(&threads->wake);
    pthread_mutex_unlock(&threads->mutex);
}

static void parallel(const PhysSystem *system, bool in_order, int shares, PhysWork *work, void *context) {
    PhysThreads *threads = system->threads;
    if (threads && shares > 1 && !threads->started)
        start(threads);
    if (!threads || shares <= 1 || threads->count == 0) {
        for (int share = 0; share < shares; share++)
            work(context, share, shares);
        return;
    }
    publish(threads, in_order, shares, work, context);
    work_some(threads, false);
    for (int looks = 0; atomic_load_explicit(&threads->done, memory_order_acquire) < shares; looks++) {
        if (looks < PATIENCE)
            pause_a_little();
        else
            sched_yield();
    }
}

void phys_parallel(const PhysSystem *system, int shares, PhysWork *work, void *context) {
    parallel(system, false, shares, work, context);
}

void phys_parallel_in_order(const PhysSystem *system, int shares, PhysWork *work, void *context) {
    parallel(system, true, shares, work, context);
}

int phys_shares(const PhysSystem *system, size_t count, size_t least) {
    int threads = system->options.threads;
    if (threads < 2 || count < least)
        return 1;
    int shares = threads * PHYS_SHARES_EACH;
    return shares < PHYS_MOST_SHARES ? shares : PHYS_MOST_SHARES;
}
