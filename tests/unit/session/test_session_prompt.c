// test_session_prompt.c: tests statements and expressions at the prompt.
#include "petri-inspect.h"
#include "petri-live.h"
#include "player.h"

static const char *const SCRIPT = "%pragma tempo 120\n"
                                  "let COUNT=3\n"
                                  "    twice=frame*2\n"
                                  "func add(a, b=1)\n"
                                  "    a+b\n"
                                  "!counter state=:c rate=1\n"
                                  "!shape n=COUNT\n";

// Returns the prompt's output for an input.
static const char *typed(Player *player, const char *text, PetriStatus wanted) {
    PetriPromptResult done;
    player->printed.len = 0;
    note(&player->printed, "", 0);
    PetriStatus status =
        petri_prompt(player->session, text, PETRI_NUL_TERMINATED, note, &player->printed, &done, sizeof done);
    if (status != wanted) {
        print_error("%s: status %d\n%s", text, status, player_diagnostics(player));
        fail();
    }
    return player->printed.text;
}

static void check_typed(Player *player, const ScriptRow *rows, size_t count) {
    for (size_t i = 0; i < count; i++)
        assert_text(rows[i].script, typed(player, rows[i].script, PETRI_OK), rows[i].wanted);
}

#define CHECK_TYPED(player, rows) check_typed(player, rows, sizeof rows / sizeof rows[0])

static void test_prompt_prints_the_values_of_the_frame(void **state) {
    Player *player = *state;
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    const ScriptRow before[] = {
        {"1+2", "3\n"},     {"frame;time;beat", "0;0;0\n"}, {"COUNT;add(COUNT)", "3;4\n"},
        {"null", "null\n"}, {"'a';:b", "'a';:b\n"},         {"$:c", "null\n"},
        {"add", "(add)\n"}, {"2 if 1 else 3", "2\n"},       {"", ""},
    };
    CHECK_TYPED(player, before);
    player_step(player, 3);
    const ScriptRow after[] = {
        {"frame;twice", "2;4\n"},
        {"$:c", "0.03333333333333333\n"},
        {"1\n2\n", "1\n2\n"},
        {"debug(7)", "> 7\n7\n"},
    };
    CHECK_TYPED(player, after);
    assert_string_equal(player_diagnostics(player), "");
}

static void test_statements_persist(void **state) {
    Player *player = *state;
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    const ScriptRow rows[] = {
        {"let k=COUNT+frame", ""},
        {"k", "3\n"},
        {"let a;b=k;10", ""},
        {"func f(x)\n    if x < 2\n        1\n    else\n        x*f(x-1)\n", ""},
        {"f(5)+a+b", "133\n"},
        {"!extra v=k\n    !inner\n", "!extra v=3\n    !inner\n"},
        {"for i in ..2\n    !loop i=i\n", "!loop i=0\n!loop i=1\n"},
    };
    CHECK_TYPED(player, rows);
    player_step(player, 5);
    assert_string_equal(player_tree(player), "!counter state=:c rate=1\n!shape n=3\n!extra v=7\n    !inner\n"
                                             "!loop i=0\n!loop i=1\n");
    assert_string_equal(typed(player, "k;a;b", PETRI_OK), "7;7;10\n");
    assert_string_equal(petri_prompt_statement(player->session, 0), "let k=COUNT+frame");
    assert_int_equal(petri_prompt_clear(player->session, false), 2);
    player_step(player, 1);
    assert_string_equal(player_tree(player), "!counter state=:c rate=1\n!shape n=3\n");
    assert_string_equal(typed(player, "k", PETRI_OK), "8\n");
    assert_int_equal(petri_prompt_clear(player->session, true), 3);
    assert_null(petri_prompt_statement(player->session, 0));
    assert_string_equal(typed(player, "k", PETRI_OK), "null\n");
    assert_non_null(strstr(player_diagnostics(player), "unbound name 'k'"));
}

// The result counts the statements of an input by kind, and names a binding that shadows one of the script.
static void test_result_counts_statements(void **state) {
    Player *player = *state;
    PetriPromptResult done;
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    assert_int_equal(petri_prompt(player->session, "1\n2\n3\nlet a=1\nlet b=2\n!node\n", PETRI_NUL_TERMINATED, NULL,
                                  NULL, &done, sizeof done),
                     PETRI_OK);
    assert_int_equal(done.values, 3);
    assert_int_equal(done.bindings, 2);
    assert_int_equal(done.nodes, 1);
    assert_null(done.shadowed);
    assert_int_equal(
        petri_prompt(player->session, "let COUNT=1\n", PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done), PETRI_OK);
    assert_string_equal(done.shadowed, "COUNT");
}

