// threads.c: the thread pool and the claiming of chunks (threads.h).
#include "physics/threads.h"

#include "base/clock.h"
#include "base/heap.h"
#include "base/os.h"
#include "physics/backoff.h"
#include "physics/internal.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <unistd.h>

// The ticket is a 64-bit word. Its fields are, from the high bits: the number of the job, the number of its chunks, how
// many of these are claimed from the back, and how many from the front. Half of the threads claim from the back. So
// a thread processes nearly the same particles in each job and finds them in its cache.
enum { COUNT_BITS = 8, BACK_SHIFT = COUNT_BITS, CHUNKS_SHIFT = 2 * COUNT_BITS, JOB_SHIFT = 3 * COUNT_BITS };
_Static_assert(PHYS_MAX_CHUNKS < 1 << COUNT_BITS, "the number of claimed chunks must fit");

enum {
    TUNERS = 3,
    MIN_TUNER_BITS = 13,   // the tuners are for jobs below 2^14 units, below 2^15 units, and above
    CACHE_LINE_BYTES = 64, // size of a cache line
    POLLS_PER_CHECK = 64,  // polls between two readings of the clock
    SPIN_NS = 50000,       // time for which a thread polls for work before it sleeps; about as long as waking takes
    YIELD_NS = 50000       // time for which a thread polls for other threads before it yields the processor
};

struct PhysThreads {
    int count;          // number of created threads, without the caller
    atomic_int serving; // number of threads that have begun to run
    pthread_t threads[PHYS_MAX_THREADS];
    pid_t process; // process that created the pool; a forked child has none of its threads
    bool started;
    void *block; // allocated memory that contains this struct
    int wanted;  // intended number of threads, with the caller
    // used by the caller only
    PhysBackoff backoff;
    PhysTuner tuners[TUNERS]; // by the size of a short job
    uint64_t last_request;    // time at which has_awake_helper last found no thread awake
    uint64_t waited;          // nanoseconds that the caller has waited in the current job
    bool helped;              // a helper took part in the last job
    // the job; its fields are in one cache line, because other threads read them first
    _Alignas(CACHE_LINE_BYTES) atomic_uint_fast64_t ticket;
    PhysTask *work;
    void *context;
    _Alignas(CACHE_LINE_BYTES) atomic_uint done; // number of chunks that helpers have finished, in all jobs so far
    // sleeping
    _Alignas(CACHE_LINE_BYTES) atomic_int sleeping;
    atomic_uint wakeups;          // number of broadcasts of `wake`
    atomic_uint answered_wakeups; // value of `wakeups` to which a thread last responded
    bool stop;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
};

static int count_at(uint64_t ticket, int shift) {
    return (int)(ticket >> shift & ((1u << COUNT_BITS) - 1));
}

static bool any_left(uint64_t ticket) {
    return count_at(ticket, 0) + count_at(ticket, BACK_SHIFT) < count_at(ticket, CHUNKS_SHIFT);
}

// Claims a chunk. Returns false if none is left. A job does not end before all claimed chunks are finished, so the
// fields of the job stay valid until then.
static bool claim_chunk(PhysThreads *threads, bool from_back, int *chunk, int *chunks) {
    uint64_t ticket = atomic_load_explicit(&threads->ticket, memory_order_acquire);
    while (any_left(ticket)) {
        uint64_t next = ticket + (from_back ? UINT64_C(1) << BACK_SHIFT : 1);
        if (atomic_compare_exchange_weak_explicit(&threads->ticket, &ticket, next, memory_order_acq_rel,
                                                  memory_order_acquire)) {
            *chunks = count_at(ticket, CHUNKS_SHIFT);
            *chunk = from_back ? *chunks - 1 - count_at(ticket, BACK_SHIFT) : count_at(ticket, 0);
            return true;
        }
    }
    return false;
}

// Runs chunks until none is left, and returns how many it has run.
static int run_chunks(PhysThreads *threads, bool helping, bool from_back) {
    int chunk, chunks, count = 0;
    for (; claim_chunk(threads, from_back, &chunk, &chunks); count++) {
        threads->work(threads->context, chunk, chunks);
        if (helping)
            atomic_fetch_add_explicit(&threads->done, 1, memory_order_release);
    }
    return count;
}

