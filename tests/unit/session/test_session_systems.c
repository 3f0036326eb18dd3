// test_session_systems.c: tests access to particle systems through petri.h.
#include "petri-inspect.h"
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

static void test_systems_are_listed_until_removed(void **state) {
    Player *player = *state;
    PetriSystem system;
    assert_false(petri_system(player->session, 0, &system, sizeof system));
    assert_int_equal(petri_system_count(player->session), 0);
    assert_int_equal(petri_system_count(NULL), 0);
    player_run(player, SCRIPT, 2);
    assert_int_equal(petri_system_count(player->session), 2);
    assert_true(petri_system(player->session, 0, &system, sizeof system));
    assert_string_equal(system.name, ":a");
    assert_int_equal(system.dimensions, 2);
    assert_int_equal(system.particle_count, 3);
    assert_int_equal(system.force_count, 3);
    assert_true(petri_system(player->session, 1, &system, sizeof system));
    assert_string_equal(system.name, ":b");
    assert_int_equal(system.dimensions, 1);
    assert_false(petri_system(player->session, 2, &system, sizeof system));
    player_run(player, "!a", 1); // a removed system is not listed
    assert_false(petri_system(player->session, 0, &system, sizeof system));
}

// Systems are in the order of the script, also if they appear later, change their places or return.
static void test_systems_are_in_the_order_of_the_script(void **state) {
    static const char *const script = "for name in (:a;:b;:c) if frame == 0 else (:c;:a) if frame == 1 else "
                                      "(:d;:b;:a) if frame == 2 else (:b;:c;:b;:d;:a)\n"
                                      "    !physics state=name dimensions=1\n"
                                      "        !particle id=1\n";
    static const char *const expected[] = {":a:b:c", ":c:a", ":d:b:a", ":b:c:b:d:a", ":b:c:b:d:a"};
    Player *player = *state;
    assert_int_equal(player_load(player, script), PETRI_OK);
    for (size_t frame = 0; frame < COUNT_OF(expected); frame++) {
        char names[100] = "";
        PetriSystem system;
        player_step(player, 1);
        for (size_t i = 0; petri_system(player->session, i, &system, sizeof system); i++)
            strcat(names, system.name);
        assert_int_equal(petri_system_count(player->session), strlen(names) / 2);
        assert_text(expected[frame], names, expected[frame]);
    }
}

static PetriSystem system_of(Player *player, size_t number) {
    PetriSystem system;
    assert_true(petri_system(player->session, number, &system, sizeof system));
    return system;
}

static const double *particle_numbers(PetriColumn column, uint32_t particle) {
    return column.data + particle * column.stride;
}

static const char *id_text(Player *player, size_t system, uint32_t particle) {
    return petri_format_value(player->session, petri_particle_id(player->session, system, particle));
}

static void test_columns_of_particles_are_readable(void **state) {
    Player *player = *state;
    for (int keep = 0; keep <= 1; keep++) {
        open_keeping(player, keep);
        player_run(player, SCRIPT, 2);
        PetriSystem a = system_of(player, 0);
        assert_string_equal(id_text(player, 0, 0), "'p';1");
        assert_false(a.anchor[0]);
        assert_number("mass", *particle_numbers(a.mass, 0), 2);
        assert_number("radius", *particle_numbers(a.radius, 0), 3);
        assert_number("charge", *particle_numbers(a.charge, 0), 4);
        assert_number("x", particle_numbers(a.position, 0)[0], 1);
        assert_number("y", particle_numbers(a.position, 0)[1], 2);
        assert_true(a.anchor[a.anchor_stride]);
        assert_string_equal(id_text(player, 0, 1), ":top");
        assert_false(a.anchor[2 * a.anchor_stride]);
        // One step of 0.1 under a force of 6;8 on a mass of 1 (spec physics.md 4.3).
        assert_number("v", particle_numbers(a.velocity, 2)[0], 1 + 6 * 0.1);
        assert_true(keep == (a.force.data != NULL));
        if (keep) {
            assert_number("fx", particle_numbers(a.force, 2)[0], 6);
            assert_number("fy", particle_numbers(a.force, 2)[1], 8);
            assert_number("on a particle outside the group", particle_numbers(a.force, 0)[0], 0);
            assert_number("on an anchor", particle_numbers(a.force, 1)[1], 0);
        }
        assert_null(system_of(player, 1).force.data); // no step has been simulated
        assert_int_equal(petri_particle_id(player->session, 0, 3).length, 0);
        assert_int_equal(petri_particle_id(player->session, 2, 0).length, 0);
    }
}

