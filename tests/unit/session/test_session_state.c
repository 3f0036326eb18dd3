// test_session_state.c: tests petri_restore with invalid state files. Their hashes are valid, so their contents are
// read.
#include "base/hash_index.h"
#include "folder.h"
#include "petri-live.h"
#include "player.h"

#include <inttypes.h>

static const char SCRIPT[] =
    "!physics state=:s dimensions=1\n    !particle id=1 velocity=1\n!counter state=:n rate=60\n";

typedef struct StateRow {
    const char *body; // content of the state file after the first line
    PetriStatus status;
    const char *state; // printed state after the next frame
    const char *reported;
} StateRow;

static PetriStatus restore_with_header(Player *player, Folder *folder, const char *header, const char *body) {
    char text[400], end[40];
    snprintf(text, sizeof text, "%s%s", header, body);
    snprintf(end, sizeof end, "end %016" PRIx64 "\n", hash_bytes(0, text, strlen(text)));
    strcat(text, end);
    folder_write(folder, "s.state", text);
    PetriOptions options = player_options(player);
    player_reopen(player, &options);
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    return petri_restore(player->session, folder_file(folder, "s.state"));
}

static PetriStatus restore_text(Player *player, Folder *folder, const char *body) {
    return restore_with_header(player, folder, "petri-state 2\nspec 0.4\n", body);
}

// Returns the diagnostics without the name of the folder, which differs in each run.
static const char *report_text(Player *player) {
    static char text[400];
    const char *quote = strchr(player->diagnostics.text, '\''), *slash = quote ? strrchr(quote, '/') : NULL;
    if (slash)
        snprintf(text, sizeof text, "%.*s%s", (int)(quote - player->diagnostics.text + 1), player->diagnostics.text,
                 slash + 1);
    else
        snprintf(text, sizeof text, "%s", player->diagnostics.text);
    return text;
}

static void test_state_files_have_a_version_of_the_specification(void **state) {
    static const char another[] =
        "error cannot load the state from 's.state': written by another version of petri [state-file]\n";
    static const struct {
        const char *header;
        PetriStatus status;
        const char *reported;
    } rows[] = {
        {"petri-state 2\nspec 0.4\n", PETRI_OK, ""},
        {"petri-state 1\n", PETRI_OK,
         "warning 's.state' was computed by version 0.3 of the specification; the run continues by 0.4 [state-spec]\n"},
        {"petri-state 2\n", PETRI_INVALID, another},
        {"petri-state 2\nspec 0.4", PETRI_INVALID, another},
        {"petri-state 2\nspec \n", PETRI_INVALID, another},
        {"petri-state 2\nspec 0.3 nothing\n", PETRI_INVALID, another},
        {"petri-state 2\nspec 0.40000000000000000000000\n", PETRI_INVALID, another},
        {"petri-state 3\nspec 0.5\n", PETRI_INVALID, another},
    };
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        const char *body = "frame 9\n$(:n) = 7\n";
        assert_int_equal(restore_with_header(player, &folder, rows[i].header, body), rows[i].status);
        assert_text(rows[i].header, report_text(player), rows[i].reported);
    }
    folder_close(&folder);
}

