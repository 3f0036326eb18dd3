// fuzz_database.c: fuzzes the reader of archives with databases that are damaged in their structure. The first byte of
// an input selects what it changes: 'b' the b-trees of a small archive, 'j' the journal of one whose recording was
// killed, 'r' the values of rows, whose digest of the run is then computed again. The rest are operations of OPERATION
// bytes. Reading must change no file and end soon.
#include "fuzz.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "recording/archive.h"
#include "recording/journal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { OPERATION = 7, FRAMES = 12, MEMORY = 8 << 20, HEADER = 100, SECTOR = 512 };

static const char SCRIPT[] = "let N=N or 3\n"
                             "!window\n"
                             "    !key name='a' state=:key\n"
                             "!physics state=:p dimensions=2 time=time\n"
                             "    for i in ..N\n"
                             "        !particle id=i position=i;1 radius=1\n"
                             "    !collision\n"
                             "!shown files=glob('*') key=$:key\n"
                             "!counter state=:n rate=1+clock\n";

typedef struct Bytes {
    unsigned char *bytes;
    size_t size;
} Bytes;

static Bytes base;    // an archive
static Bytes torn;    // the same in the middle of a transaction
static Bytes journal; // of that transaction

static Bytes read_file(const char *name) {
    Bytes read = {0};
    FILE *file = fopen(fuzz_file(name), "rb");
    if (!file)
        return read;
    fseek(file, 0, SEEK_END);
    read.size = (size_t)ftell(file);
    rewind(file);
    read.bytes = malloc(read.size + 1);
    if (!read.bytes || fread(read.bytes, 1, read.size, file) != read.size)
        fuzz_fail("cannot read '%s'", name);
    fclose(file);
    return read;
}

static Bytes copy_of(Bytes bytes) {
    Bytes copy = {malloc(bytes.size + 1), bytes.size};
    if (!copy.bytes)
        abort();
    memcpy(copy.bytes, bytes.bytes, bytes.size);
    return copy;
}

static void make_base(void) {
    PetriOptions options = fuzz_options();
    PetriArchiveOptions wanted = petri_archive_default_options();
    wanted.keyframe_every = 3;
    PetriSession *session = petri_open(&options);
    PetriArchive *archive = petri_archive_create(session, fuzz_file("base"), &wanted);
    if (petri_load_text(session, "a.fl", SCRIPT, PETRI_NUL_TERMINATED) != PETRI_OK)
        fuzz_fail("cannot load the script");
    for (int i = 0; i < FRAMES; i++) {
        petri_report_key(session, "a", i % 2);
        petri_archive_add_note(archive, "a note");
        petri_step(session);
    }
    petri_archive_close(&archive);
    petri_close(&session);
    base = read_file("base");
}

// Makes the archive of a recording that was killed. The small cache makes several segments.
static void make_torn(void) {
    sqlite3 *database = NULL;
    fuzz_put("work", base.bytes, base.size);
    sqlite3_open(fuzz_file("work"), &database);
    sqlite3_exec(database,
                 "PRAGMA cache_size = 3; BEGIN IMMEDIATE; DELETE FROM digest; UPDATE keyframe SET state = 'lost';"
                 "INSERT INTO note VALUES (NULL, 1, hex(zeroblob(20000)))",
                 NULL, NULL, NULL);
    sqlite3_db_cacheflush(database);
    torn = read_file("work");
    journal = read_file("work-journal");
    sqlite3_close(database);
    if (journal.size < SECTOR)
        fuzz_fail("the journal is missing");
}

static void put_number(unsigned char *at, uint32_t x) {
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(x >> (24 - 8 * i));
}

// Returns a number that is often at a limit.
static uint32_t number_of(uint8_t kind, uint32_t n, uint32_t other) {
    const uint32_t numbers[] = {0, 1, n - 1, n, n + 1, other % (n + 1), other, INT32_MAX, UINT32_MAX, 2};
    return numbers[kind % 10];
}

// --- b-trees