// Enough particles for the vector kernels, which do not store forces by default.
static void test_forces_of_vector_kernels(void **state) {
    Player *player = *state;
    open_keeping(player, true);
    player_run(player,
               "!physics state=:a dimensions=3 time=time resolution=1\n    !constant force=1;2;3\n"
               "    for i in ..50\n        !particle id=i position=i;0;0 mass=i+1 force=0;0;i\n",
               3);
    PetriSystem system = system_of(player, 0);
    for (uint32_t i = 0; i < 50; i++) {
        assert_number("fx", particle_numbers(system.force, i)[0], 1);
        assert_number("fz", particle_numbers(system.force, i)[2], 3.0 + i);
    }
}

// A frame in which no time passes has no forces, although the tree is unchanged.
static void test_forces_only_after_a_step(void **state) {
    Player *player = *state;
    open_keeping(player, true);
    player_run(player, "!physics state=:a dimensions=2 time=frame//2\n    !particle id=1\n    !constant force=6;8\n",
               2);
    for (int frame = 1; frame < 6; frame++) {
        assert_true((frame % 2 == 0) == (system_of(player, 0).force.data != NULL));
        player_step(player, 1);
    }
}

// The columns point into the engine's arrays. Their addresses do not change while the set of particles stays the same.
static void test_columns_are_not_copied(void **state) {
    Player *player = *state;
    player_run(player,
               "!physics state=:a dimensions=2 time=time\n"
               "    for i in ..100\n        !particle id=i velocity=1;0 position=0;i\n",
               3);
    PetriSystem before = system_of(player, 0);
    double x = particle_numbers(before.position, 70)[0];
    player_step(player, 1);
    PetriSystem after = system_of(player, 0);
    assert_ptr_equal(before.position.data, after.position.data);
    assert_ptr_equal(before.mass.data, after.mass.data);
    assert_true(particle_numbers(after.position, 70)[0] > x);
}

static uint32_t find_particle(Player *player, PetriValue id) {
    uint32_t found = 1000;
    return petri_find_particle(player->session, 0, id, &found) ? found : 999;
}

static PetriValue id_value(const double *id) {
    return (PetriValue){.length = 1, .numbers = id};
}

// Retained columns stay readable and count towards the memory limit until they are released.
static void test_retained_columns_stay_readable(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.keep_forces = true;
    player_reopen(player, &options);
    player_run(player,
               "if frame < 9\n"
               "    !physics state=:a dimensions=2 time=time\n"
               "        for i in ..100*(frame*frame+1)\n"
               "            !particle id=i position=i;i radius=i mass=1+i charge=i\n",
               2);
    petri_keep_columns(player->session, true);
    PetriSystem before = system_of(player, 0);
    player_step(player, 6);
    PetriSystem after = system_of(player, 0);
    assert_ptr_not_equal(before.position.data, after.position.data);
    for (uint32_t i = 0; i < before.particle_count; i++) {
        assert_number("position", before.position.data[i * before.position.stride], i);
        assert_number("velocity", before.velocity.data[i * before.velocity.stride], 0);
        assert_number("force", before.force.data[i * before.force.stride], 0);
        assert_number("radius", before.radius.data[i * before.radius.stride], i);
        assert_number("mass", before.mass.data[i * before.mass.stride], 1 + i);
        assert_false(before.anchor[i * before.anchor_stride]);
    }
    player_step(player, 2); // the system is removed
    assert_number("charge", after.charge.data[99 * after.charge.stride], 99);
    petri_keep_columns(player->session, false);
    petri_keep_columns(player->session, true);
    player_run(player, SCRIPT, 2);
    player_run(player, "!a", 1); // closing the session releases retained memory
}