// Names that were bound at the prompt are evaluated in the state after the frame. Names and nodes of the script are
// evaluated in the state before it, whatever causes the evaluation.
static void test_frame_values(void **state) {
    static const char *const values = "x;y;$(:b;0);seen;n;tempo";
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.rollback_frames = true;
    player_reopen(player, &options);
    assert_int_equal(player_load(player, "let SPEED=SPEED or 60\n"
                                         "    seen=$(:b;0)\n"
                                         "!physics state=:b dimensions=1\n"
                                         "    !particle id=0 velocity=SPEED\n"
                                         "!trace at=seen\n"),
                     PETRI_OK);
    typed(player, "let x=$(:b;0) y=x+1 n=seen+1\n!typed at=x\n", PETRI_OK);
    player_step(player, 4);
    assert_string_equal(typed(player, values, PETRI_OK), "3;4;3;2;3;120\n");
    char *tree = strdup(player_tree(player));
    assert_non_null(strstr(tree, "!trace at=2\n!typed at=2\n"));
    assert_int_equal(petri_set_tempo(player->session, 60), PETRI_OK);
    assert_string_equal(typed(player, values, PETRI_OK), "3;4;3;2;3;60\n");
    assert_int_equal(petri_set_parameter(player->session, "SPEED", "60"), PETRI_OK);
    assert_string_equal(typed(player, values, PETRI_OK), "3;4;3;2;3;60\n");
    PetriConfig *config = petri_config_get(player->session);
    assert_int_equal(petri_set_fps(player->session, 30), PETRI_OK);
    petri_config_apply(player->session, config);
    petri_config_free(config);
    assert_int_equal(petri_preview(player->session), PETRI_OK);
    assert_string_equal(player_tree(player), tree);
    assert_string_equal(typed(player, values, PETRI_OK), "3;4;3;2;3;60\n");
    player_step(player, 1);
    assert_string_equal(typed(player, values, PETRI_OK), "4;5;4;3;4;60\n");
    assert_string_equal(player_diagnostics(player), "");
    free(tree);
}

// A system typed at the prompt is simulated like a system of the script.
static void test_typed_system_simulates(void **state) {
    static const char *const system = "!physics state=:p dimensions=1 time=time\n"
                                      "    !particle id=0 position=1 velocity=COUNT\n"
                                      "    !constant force=2\n";
    Player *player = *state;
    char whole[1000];
    snprintf(whole, sizeof whole, "%s%s", SCRIPT, system);
    player_run(player, whole, 10);
    char *wanted = strdup(player_state(player));
    petri_reset(player->session);
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    typed(player, system, PETRI_OK);
    player_step(player, 10);
    assert_string_equal(player_state(player), wanted);
    free(wanted);
}

static void test_errors_are_reported(void **state) {
    Player *player = *state;
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    static const char *const wrong[] = {"1+", "let x", "%pragma tempo 3\n", "!a x=", "'"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        for (int twice = 0; twice < 2; twice++) { // if an input is repeated, its diagnostics are reported again
            typed(player, wrong[i], PETRI_INVALID);
            assert_non_null(strstr(player_diagnostics(player), "error prompt:1:"));
            player_forget(player);
        }
    }
    assert_null(petri_prompt_statement(player->session, 0));
    player_step(player, 2);
    assert_string_equal(typed(player, "COUNT", PETRI_OK), "3\n");
    // An error that an input causes is not an error of the frame.
    assert_string_equal(typed(player, "'s'(1)", PETRI_OK), "null\n");
    assert_non_null(strstr(player_diagnostics(player), "a string cannot be called"));
    assert_string_equal(player_print(player, PETRI_PRINT_ERROR), "");
}

