// test_recording_replay.c: tests that replays of archives compute the recorded frames.
#include "run.h"

static uint8_t recorded[RUN_FRAMES][RUN_DIGEST];

static void check_frame(PetriSession *session, int frame) {
    uint8_t digest[RUN_DIGEST];
    assert_int_equal(petri_frame_number(session), frame);
    assert_int_equal(petri_digest(session, digest), PETRI_OK);
    if (memcmp(digest, recorded[frame], RUN_DIGEST) != 0)
        fail_msg("frame %d differs from the recording", frame);
}

static PetriArchive *open_archive(const char *file) {
    PetriArchive *archive = petri_archive_open(file, 0);
    assert_non_null(archive);
    if (petri_archive_problem(archive))
        fail_msg("%s", petri_archive_problem(archive));
    return archive;
}

static int record(void **state) {
    (void)state;
    if (enter_folder() != 0)
        return -1;
    run_write_files();
    run_record("run.petri", RUN_FRAMES, recorded);
    // A replay needs none of the files.
    return remove("run.fl") | remove("part.fl") | remove("module.fl") | remove("data.csv") | remove("more.csv");
}

static void test_replay_computes_recorded_frames(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriSession *session = run_open_replay(archive);
    assert_int_equal(petri_archive_replay(archive, session, -1), PETRI_OK);
    for (int i = 0; i < RUN_FRAMES; i++) {
        assert_int_equal(petri_step(session), PETRI_OK);
        check_frame(session, i);
        assert_false(petri_archive_keyframe_differs(archive));
    }
    assert_int_equal(petri_step(session), PETRI_OK); // continues after the recorded frames
    petri_close(&session);
    petri_archive_close(&archive);
}

static void test_replay_starts_at_any_frame(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    for (int from = 0; from < RUN_FRAMES; from++) {
        PetriSession *session = run_open_replay(archive);
        assert_int_equal(petri_archive_replay(archive, session, from), PETRI_OK);
        check_frame(session, from);
        for (int i = from + 1; i < RUN_FRAMES && i < from + 4; i++) {
            assert_int_equal(petri_step(session), PETRI_OK);
            check_frame(session, i);
        }
        petri_close(&session);
    }
    petri_archive_close(&archive);
}

static void test_replay_goes_to_other_frames(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriSession *session = run_open_replay(archive);
    const int frames[] = {35, 4, 59, 44, 45, 0, 29};
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++) {
        assert_int_equal(petri_archive_replay(archive, session, frames[i]), PETRI_OK);
        check_frame(session, frames[i]);
    }
    petri_close(&session);
    petri_archive_close(&archive);
}

static void step_to(PetriSession *session, int frame) {
    while (petri_frame_number(session) < frame) {
        assert_int_equal(petri_step(session), PETRI_OK);
        check_frame(session, (int)petri_frame_number(session));
    }
}

// The host can go back to snapshots of a replay, also to those before and at a keyframe with a given state (-1 and 43).
// Snapshots do not have the values of globals that the host sets, such as that of frame 12.
static void test_replay_continues_after_rewinds(void **state) {
    (void)state;
    const int frames[] = {-1, 12, 19, 24, 42, 43, 44, 50};
    enum { COUNT = sizeof frames / sizeof frames[0] };
    PetriSnapshot *snapshots[COUNT];
    PetriArchive *archive = open_archive("run.petri");
    PetriSession *session = run_open_replay(archive);
    assert_int_equal(petri_archive_load(archive, session, -1), PETRI_OK);
    for (int i = 0; i < COUNT; i++) {
        step_to(session, frames[i]);
        snapshots[i] = petri_snapshot(session);
        assert_non_null(snapshots[i]);
    }
    for (int i = COUNT - 1; i >= 0; i--) {
        assert_int_equal(petri_rewind(session, snapshots[i]), PETRI_OK);
        step_to(session, RUN_FRAMES - 1);
        petri_snapshot_free(snapshots[i]);
    }
    petri_reset(session);
    step_to(session, 5);
    petri_close(&session);
    petri_archive_close(&archive);
}

