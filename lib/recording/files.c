// files.c: the versions of the files in an archive.
#include "base/heap.h"
#include "recording/archive.h"

#include <stdlib.h>
#include <string.h>

static int compare_names(const void *a, const void *b) {
    const ArchiveName *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    return order != 0 ? order : (x->file > y->file) - (x->file < y->file);
}

// Returns the position of the first name that follows the versions of `name` at or before `frame`. The versions of a
// name are in the order of their frames.
static uint32_t find_name(const PetriArchive *archive, Str name, int64_t frame) {
    uint32_t from = 0, to = archive->file_count;
    while (from < to) {
        uint32_t middle = from + (to - from) / 2;
        const ArchiveName *found = &archive->names[middle];
        int order = str_compare(str_from(found->name), name);
        if (order < 0 || (order == 0 && archive->files[found->file].frame <= frame))
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

// Adds a file to both lists, but to the end of the names.
static ArchiveFile *add_file(PetriArchive *archive, int64_t id, int64_t frame, Str name) {
    uint32_t count = archive->file_count;
    size_t size = sizeof(ArchiveFile) + sizeof(ArchiveName) + name.len + 1;
    if (!archive_reserve(archive, size))
        return NULL;
    char *copy = heap_strndup(name.bytes, name.len);
    if (!copy || !heap_reserve((void **)&archive->files, &archive->file_capacity, count, sizeof *archive->files) ||
        !heap_reserve((void **)&archive->names, &archive->name_capacity, count, sizeof *archive->names)) {
        heap_free(copy);
        archive_fail(archive, "out of memory");
        return NULL;
    }
    archive->files[count] = (ArchiveFile){.id = id, .frame = frame, .name = copy};
    archive->names[count] = (ArchiveName){copy, count};
    archive->file_count++;
    return &archive->files[count];
}

ArchiveFile *archive_add_file(PetriArchive *archive, int64_t id, int64_t frame, Str name) {
    uint32_t at = find_name(archive, name, INT64_MAX), after = archive->file_count - at;
    ArchiveFile *file = add_file(archive, id, frame, name);
    if (!file)
        return NULL;
    ArchiveName *place = &archive->names[at], added = place[after];
    memmove(place + 1, place, after * sizeof *place);
    *place = added;
    return file;
}

ArchiveFile *archive_find_file(const PetriArchive *archive, Str name, int64_t frame) {
    uint32_t next = find_name(archive, name, frame);
    const ArchiveName *found = next > 0 ? &archive->names[next - 1] : NULL;
    return found && str_equal(str_from(found->name), name) ? &archive->files[found->file] : NULL;
}

static bool is_sha256(Str text) {
    for (size_t i = 0; i < text.len; i++)
        if (!strchr("0123456789abcdef", text.bytes[i]))
            return false;
    return text.len == SHA256_DIGITS;
}

// Adds the file of a row. An empty SHA-256 marks a file that was removed.
static bool read_file_row(PetriArchive *archive, sqlite3_stmt *row, int64_t id) {
    int64_t frame, length = 0;
    Str name, sha256;
    if (!archive_column_integer(archive, row, 1, 0, ARCHIVE_MAX_FRAME, &frame) ||
        !archive_column_text(archive, row, 2, &name) || !archive_column_text(archive, row, 3, &sha256))
        return false;
    bool removed = sqlite3_column_type(row, 4) == SQLITE_NULL;
    if (!removed && !archive_column_integer(archive, row, 4, 0, INT64_MAX, &length))
        return false;
    if (memchr(name.bytes, 0, name.len) || (removed ? sha256.len > 0 : !is_sha256(sha256)))
        return archive_fail(archive, "the archive is damaged: table file: row %lld is not valid", (long long)id);
    ArchiveFile *file = add_file(archive, id, frame, name);
    if (!file)
        return false;
    memcpy(file->sha256, sha256.bytes, sha256.len);
    file->length = (size_t)length;
    return true;
}

// Sorts the names, and checks the order of the versions of each file.
static bool sort_names(PetriArchive *archive) {
    if (archive->file_count > 0)
        qsort(archive->names, archive->file_count, sizeof *archive->names, compare_names);
    for (uint32_t i = 1; i < archive->file_count; i++) {
        const ArchiveFile *last = &archive->files[archive->names[i - 1].file], *file;
        file = &archive->files[archive->names[i].file];
        if (file->frame < last->frame && strcmp(file->name, last->name) == 0)
            return archive_fail(archive, "the archive is damaged: table file: row %lld is older than the one before it",
                                (long long)file->id);
    }
    return true;
}

bool archive_read_files(PetriArchive *archive) {
    int64_t id = -1;
    sqlite3_stmt *rows = archive_statement(archive, SQL_FILES);
    while (archive_next_in_order(archive, rows, 0, INT64_MAX, &id))
        if (!read_file_row(archive, rows, id))
            return false;
    return !archive_fails(archive) && sort_names(archive);
}

bool archive_load_file(PetriArchive *archive, ArchiveFile *file) {
    char sha256[SHA256_DIGITS];
    Str bytes;
    if (file->bytes || !file->sha256[0])
        return true;
    if (file->length > archive->memory_limit - archive->memory)
        return archive_fail(archive, "the files in the archive exceed the memory limit");
    sqlite3_stmt *row = archive_statement(archive, SQL_FILE_BYTES);
    if (row)
        sqlite3_bind_int64(row, 1, file->id);
    if (!archive_next(archive, row) || !archive_column_blob(archive, row, 0, &bytes))
        return archive_fail(archive, "the archive is damaged: table file: row %lld is missing", (long long)file->id);
    sha256_of(bytes.bytes, bytes.len, sha256);
    if (bytes.len != file->length || memcmp(sha256, file->sha256, SHA256_DIGITS) != 0)
        return archive_fail(archive, "the archive is damaged: table file: row %lld has another SHA-256",
                            (long long)file->id);
    file->bytes = heap_strndup(bytes.bytes, bytes.len);
    archive->memory += file->bytes ? bytes.len : 0;
    sqlite3_reset(row);
    return file->bytes || archive_fail(archive, "out of memory");
}
