// test_scene_input.c: tests `!pointer` and `!key` in a `!window`, which show a script the input that the host reports.
#include "petri-live.h"
#include "player.h"

static const char *const POINTER = "!window size=100;100\n    !pointer state=:m\n!see at=$:m left=$(:m;:left) "
                                   "right=$(:m;:right) fourth=$(:m;:button_4)\n";
static const char *const KEY = "!window\n    !key name=:space state=:k\n!see down=$:k pushed=$(:k;:pushed) "
                               "at=$(:k;:pushed;:beat) released=$(:k;:released) until=$(:k;:released;:beat) "
                               "toggled=$(:k;:toggled)\n";

// Returns the `!see` line of the next frame.
static const char *next_tree_line(Player *player) {
    player_step(player, 1);
    const char *line = strstr(player_tree(player), "!see");
    assert_non_null(line);
    return line;
}

static void move_pointer(Player *player, double x, double y, unsigned buttons) {
    const PetriPointer pointer = {.size = sizeof pointer, .inside = true, .x = x, .y = y, .buttons = buttons};
    assert_int_equal(petri_report_pointer(player->session, &pointer), PETRI_OK);
}

static void press_key(Player *player, const char *key, bool down) {
    assert_int_equal(petri_report_key(player->session, key, down), PETRI_OK);
}

static void open_slow(Player *player) {
    PetriOptions options = player_options(player);
    options.fps = 2; // one frame per beat
    player_reopen(player, &options);
}

// If the host never reports input, the nodes are valid and write nothing.
static void test_without_reports_nothing_is_written(void **state) {
    Player *player = *state;
    player_run(player, "!window\n    !pointer state=:m\n    !key name=:a state=:k\n", 5);
    assert_text("state", player_state(player), "");
    assert_text("diagnostics", player_diagnostics(player), "");
}

static void test_pointer_shows_place_and_buttons(void **state) {
    Player *player = *state;
    player_run(player, POINTER, 1);
    move_pointer(player, 0.25, 0.75, 0);
    assert_text("inside", next_tree_line(player), "!see at=0.25;0.75 left=0 right=0\n");
    move_pointer(player, 0.5, 0, PETRI_BUTTON_LEFT | 8);
    assert_text("pressed", next_tree_line(player), "!see at=0.5;0 left=1 right=0 fourth=1\n");
    assert_text("held", next_tree_line(player), "!see at=0.5;0 left=1 right=0 fourth=1\n");
    move_pointer(player, 7, -7, PETRI_BUTTON_RIGHT);
    assert_text("beyond", next_tree_line(player), "!see at=1;0 left=0 right=1 fourth=0\n");
    const PetriPointer outside = {.size = sizeof outside, .buttons = PETRI_BUTTON_RIGHT};
    assert_int_equal(petri_report_pointer(player->session, &outside), PETRI_OK);
    assert_text("outside", next_tree_line(player), "!see left=0 right=1 fourth=0\n");
    assert_int_equal(petri_report_pointer(player->session, NULL), PETRI_OK);
    assert_text("away", next_tree_line(player), "!see left=0 right=0 fourth=0\n");
}

// Buttons also have the numbers that Flitter gives them.
static void test_numbers_of_buttons(void **state) {
    Player *player = *state;
    static const struct {
        unsigned buttons;
        const char *line;
    } rows[] = {{0, "!see l=0 r=0 m=0\n"},
                {PETRI_BUTTON_LEFT, "!see l=1 r=0 m=0\n"},
                {PETRI_BUTTON_MIDDLE, "!see l=0 r=0 m=1\n"},
                {PETRI_BUTTON_RIGHT, "!see l=0 r=1 m=0\n"},
                {8, "!see l=0 r=0 m=0 b4=1\n"}};
    player_run(player, "!window\n    !pointer state=:m\n!see l=$(:m;0) r=$(:m;1) m=$(:m;2) b4=$(:m;3)\n", 1);
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        move_pointer(player, 0, 0, rows[i].buttons);
        assert_text("buttons", next_tree_line(player), rows[i].line);
    }
}

static void test_click_between_frames(void **state) {
    Player *player = *state;
    player_run(player, POINTER, 1);
    move_pointer(player, 0, 0, PETRI_BUTTON_LEFT);
    move_pointer(player, 0, 0, 0);
    assert_text("click", next_tree_line(player), "!see at=0;0 left=1 right=0\n");
    assert_text("after", next_tree_line(player), "!see at=0;0 left=0 right=0\n");
}

