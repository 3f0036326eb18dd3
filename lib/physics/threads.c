// threads.c: see threads.h.
#include "physics/threads.h"

#include "base/heap.h"
#include "physics/help.h"
#include "physics/internal.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <time.h>
#include <unistd.h>

// What there is to claim, in one word: number of the job, its shares, and those claimed already from its front and from
// its back. Every other thread takes from the back, so that a thread meets much
// the same particles in each job and finds them in its cache.
enum { COUNT_BITS = 8, BACK_SHIFT = COUNT_BITS, SHARES_SHIFT = 2 * COUNT_BITS, JOB_SHIFT = 3 * COUNT_BITS };
_Static_assert(PHYS_MOST_SHARES < 1 << COUNT_BITS, "the number of claimed shares must fit");

enum {
    TRIALS = 3,
    TRIAL_LEAST = 13,   // the first is of jobs below twice 2^13 units, the last of all that are larger
    LINE_BYTES = 64,    // of the cache
    LOOKS = 64,         // for work or at others, between two looks at the clock
    ALERT_NS = 50000,   // a thread looks for new work before it goes to sleep: as long as it takes to be awake again
    PATIENCE_NS = 50000 // and at others before it leaves the processor
};

struct PhysThreads {
    int count; // that are running, without the caller
    atomic_int serving;
    pthread_t threads[PHYS_MOST_THREADS];
    pid_t process; // which they are of: a child that was forked off has none of them
    bool started;
    void *block; // that this lies in
    int wanted;
    // of the caller
    PhysHelp help;
    PhysTrial trials[TRIALS]; // by the size of a brief job
    uint64_t asked;           // when phys_help_at_hand found nobody awake
    uint64_t waited;          // nanoseconds in this job
    bool helped;              // the last job was
    // the job, in one line: what others must fetch first
    _Alignas(LINE_BYTES) atomic_uint_fast64_t ticket;
    PhysWork *work;
    void *context;
    _Alignas(LINE_BYTES) atomic_uint done; // shares that others have done, of all jobs
    // sleep
    _Alignas(LINE_BYTES) atomic_int sleeping;
    atomic_uint calls;    // to wake up
    atomic_uint answered; // the last of them that somebody has followed
    bool stop;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
};

static uint64_t nanoseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000 + (uint64_t)now.tv_nsec;
}

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
        uint64_t next = ticket + (from_back ? UINT64_C(1) << BACK_SHIFT : 1);
        if (atomic_compare_exchange_weak_explicit(&threads->ticket, &ticket, next, memory_order_acq_rel,
                                                  memory_order_acquire)) {
            *shares = count_at(ticket, SHARES_SHIFT);
            *share = from_back ? *shares - 1 - count_at(ticket, BACK_SHIFT) : count_at(ticket, 0);
            return true;
        }
    }
    return false;
}

