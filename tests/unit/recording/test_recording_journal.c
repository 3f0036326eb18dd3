// test_recording_journal.c: tests that the journal of a killed recording is applied as SQLite applies it, and that
// readers write nothing.
#include "recording/journal.h"
#include "run.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FRAMES = 22, MUTATIONS = 600, MAX_PAGES = 1 << 12 };

static uint8_t recorded[RUN_FRAMES][RUN_DIGEST];
static char digest_of_run[65];

typedef struct Bytes {
    unsigned char *bytes;
    size_t size;
} Bytes;

static Bytes read_bytes(const char *name) {
    Bytes read = {0};
    FILE *stream = fopen(name, "rb");
    if (!stream)
        return read;
    fseek(stream, 0, SEEK_END);
    read.size = (size_t)ftell(stream);
    rewind(stream);
    read.bytes = malloc(read.size + 1);
    assert_int_equal(fread(read.bytes, 1, read.size, stream), read.size);
    fclose(stream);
    return read;
}

static void write_bytes(const char *name, Bytes bytes) {
    FILE *stream = fopen(name, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes.bytes, 1, bytes.size, stream), bytes.size);
    fclose(stream);
}

static void copy_file(const char *from, const char *to) {
    Bytes bytes = read_bytes(from);
    write_bytes(to, bytes);
    free(bytes.bytes);
}

static void execute(sqlite3 *database, const char *sql) {
    char *error = NULL;
    if (sqlite3_exec(database, sql, NULL, NULL, &error) != SQLITE_OK)
        fail_msg("%s: %s", sql, error);
}

// Makes killed.petri and its journal: copies in the middle of a transaction that has changed most pages. A small cache
// makes a journal of several segments.
static void make_killed(const char *cache) {
    sqlite3 *database = NULL;
    copy_file("run.petri", "work.petri");
    assert_int_equal(sqlite3_open("work.petri", &database), SQLITE_OK);
    execute(database, cache);
    execute(database, "BEGIN IMMEDIATE; DELETE FROM digest; UPDATE keyframe SET state = 'lost'");
    execute(database,
            "UPDATE file SET bytes = zeroblob(9000); INSERT INTO note VALUES (NULL, 1, hex(zeroblob(90000)))");
    assert_int_equal(sqlite3_db_cacheflush(database), SQLITE_OK);
    copy_file("work.petri", "killed.petri");
    copy_file("work.petri-journal", "killed.petri-journal");
    execute(database, "ROLLBACK");
    sqlite3_close(database);
}

static int record(void **state) {
    (void)state;
    if (enter_folder() != 0)
        return -1;
    run_write_files();
    run_record("run.petri", FRAMES, recorded);
    PetriArchiveInfo info;
    PetriArchive *archive = petri_archive_open("run.petri", 0);
    assert_true(petri_archive_info(archive, &info, sizeof info));
    strcpy(digest_of_run, info.sha256);
    petri_archive_close(&archive);
    return 0;
}

static bool is_whole(const char *name) {
    PetriArchiveInfo info;
    PetriArchive *archive = petri_archive_open(name, 0);
    bool whole = petri_archive_check(archive) == PETRI_OK && petri_archive_info(archive, &info, sizeof info) &&
                 strcmp(info.sha256, digest_of_run) == 0 && info.digests == FRAMES;
    petri_archive_close(&archive);
    return whole;
}

static void assert_unchanged(const char *name, Bytes before) {
    Bytes after = read_bytes(name);
    assert_int_equal(after.size, before.size);
    assert_memory_equal(after.bytes, before.bytes, before.size);
    free(after.bytes);
}

static void test_killed_recording_is_whole(void **state) {
    (void)state;
    const char *const caches[] = {"PRAGMA cache_size = 2", "PRAGMA cache_size = 5", "PRAGMA cache_size = 1000"};
    for (size_t i = 0; i < sizeof caches / sizeof caches[0]; i++) {
        make_killed(caches[i]);
        Bytes archive = read_bytes("killed.petri"), journal = read_bytes("killed.petri-journal");
        assert_true(is_whole("killed.petri"));
        assert_unchanged("killed.petri", archive);
        assert_unchanged("killed.petri-journal", journal);
        assert_int_equal(symlink("killed.petri", "link.petri"), 0);
        assert_true(is_whole("link.petri")); // the journal is beside the file to which the link leads
        remove("link.petri");
        remove("killed.petri-journal");
        assert_false(is_whole("killed.petri"));
        write_bytes("killed.petri-journal", journal);
        // A stranger's journal is not followed to another place.
        assert_int_equal(rename("killed.petri-journal", "elsewhere"), 0);
        assert_int_equal(symlink("elsewhere", "killed.petri-journal"), 0);
        assert_false(is_whole("killed.petri"));
        remove("killed.petri-journal");
        free(archive.bytes);
        free(journal.bytes);
    }
}

