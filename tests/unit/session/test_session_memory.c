// test_session_memory.c: lets each allocation of each public function fail in turn. Nothing may crash or leak, which
// sanitizers check. A failed call changes nothing, and repeating it gives the usual result.
#include "folder.h"
#include "heap.h"
#include "petri-draw.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "player.h"

static const char *const SCRIPT = "%pragma tempo 60\n"
                                  "import twice from 'module.fl'\n"
                                  "let N=N or 5 -- 1..9 how many\n"
                                  "    text='a';'b'\n"
                                  "func area(x)\n    twice(x)*x\n"
                                  "!physics state=:cells dimensions=2 time=beat resolution=0.01\n"
                                  "    for i in ..(N if frame < 4 else N+3)\n"
                                  "        !particle id=i position=10*uniform(:a)[i];10*uniform(:b)[i] radius=2\n"
                                  "    !anchor id=:hub position=0;0\n"
                                  "    !distance from=0 to=:hub fixed=2 strength=9\n"
                                  "    !collision\n    !random strength=10\n    !drag strength=0.1\n"
                                  "!physics state='text';1 dimensions=1 time=beat\n"
                                  "    !particle id='p' position=$(:cells;0)[0]\n    !constant force=1\n"
                                  "!counter state=:count rate=2;3 maximum=1;9\n"
                                  "!shown value=area($:count) text=text x=debug(frame)\n"
                                  "!window size=100;100\n    !key name=:space state=:space\n    !pointer state=:mouse\n"
                                  "    !canvas size=100;100\n        !fill color=0;1;0\n            !rect size=50;50\n";

typedef struct Stage {
    Folder folder;
    Player player;
    PetriSnapshot *early;
    PetriConfig *config;
    Notebook written; // output of the act (a call of a public function)
} Stage;

typedef PetriStatus Act(Stage *stage);

// Writes the current frame to `book`. Frames after an act are also written and compared, to check that the session
// continues as usual.
static void write_frame(Stage *stage, Notebook *book) {
    char line[100];
    PetriFrame frame = last_frame(stage->player.session);
    int len = snprintf(line, sizeof line, "%lld %.17g %.17g\n", (long long)frame.number, frame.time, frame.beat);
    note(book, line, (size_t)len);
    assert_int_equal(petri_print(stage->player.session, PETRI_PRINT_STATE, note, book), PETRI_OK);
    for (size_t i = 0; petri_prompt_statement(stage->player.session, i); i++) {
        const char *text = petri_prompt_statement(stage->player.session, i);
        note(book, text, strlen(text));
    }
    for (size_t i = 0; i < 2; i++) {
        PetriParameter parameter = {.name = "", .value = ""};
        petri_parameter(stage->player.session, i, &parameter, sizeof parameter);
        note(book, parameter.value, strlen(parameter.value));
    }
}

static void ignore(void *host, const PetriDiagnostic *diagnostic) {
    (void)host;
    (void)diagnostic;
}

static void open_stage(Stage *stage, bool interruptible) {
    PetriPromptResult done;
    PetriOptions options = player_options(&stage->player);
    options.rollback_frames = interruptible;
    options.on_diagnostic = ignore;
    options.threads = 1;
    options.profile = true;
    options.keep_forces = true;
    player_open_with(&stage->player, &options);
    PetriSession *session = stage->player.session;
    assert_int_equal(petri_load(session, folder_file(&stage->folder, "s.fl")), PETRI_OK);
    assert_int_equal(petri_prompt(session, "let typed=frame*2", PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done),
                     PETRI_OK);
    assert_int_equal(petri_prompt(session, "!typed x=typed", PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done),
                     PETRI_OK);
    player_step(&stage->player, 2);
    petri_report_key(session, "space", true);
    petri_report_pointer(
        session, &(PetriPointer){.size = sizeof(PetriPointer), .inside = true, .x = 0.5, .y = 0.25, .buttons = 1});
    player_step(&stage->player, 1);
    stage->early = petri_snapshot(session);
    stage->config = petri_config_get(session);
    assert_non_null(stage->early);
    assert_int_equal(petri_define(session, "M=1"), PETRI_OK);
    assert_int_equal(petri_save(session, folder_file(&stage->folder, "state")), PETRI_OK);
    player_step(&stage->player, 1);
    petri_report_key(session, "space", false);
    petri_report_pointer(session, &(PetriPointer){.size = sizeof(PetriPointer),
                                                  .inside = false}); // the pointer leaves, so its position is removed
    note(&stage->written, "", 0);
}

