// test_session_trust.c: runs with shorter steps and other starting positions (petri_vary), and how far results can be
// trusted (petri_trust). tests/trust compares the stated errors with the true ones.
#include "petri-inspect.h"
#include "petri-live.h"
#include "player.h"

#include <float.h>
#include <math.h>

#define SPRING                                                                                                         \
    "    !anchor id=:wall\n"                                                                                           \
    "    !particle id=:ball position=1.5\n"                                                                            \
    "    !distance from=:wall to=:ball fixed=1\n"

static void vary(Player *player, PetriVariation variation) {
    variation.size = sizeof variation;
    assert_int_equal(petri_vary(player->session, &variation), PETRI_OK);
}

static double evaluate(Player *player, const char *expression) {
    PetriEvaluation result;
    assert_int_equal(
        petri_evaluate(player->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
        PETRI_OK);
    return result.number;
}

// Returns the value of an expression after some frames of a varied run.
static double value_after(Player *player, const char *script, int frames, PetriVariation variation,
                          const char *expression) {
    assert_int_equal(player_load(player, script), PETRI_OK);
    petri_reset(player->session);
    vary(player, variation);
    player_step(player, frames);
    return evaluate(player, expression);
}

static void test_parts_are_steps_of_that_length(void **state) {
    static const char *const ball = "$(:s;:ball)";
    static const char *const head = "%%pragma fps 64\n!physics state=:s dimensions=1 resolution=1/%d\n" SPRING;
    char whole[400], half[400];
    snprintf(whole, sizeof whole, head, 128);
    snprintf(half, sizeof half, head, 512);
    double parts = value_after(*state, whole, 100, (PetriVariation){.parts = 4}, ball);
    assert_number("one part", value_after(*state, whole, 100, (PetriVariation){.parts = 1}, ball),
                  value_after(*state, whole, 100, (PetriVariation){0}, ball));
    assert_number("four parts", parts, value_after(*state, half, 100, (PetriVariation){0}, ball));
}

// Without other forces, all parts of a step add the same velocity, so their number does not matter.
static void test_random_forces_are_constant_in_a_step(void **state) {
    static const char *const script = "!physics state=:s dimensions=2 resolution=1/120\n"
                                      "    !particle id=0\n    !group\n        !particle id=1\n        !random\n"
                                      "    !random strength=3\n";
    for (int axis = 0; axis < 2; axis++) {
        char expression[40];
        snprintf(expression, sizeof expression, "$(:s;1;:velocity)[%d]", axis);
        double whole = value_after(*state, script, 60, (PetriVariation){0}, expression);
        double parts = value_after(*state, script, 60, (PetriVariation){.parts = 16}, expression);
        assert_true(fabs(whole) > 0.01 && fabs(parts - whole) < 1e-13);
    }
}

static void test_shift_moves_particles_by_a_part_of_the_size(void **state) {
    static const char *const script = "!physics state=:s dimensions=2\n    !anchor id=:a position=-3;0\n"
                                      "    !particle id=0 position=0;1\n    !particle id=1 position=1;5\n";
    for (uint64_t seed = 0; seed < 20; seed++) {
        PetriVariation moved = {.shift = 0.01, .seed = seed};
        double x = value_after(*state, script, 2, moved, "$(:s;0)[0]"), y = evaluate(*state, "$(:s;0)[1]");
        assert_true(fabs(fabs(x) - 0.05) < 1e-12 && fabs(fabs(y - 1) - 0.05) < 1e-12);
        assert_number("anchor", evaluate(*state, "$(:s;:a)[0]"), -3);
        player_step(*state, 5);
        assert_number("only once", evaluate(*state, "$(:s;0)[0]"), x);
    }
}

static void test_invalid_variations_change_nothing(void **state) {
    Player *player = *state;
    static const PetriVariation wrong[] = {
        {.size = sizeof(PetriVariation), .shift = -1},
        {.size = sizeof(PetriVariation), .shift = NAN},
        {.size = sizeof(PetriVariation), .shift = INFINITY},
        {.size = sizeof(PetriVariation), .parts = UINT32_MAX},
        {.parts = 2},
    };
    for (size_t i = 0; i < COUNT_OF(wrong); i++)
        assert_int_equal(petri_vary(player->session, &wrong[i]), PETRI_INVALID);
    player_run(player, "!physics state=:s dimensions=1\n" SPRING, 2);
    assert_int_equal(last_frame(player->session).physics_steps, 1);
}

typedef struct Reports {
    int count;
    PetriTrust last;
    char sentence[400];
} Reports;

static void keep(void *user_data, const PetriTrust *trust) {
    Reports *reports = user_data;
    reports->count++;
    reports->last = *trust;
    snprintf(reports->sentence, sizeof reports->sentence, "%s", trust->sentence);
}

static Reports trust(Player *player, const char *expression, int64_t frames, int64_t every) {
    Reports reports = {0};
    PetriTrustOptions options = {.size = sizeof options,
                                 .expressions = &expression,
                                 .count = 1,
                                 .frames = frames,
                                 .every = every,
                                 .report = keep,
                                 .user_data = &reports};
    assert_int_equal(petri_trust(player->session, &options), PETRI_OK);
    return reports;
}

static void test_session_stays_where_it_was(void **state) {
    Player *player = *state;
    uint8_t before[16], after[16], next[16];
    player_run(player, "!physics state=:s dimensions=1\n" SPRING "    !random strength=9\n", 30);
    assert_int_equal(petri_digest(player->session, before), PETRI_OK);
    PetriSnapshot *snapshot = petri_snapshot(player->session);
    player_step(player, 20);
    assert_int_equal(petri_digest(player->session, next), PETRI_OK);
    assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK);
    assert_int_equal(trust(player, "$(:s;:ball)", 100, 25).count, 5);
    assert_int_equal(petri_digest(player->session, after), PETRI_OK);
    assert_memory_equal(before, after, sizeof after);
    player_step(player, 20);
    assert_int_equal(petri_digest(player->session, after), PETRI_OK);
    assert_memory_equal(next, after, sizeof after);
    petri_snapshot_free(snapshot);
}

