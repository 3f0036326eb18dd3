// read.c: opening archives, and their contents.
#include "base/heap.h"
#include "base/host_struct.h"
#include "base/spec.h"
#include "recording/archive.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_MEMORY_LIMIT ((size_t)2 << 30)

// Reads the keyframes, and sets archive->recorded_end to the last one.
static bool read_keyframes(PetriArchive *archive) {
    int64_t frame = -2, given;
    sqlite3_stmt *rows = archive_statement(archive, SQL_KEYFRAMES);
    while (archive_next_in_order(archive, rows, 0, ARCHIVE_MAX_FRAME, &frame)) {
        if (!archive_column_integer(archive, rows, 1, 0, 1, &given) ||
            !archive_reserve(archive, sizeof *archive->keyframes))
            return false;
        if (!heap_reserve((void **)&archive->keyframes, &archive->keyframe_capacity, archive->keyframe_count,
                          sizeof *archive->keyframes))
            return archive_fail(archive, "out of memory");
        archive->keyframes[archive->keyframe_count++] = (ArchiveKeyframe){.frame = frame, .end = frame, .given = given};
        archive->recorded_end = frame;
    }
    bool good = archive->keyframe_count == 0 || archive->keyframes[0].given;
    return !archive_fails(archive) &&
           (good || archive_fail(archive, "the archive is damaged: table keyframe: the first row is missing"));
}

// Notes that a frame was recorded. Returns the keyframe before it, or NULL.
static ArchiveKeyframe *note_frame(PetriArchive *archive, int64_t frame) {
    uint32_t after = archive_keyframes_until(archive, frame - 1);
    ArchiveKeyframe *keyframe = after > 0 ? &archive->keyframes[after - 1] : NULL;
    if (keyframe && frame > keyframe->end)
        keyframe->end = frame;
    archive->recorded_end = frame > archive->recorded_end ? frame : archive->recorded_end;
    return keyframe;
}

// Counts digests and inputs, and finds the last recorded frame after each keyframe.
static bool read_frames(PetriArchive *archive) {
    int64_t frame = -2, id = -1;
    sqlite3_stmt *digests = archive_statement(archive, SQL_DIGEST_FRAMES);
    while (archive_next_in_order(archive, digests, 0, ARCHIVE_MAX_FRAME, &frame)) {
        ArchiveKeyframe *keyframe = note_frame(archive, frame);
        if (keyframe)
            keyframe->digests++;
        archive->digest_count++;
    }
    sqlite3_stmt *inputs = archive_statement(archive, SQL_INPUT_FRAMES);
    while (archive_next_in_order(archive, inputs, 0, INT64_MAX, &id)) {
        if (!archive_column_integer(archive, inputs, 1, -1, ARCHIVE_MAX_FRAME, &frame))
            return false;
        if (sqlite3_column_int(inputs, 2))
            note_frame(archive, frame);
        archive->input_count++;
    }
    return !archive_fails(archive);
}

PetriArchive *petri_archive_open(const char *file, size_t memory_limit) {
    PetriArchive *archive = file ? archive_new() : NULL;
    if (!archive)
        return NULL;
    archive->memory_limit = memory_limit > 0 ? memory_limit : DEFAULT_MEMORY_LIMIT;
    archive->recorded_end = -1;
    archive->next_parameter = SIZE_MAX;
    archive->replay_frame = 0; // petri_check reads the first versions of files
    errno = 0;
    if (!petri_archive_is(file))
        archive_fail(archive, "%s", errno == ENOENT || errno == EACCES ? strerror(errno) : "it is not an archive");
    else if (archive_open_database(archive, file) && archive_read_files(archive) && read_keyframes(archive))
        read_frames(archive);
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
    // The keys are in order. Later ones are not read, because a damaged table can have rows without end.
    while (archive_next(archive, rows) && archive_column_text(archive, rows, 0, &found) &&
           str_compare(found, str_from(key)) <= 0)
        if (str_equal(found, str_from(key)) && archive_column_text(archive, rows, 1, &value))
            return store_string(archive, number, value);
    return store_string(archive, number, STR(""));
}

