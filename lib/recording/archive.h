// archive.h: internal declarations of archives; petri-archive.h is their public interface.
#pragma once

#include "base/sha256.h"
#include "base/str.h"
#include "petri-archive.h"
#include "recording/recognise.h"
#include "session/recorder.h"

#include <pthread.h>
#include <sqlite3.h>
#include <stdatomic.h>

// User version of the database. 1: petri 0.3, without versions of the specification.
#define ARCHIVE_FORMAT 2
#define ARCHIVE_MAX_FRAME INT64_C(100000000000000000)
#define ARCHIVE_MAX_TEXT (1 << 20) // bytes of a name, or of a text for information

// Statements, which are prepared when they are used first (database.c).
typedef enum ArchiveStatement {
    SQL_ADD_META,
    SQL_ADD_PARAMETER,
    SQL_ADD_FILE,
    SQL_ADD_INPUT,
    SQL_ADD_DIGEST,
    SQL_ADD_KEYFRAME,
    SQL_ADD_NOTE,
    SQL_META,
    SQL_PARAMETERS,
    SQL_PARAMETER,
    SQL_FILES,
    SQL_FILE_BYTES,
    SQL_FILE_IDS,
    SQL_INPUT_IDS,
    SQL_NOTE_IDS,
    SQL_FILE_FRAMES,
    SQL_INPUT_FRAMES,
    SQL_NOTE_FRAMES,
    SQL_FILE,
    SQL_INPUT,
    SQL_NOTE,
    SQL_INPUTS,
    SQL_DIGEST,
    SQL_DIGEST_FRAMES,
    SQL_DIGESTS_BETWEEN,
    SQL_KEYFRAMES,
    SQL_KEYFRAME_SETUP,
    SQL_KEYFRAME_STATE,
    SQL_LAST_KEYFRAME,
    SQL_COUNT,
} ArchiveStatement;

// A version of a file. `bytes` are read when they are requested, and are then kept.
typedef struct ArchiveFile {
    int64_t id;
    int64_t frame;
    char *name;
    char sha256[SHA256_DIGITS + 1]; // empty: the file was removed
    size_t length;
    char *bytes; // NULL: not read yet
} ArchiveFile;

// A name in the order of the names, and then of the positions in the list of files.
typedef struct ArchiveName {
    const char *name;
    uint32_t file;
} ArchiveName;

typedef struct ArchiveKeyframe {
    int64_t frame;
    int64_t end;     // last frame after it, up to the next keyframe, that has a digest or a clock; its frame: none
    int64_t digests; // number of digests of these frames
    bool given;
} ArchiveKeyframe;

typedef struct ArchivePages ArchivePages;

// Ids of rows.
typedef struct ArchiveIds {
    int64_t *ids;
    uint32_t count;
    uint32_t capacity;
} ArchiveIds;

// Rows of a table that chain.c reads for one keyframe after another.
typedef enum ArchiveTable { TABLE_FILE, TABLE_INPUT, TABLE_NOTE, TABLE_COUNT } ArchiveTable;

typedef struct ArchiveRow {
    int64_t frame;
    int64_t id;
} ArchiveRow;

typedef struct ArchiveRows {
    ArchiveRow *rows; // in the order of their frames; NULL: not read
    uint32_t count;
    uint32_t capacity;
} ArchiveRows;

struct PetriArchive {
    sqlite3 *database;
    sqlite3_stmt *statements[SQL_COUNT];
    char problem[256]; // empty: none
    PetriSession *session;
    ArchiveFile *files; // in the order of their ids
    uint32_t file_count;
    uint32_t file_capacity;
    ArchiveName *names;
    uint32_t name_capacity;
    // Writing
    PetriArchiveOptions options;
    bool writes;
    int claim;             // descriptor that holds the lock of the file; -1: none
    bool needs_keyframe;   // the next frame does not follow from the last one
    bool has_new_notes;    // there are notes since the last frame
    bool mentions_clock;   // a script may use `clock`
    bool mentions_files;   // nodes may have an attribute `filename`
    uint64_t revision;     // revision of the configuration that was recorded last
    int64_t last_frame;    // last recorded frame; -2: none
    int64_t session_frame; // last frame of the session; not that of another run (petri_trust)
    int64_t last_keyframe; // -2: none
    bool state_modified;   // the host has modified the state since the last frame
    double last_commit;    // times of the monotonic clock in seconds
    double last_frame_end; // 0: no frame yet
    // Reading
    pthread_mutex_t mutex; // for petri_archive_read, which threads that draw can call
    ArchivePages *pages;
    bool has_schema; // the tables were checked
    size_t memory_limit;
    size_t memory;          // bytes of files, lists and texts that are in memory
    uint64_t content_limit; // bytes of contents that the file can have
    _Atomic uint64_t work;  // of the current call, in units of about 10 ns
    uint64_t work_limit;
    atomic_bool interrupted; // the current call ends because its session is interrupted
    ArchiveRows rows[TABLE_COUNT];
    size_t next_parameter; // of the active query SQL_PARAMETER
    int64_t digest_count;
    int64_t input_count;
    ArchiveKeyframe *keyframes;
    uint32_t keyframe_count;
    uint32_t keyframe_capacity;
    int64_t recorded_end; // last recorded frame; less than 0: none
    bool at_keyframe;     // the session has the state of a keyframe, which was loaded since the last frame
    int64_t replay_frame; // frame that is replayed; selects versions of files
    char *strings[8];     // results of petri_archive_info and petri_archive_parameter
};

