// test_session_optimisations.c: tests that each script of the tests and samples gives the same results with and without
// the simplifier, and with and without batches of loop iterations: tree, state, log, errors and diagnostics of each
// frame. argv[1..]: folders of scripts.
#include "petri-inspect.h"
#include "player.h"
#include "scripts.h"

enum { FRAMES = 3, ALL_SECTIONS = 15 };

// Returns the results of a script as a string.
static Notebook record(const char *file, bool simplify, bool no_batches) {
    Player player = {0};
    PetriOptions options = player_options(&player);
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify, .no_batches = no_batches};
    player_open_with(&player, &options);
    Notebook all = {0};
    note(&all, "", 0);
    bool going = petri_load(player.session, file) == PETRI_OK;
    for (int frame = 0; going && frame < FRAMES; frame++) {
        going = petri_step(player.session) == PETRI_OK;
        petri_print(player.session, ALL_SECTIONS, note, &all);
    }
    note(&all, player.diagnostics.text, player.diagnostics.len);
    player_close(&player);
    return all;
}

static int scripts, differing;

static void check_variant(const char *path, const Notebook *with, const char *what, bool simplify, bool no_batches) {
    Notebook without = record(path, simplify, no_batches);
    if (with->len != without.len || memcmp(with->text, without.text, with->len) != 0) {
        differing++;
        print_error("%s\n--- with\n%.2000s\n--- without %s\n%.2000s\n", path, with->text, what, without.text);
    }
    free(without.text);
}

static void check_script(const char *path) {
    Notebook with = record(path, true, false);
    scripts++;
    check_variant(path, &with, "the simplifier", false, false);
    check_variant(path, &with, "batches", true, true);
    check_variant(path, &with, "the simplifier and batches", false, true);
    free(with.text);
}

static void test_optimised_script_matches_plain(void **state) {
    (void)state;
    scripts_each(check_script);
    assert_true(scripts > 500);
    assert_int_equal(differing, 0);
}

TEST_GROUP(session_optimisations) {
    if (argc < 2)
        return GROUP_SKIPPED; // no folders
    scripts_set_folders(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_optimised_script_matches_plain)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
