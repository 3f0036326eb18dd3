// test_recording_damage.c: tests that damaged archives are detected, and that none crashes the reader.
#include "run.h"

#include <sqlite3.h>

enum { FRAMES = 22 };

static uint8_t recorded[RUN_FRAMES][RUN_DIGEST];
static unsigned char *whole; // bytes of a small archive
static size_t whole_size;
static size_t stride = 1; // distance between bytes that are flipped; set by the first argument

static int record(void **state) {
    (void)state;
    if (enter_folder() != 0)
        return -1;
    run_write_files();
    run_record("run.petri", FRAMES, recorded);
    FILE *stream = fopen("run.petri", "rb");
    assert_non_null(stream);
    fseek(stream, 0, SEEK_END);
    whole_size = (size_t)ftell(stream);
    rewind(stream);
    whole = malloc(whole_size);
    assert_int_equal(fread(whole, 1, whole_size, stream), whole_size);
    fclose(stream);
    return 0;
}

static int finish(void **state) {
    free(whole);
    return leave_folder(state);
}

static void write_bytes(const unsigned char *bytes, size_t size) {
    FILE *stream = fopen("damaged.petri", "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size, stream), size);
    fclose(stream);
}

// Replays an archive from its start. Returns true if all frames and keyframes are as recorded.
static bool replay(PetriArchive *archive, int frames) {
    PetriSession *session = run_open_replay(archive);
    bool good = petri_archive_replay(archive, session, -1) == PETRI_OK;
    for (int i = 0; good && i < frames; i++) {
        uint8_t digest[RUN_DIGEST];
        good = petri_step(session) == PETRI_OK && petri_digest(session, digest) == PETRI_OK &&
               memcmp(digest, recorded[i], RUN_DIGEST) == 0 && !petri_archive_keyframe_differs(archive);
    }
    petri_close(&session);
    return good;
}

// Reads everything in damaged.petri. Returns true if damage was detected.
static bool is_detected(void) {
    PetriArchive *archive = petri_archive_open("damaged.petri", 0);
    assert_non_null(archive);
    PetriArchiveInfo info;
    PetriArchiveFile file;
    bool detected = petri_archive_check(archive) != PETRI_OK;
    detected = !petri_archive_info(archive, &info, sizeof info) || detected;
    for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file);)
        i++;
    PetriArchiveKeyframe keyframe;
    for (size_t i = 0; petri_archive_keyframe(archive, i, &keyframe, sizeof keyframe); i++)
        assert_true(keyframe.end >= keyframe.frame);
    detected = detected || petri_archive_problem(archive);
    petri_archive_close(&archive);
    return detected;
}

// Flips bits of every byte of the archive. If this is not detected, the replay must be the same: the byte is not used.
static void flip_byte(int file, size_t at, unsigned char mask) {
    unsigned char byte = whole[at] ^ mask;
    assert_int_equal(pwrite(file, &byte, 1, (off_t)at), 1);
}

static void test_every_flipped_byte_is_detected_or_harmless(void **state) {
    (void)state;
    size_t harmless = 0;
    write_bytes(whole, whole_size);
    int file = open("damaged.petri", O_WRONLY);
    for (size_t i = 0; i < whole_size; i += stride) {
        const unsigned char masks[] = {0x01, 0x80, 0xff};
        flip_byte(file, i, masks[i / stride % 3]);
        bool detected = is_detected();
        if (!detected && harmless++ % 16 == 0) { // not all, to save time
            PetriArchive *archive = petri_archive_open("damaged.petri", 0);
            if (!replay(archive, FRAMES))
                fail_msg("byte %zu of the archive can be changed unnoticed", i);
            petri_archive_close(&archive);
        }
        flip_byte(file, i, 0);
    }
    close(file);
    assert_true(harmless < whole_size);
}

static void test_truncated_archive_is_detected(void **state) {
    (void)state;
    for (size_t size = 0; size < whole_size; size += 509) {
        write_bytes(whole, size);
        assert_true(is_detected());
    }
}

// Executes SQL on a copy of the archive.
static void change(const char *sql) {
    sqlite3 *database = NULL;
    char *error = NULL;
    write_bytes(whole, whole_size);
    assert_int_equal(sqlite3_open("damaged.petri", &database), SQLITE_OK);
    if (sqlite3_exec(database, sql, NULL, NULL, &error) != SQLITE_OK)
        fail_msg("%s", error);
    sqlite3_close(database);
}

