// files.c: the versions of the files in an archive.
#include "base/heap.h"
#include "recording/archive.h"

#include <string.h>

ArchiveFile *archive_add_file(PetriArchive *archive, int64_t id, int64_t frame, Str name) {
    if (!heap_reserve((void **)&archive->files, &archive->file_capacity, archive->file_count, sizeof *archive->files)) {
        archive_fail(archive, "out of memory");
        return NULL;
    }
    ArchiveFile *file = &archive->files[archive->file_count];
    *file = (ArchiveFile){.id = id, .frame = frame, .name = heap_strndup(name.bytes, name.len)};
    if (!file->name) {
        archive_fail(archive, "out of memory");
        return NULL;
    }
    archive->file_count++;
    return file;
}

ArchiveFile *archive_find_file(const PetriArchive *archive, Str name, int64_t frame) {
    ArchiveFile *found = NULL;
    for (uint32_t i = 0; i < archive->file_count; i++) {
        ArchiveFile *file = &archive->files[i];
        if (file->frame <= frame && (!found || file->frame >= found->frame) && str_equal(str_from(file->name), name))
            found = file;
    }
    return found;
}

static bool is_sha256(Str text) {
    for (size_t i = 0; i < text.len; i++)
        if (!strchr("0123456789abcdef", text.bytes[i]))
            return false;
    return text.len == SHA256_DIGITS;
}

// Adds the file of a row. An empty SHA-256 marks a file that was removed.
static bool read_file_row(PetriArchive *archive, sqlite3_stmt *row) {
    int64_t id, frame, length = 0;
    Str name, sha256;
    if (!archive_column_integer(archive, row, 0, 0, INT64_MAX, &id) ||
        !archive_column_integer(archive, row, 1, 0, ARCHIVE_MAX_FRAME, &frame) ||
        !archive_column_text(archive, row, 2, &name) || !archive_column_text(archive, row, 3, &sha256))
        return false;
    bool removed = sqlite3_column_type(row, 4) == SQLITE_NULL;
    if (!removed && !archive_column_integer(archive, row, 4, 0, INT64_MAX, &length))
        return false;
    if (memchr(name.bytes, 0, name.len) || (removed ? sha256.len > 0 : !is_sha256(sha256)))
        return archive_fail(archive, "the archive is damaged: table file: row %lld is not valid", (long long)id);
    ArchiveFile *file = archive_add_file(archive, id, frame, name);
    if (!file)
        return false;
    memcpy(file->sha256, sha256.bytes, sha256.len);
    file->length = (size_t)length;
    return true;
}

bool archive_read_files(PetriArchive *archive) {
    sqlite3_stmt *rows = archive_statement(archive, SQL_FILES);
    while (archive_next(archive, rows))
        if (!read_file_row(archive, rows))
            return false;
    return !archive_fails(archive);
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
