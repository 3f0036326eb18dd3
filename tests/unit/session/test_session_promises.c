// test_session_promises.c: tests that lifetimes, snapshots and NULL arguments are as documented in petri.h.
#include "folder.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "petri-ranks.h"
#include "player.h"
#include "session/session.h"

#include <math.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static const char *const KEYS = "!physics state=:a dimensions=2 time=beat\n    !particle id=0 velocity=1;0\n"
                                "!physics state=:b dimensions=1 time=beat\n    !particle id=1\n"
                                "!window\n    !key name=:space state=:space\n    !pointer state=:mouse\n";

// Strings stay valid as long as petri.h documents, whatever functions are called in the meantime.
static void test_texts_stay_valid(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    Folder folder;
    PetriSystem system;
    PetriPromptResult done;
    PetriEvaluation result;
    folder_open(&folder);
    folder_write(&folder, "s.fl", KEYS);
    assert_int_equal(petri_load(session, folder_file(&folder, "s.fl")), PETRI_OK);
    player_step(player, 3);
    assert_int_equal(petri_prompt(session, "let twice=2*frame", PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done),
                     PETRI_OK);
    const char *statement = petri_prompt_statement(session, 0), *name = petri_visible_name(session, 0);
    player_step(player, 1);
    const char *source = petri_source_file(session, 0);
    assert_true(petri_system(session, 1, &system, sizeof system));
    PetriValue id = petri_particle_id(session, 0, 0);
    for (size_t i = 0; petri_visible_name(session, i); i++) {
    }
    player_state(player);
    player_print(player, 15);
    assert_int_equal(petri_evaluate(session, "twice", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL),
                     PETRI_OK);
    assert_string_equal(strrchr(source, '/'), "/s.fl");
    assert_string_equal(statement, "let twice=2*frame");
    assert_string_equal(name, "twice");
    assert_string_equal(system.name, ":b");
    assert_int_equal(id.length, 1);
    assert_number("id", id.numbers[0], 0);
    player_step(player, 1);
    assert_string_equal(statement, "let twice=2*frame");
    folder_close(&folder);
}

static void press(Player *player, bool pressed) {
    assert_int_equal(petri_report_key(player->session, "space", pressed), PETRI_OK);
    player_step(player, 1);
}

static char *next_state(Player *player) {
    player_step(player, 1);
    return strdup(player_state(player));
}

// Rewinding restores toggles and pressed keys.
static void test_toggles_rewind(void **state) {
    Player *player = *state;
    player_run(player, KEYS, 2);
    press(player, true);
    PetriSnapshot *snapshot = petri_snapshot(player->session);
    char *wanted = next_state(player);
    assert_non_null(strstr(wanted, "$(:space;:toggled) = 1\n"));
    press(player, false);
    press(player, true);
    petri_report_pointer(
        player->session,
        &(PetriPointer){.size = sizeof(PetriPointer), .inside = true, .x = 0.5, .y = 0.5, .buttons = 1});
    player_step(player, 1);
    assert_non_null(strstr(player_state(player), "$(:space;:toggled) = 0\n"));
    assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK);
    char *found = next_state(player);
    assert_string_equal(found, wanted);
    petri_snapshot_free(snapshot);
    free(found);
    free(wanted);
}

// Rewinding restores `performance` in real time.
static void test_performance_rewinds(void **state) {
    Player *player = *state;
    player_realtime(player, 500);
    player_run(player, "!a p=performance", 3);
    PetriSnapshot *snapshot = petri_snapshot(player->session);
    PetriEvaluation before, after;
    assert_int_equal(
        petri_evaluate(player->session, "performance", PETRI_NUL_TERMINATED, &before, sizeof before, NULL, NULL),
        PETRI_OK);
    struct timespec pause = {.tv_nsec = 20000000};
    nanosleep(&pause, NULL);
    player_step(player, 1); // the frame is late, so performance falls
    assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK);
    assert_int_equal(
        petri_evaluate(player->session, "performance", PETRI_NUL_TERMINATED, &after, sizeof after, NULL, NULL),
        PETRI_OK);
    assert_number("performance", after.number, before.number);
    petri_snapshot_free(snapshot);
}

static PetriStatus find_draw_memory(PetriSession *session, void *context) {
    *(int **)context = session_draw_memory(session, sizeof(int));
    return PETRI_OK;
}