static inline void cpu_relax(void) {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

static bool has_work(PhysThreads *threads) {
    return any_left(atomic_load(&threads->ticket));
}

// Sleeps until there may be work. Returns false if the threads must exit.
static bool sleep_until_woken(PhysThreads *threads) {
    pthread_mutex_lock(&threads->mutex);
    unsigned calls = atomic_load(&threads->wakeups);
    atomic_store(&threads->answered_wakeups, calls);
    atomic_fetch_add(&threads->sleeping, 1);
    while (!threads->stop && !has_work(threads) && atomic_load(&threads->wakeups) == calls)
        pthread_cond_wait(&threads->wake, &threads->mutex);
    atomic_fetch_sub(&threads->sleeping, 1);
    atomic_store(&threads->answered_wakeups, atomic_load(&threads->wakeups));
    bool keep_running = !threads->stop;
    pthread_mutex_unlock(&threads->mutex);
    return keep_running;
}

static void poll_for_work(PhysThreads *threads, bool from_back) {
    uint64_t last = clock_nanoseconds(), now = last;
    while (now - last < SPIN_NS) {
        bool any = false;
        for (int polls = 0; polls < POLLS_PER_CHECK; polls++) {
            any |= run_chunks(threads, true, from_back) > 0;
            cpu_relax();
        }
        now = clock_nanoseconds();
        last = any ? now : last;
    }
}

static void *worker_main(void *argument) {
    PhysThreads *threads = argument;
    bool from_back = atomic_fetch_add(&threads->serving, 1) % 2 == 0;
    do
        poll_for_work(threads, from_back);
    while (sleep_until_woken(threads));
    return NULL;
}

PhysThreads *phys_threads_new(int count) {
    unsigned char *block = heap_alloc(sizeof(PhysThreads) + CACHE_LINE_BYTES);
    if (!block)
        return NULL;
    PhysThreads *threads = (PhysThreads *)(block + CACHE_LINE_BYTES - (uintptr_t)block % CACHE_LINE_BYTES);
    *threads = (PhysThreads){.block = block, .process = getpid(), .wanted = count <= 0 ? os_processor_count() : count};
    if (threads->wanted > PHYS_MAX_THREADS)
        threads->wanted = PHYS_MAX_THREADS;
    pthread_mutex_init(&threads->mutex, NULL);
    pthread_cond_init(&threads->wake, NULL);
    return threads;
}

// Starts the threads, or as many as the operating system allows. They block all signals, so that only the host's
// threads receive them.
static void start_threads(PhysThreads *threads) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    threads->started = true;
    while (threads->count + 1 < threads->wanted &&
           pthread_create(&threads->threads[threads->count], NULL, worker_main, threads) == 0)
        threads->count++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void phys_threads_free(PhysThreads *threads) {
    if (!threads)
        return;
    if (threads->process != getpid()) {
        heap_free(threads->block);
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
    heap_free(threads->block);
}

// Wakes sleeping threads, unless an earlier wakeup is still in progress.
static void wake_threads(PhysThreads *threads) {
    if (atomic_load(&threads->sleeping) == 0 ||
        atomic_load(&threads->answered_wakeups) != atomic_load(&threads->wakeups))
        return;
    pthread_mutex_lock(&threads->mutex);
    atomic_fetch_add(&threads->wakeups, 1);
    pthread_cond_broadcast(&threads->wake);
    pthread_mutex_unlock(&threads->mutex);
}

// Publishes a job whose first chunk is already claimed for the caller.
static void publish_job(PhysThreads *threads, int chunks, PhysTask *work, void *context) {
    threads->work = work;
    threads->context = context;
    uint64_t job = (atomic_load_explicit(&threads->ticket, memory_order_relaxed) >> JOB_SHIFT) + 1;
    atomic_store(&threads->ticket, job << JOB_SHIFT | (uint64_t)chunks << CHUNKS_SHIFT | 1);
    wake_threads(threads);
}

void phys_spin_wait(PhysSpinWait *wait) {
    cpu_relax();
    if (++wait->spins % POLLS_PER_CHECK)
        return;
    uint64_t now = clock_nanoseconds();
    if (!wait->since)
        wait->since = now;
    else if (now - wait->since > YIELD_NS)
        sched_yield();
}

void phys_spin_wait_end(PhysThreads *threads, const PhysSpinWait *wait) {
    if (wait->since)
        threads->waited += clock_nanoseconds() - wait->since;
}

static void run_in_parallel(PhysThreads *threads, int chunks, PhysTask *work, void *context) {
    PhysJobTimes job = {.begin = clock_nanoseconds()};
    unsigned before = atomic_load_explicit(&threads->done, memory_order_relaxed);
    threads->waited = 0;
    publish_job(threads, chunks, work, context);
    work(context, 0, chunks);
    unsigned others = (unsigned)(chunks - 1 - run_chunks(threads, false, false));
    PhysSpinWait wait = {0};
    while (atomic_load_explicit(&threads->done, memory_order_acquire) - before < others)
        phys_spin_wait(&wait);
    phys_spin_wait_end(threads, &wait);
    job.end = clock_nanoseconds();
    job.waited = threads->waited;
    job.answered = threads->helped = others > 0;
    phys_backoff_learn(&threads->backoff, &job);
}

static bool has_helpers(PhysThreads *threads) {
    if (threads && !threads->started)
        start_threads(threads);
    return threads && threads->count > 0 && !phys_backoff_pauses(&threads->backoff, clock_nanoseconds());
}

// Returns true if a helper is awake. If not, and if short jobs come in quick succession, wakes helpers for later jobs.
static bool has_awake_helper(PhysThreads *threads) {
    uint64_t now = clock_nanoseconds();
    if (phys_backoff_pauses(&threads->backoff, now))
        return false;
    if (threads->count > 0 && atomic_load(&threads->sleeping) < threads->count)
        return true;
    bool soon = now - threads->last_request < SPIN_NS;
    threads->last_request = now;
    if (soon && has_helpers(threads))
        wake_threads(threads);
    return false;
}

static PhysTuner *tuner_of(PhysThreads *threads, uint64_t units) {
    int number = 0;
    while (number + 1 < TUNERS && units >> (MIN_TUNER_BITS + 1 + number))
        number++;
    return &threads->tuners[number];
}

int phys_short_job_threads(const PhysSystem *system, uint64_t units) {
    PhysThreads *threads = system->threads;
    if (!threads || (threads->started && threads->count == 0))
        return 0;
    PhysTuner *tuner = tuner_of(threads, units);
    if (phys_tuner_should_help(tuner))
        return has_awake_helper(threads) ? threads->wanted : 0;
    return phys_tuner_skip(tuner) ? 0 : 1;
}

void phys_parallel_short(const PhysSystem *system, int chunks, uint64_t units, PhysTask *work, void *context) {
    PhysTuner *tuner = tuner_of(system->threads, units);
    system->threads->helped = false;
    uint64_t begin = clock_nanoseconds();
    phys_parallel(system, chunks, work, context);
    if (chunks == 1 || system->threads->helped)
        phys_tuner_learn(tuner, chunks > 1, (double)(clock_nanoseconds() - begin) / (double)units);
}

void phys_threads_run(PhysThreads *threads, int chunks, PhysTask *work, void *context) {
    if (chunks > 1 && has_helpers(threads)) {
        run_in_parallel(threads, chunks, work, context);
        return;
    }
    for (int chunk = 0; chunk < chunks; chunk++)
        work(context, chunk, chunks);
}

void phys_parallel(const PhysSystem *system, int chunks, PhysTask *work, void *context) {
    phys_threads_run(chunks > 1 ? system->threads : NULL, chunks, work, context);
}

static int chunks_for(int threads) {
    int chunks = threads * PHYS_CHUNKS_PER_THREAD;
    return threads < 2 ? 1 : chunks < PHYS_MAX_CHUNKS ? chunks : PHYS_MAX_CHUNKS;
}

int phys_threads_chunks(const PhysThreads *threads) {
    return threads ? chunks_for(threads->wanted) : 1;
}

int phys_chunk_count(const PhysSystem *system, size_t count, size_t min_count) {
    return count < min_count ? 1 : chunks_for(system->options.threads);
}