// Changes a page of 4096 bytes, in whose last cells are the rows of a table.
static void change_page(Bytes *file, const uint8_t *operation) {
    enum { PAGE = 4096 };
    uint32_t pages = (uint32_t)(file->size / PAGE), page = operation[1] % pages;
    unsigned char *at = file->bytes + (size_t)page * PAGE, *tree = page == 0 ? at + HEADER : at;
    uint32_t other = (uint32_t)operation[4] << 16 | (uint32_t)operation[5] << 8 | operation[6];
    uint32_t number = number_of(operation[3], pages, other), cell = 2 * (operation[2] % 64U);
    size_t header = tree[0] == 2 || tree[0] == 5 ? 12 : 8,
           content = (size_t)tree[header + cell] << 8 | tree[header + cell + 1];
    unsigned char *start = content + 16 < PAGE ? at + content : at;
    switch (operation[0] % 12) {
    case 0:
        tree[0] = (uint8_t[]){2, 5, 10, 13, 0, 255}[operation[2] % 6];
        break;
    case 1: // number of cells
        put_number(tree + 3, number_of(operation[3], tree[4], other) << 16);
        break;
    case 2: // start of the cells
        tree[5] = operation[2], tree[6] = operation[3];
        break;
    case 3: // last child
        put_number(tree + 8, number);
        break;
    case 4: // position of a cell
        tree[header + cell] = operation[5] % 16, tree[header + cell + 1] = operation[6];
        break;
    case 5: // child of a cell, or length of a row
        put_number(start, number);
        break;
    case 6: // length of a row
        start[0] = 0x80 | operation[3], start[1] = 0x80 | operation[4], start[2] = 0x80 | operation[5], start[3] = 0x7f;
        break;
    case 7: // a type of a column
        start[3 + operation[2] % 12] = operation[3];
        break;
    case 8:
        memmove(at, file->bytes + (size_t)(operation[2] % pages) * PAGE, PAGE);
        break;
    case 9: // first page of an overflow chain, or the next one
        put_number(operation[2] % 2 ? at : at + PAGE - 4 - operation[4], number);
        break;
    case 10: // a field of the header
        file->bytes[16 + operation[2] % 84] = operation[3];
        break;
    default:
        at[((size_t)operation[2] << 8 | operation[3]) % PAGE] ^= operation[4];
    }
}

// --- journals

static void seal_record(unsigned char *record, uint32_t nonce) {
    enum { PAGE = 4096 };
    for (int at = PAGE - 200; at > 0; at -= 200)
        nonce += record[4 + at];
    put_number(record + 4 + PAGE, nonce);
}

// Replaces the end of the journal by the name of another one, which SQLite would delete.
static void add_super_journal(Bytes *file) {
    const char *victim = fuzz_file("victim");
    uint32_t length = (uint32_t)strlen(victim), sum = 0;
    file->size -= length + 20;
    unsigned char *end = file->bytes + file->size;
    for (uint32_t i = 0; i < length; i++)
        sum += (unsigned char)victim[i];
    put_number(end, 0x40000000 / 4096 + 1);
    memcpy(end + 4, victim, length);
    put_number(end + 4 + length, length);
    put_number(end + 8 + length, sum);
    memcpy(end + 12 + length, archive_journal_magic, ARCHIVE_JOURNAL_MAGIC_BYTES);
    file->size += length + 20;
}

static void change_journal(Bytes *file, const uint8_t *operation) {
    enum { RECORD = 4 + 4096 + 4 };
    uint32_t records = (uint32_t)((journal.size - SECTOR) / RECORD), pages = (uint32_t)(base.size / 4096);
    uint32_t other = (uint32_t)operation[4] << 16 | (uint32_t)operation[5] << 8 | operation[6];
    unsigned char *record = file->bytes + SECTOR + (size_t)(operation[1] % records) * RECORD;
    uint32_t nonce = (uint32_t)journal.bytes[12] << 24 | (uint32_t)journal.bytes[13] << 16 |
                     (uint32_t)journal.bytes[14] << 8 | journal.bytes[15];
    if (file->size < journal.size)
        return; // it was truncated
    switch (operation[0] % 8) {
    case 0:
        put_number(file->bytes + 8 + 4 * (operation[2] % 5U), number_of(operation[3], pages, other));
        break;
    case 1:
        put_number(record, number_of(operation[3], pages, other));
        break;
    case 2:
        record[4 + other % 4096] ^= operation[3];
        break;
    case 3:
        record[4 + other % 4096] ^= operation[3];
        seal_record(record, nonce);
        break;
    case 4:
        file->size = other % file->size;
        break;
    case 5: // a page of the archive, damaged like those of the archive itself
        memcpy(record + 4, base.bytes + (size_t)(operation[2] % pages) * 4096, 4096);
        change_page(&(Bytes){record + 4, 4096}, (uint8_t[OPERATION]){operation[3], 0, operation[4], operation[5],
                                                                     operation[6], operation[2], operation[1]});
        seal_record(record, nonce);
        break;
    case 6:
        add_super_journal(file);
        break;
    default:
        file->bytes[other % file->size] ^= operation[3];
    }
}