// After the end of a replay, frames have no recorded input: in frame 8 the recording has another N.
static void test_session_continues_after_the_end_of_a_replay(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriSession *session = run_open_replay(archive);
    PetriParameter n;
    for (int ends = 0; ends < 2; ends++) {
        assert_int_equal(petri_archive_replay(archive, session, 6), PETRI_OK);
        if (ends)
            petri_archive_end_replay(archive);
        for (int i = 0; i < 4; i++)
            assert_int_equal(petri_step(session), PETRI_OK);
        assert_true(petri_parameter(session, 0, &n, sizeof n));
        assert_string_equal(n.value, ends ? "6" : "9");
    }
    petri_close(&session);
    petri_archive_close(&archive);
    petri_archive_end_replay(NULL);
}

static void test_replay_computes_the_requested_frame(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriSession *session = run_open_replay(archive);
    PetriSystem system;
    assert_int_equal(petri_archive_load(archive, session, 25), PETRI_OK);
    check_frame(session, 19); // the keyframe
    assert_false(petri_system(session, 0, &system, sizeof system));
    assert_int_equal(petri_archive_replay(archive, session, 19), PETRI_OK);
    check_frame(session, 19);
    assert_true(petri_system(session, 0, &system, sizeof system));
    petri_close(&session);
    petri_archive_close(&archive);
}

static void test_archive_is_intact(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriArchiveInfo info;
    const char *name, *value;
    if (petri_archive_check(archive) != PETRI_OK)
        fail_msg("%s", petri_archive_problem(archive));
    assert_true(petri_archive_info(archive, &info, sizeof info));
    assert_string_equal(info.script, "run.fl");
    assert_string_equal(info.command, "petri run run.fl");
    assert_string_equal(info.version, petri_version());
    assert_int_equal(info.first_frame, 0);
    assert_int_equal(info.last_frame, RUN_FRAMES - 1);
    assert_int_equal(info.sealed_frame, RUN_FRAMES - 1);
    assert_int_equal(info.digests, RUN_FRAMES);
    assert_int_equal(info.keyframe_every, 10);
    assert_int_equal(strlen(info.sha256), 64);
    assert_true(petri_archive_parameter(archive, 0, &name, &value));
    assert_string_equal(name, "N");
    assert_string_equal(value, "6");
    assert_false(petri_archive_parameter(archive, 1, &name, &value));
    petri_archive_close(&archive);
}

static void test_archive_has_versions_of_files(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriArchiveFile file;
    int modules = 0;
    for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file); i++) {
        assert_null(strstr(file.name, "/tmp"));
        if (strcmp(file.name, "module.fl") != 0)
            continue;
        assert_int_equal(file.frame, modules == 0 ? 0 : 20);
        assert_string_equal(file.bytes, modules == 0 ? "let scale=1.5\n" : "let scale=2.5  -- changed\n");
        modules++;
    }
    assert_int_equal(modules, 2);
    petri_archive_close(&archive);
}

static void test_keyframes_state_where_they_come_from(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriArchiveKeyframe keyframe;
    int given = 0, count = 0;
    for (size_t i = 0; petri_archive_keyframe(archive, i, &keyframe, sizeof keyframe); i++, count++) {
        if (keyframe.given)
            assert_true(keyframe.frame == -1 || keyframe.frame == 43);
        given += keyframe.given;
        assert_true(keyframe.end >= keyframe.frame);
    }
    assert_int_equal(given, 2);
    assert_int_equal(count, 8);
    petri_archive_close(&archive);
}

