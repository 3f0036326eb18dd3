// test_session_settings.c: tests pragmas, definitions (-D) and global names of the engine (language.md L12, L16).
#include "petri-inspect.h"
#include "petri-live.h"
#include "player.h"

#include <math.h>
#include <time.h>

static void test_invalid_pragma_keeps_the_default(void **state) {
    static const ScriptRow rows[] = {
        {"!a v=tempo;quantum;fps\n", "!a v=120;4;60\n"},
        {"%pragma tempo 90\n%pragma quantum 3\n%pragma fps 7\n!a v=tempo;quantum;fps\n", "!a v=90;3;7\n"},
        {"%pragma fps 10\n%pragma fps 20\n!a v=fps\n", "!a v=20\n"},
        {"%pragma tempo 1:30\n!a v=tempo\n", "!a v=90\n"},
        {"%pragma fps '25'\n!a v=fps\n", "!a v=25\n"},
        {"%pragma fps ' 0.05k '\n!a v=fps\n", "!a v=50\n"},
        {"%pragma fps 'fast'\n!a v=fps\n", "!a v=60\n"},
        {"%pragma fps 0\n!a v=fps\n", "!a v=60\n"},
        {"%pragma fps 1e400\n!a v=fps\n", "!a v=60\n"},
        {"%pragma fps '-5'\n!a v=fps\n", "!a v=60\n"},
        {"%pragma fps :a\n!a v=fps\n", "!a v=60\n"},
        {"%pragma tempo !a\n!a v=tempo\n", "!a v=120\n"},
        {"%pragma tempo 'nan'\n!a v=tempo\n", "!a v=120\n"},
        {"%pragma other 3\n!a v=fps\n", "!a v=60\n"},
        {"%pragma quantum 0\n!a v=quantum\n", "!a v=0\n"}, // `quantum` may be 0; only tempo and fps must be positive
        {"%pragma quantum '-3'\n!a v=quantum\n", "!a v=-3\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 1);
}

static void test_pragma_warnings(void **state) {
    Player *player = *state;
    player_run(player, "%pragma fps 0\n%pragma tempo 'x'\n%pragma quantum !a\n%pragma other 'y'\n!a\n", 2);
    assert_text(
        "diagnostics", player_diagnostics(player),
        "warning t.fl:1:1 the value of this pragma must be a number above 0; the pragma is ignored [bad-pragma]\n"
        "warning t.fl:2:1 the value of this pragma must be a number above 0; the pragma is ignored [bad-pragma]\n"
        "warning t.fl:3:1 the value of this pragma must be a number; the pragma is ignored [bad-pragma]\n");
}

// Definitions as specified in L16.3.
static void test_definition_is_read_as_numbers_symbols_or_text(void **state) {
    Player *player = *state;
    static const struct {
        const char *definition, *wanted;
    } rows[] = {
        {"d=1", "!a d=1\n"},
        {"d=-1.5;+2k;1_000", "!a d=-1.5;2000;1000\n"},
        {"d= 3 ;inf;-inf;nan", "!a d=3;inf;-inf;nan\n"},
        {"d=1:30;100:00:00", "!a d=90;360000\n"},
        {"d=:sym;:é", "!a d=:sym;:é\n"},
        {"d=hello world", "!a d='hello world'\n"},
        {"d=", "!a d=''\n"},
        {"d=;", "!a d='';''\n"},
        {"d=:", "!a d=':'\n"},
        {"d=x=y", "!a d='x=y'\n"},
        {"d=1x;1:60;0x10;1 2", "!a d='1x';'1:60';'0x10';'1 2'\n"},
        {"d=1;a;:b;2", "!a d=1;'a';:b;2\n"},
        {"d=it's", "!a d=\"it's\"\n"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_int_equal(petri_define(player->session, rows[i].definition), PETRI_OK); // the last definition is used
        player_run(player, "!a d=d\n", 1);
        assert_text(rows[i].definition, player_tree(player), rows[i].wanted);
    }
    static const char *const bad[] = {"", "d", "=1", "=", "d=\xff", "\xff=1"};
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_claim(bad[i], petri_define(player->session, bad[i]) == PETRI_INVALID);
    player_run(player, "!a d=d\n", 1);
    assert_text("as it was", player_tree(player), "!a d=\"it's\"\n");
}

// Names of the engine have precedence over definitions, and definitions over built-ins. `let` shadows all of them.
static void test_precedence_of_names(void **state) {
    Player *player = *state;
    assert_int_equal(petri_define(player->session, "fps=1"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "sin=2"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "pi=3"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "frame=4"), PETRI_OK);
    player_run(player, "!a v=fps;sin;pi;frame\nlet fps=5 sin=6\n!b v=fps;sin\n", 1);
    assert_text("names", player_tree(player), "!a v=60;2;3;0\n!b v=5;6\n");
}

static void test_engine_names(void **state) {
    Player *player = *state;
    player_run(player,
               "%pragma tempo 90\n%pragma quantum 3\n%pragma fps 7\n"
               "!t v=frame;time;beat;delta\n"
               "!c v=tempo;quantum;performance;slow_frame;clock;realtime;screen;fullscreen;vsync;offscreen;opengl_es\n"
               "!r v=run_time\n",
               1);
    static const char constant[] = "!c v=90;3;2;0;0;0;0;0;0;1;0\n!r\n";
    static const char *const times[] = {
        "!t v=0;0;0;0\n",
        "!t v=1;0.14285714285714285;0.21428571428571427;0.21428571428571427\n",
        "!t v=2;0.2857142857142857;0.42857142857142855;0.21428571428571427\n",
    };
    for (size_t i = 0; i < COUNT_OF(times); i++) {
        if (i)
            player_step(player, 1);
        char wanted[300];
        snprintf(wanted, sizeof wanted, "%s%s", times[i], constant);
        assert_text("engine names", player_tree(player), wanted);
        assert_int_equal(petri_frame_number(player->session), i);
    }
    PetriFrame frame = last_frame(player->session);
    assert_number("time", frame.time, 2 / 7.0);
    assert_number("beat", frame.beat, 2 / 7.0 / (60 / 90.0));
    assert_number("fps", frame.fps, 7);
    assert_number("tempo", frame.tempo, 90);
}

static void test_options_set_the_global_names(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.fps = 24;
    options.run_time = 2.5;
    player_reopen(player, &options);
    player_run(player, "!a v=fps;run_time;time\n", 13);
    assert_text("options", player_tree(player), "!a v=24;2.5;0.5\n");
    player_realtime(player, 1000);
    player_run(player, "!a v=realtime;frame;(clock>1e9);(performance>=0.5 and performance<=2);(time>0)\n", 3);
    assert_text("realtime", player_tree(player), "!a v=1;2;1;1;1\n");
    player_run(player, "!a v=beat;delta;performance\n", 1);
    assert_text("frame 0", player_tree(player), "!a v=0;0;1\n");
}

static void test_load_restarts_clock(void **state) {
    Player *player = *state;
    player_run(player, "%pragma fps 10\n!a v=frame;fps\n!counter state=:c rate=1\n", 5);
    assert_text("fifth", player_print(player, PETRI_PRINT_STATE), "$:c = 0.4\n$(:c;:time) = 0.4\n");
    player_run(player, "!a v=frame;fps;delta;$:c\n", 1);
    assert_text("pragmas are the script's own, the state stays", player_tree(player), "!a v=0;60;0;0.4\n");
}

// A host that pauses can exclude the pause from script time.
static void test_resync_drops_elapsed_time(void **state) {
    Player *player = *state;
    player_run(player, "!a\n", 3);
    assert_number("lockstep", petri_seconds_until_due(player->session), 0);
    petri_resync_clock(player->session); // no effect
    player_step(player, 1);
    assert_number("lockstep", last_frame(player->session).time, 3.0 / 60);

    player_realtime(player, 10);
    assert_number("nothing loaded", petri_seconds_until_due(player->session), 0);
    player_run(player, "!a\n", 2);
    double due = petri_seconds_until_due(player->session), before = last_frame(player->session).time;
    assert_claim("due", due >= 0 && due <= 0.1);
    nanosleep(&(struct timespec){.tv_sec = 2}, NULL);
    assert_number("overdue", petri_seconds_until_due(player->session), 0);
    petri_resync_clock(player->session);
    player_step(player, 1);
    double passed = last_frame(player->session).time - before;
    assert_claim("the pause is excluded", passed > 0.0999 && passed < 1.9);
}

static void sleep_seconds(double seconds) {
    nanosleep(&(struct timespec){.tv_sec = (time_t)seconds, .tv_nsec = (long)(fmod(seconds, 1) * 1e9)}, NULL);
}

// Returns true if all frames have the times at which they were due and the system's clock equals the time, although the
// host delays the frames.
static bool keeps_due_times(Player *player) {
    player_run(player, "!physics state=:s dimensions=1 time=time\n    !particle id=1 velocity=1\n", 1);
    for (int i = 1; i <= 20; i++) {
        sleep_seconds(i % 3 == 0 ? 0.03 : i % 3 * 0.005); // frames are due every 0.02 s
        player_step(player, 1);
        if (fabs(last_frame(player->session).time - i / 50.0) > 1e-9)
            return false;
    }
    PetriSystem system;
    return petri_system(player->session, 0, &system, sizeof system) && fabs(system.position.data[0] - 20 / 50.0) < 1e-9;
}

static void test_frames_have_due_times(void **state) {
    Player *player = *state;
    player_realtime(player, 50);
    bool good = false;
    for (int i = 0; i < 20 && !good; i++) // the machine may be busy
        good = keeps_due_times(player);
    assert_claim("frames that are less than 0.1 s late have the time at which they were due", good);
    double before = last_frame(player->session).time;
    sleep_seconds(0.5);
    player_step(player, 1);
    assert_claim("a longer delay is skipped", last_frame(player->session).time >= before + 0.3);
}

// In real time, frame 0 also has time 0, however much time has passed before.
static void assert_starts(Player *player, const char *what) {
    player_step(player, 1);
    PetriFrame frame = last_frame(player->session);
    assert_int_equal(frame.number, 0);
    assert_number(what, frame.time, 0);
    assert_number(what, frame.beat, 0);
    sleep_seconds(0.05);
    player_step(player, 1);
    frame = last_frame(player->session);
    assert_claim(what, frame.time >= 1 / frame.fps - 1e-9 && frame.time < 20); // the time at which it was due
    assert_number(what, frame.beat, frame.time / (60 / frame.tempo));
}

static void test_wall_clock_starts_at_0(void **state) {
    Player *player = *state;
    player_realtime(player, 60);
    player_run(player, "%pragma fps 100\n!a v=time;beat\n", 0);
    assert_starts(player, "loaded");
    sleep_seconds(0.05);
    petri_reset(player->session);
    sleep_seconds(0.05);
    assert_starts(player, "cleared");
    player_run(player, "%pragma fps 50\n!a v=time\n", 0);
    assert_starts(player, "loaded again");
    double before = last_frame(player->session).time;
    petri_reload(player->session, NULL);
    player_step(player, 1);
    assert_claim("reloaded", last_frame(player->session).time > before);
}

// Rewinding also restores the clock, which then continues from the restored time.
static void test_wall_clock_is_rewound(void **state) {
    Player *player = *state;
    player_realtime(player, 20);
    player_run(player, "!a v=time\n", 0);
    PetriSnapshot *none = petri_snapshot(player->session);
    player_step(player, 2);
    PetriSnapshot *second = petri_snapshot(player->session);
    double kept = last_frame(player->session).time;
    player_step(player, 40);
    assert_claim("two seconds", last_frame(player->session).time >= kept + 1.9);
    assert_int_equal(petri_rewind(player->session, second), PETRI_OK);
    player_step(player, 1);
    PetriFrame frame = last_frame(player->session);
    assert_int_equal(frame.number, 2);
    assert_claim("the next frame", frame.time >= kept + 0.0499 && frame.time < kept + 1.9);
    assert_int_equal(petri_rewind(player->session, none), PETRI_OK);
    assert_starts(player, "before frame 0");
    petri_snapshot_free(none);
    petri_snapshot_free(second);
}

// petri_step_at sets the time, from which petri_step then continues.
static void test_step_at_sets_clock(void **state) {
    Player *player = *state;
    for (int realtime = 0; realtime < 2; realtime++) {
        PetriOptions options = player_options(player);
        options.realtime = realtime;
        player_reopen(player, &options);
        assert_int_equal(petri_step_at(player->session, 0, 0), PETRI_INVALID); // no script is loaded
        assert_int_equal(player_load(player, "%pragma fps 4\n%pragma tempo 60\n!a x=frame;time;beat;delta\n"
                                             "!physics state=:p dimensions=1 time=time resolution=10\n"
                                             "    !particle id=1 velocity=1\n"),
                         PETRI_OK);
        assert_int_equal(petri_step_at(player->session, 100, 7), PETRI_OK);
        assert_text("first", player_print(player, PETRI_PRINT_TREE),
                    "!a x=0;100;7;0\n"
                    "!physics state=:p dimensions=1 time=100 resolution=10\n    !particle id=1 velocity=1\n");
        assert_int_equal(petri_step_at(player->session, 102.5, 8), PETRI_OK);
        PetriFrame frame = last_frame(player->session);
        assert_number("number", (double)frame.number, 1);
        assert_number("time", frame.time, 102.5);
        assert_number("beat", frame.beat, 8);
        PetriSystem system;
        assert_true(petri_system(player->session, 0, &system, sizeof system));
        assert_number("x", system.position.data[0], 2.5);
        // the time is earlier, so systems are not advanced
        assert_int_equal(petri_step_at(player->session, 90, 3), PETRI_OK);
        assert_true(petri_system(player->session, 0, &system, sizeof system));
        assert_number("x", system.position.data[0], 2.5);
        assert_int_equal(petri_step_at(player->session, NAN, 3), PETRI_INVALID);
        assert_int_equal(petri_step_at(player->session, 3, INFINITY), PETRI_INVALID);
        assert_int_equal(petri_frame_number(player->session), 2);
        petri_step(player->session);
        if (!realtime) {
            petri_resync_clock(player->session); // no effect
            assert_number("lockstep", petri_seconds_until_due(player->session), 0);
            assert_number("time continues", last_frame(player->session).time, 90.25);
            assert_number("beat continues", last_frame(player->session).beat, 3.25);
        } else {
            assert_claim("time continues", last_frame(player->session).time >= 90);
        }
    }
}

TEST_GROUP(session_settings) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_invalid_pragma_keeps_the_default),
        PLAYER_TEST(test_pragma_warnings),
        PLAYER_TEST(test_definition_is_read_as_numbers_symbols_or_text),
        PLAYER_TEST(test_precedence_of_names),
        PLAYER_TEST(test_engine_names),
        PLAYER_TEST(test_options_set_the_global_names),
        PLAYER_TEST(test_load_restarts_clock),
        PLAYER_TEST(test_resync_drops_elapsed_time),
        PLAYER_TEST(test_step_at_sets_clock),
        PLAYER_TEST(test_frames_have_due_times),
        PLAYER_TEST(test_wall_clock_starts_at_0),
        PLAYER_TEST(test_wall_clock_is_rewound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