// --- comparison with SQLite

static uint32_t seed = 1;

static uint32_t below(uint32_t n) {
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) % n;
}

static void put(unsigned char *at, uint32_t x) {
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(x >> (24 - 8 * i));
}

static uint32_t get(const unsigned char *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

// Computes the checksum of a record again.
static void reseal(unsigned char *record, uint32_t page_size, uint32_t nonce) {
    uint32_t sum = nonce;
    for (int64_t at = (int64_t)page_size - 200; at > 0; at -= 200)
        sum += record[4 + at];
    put(record + 4 + page_size, sum);
}

static void mutate_header(unsigned char *journal, uint32_t records, uint32_t pages) {
    const uint32_t counts[] = {0, 1, records - 1, records, records + 1, UINT32_MAX};
    const uint32_t sizes[] = {0, 1, pages - 1, pages, pages + 1, pages + 100};
    const uint32_t sectors[] = {0, 32, 512, 1024, 4096, 100};
    switch (below(5)) {
    case 0:
        put(journal + 8, counts[below(6)]);
        break;
    case 1:
        put(journal + 16, sizes[below(6)]);
        break;
    case 2:
        put(journal + 20, sectors[below(6)]);
        break;
    case 3:
        put(journal + 12, below(UINT32_MAX));
        break;
    default:
        journal[below(28)] ^= (unsigned char)(1U << below(8));
    }
}

// `header` is that of the journal before all changes.
static void mutate(Bytes *journal, const unsigned char *header) {
    uint32_t page_size = get(header + 24), nonce = get(header + 12), pages = get(header + 16);
    size_t length = page_size + 8, head = 512;
    uint32_t records = (uint32_t)((journal->size - head) / length);
    unsigned char *record = journal->bytes + head + below(records) * length;
    const uint32_t numbers[] = {0, 1, 2, pages, pages + 1, UINT32_MAX, 0x40000000 / page_size + 1};
    switch (below(7)) {
    case 0:
        mutate_header(journal->bytes, records, pages);
        break;
    case 1:
        put(record, numbers[below(7)]);
        break;
    case 2:
        record[4 + below(page_size)] ^= (unsigned char)(1U << below(8));
        break;
    case 3:
        record[4 + below(page_size)] ^= (unsigned char)(1U << below(8));
        reseal(record, page_size, nonce);
        break;
    case 4:
        journal->size = below((uint32_t)journal->size);
        break;
    case 5:
        memcpy(record, journal->bytes + head + below(records) * length, length); // a page twice
        break;
    default:
        journal->bytes[below((uint32_t)journal->size)] ^= 0xff;
    }
}

// Lets SQLite recover the database in a file, and returns its contents.
static Bytes recover(const char *name) {
    sqlite3 *database = NULL;
    assert_int_equal(sqlite3_open(name, &database), SQLITE_OK);
    sqlite3_exec(database, "PRAGMA synchronous = OFF", NULL, NULL, NULL);
    sqlite3_exec(database, "SELECT count(*) FROM sqlite_schema", NULL, NULL, NULL);
    sqlite3_close(database);
    return read_bytes(name);
}

// Returns the contents of a database with a journal as readers of archives see them.
static Bytes overlay(Bytes file, const Journal *journal, Bytes journal_bytes) {
    Bytes seen = {NULL, journal->exists ? (size_t)journal->page_count * journal->page_size : file.size};
    seen.bytes = calloc(seen.size + 1, 1);
    memcpy(seen.bytes, file.bytes, seen.size < file.size ? seen.size : file.size);
    for (uint32_t page = 1; journal->exists && page <= journal->page_count; page++) {
        int64_t at = archive_journal_find(journal, page);
        if (at >= 0)
            memcpy(seen.bytes + (size_t)(page - 1) * journal->page_size, journal_bytes.bytes + at, journal->page_size);
    }
    return seen;
}

static void compare_recoveries(Bytes archive, Bytes bytes, int number) {
    Journal journal = {0};
    write_bytes("mutant.petri", archive);
    write_bytes("mutant.petri-journal", bytes);
    int file = open("mutant.petri-journal", O_RDONLY);
    const char *problem = archive_journal_read(&journal, file);
    close(file);
    PetriArchive *opened = petri_archive_open("mutant.petri", 0); // must not crash
    petri_archive_check(opened);
    petri_archive_close(&opened);
    assert_unchanged("mutant.petri", archive);
    assert_unchanged("mutant.petri-journal", bytes);
    bool comparable = !problem && journal.page_count < MAX_PAGES;
    Bytes recovered = comparable ? recover("mutant.petri") : (Bytes){0};
    if (comparable) {
        Bytes seen = overlay(archive, &journal, bytes);
        if (seen.size != recovered.size || memcmp(seen.bytes, recovered.bytes, seen.size) != 0)
            fail_msg(
                "mutation %d: %zu bytes, with SQLite %zu bytes; journal of %zu bytes: %u records, %u pages, sector %u",
                number, seen.size, recovered.size, bytes.size, get(bytes.bytes + 8), get(bytes.bytes + 16),
                get(bytes.bytes + 20));
        free(seen.bytes);
    }
    free(recovered.bytes);
    archive_journal_free(&journal);
}

// SQLite recovers a copy of the archive from each damaged journal. Readers must see the same pages without writing
// them.
static void test_damaged_journals_are_applied_as_by_sqlite(void **state) {
    (void)state;
    const char *const caches[] = {"PRAGMA cache_size = 2", "PRAGMA cache_size = 1000"};
    for (size_t i = 0; i < 2; i++) {
        make_killed(caches[i]);
        Bytes archive = read_bytes("killed.petri"), journal = read_bytes("killed.petri-journal");
        Bytes changed = {malloc(journal.size), 0};
        for (int number = 0; number < MUTATIONS; number++) {
            changed.size = journal.size;
            memcpy(changed.bytes, journal.bytes, journal.size);
            for (uint32_t count = 1 + below(3); count > 0 && changed.size == journal.size; count--)
                mutate(&changed, journal.bytes);
            compare_recoveries(archive, changed, number);
        }
        free(changed.bytes);
        free(journal.bytes);
        free(archive.bytes);
    }
}

static void test_other_journals_are_refused(void **state) {
    (void)state;
    make_killed("PRAGMA cache_size = 1000");
    Bytes journal = read_bytes("killed.petri-journal");
    write_file("victim", "important\n");
    // A transaction of several databases ends with the name of a file, which SQLite deletes.
    FILE *stream = fopen("killed.petri-journal", "ab");
    unsigned char numbers[12];
    put(numbers, 0x40000000 / 4096 + 1);
    put(numbers + 4, 6);
    put(numbers + 8, 'v' + 'i' + 'c' + 't' + 'i' + 'm');
    fwrite(numbers, 1, 4, stream);
    fwrite("victim", 1, 6, stream);
    fwrite(numbers + 4, 1, 8, stream);
    fwrite(archive_journal_magic, 1, ARCHIVE_JOURNAL_MAGIC_BYTES, stream);
    fclose(stream);
    PetriArchive *archive = petri_archive_open("killed.petri", 0);
    assert_non_null(strstr(petri_archive_problem(archive), "names another journal"));
    petri_archive_close(&archive);
    assert_int_equal(access("victim", F_OK), 0);
    free(journal.bytes);
    // A write-ahead log
    copy_file("run.petri", "wal.petri");
    int file = open("wal.petri", O_WRONLY);
    assert_int_equal(pwrite(file, "\2\2", 2, 18), 2);
    close(file);
    archive = petri_archive_open("wal.petri", 0);
    assert_non_null(strstr(petri_archive_problem(archive), "write-ahead log"));
    petri_archive_close(&archive);
    assert_int_not_equal(access("wal.petri-wal", F_OK), 0);
    assert_int_not_equal(access("wal.petri-shm", F_OK), 0);
}

TEST_GROUP(recording_journal) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_killed_recording_is_whole),
        cmocka_unit_test(test_damaged_journals_are_applied_as_by_sqlite),
        cmocka_unit_test(test_other_journals_are_refused),
    };
    return cmocka_run_group_tests(tests, record, leave_folder);
}
