// test_scene_attributes.c: tests attributes of `!physics` nodes (physics.md section 1): shapes and diagnostics.
#include "player.h"

// Returns the diagnostics of three frames of a system that contains these lines.
static const char *reports_of(Player *player, const char *lines) {
    PetriOptions options = player_options(player);
    player_reopen(player, &options);
    Notebook script = {0};
    const char *const parts[] = {"!physics state=:s dimensions=2\n    !particle id=1 radius=1\n    !anchor id=9\n    ",
                                 lines, "\n"};
    for (size_t i = 0; i < COUNT_OF(parts); i++)
        note(&script, parts[i], strlen(parts[i]));
    player_run(player, script.text, 3);
    free(script.text);
    return player_diagnostics(player);
}

static void check_reported(Player *player, const ScriptRow *rows, size_t count) {
    for (size_t i = 0; i < count; i++)
        assert_text(rows[i].script, reports_of(player, rows[i].script), rows[i].wanted);
}

#define BAD(node, text) "warning " node ": " text " [bad-attribute]\n"

static void test_malformed_attributes_are_reported(void **state) {
    static const ScriptRow rows[] = {
        {"!particle id=2 position=1;2 velocity=3 force=0 ease=1 radius=1 mass=2 charge=-1", ""},
        {"!particle id=2 position=1;2;3",
         BAD("!particle id=2", "position should be one number or a vector of 2, not 1;2;3")},
        {"!particle id=2 position='x'",
         BAD("!particle id=2", "position should be one number or a vector of 2, not 'x'")},
        {"!particle id=2 velocity=1;'x'",
         BAD("!particle id=2", "velocity should be one number or a vector of 2, not 1;'x'")},
        {"!particle id=2 position=null", ""},
        {"!particle id=2 mass=1;2", BAD("!particle id=2", "mass should be one number, not 1;2")},
        {"!particle id=2 mass=0/0", BAD("!particle id=2", "mass should be one number, not nan")},
        {"!particle id=2 mass=1/0 radius=-3", ""}, // infinities are valid; clamping is not reported
        {"!particle id=2 radius='big' charge=!a", BAD("!particle id=2", "radius should be one number, not 'big'")
                                                      BAD("!particle id=2", "charge should be one number, not (!a)")},
        {"!particle id=:a;3 mass=..20", BAD("!particle id=:a;3", "mass should be one number, not 20 elements")},
        {"!anchor id=2 position=1;2;3",
         BAD("!anchor id=2", "position should be one number or a vector of 2, not 1;2;3")},
        {"!drag strength='x'", BAD("!drag", "strength should be one number, not 'x'")},
        {"!constant force=1;2;3", BAD("!constant", "force should be one number or a vector of 2, not 1;2;3")},
        {"!buoyancy gravity='x' density=1;1",
         BAD("!buoyancy", "density should be one number, not 1;1")
             BAD("!buoyancy", "gravity should be one number or a vector of 2, not 'x'")},
        {"!collision max_distance='far' power=0/0", BAD("!collision", "max_distance should be one number, not 'far'")
                                                        BAD("!collision", "power should be one number, not nan")},
        {"!barrier normal=1;0 min='x'", BAD("!barrier", "min should be one number, not 'x'")},
        {"!distance from=1 to=9 fixed='x' min=1", BAD("!distance", "fixed should be one number, not 'x'")},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        const char *reported = reports_of(*state, rows[i].script);
        // The result does not depend on the order of attributes.
        size_t len = 0;
        for (const char *line = rows[i].wanted; *line; line = strchr(line, '\n') + 1) {
            char part[300];
            snprintf(part, sizeof part, "%.*s", (int)(strchr(line, '\n') + 1 - line), line);
            if (!strstr(reported, part))
                assert_text(rows[i].script, reported, rows[i].wanted);
            len += strlen(part);
        }
        if (strlen(reported) != len)
            assert_text(rows[i].script, reported, rows[i].wanted);
    }
}

