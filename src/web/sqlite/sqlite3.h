// sqlite3.h: the functions of SQLite that lib/recording calls to read archives, for the WebAssembly engine.
//
// The engine does not contain SQLite, which would double its size. JavaScript opens the database with sql.js, and
// sqlite3.c passes statements and values to it (host.h). https://sqlite.org/c3ref/funclist.html describes the
// functions.
#pragma once

#include <stdint.h>

typedef struct sqlite3 sqlite3;
typedef struct sqlite3_stmt sqlite3_stmt;

enum {
    SQLITE_OK = 0,
    SQLITE_BUSY = 5,
    SQLITE_NOMEM = 7,
    SQLITE_INTERRUPT = 9,
    SQLITE_CORRUPT = 11,
    SQLITE_TOOBIG = 18,
    SQLITE_NOTADB = 26,
    SQLITE_ROW = 100,
    SQLITE_DONE = 101,
};
enum { SQLITE_INTEGER = 1, SQLITE_FLOAT, SQLITE_TEXT, SQLITE_BLOB, SQLITE_NULL };
enum { SQLITE_UTF8 = 1, SQLITE_PREPARE_PERSISTENT = 1 };
#define SQLITE_STATIC NULL

// Names of options, which have no effect here: sql.js works on a copy of the database, in memory.
enum {
    SQLITE_OPEN_READONLY = 1,
    SQLITE_OPEN_READWRITE = 2,
    SQLITE_OPEN_CREATE = 4,
    SQLITE_OPEN_NOMUTEX = 0x8000,
    SQLITE_OPEN_FULLMUTEX = 0x10000,
};
enum {
    SQLITE_DBCONFIG_DEFENSIVE,
    SQLITE_DBCONFIG_TRUSTED_SCHEMA,
    SQLITE_DBCONFIG_ENABLE_TRIGGER,
    SQLITE_DBCONFIG_ENABLE_VIEW,
};
enum {
    SQLITE_LIMIT_ATTACHED,
    SQLITE_LIMIT_SQL_LENGTH,
    SQLITE_LIMIT_COLUMN,
    SQLITE_LIMIT_EXPR_DEPTH,
    SQLITE_LIMIT_LENGTH,
};

int sqlite3_open_v2(const char *file, sqlite3 **database, int flags, const char *vfs);
int sqlite3_close_v2(sqlite3 *database);
int sqlite3_extended_result_codes(sqlite3 *database, int on);
int sqlite3_db_config(sqlite3 *database, int option, ...);
int sqlite3_limit(sqlite3 *database, int limit, int value);
int sqlite3_exec(sqlite3 *database, const char *sql, int (*row)(void *, int, char **, char **), void *context,
                 char **problem);
const char *sqlite3_errstr(int result);

int sqlite3_prepare_v2(sqlite3 *database, const char *sql, int length, sqlite3_stmt **statement, const char **rest);
int sqlite3_prepare_v3(sqlite3 *database, const char *sql, int length, unsigned flags, sqlite3_stmt **statement,
                       const char **rest);
int sqlite3_finalize(sqlite3_stmt *statement);
int sqlite3_step(sqlite3_stmt *statement);
int sqlite3_reset(sqlite3_stmt *statement);
int sqlite3_clear_bindings(sqlite3_stmt *statement);
const char *sqlite3_sql(sqlite3_stmt *statement);
int sqlite3_bind_int64(sqlite3_stmt *statement, int parameter, int64_t value);
int sqlite3_bind_text64(sqlite3_stmt *statement, int parameter, const char *text, uint64_t length,
                        void (*destroy)(void *), unsigned char encoding);

// Pointers to text and blobs are valid until the next step or reset of the statement.
int sqlite3_column_type(sqlite3_stmt *statement, int column);
int sqlite3_column_int(sqlite3_stmt *statement, int column);
int64_t sqlite3_column_int64(sqlite3_stmt *statement, int column);
int sqlite3_column_bytes(sqlite3_stmt *statement, int column);
const unsigned char *sqlite3_column_text(sqlite3_stmt *statement, int column);
const void *sqlite3_column_blob(sqlite3_stmt *statement, int column);
const char *sqlite3_column_name(sqlite3_stmt *statement, int column);
