// test_session_functions.c: tests host functions (petri_add_function).
#include "player.h"

typedef struct Calls {
    int count;
    uint32_t last_count;
    PetriSession *session; // session on which the function makes calls that must be rejected
    PetriStatus stepped;
} Calls;

static PetriValue sum(PetriCall *call, void *host, const PetriValue *arguments, uint32_t count) {
    Calls *calls = host;
    double *result = petri_call_alloc_numbers(call, 1);
    assert_non_null(result);
    *result = 0;
    calls->count++;
    calls->last_count = count;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < arguments[i].length; k++) {
            if (!arguments[i].numbers) {
                petri_call_error(call, "only numbers can be added");
                return (PetriValue){0};
            }
            *result += arguments[i].numbers[k];
        }
    if (calls->session)
        calls->stepped = petri_step(calls->session);
    return (PetriValue){.length = 1, .numbers = result};
}

// Returns the string of its first argument twice, stored in memory of the host.
static PetriValue twice(PetriCall *call, void *host, const PetriValue *arguments, uint32_t count) {
    static PetriItem items[2];
    (void)call;
    (void)host;
    assert_int_equal(count, 1);
    if (!arguments[0].items)
        return (PetriValue){.length = 3}; // this value is invalid
    items[0] = items[1] = arguments[0].items[0];
    return (PetriValue){.length = 2, .items = items};
}

// Returns its argument and the next number, stored in memory of the host.
static PetriValue pair(PetriCall *call, void *host, const PetriValue *arguments, uint32_t count) {
    static double numbers[2];
    (void)call;
    (void)host;
    assert_int_equal(count, 1);
    numbers[0] = arguments[0].numbers[0];
    numbers[1] = numbers[0] + 1;
    return (PetriValue){.length = 2, .numbers = numbers};
}

static PetriStatus add_function(Player *player, const char *name, const char *parameters, bool pure,
                                PetriFunctionCall *call, void *host) {
    return petri_add_function(player->session, &(PetriFunction){sizeof(PetriFunction), name, parameters,
                                                                "A function of a test.", pure, call, host});
}

static void test_host_function_is_called_in_each_frame(void **state) {
    Player *player = *state;
    Calls calls = {0};
    assert_int_equal(add_function(player, "total", "x, y=0, ...", false, sum, &calls), PETRI_OK);
    assert_int_equal(add_function(player, "twice", "text", false, twice, NULL), PETRI_OK);
    player_run(player,
               "let f=total\n!a x=total(1;2, 3) y=f(4) z=total(y=1, x=2) w=total(1, 2, 3, 4;5)\n!b t=twice('é') n=f",
               2);
    assert_text("results", player_tree(player), "!a x=6 y=4 z=3 w=15\n!b t='é';'é' n=(total)\n");
    assert_int_equal(calls.count, 8); // the function is called in each frame
    assert_string_equal(player_diagnostics(player), "");
}

// A result is copied, so the host may overwrite its memory in the next call.
static void test_results_are_copied(void **state) {
    Player *player = *state;
    assert_int_equal(add_function(player, "pair", "x", false, pair, NULL), PETRI_OK);
    player_run(player, "!a x=pair(7) y=pair(9)\n", 1);
    assert_text("results", player_tree(player), "!a x=7;8 y=9;10\n");
}

static void test_errors_are_reported(void **state) {
    Player *player = *state;
    Calls calls = {0};
    assert_int_equal(add_function(player, "total", "x, y=0", false, sum, &calls), PETRI_OK);
    assert_int_equal(add_function(player, "twice", "text", false, twice, NULL), PETRI_OK);
    player_run(player, "!a x=total('a') y=total() z=total(1, 2, 3) v=total(1, q=3) w=twice(1)\n!b x=totel(1)", 3);
    assert_text("faults", player_diagnostics(player),
                "warning t.fl:2:6 unbound name 'totel' is null [unbound-name]\n"
                "warning t.fl:1:6 total: only numbers can be added [bad-call]\n"
                "warning t.fl:1:19 total: too few arguments: 0 given to total(x, y=0) [bad-call]\n"
                "warning t.fl:1:29 total: too many arguments: 3 given to total(x, y=0) [bad-call]\n"
                "warning t.fl:1:46 total: unknown argument 'q' for total(x, y=0) [bad-call]\n"
                "warning t.fl:1:62 twice: the host function returned an invalid value [bad-call]\n");
    assert_text("null", player_tree(player), "!a\n!b\n");
    PetriDiagnostic first;
    assert_true(petri_diagnostic(player->session, 0, &first, sizeof first));
    assert_non_null(strstr(first.rendered, "did you mean 'total'?"));
}