// --- rows

static void change_row(sqlite3 *database, const uint8_t *operation) {
    static const struct {
        const char *table;
        const char *columns[5];
        int count;
    } tables[] = {
        {"meta", {"key", "value"}, 2},
        {"parameter", {"name", "value"}, 2},
        {"file", {"id", "frame", "name", "sha256", "bytes"}, 5},
        {"input", {"id", "frame", "kind", "payload"}, 4},
        {"digest", {"frame", "digest"}, 2},
        {"keyframe", {"frame", "given", "setup", "state", "sha256"}, 5},
        {"note", {"id", "frame", "text"}, 3},
    };
    static const char *const values[] = {
        "NULL",
        "-1",
        "0",
        "1",
        "1000000000000000",
        "9223372036854775807",
        "1.5",
        "''",
        "x''",
        "'clock'",
        "'configuration'",
        "'key'",
        "'../x'",
        "'1;2;3;0;0;1;5'",
        "'999999999999'",
        "hex(zeroblob(3000))",
        "zeroblob(300000)",
        "%1$s + 1",
        "%1$s || %1$s",
        "substr(%1$s, %2$d)",
        "substr(%1$s, 1, %2$d)",
        "replace(%1$s, substr(%1$s, %2$d, 1), '9')",
        "replace(%1$s, ' = ', ' = 1e9;')",
        "char(%2$d) || %1$s",
    };
    int table = operation[1] % 7;
    const char *column = tables[table].columns[operation[2] % tables[table].count];
    char value[200], sql[500];
    snprintf(value, sizeof value, values[operation[3] % (sizeof values / sizeof values[0])], column, operation[5]);
    if (operation[0] % 3 == 0)
        snprintf(sql, sizeof sql, "DELETE FROM %s WHERE %s = (SELECT %s FROM %s LIMIT 1 OFFSET %d)",
                 tables[table].table, tables[table].columns[0], tables[table].columns[0], tables[table].table,
                 operation[4] % 32);
    else
        snprintf(sql, sizeof sql, "UPDATE OR REPLACE %s SET %s = %s WHERE %s = (SELECT %s FROM %s LIMIT 1 OFFSET %d)",
                 tables[table].table, column, value, tables[table].columns[0], tables[table].columns[0],
                 tables[table].table, operation[4] % 32);
    sqlite3_exec(database, sql, NULL, NULL, NULL);
}

// Computes the digest of the run again, as far as the rows have valid types, so that replays reach them.
static void seal(PetriArchive *archive) {
    char sha256[SHA256_DIGITS + 1] = "", previous[SHA256_DIGITS + 1] = "";
    ArchiveSeal sealed = {.previous = -2};
    sqlite3_stmt *rows = NULL, *change = NULL;
    sqlite3_prepare_v2(archive->database, "SELECT frame, given, setup, state FROM keyframe ORDER BY frame", -1, &rows,
                       NULL);
    sqlite3_prepare_v2(archive->database, "UPDATE keyframe SET sha256 = ?1 WHERE frame = ?2", -1, &change, NULL);
    while (sqlite3_step(rows) == SQLITE_ROW) {
        sealed.frame = sqlite3_column_int64(rows, 0);
        sealed.given = sqlite3_column_int(rows, 1);
        sealed.setup = (Str){(const char *)sqlite3_column_text(rows, 2), (size_t)sqlite3_column_bytes(rows, 2)};
        sealed.state = (Str){(const char *)sqlite3_column_text(rows, 3), (size_t)sqlite3_column_bytes(rows, 3)};
        if (!sealed.setup.bytes || !sealed.state.bytes || !archive_seal(archive, &sealed, sha256))
            break;
        sqlite3_bind_text(change, 1, sha256, SHA256_DIGITS, SQLITE_STATIC);
        sqlite3_bind_int64(change, 2, sealed.frame);
        sqlite3_step(change);
        sqlite3_reset(change);
        memcpy(previous, sha256, sizeof previous);
        sealed.previous = sealed.frame;
        sealed.previous_sha256 = previous;
    }
    sqlite3_finalize(rows);
    sqlite3_finalize(change);
}

