// test_session_systems.c: what petri.h shows of the particle systems.
#include "player.h"

static const char *const SCRIPT = "%pragma fps 10\n"
                                  "!physics state=:a dimensions=2 time=time resolution=0.1\n"
                                  "    !particle id='p';1 position=1;2 mass=2 radius=3 charge=4\n"
                                  "    !group\n"
                                  "        !constant force=6;8\n"
                                  "        !anchor id=:top position=5;6\n"
                                  "        !particle id=7 position=-1;-2 velocity=1;0\n"
                                  "        !distance from='p';1 to=:top fixed=1 strength=0\n"
                                  "        !barrier position=0;-50 normal=0;2\n"
                                  "!physics state=:b dimensions=1 time=0\n"
                                  "    !particle id=0 position=9\n";

static void open_keeping(Player *player, bool keep) {
    PetriOptions options = player_options(player);
    options.keep_forces = keep;
    player_reopen(player, &options);
}

static void test_systems(void **state) {
    Player *player = *state;
    PetriSystem system;
    assert_false(petri_system(player->session, 0, &system));
    player_run(player, SCRIPT, 2);
    assert_true(petri_system(player->session, 0, &system));
    assert_string_equal(system.name, ":a");
    assert_int_equal(system.dimensions, 2);
    assert_int_equal(system.particle_count, 3);
    assert_int_equal(system.force_count, 3);
    assert_true(petri_system(player->session, 1, &system));
    assert_string_equal(system.name, ":b");
    assert_int_equal(system.dimensions, 1);
    assert_false(petri_system(player->session, 2, &system));
    player_run(player, "!a", 1); // a system that is gone is shown no more
    assert_false(petri_system(player->session, 0, &system));
}

static void test_particles(void **state) {
    Player *player = *state;
    for (int keep = 0; keep <= 1; keep++) {
        open_keeping(player, keep);
        player_run(player, SCRIPT, 2);
        PetriParticle particle;
        assert_true(petri_particle(player->session, 0, 0, &particle));
        assert_string_equal(particle.id, "'p';1");
        assert_false(particle.anchor);
        assert_number("mass", particle.mass, 2);
        assert_number("radius", particle.radius, 3);
        assert_number("charge", particle.charge, 4);
        assert_number("x", particle.position[0], 1);
        assert_number("y", particle.position[1], 2);
        assert_true(petri_particle(player->session, 0, 1, &particle));
        assert_true(particle.anchor);
        assert_string_equal(particle.id, ":top");
        assert_null(particle.force);
        assert_true(petri_particle(player->session, 0, 2, &particle));
        // One step of 0.1 under a force of 6;8 on a mass of 1 (spec physics.md 4.3).
        assert_number("v", particle.velocity[0], 1 + 6 * 0.1);
        assert_true(keep == (particle.force != NULL));
        if (keep) {
            assert_number("fx", particle.force[0], 6);
            assert_number("fy", particle.force[1], 8);
        }
        assert_false(petri_particle(player->session, 0, 3, &particle));
        assert_true(petri_particle(player->session, 1, 0, &particle));
        assert_null(particle.force); // no step was made
        assert_false(petri_particle(player->session, 2, 0, &particle));
    }
}

// Enough particles for the vector kernels, which need not store forces by themselves.
static void test_forces_of_many(void **state) {
    Player *player = *state;
    open_keeping(player, true);
    player_run(player,
               "!physics state=:a dimensions=3 time=time resolution=1\n    !constant force=1;2;3\n"
               "    for i in ..50\n        !particle id=i position=i;0;0 mass=i+1 force=0;0;i\n",
               3);
    for (uint32_t i = 0; i < 50; i++) {
        PetriParticle particle;
        assert_true(petri_particle(player->session, 0, i, &particle));
        assert_non_null(particle.force);
        assert_number("fx", particle.force[0], 1);
        assert_number("fz", particle.force[2], 3.0 + i);
    }
}

// A frame in which no time passes has no forces, though the tree is the same.
static void test_rest(void **state) {
    Player *player = *state;
    open_keeping(player, true);
    player_run(player, "!physics state=:a dimensions=2 time=frame//2\n    !particle id=1\n    !constant force=6;8\n",
               2);
    for (int frame = 1; frame < 6; frame++) {
        PetriParticle particle;
        assert_true(petri_particle(player->session, 0, 0, &particle));
        assert_true((frame % 2 == 0) == (particle.force != NULL));
        player_step(player, 1);
    }
}

static void test_forces(void **state) {
    Player *player = *state;
    player_run(player, SCRIPT, 2);
    PetriForce force;
    assert_true(petri_force(player->session, 0, 0, &force));
    assert_string_equal(force.kind, "constant");
    assert_null(force.position);
    assert_true(petri_force(player->session, 0, 1, &force));
    assert_string_equal(force.kind, "distance");
    assert_int_equal(force.from, 0);
    assert_int_equal(force.to, 1);
    assert_true(petri_force(player->session, 0, 2, &force));
    assert_string_equal(force.kind, "barrier");
    assert_number("y", force.position[1], -50);
    assert_number("unit normal", force.normal[1], 1);
    assert_false(petri_force(player->session, 0, 3, &force));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_systems), PLAYER_TEST(test_particles), PLAYER_TEST(test_forces_of_many),
        PLAYER_TEST(test_rest),    PLAYER_TEST(test_forces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