static void close_stage(Stage *stage) {
    petri_snapshot_free(stage->early);
    petri_config_free(stage->config);
    player_close(&stage->player);
    free(stage->written.text);
    stage->written = (Notebook){0};
}

static void clear_written(Stage *stage) {
    stage->written.len = 0;
    stage->written.text[0] = 0;
}

static bool write_text(void *host, const char *text, size_t len) {
    bool counts = heap.counts;
    heap.counts = false; // allocations of the notebook must not be counted
    note(host, text, len);
    heap.counts = counts;
    return true;
}

// --- acts: calls of public functions

static PetriStatus of_pointer(const void *pointer) {
    return pointer ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}

static PetriStatus act_open(Stage *stage) {
    (void)stage;
    PetriOptions options = petri_default_options();
    options.profile = true;
    options.threads = 2;
    PetriSession *session = petri_open(&options);
    PetriStatus status = of_pointer(session);
    petri_close(&session);
    return status;
}

static PetriStatus act_define(Stage *stage) {
    return petri_define(stage->player.session, "N=7");
}

static PetriStatus act_load(Stage *stage) {
    return petri_load(stage->player.session, folder_file(&stage->folder, "s.fl"));
}

static PetriStatus act_load_text(Stage *stage) {
    return petri_load_text(stage->player.session, "t.fl", "let A=A or 3\n!counter state=:other rate=A*2\n",
                           PETRI_NUL_TERMINATED);
}

static PetriStatus act_load_wrong(Stage *stage) {
    PetriStatus status = petri_load_text(stage->player.session, "t.fl", "!a x=\n", PETRI_NUL_TERMINATED);
    return status == PETRI_INVALID ? PETRI_OK : status;
}

static PetriStatus act_reload(Stage *stage) {
    return petri_reload(stage->player.session, folder_file(&stage->folder, "s.fl"));
}

static PetriStatus act_set_parameter(Stage *stage) {
    return petri_set_parameter(stage->player.session, "N", "8");
}

static PetriStatus act_check(Stage *stage) {
    return petri_check(stage->player.session, folder_file(&stage->folder, "s.fl"));
}

static PetriStatus act_step(Stage *stage) {
    return petri_step(stage->player.session);
}

static PetriStatus act_config(Stage *stage) {
    petri_set_tempo(stage->player.session, 90);
    petri_set_tempo(stage->player.session, 60);
    PetriConfig *config = petri_config_get(stage->player.session);
    petri_config_free(config);
    return of_pointer(config);
}

static PetriStatus act_config_apply(Stage *stage) {
    petri_config_apply(stage->player.session, stage->config);
    return PETRI_OK;
}

static PetriStatus act_snapshot(Stage *stage) {
    PetriSnapshot *snapshot = petri_snapshot(stage->player.session);
    petri_snapshot_free(snapshot);
    return of_pointer(snapshot);
}

static PetriStatus act_rewind(Stage *stage) {
    return petri_rewind(stage->player.session, stage->early);
}

static PetriStatus act_save(Stage *stage) {
    return petri_save(stage->player.session, folder_file(&stage->folder, "other"));
}

static PetriStatus act_restore(Stage *stage) {
    return petri_restore(stage->player.session, folder_file(&stage->folder, "state"));
}

static PetriStatus act_systems(Stage *stage) {
    PetriSystem system;
    uint32_t particle = 0;
    PetriForce force;
    bool found =
        petri_system(stage->player.session, 1, &system, sizeof system) &&
        petri_find_particle(stage->player.session, 0, petri_particle_id(stage->player.session, 0, 1), &particle) &&
        petri_particle_ids(stage->player.session, 0).data != NULL &&
        petri_system_force(stage->player.session, 0, 0, &force, sizeof force);
    return found ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}