static void test_unknown_attributes_are_reported(void **state) {
    static const ScriptRow rows[] = {
        {"!particle id=2 mas=3",
         "warning !particle id=2: unknown attribute 'mas'; did you mean 'mass'? [unknown-attribute]\n"},
        {"!particle id=2 colour=1;0;0", "warning !particle id=2: unknown attribute 'colour' [unknown-attribute]\n"},
        {"!drag strenght=3",
         "warning !drag: unknown attribute 'strenght'; did you mean 'strength'? [unknown-attribute]\n"},
        {"!gravity power=2",
         // `power` is an attribute of another node
         "warning !gravity: unknown attribute 'power' [unknown-attribute]\n"},
        {"!distance from=1 to=9 max_distance=3",
         "warning !distance: unknown attribute 'max_distance' [unknown-attribute]\n"},
        {"!partikel id=2", "warning !partikel id=2: unknown inside !physics; the node is ignored; did you mean "
                           "!particle? [unknown-node]\n"},
        {"!qqqqqqqq", "warning !qqqqqqqq: unknown inside !physics; the node is ignored [unknown-node]\n"},
        {"!physics state=:t dimensions=1",
         "warning !physics state=:t: unknown inside !physics; the node is ignored; it belongs at the top level "
         "[unknown-node]\n"},
        {"!counter state=:c",
         "warning !counter state=:c: unknown inside !physics; the node is ignored; it belongs at the top level "
         "[unknown-node]\n"},
        {"!group anything=3 strength='x'", ""}, // attributes of groups are ignored
        {"!group\n        !drag x=1", "warning !drag: unknown attribute 'x' [unknown-attribute]\n"},
    };
    check_reported(*state, rows, COUNT_OF(rows));
}

static void test_missing_duplicate_and_unknown_ids_are_reported(void **state) {
    static const ScriptRow rows[] = {
        {"!particle position=1",
         "warning !particle: attribute 'id' is missing or null; the node is ignored [missing-id]\n"},
        {"!anchor position=1",
         "warning !anchor: attribute 'id' is missing or null; the node is ignored [missing-id]\n"},
        {"!particle id=0/0", "warning !particle id=nan: attribute 'id' must be numbers, symbols or strings; the node "
                             "is ignored [missing-id]\n"},
        {"!particle id=!a", "warning !particle id=(!a): attribute 'id' must be numbers, symbols or strings; the node "
                            "is ignored [missing-id]\n"},
        {"!particle id=1",
         "warning !particle id=1: an earlier particle or anchor has the same id; this one is ignored [duplicate-id]\n"},
        {"!anchor id=1",
         "warning !anchor id=1: an earlier particle or anchor has the same id; this one is ignored [duplicate-id]\n"},
        {"!group\n        !particle id=1",
         "warning !particle id=1: an earlier particle or anchor has the same id; this one is ignored [duplicate-id]\n"},
        {"!particle id='1'", ""},
        {"!particle id=1;1", ""},
        {"!particle id=-0\n    !particle id=0", ""}, // 0 and -0 are different keys
        {"!distance from=1 to=8",
         "warning !distance: to=8: no particle or anchor has this id; the force is ignored [unknown-particle]\n"},
        {"!distance from='q' to=1",
         "warning !distance: from='q': no particle or anchor has this id; the force is ignored [unknown-particle]\n"},
        {"!distance to=1",
         "warning !distance: from=null: no particle or anchor has this id; the force is ignored [unknown-particle]\n"},
        {"!barrier normal=0;0 min=1",
         "warning !barrier: attribute 'normal' is missing, 0 or not finite; the barrier is ignored [bad-normal]\n"},
        {"!barrier min=1",
         "warning !barrier: attribute 'normal' is missing, 0 or not finite; the barrier is ignored [bad-normal]\n"},
    };
    check_reported(*state, rows, COUNT_OF(rows));
}

