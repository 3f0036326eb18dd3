// test_session_simplifier.c: tests that each script of the tests and samples gives the same results with and without
// the simplifier: tree, state, log, errors and diagnostics of each frame. argv[1..]: folders of scripts.
#include "player.h"
#include "scripts.h"

enum { FRAMES = 3, ALL_SECTIONS = 15 };

// Returns the results of a script as a string.
static Notebook record(const char *file, bool simplify) {
    Player player = {0};
    PetriOptions options = player_options(&player);
    options.simplify = simplify;
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

static void check_script(const char *path) {
    Notebook with = record(path, true), without = record(path, false);
    scripts++;
    if (with.len != without.len || memcmp(with.text, without.text, with.len) != 0) {
        differing++;
        print_error("%s\n--- with\n%.2000s\n--- without\n%.2000s\n", path, with.text, without.text);
    }
    free(with.text);
    free(without.text);
}

static void test_simplified_script_matches_plain(void **state) {
    (void)state;
    scripts_each(check_script);
    assert_true(scripts > 500);
    assert_int_equal(differing, 0);
}

int main(int argc, char **argv) {
    scripts_set_folders(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_simplified_script_matches_plain)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