static void test_invalid_state_files_are_rejected(void **state) {
    static const char damaged[] =
        "error cannot load the state from 's.state': file is truncated or corrupt [state-file]\n";
    static const StateRow rows[] = {
        {"frame 9\n$(:n) = 7\n$(:n;:time) = 0\n", PETRI_OK, "$:n = 17\n", ""},
        {"frame 9\n$(:t) = 'caf\xc3\xa9'\n", PETRI_OK, "$:t = 'caf\xc3\xa9'\n", ""},
        // Strings that are not valid UTF-8: in a value, in a key, as a symbol.
        {"frame 9\n$(:t) = 'caf\xe9'\n", PETRI_INVALID, "", damaged},
        {"frame 9\n$('\xf0\x28\x8c\x28') = 1\n", PETRI_INVALID, "", damaged},
        {"frame 9\n$(:\xa0\xa0) = 1\n", PETRI_INVALID, "", damaged},
        // Values that are not finite, which no state has.
        {"frame 9\n$(:n) = inf\n$(:n;:time) = 0\n", PETRI_INVALID, "", damaged},
        {"frame 9\n$(:x) = 1;nan\n", PETRI_INVALID, "", damaged},
        // Frame numbers beyond the range of int, and beyond 2^53.
        {"frame 2147483647\n", PETRI_OK, "$(:n;:time) = 35791394.13333333\n", ""},
        {"frame 4503599627370496\n", PETRI_OK, "$(:n;:time) = 75059993789508.28\n", ""},
        {"frame 9007199254740993\n", PETRI_OK, "$(:n;:time) = 150119987579016.56\n", ""},
        {"frame 99999999999999999\n", PETRI_OK, "$(:n;:time) = 1666666666666666.8\n", ""},
        {"frame 999999999999999999\n", PETRI_INVALID, "", damaged},
        {"frame 9223372036854775807\n", PETRI_INVALID, "", damaged},
        {"frame -7\n", PETRI_INVALID, "", damaged},
        {"frame \n", PETRI_INVALID, "", damaged},
        {"frame 1-2\n", PETRI_INVALID, "", damaged},
        {"frame 0\n$(nan) = 1\n", PETRI_INVALID, "", damaged},
        {"frame 0\n$(:n) =  1\n", PETRI_INVALID, "", damaged}, // a second space
        {"frame 0 \n", PETRI_INVALID, "", damaged},
        {"frame 0 = 1\n", PETRI_INVALID, "", damaged},
        {"frame = 1\n", PETRI_INVALID, "", damaged},
        {"frame $(:n)\n", PETRI_INVALID, "", damaged},
        {"frame 0\n$(:n)\n", PETRI_INVALID, "", damaged},
        {"frame 0\n$(:n) = 1", PETRI_INVALID, "", damaged},
        {"frame 0\n\n", PETRI_INVALID, "", damaged},
        {"frame 0\nclock = 1\n", PETRI_INVALID, "", damaged},
        // Systems: without or with another number, with a value, before entries; particles without a system.
        {"frame 0\n$(:n) = 1\nsystem 0 $(:p)\nparticle $(:p;1)\nsystem 1 $(:p)\n", PETRI_OK, "$:n = 1", ""},
        {"frame 0\nsystem $(:p)\n", PETRI_INVALID, "", damaged},
        {"frame 0\nsystem -1 $(:p)\n", PETRI_INVALID, "", damaged},
        {"frame 0\nsystem 4294967296 $(:p)\n", PETRI_INVALID, "", damaged},
        {"frame 0\nsystem 0 $(:p) = 1\n", PETRI_INVALID, "", damaged},
        {"frame 0\nsystem 0\n", PETRI_INVALID, "", damaged},
        {"frame 0\nsystem 0 $(:p)\n$(:n) = 1\n", PETRI_INVALID, "", damaged},
        {"frame 0\nparticle $(:p;1)\n", PETRI_INVALID, "", damaged},
        {"frame 0\nsystem 0 $(:p)\nparticle 1 $(:p;1)\n", PETRI_INVALID, "", damaged},
    };
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_int_equal(restore_text(player, &folder, rows[i].body), rows[i].status);
        assert_text(rows[i].body, report_text(player), rows[i].reported);
        player_step(player, 1);
        const char *found = player_state(player);
        if (!strstr(found, rows[i].state))
            assert_text(rows[i].body, found, rows[i].state);
        assert_null(strstr(found, "inf"));
        assert_null(strstr(found, "nan"));
    }
    folder_close(&folder);
}

// Frame numbers that double cannot represent are counted and saved correctly.
static void test_large_frame_numbers(void **state) {
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    assert_int_equal(restore_text(player, &folder, "frame 9007199254740993\n"), PETRI_OK);
    player_step(player, 2);
    assert_int_equal(petri_frame_number(player->session), INT64_C(9007199254740995));
    assert_int_equal(petri_save(player->session, folder_file(&folder, "t.state")), PETRI_OK);
    assert_int_equal(petri_restore(player->session, folder_file(&folder, "t.state")), PETRI_OK);
    assert_int_equal(petri_frame_number(player->session), INT64_C(9007199254740995));
    folder_close(&folder);
}