// A pure function is called once at load time, unless the simplifier is off.
static void test_pure_calls_are_folded(void **state) {
    Player *player = *state;
    Calls calls = {0};
    assert_int_equal(add_function(player, "total", "x, y=0", true, sum, &calls), PETRI_OK);
    player_run(player, "!a x=total(1;2)+1", 3);
    assert_text("result", player_tree(player), "!a x=4\n");
    assert_int_equal(calls.count, 1);
    assert_int_equal(calls.last_count, 2);
}

// petri_check also calls host functions, but in a separate session. A function must not step the session that calls it.
static void test_step_within_call_fails(void **state) {
    Player *player = *state;
    Calls calls = {.session = player->session};
    assert_int_equal(add_function(player, "total", "x", false, sum, &calls), PETRI_OK);
    player_run(player, "!a x=total(1)", 1);
    assert_int_equal(calls.stepped, PETRI_INVALID);
    assert_int_equal(petri_frame_number(player->session), 0);
    assert_int_equal(petri_check_text(player->session, "c.fl", "!window size=total(2);1", PETRI_NUL_TERMINATED),
                     PETRI_OK);
    assert_string_equal(player_diagnostics(player), "");
}

static void test_invalid_functions_are_rejected(void **state) {
    Player *player = *state;
    PetriBuiltin found;
    static const char *const names[] = {"", "a b", "sin", "pi", "time", "1"};
    static const char *const bad[] = {"x,y", "x, ", "x=1, y", "..., x", "a, b, c, d, e, f, g, h, i", "1"};
    static const char *const good[] = {
        "", "...", "x, ...", "x=1, y=2", "x, y, z", "a, b, c, d, e=1", "a, b, c, d, e, f, g, h, ..."};
    for (size_t i = 0; i < COUNT_OF(names); i++)
        assert_int_equal(add_function(player, names[i], "x", false, sum, NULL), PETRI_INVALID);
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_int_equal(add_function(player, "f", bad[i], false, sum, NULL), PETRI_INVALID);
    assert_false(petri_host_function(player->session, 0, &found, sizeof found));
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        const char name[] = {(char)('a' + i), 0};
        assert_int_equal(add_function(player, name, good[i], false, sum, NULL), PETRI_OK);
        assert_true(petri_host_function(player->session, i, &found, sizeof found));
        assert_string_equal(found.name, name);
        assert_string_equal(found.parameters, good[i]);
        assert_string_equal(found.help, "A function of a test.");
    }
    assert_int_equal(add_function(player, "a", "x", false, sum, NULL), PETRI_INVALID);
    assert_int_equal(add_function(player, "f", "x", false, NULL, NULL), PETRI_INVALID);
    assert_int_equal(petri_add_function(player->session, &(PetriFunction){.name = "f"}), PETRI_INVALID);
    assert_int_equal(petri_add_function(player->session, NULL), PETRI_INVALID);
    assert_int_equal(petri_add_function(NULL, NULL), PETRI_INVALID);
    assert_null(petri_call_alloc_numbers(NULL, 1));
    petri_call_error(NULL, "");
}

TEST_GROUP(session_functions) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_host_function_is_called_in_each_frame),
        PLAYER_TEST(test_results_are_copied),
        PLAYER_TEST(test_errors_are_reported),
        PLAYER_TEST(test_pure_calls_are_folded),
        PLAYER_TEST(test_step_within_call_fails),
        PLAYER_TEST(test_invalid_functions_are_rejected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
