// test_session_step_forces.c: tests forces that the host computes in each step (petri_set_force_callback).
#include "petri-inspect.h"
#include "petri-live.h"
#include "petri-ranks.h"
#include "player.h"

#include <math.h>

// A spring to the origin, and the arguments of the last call.
typedef struct Spring {
    double stiffness;
    uint64_t calls;
    double first_clock;
    double delta;
    uint64_t refused; // number of the call, from 1, that interrupts the frame; 0: none
    char names[100];  // names of systems in the order of the calls
    PetriSession *session;
} Spring;

static bool pull(void *user_data, const PetriSystem *system, double clock, double delta, double *force) {
    Spring *spring = user_data;
    uint32_t n = system->dimensions;
    if (spring->calls++ == 0)
        spring->first_clock = clock;
    spring->delta = delta;
    if (strlen(spring->names) + strlen(system->name) < sizeof spring->names)
        strcat(spring->names, system->name);
    for (uint32_t i = 0; i < system->particle_count; i++)
        for (uint32_t k = 0; k < n; k++) {
            assert_number("force", force[i * n + k], 0);
            force[i * n + k] = -spring->stiffness * system->position.data[i * system->position.stride + k];
        }
    if (spring->session)
        assert_int_equal(petri_step(spring->session), PETRI_INVALID);
    return spring->calls != spring->refused;
}

static void set_force(Player *player, PetriForceCallback *callback, void *user_data) {
    assert_int_equal(petri_set_force_callback(player->session, callback, user_data), PETRI_OK);
}

static PetriSystem first_system(Player *player) {
    PetriSystem system;
    assert_true(petri_system(player->session, 0, &system, sizeof system));
    return system;
}

// Returns the largest difference between a harmonic oscillator with this step, run for 2 s, and cos ωt.
static double oscillator_error(Player *player, double step) {
    char script[300];
    snprintf(script, sizeof script,
             "%%pragma fps 10\n!physics state=:a dimensions=1 resolution=%.17g\n"
             "    !particle id=0 position=1 velocity=0 mass=2\n",
             step);
    Spring spring = {.stiffness = 18}; // ω = 3
    double worst = 0;
    petri_reset(player->session);
    set_force(player, pull, &spring);
    player_run(player, script, 1);
    for (int frame = 1; frame <= 20; frame++) {
        player_step(player, 1);
        worst = fmax(worst, fabs(first_system(player).position.data[0] - cos(3 * frame / 10.0)));
    }
    assert_true(fabs((double)spring.calls - 2 / step) <= 1);
    assert_number("clock", spring.first_clock, 0);
    return worst;
}

// The integrator has the first order: a tenth of the step gives a tenth of the error, in frames of the same length.
static void test_an_oscillator_has_the_order_of_the_integrator(void **state) {
    Player *player = *state;
    double coarse = oscillator_error(player, 0.01), fine = oscillator_error(player, 0.001);
    assert_true(coarse < 0.05);
    assert_true(fine < coarse / 9 && fine > coarse / 11);
}

// A force of the host that does what an engine's force does gives the same bits.
static bool push(void *user_data, const PetriSystem *system, double clock, double delta, double *force) {
    (void)user_data;
    (void)clock;
    (void)delta;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        force[2 * i] = 0.1 * (i % 7);
        force[2 * i + 1] = -0.3;
    }
    return true;
}

// Discs that collide, so that the engine has neighbour lists and reorders its columns. `own` is their attribute
// `force`.
static void run_discs(Player *player, const PetriOptions *options, const char *own, PetriForceCallback *callback,
                      uint8_t digest[16]) {
    char script[500];
    snprintf(
        script, sizeof script,
        "!physics state=:a dimensions=2 resolution=1/240\n    !collision strength=50\n    !anchor id=:wall "
        "position=0;0 radius=1\n    for i in ..2000\n        !particle id=i position=3*(i%%40);-2*(i//40) radius=1.4 "
        "velocity=uniform(:x;i)[0]-0.5;uniform(:y;i)[0]-0.5 force=%s\n",
        own);
    player_reopen(player, options);
    set_force(player, callback, NULL);
    player_run(player, script, 12);
    assert_int_equal(petri_digest(player->session, digest), PETRI_OK);
}

static void test_a_force_of_the_host_equals_that_of_the_script(void **state) {
    Player *player = *state;
    uint8_t wanted[16], plain[16], found[16];
    PetriOptions options = player_options(player);
    PetriTuning tuning = {.size = sizeof tuning, .neighbours = PETRI_NEIGHBOURS_NEVER};
    options.threads = 1;
    options.tuning = &tuning;
    run_discs(player, &options, "0.1*((i+1)%7);-0.3", NULL, wanted); // particle i has number i + 1, after the anchor
    run_discs(player, &options, "null", NULL, plain);
    assert_memory_not_equal(wanted, plain, sizeof wanted);
    for (int threads = 1; threads <= 3; threads += 2)
        for (int neighbours = PETRI_NEIGHBOURS_NEVER; neighbours <= PETRI_NEIGHBOURS_ALWAYS; neighbours++) {
            options.threads = threads;
            tuning.neighbours = (PetriNeighbours)neighbours;
            run_discs(player, &options, "null", push, found);
            assert_memory_equal(found, wanted, sizeof wanted);
        }
}

