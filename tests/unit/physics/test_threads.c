// test_threads.c: the thread pool runs each chunk of a job once, on any thread.
#include "physics/internal.h"
#include "physics/threads.h"
#include "support.h"

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

enum { JOBS = 3000 };

// Linked with --wrap, to count the threads that have not been joined.
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *context);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *context);
int __real_pthread_join(pthread_t thread, void **result);
int __wrap_pthread_join(pthread_t thread, void **result);

static atomic_int running;

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *context) {
    int result = __real_pthread_create(thread, attributes, run, context);
    atomic_fetch_add(&running, result == 0);
    return result;
}

int __wrap_pthread_join(pthread_t thread, void **result) {
    atomic_fetch_sub(&running, 1);
    return __real_pthread_join(thread, result);
}

typedef struct Job {
    atomic_int done[PHYS_MAX_CHUNKS];
    atomic_int wrong;
    int shares;
} Job;

static void count_chunk(void *context, int chunk, int chunks) {
    Job *job = context;
    if (chunks != job->shares || chunk < 0 || chunk >= chunks)
        atomic_fetch_add(&job->wrong, 1);
    else
        atomic_fetch_add(&job->done[chunk], 1);
}

static void run_jobs(const PhysSystem *system, int jobs) {
    for (int number = 0; number < jobs; number++) {
        Job job = {.shares = 1 + number % PHYS_MAX_CHUNKS};
        phys_parallel(system, job.shares, count_chunk, &job);
        assert_int_equal(atomic_load(&job.wrong), 0);
        for (int chunk = 0; chunk < PHYS_MAX_CHUNKS; chunk++)
            assert_int_equal(atomic_load(&job.done[chunk]), chunk < job.shares);
    }
}

static void test_each_chunk_runs_once(void **state) {
    (void)state;
    for (int threads = 1; threads <= 8; threads++) {
        PhysSystem *system = phys_new();
        phys_set_options(system, &(PhysOptions){.threads = threads});
        run_jobs(system, JOBS);
        nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL); // long enough for the worker threads to fall asleep
        run_jobs(system, 10);
        assert_int_equal(atomic_load(&running), threads - 1);
        phys_free(system);
        assert_int_equal(atomic_load(&running), 0);
    }
}

static void test_systems_share_threads(void **state) {
    (void)state;
    PhysThreads *pool = phys_threads_new(3);
    PhysSystem *systems[3];
    for (int i = 0; i < 3; i++) {
        systems[i] = phys_new();
        phys_set_options(systems[i], &(PhysOptions){.threads = 3, .pool = pool});
    }
    for (int round = 0; round < 20; round++)
        for (int i = 0; i < 3; i++)
            run_jobs(systems[i], 10);
    for (int i = 0; i < 3; i++)
        phys_free(systems[i]);
    phys_threads_free(pool);
}

// Simulates preemption of threads: a helper sleeps after it has begun a chunk.
typedef struct Slow {
    pthread_t caller;
    atomic_int helped;
} Slow;

static void count_chunk_slowly(void *context, int chunk, int chunks) {
    (void)chunks;
    Slow *slow = context;
    if (pthread_equal(slow->caller, pthread_self())) {
        for (volatile int i = 0; chunk == 0 && i < 20000; i++)
            continue;
        return;
    }
    atomic_fetch_add(&slow->helped, 1);
    nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
}

// After the first job in which a helper was slow, helpers are not used for a while.
static void test_slow_threads(void **state) {
    (void)state;
    enum { MAX_TRIES = 1000000, SLOW_JOBS = 400, MAX_HELPED = 40 };
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 2});
    Slow slow = {.caller = pthread_self()};
    for (int i = 0; i < MAX_TRIES && atomic_load(&slow.helped) == 0; i++)
        phys_parallel(system, 2, count_chunk_slowly, &slow);
    assert_true(atomic_load(&slow.helped) > 0);
    for (int i = 0; i < SLOW_JOBS; i++)
        phys_parallel(system, 2, count_chunk_slowly, &slow);
    assert_true(atomic_load(&slow.helped) < MAX_HELPED);
    phys_free(system);
}

static void test_chunk_counts(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    assert_int_equal(phys_chunk_count(system, 1000000, 10), 1); // a system with one thread
    phys_set_options(system, &(PhysOptions){.threads = 2});
    assert_int_equal(phys_chunk_count(system, 9, 10), 1);
    assert_int_equal(phys_chunk_count(system, 10, 10), 2 * PHYS_CHUNKS_PER_THREAD);
    phys_set_options(system, &(PhysOptions){.threads = 64});
    assert_int_equal(phys_chunk_count(system, 10, 10), PHYS_MAX_CHUNKS);
    for (int chunks = 1; chunks <= PHYS_MAX_CHUNKS; chunks++) {
        assert_int_equal(phys_chunk_begin(1000003, 0, chunks), 0);
        assert_int_equal(phys_chunk_begin(1000003, chunks, chunks), 1000003);
    }
    phys_free(system);
}

TEST_GROUP(threads) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_chunk_runs_once),
        cmocka_unit_test(test_systems_share_threads),
        cmocka_unit_test(test_slow_threads),
        cmocka_unit_test(test_chunk_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
