// read.c: opening archives, and their contents.
#include "base/heap.h"
#include "base/host_struct.h"
#include "recording/archive.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_MEMORY_LIMIT ((size_t)2 << 30)

// Reads the keyframes, and sets archive->recorded_end to the last one. Rows of a damaged file need not be in order.
static bool read_keyframes(PetriArchive *archive) {
    sqlite3_stmt *rows = archive_statement(archive, SQL_KEYFRAMES);
    while (archive_next(archive, rows)) {
        int64_t frame, given;
        if (!archive_column_integer(archive, rows, 0, -1, ARCHIVE_MAX_FRAME, &frame) ||
            !archive_column_integer(archive, rows, 1, 0, 1, &given))
            return false;
        if (archive->keyframe_count > 0 && frame <= archive->keyframes[archive->keyframe_count - 1].frame)
            return archive_fail(archive, "the archive is damaged: table keyframe: the rows are not in order");
        if (!heap_reserve((void **)&archive->keyframes, &archive->keyframe_capacity, archive->keyframe_count,
                          sizeof *archive->keyframes))
            return archive_fail(archive, "out of memory");
        archive->keyframes[archive->keyframe_count++] = (ArchiveKeyframe){frame, given};
        archive->recorded_end = frame;
    }
    bool good = archive->keyframe_count == 0 || archive->keyframes[0].given;
    return !archive_fails(archive) &&
           (good || archive_fail(archive, "the archive is damaged: table keyframe: the first row is missing"));
}

// Counts the rows of a table, and raises archive->recorded_end to their last frame.
static int64_t count_rows(PetriArchive *archive, ArchiveStatement number, bool all) {
    int64_t count = 0, last = -1;
    sqlite3_stmt *row = archive_statement(archive, number);
    if (row && sqlite3_bind_parameter_count(row) > 0)
        sqlite3_bind_int(row, 1, all);
    if (!archive_next(archive, row) || !archive_column_integer(archive, row, 0, 0, INT64_MAX, &count) ||
        !archive_column_integer(archive, row, 1, -1, ARCHIVE_MAX_FRAME, &last))
        return 0;
    archive->recorded_end = last > archive->recorded_end ? last : archive->recorded_end;
    return count;
}

PetriArchive *petri_archive_open(const char *file, size_t memory_limit) {
    PetriArchive *archive = file ? archive_new() : NULL;
    if (!archive)
        return NULL;
    archive->memory_limit = memory_limit > 0 ? memory_limit : DEFAULT_MEMORY_LIMIT;
    archive->recorded_end = -1;
    if (!petri_archive_is(file)) {
        archive_fail(archive, "it is not an archive");
        return archive;
    }
    archive->replay_frame = 0; // petri_check reads the first versions of files
    if (archive_open_database(archive, file) && archive_read_files(archive) && read_keyframes(archive)) {
        count_rows(archive, SQL_COUNT_DIGESTS, true);
        count_rows(archive, SQL_COUNT_INPUTS, false);
    }
    return archive;
}

void petri_archive_close(PetriArchive **handle) {
    PetriArchive *archive = handle ? *handle : NULL;
    if (!archive)
        return;
    *handle = NULL;
    petri_archive_complete(archive);
    petri_archive_end_replay(archive);
    archive_free(archive);
}

const char *petri_archive_problem(const PetriArchive *archive) {
    return archive && archive_fails(archive) ? archive->problem : NULL;
}

// --- contents

// Stores a copy of a text as result `number`. Returns the copy.
static const char *store_string(PetriArchive *archive, int number, Str text) {
    heap_free(archive->strings[number]);
    archive->strings[number] = heap_strndup(text.bytes, text.len);
    return archive->strings[number] ? archive->strings[number] : "";
}

// Returns the value of a key in the table meta, as result `number`; "" if there is none.
static const char *read_meta(PetriArchive *archive, int number, const char *key) {
    sqlite3_stmt *rows = archive_statement(archive, SQL_META);
    Str found, value = {"", 0};
    while (archive_next(archive, rows))
        if (archive_column_text(archive, rows, 0, &found) && str_equal(found, str_from(key)) &&
            archive_column_text(archive, rows, 1, &value))
            return store_string(archive, number, value);
    return store_string(archive, number, STR(""));
}

static int64_t read_meta_integer(PetriArchive *archive, const char *key) {
    return strtoll(read_meta(archive, 7, key), NULL, 10);
}

bool petri_archive_info(PetriArchive *archive, PetriArchiveInfo *info, size_t size) {
    Str sha256 = {"", 0};
    if (!archive || archive->writes || !info)
        return false;
    PetriArchiveInfo data = {.keyframes = archive->keyframe_count, .files = archive->file_count, .sealed_frame = -1};
    data.script = read_meta(archive, 0, "script");
    data.command = read_meta(archive, 1, "command");
    data.version = read_meta(archive, 2, "petri");
    data.keyframe_every = read_meta_integer(archive, "keyframe_every");
    data.digest_every = read_meta_integer(archive, "digest_every");
    data.digests = count_rows(archive, SQL_COUNT_DIGESTS, true);
    int64_t end = archive->recorded_end;
    data.inputs = count_rows(archive, SQL_COUNT_INPUTS, true);
    archive->recorded_end = end; // inputs after the last frame do not count
    for (uint32_t i = 0; i < archive->file_count; i++)
        data.file_bytes += (int64_t)archive->files[i].length;
    data.first_frame = archive->keyframe_count > 0 ? archive->keyframes[0].frame + 1 : 0;
    data.last_frame = archive->recorded_end;
    sqlite3_stmt *last = archive_statement(archive, SQL_LAST_KEYFRAME);
    if (last)
        sqlite3_bind_int64(last, 1, INT64_MAX);
    if (archive_next(archive, last)) {
        archive_column_integer(archive, last, 0, -1, ARCHIVE_MAX_FRAME, &data.sealed_frame);
        archive_column_text(archive, last, 1, &sha256);
    }
    data.sha256 = store_string(archive, 3, sha256);
    return !archive_fails(archive) && host_struct_write(info, size, &data, sizeof data);
}