// The rules of 0.3 give the same frames here, so they differ from those of today in the line `spec` of the states only.
static void test_the_version_of_the_rules_is_no_difference(void **state) {
    (void)state;
    static const char script[] = "!physics state=:p dimensions=1\n    !particle id=0 position=1 velocity=1\n";
    const char *specs[] = {"0.3", NULL};
    for (int recorder = 0; recorder < 2; recorder++) {
        PetriOptions options = petri_default_options();
        options.spec = specs[recorder];
        PetriSession *session = petri_open(&options);
        PetriArchiveOptions often = petri_archive_default_options();
        often.keyframe_every = 2;
        PetriArchive *archive = petri_archive_create(session, "rules.petri", &often);
        assert_int_equal(petri_load_text(session, "rules.fl", script, PETRI_NUL_TERMINATED), PETRI_OK);
        for (int i = 0; i < 5; i++) {
            assert_int_equal(petri_step(session), PETRI_OK);
            assert_int_equal(petri_digest(session, recorded[i]), PETRI_OK);
        }
        petri_archive_close(&archive);
        petri_close(&session);
        archive = open_archive("rules.petri");
        options.spec = recorder == 0 ? "0.4" : "0.3";
        options.read_file = petri_archive_read;
        options.read_user_data = archive;
        session = petri_open(&options);
        assert_int_equal(petri_archive_replay(archive, session, -1), PETRI_OK);
        assert_string_equal(petri_spec(session), options.spec);
        for (int i = 0; i < 5; i++) {
            assert_int_equal(petri_step(session), PETRI_OK);
            check_frame(session, i);
            assert_false(petri_archive_keyframe_differs(archive));
        }
        assert_int_equal(petri_archive_replay(archive, session, 3), PETRI_OK);
        const double key[] = {petri_symbol(session, "p"), 0}, elsewhere = 9;
        petri_state_set(session, (PetriValue){2, key, NULL}, (PetriValue){1, &elsewhere, NULL});
        assert_int_equal(petri_step(session), PETRI_OK);
        assert_true(petri_archive_keyframe_differs(archive)); // the state is still compared
        petri_close(&session);
        petri_archive_close(&archive);
        assert_int_equal(remove("rules.petri"), 0);
    }
}

static void test_recording_in_real_time_is_replayed(void **state) {
    (void)state;
    enum { FRAMES = 12 };
    static const char script[] = "!counter state=:a rate=1+performance+slow_frame+realtime+delta maximum=1e300\n"
                                 "!counter state=:b rate=time+clock maximum=1e300\n";
    PetriOptions options = petri_default_options();
    options.realtime = true;
    options.fps = 500;
    PetriSession *session = petri_open(&options);
    PetriArchiveOptions often = petri_archive_default_options();
    often.keyframe_every = 4;
    PetriArchive *archive = petri_archive_create(session, "live.petri", &often);
    assert_int_equal(petri_load_text(session, "live.fl", script, PETRI_NUL_TERMINATED), PETRI_OK);
    for (int i = 0; i < FRAMES; i++) {
        assert_int_equal(petri_step(session), PETRI_OK);
        assert_int_equal(petri_digest(session, recorded[i]), PETRI_OK);
    }
    petri_archive_close(&archive);
    petri_close(&session);
    archive = open_archive("live.petri");
    session = run_open_replay(archive);
    assert_int_equal(petri_archive_replay(archive, session, -1), PETRI_OK);
    for (int i = 0; i < FRAMES; i++) {
        assert_int_equal(petri_step(session), PETRI_OK);
        check_frame(session, i);
        assert_false(petri_archive_keyframe_differs(archive));
    }
    assert_int_equal(petri_archive_check(archive), PETRI_OK);
    petri_close(&session);
    petri_archive_close(&archive);
}

static void test_reset_begins_again(void **state) {
    (void)state;
    PetriSession *session = run_open_session();
    PetriArchive *archive = petri_archive_create(session, "reset.petri", NULL);
    assert_int_equal(petri_load_text(session, "a.fl", "!counter state=:a rate=1\n", PETRI_NUL_TERMINATED), PETRI_OK);
    for (int i = 0; i < 5; i++)
        assert_int_equal(petri_step(session), PETRI_OK);
    petri_reset(session);
    for (int i = 0; i < 3; i++)
        assert_int_equal(petri_step(session), PETRI_OK);
    petri_archive_close(&archive);
    petri_close(&session);
    archive = open_archive("reset.petri");
    PetriArchiveInfo info;
    assert_true(petri_archive_info(archive, &info, sizeof info));
    assert_int_equal(info.last_frame, 2);
    assert_int_equal(info.digests, 3);
    assert_int_equal(petri_archive_check(archive), PETRI_OK);
    petri_archive_close(&archive);
}

