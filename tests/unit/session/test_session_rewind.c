// test_session_rewind.c: tests snapshots, configurations, interrupts, reloading and changes of the clock.
#include "folder.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "player.h"

#include <pthread.h>
#include <time.h>

// All kinds of data that systems keep: random forces, systems and particles that appear and vanish, strings in keys.
static const char *const SCRIPT = "%pragma tempo 60\n"
                                  "let N=12 if frame%7 < 3 else 9\n"
                                  "!physics state=:cells dimensions=2 time=beat resolution=0.01 run=frame//20\n"
                                  "    for i in ..N\n"
                                  "        !particle id=i position=10*uniform(:a)[i];10*uniform(:b)[i] radius=2\n"
                                  "    !collision\n"
                                  "    !random strength=10\n"
                                  "    !drag strength=0.1\n"
                                  "if frame%5 != 3\n"
                                  "    !physics state='text';1 dimensions=1 time=beat\n"
                                  "        !particle id='p' position=$(:cells;0)[0]\n"
                                  "        !constant force=1\n"
                                  "!counter state=:count rate=2;3 maximum=1;9\n"
                                  "!shown value=$:count delta=delta\n";

static char *frame_text(Player *player) {
    player->printed.len = 0;
    assert_int_equal(petri_print(player->session, PETRI_PRINT_TREE | PETRI_PRINT_STATE, note, &player->printed),
                     PETRI_OK);
    return strdup(player->printed.text);
}

enum { FRAMES = 45 };

static void test_snapshot_restores_session(void **state) {
    Player *player = *state;
    PetriSnapshot *snapshots[FRAMES + 1];
    char *texts[FRAMES];
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    for (int i = 0; i < FRAMES; i++) {
        snapshots[i] = petri_snapshot(player->session);
        assert_non_null(snapshots[i]);
        player_step(player, 1);
        texts[i] = frame_text(player);
    }
    snapshots[FRAMES] = petri_snapshot(player->session);
    for (int from = 0; from < FRAMES; from += 4) {
        assert_int_equal(petri_rewind(player->session, snapshots[from]), PETRI_OK);
        assert_int_equal(petri_frame_number(player->session), from - 1);
        for (int i = from; i < FRAMES && i < from + 9; i++) {
            player_step(player, 1);
            char *text = frame_text(player);
            assert_string_equal(text, texts[i]);
            free(text);
        }
    }
    assert_true(petri_snapshot_bytes(snapshots[FRAMES]) < 8192);
    for (int i = 0; i < FRAMES; i++)
        free(texts[i]);
    for (int i = 0; i <= FRAMES; i++)
        petri_snapshot_free(snapshots[i]);
    petri_snapshot_free(NULL);
}

// A snapshot restores its script and state; a configuration restores only the script.
static void test_config_restores_script(void **state) {
    Player *player = *state;
    PetriPromptResult done;
    player_run(player, "!counter state=:c rate=1\n!old c=$:c", 4);
    PetriSnapshot *old = petri_snapshot(player->session);
    uint64_t number = petri_config_revision(player->session);
    player_step(player, 3);
    char *wanted = frame_text(player);
    assert_int_equal(petri_config_revision(player->session), number);
    assert_int_equal(
        petri_prompt(player->session, "!typed f=frame", PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done),
        PETRI_OK);
    assert_true(petri_config_revision(player->session) != number);
    assert_int_equal(petri_define(player->session, "X=5"), PETRI_OK);
    PetriConfig *config = petri_config_get(player->session);
    assert_int_equal(petri_rewind(player->session, old), PETRI_OK);
    assert_int_equal(petri_config_revision(player->session), number);
    player_step(player, 3);
    char *again = frame_text(player);
    assert_string_equal(again, wanted);
    petri_config_apply(player->session, config);
    player_step(player, 1);
    assert_string_equal(player_tree(player), "!counter state=:c rate=1\n!old c=0.1\n!typed f=7\n");
    petri_config_free(config);
    petri_config_free(NULL);
    petri_snapshot_free(old);
    free(wanted);
    free(again);
}

static void *interrupt_soon(void *session) {
    nanosleep(&(struct timespec){.tv_nsec = 30000000}, NULL);
    petri_interrupt(session);
    return NULL;
}

