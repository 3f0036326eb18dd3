// test_session_simplifier.c: every script of the tests and samples does the same with and without the simplifier, frame
// by frame: tree, state, log, errors and diagnostics. argv[1..]: the folders to go through.
#include "player.h"

#include <ftw.h>

enum { FRAMES = 3, ALL_SECTIONS = 15 };

// What a script does, as text.
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
    note(&all, player.told.text, player.told.len);
    player_close(&player);
    return all;
}

static int scripts, differing;

static int visit(const char *path, const struct stat *info, int type, struct FTW *walk) {
    (void)info;
    (void)walk;
    size_t len = strlen(path);
    if (type != FTW_F || len < 3 || strcmp(path + len - 3, ".fl") != 0)
        return 0;
    Notebook with = record(path, true), without = record(path, false);
    scripts++;
    if (with.len != without.len || memcmp(with.text, without.text, with.len) != 0) {
        differing++;
        print_error("%s\n--- with\n%.2000s\n--- without\n%.2000s\n", path, with.text, without.text);
    }
    free(with.text);
    free(without.text);
    return 0;
}

static int folder_count;
static char **folders;

static void test_same(void **state) {
    (void)state;
    for (int i = 0; i < folder_count; i++)
        assert_int_equal(nftw(folders[i], visit, 16, FTW_PHYS), 0);
    assert_true(scripts > 500);
    assert_int_equal(differing, 0);
}

int main(int argc, char **argv) {
    folder_count = argc - 1;
    folders = argv + 1;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