static int *draw_memory(Player *player) {
    int *memory = NULL;
    assert_int_equal(session_protect(player->session, NULL, find_draw_memory, &memory), PETRI_OK);
    return memory;
}

// The memory that lib/picture stores across frames is zeroed before frame 0.
static void test_draw_memory_is_zeroed_before_frame_0(void **state) {
    Player *player = *state;
    player_run(player, "!a", 1);
    int *memory = draw_memory(player);
    assert_int_equal(*memory, 0);
    *memory = 7;
    player_step(player, 1);
    assert_ptr_equal(draw_memory(player), memory);
    assert_int_equal(*memory, 7);
    petri_reset(player->session);
    assert_int_equal(*draw_memory(player), 0);
}

// Shaders get the numbers of the engine and of definitions, but no more than there is room for.
static void test_shaders_get_numbers_of_frame(void **state) {
    Player *player = *state;
    const char *names[40];
    double numbers[COUNT_OF(names)];
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    assert_int_equal(petri_define(player->session, "SIZE=3"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "PAIR=3;4"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "SIZE=5"), PETRI_OK);
    player_run(player, "!a v=SIZE;PAIR", 3);
    uint32_t count = session_frame_numbers(player->session, &arena, names, numbers, COUNT_OF(names));
    assert_in_range(count, 10, COUNT_OF(names) - 1);
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(names[i], "frame") == 0)
            assert_number("frame", numbers[i], 2);
    assert_string_equal(names[count - 1], "SIZE"); // the only one: the newest definition of a name
    assert_string_not_equal(names[count - 2], "SIZE");
    assert_number("SIZE", numbers[count - 1], 5);
    assert_int_equal(session_frame_numbers(player->session, &arena, names, numbers, 3), 3);
    arena_free(&arena);
}

// petri_work includes the work of drawing.
static void test_work_of_drawing_is_added(void **state) {
    Player *player = *state;
    uint64_t before = petri_work(player->session);
    session_add_work(player->session, 5);
    assert_int_equal(petri_work(player->session), before + 5);
}