// Checks that an archive has the frames `first` to `last`, and that a replay computes them.
static void check_recording(const char *file, int first, int last) {
    PetriArchiveInfo info;
    uint8_t wanted[RUN_DIGEST], digest[RUN_DIGEST];
    PetriArchive *archive = open_archive(file);
    PetriSession *session = run_open_replay(archive);
    assert_int_equal(petri_archive_check(archive), PETRI_OK);
    assert_true(petri_archive_info(archive, &info, sizeof info));
    assert_int_equal(info.first_frame, first);
    assert_int_equal(info.last_frame, last);
    assert_int_equal(info.sealed_frame, last);
    assert_int_equal(petri_archive_load(archive, session, first - 1), PETRI_OK);
    for (int i = first; i <= last; i++) {
        assert_int_equal(petri_step(session), PETRI_OK);
        assert_true(petri_archive_digest(archive, i, wanted));
        assert_int_equal(petri_digest(session, digest), PETRI_OK);
        assert_memory_equal(digest, wanted, RUN_DIGEST);
    }
    assert_false(petri_archive_keyframe_differs(archive));
    petri_archive_close(&archive);
    petri_close(&session);
}

static PetriArchive *start(PetriSession *session, const char *file, int frames) {
    PetriArchive *archive = petri_archive_create(session, file, NULL);
    if (petri_archive_problem(archive))
        fail_msg("%s: %s", file, petri_archive_problem(archive));
    for (int i = 0; i < frames; i++)
        assert_int_equal(petri_step(session), PETRI_OK);
    return archive;
}

// After a reload, the text of a script is in its parse cache.
static void test_session_is_recorded_again(void **state) {
    (void)state;
    for (int reloads = 0; reloads < 3; reloads++) {
        write_file("again.fl", "%include 'added.fl'\n!counter state=:a rate=1\n");
        write_file("added.fl", "!counter state=:b rate=2\n");
        PetriSession *session = run_open_session();
        assert_int_equal(petri_load(session, "again.fl"), PETRI_OK);
        for (int i = 0; i < reloads; i++)
            assert_int_equal(petri_reload(session, NULL), PETRI_OK);
        PetriConfig *config = petri_config_get(session); // keeps the compiled script
        PetriArchive *first = start(session, "first.petri", 3);
        petri_archive_close(&first);
        write_file("added.fl", "!counter state=:b rate=5\n");
        PetriArchive *second = start(session, "second.petri", 4);
        petri_archive_close(&second);
        petri_config_apply(session, config);
        assert_int_equal(petri_step(session), PETRI_OK);
        petri_config_free(config);
        petri_close(&session);
        check_recording("first.petri", 0, 2);
        check_recording("second.petri", 3, 6);
    }
}

static void test_second_recording_completes_the_first(void **state) {
    (void)state;
    for (int order = 0; order < 4; order++) {
        write_file("again.fl", "!counter state=:a rate=1\n");
        PetriSession *session = run_open_session();
        assert_int_equal(petri_load(session, "again.fl"), PETRI_OK);
        PetriArchive *first = start(session, "first.petri", 3), *second = start(session, "second.petri", 4);
        assert_int_equal(petri_archive_add_note(first, "late"), PETRI_INVALID);
        if (order == 0)
            petri_archive_close(&first);
        assert_int_equal(petri_step(session), PETRI_OK);
        if (order == 2)
            petri_close(&session);
        petri_archive_close(order == 1 ? &second : &first);
        petri_archive_close(order == 1 ? &first : &second);
        petri_close(&session);
        check_recording("first.petri", 0, 2);
        check_recording("second.petri", 3, 7);
    }
}