bool petri_archive_file(PetriArchive *archive, size_t number, PetriArchiveFile *file, size_t size) {
    if (!archive || archive->writes || !file || number >= archive->file_count)
        return false;
    ArchiveFile *found = &archive->files[number];
    if (!archive_load_file(archive, found))
        return false;
    PetriArchiveFile data = {.name = found->name,
                             .frame = found->frame,
                             .sha256 = found->sha256,
                             .bytes = found->bytes,
                             .length = found->length};
    return host_struct_write(file, size, &data, sizeof data);
}

bool petri_archive_parameter(PetriArchive *archive, size_t number, const char **name, const char **value) {
    Str texts[2];
    if (!archive || archive->writes || !name || !value || number > INT32_MAX)
        return false;
    sqlite3_stmt *row = archive_statement(archive, SQL_PARAMETER);
    if (row)
        sqlite3_bind_int64(row, 1, (int64_t)number);
    if (!archive_next(archive, row) || !archive_column_text(archive, row, 0, &texts[0]) ||
        !archive_column_text(archive, row, 1, &texts[1]))
        return false;
    *name = store_string(archive, 4, texts[0]);
    *value = store_string(archive, 5, texts[1]);
    return true;
}

bool petri_archive_keyframe(PetriArchive *archive, size_t number, PetriArchiveKeyframe *keyframe, size_t size) {
    if (!archive || archive->writes || !keyframe || number >= archive->keyframe_count)
        return false;
    const ArchiveKeyframe *found = &archive->keyframes[number], *next = found + 1;
    PetriArchiveKeyframe data = {.frame = found->frame, .given = found->given, .end = archive->recorded_end};
    if (number + 1 < archive->keyframe_count) {
        data.end = next->frame;
        // The frames before a given keyframe need not reach it.
        sqlite3_stmt *rows = next->given ? archive_statement(archive, SQL_LAST_RECORDED) : NULL;
        if (rows) {
            sqlite3_bind_int64(rows, 1, next->frame);
            if (!archive_next(archive, rows) ||
                !archive_column_integer(archive, rows, 0, -1, ARCHIVE_MAX_FRAME, &data.end))
                return false;
            data.end = data.end < found->frame ? found->frame : data.end;
        }
    }
    return host_struct_write(keyframe, size, &data, sizeof data);
}

bool petri_archive_digest(PetriArchive *archive, int64_t frame, uint8_t digest[16]) {
    Str bytes;
    if (!archive || !digest || (archive->writes && !archive->session))
        return false;
    sqlite3_stmt *row = archive_statement(archive, SQL_DIGEST);
    if (row)
        sqlite3_bind_int64(row, 1, frame);
    if (!archive_next(archive, row) || !archive_column_blob(archive, row, 0, &bytes))
        return false;
    if (bytes.len != 16)
        return archive_fail(archive,
                            "the archive is damaged: table digest: the value of frame %" PRId64 " is not valid", frame);
    memcpy(digest, bytes.bytes, 16);
    return true;
}

// --- files

// Returns true if a recorded listing of the file's folder contains its name.
static bool is_listed(const PetriArchive *archive, const char *name) {
    Str whole = str_from(name), folder;
    size_t length = whole.len - (whole.len > 0 && whole.bytes[whole.len - 1] == '/');
    while (length > 0 && whole.bytes[length - 1] != '/')
        length--;
    folder = length > 0 ? (Str){whole.bytes, length} : STR("./");
    const ArchiveFile *list = archive_find_file(archive, folder, archive->replay_frame);
    Str wanted = {whole.bytes + length, whole.len - length};
    for (size_t at = 0; list && list->bytes && at < list->length;) {
        const char *line = list->bytes + at, *end = memchr(line, '\n', list->length - at);
        size_t line_length = end ? (size_t)(end - line) : list->length - at;
        if (str_equal((Str){line, line_length}, wanted))
            return true;
        at += line_length + 1;
    }
    return false;
}

static const char *find_bytes(PetriArchive *archive, const char *name, size_t *length) {
    ArchiveFile *file = archive_find_file(archive, str_from(name), archive->replay_frame);
    if (!file) {
        // A file that exists but was not read, or a folder that was not listed.
        *length = 0;
        return is_listed(archive, name) ? "" : NULL;
    }
    if (!archive_load_file(archive, file))
        return NULL;
    *length = file->length;
    return file->bytes;
}

const char *petri_archive_read(void *archive_handle, const char *name, size_t *length) {
    PetriArchive *archive = archive_handle;
    if (!archive || !name || !length)
        return NULL;
    pthread_mutex_lock(&archive->mutex);
    const char *bytes = find_bytes(archive, name, length);
    pthread_mutex_unlock(&archive->mutex);
    return bytes;
}