static const char *const TWO = "%pragma fps 10\n"
                               "!physics state=:a dimensions=2 resolution=0.05\n"
                               "    !anchor id=:top position=5;6\n"
                               "    !particle id=1 position=1;2 force=1;1\n"
                               "!physics state='x';7 dimensions=1 resolution=0.1\n"
                               "    !particle id=1 position=1\n";

static void test_each_system_is_named(void **state) {
    Player *player = *state;
    Spring spring = {.stiffness = 1};
    set_force(player, pull, &spring);
    player_run(player, TWO, 1);
    assert_string_equal(spring.names, ""); // no time has passed
    player_step(player, 1);
    assert_string_equal(spring.names, ":a:a'x';7");
    assert_number("delta", spring.delta, 0.1);
    assert_number("the anchor", first_system(player).position.data[1], 6);
    set_force(player, NULL, NULL);
    player_step(player, 1);
    assert_int_equal(spring.calls, 3);
}

static void test_the_force_of_the_host_is_explained(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    PetriExplanation found;
    options.keep_forces = true;
    player_reopen(player, &options);
    Spring spring = {.stiffness = 4};
    set_force(player, pull, &spring);
    player_run(player, TWO, 3);
    PetriSystem system = first_system(player);
    assert_int_equal(petri_explain_force(player->session, 0, 1, 1, &found, sizeof found), PETRI_OK);
    assert_memory_equal(found.sum, system.force.data + system.force.stride, 2 * sizeof *found.sum);
    assert_number("force", found.sum[0], 1 - 4 * found.position[0]);
    spring.refused = spring.calls + 1;
    assert_int_equal(petri_explain_force(player->session, 0, 1, 0, &found, sizeof found), PETRI_INTERRUPTED);
    assert_int_equal(petri_explain_force(player->session, 0, 1, 0, &found, sizeof found), PETRI_OK);
}

static void test_a_refused_step_is_rolled_back(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    uint8_t before[16], after[16];
    options.rollback_frames = true;
    player_reopen(player, &options);
    Spring spring = {.stiffness = 1, .session = player->session};
    set_force(player, pull, &spring);
    player_run(player, TWO, 3);
    PetriSnapshot *snapshot = petri_snapshot(player->session);
    player_step(player, 4);
    assert_int_equal(petri_digest(player->session, before), PETRI_OK);
    spring.refused = spring.calls + 2; // in the middle of a frame
    assert_int_equal(petri_step(player->session), PETRI_INTERRUPTED);
    assert_int_equal(petri_frame_number(player->session), 6);
    assert_int_equal(petri_digest(player->session, after), PETRI_OK);
    assert_memory_equal(before, after, sizeof before);
    player_step(player, 1);
    assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK); // frames that are repeated are the same
    player_step(player, 4);
    assert_int_equal(petri_digest(player->session, after), PETRI_OK);
    assert_memory_equal(before, after, sizeof before);
    petri_snapshot_free(snapshot);
    assert_string_equal(player->diagnostics.text, "");
}

static void test_ranks_have_no_force_of_the_host(void **state) {
    Player *player = *state;
    const PetriRanks ranks = {.size = sizeof ranks, .rank_count = 2};
    PetriOptions options = player_options(player);
    options.ranks = &ranks;
    player_reopen(player, &options);
    assert_int_equal(petri_set_force_callback(player->session, pull, NULL), PETRI_INVALID);
    assert_int_equal(petri_set_force_callback(player->session, NULL, NULL), PETRI_OK);
}

// Divides by zero at the anchor and at each particle whose bit is set in *context.
static bool divide(void *context, const PetriSystem *system, double clock, double delta, double *force) {
    (void)clock;
    (void)delta;
    for (uint32_t i = 0; i < system->particle_count; i++)
        if (i == 0 || *(const unsigned *)context >> i & 1)
            force[i * system->dimensions + 1] = i % 2 ? NAN : -INFINITY;
    return true;
}

static void test_forces_that_are_not_finite_are_reported(void **state) {
    Player *player = *state;
    unsigned bits = 0;
    set_force(player, divide, &bits);
    player_run(player,
               "!physics state=:a;1 dimensions=2\n    !anchor id=0 position=0\n"
               "    for i in 1..4\n        !particle id=i position=i velocity=1;2\n",
               5);
    assert_string_equal(player->diagnostics.text, ""); // forces on anchors have no effect
    bits = 1 << 2 | 1 << 3;
    player_step(player, 3);
    assert_string_equal(player->diagnostics.text, // once
                        "warning the force of the host on particle number 2 of :a;1 is not finite, so the particle "
                        "keeps its velocity [not-finite]\n");
    PetriSystem system = first_system(player);
    assert_number("velocity", system.velocity.data[2 * system.velocity.stride + 1], 2);
    assert_true(fabs(system.position.data[2 * system.position.stride + 1] - (2 + 2 * 7 / 60.0)) < 1e-14);
}

TEST_GROUP(session_step_forces) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_an_oscillator_has_the_order_of_the_integrator),
        PLAYER_TEST(test_a_force_of_the_host_equals_that_of_the_script),
        PLAYER_TEST(test_each_system_is_named),
        PLAYER_TEST(test_the_force_of_the_host_is_explained),
        PLAYER_TEST(test_a_refused_step_is_rolled_back),
        PLAYER_TEST(test_ranks_have_no_force_of_the_host),
        PLAYER_TEST(test_forces_that_are_not_finite_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