static void test_particle_ids(void **state) {
    Player *player = *state;
    player_run(player, SCRIPT, 2);
    double top = petri_symbol(player->session, "top"), seven = 7;
    const PetriString p = {"p", 1};
    PetriItem items[] = {{PETRI_STRING, {.string = &p}}, {PETRI_NUMBER, {.number = 1}}};
    assert_string_equal(petri_symbol_name(player->session, top), "top");
    assert_null(petri_symbol_name(player->session, 12));
    assert_int_equal(find_particle(player, id_value(&seven)), 2);
    assert_int_equal(find_particle(player, id_value(&top)), 1);
    assert_int_equal(find_particle(player, (PetriValue){.length = 2, .items = items}), 0);
    assert_int_equal(find_particle(player, (PetriValue){.length = 1, .items = items}), 999);
    assert_int_equal(find_particle(player, (PetriValue){0}), 999);
    assert_int_equal(find_particle(player, (PetriValue){.length = 1}), 999); // not a valid value
    assert_null(petri_particle_ids(player->session, 0).data);
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(find_particle(player, petri_particle_id(player->session, 0, i)), i);
    // The ids are replaced by others in another order, with a prefix that contains a string, so that the key is not
    // numeric.
    player_run(player, "!physics state='s';1 dimensions=2 time=time\n    for i in 4;3;5\n        !particle id=i\n", 1);
    for (int frame = 0; frame < 3; frame++, player_step(player, 1)) {
        PetriColumn ids = petri_particle_ids(player->session, 0);
        assert_number("first id", ids.data[0], 4);
        assert_number("last id", ids.data[2 * ids.stride], 5);
        assert_number("the second id", petri_particle_id(player->session, 0, 1).numbers[0], 3);
        assert_int_equal(find_particle(player, petri_particle_id(player->session, 0, 1)), 1);
    }
    player_run(player, "!physics state='s';1 dimensions=2 time=time\n    !particle id=frame\n", 8);
    assert_number("a new id in each frame", petri_particle_ids(player->session, 0).data[0], 7);
    player_step(player, 1);
    assert_number("a new id in each frame", petri_particle_ids(player->session, 0).data[0], 8);
}

static void test_force_appliers(void **state) {
    Player *player = *state;
    player_run(player, SCRIPT, 2);
    PetriForce force;
    assert_true(petri_system_force(player->session, 0, 0, &force, sizeof force));
    assert_string_equal(force.kind, "constant");
    assert_null(force.position);
    assert_true(petri_system_force(player->session, 0, 1, &force, sizeof force));
    assert_string_equal(force.kind, "distance");
    assert_string_equal(force.file, "t.fl");
    assert_int_equal(force.line, 8);
    assert_int_equal(force.column, 9);
    assert_int_equal(force.from, 0);
    assert_int_equal(force.to, 1);
    assert_true(petri_system_force(player->session, 0, 2, &force, sizeof force));
    assert_string_equal(force.kind, "barrier");
    assert_number("y", force.position[1], -50);
    assert_number("unit normal", force.normal[1], 1);
    assert_false(petri_system_force(player->session, 0, 3, &force, sizeof force));
}

static const char *const EXPLAINED = "%pragma fps 8\n"
                                     "!physics state=:a dimensions=2 time=time resolution=1/16\n"
                                     "    for i in ..3\n"
                                     "        !particle id=i position=i;0 radius=0.7 force=0;-1\n"
                                     "    !constant force=6;8\n"
                                     "    !group\n"
                                     "        !gravity strength=9\n"
                                     "    !collision\n"
                                     "    !anchor id=:wall position=9;9\n";

