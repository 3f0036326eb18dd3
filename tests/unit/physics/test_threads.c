// test_threads.c: shares of work: each is done once, whoever does it.
#include "physics/internal.h"
#include "physics/threads.h"
#include "support.h"

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

enum { JOBS = 3000 };

typedef struct Job {
    atomic_int done[PHYS_MOST_SHARES];
    atomic_int wrong;
    int shares;
} Job;

static void work(void *context, int share, int shares) {
    Job *job = context;
    if (shares != job->shares || share < 0 || share >= shares)
        atomic_fetch_add(&job->wrong, 1);
    else
        atomic_fetch_add(&job->done[share], 1);
}

static void run_jobs(const PhysSystem *system, int jobs) {
    for (int number = 0; number < jobs; number++) {
        Job job = {.shares = 1 + number % PHYS_MOST_SHARES};
        phys_parallel(system, job.shares, work, &job);
        assert_int_equal(atomic_load(&job.wrong), 0);
        for (int share = 0; share < PHYS_MOST_SHARES; share++)
            assert_int_equal(atomic_load(&job.done[share]), share < job.shares);
    }
}

static void test_each_share_once(void **state) {
    (void)state;
    for (int threads = 1; threads <= 8; threads++) {
        PhysSystem *system = phys_new();
        phys_set_options(system, &(PhysOptions){.threads = threads});
        run_jobs(system, JOBS);
        nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL); // long enough to fall asleep
        run_jobs(system, 10);
        phys_free(system);
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

// Threads that others keep from working: whoever has begun a share falls asleep.
typedef struct Slow {
    pthread_t caller;
    atomic_int helped;
} Slow;

static void work_slowly(void *context, int share, int shares) {
    (void)shares;
    Slow *slow = context;
    if (pthread_equal(slow->caller, pthread_self())) {
        for (volatile int i = 0; share == 0 && i < 20000; i++)
            continue;
        return;
    }
    atomic_fetch_add(&slow->helped, 1);
    nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
}

// Nobody is asked any more after the first time, for a while.
static void test_slow_threads(void **state) {
    (void)state;
    enum { MOST_TRIES = 1000000, SLOW_JOBS = 400, MOST_HELPED = 40 };
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 2});
    Slow slow = {.caller = pthread_self()};
    for (int i = 0; i < MOST_TRIES && atomic_load(&slow.helped) == 0; i++)
        phys_parallel(system, 2, work_slowly, &slow);
    assert_true(atomic_load(&slow.helped) > 0);
    for (int i = 0; i < SLOW_JOBS; i++)
        phys_parallel(system, 2, work_slowly, &slow);
    assert_true(atomic_load(&slow.helped) < MOST_HELPED);
    phys_free(system);
}

static void test_shares_of_counts(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    assert_int_equal(phys_shares(system, 1000000, 10), 1); // one thread
    phys_set_options(system, &(PhysOptions){.threads = 2});
    assert_int_equal(phys_shares(system, 9, 10), 1);
    assert_int_equal(phys_shares(system, 10, 10), 2 * PHYS_SHARES_EACH);
    phys_set_options(system, &(PhysOptions){.threads = 64});
    assert_int_equal(phys_shares(system, 10, 10), PHYS_MOST_SHARES);
    for (int shares = 1; shares <= PHYS_MOST_SHARES; shares++) {
        assert_int_equal(phys_share(1000003, 0, shares), 0);
        assert_int_equal(phys_share(1000003, shares, shares), 1000003);
    }
    phys_free(system);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_share_once),
        cmocka_unit_test(test_systems_share_threads),
        cmocka_unit_test(test_slow_threads),
        cmocka_unit_test(test_shares_of_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
