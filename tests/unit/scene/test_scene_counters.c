// test_scene_counters.c: tests `!counter` (spec counters.md). The first value is clamp(initial). In each later frame,
// the new value is clamp((time − last)·rate + value).
#include "player.h"

// Returns the state lines of `:c` after `frames` frames at 10 fps, without the `:time` line.
static const char *counter(Player *player, const char *script, int frames) {
    PetriOptions options = player_options(player);
    options.fps = 10;
    player_reopen(player, &options);
    player_run(player, script, frames);
    const char *state = player_state(player);
    char *end = strstr(state, "\n$(:c;:time)");
    if (!end)
        return state;
    *end = 0;
    return state + strlen("$:c = ");
}

typedef struct CounterRow {
    const char *attributes;
    int frames;
    const char *value;
} CounterRow;

static void test_value_grows_by_rate_within_the_limits(void **state) {
    static const CounterRow rows[] = {
        {"", 1, "0"},
        {"", 3, "0"}, // a counter without a rate does not change
        {"rate=1", 1, "0"},
        {"rate=1", 2, "0.1"},
        {"rate=1", 3, "0.2"},
        {"initial=5", 1, "5"},
        {"initial=5 rate=-2", 3, "4.6"},
        {"rate=0", 5, "0"},
        // Vectors are combined element by element. Shorter ones are repeated.
        {"rate=1 initial=1;2;3", 2, "1.1;2.1;3.1"},
        {"rate=1;10", 3, "0.2;2"},
        {"initial=0;1;2;3 rate=1;-1", 2, "0.1;0.9;2.1;2.9"},
        // The first value is `initial`. Only clamps can give it more elements.
        {"rate=1;2", 1, "0"},
        {"rate=1;2", 2, "0.1;0.2"},
        {"initial=7 time=frame;frame*2", 1, "7"},
        {"initial=7 reset=0;1", 1, "7"},
        {"minimum=1;2", 1, "1;2"},
        {"rate=1 time=((0;1) if frame==0 else 5)", 2, "5;4"}, // the stored time may have more elements than the value
        // After the first frame, `initial` is used only where `reset` is true.
        {"rate=1 initial=(0 if frame==0 else (1;2))", 2, "0.1"},
        {"rate=1 initial=(0 if frame==0 else (1;2)) reset=0", 2, "0.1"},
        {"rate=1 initial=(0 if frame==0 else (1;2)) reset=frame==1", 2, "1;2"},
        {"rate=1 initial=(0 if frame==0 else (1;2;3)) reset=0;1", 2, "0.1;2;0.1"},
        // Clamps also apply to the initial value: first the minimum, then the maximum.
        {"initial=5 maximum=3", 1, "3"},
        {"initial=-5 minimum=-3", 1, "-3"},
        {"minimum=5 maximum=3", 1, "3"},
        {"rate=100 maximum=4", 3, "4"},
        {"rate=-100 minimum=-4", 3, "-4"},
        {"rate=100 max=4", 3, "4"},
        {"rate=-100 min=-4", 3, "-4"},
        {"rate=100 max=4 maximum=5", 3, "5"}, // the long name has precedence
        {"rate=-100 min=-4 minimum=-5", 3, "-5"},
        {"rate=100 max=4 maximum='x'", 3, "4"}, // the long name's value is invalid, so the short name is used
        {"rate=100;-100 maximum=4 minimum=-4", 3, "4;-4"},
        {"initial=0;0 rate=100 maximum=1;2", 2, "1;2"},
        {"maximum=0 rate=1", 3, "0"},
        // The attribute `time`.
        {"rate=1 time=frame*5", 3, "10"},
        {"time=frame*5 rate=2", 3, "20"},
        {"rate=1 time=10-frame", 3, "-2"},
        {"rate=1 time=frame;frame*2", 3, "2;4"},
        // While and where `reset` is true, the value is `initial`.
        {"rate=1 initial=7 reset=frame==2", 3, "7"},
        {"rate=1 initial=7 reset=frame==2", 4, "7.1"},
        {"rate=1 initial=7 reset=1", 4, "7"},
        {"rate=1 initial=7 reset=null", 2, "7.1"},
        {"rate=1 initial=7;8 reset=0;1", 2, "7.1;8"},
        {"rate=1 initial=7 reset=0;-1;0", 2, "7.1;7;7.1"},
        {"rate=1 initial=frame reset=frame==2", 3, "2"},
        {"rate=1 initial=frame", 3, "0.2"}, // otherwise, only the value of `initial` in the first frame is used
        // Attributes that are not numeric are ignored.
        {"initial='x' rate=!a", 2, "0"},
        {"initial='x' rate=1", 2, "0.1"},
        {"rate=1 time='x'", 2, "0.1"},
        {"rate=1 initial=7 reset='x'", 2, "7.1"},
        // A frame in which the result is not finite is skipped: the last value and time are kept.
        {"rate=inf", 3, "0"},
        {"rate=nan", 3, "0"},
        {"rate=(inf if frame==1 else 1)", 3, "0.1"},
        {"rate=1;(nan if frame==1 else 2)", 3, "0.1;0.2"},
        {"rate=1 time=(inf if frame==1 else frame)", 2, "0"},
        {"rate=1 time=(inf if frame==1 else frame)", 3, "2"},
        {"rate=1 time=(nan if frame==0 else frame)", 2, "0"},
        {"rate=1 time=(nan if frame==0 else frame)", 3, "1"},
        {"rate=1 time=(-1.7e308 if frame==0 else 1.7e308 if frame==1 else 1.6e308)", 3, "-9.999999999999996e+306"},
        {"rate=1e309 maximum=4", 3, "4"}, // the stored value is finite
        {"initial=1e308 rate=1e308 time=frame*10", 3, "1e+308"},
        {"initial=(inf if frame==0 else 3) rate=1", 3, "3.1"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        char script[200];
        snprintf(script, sizeof script, "!counter state=:c %s\n", rows[i].attributes);
        assert_text(script, counter(*state, script, rows[i].frames), rows[i].value);
    }
}

static void test_counter_stores_value_and_time_under_its_key(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.fps = 10;
    player_reopen(player, &options);
    player_run(player,
               "!counter state=:a;1 initial=3 rate=1\n!counter state='s' rate=1\n!counter state=0 rate=1 time=7\n", 2);
    assert_text("keys", player_state(player),
                "$(:a;1) = 3.1\n$(:a;1;:time) = 0.1\n$0 = 0\n$(0;:time) = 7\n$'s' = 0.1\n$('s';:time) = 0.1\n");
}

static void test_read_in_the_next_frame(void **state) {
    Player *player = *state;
    player_run(player, "%pragma fps 10\n!counter state=:c initial=1 rate=1\n!a v=$:c t=$(:c;:time)\n", 1);
    assert_text("first", player_tree(player), "!counter state=:c initial=1 rate=1\n!a\n");
    player_step(player, 2);
    assert_text("third", player_tree(player), "!counter state=:c initial=1 rate=1\n!a v=1.1 t=0.1\n");
}

// A changed rate applies to the time since the last frame.
static void test_changed_rate_applies_to_last_frame(void **state) {
    assert_text("rate", counter(*state, "!counter state=:c rate=frame\n", 4), "0.6");
}

// An absent counter keeps its value. When it returns, it also advances by the time of its absence.
static void test_absent_counter_keeps_value(void **state) {
    static const char script[] = "if frame<2 or frame>3\n    !counter state=:c rate=1\n";
    assert_text("absent", counter(*state, script, 4), "0.1");
    assert_text("back", counter(*state, script, 5), "0.4");
}

static void test_two_counters_of_one_key(void **state) {
    // The second counter reads the time that the first has written, so no time has passed since then.
    assert_text("two", counter(*state, "!counter state=:c rate=1\n!counter state=:c rate=100\n", 3), "0.2");
}

static void test_invalid_counters_are_reported(void **state) {
    Player *player = *state;
    static const ScriptRow rows[] = {
        {"!counter\n", "warning !counter: attribute 'state' must be numbers, symbols or strings, such as :x; the "
                       "counter is skipped [invalid-system]\n"},
        {"!counter state=0/0\n", "warning !counter state=nan: attribute 'state' must be numbers, symbols or strings, "
                                 "such as :x; the counter is skipped [invalid-system]\n"},
        {"!counter state=!a\n", "warning !counter state=(!a): attribute 'state' must be numbers, symbols or strings, "
                                "such as :x; the counter is skipped [invalid-system]\n"},
        {"!counter state=:c rat=2\n",
         "warning !counter state=:c: unknown attribute 'rat'; did you mean 'rate'? [unknown-attribute]\n"},
        {"!counter state=:c zzzzz=2\n", "warning !counter state=:c: unknown attribute 'zzzzz' [unknown-attribute]\n"},
        {"!counter state=:c rate='x'\n",
         "warning !counter state=:c: rate should be any numbers, not 'x' [bad-attribute]\n"},
        {"!counter state=:c reset='x'\n",
         "warning !counter state=:c: reset should be any numbers, not 'x' [bad-attribute]\n"},
        {"!counter state=:c initial=inf\n",
         "warning !counter state=:c: the value is not finite; the counter keeps the previous value [not-finite]\n"},
        {"!counter state=:c time=inf\n",
         "warning !counter state=:c: the time is not finite; the counter keeps the previous time [not-finite]\n"},
        {"!a\n    !counter state=:c\n", ""}, // systems are top-level nodes only
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        PetriOptions options = player_options(player);
        player_reopen(player, &options);
        player_run(player, rows[i].script, 3);
        assert_text(rows[i].script, player_diagnostics(player), rows[i].wanted);
    }
}

TEST_GROUP(scene_counters) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_value_grows_by_rate_within_the_limits),
        PLAYER_TEST(test_counter_stores_value_and_time_under_its_key),
        PLAYER_TEST(test_read_in_the_next_frame),
        PLAYER_TEST(test_changed_rate_applies_to_last_frame),
        PLAYER_TEST(test_absent_counter_keeps_value),
        PLAYER_TEST(test_two_counters_of_one_key),
        PLAYER_TEST(test_invalid_counters_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
