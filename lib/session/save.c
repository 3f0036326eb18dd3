// save.c: state files (petri_save, petri_restore).
//
// A state file is line-based text, so that users can read and compare it:
//
//     petri-state 1
//     frame 99
//     $(:cells;0) = 12.5;-3                 every entry of the dictionary
//     system 0 $(:cells)                    each system: its index among systems with the same prefix,
//     particle $(:cells;0)                  then the position key of each particle, in order
//     end 1f0e6c9d7a5b4832                  hash of all bytes before this line
//
// Values are in the language's printed form, which reads back as the same doubles. The hash detects files that were
// truncated or edited.
#include "base/file.h"
#include "base/number.h"
#include "session/session.h"
#include "session/state_text.h"
#include "session/value_reader.h"
#include "value/format.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define HEADER "petri-state 1\n"
// Highest frame number that can be restored. It is low enough that later frame numbers cannot overflow.
#define MAX_FRAMES INT64_C(100000000000000000)
#define MAX_STATE_BYTES (SIZE_MAX > UINT32_MAX ? (size_t)(UINT64_C(8) << 30) : (size_t)1 << 30)

static void add_key(Text *out, const PetriSession *session, Value key) {
    text_add_c(out, "$(");
    format_value(out, &session->symbols, key);
    text_add_char(out, ')');
}

// Adds the entries in canonical order (spec digest.md 2), so that equal states have equal files.
static void add_entries(Text *out, const PetriSession *session) {
    uint32_t cursor = 0;
    double buffer[STATE_KEY_BUFFER];
    if (state_digest_is_stale(session->state))
        arena_charge(out->arena, state_slot_count(session->state));
    for (Value key, value; state_next(session->state, &cursor, &key, &value, buffer);) {
        add_key(out, session, key);
        text_add_c(out, " = ");
        format_value(out, &session->symbols, value);
        text_add_char(out, '\n');
    }
    if (state_clear_exhausted(session->state))
        arena_exhausted(out->arena);
}

static void add_systems(Text *out, const PetriSession *session) {
    const void *cursor = NULL;
    double buffer[STATE_KEY_BUFFER];
    for (SceneSystem system; scene_next_system(session->scene, &cursor, &system);) {
        text_add_format(out, "system %u ", system.occurrence);
        add_key(out, session, state_slot_key_in(session->state, system.prefix, buffer));
        text_add_char(out, '\n');
        for (uint32_t i = 0; i < system.slot_count; i += 2) {
            text_add_c(out, "particle ");
            add_key(out, session, state_slot_key_in(session->state, system.slots[i], buffer));
            text_add_char(out, '\n');
        }
    }
}

static void report_state_error(PetriSession *session, const char *what, const char *file, const char *reason) {
    session_report_text(session, DIAG_ERROR, "state-file",
                        str_format(&session->text_arena, "%s '%s': %s", what, file, reason));
}

Str session_write_state(PetriSession *session) {
    Text out = text_new(&session->text_arena);
    text_add_c(&out, HEADER);
    text_add_format(&out, "frame %lld\n", (long long)session->clock.number);
    add_entries(&out, session);
    add_systems(&out, session);
    text_add_format(&out, "end %016" PRIx64 "\n", hash_bytes(0, out.bytes, out.len));
    return text_str(&out);
}

static PetriStatus save_state(PetriSession *session, void *context) {
    const char *file = context, *problem = file_replace(file, session_write_state(session), 0);
    if (problem)
        report_state_error(session, "cannot write the state to", file, problem);
    return problem ? PETRI_INVALID : PETRI_OK;
}

PetriStatus petri_save(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    ArenaMark mark = arena_mark(&session->text_arena);
    PetriStatus status = session_protect(session, NULL, save_state, (void *)file);
    arena_rewind(&session->text_arena, mark);
    return status;
}

// A state file that is being read.
typedef struct Restore {
    ValueReader in;
    State *state; // the new dictionary
    Incoming *incoming;
    int64_t frame;
    uint32_t omitted; // number of entries ignored because they are not finite; versions before 0.2.0 could save them
} Restore;

static bool read_key(Restore *restore, StateSlot *slot) {
    Value key;
    if (!value_reader_skip(&restore->in, STR("$(")) || !value_reader_read(&restore->in, &key) ||
        !value_reader_skip(&restore->in, STR(")")))
        return false;
    *slot = state_slot(restore->state, key);
    return *slot != STATE_NO_SLOT;
}

static bool read_entry(Restore *restore) {
    StateSlot slot;
    Value value;
    if (!read_key(restore, &slot) || !value_reader_skip(&restore->in, STR(" = ")) ||
        !value_reader_read(&restore->in, &value) || !value_reader_skip(&restore->in, STR("\n")))
        return false;
    if (value.kind == VALUE_NUMBERS && !numbers_finite(value_numbers(&value), value.len, 1)) {
        restore->omitted++;
        return true;
    }
    return state_slot_set(restore->state, slot, value);
}

static bool read_integer(Restore *restore, int64_t *x) {
    enum { MAX_DIGITS = 18 };
    bool negative = value_reader_skip(&restore->in, STR("-"));
    size_t len = 0;
    *x = 0;
    for (; len < restore->in.rest.len && restore->in.rest.bytes[len] >= '0' && restore->in.rest.bytes[len] <= '9';
         len++) {
        if (len == MAX_DIGITS)
            return false;
        *x = *x * 10 + (restore->in.rest.bytes[len] - '0');
    }
    *x = negative ? -*x : *x;
    restore->in.rest = (Str){restore->in.rest.bytes + len, restore->in.rest.len - len};
    return len > 0;
}