static void test_skipped_systems(void **state) {
    Player *player = *state;
    static const char *const rows[][2] = {
        {"state=:s", "state=:s: attribute 'dimensions' is missing or null; the system is skipped"},
        {"state=:s dimensions=0.9", "state=:s: dimensions must be at least 1"},
        {"state=:s dimensions=0/0", "state=:s: dimensions must be at least 1"},
        {"state=:s dimensions=1/0", "state=:s: dimensions must be at most 1000000000"},
        {"state=:s dimensions=1e9", "state=:s: the vectors of the system would take more than 1 GiB"},
        {"dimensions=2", ": attribute 'state' is missing or null"},
        {"state=null dimensions=2", ": attribute 'state' is missing or null"},
        {"state=0/0 dimensions=2", "state=nan: attribute 'state' must be numbers, symbols or strings"},
        {"state=:s dimensions=2 resolution=0", "state=:s: resolution must be above 0 and finite"},
        {"state=:s dimensions=2 resolution=-1", "state=:s: resolution must be above 0 and finite"},
        {"state=:s dimensions=2 resolution=1/0", "state=:s: resolution must be above 0 and finite"},
        {"state=:s dimensions=2 time=1/0", "state=:s: time is not finite"},
        {"state=:s dimensions=2 time=0/0", "state=:s: time is not finite"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        PetriOptions options = player_options(player);
        player_reopen(player, &options);
        char script[200], wanted[200];
        snprintf(script, sizeof script, "!physics %s\n    !particle id=1 velocity=1\n", rows[i][0]);
        snprintf(wanted, sizeof wanted, "!physics%s%s", rows[i][1][0] == ':' ? "" : " ", rows[i][1]);
        player_run(player, script, 3);
        assert_text(script, player_state(player), ""); // a skipped system changes nothing
        const char *reported = player_diagnostics(player);
        const char *found = strstr(reported, "[invalid-system]\n");
        assert_claim(script, strstr(reported, wanted) != NULL);
        assert_claim(script, found && !strstr(found + 1, "[invalid-system]")); // the error is reported once
    }
}

// Dimensions and run are rounded down; the default resolution is one frame.
static void test_dimensions_and_run_are_floored(void **state) {
    Player *player = *state;
    player_run(player, "%pragma fps 10\n!physics state=:s dimensions=2.9 run=3.7\n    !particle id=1 velocity=1\n", 2);
    assert_text("floored", player_state(player),
                "$:s = 0\n$(:s;:clock) = 0.1\n$(:s;:iteration) = 1\n$(:s;:last) = 0.1\n$(:s;:run) = 3\n"
                "$(:s;1) = 0.1;0.1\n$(:s;1;:velocity) = 1;1\n");
}

// Each row has the position of the first particle after one step of length 1. The particle starts at rest at 0.
static void test_default_values(void **state) {
    Player *player = *state;
    static const struct {
        const char *lines, *position;
    } rows[] = {
        {"!constant force=1;2", "1;2"},
        {"!constant force=3", "3;3"},     // one number is used for all components
        {"!constant force=1;2;3", "0;0"}, // wrong length, so the default 0 is used
        {"!constant force=1;2 strength=2", "2;4"},
        {"!constant force=1;2 strength='x'", "1;2"}, // not a number, so the default 1 is used
        {"!constant force=1;2 strength=0/0", "1;2"},
        {"!constant acceleration=1;2", "1;2"},
        {"!anchor id=:a position=1;0\n    !distance from=1 to=:a fixed=0", "1;0"},
        {"!anchor id=:a position=1;0\n    !distance from=1 to=:a max=0", "1;0"}, // a rest length of 0
        {"!anchor id=:a position=1;0\n    !distance from=1 to=:a min=3", "-2;0"},
        {"!anchor id=:a position=1;0\n    !distance from=1 to=:a min=3 minimum=2", "-1;0"},
        {"!anchor id=:a position=1;0\n    !distance from=1 to=:a min=3 minimum='x'", "-2;0"},
        {"!anchor id=:a position=1;0\n    !distance from=1 to=:a min=5 max=6 fixed=3",
         "-2;0"}, // `fixed` has precedence over `min` and `max`
        {"!anchor id=:a position=1;0\n    !distance from=1 to=:a min=0", "0;0"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        PetriOptions options = player_options(player);
        player_reopen(player, &options);
        char script[300], wanted[100];
        snprintf(script, sizeof script, "%%pragma fps 1\n!physics state=:s dimensions=2\n    !particle id=1\n    %s\n",
                 rows[i].lines);
        player_run(player, script, 2);
        snprintf(wanted, sizeof wanted, "$(:s;1) = %s\n", rows[i].position);
        const char *found = strstr(player_state(player), "$(:s;1) = ");
        assert_non_null(found);
        if (strncmp(found, wanted, strlen(wanted)) != 0)
            assert_text(script, found, wanted);
    }
}

TEST_GROUP(scene_attributes) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_malformed_attributes_are_reported),
        PLAYER_TEST(test_unknown_attributes_are_reported),
        PLAYER_TEST(test_missing_duplicate_and_unknown_ids_are_reported),
        PLAYER_TEST(test_skipped_systems),
        PLAYER_TEST(test_dimensions_and_run_are_floored),
        PLAYER_TEST(test_default_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