static void test_changed_rows_are_detected(void **state) {
    (void)state;
    static const char *const changes[] = {
        "UPDATE meta SET value = 'x' WHERE key = 'command'",
        "UPDATE parameter SET value = '7'",
        "UPDATE file SET name = 'other.fl' WHERE id = 1",
        "UPDATE file SET frame = 3 WHERE id = 2",
        "UPDATE file SET bytes = CAST('let scale=9' AS BLOB) WHERE name = 'module.fl'",
        "UPDATE file SET bytes = 'text' WHERE name = 'module.fl'",
        "UPDATE file SET sha256 = 'abc' WHERE id = 2",
        "UPDATE input SET payload = '0;0.5;0.5' WHERE kind = 'pointer'",
        "UPDATE input SET payload = CAST(payload AS BLOB) WHERE kind = 'pointer'",
        "UPDATE note SET text = CAST(text AS BLOB)",
        "UPDATE file SET name = CAST(name AS BLOB)",
        "UPDATE input SET frame = frame + 1",
        "DELETE FROM input WHERE kind = 'key'",
        "UPDATE digest SET digest = zeroblob(16) WHERE frame = 4",
        "UPDATE digest SET digest = zeroblob(3) WHERE frame = 4",
        "DELETE FROM digest WHERE frame = 7",
        "UPDATE keyframe SET given = 1",
        "UPDATE keyframe SET setup = replace(setup, '20', '21')",
        "UPDATE keyframe SET state = replace(state, '1', '2') WHERE frame = 9",
        "UPDATE keyframe SET sha256 = upper(sha256)",
        "DELETE FROM keyframe WHERE frame = 9",
        "UPDATE keyframe SET frame = 8 WHERE frame = 9",
        "UPDATE note SET text = 'x'",
        "PRAGMA user_version = 3",
        "PRAGMA application_id = 7",
        "CREATE TABLE more (x)",
        "CREATE VIEW v AS SELECT * FROM meta",
        "CREATE TRIGGER t AFTER INSERT ON note BEGIN DELETE FROM note; END",
        "DROP TABLE note",
        "ALTER TABLE meta ADD COLUMN x",
    };
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        change(changes[i]);
        if (!is_detected())
            fail_msg("not detected: %s", changes[i]);
    }
    change("VACUUM");
    assert_false(is_detected());
}

// Replays a changed archive without checking it first.
static bool is_replayed(const char *sql) {
    change(sql);
    PetriArchive *archive = petri_archive_open("damaged.petri", 0);
    bool replayed = replay(archive, FRAMES);
    petri_archive_close(&archive);
    return replayed;
}

static void test_invalid_rows_end_the_replay(void **state) {
    (void)state;
    static const char *const changes[] = {
        "UPDATE keyframe SET setup = ''",
        "UPDATE keyframe SET setup = setup || 'x'",
        "UPDATE keyframe SET setup = x'ff'",
        "UPDATE keyframe SET setup = replace(setup, 'host_names = ', 'host_names = -')",
        "UPDATE keyframe SET setup = replace(setup, 'rates = ', 'rates = 0;')",
        "UPDATE keyframe SET setup = replace(setup, 'base = ', 'base = 1e300;')",
        "UPDATE keyframe SET setup = replace(setup, 'script = ', 'script = 1;')",
        "UPDATE keyframe SET setup = setup || 'switch = 4;1;1;1;-5' || char(10)",
        "UPDATE keyframe SET setup = setup || 'switch = 400;1;1;1;0' || char(10)",
        "UPDATE keyframe SET setup = setup || 'binding = 1e9;1' || char(10)",
        "UPDATE keyframe SET setup = setup || 'global = 1' || char(10)",
        "UPDATE keyframe SET setup = setup || 'global = ''x''' || char(10)",
        "UPDATE keyframe SET setup = setup || 'prompt = ''let ''' || char(10)",
        "UPDATE keyframe SET setup = setup || 'define = 5' || char(10)",
        "UPDATE keyframe SET state = ''",
        "UPDATE keyframe SET state = 'petri-state 1'",
        "UPDATE input SET payload = '1;2;3;4;5' WHERE kind = 'pointer'",
        "UPDATE input SET payload = '''nothing'';1' WHERE kind = 'key'",
        "UPDATE input SET kind = 'unknown' WHERE kind = 'key'",
        "UPDATE input SET payload = '1' WHERE kind = 'global'",
        "UPDATE input SET kind = 'state', payload = '1' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = '1 = 1e999' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = '1 = 3;nan' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = 'nan = 1' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = '1 = 2;' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = '1 = 2 = 3' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = '1 = !a' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = x'31203d2032' WHERE kind = 'key'",
        "UPDATE input SET kind = 'state', payload = 12 WHERE kind = 'key'",
        "UPDATE input SET payload = 'script = ''other.fl''' || char(10) WHERE kind = 'configuration'",
        "UPDATE input SET kind = 'clock', payload = '1;2;3' WHERE kind = 'key'",
        "UPDATE input SET kind = 'clock', payload = '1;2;3;4;5;6;x' WHERE kind = 'key'",
        "UPDATE input SET kind = 'clock', payload = '1;2;3;4;5;6;1e999' WHERE kind = 'key'",
        "DELETE FROM file WHERE name = 'run.fl'",
        "DELETE FROM keyframe",
    };
    assert_true(is_replayed("VACUUM"));
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++)
        if (is_replayed(changes[i]))
            fail_msg("replayed: %s", changes[i]);
}

static void test_open_rejects_other_files(void **state) {
    (void)state;
    write_file("text.petri", "!window\n");
    assert_false(petri_archive_is("text.petri"));
    assert_true(petri_archive_is("run.petri"));
    const char *const files[] = {"text.petri", "missing.petri", "."};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        PetriArchive *archive = petri_archive_open(files[i], 0);
        assert_non_null(petri_archive_problem(archive));
        petri_archive_close(&archive);
    }
}

TEST_GROUP(recording_damage) {
    stride = argc > 1 ? strtoul(argv[1], NULL, 10) : stride;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_open_rejects_other_files),
        cmocka_unit_test(test_changed_rows_are_detected),
        cmocka_unit_test(test_invalid_rows_end_the_replay),
        cmocka_unit_test(test_truncated_archive_is_detected),
        cmocka_unit_test(test_every_flipped_byte_is_detected_or_harmless),
    };
    return cmocka_run_group_tests(tests, record, finish);
}