static void test_replay_ends_with_its_archive_or_session(void **state) {
    (void)state;
    PetriArchive *archive = open_archive("run.petri");
    PetriSession *session = run_open_replay(archive), *other = run_open_replay(archive);
    assert_int_equal(petri_archive_replay(archive, session, 5), PETRI_OK);
    assert_int_equal(petri_archive_replay(archive, other, 9), PETRI_OK); // ends the replay of the first session
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_int_equal(petri_step(other), PETRI_OK);
    check_frame(other, 10);
    petri_close(&other);
    assert_false(petri_archive_keyframe_differs(archive));
    PetriArchive *recording = start(session, "copy.petri", 2);
    assert_int_equal(petri_archive_load(archive, session, 0), PETRI_OK); // ends the recording
    assert_int_equal(petri_archive_complete(recording), PETRI_OK);
    petri_archive_close(&archive);
    petri_archive_close(&recording);
    petri_close(&session);
}

static void test_create_keeps_other_files(void **state) {
    (void)state;
    write_file("notes.txt", "important\n");
    PetriSession *session = run_open_session();
    PetriArchive *archive = petri_archive_create(session, "notes.txt", NULL);
    assert_non_null(strstr(petri_archive_problem(archive), "not an archive"));
    petri_archive_close(&archive);
    static const char *const names[] = {"missing/run.petri", "", ".", "-", ":memory:", "new/", "/dev/null"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (i == 6 && geteuid() == 0)
            continue; // a fault would remove the device
        archive = petri_archive_create(session, names[i], NULL);
        if (!petri_archive_problem(archive))
            fail_msg("'%s' was accepted", names[i]);
        petri_archive_close(&archive);
    }
    petri_close(&session);
    char text[16] = "";
    FILE *stream = fopen("notes.txt", "r");
    assert_non_null(fgets(text, sizeof text, stream));
    fclose(stream);
    assert_string_equal(text, "important\n");
}

static void test_two_recordings_of_one_file(void **state) {
    (void)state;
    PetriSession *session = run_open_session(), *other = run_open_session();
    assert_int_equal(petri_load_text(session, "a.fl", "!counter state=:a rate=1\n", PETRI_NUL_TERMINATED), PETRI_OK);
    PetriArchive *archive = start(session, "shared.petri", 3);
    PetriArchive *second = petri_archive_create(other, "./shared.petri", NULL);
    assert_non_null(strstr(petri_archive_problem(second), "in use by another recording"));
    petri_archive_close(&second);
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_int_equal(petri_archive_complete(archive), PETRI_OK);
    petri_archive_close(&archive);
    check_recording("shared.petri", 0, 3);
    archive = start(session, "shared.petri", 1); // replaces it
    petri_archive_close(&archive);
    check_recording("shared.petri", 4, 4);
    petri_close(&other);
    petri_close(&session);
}

static PetriValue call_nothing(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count) {
    (void)call;
    (void)user_data;
    (void)arguments;
    (void)count;
    return (PetriValue){0};
}

static bool pull_nothing(void *user_data, const PetriSystem *system, double clock, double delta, double *force) {
    (void)user_data;
    (void)system;
    (void)clock;
    (void)delta;
    (void)force;
    return true;
}

static void test_forces_of_the_host_end_recording(void **state) {
    (void)state;
    PetriSession *session = run_open_session();
    PetriArchive *archive = petri_archive_create(session, "force.petri", NULL);
    assert_int_equal(petri_load_text(session, "a.fl", "!counter state=:a rate=1\n", PETRI_NUL_TERMINATED), PETRI_OK);
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_null(petri_archive_problem(archive));
    assert_int_equal(petri_set_force_callback(session, pull_nothing, NULL), PETRI_OK);
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_non_null(strstr(petri_archive_problem(archive), "of the host cannot be recorded"));
    petri_archive_close(&archive);
    petri_close(&session);
}

