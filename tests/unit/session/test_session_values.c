// test_session_values.c: tests values in the host interface: the state, global names, and the tree of the frame.
#include "player.h"

#include <math.h>

static PetriValue numbers(const double *numbers, uint32_t length) {
    return (PetriValue){.length = length, .numbers = numbers};
}

static PetriValue items(const PetriItem *items, uint32_t length) {
    return (PetriValue){.length = length, .items = items};
}

static const char *text(Player *player, PetriValue value) {
    return petri_format_value(player->session, value);
}

static const PetriString name = {"käse", 5};
static const PetriItem mixed[] = {{PETRI_STRING, {.string = &name}}, {PETRI_NUMBER, {.number = 2.5}}};
static const PetriItem only_numbers[] = {{PETRI_NUMBER, {.number = 1}}, {PETRI_NUMBER, {.number = 2}}};

static void test_printed_values(void **state) {
    Player *player = *state;
    double some[] = {1, petri_symbol(player->session, "cells"), 0.1};
    assert_string_equal(text(player, numbers(some, 3)), "1;:cells;0.1");
    assert_string_equal(text(player, items(mixed, 2)), "'käse';2.5");
    assert_string_equal(text(player, items(only_numbers, 2)), "1;2");
    assert_string_equal(text(player, items(&(PetriItem){PETRI_NUMBER, {.number = 0}}, 1)), "0");
    assert_string_equal(text(player, (PetriValue){0}), "null");
    assert_null(text(player, (PetriValue){.length = 1}));
    assert_null(text(player, (PetriValue){.length = 1, .numbers = some, .items = mixed}));
    const PetriString bad = {"\xff", 1}, empty = {NULL, 0};
    assert_null(text(player, items(&(PetriItem){PETRI_STRING, {.string = &bad}}, 1)));
    assert_string_equal(text(player, items(&(PetriItem){PETRI_STRING, {.string = &empty}}, 1)), "''");
    assert_null(text(player, items(&(PetriItem){PETRI_STRING, {.string = NULL}}, 1)));
    assert_true(isnan(petri_symbol(player->session, "no name")));
    assert_true(isnan(petri_symbol(player->session, "")));
}

static void test_state_access(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    player_run(player, "!counter state=:c rate=1 time=frame\n!look at=$(:c) own=$('käse';2.5)", 3);
    double c = petri_symbol(session, "c"), three = 3, bad[] = {NAN, INFINITY};
    PetriValue counter = petri_state_get(session, numbers(&c, 1));
    assert_int_equal(counter.length, 1);
    assert_number("a counter", counter.numbers[0], 2);
    assert_int_equal(petri_state_get(session, numbers(&three, 1)).length, 0);
    assert_int_equal(petri_state_get(session, numbers(bad, 1)).length, 0);
    assert_int_equal(petri_state_set(session, items(mixed, 2), numbers(&three, 1)), PETRI_OK);
    assert_number("a key with text", petri_state_get(session, items(mixed, 2)).numbers[0], 3);
    player_step(player, 1);
    assert_string_equal(text(player, petri_tree_get(petri_tree(session).items[1].as.node, "own")), "3");
    assert_int_equal(petri_state_set(session, items(mixed, 2), items(mixed, 2)), PETRI_OK);
    assert_string_equal(text(player, petri_state_get(session, items(mixed, 2))), "'käse';2.5");
    assert_int_equal(petri_state_set(session, items(mixed, 2), (PetriValue){0}), PETRI_OK);
    assert_int_equal(petri_state_get(session, items(mixed, 2)).length, 0);
    assert_int_equal(petri_state_set(session, numbers(bad, 1), numbers(&three, 1)), PETRI_INVALID);
    assert_int_equal(petri_state_set(session, numbers(&c, 1), numbers(bad + 1, 1)), PETRI_INVALID);
    assert_int_equal(petri_state_set(session, numbers(&c, 1), petri_tree(session)), PETRI_INVALID);
    assert_int_equal(petri_state_set(session, petri_tree(session), numbers(&c, 1)), PETRI_INVALID);
    assert_number("unchanged", petri_state_get(session, numbers(&c, 1)).numbers[0], 3);
}

