// database.c: the SQLite database of an archive: its schema, statements and rows.
#include "base/heap.h"
#include "recording/archive.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// Name and text of each table and index, as SQLite stores them. An archive with any other schema is rejected, so that
// it has no views and triggers.
static const struct {
    const char *name;
    const char *sql;
} schema[] = {
    {"meta", "CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID"},
    {"parameter", "CREATE TABLE parameter (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID"},
    {"file", "CREATE TABLE file (id INTEGER PRIMARY KEY, frame INTEGER NOT NULL, name TEXT NOT NULL, "
             "sha256 TEXT NOT NULL, bytes BLOB)"},
    {"input", "CREATE TABLE input (id INTEGER PRIMARY KEY, frame INTEGER NOT NULL, kind TEXT NOT NULL, "
              "payload TEXT NOT NULL)"},
    {"input_frame", "CREATE INDEX input_frame ON input (frame)"},
    {"digest", "CREATE TABLE digest (frame INTEGER PRIMARY KEY, digest BLOB NOT NULL)"},
    {"keyframe", "CREATE TABLE keyframe (frame INTEGER PRIMARY KEY, given INTEGER NOT NULL, setup TEXT NOT NULL, "
                 "state TEXT NOT NULL, sha256 TEXT NOT NULL)"},
    {"note", "CREATE TABLE note (id INTEGER PRIMARY KEY, frame INTEGER NOT NULL, text TEXT NOT NULL)"},
};
enum { SCHEMA_COUNT = sizeof schema / sizeof schema[0] };

static const char *const statements[SQL_COUNT] = {
    [SQL_ADD_META] = "INSERT OR REPLACE INTO meta VALUES (?1, ?2)",
    [SQL_ADD_PARAMETER] = "INSERT OR REPLACE INTO parameter VALUES (?1, ?2)",
    [SQL_ADD_FILE] = "INSERT INTO file (frame, name, sha256, bytes) VALUES (?1, ?2, ?3, ?4)",
    [SQL_ADD_INPUT] = "INSERT INTO input (frame, kind, payload) VALUES (?1, ?2, ?3)",
    [SQL_ADD_DIGEST] = "INSERT OR REPLACE INTO digest VALUES (?1, ?2)",
    [SQL_ADD_KEYFRAME] = "INSERT OR REPLACE INTO keyframe VALUES (?1, ?2, ?3, ?4, ?5)",
    [SQL_ADD_NOTE] = "INSERT INTO note (frame, text) VALUES (?1, ?2)",
    [SQL_META] = "SELECT key, value FROM meta ORDER BY key",
    [SQL_PARAMETERS] = "SELECT name, value FROM parameter ORDER BY name",
    [SQL_PARAMETER] = "SELECT name, value FROM parameter ORDER BY name",
    [SQL_FILES] = "SELECT id, frame, name, sha256, length(bytes) FROM file ORDER BY id",
    [SQL_FILE_BYTES] = "SELECT bytes FROM file WHERE id = ?1",
    [SQL_FILE_IDS] = "SELECT id FROM file WHERE frame > ?1 AND frame <= ?2 ORDER BY id",
    [SQL_INPUT_IDS] = "SELECT id FROM input WHERE frame > ?1 AND frame <= ?2 ORDER BY id",
    [SQL_NOTE_IDS] = "SELECT id FROM note WHERE frame > ?1 AND frame <= ?2 ORDER BY id",
    [SQL_FILE_FRAMES] = "SELECT id, frame FROM file ORDER BY id",
    [SQL_INPUT_FRAMES] = "SELECT id, frame, kind = 'clock' FROM input ORDER BY id",
    [SQL_NOTE_FRAMES] = "SELECT id, frame FROM note ORDER BY id",
    [SQL_FILE] = "SELECT frame, name, sha256 FROM file WHERE id = ?1",
    [SQL_INPUT] = "SELECT frame, kind, payload FROM input WHERE id = ?1",
    [SQL_NOTE] = "SELECT frame, text FROM note WHERE id = ?1",
    [SQL_INPUTS] = "SELECT kind, payload, id FROM input WHERE frame = ?1 ORDER BY id",
    [SQL_DIGEST] = "SELECT digest FROM digest WHERE frame = ?1",
    [SQL_DIGEST_FRAMES] = "SELECT frame FROM digest ORDER BY frame",
    [SQL_DIGESTS_BETWEEN] = "SELECT frame, digest FROM digest WHERE frame > ?1 AND frame <= ?2 ORDER BY frame",
    [SQL_KEYFRAMES] = "SELECT frame, given FROM keyframe ORDER BY frame",
    [SQL_KEYFRAME_SETUP] = "SELECT setup, sha256 FROM keyframe WHERE frame = ?1",
    [SQL_KEYFRAME_STATE] = "SELECT state FROM keyframe WHERE frame = ?1",
    [SQL_LAST_KEYFRAME] = "SELECT frame, sha256 FROM keyframe WHERE frame < ?1 ORDER BY frame DESC LIMIT 1",
};

