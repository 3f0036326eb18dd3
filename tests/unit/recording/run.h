// run.h: a recorded run with all kinds of inputs, and its replay.
#pragma once

#include "folder.h"
#include "petri-archive.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "petri-live.h"

enum { RUN_FRAMES = 60, RUN_DIGEST = 16 };

static const char RUN_SCRIPT[] = "%pragma fps 20\n"
                                 "%include 'part.fl'\n"
                                 "import scale from 'module.fl'\n"
                                 "let N=N or 6 -- 1..20 number of particles\n"
                                 "let rows=csv('data.csv', 0) files=glob('*.csv')\n"
                                 "!window\n"
                                 "    !pointer state=:mouse\n"
                                 "    !key name='space' state=:jump\n"
                                 "!physics state=:p dimensions=2 time=time\n"
                                 "    for i in ..N\n"
                                 "        !particle id=i position=uniform(:a)[i]*9;2 radius=1 mass=scale\n"
                                 "    !collision\n"
                                 "    !constant force=(level or 1);rows[0]\n"
                                 "    !random strength=($:mouse or 0)[0]+1\n"
                                 "!counter state=:count rate=len(files)+($:jump or 0)+speed*(realtime+1) maximum=100\n";

static Folder run_folder;

static inline void write_file(const char *name, const char *text) {
    folder_write(&run_folder, name, text);
}

static inline int enter_folder(void) {
    folder_open(&run_folder);
    return chdir(run_folder.path);
}

static inline int leave_folder(void **state) {
    (void)state;
    assert_int_equal(chdir("/"), 0);
    folder_close(&run_folder);
    return 0;
}

// Prepares the files of the script in the current folder.
static inline void run_write_files(void) {
    write_file("part.fl", "!counter state=:part rate=2\n");
    write_file("module.fl", "let scale=1.5\n");
    write_file("data.csv", "1,2\n3,4\n");
    write_file("run.fl", RUN_SCRIPT);
}

static inline void run_ignore_trust(void *user_data, const PetriTrust *trust) {
    (void)user_data;
    (void)trust;
}

// Compares runs with shorter steps, which must leave no trace in the recording.
static inline void run_trust(PetriSession *session) {
    const PetriTrustOptions options = {.size = sizeof options,
                                       .expressions = (const char *const[]){"$(:p;0)"},
                                       .count = 1,
                                       .frames = 25,
                                       .report = run_ignore_trust};
    assert_int_equal(petri_trust(session, &options), PETRI_OK);
}

// Gives the inputs before the frame `frame`.
static inline void run_give_inputs(PetriSession *session, int frame) {
    const double one[] = {frame};
    PetriSnapshot *snapshot;
    PetriPromptResult result;
    switch (frame) {
    case 3:
        petri_report_pointer(session, &(PetriPointer){sizeof(PetriPointer), true, 0.25, 0.75, PETRI_BUTTON_LEFT});
        break;
    case 5:
        petri_report_key(session, "space", true);
        petri_report_key(session, "space", false);
        petri_report_key(session, "space", true);
        break;
    case 8:
        assert_int_equal(petri_set_parameter(session, "N", "9"), PETRI_OK);
        break;
    case 12:
        assert_int_equal(petri_set_global(session, "level", (PetriValue){1, one, NULL}), PETRI_OK);
        break;
    case 15:
        assert_int_equal(petri_prompt(session,
                                      "!counter state=:extra rate=2\n"
                                      "if frame > 16\n"
                                      "    !physics state=:q dimensions=1\n"
                                      "        !particle id=1 velocity=2  -- all lines are recorded\n",
                                      PETRI_NUL_TERMINATED, NULL, NULL, &result, sizeof result),
                         PETRI_OK);
        break;
    case 20:
        write_file("module.fl", "let scale=2.5  -- changed\n");
        run_trust(session); // reads the module as of now
        break;
    case 23:
        write_file("data.csv", "7,8\n3,4,5\n");
        write_file("more.csv", "1\n");
        break;
    case 26:
        write_file("part.fl", "!counter state=:part rate=3.5\n");
        assert_int_equal(petri_reload(session, "run.fl"), PETRI_OK);
        break;
    case 30:
        assert_int_equal(petri_set_tempo(session, 95), PETRI_OK);
        assert_int_equal(petri_set_fps(session, 30), PETRI_OK);
        break;
    case 34:
        assert_int_equal(petri_state_set(session, (PetriValue){1, (double[]){17}, NULL}, (PetriValue){1, one, NULL}),
                         PETRI_OK);
        break;
    case 38:
        petri_report_pointer(session, NULL);
        break;
    case 44:
        snapshot = petri_snapshot(session);
        petri_step(session);
        petri_step(session);
        assert_int_equal(petri_rewind(session, snapshot), PETRI_OK);
        petri_snapshot_free(snapshot);
        break;
    default:
        break;
    }
}

static inline void run_step(PetriSession *session, int frame) {
    run_give_inputs(session, frame);
    bool jumps = frame == 41;
    double time = 5.125;
    assert_int_equal(jumps ? petri_step_at(session, time, time) : petri_step(session), PETRI_OK);
}

static inline PetriSession *run_open_session(void) {
    PetriOptions options = petri_default_options();
    options.threads = 1;
    PetriSession *session = petri_open(&options);
    const double half = 0.5;
    assert_non_null(session);
    assert_int_equal(petri_set_global(session, "speed", (PetriValue){1, &half, NULL}), PETRI_OK);
    assert_int_equal(petri_set_global(session, "level", (PetriValue){0}), PETRI_OK);
    return session;
}

// Records a run in a file. Stores the digest of each frame.
static inline void run_record(const char *file, int frames, uint8_t digests[RUN_FRAMES][RUN_DIGEST]) {
    PetriSession *session = run_open_session();
    PetriArchiveOptions options = petri_archive_default_options();
    options.keyframe_every = 10;
    options.command = "petri run run.fl";
    PetriArchive *archive = petri_archive_create(session, file, &options);
    assert_null(petri_archive_problem(archive));
    assert_int_equal(petri_load(session, "run.fl"), PETRI_OK);
    for (int i = 0; i < frames; i++) {
        run_step(session, i);
        assert_int_equal(petri_digest(session, digests[i]), PETRI_OK);
    }
    assert_null(petri_archive_problem(archive));
    assert_int_equal(petri_archive_add_note(archive, "a note"), PETRI_OK);
    petri_archive_close(&archive);
    petri_close(&session);
}

// Opens a session that reads the files of an archive.
static inline PetriSession *run_open_replay(PetriArchive *archive) {
    PetriOptions options = petri_default_options();
    options.threads = 1;
    options.read_file = petri_archive_read;
    options.read_user_data = archive;
    return petri_open(&options);
}
