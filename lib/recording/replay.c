// replay.c: replays of archives, and checks for damage.
#include "base/heap.h"
#include "base/number.h"
#include "recording/archive.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Returns the status of a call after its last query. Clears an interrupt, which has ended the call.
static PetriStatus finish(PetriArchive *archive, PetriStatus status) {
    if (archive->interrupted) {
        petri_clear_interrupt(archive->session);
        return PETRI_INTERRUPTED;
    }
    return archive_fails(archive) && status == PETRI_OK ? PETRI_INVALID : status;
}

// A keyframe that was read. Its texts are copies, because the session can read further rows while it uses them.
typedef struct KeyframeTexts {
    char *setup;
    char *state;
    Str setup_text;
    Str state_text;
    char sha256[SHA256_DIGITS];
} KeyframeTexts;

static void free_keyframe(PetriArchive *archive, KeyframeTexts *texts) {
    archive->memory -= texts->setup_text.len + texts->state_text.len;
    heap_free(texts->setup);
    heap_free(texts->state);
    *texts = (KeyframeTexts){0};
}

// Reads the text in the first column of a keyframe, which the caller frees. Charges its memory. Returns NULL after a
// problem.
static char *read_text(PetriArchive *archive, ArchiveStatement number, int64_t frame, Str *text, char *sha256) {
    Str value, sum;
    char *copy = NULL;
    sqlite3_stmt *row = archive_statement(archive, number);
    if (row)
        sqlite3_bind_int64(row, 1, frame);
    if (!archive_next(archive, row)) {
        archive_fail(archive, "the archive is damaged: table keyframe: row %" PRId64 " is missing", frame);
        return NULL;
    }
    if (!archive_column_text(archive, row, 0, &value) || (sha256 && !archive_column_text(archive, row, 1, &sum)))
        return NULL;
    if (sha256 && sum.len != SHA256_DIGITS)
        archive_fail(archive, "the archive is damaged: table keyframe: row %" PRId64 " is not valid", frame);
    else if (sha256)
        memcpy(sha256, sum.bytes, SHA256_DIGITS);
    if (!archive_fails(archive) && archive_reserve(archive, value.len)) {
        copy = heap_strndup(value.bytes, value.len);
        archive->memory -= copy ? 0 : value.len;
        if (!copy)
            archive_fail(archive, "out of memory");
    }
    *text = (Str){copy, copy ? value.len : 0};
    sqlite3_reset(row); // frees the value
    return copy;
}

// Reads a keyframe, which the caller frees. Returns false after a problem.
static bool read_keyframe(PetriArchive *archive, int64_t frame, KeyframeTexts *texts) {
    *texts = (KeyframeTexts){0};
    texts->setup = read_text(archive, SQL_KEYFRAME_SETUP, frame, &texts->setup_text, texts->sha256);
    texts->state = texts->setup ? read_text(archive, SQL_KEYFRAME_STATE, frame, &texts->state_text, NULL) : NULL;
    if (!texts->state)
        free_keyframe(archive, texts);
    return texts->state;
}

static PetriStatus restore_keyframe(PetriArchive *archive, PetriSession *session, int64_t frame) {
    KeyframeTexts texts;
    archive->replay_frame = frame + 1;
    if (!read_keyframe(archive, frame, &texts))
        return PETRI_INVALID;
    PetriStatus status = recorder_restore(session, texts.setup_text, texts.state_text);
    free_keyframe(archive, &texts);
    if (status == PETRI_OK && petri_frame_number(session) != frame)
        status = PETRI_INVALID;
    if (status == PETRI_INVALID)
        archive_fail(archive, "the archive is damaged: table keyframe: row %" PRId64 " is not valid", frame);
    return status;
}

