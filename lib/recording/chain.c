// chain.c: the digest of a run, which each keyframe extends. src/archive/README.md defines it.
#include "base/heap.h"
#include "recording/archive.h"

#include <stdlib.h>

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

// Adds a text. A blob with the same bytes is damage, because a replay needs a text.
static bool add_column(PetriArchive *archive, Sha256 *hash, sqlite3_stmt *row, int column) {
    Str text;
    if (!archive_column_text(archive, row, column, &text))
        return false;
    add_text(hash, text);
    return true;
}

// Adds the pairs of a table of texts, which are in the order of their names.
static bool add_pairs(PetriArchive *archive, Sha256 *hash, ArchiveStatement number) {
    sqlite3_stmt *rows = archive_statement(archive, number);
    while (archive_next(archive, rows))
        if (!add_column(archive, hash, rows, 0) || !add_column(archive, hash, rows, 1))
            return false;
    return !archive_fails(archive);
}

// Adds the frame in the first column, and the texts in the columns after it.
static bool add_row(PetriArchive *archive, Sha256 *hash, sqlite3_stmt *row, int columns) {
    int64_t frame;
    if (!archive_column_integer(archive, row, 0, -1, ARCHIVE_MAX_FRAME, &frame))
        return false;
    add_integer(hash, frame);
    for (int i = 1; i < columns; i++)
        if (!add_column(archive, hash, row, i))
            return false;
    return true;
}

static bool add_digests(PetriArchive *archive, Sha256 *hash, const ArchiveSeal *seal) {
    int64_t frame = -2;
    Str digest;
    sqlite3_stmt *rows = archive_statement(archive, SQL_DIGESTS_BETWEEN);
    if (rows) {
        sqlite3_bind_int64(rows, 1, seal->previous);
        sqlite3_bind_int64(rows, 2, seal->frame);
    }
    while (archive_next_in_order(archive, rows, 0, ARCHIVE_MAX_FRAME, &frame)) {
        if (!archive_column_blob(archive, rows, 1, &digest))
            return false;
        add_integer(hash, frame);
        add_text(hash, digest);
    }
    return !archive_fails(archive);
}

// --- rows in the order of their ids

static const struct {
    ArchiveStatement frames;
    ArchiveStatement ids;
    ArchiveStatement row;
    int columns; // of `row`
} tables[TABLE_COUNT] = {
    [TABLE_FILE] = {SQL_FILE_FRAMES, SQL_FILE_IDS, SQL_FILE, 3},
    [TABLE_INPUT] = {SQL_INPUT_FRAMES, SQL_INPUT_IDS, SQL_INPUT, 3},
    [TABLE_NOTE] = {SQL_NOTE_FRAMES, SQL_NOTE_IDS, SQL_NOTE, 2},
};

static int compare_rows(const void *a, const void *b) {
    const ArchiveRow *x = a, *y = b;
    return x->frame != y->frame ? (x->frame < y->frame ? -1 : 1) : (x->id > y->id) - (x->id < y->id);
}

static int compare_ids(const void *a, const void *b) {
    int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

static bool read_frames(PetriArchive *archive, ArchiveTable table) {
    ArchiveRows *list = &archive->rows[table];
    int64_t id = -1, frame;
    sqlite3_stmt *rows = archive_statement(archive, tables[table].frames);
    while (archive_next_in_order(archive, rows, 0, INT64_MAX, &id)) {
        if (!archive_column_integer(archive, rows, 1, -1, ARCHIVE_MAX_FRAME, &frame) ||
            !archive_reserve(archive, sizeof *list->rows))
            return false;
        if (!heap_reserve((void **)&list->rows, &list->capacity, list->count, sizeof *list->rows))
            return archive_fail(archive, "out of memory");
        list->rows[list->count++] = (ArchiveRow){frame, id};
    }
    if (list->count > 0)
        qsort(list->rows, list->count, sizeof *list->rows, compare_rows);
    return !archive_fails(archive);
}

bool archive_begin_seals(PetriArchive *archive) {
    for (int i = 0; i < TABLE_COUNT; i++)
        if (!read_frames(archive, i))
            return false;
    return true;
}

void archive_end_seals(PetriArchive *archive) {
    for (int i = 0; i < TABLE_COUNT; i++) {
        ArchiveRows *list = &archive->rows[i];
        archive->memory -= list->count * sizeof *list->rows;
        heap_free(list->rows);
        *list = (ArchiveRows){0};
    }
}

static bool add_id(PetriArchive *archive, ArchiveIds *list, int64_t id) {
    if (!heap_reserve((void **)&list->ids, &list->capacity, list->count, sizeof *list->ids))
        return archive_fail(archive, "out of memory");
    list->ids[list->count++] = id;
    return true;
}

// Returns the position of the first row after a frame.
static uint32_t find_row(const ArchiveRows *list, int64_t frame) {
    uint32_t from = 0, to = list->count;
    while (from < to) {
        uint32_t middle = from + (to - from) / 2;
        if (list->rows[middle].frame <= frame)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

// Lists the rows that a seal covers: with a query if the archive is written, because that has the last rows only.
static bool list_rows(PetriArchive *archive, ArchiveTable table, const ArchiveSeal *seal, ArchiveIds *list) {
    const ArchiveRows *known = &archive->rows[table];
    sqlite3_stmt *rows = archive->writes ? archive_statement(archive, tables[table].ids) : NULL;
    for (uint32_t i = find_row(known, seal->previous); i < known->count && known->rows[i].frame <= seal->frame; i++)
        if (!add_id(archive, list, known->rows[i].id))
            return false;
    if (rows) {
        sqlite3_bind_int64(rows, 1, seal->previous);
        sqlite3_bind_int64(rows, 2, seal->frame);
    }
    while (archive_next(archive, rows))
        if (!add_id(archive, list, sqlite3_column_int64(rows, 0)))
            return false;
    if (list->count > 0)
        qsort(list->ids, list->count, sizeof *list->ids, compare_ids);
    return !archive_fails(archive);
}

static bool add_rows(PetriArchive *archive, Sha256 *hash, ArchiveTable table, const ArchiveSeal *seal) {
    ArchiveIds list = {0};
    bool good = list_rows(archive, table, seal, &list);
    for (uint32_t i = 0; i < list.count && good; i++) {
        sqlite3_stmt *row = archive_statement(archive, tables[table].row);
        if (row)
            sqlite3_bind_int64(row, 1, list.ids[i]);
        good = archive_next(archive, row) ? add_row(archive, hash, row, tables[table].columns)
                                          : archive_fail(archive, "the archive is damaged: a row is missing");
        if (row)
            sqlite3_reset(row); // frees the values
    }
    heap_free(list.ids);
    return good;
}

bool archive_seal(PetriArchive *archive, const ArchiveSeal *seal, char sha256[SHA256_DIGITS]) {
    Sha256 hash = sha256_new();
    bool good = true;
    if (seal->previous_sha256)
        sha256_add(&hash, seal->previous_sha256, SHA256_DIGITS);
    else
        good = add_pairs(archive, &hash, SQL_META) && add_pairs(archive, &hash, SQL_PARAMETERS);
    for (int i = 0; i < TABLE_COUNT && good; i++)
        good = add_rows(archive, &hash, i, seal);
    good = good && add_digests(archive, &hash, seal);
    add_integer(&hash, seal->frame);
    add_integer(&hash, seal->given);
    add_text(&hash, seal->setup);
    add_text(&hash, seal->state);
    sha256_end(&hash, sha256);
    return good;
}