// Statements that read long values. The others read names and texts for information.
static bool is_long(ArchiveStatement number) {
    return number == SQL_FILE_BYTES || number == SQL_INPUT || number == SQL_INPUTS || number == SQL_NOTE ||
           number == SQL_KEYFRAME_SETUP || number == SQL_KEYFRAME_STATE;
}

bool archive_fails(const PetriArchive *archive) {
    return archive->problem[0] != '\0' || archive->interrupted;
}

bool archive_fail(PetriArchive *archive, const char *format, ...) {
    if (archive_fails(archive))
        return false;
    va_list list;
    va_start(list, format);
    vsnprintf(archive->problem, sizeof archive->problem, format, list);
    va_end(list);
    return false;
}

bool archive_fail_sqlite(PetriArchive *archive, int result) {
    int code = result & 0xff;
    bool damaged = code == SQLITE_CORRUPT || code == SQLITE_NOTADB;
    const char *text = sqlite3_errstr(result);
    if (code == SQLITE_INTERRUPT)
        return archive_fail(archive, "the archive is damaged: reading it takes more work than its size allows");
    if (code == SQLITE_TOOBIG && !archive->writes)
        return archive_fail(archive, "a value exceeds the size of the archive, or the memory limit");
    if (code == SQLITE_BUSY && !archive->writes)
        return archive_fail(archive, "the archive is being recorded; read it when the recording has ended");
    return archive_fail(archive, damaged ? "the archive is damaged: %s" : "%s", text);
}

PetriArchive *archive_new(void) {
    PetriArchive *archive = heap_calloc(1, sizeof *archive);
    if (!archive)
        return NULL;
    pthread_mutex_init(&archive->mutex, NULL);
    archive->claim = -1;
    return archive;
}

void archive_close_database(PetriArchive *archive) {
    for (int i = 0; i < SQL_COUNT; i++) {
        sqlite3_finalize(archive->statements[i]);
        archive->statements[i] = NULL;
    }
    sqlite3_close_v2(archive->database);
    archive->database = NULL;
    if (archive->claim >= 0)
        close(archive->claim);
    archive->claim = -1;
}

void archive_free(PetriArchive *archive) {
    archive_close_database(archive);
    archive_free_pages(archive->pages);
    for (uint32_t i = 0; i < archive->file_count; i++) {
        heap_free(archive->files[i].name);
        heap_free(archive->files[i].bytes);
    }
    for (size_t i = 0; i < sizeof archive->strings / sizeof archive->strings[0]; i++)
        heap_free(archive->strings[i]);
    heap_free(archive->files);
    heap_free(archive->names);
    heap_free(archive->keyframes);
    pthread_mutex_destroy(&archive->mutex);
    heap_free(archive);
}

void archive_begin(PetriArchive *archive) {
    const uint64_t min = UINT64_C(1) << 28, per_byte = 8;
    archive->work = 0;
    archive->work_limit = min + per_byte * archive->content_limit;
    archive->interrupted = false;
}

bool archive_charge(PetriArchive *archive, uint64_t units) {
    if (archive->writes)
        return true;
    archive->work += units;
    if (archive->session && recorder_is_interrupted(archive->session))
        archive->interrupted = true;
    return !archive->interrupted && archive->work <= archive->work_limit;
}

bool archive_reserve(PetriArchive *archive, uint64_t bytes) {
    if (!archive->writes && bytes > archive->memory_limit - archive->memory)
        return archive_fail(archive, "the archive exceeds the memory limit of %zu MiB", archive->memory_limit >> 20);
    archive->memory += (size_t)bytes;
    return true;
}

bool archive_execute(PetriArchive *archive, const char *sql) {
    int result = sqlite3_exec(archive->database, sql, NULL, NULL, NULL);
    return result == SQLITE_OK || archive_fail_sqlite(archive, result);
}