// Writes the contributions as `NAME:LINE:COLUMN kind partner`, separated by commas.
static void write_contributions(Player *player, const PetriExplanation *found, char *text, size_t size) {
    size_t length = 0;
    text[0] = '\0';
    for (uint32_t c = 0; c < found->count; c++) {
        PetriForce force = {.kind = "own", .file = ""};
        if (found->force[c] != PETRI_OWN_FORCE)
            assert_true(petri_system_force(player->session, 0, found->force[c], &force, sizeof force));
        length += (size_t)snprintf(text + length, size - length, "%s%s:%u:%u %s %d", c ? ", " : "",
                                   force.file ? force.file : "?", force.line, force.column, force.kind,
                                   (int)found->partner[c]);
    }
}

static PetriStatus explain(Player *player, uint32_t particle, uint64_t step, PetriExplanation *found) {
    return petri_explain_force(player->session, 0, particle, step, found, sizeof *found);
}

static void test_contributions_add_up_to_the_force(void **state) {
    Player *player = *state;
    open_keeping(player, true);
    player_run(player, EXPLAINED, 3);
    PetriSystem system = system_of(player, 0);
    PetriExplanation found;
    char text[500];
    assert_int_equal(system.steps, 2);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(explain(player, i, 1, &found), PETRI_OK);
        double sum[] = {found.vector[0], found.vector[1]};
        for (size_t c = 1; c < found.count; c++)
            for (size_t k = 0; k < 2; k++)
                sum[k] += found.vector[2 * c + k];
        assert_memory_equal(sum, particle_numbers(system.force, i), sizeof sum);
        assert_memory_equal(found.sum, sum, sizeof sum);
    }
    assert_number("clock", found.clock, 0.125 + 0.0625);
    assert_number("delta", found.delta, 0.0625);
    assert_int_equal(explain(player, 0, 0, &found), PETRI_OK);
    write_contributions(player, &found, text, sizeof text);
    assert_string_equal(text, ":0:0 own -1, t.fl:8:5 collision 1, t.fl:5:5 constant -1");
    assert_int_equal(explain(player, 3, 1, &found), PETRI_OK); // an anchor
    assert_int_equal(found.count, 0);
    assert_number("sum", found.sum[1], 0);
}

// A frame is explained as it was computed, even if the state or the parameters have changed since.
static void test_explanation_of_a_changed_session(void **state) {
    Player *player = *state;
    open_keeping(player, true);
    player_run(player, EXPLAINED, 3);
    PetriExplanation found;
    double force[2], far[] = {1e6, 1e6}, prefix = petri_symbol(player->session, "a");
    char text[500];
    memcpy(force, particle_numbers(system_of(player, 0).force, 1), sizeof force);
    assert_int_equal(petri_state_set(player->session, (PetriValue){.length = 2, .numbers = (double[]){prefix, 0}},
                                     (PetriValue){.length = 2, .numbers = far}),
                     PETRI_OK);
    petri_prompt(player->session, "let x = 1", PETRI_NUL_TERMINATED, NULL, NULL, NULL, 0);
    assert_int_equal(explain(player, 1, 1, &found), PETRI_OK);
    assert_memory_equal(found.sum, force, sizeof force);
    write_contributions(player, &found, text, sizeof text);
    assert_non_null(strstr(text, "t.fl:8:5 collision 0, t.fl:8:5 collision 2"));
    assert_int_equal(petri_reload(player->session, NULL), PETRI_OK);
    assert_int_equal(explain(player, 1, 1, &found), PETRI_OK);
    write_contributions(player, &found, text, sizeof text); // the program that created the nodes no longer exists
    assert_non_null(strstr(text, "?:0:0 collision 0"));
}