// Interrupts a frame that would take minutes.
static void check_interrupted(Player *player) {
    pthread_t thread;
    char *before = frame_text(player);
    PetriFrame frame = last_frame(player->session);
    assert_int_equal(pthread_create(&thread, NULL, interrupt_soon, player->session), 0);
    assert_int_equal(petri_step(player->session), PETRI_INTERRUPTED);
    pthread_join(thread, NULL);
    assert_int_equal(petri_frame_number(player->session), frame.number);
    assert_true(last_frame(player->session).time == frame.time && last_frame(player->session).beat == frame.beat);
    assert_false(petri_clear_interrupt(player->session));
    assert_non_null(strstr(before, player_state(player)));
    free(before);
}

static int polls_left;
static void *asked_host;

static bool stop_after_polls(void *host) {
    asked_host = host;
    return polls_left > 0 && --polls_left == 0;
}

// should_interrupt is polled during a frame. An interrupted frame has no effect.
static void test_should_interrupt(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.rollback_frames = true;
    options.should_interrupt = stop_after_polls;
    player_reopen(player, &options);
    player_run(player,
               "!physics state=:a dimensions=1 time=time\n    !particle id=0 velocity=1\n"
               "!a x=sum(i*j for i in ..1000 for j in ..(1000 if frame==3 else 1))",
               3);
    assert_ptr_equal(asked_host, options.user_data);
    char *before = frame_text(player);
    polls_left = 100;
    assert_int_equal(petri_step(player->session), PETRI_INTERRUPTED);
    assert_int_equal(petri_frame_number(player->session), 2);
    assert_non_null(strstr(before, player_state(player)));
    assert_false(petri_clear_interrupt(player->session));
    player_step(player, 1);
    assert_int_equal(petri_frame_number(player->session), 3);
    free(before);

    static const char loop[] = "!a x=sum(i*j for i in ..1000 for j in ..1000)";
    asked_host = NULL; // during petri_check_text, should_interrupt also gets the host's user_data
    assert_int_equal(petri_check_text(player->session, "loop.fl", loop, PETRI_NUL_TERMINATED), PETRI_OK);
    assert_ptr_equal(asked_host, options.user_data);
    petri_interrupt(player->session);
    assert_int_equal(petri_check_text(player->session, "loop.fl", loop, PETRI_NUL_TERMINATED), PETRI_INTERRUPTED);
    assert_false(petri_clear_interrupt(player->session));
}

