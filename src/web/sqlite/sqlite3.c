// sqlite3.c: see sqlite3.h.
#include "sqlite3.h"

#include "recording/archive.h"
#include "web/host.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 8 };

struct sqlite3_stmt {
    int number; // of the statement in JavaScript
    char *sql;
    char name[24];                     // result of sqlite3_column_name
    unsigned char *bytes[MAX_COLUMNS]; // texts and blobs of the current row that were read; NULL: not read yet
    size_t lengths[MAX_COLUMNS];
};

// --- the database, of which JavaScript has one

int sqlite3_open_v2(const char *file, sqlite3 **database, int flags, const char *vfs) {
    (void)file;
    (void)flags;
    (void)vfs;
    *database = NULL;
    return SQLITE_OK;
}

int sqlite3_close_v2(sqlite3 *database) {
    (void)database;
    return SQLITE_OK;
}

int sqlite3_extended_result_codes(sqlite3 *database, int on) {
    (void)database;
    (void)on;
    return SQLITE_OK;
}

int sqlite3_db_config(sqlite3 *database, int option, ...) {
    (void)database;
    (void)option;
    return SQLITE_OK;
}

int sqlite3_limit(sqlite3 *database, int limit, int value) {
    (void)database;
    (void)limit;
    (void)value;
    return 0;
}

const char *sqlite3_errstr(int result) {
    return result == SQLITE_NOMEM ? "out of memory" : "database disk image is malformed";
}

// --- statements

int sqlite3_prepare_v2(sqlite3 *database, const char *sql, int length, sqlite3_stmt **statement, const char **rest) {
    return sqlite3_prepare_v3(database, sql, length, 0, statement, rest);
}

int sqlite3_prepare_v3(sqlite3 *database, const char *sql, int length, unsigned flags, sqlite3_stmt **statement,
                       const char **rest) {
    (void)database;
    (void)length;
    (void)flags;
    (void)rest;
    *statement = calloc(1, sizeof **statement);
    if (!*statement)
        return SQLITE_NOMEM;
    (*statement)->sql = strdup(sql);
    (*statement)->number = host_sql_prepare(sql);
    if ((*statement)->sql && (*statement)->number > 0)
        return SQLITE_OK;
    sqlite3_finalize(*statement);
    *statement = NULL;
    return SQLITE_CORRUPT;
}

static void free_row(sqlite3_stmt *statement) {
    for (int i = 0; i < MAX_COLUMNS; i++) {
        free(statement->bytes[i]);
        statement->bytes[i] = NULL;
    }
}

int sqlite3_finalize(sqlite3_stmt *statement) {
    if (!statement)
        return SQLITE_OK;
    free_row(statement);
    if (statement->number > 0)
        host_sql_finalize(statement->number);
    free(statement->sql);
    free(statement);
    return SQLITE_OK;
}

int sqlite3_step(sqlite3_stmt *statement) {
    free_row(statement);
    return host_sql_step(statement->number);
}

int sqlite3_reset(sqlite3_stmt *statement) {
    free_row(statement);
    host_sql_reset(statement->number);
    return SQLITE_OK;
}

int sqlite3_clear_bindings(sqlite3_stmt *statement) {
    (void)statement; // host_sql_reset also clears them
    return SQLITE_OK;
}

const char *sqlite3_sql(sqlite3_stmt *statement) {
    return statement->sql;
}

int sqlite3_bind_int64(sqlite3_stmt *statement, int parameter, int64_t value) {
    host_sql_bind(statement->number, parameter, (double)value);
    return SQLITE_OK;
}

// --- columns

int sqlite3_column_type(sqlite3_stmt *statement, int column) {
    return host_sql_type(statement->number, column);
}

int sqlite3_column_int(sqlite3_stmt *statement, int column) {
    return (int)sqlite3_column_int64(statement, column);
}

int64_t sqlite3_column_int64(sqlite3_stmt *statement, int column) {
    int64_t value = 0;
    host_sql_integer(statement->number, column, &value);
    return value;
}

static unsigned char *read_bytes(sqlite3_stmt *statement, int column) {
    if (column < 0 || column >= MAX_COLUMNS)
        return NULL;
    if (!statement->bytes[column])
        statement->bytes[column] = host_sql_bytes(statement->number, column, &statement->lengths[column]);
    return statement->bytes[column];
}

int sqlite3_column_bytes(sqlite3_stmt *statement, int column) {
    return read_bytes(statement, column) ? (int)statement->lengths[column] : 0;
}

const unsigned char *sqlite3_column_text(sqlite3_stmt *statement, int column) {
    return read_bytes(statement, column);
}

const void *sqlite3_column_blob(sqlite3_stmt *statement, int column) {
    return read_bytes(statement, column);
}

const char *sqlite3_column_name(sqlite3_stmt *statement, int column) {
    snprintf(statement->name, sizeof statement->name, "column %d", column + 1);
    return statement->name;
}

// --- functions that lib/recording defines in files that the engine does not need

bool petri_archive_is(const char *file) {
    (void)file;
    return true; // JavaScript checks the identification
}

PetriStatus petri_archive_complete(PetriArchive *archive) {
    (void)archive;
    return PETRI_OK; // the engine does not write archives
}

bool archive_connect(PetriArchive *archive, const char *name) {
    // The database is in memory, so JavaScript has limited its size.
    archive->content_limit = INT32_MAX;
    return sqlite3_open_v2(name, &archive->database, SQLITE_OPEN_READONLY, NULL) == SQLITE_OK;
}

void archive_free_pages(ArchivePages *pages) {
    (void)pages;
}