// Makes the connection safe for a database from a stranger.
static void protect_connection(sqlite3 *database) {
    sqlite3_extended_result_codes(database, 1);
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
    sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, NULL);
    sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, NULL);
    sqlite3_limit(database, SQLITE_LIMIT_ATTACHED, 0);
    sqlite3_limit(database, SQLITE_LIMIT_SQL_LENGTH, 10000);
    sqlite3_limit(database, SQLITE_LIMIT_COLUMN, 16);
    sqlite3_limit(database, SQLITE_LIMIT_EXPR_DEPTH, 16);
}

bool archive_create_database(PetriArchive *archive, const char *file) {
    char path[PATH_MAX]; // with a folder, so that SQLite does not take a name such as 'file:x' for a URI
    snprintf(path, sizeof path, "%s%s", file[0] == '/' ? "" : "./", file);
    int result = sqlite3_open_v2(path, &archive->database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, NULL);
    if (result != SQLITE_OK)
        return archive_fail_sqlite(archive, result);
    protect_connection(archive->database);
    char identity[100];
    snprintf(identity, sizeof identity, "PRAGMA application_id = %d; PRAGMA user_version = %d", ARCHIVE_APPLICATION_ID,
             ARCHIVE_FORMAT);
    // In one transaction, so that a process that is killed leaves no archive without tables.
    bool good = archive_execute(archive, "BEGIN IMMEDIATE") && archive_execute(archive, identity);
    for (int i = 0; i < SCHEMA_COUNT && good; i++)
        good = archive_execute(archive, schema[i].sql);
    return good && archive_execute(archive, "COMMIT; BEGIN IMMEDIATE");
}

// Returns the value of `PRAGMA user_version`, or a result of SQLite as a negative number.
static int read_version(sqlite3 *database) {
    sqlite3_stmt *statement = NULL;
    int result = sqlite3_prepare_v2(database, "PRAGMA user_version", -1, &statement, NULL);
    if (result == SQLITE_OK)
        result = sqlite3_step(statement);
    int version = result == SQLITE_ROW ? sqlite3_column_int(statement, 0) : -result;
    sqlite3_finalize(statement);
    return version;
}

// Checks that the database has exactly the tables of an archive.
static bool check_schema(PetriArchive *archive) {
    sqlite3_stmt *statement = NULL;
    int found = 0,
        result = sqlite3_prepare_v2(archive->database, "SELECT name, sql FROM sqlite_schema", -1, &statement, NULL);
    if (result != SQLITE_OK)
        return archive_fail_sqlite(archive, result);
    while ((result = sqlite3_step(statement)) == SQLITE_ROW) {
        const char *name = (const char *)sqlite3_column_text(statement, 0);
        const char *sql = (const char *)sqlite3_column_text(statement, 1);
        bool known = false;
        for (int i = 0; name && sql && i < SCHEMA_COUNT; i++)
            known = known || (strcmp(name, schema[i].name) == 0 && strcmp(sql, schema[i].sql) == 0);
        found = known ? found + 1 : SCHEMA_COUNT + 1;
    }
    sqlite3_finalize(statement);
    if (result != SQLITE_DONE)
        return archive_fail_sqlite(archive, result);
    // The transaction that creates the tables was undone.
    if (found == 0)
        return archive_fail(archive, "it has no frames");
    return found == SCHEMA_COUNT ||
           archive_fail(archive, "the archive is damaged: its tables are not those of an archive");
}

bool archive_open_database(PetriArchive *archive, const char *file) {
    archive_begin(archive);
    if (!archive_connect(archive, file))
        return false;
    archive_begin(archive); // now the size is known
    protect_connection(archive->database);
    sqlite3_limit(archive->database, SQLITE_LIMIT_LENGTH, ARCHIVE_MAX_TEXT);
    int version = read_version(archive->database);
    if (version < 0)
        return archive_fail_sqlite(archive, -version);
    if (version > ARCHIVE_FORMAT)
        return archive_fail(archive, "the archive was made by a newer version of petri: format %d", version);
    archive->has_schema = check_schema(archive);
    return archive->has_schema;
}