uint32_t archive_keyframes_until(const PetriArchive *archive, int64_t frame) {
    uint32_t from = 0, to = archive->keyframe_count;
    while (from < to) {
        uint32_t middle = from + (to - from) / 2;
        if (archive->keyframes[middle].frame <= frame)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

int64_t archive_segment_end(const PetriArchive *archive, uint32_t number) {
    if (number + 1 == archive->keyframe_count)
        return archive->recorded_end;
    // The frames before a given keyframe need not reach it.
    const ArchiveKeyframe *next = &archive->keyframes[number + 1];
    return next->given ? archive->keyframes[number].end : next->frame;
}

// Returns the last keyframe at or before `frame`, or the first one; NULL: there are none.
static const ArchiveKeyframe *find_keyframe(const PetriArchive *archive, int64_t frame) {
    uint32_t count = archive_keyframes_until(archive, frame);
    return archive->keyframe_count > 0 ? &archive->keyframes[count > 0 ? count - 1 : 0] : NULL;
}

// --- gaps

// Returns how many of the frames up to `frame` have a digest; only differences of these numbers have a meaning.
static int64_t digests_until(int64_t frame, int64_t digest_every) {
    return frame < 0 ? -1 : frame / digest_every;
}

// Checks that no keyframes and digests are missing. Otherwise a single row of a distant frame would let a replay
// compute all frames before it.
static bool check_gaps(PetriArchive *archive) {
    if (archive->keyframe_count == 0)
        return true; // no frame was committed
    int64_t keyframe_every = archive_meta_integer(archive, "keyframe_every");
    int64_t digest_every = archive_meta_integer(archive, "digest_every");
    if (archive_fails(archive) || keyframe_every < 1 || digest_every < 1)
        return archive_fail(archive, "the archive is damaged: table meta: the number of frames is not valid");
    for (uint32_t i = 0; i < archive->keyframe_count; i++) {
        const ArchiveKeyframe *keyframe = &archive->keyframes[i];
        int64_t end = archive_segment_end(archive, i);
        int64_t missing =
            digests_until(end, digest_every) - digests_until(keyframe->frame, digest_every) - keyframe->digests;
        if (missing > 0)
            return archive_fail(
                archive, "the archive is damaged: table digest: %" PRId64 " rows are missing after frame %" PRId64,
                missing, keyframe->frame);
        if (end - keyframe->frame > keyframe_every)
            return archive_fail(archive,
                                "the archive is damaged: table keyframe: rows are missing after frame %" PRId64,
                                keyframe->frame);
    }
    return true;
}

// --- frames

// Reads the numbers of a recorded clock, separated by semicolons.
static bool read_clock(Str text, FrameClock *clock) {
    double numbers[7];
    for (size_t i = 0, at = 0; i < 7; i++) {
        size_t end = at;
        while (end < text.len && text.bytes[end] != ';')
            end++;
        char digits[NUMBER_TEXT];
        if (end == at || end - at >= sizeof digits || (i == 6) != (end == text.len))
            return false;
        memcpy(digits, text.bytes + at, end - at);
        digits[end - at] = '\0';
        if (digits[strspn(digits, "0123456789+-.e")] != '\0')
            return false;
        numbers[i] = number_parse((Str){digits, end - at});
        if (!isfinite(numbers[i]))
            return false;
        at = end + 1;
    }
    *clock = (FrameClock){.time = numbers[0],
                          .beat = numbers[1],
                          .performance = numbers[2],
                          .slow_frame = numbers[3] != 0,
                          .realtime = numbers[4] != 0,
                          .is_base = numbers[5] != 0,
                          .unix_time = numbers[6]};
    return true;
}

// Gives the inputs of a frame to the session.
static PetriStatus apply_inputs(PetriArchive *archive, int64_t frame, FrameClock *clock) {
    Str kind, payload;
    int64_t id = -1;
    sqlite3_stmt *rows = archive_statement(archive, SQL_INPUTS);
    if (rows)
        sqlite3_bind_int64(rows, 1, frame);
    while (archive_next_in_order(archive, rows, 2, INT64_MAX, &id)) {
        if (!archive_column_text(archive, rows, 0, &kind) || !archive_column_text(archive, rows, 1, &payload))
            return PETRI_INVALID;
        PetriStatus status = str_equal(kind, STR("clock")) ? read_clock(payload, clock) ? PETRI_OK : PETRI_INVALID
                                                           : recorder_apply_input(archive->session, kind, payload);
        if (status == PETRI_INVALID)
            archive_fail(archive, "the archive is damaged: table input: a row of frame %" PRId64 " is not valid",
                         frame);
        if (status != PETRI_OK)
            return status;
    }
    return PETRI_OK;
}

static PetriStatus begin_frame(PetriArchive *archive, FrameClock *clock, bool *has_clock) {
    int64_t frame = petri_frame_number(archive->session);
    const ArchiveKeyframe *keyframe = find_keyframe(archive, frame);
    if (archive_fails(archive))
        return PETRI_INVALID;
    if (keyframe && keyframe->given && keyframe->frame == frame && !archive->at_keyframe) {
        PetriStatus status = restore_keyframe(archive, archive->session, frame);
        if (status != PETRI_OK)
            return status;
    }
    archive->at_keyframe = false;
    archive->replay_frame = frame + 1;
    recorder_ignore_input(archive->session, false);
    if (frame >= archive->recorded_end)
        return PETRI_OK; // the run continues after its recorded frames
    *clock = (FrameClock){.lockstep = true};
    *has_clock = true;
    PetriStatus status = apply_inputs(archive, frame + 1, clock);
    recorder_ignore_input(archive->session, true);
    return status;
}

static PetriStatus before_frame(void *user_data, FrameClock *clock, bool *has_clock) {
    PetriArchive *archive = user_data;
    archive_begin(archive);
    return finish(archive, begin_frame(archive, clock, has_clock));
}

// Another state was loaded: if a keyframe with a given state follows its frame, the next frame begins with that one.
static void after_jump(void *user_data) {
    ((PetriArchive *)user_data)->at_keyframe = false;
}

// The session is closed, or is recorded or replayed by another archive.
static void on_end(void *user_data) {
    ((PetriArchive *)user_data)->session = NULL;
}

PetriStatus petri_archive_load(PetriArchive *archive, PetriSession *session, int64_t frame) {
    if (!archive || !session || archive->writes)
        return PETRI_INVALID;
    archive_begin(archive);
    const ArchiveKeyframe *keyframe = find_keyframe(archive, frame);
    if (!keyframe)
        archive_fail(archive, "the archive has no frames");
    if (archive_fails(archive) || !check_gaps(archive))
        return PETRI_INVALID;
    petri_archive_end_replay(archive);
    recorder_set(session, NULL);
    archive->session = session;
    PetriStatus status = finish(archive, restore_keyframe(archive, session, keyframe->frame));
    archive->at_keyframe = true;
    recorder_set(session, &(Recorder){.user_data = archive,
                                      .before_frame = before_frame,
                                      .jump = after_jump,
                                      .end = on_end,
                                      .ignores_input = true});
    return status;
}

PetriStatus petri_archive_replay(PetriArchive *archive, PetriSession *session, int64_t frame) {
    PetriStatus status = petri_archive_load(archive, session, frame - (frame > INT64_MIN));
    while (status == PETRI_OK && petri_frame_number(session) < frame)
        status = petri_step(session);
    return status;
}

void petri_archive_end_replay(PetriArchive *archive) {
    if (archive && archive->session && !archive->writes)
        recorder_set(archive->session, NULL); // calls on_end
}

// Takes the next line, without its end, from a text.
static Str next_line(Str *text) {
    const char *end = memchr(text->bytes, '\n', text->len);
    size_t length = end ? (size_t)(end - text->bytes) : text->len, skipped = length + (end ? 1 : 0);
    Str line = {text->bytes, length};
    *text = (Str){text->bytes + skipped, text->len - skipped};
    return line;
}

static int compare_lines(const void *a, const void *b) {
    return str_compare(*(const Str *)a, *(const Str *)b);
}

// Returns the lines of a state file, without those that depend on its form, on the version of the specification or on
// the other lines. The caller frees them with heap_free. Returns NULL if out of memory.
static Str *state_lines(Str text, bool sorted, size_t *count) {
    size_t capacity = 1;
    for (Str rest = text; rest.len > 0; capacity++)
        next_line(&rest);
    Str *lines = heap_calloc(capacity, sizeof *lines);
    *count = 0;
    for (Str rest = text; rest.len > 0 && lines;) {
        Str line = next_line(&rest);
        if (!str_starts_with(line, STR("petri-state ")) && !str_starts_with(line, STR("spec ")) &&
            !str_starts_with(line, STR("end ")))
            lines[(*count)++] = line;
    }
    if (lines && sorted)
        qsort(lines, *count, sizeof *lines, compare_lines);
    return lines;
}

// Returns true if two state files have the same state. Petri 0.3 wrote the lines in another order. The rules by which
// the states were computed may differ.
static bool states_equal(PetriArchive *archive, Str recorded, Str computed) {
    if (str_equal(recorded, computed))
        return true;
    bool sorted = str_starts_with(recorded, STR("petri-state 1\n"));
    size_t count[2];
    Str *lines[] = {state_lines(recorded, sorted, &count[0]), state_lines(computed, sorted, &count[1])};
    if (!lines[0] || !lines[1])
        archive_fail(archive, "out of memory");
    bool same = lines[0] && lines[1] && count[0] == count[1];
    for (size_t i = 0; same && i < count[0]; i++)
        same = str_equal(lines[0][i], lines[1][i]);
    heap_free(lines[0]);
    heap_free(lines[1]);
    return same;
}

bool petri_archive_keyframe_differs(PetriArchive *archive) {
    PetriSession *session = archive ? archive->session : NULL;
    KeyframeTexts texts;
    Str setup, state;
    int64_t frame = petri_frame_number(session);
    const ArchiveKeyframe *keyframe = session && !archive->writes ? find_keyframe(archive, frame) : NULL;
    if (!keyframe || keyframe->given || keyframe->frame != frame)
        return false;
    archive_begin(archive);
    if (!read_keyframe(archive, frame, &texts))
        return false;
    // Inputs that followed the last frame can have changed the setup of the last keyframe.
    bool last = keyframe == &archive->keyframes[archive->keyframe_count - 1];
    bool same = recorder_write(session, RECORDER_SETUP, &setup) == PETRI_OK &&
                recorder_write(session, RECORDER_STATE, &state) == PETRI_OK &&
                (last || str_equal(setup, texts.setup_text)) && states_equal(archive, texts.state_text, state);
    free_keyframe(archive, &texts);
    return !same;
}

// --- checks

// Computes the digest of each keyframe again. Returns false after a problem.
static bool check_seals(PetriArchive *archive) {
    char sha256[SHA256_DIGITS], previous[SHA256_DIGITS];
    ArchiveSeal seal = {.previous = -2};
    for (uint32_t i = 0; i < archive->keyframe_count; i++) {
        KeyframeTexts texts;
        seal.frame = archive->keyframes[i].frame;
        seal.given = archive->keyframes[i].given;
        if (!read_keyframe(archive, seal.frame, &texts))
            return false;
        seal.setup = texts.setup_text;
        seal.state = texts.state_text;
        bool good = archive_seal(archive, &seal, sha256), same = memcmp(sha256, texts.sha256, SHA256_DIGITS) == 0;
        memcpy(previous, texts.sha256, SHA256_DIGITS);
        free_keyframe(archive, &texts);
        if (!good)
            return false;
        if (!same)
            return archive_fail(archive,
                                "the archive is damaged: table keyframe: row %" PRId64 " has another SHA-256 than the "
                                "rows after frame %" PRId64 " up to it",
                                seal.frame, seal.previous < 0 ? 0 : seal.previous);
        seal.previous = seal.frame;
        seal.previous_sha256 = previous;
    }
    return true;
}

// Checks the rows after the last keyframe, which no digest of the run covers.
static bool check_rest(PetriArchive *archive) {
    char sha256[SHA256_DIGITS], previous[SHA256_DIGITS] = "";
    int64_t last = archive->keyframe_count > 0 ? archive->keyframes[archive->keyframe_count - 1].frame : -2;
    ArchiveSeal rest = {.previous = last, .previous_sha256 = previous, .frame = INT64_MAX};
    return archive_seal(archive, &rest, sha256);
}

static bool check_pages(PetriArchive *archive) {
    sqlite3_stmt *statement = NULL;
    int result = sqlite3_prepare_v2(archive->database, "PRAGMA integrity_check(1)", -1, &statement, NULL);
    if (result == SQLITE_OK)
        result = sqlite3_step(statement);
    const char *text = result == SQLITE_ROW ? (const char *)sqlite3_column_text(statement, 0) : NULL;
    bool good = text && strcmp(text, "ok") == 0;
    const char *line = text ? strchr(text, '\n') : NULL; // the first line names the database
    if (text && !good)
        archive_fail(archive, "the archive is damaged: %s", line ? line + 1 : text);
    else if (!good)
        archive_fail_sqlite(archive, result);
    sqlite3_finalize(statement);
    return good;
}

PetriStatus petri_archive_check(PetriArchive *archive) {
    if (!archive || archive->writes)
        return PETRI_INVALID;
    archive_begin(archive);
    if (archive_fails(archive) || !check_gaps(archive) || !check_pages(archive))
        return finish(archive, PETRI_INVALID);
    for (uint32_t i = 0; i < archive->file_count; i++) {
        ArchiveFile *file = &archive->files[i];
        bool loaded = file->bytes;
        if (!archive_load_file(archive, file))
            return finish(archive, PETRI_INVALID);
        if (loaded || !file->bytes)
            continue;
        archive->memory -= file->length; // a replay reads the file again if it needs it
        heap_free(file->bytes);
        file->bytes = NULL;
    }
    bool good = archive_begin_seals(archive) && check_seals(archive) && check_rest(archive);
    archive_end_seals(archive);
    return finish(archive, good ? PETRI_OK : PETRI_INVALID);
}