static void test_positions_that_are_not_finite_are_rejected(void **state) {
    static const double bad[][2] = {{NAN, 0}, {0, NAN}, {INFINITY, 0}, {0, -INFINITY}};
    Player *player = *state;
    player_run(player, POINTER, 1);
    move_pointer(player, 0.5, 0.5, 0);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        const PetriPointer pointer = {
            .size = sizeof pointer, .inside = true, .x = bad[i][0], .y = bad[i][1], .buttons = PETRI_BUTTON_LEFT};
        assert_int_equal(petri_report_pointer(player->session, &pointer), PETRI_INVALID);
        assert_text("unchanged", next_tree_line(player), "!see at=0.5;0.5 left=0 right=0\n");
    }
    const PetriPointer outside = {
        .size = sizeof outside, .inside = false, .x = NAN, .y = NAN}; // outside the window, x and y are ignored
    assert_int_equal(petri_report_pointer(player->session, &outside), PETRI_OK);
    assert_text("outside", next_tree_line(player), "!see left=0 right=0\n");
}

static void test_key_shows_presses_that_are_shorter_than_a_frame(void **state) {
    Player *player = *state;
    open_slow(player);
    player_run(player, KEY, 1);
    assert_text("no input", next_tree_line(player), "!see\n");
    press_key(player, "a", true); // no `!key` node uses this key
    assert_text("up", next_tree_line(player), "!see down=0 pushed=0 released=1 toggled=0\n");
    press_key(player, "space", true);
    assert_text("down", next_tree_line(player), "!see down=1 pushed=1 at=3 released=0 toggled=1\n");
    press_key(player, "space", true); // an auto-repeat of the keyboard
    assert_text("held", next_tree_line(player), "!see down=1 pushed=1 at=3 released=0 toggled=1\n");
    press_key(player, "space", false);
    assert_text("released", next_tree_line(player), "!see down=0 pushed=0 at=3 released=1 until=5 toggled=1\n");
    press_key(player, "space", true);
    press_key(player, "space", false);
    assert_text("tapped", next_tree_line(player), "!see down=1 pushed=1 at=6 released=0 until=5 toggled=0\n");
    assert_text("after", next_tree_line(player), "!see down=0 pushed=0 at=6 released=1 until=7 toggled=0\n");
    press_key(player, "space", true);
    assert_text("down", next_tree_line(player), "!see down=1 pushed=1 at=8 released=0 until=7 toggled=1\n");
    press_key(player, "space", false);
    press_key(player, "space", true);
    assert_text("pressed again", next_tree_line(player), "!see down=1 pushed=1 at=9 released=0 until=7 toggled=0\n");
    petri_report_pointer(player->session, NULL);
    assert_text("away", next_tree_line(player), "!see down=0 pushed=0 at=9 released=1 until=10 toggled=0\n");
}

static void test_names_of_keys(void **state) {
    static const char *const good[] = {"a", "z", "0", "9", "space", "left", "page_up", "f12", "right_super", "menu"};
    static const char *const bad[] = {"", "A", "aa", "spcae", ".", "f13", "leer"};
    Player *player = *state;
    player_run(player, "!window\n    !key name='9' state=:nine\n    !key name=:z state=:zed\n", 1);
    for (size_t i = 0; i < COUNT_OF(good); i++)
        assert_claim(good[i], petri_report_key(player->session, good[i], true) == PETRI_OK);
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_claim(bad[i], petri_report_key(player->session, bad[i], true) == PETRI_INVALID);
    assert_true(petri_key_is_bound(player->session, "9") && petri_key_is_bound(player->session, "z"));
    assert_false(petri_key_is_bound(player->session, "a") || petri_key_is_bound(player->session, "spcae"));
    player_step(player, 1);
    assert_non_null(strstr(player_state(player), "$:nine = 1\n"));
    assert_non_null(strstr(player_state(player), "$:zed = 1\n"));
}

// Uses the last key with a long name and the first key with a name of one character.
static void test_keys_are_distinct(void **state) {
    Player *player = *state;
    player_run(player, "!window\n    !key name=:menu state=:m\n    !key name=:a state=:a\n!see m=$:m a=$:a\n", 1);
    press_key(player, "menu", true);
    assert_text("menu", next_tree_line(player), "!see m=1 a=0\n");
    press_key(player, "a", true);
    press_key(player, "menu", false);
    assert_text("a", next_tree_line(player), "!see m=0 a=1\n");
}