static void test_iteration_visits_each_entry_once(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    PetriValue key, value;
    uint32_t at = 0;
    assert_false(petri_state_next(session, &at, &key, &value));
    player_run(player, "!physics state=:p dimensions=2 time=frame\n    !particle id=1 position=3;4\n", 2);
    char all[200] = "";
    for (at = 0; petri_state_next(session, &at, &key, &value);) {
        strcat(strcat(all, text(player, key)), "=");
        strcat(strcat(all, text(player, value)), " ");
    }
    assert_string_equal(all, ":p=0 :p;:iteration=1 :p;:clock=1 :p;:run=0 :p;:last=1 :p;1=3;4 :p;1;:velocity=0;0 ");
}

// A particle continues from a position that the host has set.
static void test_moved_particle(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    player_run(player, "!physics state=:p dimensions=2 time=frame resolution=1\n    !particle id=1 velocity=1;0\n", 3);
    double key[] = {petri_symbol(session, "p"), 1}, there[] = {100, 50};
    assert_int_equal(petri_state_set(session, numbers(key, 2), numbers(there, 2)), PETRI_OK);
    player_step(player, 1);
    PetriSystem system;
    assert_true(petri_system(session, 0, &system, sizeof system));
    assert_number("x", system.position.data[0], 101);
    assert_number("y", system.position.data[1], 50);
}

static const char *heat(Player *player) {
    return text(player, petri_tree_get(petri_tree(player->session).items[0].as.node, "heat"));
}