static void test_null_arguments_are_accepted(void **state) {
    Player *player = *state;
    PetriSession *none = NULL, *session = player->session;
    PetriSnapshot *snapshot = petri_snapshot(session);
    PetriPromptResult done;
    PetriEvaluation result;
    PetriSystem system;
    uint32_t particle;
    PetriForce force;
    PetriExplanation explanation;
    PetriParameter parameter;
    double x;
    player_run(player, KEYS, 2);
    const PetriStatus statuses[] = {
        petri_set_allocator(NULL), // invalid while a session is open
        petri_define(none, "A=1"),
        petri_define(session, NULL),
        petri_load(none, "s.fl"),
        petri_load(session, NULL),
        petri_load_text(none, "s", "", 0),
        petri_load_text(session, NULL, "", 0),
        petri_load_text(session, "s", NULL, 0),
        petri_reload(none, "s.fl"),
        petri_reload(none, NULL),
        petri_check(none, "s"),
        petri_check(session, NULL),
        petri_check_text(none, "s", "", 0),
        petri_check_text(session, "s", NULL, PETRI_NUL_TERMINATED),
        petri_step(none),
        petri_preview(none),
        petri_set_tempo(none, 1),
        petri_set_fps(none, 1),
        petri_set_resolution(none, 1),
        petri_report_pointer(none, NULL),
        petri_report_key(none, "a", true),
        petri_report_key(session, NULL, true),
        petri_rewind(none, snapshot),
        petri_rewind(session, NULL),
        petri_save(none, "s"),
        petri_save(session, NULL),
        petri_restore(none, "s"),
        petri_restore(session, NULL),
        petri_print(none, 15, note, &player->printed),
        petri_print(session, 15, NULL, NULL),
        petri_print_log(none, note, &player->printed),
        petri_vary(none, &(PetriVariation){.size = sizeof(PetriVariation)}),
        petri_vary(session, NULL),
        petri_trust(none, NULL),
        petri_trust(session, NULL),
        petri_print_log(session, NULL, NULL),
        petri_profile(none, 0, note, &player->printed),
        petri_profile(session, 0, NULL, NULL),
        petri_dump(none, PETRI_DUMP_AST, note, &player->printed),
        petri_dump(session, PETRI_DUMP_AST, NULL, NULL),
        petri_tokenise(none, "1", 1, player_ignore_token, NULL),
        petri_tokenise(session, NULL, 0, player_ignore_token, NULL),
        petri_tokenise(session, "1", 1, NULL, NULL),
        petri_bindings(none, "1", 1, player_ignore_name, NULL),
        petri_bindings(session, NULL, 0, player_ignore_name, NULL),
        petri_bindings(session, "1", 1, NULL, NULL),
        petri_prompt(none, "1", 1, NULL, NULL, &done, sizeof done),
        petri_prompt(session, NULL, 0, NULL, NULL, &done, sizeof done),
        petri_prompt(session, "1", 1, NULL, NULL, NULL, 0),
        petri_evaluate(none, "1", 1, &result, sizeof result, NULL, NULL),
        petri_evaluate(session, NULL, 0, &result, sizeof result, NULL, NULL),
        petri_evaluate(session, "1", 1, NULL, 0, NULL, NULL),
        petri_history_move_particle(NULL, 0, 0, NULL, NULL),
        petri_set_force_callback(none, NULL, NULL),
        petri_set_parameter(none, "A", "1"),
        petri_set_parameter(session, NULL, "1"),
    };
    for (size_t i = 0; i < COUNT_OF(statuses); i++)
        assert_int_equal(statuses[i], PETRI_INVALID);
    assert_null(petri_open(NULL));
    petri_close(&none);
    petri_close(NULL);
    petri_options_init(NULL, sizeof(PetriOptions));
    petri_reset(NULL);
    petri_resync_clock(NULL);
    petri_interrupt(NULL);
    petri_config_free(NULL);
    petri_snapshot_free(NULL);
    petri_config_apply(NULL, NULL);
    petri_config_apply(session, NULL);
    assert_null(petri_snapshot(NULL));
    assert_false(petri_history_is_moved(NULL, 0));
    assert_null(petri_config_get(NULL));
    assert_null(petri_source_file(NULL, 0));
    assert_null(petri_visible_name(NULL, 0));
    assert_null(petri_prompt_statement(NULL, 0));
    assert_false(petri_clear_interrupt(NULL));
    assert_false(petri_has_picture(NULL));
    assert_false(petri_key_is_bound(NULL, "a"));
    assert_false(petri_key_is_bound(session, NULL));
    petri_keep_columns(NULL, true);
    assert_false(petri_system(NULL, 0, &system, sizeof system) || petri_system(session, 0, NULL, 0));
    PetriRankStats traffic;
    assert_false(petri_rank_stats(NULL, 0, &traffic, sizeof traffic) || petri_rank_stats(session, 0, NULL, 0));
    assert_int_equal(petri_particle_id(NULL, 0, 0).length, 0);
    assert_null(petri_particle_ids(NULL, 0).data);
    assert_false(petri_find_particle(NULL, 0, (PetriValue){0}, &particle) ||
                 petri_find_particle(session, 0, (PetriValue){0}, NULL));
    PetriValue value = {0};
    uint32_t cursor = 0;
    PetriDiagnostic kept;
    assert_false(petri_diagnostic(NULL, 0, &kept, sizeof kept) || petri_diagnostic(session, 0, NULL, 0));
    petri_clear_diagnostics(NULL);
    assert_null(petri_format_value(NULL, value));
    assert_int_equal(petri_state_get(NULL, value).length, 0);
    assert_int_equal(petri_state_set(NULL, value, value), PETRI_INVALID);
    assert_false(petri_state_next(NULL, &cursor, &value, &value) || petri_state_next(session, NULL, &value, &value));
    assert_false(petri_state_next(session, &cursor, NULL, &value) || petri_state_next(session, &cursor, &value, NULL));
    assert_int_equal(petri_set_global(NULL, "a", value), PETRI_INVALID);
    assert_int_equal(petri_set_global(session, NULL, value), PETRI_INVALID);
    assert_int_equal(petri_tree(NULL).length, 0);
    assert_true(!petri_tree_tag(NULL, 0) && !petri_tree_attribute(NULL, 0, &value));
    assert_int_equal(petri_tree_get(NULL, "a").length, 0);
    assert_true(isnan(petri_symbol(NULL, "a")) && isnan(petri_symbol(session, NULL)));
    assert_null(petri_symbol_name(NULL, 1));
    assert_false(petri_system_force(NULL, 0, 0, &force, sizeof force) || petri_system_force(session, 0, 0, NULL, 0));
    assert_int_equal(petri_explain_force(NULL, 0, 0, 0, &explanation, sizeof explanation), PETRI_INVALID);
    assert_int_equal(petri_explain_force(session, 0, 0, 0, NULL, 0), PETRI_INVALID);
    assert_false(petri_parameter(NULL, 0, &parameter, sizeof parameter) || petri_parameter(session, 0, NULL, 0));
    assert_false(petri_builtin(0, NULL, 0) || petri_node_kind(0, NULL, 0) || petri_node_attribute(0, 0, NULL, 0));
    assert_false(petri_parse_number(NULL, &x) || petri_parse_number("1", NULL));
    assert_true(petri_seconds_until_due(NULL) == 0 && petri_resolution(NULL) == 0);
    assert_int_equal(petri_frame_number(NULL), -1);
    assert_int_equal(petri_prompt_check(NULL, "1", 1), PETRI_COMPLETE);
    assert_int_equal(petri_prompt_check(session, NULL, 1), PETRI_COMPLETE);
    assert_int_equal(petri_prompt_clear(NULL, true), 0);
    assert_int_equal(petri_config_revision(NULL), 0);
    assert_int_equal(petri_snapshot_bytes(NULL), 0);
    assert_int_equal(petri_diagnostic_count(NULL, PETRI_ERROR), 0);
    assert_int_equal(petri_frame_number(session), 1);
    petri_snapshot_free(snapshot);
}