static void change_rows(const uint8_t *data, size_t size) {
    PetriArchive *archive = archive_new();
    fuzz_put("archive", base.bytes, base.size);
    archive->writes = true;
    sqlite3_open(fuzz_file("archive"), &archive->database);
    sqlite3_exec(archive->database, "PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF", NULL, NULL, NULL);
    for (size_t at = 0; at + OPERATION <= size; at += OPERATION)
        change_row(archive->database, data + at);
    seal(archive);
    archive_free(archive);
}

// --- reading

static void replay(PetriArchive *archive) {
    uint8_t digest[16];
    PetriOptions options = fuzz_options();
    options.read_file = petri_archive_read;
    options.read_user_data = archive;
    PetriSession *session = fuzz_open(&options);
    PetriStatus status = petri_archive_replay(archive, session, -1);
    for (int i = 0; i < FRAMES + 2 && status == PETRI_OK; i++) {
        status = petri_step(session);
        petri_archive_keyframe_differs(archive);
        petri_archive_digest(archive, i, digest);
    }
    fuzz_close(&session);
}

static void read_all(void) {
    PetriArchiveInfo info;
    PetriArchiveFile file;
    PetriArchiveKeyframe keyframe;
    const char *name, *value;
    size_t count = 0;
    PetriArchive *archive = petri_archive_open(fuzz_file("archive"), MEMORY);
    petri_archive_info(archive, &info, sizeof info);
    while (petri_archive_file(archive, count, &file, sizeof file))
        count++;
    for (size_t i = 0; petri_archive_keyframe(archive, i, &keyframe, sizeof keyframe); i++)
        if (keyframe.end < keyframe.frame)
            fuzz_fail("a segment ends before it begins");
    for (size_t i = 0; petri_archive_parameter(archive, i, &name, &value); i++)
        count += strlen(name) + strlen(value);
    if (count > MEMORY)
        fuzz_fail("the archive has too many texts");
    replay(archive);
    petri_archive_close(&archive);
    archive = petri_archive_open(fuzz_file("archive"), MEMORY);
    petri_archive_check(archive);
    petri_archive_close(&archive);
}

static void check_unchanged(const char *name, Bytes before) {
    Bytes after = read_file(name);
    if (after.size != before.size || memcmp(after.bytes, before.bytes, before.size) != 0)
        fuzz_fail("'%s' was changed", name);
    free(after.bytes);
}

static void read_pair(Bytes archive, Bytes beside) {
    fuzz_put("archive", archive.bytes, archive.size);
    fuzz_put("archive-journal", beside.bytes, beside.size);
    fuzz_put("victim", "text", 4);
    read_all();
    check_unchanged("archive", archive);
    check_unchanged("archive-journal", beside);
    check_unchanged("victim", (Bytes){(unsigned char *)"text", 4});
    unlink(fuzz_file("archive-journal"));
}

FUZZ_HARNESS(database) {
    if (!base.bytes) {
        make_base();
        make_torn();
    }
    if (size < 1 + OPERATION)
        return 0;
    Bytes changed = copy_of(data[0] == 'j' ? journal : base);
    for (size_t at = 1; data[0] != 'r' && at + OPERATION <= size; at += OPERATION)
        (data[0] == 'j' ? change_journal : change_page)(&changed, data + at);
    if (data[0] == 'j') {
        read_pair(torn, changed);
    } else if (data[0] == 'r') {
        change_rows(data + 1, size - 1);
        read_all();
    } else if (data[0] == 'b') {
        fuzz_put("archive", changed.bytes, changed.size);
        read_all();
        check_unchanged("archive", changed);
    }
    free(changed.bytes);
    return 0;
}