static void test_completeness_says_if_more_lines_may_follow(void **state) {
    Player *player = *state;
    static const struct {
        const char *text;
        PetriCompleteness wanted;
    } rows[] = {
        {"1+2\n", PETRI_COMPLETE},
        {"let x=1\n", PETRI_COMPLETE},
        {"x where y=2\n", PETRI_COMPLETE},
        {"!a\n", PETRI_EXTENDABLE},
        {"!a x=1\n    !b\n", PETRI_EXTENDABLE},
        {"@f x=1\n", PETRI_EXTENDABLE},
        {"for i in ..3\n", PETRI_NEEDS_BLOCK},
        {"if x\n", PETRI_NEEDS_BLOCK},
        {"if x\n    1\nelse\n", PETRI_NEEDS_BLOCK},
        {"func f(x)\n", PETRI_NEEDS_BLOCK},
        {"func f(x)\n    x\n", PETRI_EXTENDABLE},
        {"let x=\n", PETRI_NEEDS_BLOCK},
        {"(1;\n", PETRI_INCOMPLETE},
        {"f(1, (2\n;3)\n", PETRI_INCOMPLETE},
        {"f(1, (2\n;3))\n", PETRI_COMPLETE},
        {"'''abc\n", PETRI_INCOMPLETE},
        {"'''abc\ndef'''\n", PETRI_COMPLETE},
        {"1 + \\\n", PETRI_INCOMPLETE},
        {"1 + \\\n2\n", PETRI_COMPLETE},
        {"1+\n", PETRI_COMPLETE},   // invalid, whatever may follow
        {")(\n", PETRI_COMPLETE},   //
        {"?'''\n", PETRI_COMPLETE}, //
        {"'abc\n", PETRI_COMPLETE}, //
        {"\xff\n", PETRI_COMPLETE}, //
        {"\n", PETRI_COMPLETE},
        {"-- a remark\n", PETRI_COMPLETE},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (petri_prompt_check(player->session, rows[i].text, PETRI_NUL_TERMINATED) != rows[i].wanted) {
            print_error("%s", rows[i].text);
            assert_int_equal(petri_prompt_check(player->session, rows[i].text, PETRI_NUL_TERMINATED), rows[i].wanted);
        }
    assert_string_equal(player_diagnostics(player), "");
}

static void test_evaluate_takes_a_single_expression(void **state) {
    Player *player = *state;
    PetriEvaluation result;
    player_run(player, SCRIPT, 2);
    player->printed.len = 0;
    assert_int_equal(petri_evaluate(player->session, "COUNT*2", PETRI_NUL_TERMINATED, &result, sizeof result, note,
                                    &player->printed),
                     PETRI_OK);
    assert_string_equal(player->printed.text, "6");
    assert_true(result.is_true && result.length == 1 && result.number == 6 && result.seconds >= 0);
    assert_int_equal(petri_evaluate(player->session, "null", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
                     PETRI_OK);
    assert_true(!result.is_true && result.length == 0 && result.number != result.number);
    assert_int_equal(petri_evaluate(player->session, "1;0", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
                     PETRI_OK);
    assert_true(result.is_true && result.length == 2 && result.number != result.number);
    assert_int_equal(petri_evaluate(player->session, "1\n2", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
                     PETRI_INVALID);
    assert_string_equal(player_diagnostics(player),
                        "error prompt:1:1 the input must be a single expression [syntax]\n");
    static const char *const wrong[] = {"let x=1", "1\n2", "", "1+", "%pragma tempo 1\n"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_int_equal(
            petri_evaluate(player->session, wrong[i], PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
            PETRI_INVALID);
}

// Expressions leave nothing in memory.
static void test_expressions_retain_no_memory(void **state) {
    Player *player = *state;
    PetriEvaluation result;
    PetriOptions options = player_options(player);
    options.memory_limit = 1 << 20;
    player_reopen(player, &options);
    player_run(player, SCRIPT, 2);
    for (int i = 0; i < 1000; i++)
        assert_int_equal(
            petri_evaluate(player->session, "COUNT;..1000", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
            PETRI_OK);
    for (int i = 0; i < 1000; i++)
        assert_string_equal(typed(player, "len(COUNT;..1000)", PETRI_OK), "1001\n");
    assert_null(petri_prompt_statement(player->session, 0));
}

static void test_visible_names(void **state) {
    Player *player = *state;
    bool found[3] = {false};
    static const char *const wanted[] = {"COUNT", "DEFINED", "beat"};
    assert_int_equal(petri_define(player->session, "DEFINED=1"), PETRI_OK);
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    const char *name;
    for (size_t i = 0; (name = petri_visible_name(player->session, i)) != NULL; i++)
        for (int k = 0; k < 3; k++)
            found[k] |= strcmp(name, wanted[k]) == 0;
    assert_true(found[0] && found[1] && found[2]);
}

// Without a script, the prompt returns PETRI_INVALID.
static void test_prompt_needs_script(void **state) {
    Player *player = *state;
    typed(player, "1", PETRI_INVALID);
    assert_int_equal(petri_preview(player->session), PETRI_INVALID);
    assert_int_equal(petri_reload(player->session, NULL), PETRI_INVALID);
    assert_null(petri_visible_name(player->session, 1000));
    assert_null(petri_source_file(player->session, 0));
}

TEST_GROUP(session_prompt) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_prompt_prints_the_values_of_the_frame),
        PLAYER_TEST(test_statements_persist),
        PLAYER_TEST(test_result_counts_statements),
        PLAYER_TEST(test_frame_values),
        PLAYER_TEST(test_typed_system_simulates),
        PLAYER_TEST(test_errors_are_reported),
        PLAYER_TEST(test_completeness_says_if_more_lines_may_follow),
        PLAYER_TEST(test_evaluate_takes_a_single_expression),
        PLAYER_TEST(test_expressions_retain_no_memory),
        PLAYER_TEST(test_visible_names),
        PLAYER_TEST(test_prompt_needs_script),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