// A host may save often between two frames, because saving retains no memory.
static void test_saving_retains_no_memory(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.memory_limit = 1 << 20; // the session may use 64 MiB more for its own data
    player_reopen(player, &options);
    Folder folder;
    folder_open(&folder);
    player_run(player, SCRIPT, 1);
    static double numbers[100000];
    for (size_t i = 0; i < COUNT_OF(numbers); i++)
        numbers[i] = (double)(i + 1) / 7;
    assert_int_equal(petri_state_set(player->session, (PetriValue){1, &(double){5}, NULL},
                                     (PetriValue){COUNT_OF(numbers), numbers, NULL}),
                     PETRI_OK);
    for (int i = 0; i < 60; i++)
        assert_int_equal(petri_save(player->session, folder_file(&folder, "t.state")), PETRI_OK);
    folder_close(&folder);
}

// Systems that are absent, paused or not finite, and counters between them. Particles have slots before they have
// entries.
static const char HISTORY[] = "!physics state=:z dimensions=2 time=max(0;time-0.15)\n"
                              "    for i in ..3\n"
                              "        !particle id=4-i position=i;0 velocity=0;1\n"
                              "if frame%12 > 7\n"
                              "    !physics state=:y dimensions=1\n"
                              "        !particle id=frame%5 velocity=1\n"
                              "        !particle id='s'\n"
                              "!counter state=:c rate=2\n"
                              "if frame < 6\n"
                              "    !physics state=:x dimensions=(1 if frame%4 else 1/0)\n"
                              "        !anchor id=1 position=frame\n"
                              "!physics state=:w dimensions=1 run=frame//9\n"
                              "    for i in ..frame//3\n"
                              "        !particle id=-i position=(1/0 if frame < 10 else i)\n"
                              "if frame > 3\n"
                              "    !physics state=:w dimensions=1\n"
                              "        !particle id=:last position=3\n";

// Returns the state file of a session, which the caller frees.
static char *saved_text(PetriSession *session, Folder *folder) {
    char *text = calloc(1, 10000);
    assert_int_equal(petri_save(session, folder_file(folder, "saved.state")), PETRI_OK);
    FILE *file = fopen(folder_file(folder, "saved.state"), "rb");
    assert_non_null(file);
    assert_true(fread(text, 1, 9999, file) > 100);
    fclose(file);
    return text;
}

static void restart(Player *player) {
    PetriOptions options = player_options(player);
    player_reopen(player, &options);
    assert_int_equal(player_load(player, HISTORY), PETRI_OK);
}

// A session that was restored saves the same bytes as one that was not, and lists its entries and systems in the same
// order.
static void test_restored_sessions_save_the_same_bytes(void **state) {
    enum { FRAMES = 30 };
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    char *expected[FRAMES];
    restart(player);
    for (int i = 0; i < FRAMES; i++) {
        player_step(player, 1);
        expected[i] = saved_text(player->session, &folder);
    }
    for (int from = 0; from < FRAMES; from++) {
        restart(player);
        folder_write(&folder, "from.state", expected[from]);
        assert_int_equal(petri_restore(player->session, folder_file(&folder, "from.state")), PETRI_OK);
        PetriSnapshot *snapshot = petri_snapshot(player->session);
        for (int again = 0; again < 2; again++) {
            for (int i = from; i < FRAMES; i++) {
                char *found = saved_text(player->session, &folder);
                if (strcmp(found, expected[i]) != 0)
                    fail_msg("restored at frame %d, frame %d differs: %s instead of %s", from, i, found, expected[i]);
                free(found);
                player_step(player, 1);
            }
            assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK);
        }
        petri_snapshot_free(snapshot);
    }
    for (int i = 0; i < FRAMES; i++)
        free(expected[i]);
    folder_close(&folder);
}

TEST_GROUP(session_state) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_state_files_have_a_version_of_the_specification),
        PLAYER_TEST(test_invalid_state_files_are_rejected), PLAYER_TEST(test_large_frame_numbers),
        PLAYER_TEST(test_restored_sessions_save_the_same_bytes), PLAYER_TEST(test_saving_retains_no_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
