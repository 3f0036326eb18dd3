// chain.c: the digest of a run, which each keyframe extends. src/archive/README.md defines it.
#include "recording/archive.h"

#include <string.h>

static void add_integer(Sha256 *hash, int64_t x) {
    char bytes[8];
    for (int i = 0; i < 8; i++)
        bytes[i] = (char)((uint64_t)x >> 8 * i);
    sha256_add(hash, bytes, sizeof bytes);
}

static void add_text(Sha256 *hash, Str text) {
    add_integer(hash, (int64_t)text.len);
    sha256_add(hash, text.bytes, text.len);
}

// Adds columns of all rows of a query, after the frame if the query has one: the columns `first` to `end` - 1, which
// are texts or blobs.
static bool add_rows(PetriArchive *archive, Sha256 *hash, sqlite3_stmt *rows, int frame_column, int first, int end) {
    while (archive_next(archive, rows)) {
        int64_t frame;
        if (frame_column >= 0 && !archive_column_integer(archive, rows, frame_column, -1, ARCHIVE_MAX_FRAME, &frame))
            return false;
        if (frame_column >= 0)
            add_integer(hash, frame);
        for (int i = first; i < end; i++) {
            Str bytes;
            bool is_blob = sqlite3_column_type(rows, i) == SQLITE_BLOB;
            if (!(is_blob ? archive_column_blob : archive_column_text)(archive, rows, i, &bytes))
                return false;
            add_text(hash, bytes);
        }
    }
    return !archive_fails(archive);
}

// Returns a query of the rows that a seal covers.
static sqlite3_stmt *rows_between(PetriArchive *archive, ArchiveStatement number, const ArchiveSeal *seal) {
    sqlite3_stmt *rows = archive_statement(archive, number);
    if (rows) {
        sqlite3_bind_int64(rows, 1, seal->previous);
        sqlite3_bind_int64(rows, 2, seal->frame);
    }
    return rows;
}

bool archive_seal(PetriArchive *archive, const ArchiveSeal *seal, char sha256[SHA256_DIGITS]) {
    Sha256 hash = sha256_new();
    bool good = true;
    if (seal->previous_sha256)
        sha256_add(&hash, seal->previous_sha256, SHA256_DIGITS);
    else
        good = add_rows(archive, &hash, archive_statement(archive, SQL_META), -1, 0, 2) &&
               add_rows(archive, &hash, archive_statement(archive, SQL_PARAMETERS), -1, 0, 2);
    good = good && add_rows(archive, &hash, rows_between(archive, SQL_FILES_BETWEEN, seal), 1, 2, 4) &&
           add_rows(archive, &hash, rows_between(archive, SQL_INPUTS_BETWEEN, seal), 0, 1, 3) &&
           add_rows(archive, &hash, rows_between(archive, SQL_NOTES_BETWEEN, seal), 0, 1, 2) &&
           add_rows(archive, &hash, rows_between(archive, SQL_DIGESTS_BETWEEN, seal), 0, 1, 2);
    add_integer(&hash, seal->frame);
    add_integer(&hash, seal->given);
    add_text(&hash, seal->setup);
    add_text(&hash, seal->state);
    sha256_end(&hash, sha256);
    return good;
}