// A particle that is pushed away as r'' = 4 r has a Lyapunov time of 1/2.
static void test_lyapunov_time_is_that_of_an_unstable_rest(void **state) {
    static const char *const script = "!physics state=:s dimensions=1 resolution=1/600\n    !anchor id=0 radius=0\n"
                                      "    !particle id=1 position=1e-6 radius=0\n"
                                      "    !distance from=0 to=1 fixed=0 strength=-4\n";
    Player *player = *state;
    assert_int_equal(player_load(player, script), PETRI_OK);
    Reports found = trust(player, "$(:s;1)", 1200, 0);
    assert_true(fabs(found.last.lyapunov_time - 0.5) < 0.02);
    assert_true(fabs(found.last.lyapunov_time - 0.5) < 4 * found.last.lyapunov_error + 0.005);
    player_run(player, "!physics state=:s dimensions=1\n" SPRING, 1);
    found = trust(player, "$(:s;:ball)", 1200, 0);
    assert_true(isnan(found.last.lyapunov_time) && isnan(found.last.horizon));
}

static void check_verdict(Player *player, const char *script, const char *expression, PetriVerdict verdict,
                          const char *sentence) {
    assert_int_equal(player_load(player, script), PETRI_OK);
    Reports found = trust(player, expression, 300, 0);
    assert_int_equal(found.last.verdict, verdict);
    assert_true(strncmp(found.sentence, sentence, strlen(sentence)) == 0);
}

static void test_verdicts_say_what_is_wrong(void **state) {
    static const char *const spring = "!physics state=:s dimensions=1\n" SPRING;
    static const char *const dish = "!physics state=:d dimensions=2\n    !anchor id=:a\n    for i in ..9\n"
                                    "        !particle id=i position=(i%3)*1.3;(i//3)*1.3 velocity=i/3;1 radius=0.5\n"
                                    "    !collision strength=200\n    !barrier position=-1;0 normal=1;0\n"
                                    "    !barrier position=3.6;0 normal=-1;0\n    !barrier position=0;-1 normal=0;1\n"
                                    "    !barrier position=0;3.6 normal=0;-1\n";
    static const char *const stiff = "!physics state=:s dimensions=1\n    !anchor id=0\n    !particle id=1 position=2\n"
                                     "    !distance from=0 to=1 fixed=1\\\n        strength=1e5\n";
    check_verdict(*state, spring, "frame*2", PETRI_CONVERGED, "converged: 15 digits");
    check_verdict(*state, spring, "$(:s;:ball)", PETRI_STEP_TOO_LARGE,
                  "step too large: for 3 digits, use resolution=1/");
    check_verdict(*state, spring, "'text'", PETRI_NO_NUMBER, "not a number");
    check_verdict(*state, spring, "null", PETRI_NO_NUMBER, "not a number");
    check_verdict(*state, spring, "frame;1/0", PETRI_NO_NUMBER, "not a number");
    check_verdict(*state, spring, "'text';frame", PETRI_NO_NUMBER, "not a number");
    check_verdict(*state, dish, "$(:d;4)", PETRI_CHAOTIC, "chaotic: single runs mean nothing after");
    check_verdict(*state, stiff, "$(:s;1)", PETRI_UNSTABLE, "unstable since frame 1 because of the force in line 4");
}

// Following the advice gives the wanted digits.
static void test_advice_is_right(void **state) {
    char script[400];
    Player *player = *state;
    check_verdict(player, "!physics state=:s dimensions=1\n" SPRING, "$(:s;:ball)", PETRI_STEP_TOO_LARGE, "step");
    double rate = strtod(strstr(trust(player, "$(:s;:ball)", 300, 0).sentence, "1/") + 2, NULL);
    snprintf(script, sizeof script, "!physics state=:s dimensions=1 resolution=1/%.0f\n" SPRING, rate);
    check_verdict(player, script, "$(:s;:ball)", PETRI_CONVERGED, "converged: 3 digits");
}

TEST_GROUP(session_trust) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_parts_are_steps_of_that_length),
        PLAYER_TEST(test_random_forces_are_constant_in_a_step),
        PLAYER_TEST(test_shift_moves_particles_by_a_part_of_the_size),
        PLAYER_TEST(test_invalid_variations_change_nothing),
        PLAYER_TEST(test_session_stays_where_it_was),
        PLAYER_TEST(test_lyapunov_time_is_that_of_an_unstable_rest),
        PLAYER_TEST(test_verdicts_say_what_is_wrong),
        PLAYER_TEST(test_advice_is_right),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
