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
    [SQL_PARAMETER] = "SELECT name, value FROM parameter ORDER BY name LIMIT 1 OFFSET ?1",
    [SQL_FILES] = "SELECT id, frame, name, sha256, length(bytes) FROM file ORDER BY id",
    [SQL_FILE_BYTES] = "SELECT bytes FROM file WHERE id = ?1",
    [SQL_FILES_BETWEEN] = "SELECT id, frame, name, sha256 FROM file WHERE frame > ?1 AND frame <= ?2 ORDER BY id",
    [SQL_INPUTS] = "SELECT kind, payload FROM input WHERE frame = ?1 ORDER BY id",
    [SQL_INPUTS_BETWEEN] = "SELECT frame, kind, payload FROM input WHERE frame > ?1 AND frame <= ?2 ORDER BY id",
    [SQL_NOTES_BETWEEN] = "SELECT frame, text FROM note WHERE frame > ?1 AND frame <= ?2 ORDER BY id",
    [SQL_DIGEST] = "SELECT digest FROM digest WHERE frame = ?1",
    [SQL_DIGESTS_BETWEEN] = "SELECT frame, digest FROM digest WHERE frame > ?1 AND frame <= ?2 ORDER BY frame",
    [SQL_KEYFRAMES] = "SELECT frame, given FROM keyframe ORDER BY frame",
    [SQL_KEYFRAME] = "SELECT setup, state, sha256 FROM keyframe WHERE frame = ?1",
    [SQL_LAST_KEYFRAME] = "SELECT frame, sha256 FROM keyframe WHERE frame < ?1 ORDER BY frame DESC LIMIT 1",
    [SQL_LAST_RECORDED] = ("SELECT max(coalesce((SELECT max(frame) FROM digest WHERE frame <= ?1), -1), "
                           "coalesce((SELECT max(frame) FROM input WHERE frame <= ?1 AND kind = 'clock'), -1))"),
    [SQL_COUNT_INPUTS] = "SELECT count(*), coalesce(max(frame), -1) FROM input WHERE kind = 'clock' OR ?1",
    [SQL_COUNT_DIGESTS] = "SELECT count(*), coalesce(max(frame), -1) FROM digest",
};

bool archive_fails(const PetriArchive *archive) {
    return archive->problem[0] != '\0';
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
    bool damaged = (result & 0xff) == SQLITE_CORRUPT || (result & 0xff) == SQLITE_NOTADB;
    const char *text = sqlite3_errstr(result);
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
    for (uint32_t i = 0; i < archive->file_count; i++) {
        heap_free(archive->files[i].name);
        heap_free(archive->files[i].bytes);
    }
    for (size_t i = 0; i < sizeof archive->strings / sizeof archive->strings[0]; i++)
        heap_free(archive->strings[i]);
    heap_free(archive->files);
    heap_free(archive->keyframes);
    pthread_mutex_destroy(&archive->mutex);
    heap_free(archive);
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

// Completes or undoes a transaction that was interrupted, for example because its process was killed.
static void roll_back(const char *file) {
    sqlite3 *database = NULL;
    if (sqlite3_open_v2(file, &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, NULL) == SQLITE_OK) {
        protect_connection(database);
        read_version(database);
    }
    sqlite3_close_v2(database);
}

static int connect_to(PetriArchive *archive, const char *file) {
    sqlite3_close_v2(archive->database);
    archive->database = NULL;
    int result = sqlite3_open_v2(file, &archive->database, SQLITE_OPEN_READONLY | SQLITE_OPEN_FULLMUTEX, NULL);
    if (result != SQLITE_OK)
        return -result;
    protect_connection(archive->database);
    return read_version(archive->database);
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
    int version = connect_to(archive, file);
    if (version < 0) {
        roll_back(file);
        version = connect_to(archive, file);
    }
    if (version < 0)
        return archive_fail_sqlite(archive, -version);
    sqlite3_limit(archive->database, SQLITE_LIMIT_LENGTH,
                  archive->memory_limit < 1000000000 ? (int)archive->memory_limit : 1000000000);
    if (version > ARCHIVE_FORMAT)
        return archive_fail(archive, "the archive was made by a newer version of petri: format %d", version);
    return check_schema(archive);
}

sqlite3_stmt *archive_statement(PetriArchive *archive, ArchiveStatement number) {
    sqlite3_stmt **statement = &archive->statements[number];
    if (archive_fails(archive))
        return NULL;
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

bool archive_next(PetriArchive *archive, sqlite3_stmt *statement) {
    int result = statement ? sqlite3_step(statement) : SQLITE_DONE;
    if (result != SQLITE_ROW && result != SQLITE_DONE)
        archive_fail_sqlite(archive, result);
    return result == SQLITE_ROW;
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

// Reports an invalid value, with the table that the query names.
static bool fail_column(PetriArchive *archive, sqlite3_stmt *row, int column) {
    const char *from = strstr(sqlite3_sql(row), "FROM "), *table = from ? from + strlen("FROM ") : "";
    return archive_fail(archive, "the archive is damaged: table %.*s: a value of %s is not valid",
                        (int)strcspn(table, " "), table, sqlite3_column_name(row, column));
}

bool archive_column_integer(PetriArchive *archive, sqlite3_stmt *row, int column, int64_t min, int64_t max,
                            int64_t *x) {
    *x = sqlite3_column_int64(row, column);
    bool good = sqlite3_column_type(row, column) == SQLITE_INTEGER && *x >= min && *x <= max;
    return good || fail_column(archive, row, column);
}

bool archive_column_text(PetriArchive *archive, sqlite3_stmt *row, int column, Str *text) {
    bool good = sqlite3_column_type(row, column) == SQLITE_TEXT;
    text->bytes = good ? (const char *)sqlite3_column_text(row, column) : NULL;
    text->len = text->bytes ? (size_t)sqlite3_column_bytes(row, column) : 0;
    return text->bytes || fail_column(archive, row, column);
}

bool archive_column_blob(PetriArchive *archive, sqlite3_stmt *row, int column, Str *bytes) {
    bool good = sqlite3_column_type(row, column) == SQLITE_BLOB;
    const void *blob = good ? sqlite3_column_blob(row, column) : NULL;
    bytes->bytes = blob ? blob : "";
    bytes->len = blob ? (size_t)sqlite3_column_bytes(row, column) : 0;
    return good || fail_column(archive, row, column);
}