static void test_interrupt_rolls_back(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.rollback_frames = true;
    player_reopen(player, &options);
    player_run(player,
               "func f(n)\n    if n > 0\n        f(n-1)+f(n-1)\n    else\n        1\n"
               "!counter state=:c rate=1\n!a x=(f(26) if frame==3 else 0)",
               3);
    check_interrupted(player);
    // The interrupt occurs in the second system, after the first was updated.
    player_run(player,
               "!physics state=:a dimensions=1 time=time\n    !particle id=0 velocity=1\n"
               "!physics state=:b dimensions=2 time=time resolution=(1e-7 if frame==3 else 0.01)\n"
               "    for i in ..200\n        !particle id=i position=i;i%7\n    !gravity\n!counter state=:d",
               3);
    check_interrupted(player);
    assert_int_equal(petri_set_resolution(player->session, 0.01), PETRI_OK);
    player_step(player, 2);
    assert_int_equal(petri_frame_number(player->session), 4);
    petri_interrupt(player->session); // the interrupt comes before the step
    assert_int_equal(petri_step(player->session), PETRI_INTERRUPTED);
    assert_int_equal(petri_frame_number(player->session), 4);
    player_step(player, 1);
    petri_interrupt(player->session);
    assert_true(petri_clear_interrupt(player->session));
    assert_false(petri_clear_interrupt(player->session));
    PetriEvaluation result;
    pthread_t thread;
    assert_int_equal(player_load(player, "func f(n)\n    if n > 0\n        f(n-1)+f(n-1)\n    else\n        1\n!a"),
                     PETRI_OK);
    assert_int_equal(pthread_create(&thread, NULL, interrupt_soon, player->session), 0);
    assert_int_equal(
        petri_evaluate(player->session, "f(frame+26)", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
        PETRI_INTERRUPTED);
    pthread_join(thread, NULL);
}

static void test_reload_keeps_clock(void **state) {
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    folder_write(&folder, "s.fl", "%pragma tempo 60\n!counter state=:c rate=1\n!v x=1\n");
    const char *file = folder_file(&folder, "s.fl");
    assert_int_equal(petri_load(player->session, file), PETRI_OK);
    assert_true(strstr(petri_source_file(player->session, 0), "s.fl") != NULL);
    assert_null(petri_source_file(player->session, 1));
    player_step(player, 6);
    double beat = last_frame(player->session).beat;
    folder_write(&folder, "s.fl", "!v x=\n");
    assert_int_equal(petri_reload(player->session, file), PETRI_INVALID);
    player_step(player, 1); // the previously loaded script continues
    assert_string_equal(player_tree(player), "!counter state=:c rate=1\n!v x=1\n");
    folder_write(&folder, "s.fl", "%pragma tempo 180\n!counter state=:c rate=1\n!v x=2\n");
    assert_int_equal(petri_reload(player->session, file), PETRI_OK);
    assert_int_equal(petri_frame_number(player->session), 6);
    player_step(player, 1);
    assert_string_equal(player_tree(player), "!counter state=:c rate=1\n!v x=2\n");
    assert_int_equal(petri_frame_number(player->session), 7);
    assert_float_equal(last_frame(player->session).time, 7 / 60.0, 1e-12);
    assert_float_equal(last_frame(player->session).beat, beat + 1 / 60.0 + 3 / 60.0, 1e-12);
    // A reload changes the tempo only if its pragma changed.
    assert_int_equal(petri_set_tempo(player->session, 90), PETRI_OK);
    assert_int_equal(petri_reload(player->session, file), PETRI_OK);
    assert_float_equal(last_frame(player->session).tempo, 90, 0);
    // Recompiling the loaded text applies new definitions.
    folder_write(&folder, "s.fl", "!v x=N\n");
    assert_int_equal(petri_load(player->session, file), PETRI_OK);
    player_step(player, 2);
    assert_int_equal(petri_define(player->session, "N=7"), PETRI_OK);
    assert_int_equal(petri_reload(player->session, NULL), PETRI_OK);
    player_step(player, 1);
    assert_string_equal(player_tree(player), "!v x=7\n");
    assert_int_equal(petri_frame_number(player->session), 2);
    assert_non_null(petri_source_file(player->session, 0));
    folder_close(&folder);
}

static void test_clock_changes_do_not_jump(void **state) {
    Player *player = *state;
    player_run(player, "%pragma tempo 60\n!a t=time b=beat", 61);
    assert_float_equal(last_frame(player->session).beat, 1, 1e-12);
    assert_int_equal(petri_set_tempo(player->session, 120), PETRI_OK);
    player_step(player, 30);
    assert_float_equal(last_frame(player->session).beat, 2, 1e-12);
    assert_int_equal(petri_set_fps(player->session, 30), PETRI_OK);
    player_step(player, 30);
    assert_float_equal(last_frame(player->session).time, 2.5, 1e-12);
    assert_float_equal(last_frame(player->session).beat, 4, 1e-12);
    assert_int_equal(petri_frame_number(player->session), 120);
    static const double wrong[] = {0, -1, 1.0 / 0.0};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(petri_set_tempo(player->session, wrong[i]), PETRI_INVALID);
        assert_int_equal(petri_set_fps(player->session, wrong[i]), PETRI_INVALID);
    }
    assert_int_equal(petri_set_resolution(player->session, -1), PETRI_INVALID);
    petri_reset(player->session);
    player_step(player, 1);
    assert_int_equal(petri_frame_number(player->session), 0);
    assert_float_equal(last_frame(player->session).tempo, 120, 0);
}

TEST_GROUP(session_rewind) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_snapshot_restores_session), PLAYER_TEST(test_config_restores_script),
        PLAYER_TEST(test_interrupt_rolls_back),      PLAYER_TEST(test_should_interrupt),
        PLAYER_TEST(test_reload_keeps_clock),        PLAYER_TEST(test_clock_changes_do_not_jump),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
