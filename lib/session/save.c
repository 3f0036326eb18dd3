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
#include "ast/literal.h"
#include "base/file.h"
#include "base/number.h"
#include "session/session.h"
#include "value/format.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define HEADER "petri-state 1\n"
// Highest frame number that can be restored. It is low enough that later frame numbers cannot overflow.
#define MAX_FRAMES INT64_C(100000000000000000)
#define MAX_STATE_BYTES ((size_t)8 << 30)

static void add_key(Text *out, const PetriSession *session, Value key) {
    text_add_c(out, "$(");
    format_value(out, &session->symbols, key);
    text_add_char(out, ')');
}

static void add_entries(Text *out, const PetriSession *session) {
    uint32_t cursor = 0;
    double buffer[STATE_KEY_BUFFER];
    for (Value key, value; state_next(session->state, &cursor, &key, &value, buffer);) {
        add_key(out, session, key);
        text_add_c(out, " = ");
        format_value(out, &session->symbols, value);
        text_add_char(out, '\n');
    }
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

static PetriStatus save_state(PetriSession *session, void *context) {
    const char *file = context;
    Text out = text_new(&session->text_arena);
    text_add_c(&out, HEADER);
    text_add_format(&out, "frame %lld\n", (long long)session->clock.number);
    add_entries(&out, session);
    add_systems(&out, session);
    text_add_format(&out, "end %016" PRIx64 "\n", hash_bytes(0, out.bytes, out.len));
    const char *problem = file_replace(file, text_str(&out), 0);
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
    PetriSession *session;
    Arena *arena;
    Str rest;     // text not read yet
    State *state; // the new dictionary
    Incoming *incoming;
    int64_t frame;
    uint32_t omitted; // number of entries ignored because they are not finite; versions before 0.2.0 could save them
} Restore;

static bool consume_prefix(Restore *restore, Str prefix) {
    if (!str_starts_with(restore->rest, prefix))
        return false;
    restore->rest = (Str){restore->rest.bytes + prefix.len, restore->rest.len - prefix.len};
    return true;
}

// Returns the length of the element at the start of `rest`: a quoted string, or everything up to ";", ")", a space or
// the end of the line. Returns 0 if a string is not terminated.
static size_t element_length(Str rest) {
    size_t at = 0;
    char quote = rest.len && (rest.bytes[0] == '\'' || rest.bytes[0] == '"') ? rest.bytes[0] : 0;
    if (!quote) {
        while (at < rest.len && !strchr(";) \n", rest.bytes[at]))
            at++;
        return at;
    }
    for (at = 1; at < rest.len && rest.bytes[at] != quote; at++)
        at += rest.bytes[at] == '\\';
    return at < rest.len ? at + 1 : 0;
}

static bool read_element(Restore *restore, Vector *vector) {
    size_t len = element_length(restore->rest);
    Str text = {restore->rest.bytes, len};
    double x;
    if (len == 0)
        return false;
    restore->rest = (Str){restore->rest.bytes + len, restore->rest.len - len};
    if (text.bytes[0] == ':') {
        const Symbol *symbol = symbol_register(&restore->session->symbols, (Str){text.bytes + 1, len - 1});
        if (symbol)
            vector_add_number(vector, symbol->number);
        return symbol;
    }
    if (text.bytes[0] == '\'' || text.bytes[0] == '"') {
        Str string;
        if (literal_string(restore->arena, text, &string))
            return false;
        vector_add(vector, value_string(restore->arena, string));
        return true;
    }
    if (!literal_parse_number(text, &x))
        return false;
    vector_add_number(vector, x);
    return true;
}

static bool read_value(Restore *restore, Value *value) {
    Vector vector = vector_new(restore->arena);
    if (!consume_prefix(restore, STR("null"))) {
        do
            if (!read_element(restore, &vector))
                return false;
        while (consume_prefix(restore, STR(";")));
    }
    *value = vector_finish(&vector);
    return true;
}

static bool read_key(Restore *restore, StateSlot *slot) {
    Value key;
    if (!consume_prefix(restore, STR("$(")) || !read_value(restore, &key) || !consume_prefix(restore, STR(")")))
        return false;
    *slot = state_slot(restore->state, key);
    return *slot != STATE_NO_SLOT;
}

static bool read_entry(Restore *restore) {
    StateSlot slot;
    Value value;
    if (!read_key(restore, &slot) || !consume_prefix(restore, STR(" = ")) || !read_value(restore, &value) ||
        !consume_prefix(restore, STR("\n")))
        return false;
    if (value.kind == VALUE_NUMBERS && !numbers_finite(value_numbers(&value), value.len, 1)) {
        restore->omitted++;
        return true;
    }
    return state_slot_set(restore->state, slot, value);
}

static bool read_integer(Restore *restore, int64_t *x) {
    enum { MAX_DIGITS = 18 };
    bool negative = consume_prefix(restore, STR("-"));
    size_t len = 0;
    *x = 0;
    for (; len < restore->rest.len && restore->rest.bytes[len] >= '0' && restore->rest.bytes[len] <= '9'; len++) {
        if (len == MAX_DIGITS)
            return false;
        *x = *x * 10 + (restore->rest.bytes[len] - '0');
    }
    *x = negative ? -*x : *x;
    restore->rest = (Str){restore->rest.bytes + len, restore->rest.len - len};
    return len > 0;
}

// Returns the slot of the velocity that belongs to a position.
static StateSlot velocity_slot(Restore *restore, StateSlot position) {
    Vector key = vector_new(restore->arena);
    vector_add(&key, state_slot_key(restore->state, position));
    vector_add_number(&key, symbol_number(STR("velocity")));
    return state_slot(restore->state, vector_finish(&key));
}

static bool read_system(Restore *restore) {
    int64_t occurrence;
    uint32_t capacity = 0; // always even, so there is room for both slots of a particle, position and velocity
    SceneSystem system = {0};
    if (!read_integer(restore, &occurrence) || !consume_prefix(restore, STR(" ")) ||
        !read_key(restore, &system.prefix) || !consume_prefix(restore, STR("\n")))
        return false;
    if (occurrence < 0 || occurrence > UINT32_MAX)
        return false;
    system.occurrence = (uint32_t)occurrence;
    StateSlot *slots = NULL;
    while (consume_prefix(restore, STR("particle "))) {
        slots = arena_grow_array(restore->arena, slots, system.slot_count, &capacity, sizeof *slots);
        if (!read_key(restore, &slots[system.slot_count]) || !consume_prefix(restore, STR("\n")))
            return false;
        slots[system.slot_count + 1] = velocity_slot(restore, slots[system.slot_count]);
        system.slot_count += 2;
    }
    system.slots = slots;
    checkpoint_restore_system(restore->session, restore->incoming, &system);
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
    if (!consume_prefix(restore, STR(HEADER)) || !consume_prefix(restore, STR("frame ")) ||
        !read_integer(restore, &restore->frame) || restore->frame < -1 || restore->frame > MAX_FRAMES ||
        !consume_prefix(restore, STR("\n")))
        return false;
    while (str_starts_with(restore->rest, STR("$")))
        if (!read_entry(restore))
            return false;
    while (consume_prefix(restore, STR("system ")))
        if (!read_system(restore))
            return false;
    return restore->rest.len == 0;
}

// Reads the text of a state file. Returns NULL on success, else the reason for the failure.
static const char *restore_text(Restore *restore) {
    if (!str_starts_with(restore->rest, STR("petri-state ")))
        return "not a petri state file";
    if (!str_starts_with(restore->rest, STR(HEADER)))
        return "written by another version of petri";
    bool good = utf8_find_error(restore->rest) == restore->rest.len && hash_matches(&restore->rest);
    return good && read_body(restore) ? NULL : "file is truncated or corrupt";
}

static PetriStatus read_state_file(PetriSession *session, Incoming *incoming, void *context) {
    const char *file = context, *reason = NULL;
    Arena *arena = &incoming->arena;
    Restore restore = {.session = session, .arena = arena, .state = incoming->state, .incoming = incoming};
    if (file_read(arena, NULL, file, true, MAX_STATE_BYTES, &restore.rest, NULL, &reason))
        reason = restore_text(&restore);
    if (state_clear_exhausted(incoming->state)) // running out of memory must not be reported as a corrupt file
        arena_exhausted(arena);
    if (restore.omitted && !reason)
        session_report_text(session, DIAG_WARNING, "state-file",
                            str_format(&session->text_arena,
                                       "'%s' contains values that are not finite; number of ignored values: %u", file,
                                       restore.omitted));
    if (reason)
        report_state_error(session, "cannot load the state from", file, reason);
    else
        clock_resume(&incoming->clock, restore.frame);
    return reason ? PETRI_INVALID : PETRI_OK;
}

PetriStatus petri_restore(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    if (!file_exists(file))
        return PETRI_OK;
    PetriStatus status = checkpoint_replace(session, read_state_file, (void *)file);
    if (status == PETRI_OK)
        session_change_config(session, false);
    return status;
}
