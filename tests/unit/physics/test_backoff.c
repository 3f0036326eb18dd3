// test_backoff.c: tests when helper threads are used, on a quiet and on a busy machine, in simulated time.
#include "physics/backoff.h"
#include "support.h"

// A simulated machine. A job takes ALONE nanoseconds without a helper and HELPED with one.
enum { ALONE = 20000, HELPED = 12000, SECOND = 1000000000 };

typedef struct Machine {
    PhysBackoff help;
    uint64_t now;
    uint64_t worked; // time that all jobs would take without helpers, in nanoseconds
    uint64_t asked;  // number of jobs offered to helpers
} Machine;

// Returns how long the caller waits for a helper that begins a chunk at `now`. UINT64_MAX: no helper comes.
typedef uint64_t Answer(uint64_t now);

static void play_jobs(Machine *machine, Answer *answer, uint64_t duration) {
    for (uint64_t end = machine->now + duration; machine->now < end; machine->worked += ALONE) {
        PhysJobTimes job = {.begin = machine->now};
        if (phys_backoff_pauses(&machine->help, machine->now)) {
            machine->now += ALONE;
            continue;
        }
        machine->asked++;
        uint64_t waited = answer(machine->now);
        job.answered = waited != UINT64_MAX;
        job.waited = job.answered ? waited : 0;
        job.end = machine->now += job.answered ? HELPED + waited : ALONE;
        phys_backoff_learn(&machine->help, &job);
    }
}

static uint64_t answer_at_once(uint64_t now) {
    (void)now;
    return 0;
}

static uint64_t answer_never(uint64_t now) {
    (void)now;
    return UINT64_MAX;
}

// Another process uses the helper's processor for 4 of 8 ms.
static uint64_t answer_half_of_the_time(uint64_t now) {
    return now % 8000000 < 4000000 ? 0 : 8000000 - now % 8000000;
}

// Another process uses the helper's processor for 1 of 16 ms.
static uint64_t answer_most_of_the_time(uint64_t now) {
    return now % 16000000 < 15000000 ? 0 : 16000000 - now % 16000000;
}

// The helper is always preempted as soon as it has begun a chunk.
static uint64_t answer_always_late(uint64_t now) {
    (void)now;
    return 4000000;
}

static double ratio(const Machine *machine) {
    return (double)machine->now / (double)machine->worked;
}

static void test_helpers_that_answer_at_once_are_always_used(void **state) {
    (void)state;
    Machine machine = {0};
    play_jobs(&machine, answer_at_once, SECOND);
    assert_near(ratio(&machine), (double)HELPED / ALONE, 1e-9);
    assert_int_equal(machine.help.pause_length, 0);
}

// The jobs take at most one or two per cent longer than without helpers.
static void test_late_helpers_cost_at_most_two_per_cent(void **state) {
    (void)state;
    Answer *answers[] = {answer_half_of_the_time, answer_always_late, answer_never};
    for (size_t i = 0; i < COUNT_OF(answers); i++) {
        Machine machine = {0};
        play_jobs(&machine, answers[i], 10ull * SECOND);
        assert_true(ratio(&machine) < 1.02);
        assert_true(machine.asked * ALONE < machine.worked / 10);
    }
}

static void test_helpers_that_mostly_answer_stay_in_use(void **state) {
    (void)state;
    Machine machine = {0};
    play_jobs(&machine, answer_most_of_the_time, 10ull * SECOND);
    assert_true(ratio(&machine) < 0.75);
}

// After the other process has ended, helpers are used again within a second.
static void test_quiet_again(void **state) {
    (void)state;
    Answer *answers[] = {answer_half_of_the_time, answer_always_late, answer_never};
    for (size_t i = 0; i < COUNT_OF(answers); i++) {
        Machine machine = {0};
        play_jobs(&machine, answers[i], 10ull * SECOND);
        play_jobs(&machine, answer_at_once, SECOND);
        uint64_t asked = machine.asked, before = machine.now;
        play_jobs(&machine, answer_at_once, SECOND);
        assert_int_equal(machine.asked - asked, (machine.now - before) / HELPED);
    }
}

static void test_helpers_pause_after_too_many_unanswered_jobs(void **state) {
    (void)state;
    PhysBackoff help = {0};
    PhysJobTimes alone = {.begin = 100, .end = 200}, helped = {.begin = 200, .end = 300, .answered = true};
    for (int i = 1; i < 10 * PHYS_MAX_UNANSWERED; i++)
        phys_backoff_learn(&help, i % PHYS_MAX_UNANSWERED ? &alone : &helped);
    assert_false(phys_backoff_pauses(&help, 301));
    phys_backoff_learn(&help, &alone);
    assert_true(phys_backoff_pauses(&help, 201));
}

// Runs jobs that take `helped` with a helper and `alone` without. Returns their mean time in the last periods.
static double play_tuner(PhysTuner *tuner, double alone, double helped) {
    enum { JOBS = 8 * PHYS_TUNER_PERIOD };
    double sum = 0;
    for (int i = 0; i < JOBS; i++) {
        bool asks = phys_tuner_should_help(tuner);
        double took = asks ? helped : alone;
        if (asks || !phys_tuner_skip(tuner))
            phys_tuner_learn(tuner, asks, i % 50 ? took : took * 100); // every 50th job is disturbed and takes 100
                                                                       // times as long
        sum += i < JOBS / 2 ? 0 : took;
    }
    return sum / (JOBS / 2);
}

// The tuner finds the faster alternative, and finds it again after the other one has become faster.
static void test_tuner_picks_faster(void **state) {
    (void)state;
    PhysTuner tuner = {0};
    assert_true(play_tuner(&tuner, 20, 12) < 12.3);
    assert_true(play_tuner(&tuner, 20, 24) < 20.3);
    assert_true(play_tuner(&tuner, 20, 12) < 12.3);
}

TEST_GROUP(backoff) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_helpers_that_answer_at_once_are_always_used),
        cmocka_unit_test(test_late_helpers_cost_at_most_two_per_cent),
        cmocka_unit_test(test_helpers_that_mostly_answer_stay_in_use),
        cmocka_unit_test(test_quiet_again),
        cmocka_unit_test(test_helpers_pause_after_too_many_unanswered_jobs),
        cmocka_unit_test(test_tuner_picks_faster),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