static PetriStatus act_explain(Stage *stage) {
    PetriExplanation found;
    return petri_explain_force(stage->player.session, 0, 0, 0, &found, sizeof found);
}

static const PetriString some_text = {"some text", 9};
static const PetriItem some_items[] = {{PETRI_STRING, {.string = &some_text}}, {PETRI_NUMBER, {.number = 5}}};
static const PetriValue some_value = {.length = 2, .items = some_items};

static PetriStatus act_state(Stage *stage) {
    PetriStatus status = petri_state_set(stage->player.session, some_value, some_value);
    if (status == PETRI_OK &&
        !petri_format_value(stage->player.session, petri_state_get(stage->player.session, some_value)))
        status = petri_state_set(stage->player.session, some_value, (PetriValue){0}) == PETRI_OK ? PETRI_OUT_OF_MEMORY
                                                                                                 : PETRI_INVALID;
    return status;
}

// Moves a particle, and repeats the move when its frame is computed again.
static PetriStatus act_move(Stage *stage) {
    const double vector[] = {3, 4};
    PetriHistory *history = petri_history_new(stage->player.session, 0);
    PetriStatus status = of_pointer(history);
    if (status == PETRI_OK)
        status = petri_history_move_particle(history, 0, 1, vector, vector);
    petri_history_free(history);
    return status;
}

static PetriStatus act_set_global(Stage *stage) {
    return petri_set_global(stage->player.session, "given", some_value);
}

static PetriValue return_null(PetriCall *call, void *host, const PetriValue *arguments, uint32_t count) {
    (void)call;
    (void)host;
    (void)arguments;
    (void)count;
    return (PetriValue){0};
}

static PetriStatus act_add_function(Stage *stage) {
    return petri_add_function(stage->player.session,
                              &(PetriFunction){sizeof(PetriFunction), "f", "x, y=0", "help", false, return_null, NULL});
}

static PetriStatus act_picture(Stage *stage) {
    PetriPicture *picture;
    PetriPictureOptions options = petri_default_picture_options();
    PetriStatus status = petri_picture(stage->player.session, &options, &picture);
    petri_picture_free(&picture);
    return status;
}

static PetriStatus act_automatic_picture(Stage *stage) {
    PetriPicture *picture;
    PetriPictureOptions options = petri_default_picture_options();
    options.automatic = PETRI_AUTO_ALWAYS;
    PetriStatus status = petri_picture(stage->player.session, &options, &picture);
    petri_picture_free(&picture);
    return status;
}

static PetriStatus act_print(Stage *stage) {
    return petri_print(stage->player.session, 15, write_text, &stage->written);
}

static PetriStatus act_dump(Stage *stage) {
    PetriStatus status = petri_dump(stage->player.session, PETRI_DUMP_AST, write_text, &stage->written);
    return status == PETRI_OK ? petri_dump(stage->player.session, PETRI_DUMP_CODE, write_text, &stage->written)
                              : status;
}

static PetriStatus act_names(Stage *stage) {
    return petri_bindings(stage->player.session, "let other_name=(1;'two';:three)\nfunc g(x)\n    x\n",
                          PETRI_NUL_TERMINATED, player_ignore_name, NULL);
}

static PetriStatus act_tokens(Stage *stage) {
    return petri_tokenise(stage->player.session, "let new_name=(1;'two';:three) -- four\n", PETRI_NUL_TERMINATED,
                          player_ignore_token, NULL);
}

static PetriStatus act_prompt_check(Stage *stage) {
    uint64_t errors = petri_diagnostic_count(stage->player.session, PETRI_ERROR);
    if (petri_prompt_check(stage->player.session, "area(1;", PETRI_NUL_TERMINATED) == PETRI_INCOMPLETE)
        return PETRI_OK;
    assert_true(petri_diagnostic_count(stage->player.session, PETRI_ERROR) > errors); // the failure is reported
    return PETRI_OUT_OF_MEMORY;
}

