// write.c: recording of a session in an archive.
#include "base/clock.h"
#include "base/heap.h"
#include "base/host_struct.h"
#include "base/number.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "recording/archive.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

// Returns the frame to which an input or a file belongs: the frame that is computed, else the next one.
static int64_t next_frame(const PetriArchive *archive) {
    return archive->session_frame + 1;
}

static void add_pair(PetriArchive *archive, ArchiveStatement number, const char *key, const char *value) {
    sqlite3_stmt *row = archive_statement(archive, number);
    archive_bind_text(row, 1, str_from(key));
    archive_bind_text(row, 2, str_from(value));
    archive_run(archive, row);
}

static void add_meta_integer(PetriArchive *archive, const char *key, int64_t value) {
    char text[24];
    snprintf(text, sizeof text, "%" PRId64, value);
    add_pair(archive, SQL_ADD_META, key, text);
}

// --- files and inputs

static bool contains(Str text, const char *word) {
    size_t length = strlen(word);
    const char *end = text.bytes + text.len;
    for (const char *at = text.bytes; (at = memchr(at, word[0], (size_t)(end - at))); at++)
        if ((size_t)(end - at) >= length && memcmp(at, word, length) == 0)
            return true;
    return false;
}

static void note_words(PetriArchive *archive, Str text) {
    archive->mentions_clock = archive->mentions_clock || contains(text, "clock");
    archive->mentions_files = archive->mentions_files || contains(text, "filename");
}

// Adds a new version of a file, unless it is the same as the last version.
static void on_file(void *user_data, const char *name, Str bytes) {
    PetriArchive *archive = user_data;
    char sha256[SHA256_DIGITS + 1] = "";
    if (archive_fails(archive))
        return;
    if (bytes.bytes)
        sha256_of(bytes.bytes, bytes.len, sha256);
    ArchiveFile *last = archive_find_file(archive, str_from(name), INT64_MAX);
    if (last ? strcmp(last->sha256, sha256) == 0 : !bytes.bytes)
        return;
    if (bytes.bytes)
        note_words(archive, bytes);
    int64_t frame = next_frame(archive);
    sqlite3_stmt *row = archive_statement(archive, SQL_ADD_FILE);
    if (!row)
        return;
    sqlite3_bind_int64(row, 1, frame);
    archive_bind_text(row, 2, str_from(name));
    archive_bind_text(row, 3, str_from(sha256));
    if (bytes.bytes)
        sqlite3_bind_blob64(row, 4, bytes.bytes, bytes.len, SQLITE_STATIC);
    if (!archive_run(archive, row))
        return;
    ArchiveFile *file = archive_add_file(archive, sqlite3_last_insert_rowid(archive->database), frame, str_from(name));
    if (file)
        memcpy(file->sha256, sha256, sizeof sha256);
}

static void add_input(PetriArchive *archive, int64_t frame, const char *kind, Str payload) {
    sqlite3_stmt *row = archive_statement(archive, SQL_ADD_INPUT);
    if (!row)
        return;
    sqlite3_bind_int64(row, 1, frame);
    archive_bind_text(row, 2, str_from(kind));
    archive_bind_text(row, 3, payload);
    archive_run(archive, row);
}

static bool fail_status(PetriArchive *archive, PetriStatus status) {
    return status == PETRI_OK || archive_fail(archive, "%s", petri_status_text(status));
}

// Adds the configuration if it has changed. Its text can be the same as before, for example if an included file was
// loaded again.
static void flush_configuration(PetriArchive *archive) {
    Str text;
    uint64_t revision = petri_config_revision(archive->session);
    if (archive_fails(archive) || revision == archive->revision)
        return;
    recorder_report_script(archive->session);
    if (!fail_status(archive, recorder_write(archive->session, RECORDER_CONFIGURATION, &text)))
        return;
    archive->revision = revision;
    note_words(archive, text);
    if (!archive->needs_keyframe)
        add_input(archive, next_frame(archive), "configuration", text);
}

static void on_input(void *user_data, const char *kind, Str payload) {
    PetriArchive *archive = user_data;
    if (archive_fails(archive) || archive->needs_keyframe)
        return; // the keyframe will contain the effect of the input
    flush_configuration(archive);
    add_input(archive, next_frame(archive), kind, payload);
    archive->state_modified = archive->state_modified || strcmp(kind, "state") == 0;
}

// --- keyframes

static void add_first_rows(PetriArchive *archive) {
    PetriParameter parameter;
    const char *script = recorder_script_name(archive->session);
    add_meta_integer(archive, "format", ARCHIVE_FORMAT);
    add_pair(archive, SQL_ADD_META, "spec", petri_spec(archive->session));
    add_pair(archive, SQL_ADD_META, "petri", petri_version());
    add_pair(archive, SQL_ADD_META, "script", script);
    add_pair(archive, SQL_ADD_META, "command", archive->options.command ? archive->options.command : "");
    add_meta_integer(archive, "keyframe_every", archive->options.keyframe_every);
    add_meta_integer(archive, "digest_every", archive->options.digest_every);
    for (size_t i = 0; petri_parameter(archive->session, i, &parameter, sizeof parameter); i++)
        if (parameter.settable)
            add_pair(archive, SQL_ADD_PARAMETER, parameter.name, parameter.value);
}