int64_t archive_meta_integer(PetriArchive *archive, const char *key) {
    return strtoll(read_meta(archive, 7, key), NULL, 10);
}

bool petri_archive_info(PetriArchive *archive, PetriArchiveInfo *info, size_t size) {
    Str sha256 = {"", 0};
    if (!archive || archive->writes || !info)
        return false;
    archive_begin(archive);
    PetriArchiveInfo data = {.keyframes = archive->keyframe_count, .files = archive->file_count, .sealed_frame = -1};
    data.script = read_meta(archive, 0, "script");
    data.command = read_meta(archive, 1, "command");
    data.version = read_meta(archive, 2, "petri");
    data.spec = read_meta(archive, 6, "spec");
    data.spec = data.spec[0] ? data.spec : SPEC_FIRST;
    data.keyframe_every = archive_meta_integer(archive, "keyframe_every");
    data.digest_every = archive_meta_integer(archive, "digest_every");
    data.digests = archive->digest_count;
    data.inputs = archive->input_count;
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
    archive_begin(archive);
    if (!archive_load_file(archive, found))
        return false;
    PetriArchiveFile data = {.name = found->name,
                             .frame = found->frame,
                             .sha256 = found->sha256,
                             .bytes = found->bytes,
                             .length = found->length};
    return host_struct_write(file, size, &data, sizeof data);
}

// Goes to the next parameter and stores its texts. The names are in order: a damaged table can have rows without end.
static bool next_parameter(PetriArchive *archive, sqlite3_stmt *rows) {
    Str texts[2];
    archive->next_parameter++;
    if (!archive_next(archive, rows) || !archive_column_text(archive, rows, 0, &texts[0]) ||
        !archive_column_text(archive, rows, 1, &texts[1]))
        return false;
    const char *last = archive->strings[4];
    if (last && str_compare(texts[0], str_from(last)) <= 0)
        return archive_fail(archive, "the archive is damaged: table parameter: the rows are not in order");
    store_string(archive, 4, texts[0]);
    store_string(archive, 5, texts[1]);
    return archive->strings[4] && archive->strings[5];
}

bool petri_archive_parameter(PetriArchive *archive, size_t number, const char **name, const char **value) {
    if (!archive || archive->writes || !name || !value || number > INT32_MAX)
        return false;
    archive_begin(archive);
    sqlite3_stmt *rows = archive->statements[SQL_PARAMETER];
    if (!rows || number != archive->next_parameter) {
        rows = archive_statement(archive, SQL_PARAMETER);
        heap_free(archive->strings[4]);
        archive->strings[4] = NULL;
        archive->next_parameter = 0;
    }
    bool found = !archive_fails(archive);
    while (found && archive->next_parameter <= number)
        found = next_parameter(archive, rows);
    if (!found) {
        archive->next_parameter = SIZE_MAX;
        return false;
    }
    *name = archive->strings[4];
    *value = archive->strings[5];
    return true;
}

bool petri_archive_keyframe(PetriArchive *archive, size_t number, PetriArchiveKeyframe *keyframe, size_t size) {
    if (!archive || archive->writes || !keyframe || number >= archive->keyframe_count)
        return false;
    const ArchiveKeyframe *found = &archive->keyframes[number];
    PetriArchiveKeyframe data = {
        .frame = found->frame, .given = found->given, .end = archive_segment_end(archive, (uint32_t)number)};
    return host_struct_write(keyframe, size, &data, sizeof data);
}

bool petri_archive_digest(PetriArchive *archive, int64_t frame, uint8_t digest[16]) {
    Str bytes;
    if (!archive || !digest || (archive->writes && !archive->session))
        return false;
    archive_begin(archive);
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
    if (!archive->session)
        archive_begin(archive); // else a part of the call that computes a frame
    const char *bytes = find_bytes(archive, name, length);
    pthread_mutex_unlock(&archive->mutex);
    return bytes;
}