static PetriStatus prompt(Stage *stage, const char *text) {
    PetriPromptResult done;
    return petri_prompt(stage->player.session, text, PETRI_NUL_TERMINATED, write_text, &stage->written, &done,
                        sizeof done);
}

static PetriStatus act_prompt_value(Stage *stage) {
    return prompt(stage, "area(typed)+debug(1);'text'");
}

static PetriStatus act_prompt_binding(Stage *stage) {
    return prompt(stage, "let more=typed*2");
}

static PetriStatus act_prompt_node(Stage *stage) {
    return prompt(stage, "!counter state=:typed rate=typed");
}

static PetriStatus act_evaluate(Stage *stage) {
    PetriEvaluation result;
    return petri_evaluate(stage->player.session, "area(typed)", PETRI_NUL_TERMINATED, &result, sizeof result,
                          write_text, &stage->written);
}

static PetriStatus act_prompt_clear(Stage *stage) {
    return petri_prompt_clear(stage->player.session, false) == 1 ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}

static PetriStatus act_preview(Stage *stage) {
    petri_set_resolution(stage->player.session, 0);
    return petri_preview(stage->player.session);
}

static PetriStatus act_parameters(Stage *stage) {
    PetriParameter parameter;
    return petri_parameter(stage->player.session, 0, &parameter, sizeof parameter) ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}

static PetriStatus act_texts(Stage *stage) {
    assert_string_equal(petri_prompt_statement(stage->player.session, 1), "!typed x=typed");
    assert_non_null(petri_source_file(stage->player.session, 0));
    return of_pointer(petri_visible_name(stage->player.session, 0));
}

static PetriStatus act_simple(Stage *stage) {
    petri_reset(stage->player.session);
    petri_set_fps(stage->player.session, 30);
    petri_resync_clock(stage->player.session);
    petri_has_picture(stage->player.session);
    petri_needs_history(stage->player.session);
    return petri_report_key(stage->player.session, "a", true);
}

static PetriStatus act_check_text(Stage *stage) {
    return petri_check_text(stage->player.session, "t.fl", "let A=3\n!counter state=:other rate=A*2\n",
                            PETRI_NUL_TERMINATED);
}

static PetriStatus act_print_log(Stage *stage) {
    return petri_print_log(stage->player.session, write_text, &stage->written);
}

// Discards the output, because it contains times.
static PetriStatus act_profile(Stage *stage) {
    Notebook seconds = {0};
    PetriStatus status = petri_profile(stage->player.session, 0, write_text, &seconds);
    free(seconds.text);
    return status;
}

static PetriStatus act_records(Stage *stage) {
    PetriPicture *picture;
    PetriPictureOptions options = petri_default_picture_options();
    bool ready = petri_picture_ready(stage->player.session, &options),
         records = petri_needs_history(stage->player.session);
    PetriStatus status = petri_picture(stage->player.session, &options, &picture);
    if (status == PETRI_OK) {
        assert_true(ready && !records);
        PetriPainter *painter = petri_painter_open();
        PetriRecord record;
        assert_false(painter &&
                     petri_picture_record(picture, painter, 0, &record, sizeof record)); // the picture was not rendered
        petri_painter_close(&painter);
        petri_picture_report(stage->player.session, picture);
    }
    petri_picture_free(&picture);
    return status;
}

// Only allocations by petri fail, not those inside Cairo and its dependencies.
static PetriStatus act_paint(Stage *stage) {
    static uint32_t pixels[100 * 100];
    PetriPicture *picture;
    PetriPictureOptions options = petri_default_picture_options();
    PetriStatus status = petri_picture(stage->player.session, &options, &picture);
    PetriPainter *painter = status == PETRI_OK ? petri_painter_open() : NULL;
    if (status == PETRI_OK)
        status = of_pointer(painter);
    if (status == PETRI_OK)
        status = petri_picture_draw(picture, painter, pixels, 100, 100, 400);
    const PetriLabel label = {.text = "label", .width = 50, .height = 20, .size = 10, .line_height = 12};
    if (status == PETRI_OK)
        status = petri_painter_draw_labels(painter, &label, 1, sizeof label, 1, pixels, 100, 100, 400);
    if (status == PETRI_OK)
        status = petri_picture_save(picture, painter, folder_file(&stage->folder, "a.png"));
    petri_painter_close(&painter);
    petri_picture_free(&picture);
    return status == PETRI_UNSUPPORTED ? PETRI_OK : status;
}