static void test_variations_end_recording(void **state) {
    (void)state;
    PetriSession *session = run_open_session();
    PetriArchive *archive = petri_archive_create(session, "varied.petri", NULL);
    assert_int_equal(petri_load_text(session, "a.fl", "!counter state=:a rate=1\n", PETRI_NUL_TERMINATED), PETRI_OK);
    assert_int_equal(petri_vary(session, &(PetriVariation){.size = sizeof(PetriVariation), .parts = 1}), PETRI_OK);
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_null(petri_archive_problem(archive));
    assert_int_equal(petri_vary(session, &(PetriVariation){.size = sizeof(PetriVariation), .parts = 2}), PETRI_OK);
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_non_null(strstr(petri_archive_problem(archive), "variations of the host"));
    petri_archive_close(&archive);
    petri_close(&session);
}

static void test_host_functions_end_recording(void **state) {
    (void)state;
    PetriSession *session = run_open_session();
    PetriArchive *archive = petri_archive_create(session, "host.petri", NULL);
    petri_add_function(
        session, &(PetriFunction){.size = sizeof(PetriFunction), .name = "f", .parameters = "x", .call = call_nothing});
    assert_int_equal(petri_load_text(session, "a.fl", "!counter state=:a rate=1\n", PETRI_NUL_TERMINATED), PETRI_OK);
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_non_null(strstr(petri_archive_problem(archive), "of the host cannot be recorded"));
    assert_int_equal(petri_step(session), PETRI_OK);
    petri_archive_close(&archive);
    petri_close(&session);
}

static void test_memory_limit_holds_for_files(void **state) {
    (void)state;
    PetriArchive *archive = petri_archive_open("run.petri", 10);
    PetriArchiveFile file;
    assert_false(petri_archive_file(archive, 0, &file, sizeof file));
    assert_non_null(petri_archive_problem(archive));
    petri_archive_close(&archive);
}

static void test_functions_reject_missing_arguments(void **state) {
    (void)state;
    PetriArchive *none = NULL;
    size_t length;
    assert_false(petri_archive_is(NULL));
    assert_null(petri_archive_open(NULL, 0));
    assert_null(petri_archive_create(NULL, "x", NULL));
    assert_null(petri_archive_problem(NULL));
    assert_null(petri_archive_read(NULL, "x", &length));
    assert_false(petri_archive_keyframe_differs(NULL));
    assert_int_equal(petri_archive_check(NULL), PETRI_INVALID);
    assert_int_equal(petri_archive_replay(NULL, NULL, 0), PETRI_INVALID);
    assert_int_equal(petri_archive_add_note(NULL, "x"), PETRI_INVALID);
    assert_int_equal(petri_archive_complete(NULL), PETRI_INVALID);
    petri_archive_close(&none);
    petri_archive_close(NULL);
}

TEST_GROUP(recording_replay) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_replay_computes_recorded_frames),
        cmocka_unit_test(test_replay_starts_at_any_frame),
        cmocka_unit_test(test_replay_goes_to_other_frames),
        cmocka_unit_test(test_replay_continues_after_rewinds),
        cmocka_unit_test(test_session_continues_after_the_end_of_a_replay),
        cmocka_unit_test(test_replay_ends_with_its_archive_or_session),
        cmocka_unit_test(test_replay_computes_the_requested_frame),
        cmocka_unit_test(test_archive_is_intact),
        cmocka_unit_test(test_archive_has_versions_of_files),
        cmocka_unit_test(test_keyframes_state_where_they_come_from),
        cmocka_unit_test(test_memory_limit_holds_for_files),
        cmocka_unit_test(test_the_version_of_the_rules_is_no_difference),
        cmocka_unit_test(test_recording_in_real_time_is_replayed),
        cmocka_unit_test(test_reset_begins_again),
        cmocka_unit_test(test_session_is_recorded_again),
        cmocka_unit_test(test_second_recording_completes_the_first),
        cmocka_unit_test(test_create_keeps_other_files),
        cmocka_unit_test(test_two_recordings_of_one_file),
        cmocka_unit_test(test_host_functions_end_recording),
        cmocka_unit_test(test_forces_of_the_host_end_recording),
        cmocka_unit_test(test_variations_end_recording),
        cmocka_unit_test(test_functions_reject_missing_arguments),
    };
    return cmocka_run_group_tests(tests, record, leave_folder);
}
