// test_session_reuse.c: tests that a reused session, as in petri sweep, gives the same tree, state and log in each
// frame as a new session. The log of a missing file is an exception: it is reported only at the first read. argv[1..]:
// folders of scripts.
#include "petri-inspect.h"
#include "player.h"
#include "scripts.h"

enum { FRAMES = 3, BEFORE = 5, SECTIONS = PETRI_PRINT_TREE | PETRI_PRINT_STATE | PETRI_PRINT_LOG };

static Notebook record(PetriSession *session) {
    Notebook all = {0};
    note(&all, "", 0);
    bool going = true;
    for (int frame = 0; going && frame < FRAMES; frame++) {
        going = petri_step(session) == PETRI_OK;
        petri_print(session, SECTIONS, note, &all);
    }
    return all;
}

// Loads a script and runs it with another definition for more frames. Then resets the session and records the results
// of a second run. Returns false if loading fails.
static bool run_again(Player *player, const char *file, Notebook *all) {
    PetriSession *session = player->session;
    if (petri_load(session, file) != PETRI_OK)
        return false;
    PetriConfig *base = petri_config_get(session);
    assert_non_null(base);
    for (int run = 0; run < 2; run++) {
        petri_config_apply(session, base);
        petri_reset(session);
        assert_int_equal(petri_define(session, run == 0 ? "SEED=5" : "SEED=7"), PETRI_OK);
        assert_int_equal(petri_reload(session, NULL), PETRI_OK);
        for (int frame = 0; run == 0 && frame < BEFORE && petri_step(session) == PETRI_OK; frame++)
            continue;
    }
    petri_config_free(base);
    *all = record(session);
    return true;
}

static int scripts, differing;

static void check_script(const char *path) {
    Player again = {0}, fresh = {0};
    PetriOptions options = player_options(&again);
    player_open_with(&again, &options);
    options = player_options(&fresh);
    player_open_with(&fresh, &options);
    Notebook reused;
    if (run_again(&again, path, &reused)) {
        assert_int_equal(petri_define(fresh.session, "SEED=7"), PETRI_OK);
        assert_int_equal(petri_load(fresh.session, path), PETRI_OK);
        Notebook once = record(fresh.session);
        scripts++;
        if (once.len != reused.len || memcmp(once.text, reused.text, once.len) != 0) {
            differing++;
            print_error("%s\n--- once\n%.2000s\n--- again\n%.2000s\n", path, once.text, reused.text);
        }
        free(once.text);
        free(reused.text);
    }
    player_close(&again);
    player_close(&fresh);
}

static void test_reused_session_matches_new(void **state) {
    (void)state;
    scripts_each(check_script);
    assert_true(scripts > 300);
    assert_int_equal(differing, 0);
}

TEST_GROUP(session_reuse) {
    if (argc < 2)
        return GROUP_SKIPPED; // no folders
    scripts_set_folders(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_reused_session_matches_new)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