typedef struct Row {
    const char *name;
    Act *act;
    bool interruptible;
} Row;

static const Row rows[] = {
    {"open", act_open, false},
    {"define", act_define, false},
    {"load", act_load, false},
    {"load text", act_load_text, false},
    {"load a wrong text", act_load_wrong, false},
    {"reload", act_reload, false},
    {"set parameter", act_set_parameter, false},
    {"check", act_check, false},
    {"step", act_step, true},
    {"config", act_config, false},
    {"config use", act_config_apply, false},
    {"snapshot", act_snapshot, false},
    {"rewind", act_rewind, false},
    {"save", act_save, false},
    {"restore", act_restore, false},
    {"systems", act_systems, false},
    {"explain", act_explain, false},
    {"state", act_state, false},
    {"move", act_move, false},
    {"give", act_set_global, false},
    {"add a function", act_add_function, false},
    {"picture", act_picture, false},
    {"automatic picture", act_automatic_picture, false},
    {"print", act_print, false},
    {"dump", act_dump, false},
    {"tokens", act_tokens, false},
    {"names", act_names, false},
    {"input", act_prompt_check, false},
    {"prompt value", act_prompt_value, false},
    {"prompt binding", act_prompt_binding, false},
    {"prompt node", act_prompt_node, false},
    {"evaluate", act_evaluate, false},
    {"drop", act_prompt_clear, false},
    {"preview", act_preview, false},
    {"parameters", act_parameters, false},
    {"texts", act_texts, false},
    {"simple", act_simple, false},
    {"check text", act_check_text, false},
    {"print log", act_print_log, false},
    {"profile", act_profile, false},
    {"records", act_records, false},
    {"paint", act_paint, false},
};

// Records the output of the act, the session's state after it, and the next two frames.
static char *outcome(Stage *stage) {
    Notebook book = stage->written;
    write_frame(stage, &book);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(petri_step(stage->player.session), PETRI_OK);
        write_frame(stage, &book);
    }
    stage->written = (Notebook){0};
    note(&stage->written, "", 0);
    return book.text;
}

// Lets one allocation fail, and optionally all later ones.
static void check_failure(Stage *stage, const Row *row, long number, bool all, const char *wanted) {
    char name[100];
    Notebook before = {0}, after = {0};
    snprintf(name, sizeof name, "%s, allocation %ld%s", row->name, number, all ? " and later ones" : "");
    open_stage(stage, row->interruptible);
    write_frame(stage, &before);
    heap_fail(number, all);
    PetriStatus status = row->act(stage);
    heap_restore();
    if (status != PETRI_OK) {
        assert_number(name, status, PETRI_OUT_OF_MEMORY);
        write_frame(stage, &after);
        assert_text(name, after.text, before.text);
        clear_written(stage);
        assert_number(name, row->act(stage), PETRI_OK);
    }
    char *found = outcome(stage);
    assert_text(name, found, wanted);
    free(found);
    free(before.text);
    free(after.text);
    close_stage(stage);
}

static void ignore_trust(void *user_data, const PetriTrust *trust) {
    (void)user_data;
    (void)trust;
}

// petri_trust may leave the session at another frame, but in a valid state.
static void test_trust_without_memory_leaves_a_valid_session(void **state) {
    Stage *stage = *state;
    static const char *const expressions[] = {"frame"};
    const PetriTrustOptions options = {
        .size = sizeof options, .expressions = expressions, .count = 1, .frames = 4, .report = ignore_trust};
    bool failed = true;
    for (long number = 0; failed; number += 7) {
        open_stage(stage, false);
        heap_fail(number, true);
        PetriStatus status = petri_trust(stage->player.session, &options);
        heap_restore();
        failed = status != PETRI_OK;
        assert_true(!failed || status == PETRI_OUT_OF_MEMORY);
        petri_reset(stage->player.session);
        for (int i = 0; i < 3; i++)
            assert_int_equal(petri_step(stage->player.session), PETRI_OK);
        close_stage(stage);
    }
}

