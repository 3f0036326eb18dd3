// fuzz_archive.c: fuzzes the reader of archives. The first byte of an input selects what it replaces in a small
// archive:
// '#' the whole file, 'x' single bytes of it (two bytes of position, then the byte), else a value in its tables: 's'
// the setup of a keyframe, 't' its state, 'f' the bytes of the script, 'n' the name of a file, 'l' a listed folder, or
// an input: 'c' configuration, 'p' pointer, 'k' key, 'a' state, 'g' global, 'z' clock.
#include "fuzz.h"
#include "petri-archive.h"
#include "petri-inspect.h"
#include "petri-live.h"

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char SCRIPT[] = "let N=N or 3\n"
                             "!window\n"
                             "    !pointer state=:mouse\n"
                             "    !key name='a' state=:key\n"
                             "!physics state=:p dimensions=2 time=time\n"
                             "    for i in ..N\n"
                             "        !particle id=i position=i;level or 1 radius=1\n"
                             "    !collision\n"
                             "!shown files=glob('*') mouse=$:mouse key=$:key\n"
                             "!counter state=:n rate=1+clock\n";

enum { FRAMES = 6 };

static unsigned char *base; // the bytes of the archive
static size_t base_size;

static void make_base(void) {
    PetriOptions options = fuzz_options();
    PetriArchiveOptions wanted = petri_archive_default_options();
    wanted.keyframe_every = 3;
    PetriSession *session = petri_open(&options);
    petri_set_global(session, "level", (PetriValue){0});
    PetriArchive *archive = petri_archive_create(session, fuzz_file("base"), &wanted);
    if (petri_load_text(session, "a.fl", SCRIPT, PETRI_NUL_TERMINATED) != PETRI_OK)
        fuzz_fail("cannot load the script");
    for (int i = 0; i < FRAMES; i++) {
        petri_report_key(session, "a", i % 2);
        petri_step(session);
    }
    petri_archive_close(&archive);
    petri_close(&session);
    FILE *file = fopen(fuzz_file("base"), "rb");
    fseek(file, 0, SEEK_END);
    base_size = (size_t)ftell(file);
    rewind(file);
    base = malloc(base_size);
    if (!base || fread(base, 1, base_size, file) != base_size)
        fuzz_fail("cannot read the archive");
    fclose(file);
}

// Executes a statement with the rest of the input as ?1.
static void change(const char *sql, const uint8_t *data, size_t size) {
    sqlite3 *database = NULL;
    sqlite3_stmt *statement = NULL;
    fuzz_put("archive", base, base_size);
    sqlite3_open(fuzz_file("archive"), &database);
    sqlite3_exec(database, "PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF", NULL, NULL, NULL);
    if (sqlite3_prepare_v2(database, sql, -1, &statement, NULL) != SQLITE_OK)
        fuzz_fail("%s", sqlite3_errmsg(database));
    sqlite3_bind_blob64(statement, 1, data, size, SQLITE_STATIC);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
    sqlite3_close(database);
}

static void change_bytes(const uint8_t *data, size_t size) {
    unsigned char *bytes = malloc(base_size);
    if (!bytes)
        return;
    memcpy(bytes, base, base_size);
    for (size_t i = 0; i + 2 < size; i += 3)
        bytes[((size_t)data[i] << 8 | data[i + 1]) * 7 % base_size] ^= data[i + 2];
    fuzz_put("archive", bytes, base_size);
    free(bytes);
}

static bool write_archive(uint8_t kind, const uint8_t *data, size_t size) {
    static const struct {
        char kind;
        const char *sql;
    } changes[] = {
        {'s', "UPDATE keyframe SET setup = CAST(?1 AS TEXT)"},
        {'t', "UPDATE keyframe SET state = CAST(?1 AS TEXT)"},
        {'f', "UPDATE file SET bytes = ?1 WHERE id = 1"},
        {'n', "UPDATE file SET name = CAST(?1 AS TEXT)"},
        {'l', "UPDATE file SET bytes = ?1 WHERE name = './'"},
        {'c', "INSERT INTO input (frame, kind, payload) VALUES (1, 'configuration', CAST(?1 AS TEXT))"},
        {'p', "INSERT INTO input (frame, kind, payload) VALUES (1, 'pointer', CAST(?1 AS TEXT))"},
        {'k', "INSERT INTO input (frame, kind, payload) VALUES (1, 'key', CAST(?1 AS TEXT))"},
        {'a', "INSERT INTO input (frame, kind, payload) VALUES (1, 'state', CAST(?1 AS TEXT))"},
        {'g', "INSERT INTO input (frame, kind, payload) VALUES (1, 'global', CAST(?1 AS TEXT))"},
        {'z', "INSERT INTO input (frame, kind, payload) VALUES (1, 'clock', CAST(?1 AS TEXT))"},
    };
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++)
        if (changes[i].kind == (char)kind) {
            change(changes[i].sql, data, size);
            return true;
        }
    if (kind == 'x')
        change_bytes(data, size);
    else if (kind == '#')
        fuzz_put("archive", data, size);
    return kind == 'x' || kind == '#';
}

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
    fuzz_check_state(session);
    fuzz_close(&session);
}

FUZZ_HARNESS(archive) {
    if (!base)
        make_base();
    if (size == 0 || !write_archive(data[0], data + 1, size - 1))
        return 0;
    PetriArchiveInfo info;
    PetriArchiveFile file;
    PetriArchiveKeyframe keyframe;
    const char *name, *value;
    PetriArchive *archive = petri_archive_open(fuzz_file("archive"), (size_t)8 << 20);
    petri_archive_info(archive, &info, sizeof info);
    for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file); i++)
        if (file.bytes && strlen(file.name) + file.length == 1)
            fuzz_sink(NULL, file.bytes, file.length);
    for (size_t i = 0; petri_archive_keyframe(archive, i, &keyframe, sizeof keyframe); i++)
        if (keyframe.end < keyframe.frame)
            fuzz_fail("a segment ends before it begins");
    for (size_t i = 0; petri_archive_parameter(archive, i, &name, &value); i++)
        fuzz_sink(NULL, value, strlen(value));
    replay(archive);
    petri_archive_close(&archive);
    archive = petri_archive_open(fuzz_file("archive"), (size_t)8 << 20);
    petri_archive_check(archive);
    petri_archive_close(&archive);
    return 0;
}