// Returns how many shares it has done.
static int work_some(PhysThreads *threads, bool helping, bool from_back) {
    int share, shares, count = 0;
    for (; claim(threads, from_back, &share, &shares); count++) {
        threads->work(threads->context, share, shares);
        if (helping)
            atomic_fetch_add_explicit(&threads->done, 1, memory_order_release);
    }
    return count;
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
static bool sleep_until_called(PhysThreads *threads) {
    pthread_mutex_lock(&threads->mutex);
    unsigned calls = atomic_load(&threads->calls);
    atomic_store(&threads->answered, calls);
    atomic_fetch_add(&threads->sleeping, 1);
    while (!threads->stop && !has_work(threads) && atomic_load(&threads->calls) == calls)
        pthread_cond_wait(&threads->wake, &threads->mutex);
    atomic_fetch_sub(&threads->sleeping, 1);
    atomic_store(&threads->answered, atomic_load(&threads->calls));
    bool go_on = !threads->stop;
    pthread_mutex_unlock(&threads->mutex);
    return go_on;
}

static void serve_while_alert(PhysThreads *threads, bool from_back) {
    uint64_t last = nanoseconds(), now = last;
    while (now - last < ALERT_NS) {
        bool any = false;
        for (int looks = 0; looks < LOOKS; looks++) {
            any |= work_some(threads, true, from_back) > 0;
            pause_a_little();
        }
        now = nanoseconds();
        last = any ? now : last;
    }
}

static void *serve(void *argument) {
    PhysThreads *threads = argument;
    bool from_back = atomic_fetch_add(&threads->serving, 1) % 2 == 0;
    do
        serve_while_alert(threads, from_back);
    while (sleep_until_called(threads));
    return NULL;
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

// Wakes those who sleep, unless they are on their way already.
static void call(PhysThreads *threads) {
    if (atomic_load(&threads->sleeping) == 0 || atomic_load(&threads->answered) != atomic_load(&threads->calls))
        return;
    pthread_mutex_lock(&threads->mutex);
    atomic_fetch_add(&threads->calls, 1);
    pthread_cond_broadcast(&threads->wake);
    pthread_mutex_unlock(&threads->mutex);
}

// The first share is the caller's.
static void publish(PhysThreads *threads, int shares, PhysWork *work, void *context) {
    threads->work = work;
    threads->context = context;
    uint64_t job = (atomic_load_explicit(&threads->ticket, memory_order_relaxed) >> JOB_SHIFT) + 1;
    atomic_store(&threads->ticket, job << JOB_SHIFT | (uint64_t)shares << SHARES_SHIFT | 1);
    call(threads);
}

void phys_wait(PhysWait *wait) {
    pause_a_little();
    if (++wait->looks % LOOKS)
        return;
    uint64_t now = nanoseconds();
    if (!wait->since)
        wait->since = now;
    else if (now - wait->since > PATIENCE_NS)
        sched_yield();
}

void phys_wait_end(PhysThreads *threads, const PhysWait *wait) {
    if (wait->since)
        threads->waited += nanoseconds() - wait->since;
}

static void help_each_other(PhysThreads *threads, int shares, PhysWork *work, void *context) {
    PhysJobTimes job = {.begin = nanoseconds()};
    unsigned before = atomic_load_explicit(&threads->done, memory_order_relaxed);
    threads->waited = 0;
    publish(threads, shares, work, context);
    work(context, 0, shares);
    unsigned others = (unsigned)(shares - 1 - work_some(threads, false, false));
    PhysWait wait = {0};
    while (atomic_load_explicit(&threads->done, memory_order_acquire) - before < others)
        phys_wait(&wait);
    phys_wait_end(threads, &wait);
    job.end = nanoseconds();
    job.waited = threads->waited;
    job.answered = threads->helped = others > 0;
    phys_help_learn(&threads->help, &job);
}

static bool any_helpers(PhysThreads *threads) {
    if (threads && !threads->started)
        start(threads);
    return threads && threads->count > 0 && !phys_help_pauses(&threads->help, nanoseconds());
}

// Somebody is awake, or will be for one of the next jobs if they come quickly.
static bool is_at_hand(PhysThreads *threads) {
    uint64_t now = nanoseconds();
    if (phys_help_pauses(&threads->help, now))
        return false;
    if (threads->count > 0 && atomic_load(&threads->sleeping) < threads->count)
        return true;
    bool soon = now - threads->asked < ALERT_NS;
    threads->asked = now;
    if (soon && any_helpers(threads))
        call(threads);
    return false;
}

static PhysTrial *trial_of(PhysThreads *threads, uint64_t units) {
    int number = 0;
    while (number + 1 < TRIALS && units >> (TRIAL_LEAST + 1 + number))
        number++;
    return &threads->trials[number];
}

int phys_brief_threads(const PhysSystem *system, uint64_t units) {
    PhysThreads *threads = system->threads;
    if (!threads || (threads->started && threads->count == 0))
        return 0;
    PhysTrial *trial = trial_of(threads, units);
    if (phys_trial_asks(trial))
        return is_at_hand(threads) ? threads->wanted : 0;
    return phys_trial_skips(trial) ? 0 : 1;
}

void phys_parallel_brief(const PhysSystem *system, int shares, uint64_t units, PhysWork *work, void *context) {
    PhysTrial *trial = trial_of(system->threads, units);
    system->threads->helped = false;
    uint64_t begin = nanoseconds();
    phys_parallel(system, shares, work, context);
    if (shares == 1 || system->threads->helped)
        phys_trial_learn(trial, shares > 1, (double)(nanoseconds() - begin) / (double)units);
}

void phys_parallel(const PhysSystem *system, int shares, PhysWork *work, void *context) {
    if (shares > 1 && any_helpers(system->threads)) {
        help_each_other(system->threads, shares, work, context);
        return;
    }
    for (int share = 0; share < shares; share++)
        work(context, share, shares);
}

int phys_shares(const PhysSystem *system, size_t count, size_t least) {
    int threads = system->options.threads;
    if (threads < 2 || count < least)
        return 1;
    int shares = threads * PHYS_SHARES_EACH;
    return shares < PHYS_MOST_SHARES ? shares : PHYS_MOST_SHARES;
}