// Lets a sample of an act's allocations fail. TRIES=1000000 tries all of them.
static long max_tries(void) {
    const char *tries = getenv("TRIES");
    return tries ? strtol(tries, NULL, 10) : 50;
}

static void test_failed_allocations_change_nothing(void **state) {
    Stage *stage = *state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        open_stage(stage, rows[i].interruptible);
        heap_fail(-1, false);
        assert_number(rows[i].name, rows[i].act(stage), PETRI_OK);
        heap.counts = false;
        long total = heap.count, stride = 1 + total / max_tries();
        char *wanted = outcome(stage);
        close_stage(stage);
        for (long number = 0; number <= total; number += stride)
            for (int all = 0; all < 2; all++)
                check_failure(stage, &rows[i], number, all, wanted);
        free(wanted);
    }
}

// Without rollback_frames, systems that were updated before the allocation failed keep their new state, and the frame
// is counted. The session continues. With rollback_frames, a rollback that failed is repeated.
static void check_steps_continue(Stage *stage, bool interruptible) {
    for (long number = 0, total = 1; number < total; number++) {
        open_stage(stage, interruptible);
        heap_fail(number, true);
        PetriStatus status = petri_step(stage->player.session);
        heap_restore();
        total = status == PETRI_OK && heap.count <= number ? 0 : number + 2;
        assert_true(status == PETRI_OK || status == PETRI_OUT_OF_MEMORY);
        for (int i = 0; i < 3; i++) {
            PetriStatus again = petri_step(stage->player.session);
            if (again != PETRI_OK)
                print_error("allocation %ld: the step ended with %d, step %d after it with %d\n", number, (int)status,
                            i, (int)again);
            assert_int_equal(again, PETRI_OK);
        }
        close_stage(stage);
        number += number / 20;
    }
}

static void test_step_without_rollback_continues(void **state) {
    check_steps_continue(*state, false);
}

static void test_step_with_rollback_continues(void **state) {
    check_steps_continue(*state, true);
}

static void count_warnings(void *count, const PetriDiagnostic *diagnostic) {
    *(int *)count += diagnostic->level == PETRI_WARNING;
}

// A check either reports all problems or fails.
static void test_check_reports_all_or_fails(void **state) {
    (void)state;
    PetriStatus status = PETRI_OUT_OF_MEMORY;
    for (long number = 0; number <= heap.count || status != PETRI_OK; number++) {
        int warnings = 0;
        PetriOptions options = petri_default_options();
        options.on_diagnostic = count_warnings;
        options.user_data = &warnings;
        PetriSession *session = petri_open(&options);
        heap_fail(number, false);
        status = petri_check_text(session, "t.fl", "!a x=one y=two\n!counter state=:c rat=1\n", PETRI_NUL_TERMINATED);
        heap_restore();
        assert_int_equal(status, status == PETRI_OK ? PETRI_OK : PETRI_OUT_OF_MEMORY);
        if (status == PETRI_OK)
            assert_int_equal(warnings, 3);
        petri_close(&session);
    }
}

static int set_up(void **state) {
    Stage *stage = calloc(1, sizeof *stage);
    folder_open(&stage->folder);
    folder_write(&stage->folder, "module.fl", "let STEP=STEP or 2\nfunc twice(x)\n    x*STEP\n");
    folder_write(&stage->folder, "s.fl", SCRIPT);
    *state = stage;
    return 0;
}

static int tear_down(void **state) {
    Stage *stage = *state;
    folder_close(&stage->folder);
    free(stage);
    return 0;
}

TEST_GROUP(session_memory) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_failed_allocations_change_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_step_without_rollback_continues, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_step_with_rollback_continues, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_trust_without_memory_leaves_a_valid_session, set_up, tear_down),
        cmocka_unit_test(test_check_reports_all_or_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
