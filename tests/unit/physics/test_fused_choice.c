// test_fused_choice.c: the faster way to compute roots is found from the times of steps (fused_choice.h).
#include "physics/fused_choice.h"
#include "support.h"

// Takes `steps` steps, whose pairs need these times in ns. Each fifth step is disturbed. Returns the number of steps
// that used fused multiply-add.
static int play(FusedChoice *choice, int steps, uint64_t pairs, double divider, double fused) {
    int used = 0;
    for (int i = 0; i < steps; i++) {
        phys_fused_next_step(choice);
        bool now = phys_fused_chosen(choice);
        used += now;
        if (phys_fused_measures(choice))
            for (int part = 0; part < 2; part++) // a step can have several passes
                phys_fused_learn(choice, pairs / 2,
                                 (uint64_t)((double)(pairs / 2) * (now ? fused : divider)) + (i % 5 ? 0 : pairs * 10));
    }
    return used;
}

static void test_faster_way_is_used_after_few_steps(void **state) {
    (void)state;
    FusedChoice faster = {0}, slower = {0}, large = {0};
    assert_int_equal(play(&faster, 1000, 2000, 1.4, 1.0), 1000 - FUSED_MAX_PROBES);
    assert_int_equal(play(&slower, 1000, 2000, 1.0, 1.4), FUSED_MAX_PROBES);
    // Two steps of each way are enough if they are long.
    assert_int_equal(play(&large, 100, 1000000, 1.4, 1.0), 100 - FUSED_MIN_PROBES);
}

static void test_change_of_speed_is_noticed(void **state) {
    (void)state;
    FusedChoice choice = {0};
    play(&choice, FUSED_PERIOD, 2000, 1.4, 1.0);
    assert_true(phys_fused_chosen(&choice));
    play(&choice, 2 * FUSED_MAX_PROBES + 1, 2000, 1.0, 1.4);
    assert_false(phys_fused_chosen(&choice));
}

static void test_forced_ways_are_never_measured(void **state) {
    (void)state;
    FusedChoice never = {.use = CPU_FMA_NEVER}, always = {.use = CPU_FMA_ALWAYS};
    for (int i = 0; i < 100; i++) {
        phys_fused_next_step(&never);
        phys_fused_next_step(&always);
        assert_false(phys_fused_measures(&never) || phys_fused_chosen(&never));
        assert_true(!phys_fused_measures(&always) && phys_fused_chosen(&always));
    }
}

static void test_steps_with_few_pairs_decide_nothing(void **state) {
    (void)state;
    FusedChoice choice = {0};
    assert_int_equal(play(&choice, 1000, FUSED_MIN_PAIRS - 2, 1.4, 1.0), 0);
}

TEST_GROUP(fused_choice) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_faster_way_is_used_after_few_steps),
                                       cmocka_unit_test(test_change_of_speed_is_noticed),
                                       cmocka_unit_test(test_forced_ways_are_never_measured),
                                       cmocka_unit_test(test_steps_with_few_pairs_decide_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