static void test_nothing_to_explain(void **state) {
    Player *player = *state;
    PetriExplanation found;
    player_run(player, EXPLAINED, 3);
    assert_int_equal(explain(player, 0, 0, &found), PETRI_INVALID); // forces are not kept
    open_keeping(player, true);
    player_run(player, EXPLAINED, 1);
    assert_int_equal(explain(player, 0, 0, &found), PETRI_INVALID); // frame 0 has no steps
    player_step(player, 1);
    assert_int_equal(explain(player, 0, 1, &found), PETRI_OK);
    assert_int_equal(explain(player, 0, 2, &found), PETRI_INVALID);
    assert_int_equal(explain(player, 4, 0, &found), PETRI_INVALID);
    assert_int_equal(petri_explain_force(player->session, 1, 0, 0, &found, sizeof found), PETRI_INVALID);
}

// An explanation can be interrupted, and has the limits of a frame. It computes pairs that neighbour lists exclude.
static void test_aborted_explanation(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    PetriExplanation found;
    options.keep_forces = true;
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .neighbours = PETRI_NEIGHBOURS_ALWAYS};
    player_reopen(player, &options);
    const char *script = "!physics state=:a dimensions=2 time=time\n    for i in ..8\n        !collision\n"
                         "    for i in ..3000\n        !particle id=i position=i*3;0 radius=1\n";
    player_run(player, script, 2);
    assert_int_equal(explain(player, 1, 0, &found), PETRI_OK);
    petri_interrupt(player->session);
    assert_int_equal(explain(player, 1, 0, &found), PETRI_INTERRUPTED);
    assert_int_equal(explain(player, 1, 0, &found), PETRI_OK);
    assert_string_equal(player->diagnostics.text, "");
    options.work_limit = 80000; // each frame needs less
    player_reopen(player, &options);
    player_run(player, script, 2);
    assert_int_equal(explain(player, 1, 0, &found), PETRI_LIMIT_EXCEEDED);
    assert_non_null(strstr(player->diagnostics.text, "the explanation exceeded its limit of 80000 work units"));
}

// Functions that return no status would lose the interrupt.
static void test_queries_leave_an_interrupt_to_the_next_call(void **state) {
    Player *player = *state;
    PetriSystem system;
    PetriParameter parameter;
    PetriForce force;
    uint32_t particle;
    player_run(player,
               "let N=N or 3\n!physics state=:a dimensions=2\n    for i in ..N\n        !particle id=i\n    !drag\n",
               3);
    petri_interrupt(player->session);
    assert_true(petri_system(player->session, 0, &system, sizeof system));
    assert_true(petri_parameter(player->session, 0, &parameter, sizeof parameter));
    assert_true(petri_system_force(player->session, 0, 0, &force, sizeof force));
    assert_int_equal(petri_particle_id(player->session, 0, 1).length, 1);
    assert_non_null(petri_particle_ids(player->session, 0).data);
    assert_true(petri_find_particle(player->session, 0, (PetriValue){1, (double[]){2}, NULL}, &particle));
    assert_int_equal(petri_step(player->session), PETRI_INTERRUPTED);
    assert_int_equal(petri_step(player->session), PETRI_OK);
}

TEST_GROUP(session_systems) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_systems_are_listed_until_removed),
        PLAYER_TEST(test_systems_are_in_the_order_of_the_script),
        PLAYER_TEST(test_columns_of_particles_are_readable),
        PLAYER_TEST(test_forces_of_vector_kernels),
        PLAYER_TEST(test_forces_only_after_a_step),
        PLAYER_TEST(test_columns_are_not_copied),
        PLAYER_TEST(test_particle_ids),
        PLAYER_TEST(test_force_appliers),
        PLAYER_TEST(test_retained_columns_stay_readable),
        PLAYER_TEST(test_contributions_add_up_to_the_force),
        PLAYER_TEST(test_explanation_of_a_changed_session),
        PLAYER_TEST(test_nothing_to_explain),
        PLAYER_TEST(test_aborted_explanation),
        PLAYER_TEST(test_queries_leave_an_interrupt_to_the_next_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