static void test_global_changes_at_the_next_frame(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    double one = 1, many[] = {4, 5, 6};
    assert_int_equal(petri_set_global(session, "warmth", numbers(&one, 1)), PETRI_OK);
    assert_int_equal(petri_set_global(session, "other", (PetriValue){0}), PETRI_OK);
    player_run(player, "let twice=2*warmth\n!dish heat=twice;other", 1);
    assert_string_equal(heat(player), "2");
    uint64_t number = petri_config_revision(session);
    assert_int_equal(petri_set_global(session, "warmth", numbers(many, 3)), PETRI_OK);
    assert_int_equal(petri_set_global(session, "other", items(mixed, 2)), PETRI_OK);
    many[0] = 1000;                         // the session has its own copy
    assert_string_equal(heat(player), "2"); // the value does not change within a frame
    player_step(player, 1);
    assert_string_equal(heat(player), "8;10;12;'käse';2.5");
    assert_int_equal(petri_config_revision(session), number); // the script is not recompiled
    PetriEvaluation result;
    assert_int_equal(
        petri_evaluate(session, "warmth[0]+twice[0]", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
        PETRI_OK);
    assert_number("at the prompt", result.number, 12);
    PetriPromptResult done;
    assert_int_equal(
        petri_prompt(session, "let both=warmth[1]+twice[1]", PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done),
        PETRI_OK);
    assert_int_equal(petri_set_global(session, "later", numbers(&one, 1)), PETRI_OK);
    player_step(player, 1);
    assert_int_equal(petri_evaluate(session, "both", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
                     PETRI_OK);
    assert_number("typed", result.number, 15);
    assert_int_equal(petri_reload(session, NULL), PETRI_OK);
    player_step(player, 1);
    assert_int_equal(petri_evaluate(session, "both+later", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
                     PETRI_OK);
    assert_number("typed, with a new name before it", result.number, 16);
    assert_int_equal(petri_set_global(session, "time", numbers(&one, 1)), PETRI_INVALID);
    assert_int_equal(petri_set_global(session, "a b", numbers(&one, 1)), PETRI_INVALID);
    assert_int_equal(petri_set_global(session, "x", petri_tree(session)), PETRI_INVALID);
    assert_string_equal(player_diagnostics(player), "");
}

// A host may set a name for each frame, because old values are freed.
static void test_globals_retain_no_old_values(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.memory_limit = 1 << 20; // the session may use 64 MiB more for its own data
    player_reopen(player, &options);
    static PetriItem many[10000];
    for (int i = 0; i < 1000; i++) {
        many[0].as.number = i;
        assert_int_equal(petri_set_global(player->session, "warmth", items(many, COUNT_OF(many))), PETRI_OK);
    }
    player_run(player, "!dish heat=warmth[..2]", 1);
    assert_string_equal(heat(player), "999;0");
}

// petri_check accepts global names, and does not report those that are unused.
static void test_check_knows_globals(void **state) {
    Player *player = *state;
    double one = 1;
    assert_int_equal(petri_set_global(player->session, "used", numbers(&one, 1)), PETRI_OK);
    assert_int_equal(petri_set_global(player->session, "unused", numbers(&one, 1)), PETRI_OK);
    assert_int_equal(petri_check_text(player->session, "x.fl", "!window size=used;1", PETRI_NUL_TERMINATED), PETRI_OK);
    assert_string_equal(player_diagnostics(player), "");
}

static void test_tree_gives_nodes_tags_and_attributes(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    assert_int_equal(petri_tree(session).length, 0);
    player_run(player, "!dish #round #flat size=3;4 name='p'\n    !cell\n    !cell x=1\n12", 1);
    PetriValue tree = petri_tree(session), value;
    assert_int_equal(tree.length, 2);
    assert_string_equal(text(player, tree), "(!dish);12");
    assert_int_equal(tree.items[1].type, PETRI_NUMBER);
    assert_number("a number", tree.items[1].as.number, 12);
    assert_int_equal(tree.items[0].type, PETRI_NODE);
    const PetriNode *dish = tree.items[0].as.node;
    assert_string_equal(petri_tree_kind(dish), "dish");
    assert_string_equal(petri_tree_tag(dish, 0), "flat");
    assert_string_equal(petri_tree_tag(dish, 1), "round");
    assert_null(petri_tree_tag(dish, 2));
    assert_string_equal(petri_tree_attribute(dish, 1, &value), "name");
    assert_string_equal(text(player, value), "'p'");
    assert_null(petri_tree_attribute(dish, 2, &value));
    assert_number("size", petri_tree_get(dish, "size").numbers[1], 4);
    assert_int_equal(petri_tree_get(dish, "colour").length, 0);
    assert_number("x", petri_tree_get(petri_tree_child(dish, 1), "x").numbers[0], 1);
    assert_null(petri_tree_child(dish, 2));
    assert_null(petri_tree_child(NULL, 0));
    assert_null(petri_tree_kind(NULL));
}

static void assert_place(const PetriNode *node, const char *file, uint32_t line, uint32_t column) {
    uint32_t found_line = 0, found_column = 0;
    assert_string_equal(petri_tree_place(node, &found_line, &found_column), file);
    assert_int_equal(found_line, line);
    assert_int_equal(found_column, column);
}

// Nodes of a loop, which share one batch, and nodes that a function makes or changes have the place of their `!`.
static void test_nodes_have_places(void **state) {
    Player *player = *state;
    player_run(player, "func f(x)\n    !cell é=x\n!dish\n    for i in ..3\n        !cell x=i\n    f(1) y=2\n", 1);
    const PetriNode *dish = petri_tree(player->session).items[0].as.node;
    const char *file = petri_tree_place(dish, NULL, NULL);
    assert_non_null(file);
    assert_place(dish, file, 3, 1);
    for (uint32_t i = 0; i < 3; i++)
        assert_place(petri_tree_child(dish, i), file, 5, 9);
    assert_place(petri_tree_child(dish, 3), file, 2, 5);
    assert_null(petri_tree_place(NULL, NULL, NULL));
}

TEST_GROUP(session_values) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_printed_values),
        PLAYER_TEST(test_state_access),
        PLAYER_TEST(test_iteration_visits_each_entry_once),
        PLAYER_TEST(test_moved_particle),
        PLAYER_TEST(test_global_changes_at_the_next_frame),
        PLAYER_TEST(test_check_knows_globals),
        PLAYER_TEST(test_tree_gives_nodes_tags_and_attributes),
        PLAYER_TEST(test_nodes_have_places),
        PLAYER_TEST(test_globals_retain_no_old_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