// Returns the slot of the velocity that belongs to a position.
static StateSlot velocity_slot(Restore *restore, StateSlot position) {
    double buffer[STATE_KEY_BUFFER]; // without it, all keys of a range would be written to memory for each particle
    Vector key = vector_new(restore->in.arena);
    vector_add(&key, state_slot_key_in(restore->state, position, buffer));
    vector_add_number(&key, symbol_number(STR("velocity")));
    return state_slot(restore->state, vector_finish(&key));
}

static bool read_system(Restore *restore) {
    int64_t occurrence;
    uint32_t capacity = 0; // always even, so there is room for both slots of a particle, position and velocity
    SceneSystem system = {0};
    if (!read_integer(restore, &occurrence) || !value_reader_skip(&restore->in, STR(" ")) ||
        !read_key(restore, &system.prefix) || !value_reader_skip(&restore->in, STR("\n")))
        return false;
    if (occurrence < 0 || occurrence > UINT32_MAX)
        return false;
    system.occurrence = (uint32_t)occurrence;
    StateSlot *slots = NULL;
    while (value_reader_skip(&restore->in, STR("particle "))) {
        slots = arena_grow_array(restore->in.arena, slots, system.slot_count, &capacity, sizeof *slots);
        if (!read_key(restore, &slots[system.slot_count]) || !value_reader_skip(&restore->in, STR("\n")))
            return false;
        slots[system.slot_count + 1] = velocity_slot(restore, slots[system.slot_count]);
        system.slot_count += 2;
    }
    system.slots = slots;
    checkpoint_restore_system(restore->in.session, restore->incoming, &system);
    return true;
}

// Removes the last line, which contains a hash. Returns true if the hash matches the remaining text.
static bool hash_matches(Str *text) {
    enum { END = sizeof "end 0123456789abcdef\n" - 1 };
    if (text->len < END)
        return false;
    Str body = {text->bytes, text->len - END};
    char line[END + 1];
    snprintf(line, sizeof line, "end %016" PRIx64 "\n", hash_bytes(0, body.bytes, body.len));
    bool same = str_equal(str_from(line), (Str){text->bytes + body.len, END});
    *text = body;
    return same;
}

static bool read_body(Restore *restore) {
    if (!value_reader_skip(&restore->in, STR(HEADER)) || !value_reader_skip(&restore->in, STR("frame ")) ||
        !read_integer(restore, &restore->frame) || restore->frame < -1 || restore->frame > MAX_FRAMES ||
        !value_reader_skip(&restore->in, STR("\n")))
        return false;
    while (str_starts_with(restore->in.rest, STR("$")))
        if (!read_entry(restore))
            return false;
    while (value_reader_skip(&restore->in, STR("system ")))
        if (!read_system(restore))
            return false;
    return restore->in.rest.len == 0;
}

// Reads the text of a state file. Returns NULL on success, else the reason for the failure.
static const char *restore_text(Restore *restore) {
    if (!str_starts_with(restore->in.rest, STR("petri-state ")))
        return "not a petri state file";
    if (!str_starts_with(restore->in.rest, STR(HEADER)))
        return "written by another version of petri";
    bool good = utf8_find_error(restore->in.rest) == restore->in.rest.len && hash_matches(&restore->in.rest);
    return good && read_body(restore) ? NULL : "file is truncated or corrupt";
}

const char *session_read_state(PetriSession *session, Incoming *incoming, Str text, int64_t *frame, uint32_t *omitted) {
    Arena *arena = &incoming->arena;
    Restore restore = {.in = {session, arena, text}, .state = incoming->state, .incoming = incoming};
    const char *reason = restore_text(&restore);
    if (state_clear_exhausted(incoming->state)) // running out of memory must not be reported as a corrupt file
        arena_exhausted(arena);
    *frame = restore.frame;
    *omitted = restore.omitted;
    return reason;
}

static PetriStatus read_state_file(PetriSession *session, Incoming *incoming, void *context) {
    const char *file = context, *reason = NULL;
    int64_t frame = 0;
    uint32_t omitted = 0;
    Str text;
    if (file_read(&incoming->arena, NULL, file, true, MAX_STATE_BYTES, &text, NULL, &reason))
        reason = session_read_state(session, incoming, text, &frame, &omitted);
    if (omitted && !reason)
        session_report_text(session, DIAG_WARNING, "state-file",
                            str_format(&session->text_arena,
                                       "'%s' contains values that are not finite; number of ignored values: %u", file,
                                       omitted));
    if (reason)
        report_state_error(session, "cannot load the state from", file, reason);
    else
        clock_resume(&incoming->clock, frame);
    return reason ? PETRI_INVALID : PETRI_OK;
}

PetriStatus petri_restore(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    if (!file_exists(file))
        return PETRI_OK;
    PetriStatus status = checkpoint_replace(session, read_state_file, (void *)file);
    if (status == PETRI_OK) {
        session_change_config(session, false);
        recorder_jump(session);
    }
    return status;
}