static void test_invalid_levels_have_no_diagnostics(void **state) {
    Player *player = *state;
    assert_int_equal(player_load(player, "!a x=(\n"), PETRI_INVALID);
    assert_true(petri_diagnostic_count(player->session, PETRI_ERROR) > 0);
    assert_int_equal(petri_diagnostic_count(player->session, (PetriLevel)3), 0);
    assert_int_equal(petri_diagnostic_count(player->session, (PetriLevel)-1), 0);
    assert_int_equal(petri_diagnostic_count(player->session, (PetriLevel)1000000), 0);
}

// After fork, the child process has no worker threads, so petri_close must not wait for them.
static void test_close_after_fork(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.threads = 3;
    player_reopen(player, &options);
    player_run(player,
               "!physics state=:s dimensions=2\n    for i in ..3000\n        !particle id=i position=i;0 radius=1\n"
               "    !collision\n    !gravity\n",
               3);
    pid_t child = fork();
    if (child == 0) {
        alarm(20);
        petri_close(&player->session);
        _exit(player->session == NULL ? 0 : 1);
    }
    int status = -1;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    player_step(player, 1); // the parent process continues
}

// A reload rejects a pipe, which could block.
static void test_reload_rejects_pipe(void **state) {
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    folder_write(&folder, "s.fl", "!a x=frame\n");
    assert_int_equal(petri_load(player->session, folder_file(&folder, "s.fl")), PETRI_OK);
    assert_int_equal(remove(folder_file(&folder, "s.fl")), 0);
    assert_int_equal(mkfifo(folder_file(&folder, "s.fl"), 0600), 0);
    alarm(60);
    assert_int_equal(petri_reload(player->session, folder_file(&folder, "s.fl")), PETRI_INVALID);
    alarm(0);
    assert_non_null(strstr(player_diagnostics(player), "it is not a regular file"));
    player_step(player, 2);
    assert_text("the old one", player_tree(player), "!a x=1\n");
    folder_close(&folder);
}

TEST_GROUP(session_promises) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_texts_stay_valid),
        PLAYER_TEST(test_toggles_rewind),
        PLAYER_TEST(test_performance_rewinds),
        PLAYER_TEST(test_draw_memory_is_zeroed_before_frame_0),
        PLAYER_TEST(test_shaders_get_numbers_of_frame),
        PLAYER_TEST(test_work_of_drawing_is_added),
        PLAYER_TEST(test_null_arguments_are_accepted),
        PLAYER_TEST(test_invalid_levels_have_no_diagnostics),
        PLAYER_TEST(test_close_after_fork),
        PLAYER_TEST(test_reload_rejects_pipe),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