// Sets the maximum length of a value, so that SQLite does not allocate more than the archive can contain.
static void limit_values(PetriArchive *archive, ArchiveStatement number) {
    uint64_t max = 1000000000;
    size_t left = archive->memory_limit - archive->memory;
    max = max < archive->content_limit ? max : archive->content_limit;
    max = max < left ? max : left;
    max = is_long(number) || max < ARCHIVE_MAX_TEXT ? max : ARCHIVE_MAX_TEXT;
    sqlite3_limit(archive->database, SQLITE_LIMIT_LENGTH, (int)max);
}

sqlite3_stmt *archive_statement(PetriArchive *archive, ArchiveStatement number) {
    sqlite3_stmt **statement = &archive->statements[number];
    if (archive_fails(archive))
        return NULL;
    if (!archive->writes)
        limit_values(archive, number);
    if (!*statement) {
        int result =
            sqlite3_prepare_v3(archive->database, statements[number], -1, SQLITE_PREPARE_PERSISTENT, statement, NULL);
        if (result != SQLITE_OK)
            archive_fail_sqlite(archive, result);
        return *statement;
    }
    sqlite3_reset(*statement);
    sqlite3_clear_bindings(*statement);
    return *statement;
}

// Reports an invalid value, with the table that the query names.
static bool fail_column(PetriArchive *archive, sqlite3_stmt *row, int column) {
    const char *from = strstr(sqlite3_sql(row), "FROM "), *table = from ? from + strlen("FROM ") : "";
    return archive_fail(archive, "the archive is damaged: table %.*s: a value of %s is not valid",
                        (int)strcspn(table, " "), table, sqlite3_column_name(row, column));
}

bool archive_next(PetriArchive *archive, sqlite3_stmt *statement) {
    const uint64_t units = 50;
    int result = !statement ? SQLITE_DONE : archive_charge(archive, units) ? sqlite3_step(statement) : SQLITE_INTERRUPT;
    if (result != SQLITE_ROW && result != SQLITE_DONE)
        archive_fail_sqlite(archive, result);
    return result == SQLITE_ROW;
}

bool archive_next_in_order(PetriArchive *archive, sqlite3_stmt *statement, int column, int64_t max, int64_t *key) {
    int64_t before = *key;
    if (!archive_next(archive, statement) || !archive_column_integer(archive, statement, column, -1, max, key))
        return false;
    return *key > before || fail_column(archive, statement, column);
}

bool archive_run(PetriArchive *archive, sqlite3_stmt *statement) {
    int result = statement ? sqlite3_step(statement) : SQLITE_DONE;
    if (statement)
        sqlite3_reset(statement);
    return !archive_fails(archive) && (result == SQLITE_DONE || archive_fail_sqlite(archive, result));
}

bool archive_bind_text(sqlite3_stmt *statement, int column, Str text) {
    return statement && sqlite3_bind_text64(statement, column, text.bytes ? text.bytes : "", text.len, SQLITE_STATIC,
                                            SQLITE_UTF8) == SQLITE_OK;
}

bool archive_column_integer(PetriArchive *archive, sqlite3_stmt *row, int column, int64_t min, int64_t max,
                            int64_t *x) {
    *x = sqlite3_column_int64(row, column);
    bool good = sqlite3_column_type(row, column) == SQLITE_INTEGER && *x >= min && *x <= max;
    return good || fail_column(archive, row, column);
}

// Charges the work of copying a value and of its SHA-256.
static bool charge_value(PetriArchive *archive, size_t length) {
    return archive_charge(archive, length / 4) || archive_fail_sqlite(archive, SQLITE_INTERRUPT);
}

bool archive_column_text(PetriArchive *archive, sqlite3_stmt *row, int column, Str *text) {
    bool good = sqlite3_column_type(row, column) == SQLITE_TEXT;
    text->bytes = good ? (const char *)sqlite3_column_text(row, column) : NULL;
    text->len = text->bytes ? (size_t)sqlite3_column_bytes(row, column) : 0;
    if (good && !text->bytes)
        return archive_fail(archive, "out of memory");
    return good ? charge_value(archive, text->len) : fail_column(archive, row, column);
}

bool archive_column_blob(PetriArchive *archive, sqlite3_stmt *row, int column, Str *bytes) {
    bool good = sqlite3_column_type(row, column) == SQLITE_BLOB;
    const void *blob = good ? sqlite3_column_blob(row, column) : NULL;
    bytes->bytes = blob ? blob : "";
    bytes->len = blob ? (size_t)sqlite3_column_bytes(row, column) : 0;
    return good ? charge_value(archive, bytes->len) : fail_column(archive, row, column);
}