static void test_invalid_nodes_are_reported(void **state) {
    static const struct {
        const char *script;
        const char *reported;
    } rows[] = {
        {"!window\n    !pointer\n", "warning !pointer: attribute 'state' must be numbers, symbols or strings, such as "
                                    ":x; the node is skipped [invalid-input-node]\n"},
        {"!window\n    !pointer state=(!a)\n",
         "warning !pointer state=(!a): attribute 'state' must be numbers, symbols or strings, such as :x; the node is "
         "skipped [invalid-input-node]\n"},
        {"!window\n    !key state=:k\n",
         "warning !key state=:k: attribute 'name' is missing or null; the node is skipped [invalid-input-node]\n"},
        {"!window\n    !key name=:spcae state=:k\n",
         "warning !key state=:k: no key has the name :spcae; the node is skipped [invalid-input-node]\n"},
        {"!window\n    !key name=5 state=:k\n",
         "warning !key state=:k: no key has the name 5; the node is skipped [invalid-input-node]\n"},
        {"!window\n    !key name=:a state=:k nmae=:b\n",
         "warning !key state=:k: unknown attribute 'nmae'; did you mean 'name'? [unknown-attribute]\n"},
    };
    Player *player = *state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        player_forget(player);
        player_run(player, rows[i].script, 3);
        assert_text(rows[i].script, player_diagnostics(player), rows[i].reported);
    }
}

// Nodes outside windows get no input. State keys may have several elements, and several nodes may use the same key.
static void test_nodes_work_only_in_windows(void **state) {
    Player *player = *state;
    player_run(player,
               "!pointer state=:top\n!group\n    !pointer state=:inner\n!window\n    !pointer state=:a;1\n"
               "    !canvas\n        !pointer state=:deep\n!window\n    !pointer state=:b\n    !pointer state='c'\n",
               1);
    move_pointer(player, 1, 0, 0);
    player_step(player, 1);
    const char *found = player_state(player);
    assert_text("state", found,
                "$(:a;1) = 1;0\n$(:a;1;:left) = 0\n$(:a;1;:middle) = 0\n$(:a;1;:right) = 0\n"
                "$(:a;1;0) = 0\n$(:a;1;1) = 0\n$(:a;1;2) = 0\n"
                "$:b = 1;0\n$(:b;:left) = 0\n$(:b;:middle) = 0\n$(:b;:right) = 0\n"
                "$(:b;0) = 0\n$(:b;1) = 0\n$(:b;2) = 0\n"
                "$'c' = 1;0\n$('c';:left) = 0\n$('c';:middle) = 0\n$('c';:right) = 0\n"
                "$('c';0) = 0\n$('c';1) = 0\n$('c';2) = 0\n");
}

// The values of a removed node stay in the state, and the node continues when it returns. A reload keeps pressed keys.
static void test_input_nodes_can_disappear(void **state) {
    Player *player = *state;
    player_run(player, "!window\n    if frame%2==0\n        !key name=:a state=:k\n", 1);
    press_key(player, "a", true);
    player_step(player, 1);
    assert_true(strncmp(player_state(player), "$:k = 1\n", 8) == 0);
    press_key(player, "a", false);
    player_step(player, 1);
    assert_true(strncmp(player_state(player), "$:k = 1\n", 8) == 0);
    player_step(player, 1);
    assert_true(strncmp(player_state(player), "$:k = 0\n", 8) == 0);
    press_key(player, "a", true);
    player_run(player, "!window\n    !key name=:a state=:other\n", 2);
    assert_non_null(strstr(player_state(player), "$:other = 1\n"));
}

TEST_GROUP(scene_input) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_without_reports_nothing_is_written),
        PLAYER_TEST(test_pointer_shows_place_and_buttons),
        PLAYER_TEST(test_numbers_of_buttons),
        PLAYER_TEST(test_click_between_frames),
        PLAYER_TEST(test_positions_that_are_not_finite_are_rejected),
        PLAYER_TEST(test_key_shows_presses_that_are_shorter_than_a_frame),
        PLAYER_TEST(test_names_of_keys),
        PLAYER_TEST(test_invalid_nodes_are_reported),
        PLAYER_TEST(test_nodes_work_only_in_windows),
        PLAYER_TEST(test_input_nodes_can_disappear),
        PLAYER_TEST(test_keys_are_distinct),
    };
    return cmocka_run_group_tests_name("input", tests, NULL, NULL);
}