// database.c: the database, its statements and its rows.

// Records the first problem. Returns false.
bool archive_fail(PetriArchive *archive, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool archive_fails(const PetriArchive *archive);
// Records the problem that SQLite reports. Returns false.
bool archive_fail_sqlite(PetriArchive *archive, int result);
PetriArchive *archive_new(void);
void archive_free(PetriArchive *archive);
// Creates the database in the file that archive_claim_file has made.
bool archive_create_database(PetriArchive *archive, const char *file);
// Closes the database and releases the lock of the file.
void archive_close_database(PetriArchive *archive);
bool archive_open_database(PetriArchive *archive, const char *file);
bool archive_execute(PetriArchive *archive, const char *sql);
// Returns a statement, ready for binding. Returns NULL after a problem.
sqlite3_stmt *archive_statement(PetriArchive *archive, ArchiveStatement number);
// Goes to the next row of a query. Returns false at the end or after a problem.
bool archive_next(PetriArchive *archive, sqlite3_stmt *statement);
// Like archive_next, but stores a column in *key, whose value must be greater than before and at most `max`. In a
// damaged database, pages can follow each other without end.
bool archive_next_in_order(PetriArchive *archive, sqlite3_stmt *statement, int column, int64_t max, int64_t *key);
// Executes a statement that returns no rows, unless it is NULL. Returns false after a problem.
bool archive_run(PetriArchive *archive, sqlite3_stmt *statement);
bool archive_bind_text(sqlite3_stmt *statement, int column, Str text);
// Columns of the current row. If the value has the wrong type, they record a problem and return false.
bool archive_column_integer(PetriArchive *archive, sqlite3_stmt *row, int column, int64_t min, int64_t max, int64_t *x);
bool archive_column_text(PetriArchive *archive, sqlite3_stmt *row, int column, Str *text);
bool archive_column_blob(PetriArchive *archive, sqlite3_stmt *row, int column, Str *bytes);

// Begins a call that reads: its work is limited in proportion to the size of the archive.
void archive_begin(PetriArchive *archive);
// Charges units of work of about 10 ns to the current call. Returns false if it must end.
bool archive_charge(PetriArchive *archive, uint64_t units);
// Charges memory, which the caller releases by subtracting it from archive->memory. Returns false after a problem.
bool archive_reserve(PetriArchive *archive, uint64_t bytes);

// pages.c: opens an archive for reading. Returns false after a problem.
bool archive_connect(PetriArchive *archive, const char *name);
void archive_free_pages(ArchivePages *pages); // NULL is ignored

// claim.c: creates the file of an archive that is written, or empties an existing archive, and locks it. The file is
// archive->claim, which must stay open. Returns false after a problem.
bool archive_claim_file(PetriArchive *archive, const char *name);

// files.c: the versions of files.

// Adds a version to the list. Copies the name. Returns NULL after a problem.
ArchiveFile *archive_add_file(PetriArchive *archive, int64_t id, int64_t frame, Str name);
// Returns the last version of a file at or before `frame`, or NULL.
ArchiveFile *archive_find_file(const PetriArchive *archive, Str name, int64_t frame);
// Reads the list of the files. Returns false after a problem.
bool archive_read_files(PetriArchive *archive);
// Reads the bytes of a file and checks them. Returns false after a problem.
bool archive_load_file(PetriArchive *archive, ArchiveFile *file);

// read.c: returns the value of a key in the table meta; 0: there is none.
int64_t archive_meta_integer(PetriArchive *archive, const char *key);

// replay.c: keyframes.

// Returns the number of keyframes at or before `frame`.
uint32_t archive_keyframes_until(const PetriArchive *archive, int64_t frame);
// Returns the last recorded frame that follows from a keyframe.
int64_t archive_segment_end(const PetriArchive *archive, uint32_t number);

// chain.c: the digest of a run. Computes the digest of the keyframe `frame`, which covers all rows after the frame
// `previous` (the keyframe before it; -2: none) and the digest of that keyframe. Returns false after a problem.
typedef struct ArchiveSeal {
    int64_t previous;
    const char *previous_sha256; // 64 digits; NULL: none
    int64_t frame;
    bool given;
    Str setup;
    Str state;
} ArchiveSeal;
bool archive_seal(PetriArchive *archive, const ArchiveSeal *seal, char sha256[SHA256_DIGITS]);
// Reads the frames of the rows of an archive that is read, before the seals of its keyframes are computed in order.
// Returns false after a problem.
bool archive_begin_seals(PetriArchive *archive);
void archive_end_seals(PetriArchive *archive);