// Adds a keyframe of the current frame and extends the digest of the run.
static void add_keyframe(PetriArchive *archive, bool given) {
    ArchiveSeal seal = {.previous = -2, .frame = petri_frame_number(archive->session), .given = given};
    char previous[SHA256_DIGITS], sha256[SHA256_DIGITS];
    Str last;
    sqlite3_stmt *before = archive_statement(archive, SQL_LAST_KEYFRAME);
    if (before)
        sqlite3_bind_int64(before, 1, seal.frame);
    if (archive_next(archive, before)) {
        if (!archive_column_integer(archive, before, 0, -1, ARCHIVE_MAX_FRAME, &seal.previous) ||
            !archive_column_text(archive, before, 1, &last) || last.len != SHA256_DIGITS)
            return;
        memcpy(previous, last.bytes, SHA256_DIGITS);
        seal.previous_sha256 = previous;
        sqlite3_reset(before);
    }
    if (archive_fails(archive) ||
        !fail_status(archive, recorder_write(archive->session, RECORDER_SETUP, &seal.setup)) ||
        !fail_status(archive, recorder_write(archive->session, RECORDER_STATE, &seal.state)) ||
        !archive_seal(archive, &seal, sha256))
        return;
    sqlite3_stmt *row = archive_statement(archive, SQL_ADD_KEYFRAME);
    if (!row)
        return;
    sqlite3_bind_int64(row, 1, seal.frame);
    sqlite3_bind_int64(row, 2, given);
    archive_bind_text(row, 3, seal.setup);
    archive_bind_text(row, 4, seal.state);
    archive_bind_text(row, 5, (Str){sha256, SHA256_DIGITS});
    archive_run(archive, row);
    archive->last_keyframe = seal.frame;
}

// Removes the rows after a frame. Versions of files become versions of the next frame, because the session still uses
// them.
static void remove_rows_after(PetriArchive *archive, int64_t frame) {
    char sql[400];
    const char *next = "UPDATE file SET frame = %" PRId64 " WHERE frame > %" PRId64 ";";
    char move[128];
    snprintf(move, sizeof move, next, frame + 1, frame + 1);
    snprintf(sql, sizeof sql,
             "%s DELETE FROM input WHERE frame > %" PRId64 "; DELETE FROM digest WHERE frame > %" PRId64
             "; DELETE FROM keyframe WHERE frame > %" PRId64 "; DELETE FROM note WHERE frame > %" PRId64,
             move, frame, frame, frame, frame);
    archive_execute(archive, sql);
    for (uint32_t i = 0; i < archive->file_count; i++)
        if (archive->files[i].frame > frame + 1)
            archive->files[i].frame = frame + 1;
}

static void on_jump(void *user_data) {
    PetriArchive *archive = user_data;
    if (archive_fails(archive))
        return;
    archive->session_frame = petri_frame_number(archive->session);
    remove_rows_after(archive, archive->session_frame);
    archive->needs_keyframe = true;
}

// --- frames

static PetriStatus before_frame(void *user_data, FrameClock *clock, bool *has_clock) {
    PetriArchive *archive = user_data;
    (void)clock;
    (void)has_clock;
    if (archive_fails(archive))
        return PETRI_OK;
    if (recorder_host_functions(archive->session) > 0)
        archive_fail(archive, "functions, forces and variations of the host cannot be recorded");
    bool first = archive->last_frame == -2;
    flush_configuration(archive);
    if (first)
        add_first_rows(archive);
    if (archive->needs_keyframe)
        add_keyframe(archive, true);
    archive->needs_keyframe = false;
    archive->last_frame = archive->session_frame;
    return PETRI_OK;
}

static void add_clock(PetriArchive *archive, int64_t frame, const FrameClock *clock) {
    char text[7 * NUMBER_TEXT];
    size_t length = 0;
    const double numbers[] = {clock->time,
                              clock->beat,
                              clock->performance,
                              clock->slow_frame,
                              clock->realtime,
                              clock->is_base,
                              archive->mentions_clock ? clock->unix_time : 0};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        if (i > 0)
            text[length++] = ';';
        length += number_format(numbers[i], text + length);
    }
    add_input(archive, frame, "clock", (Str){text, length});
}

static void add_digest(PetriArchive *archive, int64_t frame) {
    uint8_t digest[16];
    if (!fail_status(archive, petri_digest(archive->session, digest)))
        return;
    sqlite3_stmt *row = archive_statement(archive, SQL_ADD_DIGEST);
    if (!row)
        return;
    sqlite3_bind_int64(row, 1, frame);
    sqlite3_bind_blob(row, 2, digest, sizeof digest, SQLITE_STATIC);
    archive_run(archive, row);
}

