// test_session_promises.c: what petri.h says of lifetimes and of what decides how a session goes on.
#include "folder.h"
#include "player.h"

#include <time.h>

static const char *const KEYS = "!physics state=:a dimensions=2 time=beat\n    !particle id=0 velocity=1;0\n"
                                "!physics state=:b dimensions=1 time=beat\n    !particle id=1\n"
                                "!window\n    !key name=:space state=:space\n    !pointer state=:mouse\n";

// Texts live as long as petri.h says, whatever else is asked meanwhile.
static void test_lifetimes(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    Folder folder;
    PetriSystem system;
    PetriParticle particle;
    PetriPrompted done;
    PetriResult result;
    folder_open(&folder);
    folder_write(&folder, "s.fl", KEYS);
    assert_int_equal(petri_load(session, folder_file(&folder, "s.fl")), PETRI_OK);
    player_step(player, 3);
    assert_int_equal(petri_prompt(session, "let twice=2*frame", PETRI_Z, NULL, NULL, &done), PETRI_OK);
    const char *statement = petri_prompt_statement(session, 0), *name = petri_name(session, 0);
    player_step(player, 1);
    const char *source = petri_source(session, 0);
    assert_true(petri_system(session, 1, &system));
    assert_true(petri_particle(session, 0, 0, &particle));
    for (size_t i = 0; petri_name(session, i); i++) {
    }
    player_state(player);
    player_print(player, 15);
    assert_int_equal(petri_evaluate(session, "twice", PETRI_Z, &result, NULL, NULL), PETRI_OK);
    assert_string_equal(strrchr(source, '/'), "/s.fl");
    assert_string_equal(statement, "let twice=2*frame");
    assert_string_equal(name, "twice");
    assert_string_equal(system.name, ":b");
    assert_string_equal(particle.id, "0");
    player_step(player, 1);
    assert_string_equal(statement, "let twice=2*frame");
    folder_close(&folder);
}

static void press(Player *player, bool pressed) {
    assert_int_equal(petri_key(player->session, "space", pressed), PETRI_OK);
    player_step(player, 1);
}

static char *next_state(Player *player) {
    player_step(player, 1);
    return strdup(player_state(player));
}

// A toggle is as it was, and so is what is pressed.
static void test_toggles_rewind(void **state) {
    Player *player = *state;
    player_run(player, KEYS, 2);
    press(player, true);
    PetriSnapshot *snapshot = petri_snapshot(player->session);
    char *wanted = next_state(player);
    assert_non_null(strstr(wanted, "$(:space;:toggled) = 1\n"));
    press(player, false);
    press(player, true);
    petri_pointer(player->session, &(PetriPointer){.inside = true, .x = 0.5, .y = 0.5, .buttons = 1});
    player_step(player, 1);
    assert_non_null(strstr(player_state(player), "$(:space;:toggled) = 0\n"));
    assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK);
    char *found = next_state(player);
    assert_string_equal(found, wanted);
    petri_snapshot_free(snapshot);
    free(found);
    free(wanted);
}

// Real time: what a script sees of it goes back, too.
static void test_performance_rewinds(void **state) {
    Player *player = *state;
    player_realtime(player, 500);
    player_run(player, "!a p=performance", 3);
    PetriSnapshot *snapshot = petri_snapshot(player->session);
    PetriResult before, after;
    assert_int_equal(petri_evaluate(player->session, "performance", PETRI_Z, &before, NULL, NULL), PETRI_OK);
    struct timespec pause = {.tv_nsec = 20000000};
    nanosleep(&pause, NULL);
    player_step(player, 1); // late: performance falls
    assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK);
    assert_int_equal(petri_evaluate(player->session, "performance", PETRI_Z, &after, NULL, NULL), PETRI_OK);
    assert_number("performance", after.number, before.number);
    petri_snapshot_free(snapshot);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_lifetimes),
        PLAYER_TEST(test_toggles_rewind),
        PLAYER_TEST(test_performance_rewinds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