// Commits if more than a second of frames could be lost when the next frame takes as long as the last one.
static void commit_if_due(PetriArchive *archive) {
    double now = clock_seconds(), last = now - archive->last_frame_end;
    archive->last_frame_end = now;
    if (now - archive->last_commit + last < 0.9)
        return;
    archive_execute(archive, "COMMIT; BEGIN IMMEDIATE");
    archive->last_commit = clock_seconds();
}

static bool knows_file(void *user_data, Str name) {
    return archive_find_file(user_data, name, INT64_MAX);
}

static void after_frame(void *user_data, const FrameClock *clock, bool complete) {
    PetriArchive *archive = user_data;
    int64_t frame = petri_frame_number(archive->session);
    if (archive_fails(archive))
        return;
    if (!complete) {
        archive_fail(archive, "frame %" PRId64 " was aborted", frame);
        return;
    }
    // A signal that interrupts the search ends the run in the next frame.
    PetriStatus drawn =
        archive->mentions_files ? recorder_read_drawn_files(archive->session, knows_file, archive) : PETRI_OK;
    if (drawn != PETRI_INTERRUPTED && !fail_status(archive, drawn))
        return;
    archive->last_frame = archive->session_frame = frame;
    archive->state_modified = archive->has_new_notes = false;
    if (!clock->lockstep)
        add_clock(archive, frame, clock);
    if (frame % archive->options.digest_every == 0)
        add_digest(archive, frame);
    if ((frame + 1) % archive->options.keyframe_every == 0)
        add_keyframe(archive, false);
    commit_if_due(archive);
}

// --- opening and closing

// Removes inputs that no frame has used, and adds a keyframe if the last frame has none, so that the digest of the run
// covers all frames. There is no keyframe if the host has modified the state since the last frame.
static void complete(PetriArchive *archive) {
    char sql[200];
    if (archive_fails(archive))
        return;
    int64_t last = archive->last_frame;
    if (last >= 0 && !archive->needs_keyframe) {
        snprintf(sql, sizeof sql,
                 "DELETE FROM file WHERE frame > %" PRId64 "; UPDATE note SET frame = %" PRId64
                 " WHERE frame > %" PRId64,
                 last, last, last);
        archive_execute(archive, sql);
        remove_rows_after(archive, last);
        if ((archive->last_keyframe != last || archive->has_new_notes) && !archive->state_modified)
            add_keyframe(archive, false);
    }
    archive_execute(archive, "COMMIT");
}

// Another recording or a replay begins, or the session is closed.
static void on_end(void *user_data) {
    PetriArchive *archive = user_data;
    complete(archive);
    archive->session = NULL;
    archive_close_database(archive); // the file can be recorded again
}

PetriArchive *petri_archive_create(PetriSession *session, const char *file, const PetriArchiveOptions *options) {
    PetriArchive *archive = session && file ? archive_new() : NULL;
    if (!archive)
        return NULL;
    archive->session = session;
    archive->writes = archive->needs_keyframe = true;
    archive->last_frame = archive->last_keyframe = -2;
    archive->session_frame = petri_frame_number(session);
    petri_archive_options_init(&archive->options, sizeof archive->options);
    if (options && !host_struct_read(&archive->options, sizeof archive->options, options))
        archive_fail(archive, "the options are not valid");
    if (archive->options.keyframe_every < 1 || archive->options.digest_every < 1)
        archive_fail(archive, "the options are not valid");
    const char *command = archive->options.command;
    archive->strings[0] = command ? heap_strndup(command, strlen(command)) : NULL;
    archive->options.command = archive->strings[0];
    if (!archive_fails(archive) && archive_claim_file(archive, file))
        archive_create_database(archive, file);
    archive->last_frame_end = archive->last_commit = clock_seconds();
    archive->revision = UINT64_MAX;
    recorder_set(session, &(Recorder){.user_data = archive,
                                      .before_frame = before_frame,
                                      .after_frame = after_frame,
                                      .jump = on_jump,
                                      .input = on_input,
                                      .file = on_file,
                                      .end = on_end});
    if (!archive_fails(archive) && recorder_has_script(session))
        fail_status(archive, recorder_read_again(session));
    return archive;
}

PetriStatus petri_archive_add_note(PetriArchive *archive, const char *text) {
    if (!archive || !text || !archive->writes || !archive->session || utf8_find_error(str_from(text)) < strlen(text))
        return PETRI_INVALID;
    sqlite3_stmt *row = archive_statement(archive, SQL_ADD_NOTE);
    if (row)
        sqlite3_bind_int64(row, 1, next_frame(archive));
    archive_bind_text(row, 2, str_from(text));
    archive->has_new_notes = true;
    return archive_run(archive, row) ? PETRI_OK : PETRI_INVALID;
}

PetriStatus petri_archive_complete(PetriArchive *archive) {
    if (!archive || !archive->writes)
        return PETRI_INVALID;
    if (archive->session)
        recorder_set(archive->session, NULL); // calls on_end
    return archive_fails(archive) ? PETRI_INVALID : PETRI_OK;
}
