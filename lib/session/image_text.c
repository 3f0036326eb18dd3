// image_text.c: see image_text.h.
#include "session/image_text.h"

#include "ast/literal.h"
#include "base/number.h"
#include "base/spec.h"
#include "session/session.h"
#include "value/format.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define HEADER "petri-state 2\n"
#define HEADER_1 "petri-state 1\n" // without a version of the specification
// Highest frame number that can be restored. It is low enough that later frame numbers cannot overflow.
#define MAX_FRAMES INT64_C(100000000000000000)

// --- writing

typedef struct TextWriter {
    ImageSink sink; // first member, so that a pointer to it can be cast to TextWriter
    Text text;
    const PetriSession *session;
} TextWriter;

static void add_image_key(TextWriter *writer, Value key) {
    text_add_c(&writer->text, "$(");
    format_value(&writer->text, &writer->session->symbols, key);
    text_add_char(&writer->text, ')');
}

static void end_line(TextWriter *writer, Value value) {
    text_add_c(&writer->text, " = ");
    format_value(&writer->text, &writer->session->symbols, value);
    text_add_char(&writer->text, '\n');
}

static void add_line(ImageSink *sink, const char *name, Value first, Value rest) {
    TextWriter *writer = (TextWriter *)sink;
    Vector value = vector_new(writer->text.arena);
    vector_add(&value, first);
    vector_add(&value, rest);
    text_add_c(&writer->text, name);
    end_line(writer, vector_finish(&value));
}

static void add_entry(ImageSink *sink, Value key, Value value) {
    add_image_key((TextWriter *)sink, key);
    end_line((TextWriter *)sink, value);
}

static void add_system(ImageSink *sink, const SceneSystem *system) {
    TextWriter *writer = (TextWriter *)sink;
    const State *state = writer->session->state;
    double buffer[STATE_KEY_BUFFER];
    text_add_format(&writer->text, "system %u ", system->occurrence);
    add_image_key(writer, state_slot_key_in(state, system->prefix, buffer));
    text_add_char(&writer->text, '\n');
    for (uint32_t i = 0; i < system->slot_count; i += 2) {
        text_add_c(&writer->text, "particle ");
        add_image_key(writer, state_slot_key_in(state, system->slots[i], buffer));
        text_add_char(&writer->text, '\n');
    }
}

static TextWriter text_writer(PetriSession *session) {
    return (TextWriter){
        .sink = {add_line, add_entry, add_system, false}, .text = text_new(&session->text_arena), .session = session};
}

Str image_setup_text(PetriSession *session, unsigned parts) {
    TextWriter writer = text_writer(session);
    image_write(session, parts, &writer.sink);
    return text_str(&writer.text);
}

Str image_state_text(PetriSession *session) {
    TextWriter writer = text_writer(session);
    Text *text = &writer.text;
    text_add_c(text, HEADER);
    text_add_format(text, "spec %s\n", spec_version(session->old_rules));
    text_add_format(text, "frame %lld\n", (long long)session->clock.number);
    if (state_digest_is_stale(session->state))
        arena_charge(text->arena, state_slot_count(session->state));
    image_write(session, IMAGE_ENTRIES | IMAGE_SYSTEMS, &writer.sink);
    if (state_clear_exhausted(session->state))
        arena_exhausted(text->arena);
    text_add_format(text, "end %016" PRIx64 "\n", hash_bytes(0, text->bytes, text->len));
    return text_str(text);
}

// --- reading of lines

bool text_reader_skip(TextReader *reader, Str prefix) {
    if (!str_starts_with(reader->rest, prefix))
        return false;
    reader->rest = (Str){reader->rest.bytes + prefix.len, reader->rest.len - prefix.len};
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

static bool read_element(TextReader *reader, Vector *vector) {
    size_t len = element_length(reader->rest);
    Str text = {reader->rest.bytes, len};
    double x;
    if (len == 0)
        return false;
    reader->rest = (Str){reader->rest.bytes + len, reader->rest.len - len};
    if (text.bytes[0] == ':') {
        const Symbol *symbol = symbol_register(&reader->session->symbols, (Str){text.bytes + 1, len - 1});
        if (symbol)
            vector_add_number(vector, symbol->number);
        return symbol;
    }
    if (text.bytes[0] == '\'' || text.bytes[0] == '"') {
        Str string;
        if (literal_string(reader->arena, text, &string))
            return false;
        vector_add(vector, value_string(reader->arena, string));
        return true;
    }
    if (!literal_parse_number(text, &x))
        return false;
    vector_add_number(vector, x);
    return true;
}

bool text_reader_value(TextReader *reader, Value *value) {
    Vector vector = vector_new(reader->arena);
    if (!text_reader_skip(reader, STR("null"))) {
        do
            if (!read_element(reader, &vector))
                return false;
        while (text_reader_skip(reader, STR(";")));
    }
    *value = vector_finish(&vector);
    return true;
}

static Str read_name(TextReader *reader) {
    Str rest = reader->rest;
    size_t len = 0;
    while (len < rest.len && ((rest.bytes[len] >= 'a' && rest.bytes[len] <= 'z') || rest.bytes[len] == '_'))
        len++;
    reader->rest = (Str){rest.bytes + len, rest.len - len};
    return (Str){rest.bytes, len};
}

static bool read_integer(TextReader *reader, int64_t *x) {
    enum { MAX_DIGITS = 18 };
    bool negative = text_reader_skip(reader, STR("-"));
    Str rest = reader->rest;
    size_t len = 0;
    *x = 0;
    for (; len < rest.len && len <= MAX_DIGITS && rest.bytes[len] >= '0' && rest.bytes[len] <= '9'; len++)
        *x = *x * 10 + (rest.bytes[len] - '0');
    *x = negative ? -*x : *x;
    reader->rest = (Str){rest.bytes + len, rest.len - len};
    return len > 0 && len <= MAX_DIGITS;
}

static bool read_key(TextReader *reader, TextLine *line) {
    line->has_key = true;
    return text_reader_value(reader, &line->key) && text_reader_skip(reader, STR(")"));
}

bool text_reader_line(TextReader *reader, TextLine *line) {
    *line = (TextLine){.name = read_name(reader)};
    bool assigns = str_starts_with(reader->rest, STR(" = "));
    if (line->name.len && !assigns && !text_reader_skip(reader, STR(" ")))
        return false;
    if (line->name.len && !assigns && !str_starts_with(reader->rest, STR("$"))) {
        line->has_number = true;
        if (!read_integer(reader, &line->number))
            return false;
        if (str_starts_with(reader->rest, STR(" $")))
            text_reader_skip(reader, STR(" "));
    }
    if (text_reader_skip(reader, STR("$(")) && !read_key(reader, line))
        return false;
    line->has_value = text_reader_skip(reader, STR(" = "));
    return (!line->has_value || text_reader_value(reader, &line->value)) && text_reader_skip(reader, STR("\n"));
}

// --- reading of state files

typedef struct StateReader {
    TextReader in;
    Incoming *incoming;
    SceneSystem system; // the last system, if has_system is set, and its particles read so far
    StateSlot *slots;
    uint32_t capacity; // always even, so there is room for both slots of a particle, position and velocity
    bool has_system;
} StateReader;

// Returns the slot of the velocity that belongs to a position.
static StateSlot velocity_slot(StateReader *reader, StateSlot position) {
    State *state = reader->incoming->state;
    double buffer[STATE_KEY_BUFFER]; // without it, all keys of a range would be written to memory for each particle
    Vector key = vector_new(reader->in.arena);
    vector_add(&key, state_slot_key_in(state, position, buffer));
    vector_add_number(&key, symbol_number(STR("velocity")));
    return state_slot(state, vector_finish(&key));
}

static void end_system(StateReader *reader) {
    reader->system.slots = reader->slots;
    if (reader->has_system)
        image_read_system(reader->in.session, reader->incoming, &reader->system);
    reader->slots = NULL;
    reader->capacity = 0;
}

static void add_particle(StateReader *reader, StateSlot position) {
    SceneSystem *system = &reader->system;
    reader->slots =
        arena_grow_array(reader->in.arena, reader->slots, system->slot_count, &reader->capacity, sizeof position);
    reader->slots[system->slot_count++] = position;
    reader->slots[system->slot_count++] = velocity_slot(reader, position);
}

static bool read_state_line(StateReader *reader, const TextLine *line) {
    StateSlot slot = line->has_key ? state_slot(reader->incoming->state, line->key) : STATE_NO_SLOT;
    bool is_entry = !line->name.len && !reader->has_system, is_system = str_equal(line->name, STR("system"));
    if (slot == STATE_NO_SLOT || line->has_value != is_entry || line->has_number != is_system)
        return false;
    if (is_entry)
        return (line->value.kind != VALUE_NUMBERS || numbers_finite(value_numbers(&line->value), line->value.len, 1)) &&
               state_slot_set(reader->incoming->state, slot, line->value);
    if (is_system && line->number >= 0 && line->number <= UINT32_MAX) {
        end_system(reader);
        reader->has_system = true;
        reader->system = (SceneSystem){.prefix = slot, .occurrence = (uint32_t)line->number};
        return true;
    }
    bool is_particle = reader->has_system && str_equal(line->name, STR("particle"));
    if (is_particle)
        add_particle(reader, slot);
    return is_particle;
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

static bool read_state_body(StateReader *reader, int64_t *frame) {
    TextLine line;
    if (!text_reader_line(&reader->in, &line) || !str_equal(line.name, STR("frame")) || !line.has_number ||
        line.has_key || line.has_value || line.number < -1 || line.number > MAX_FRAMES)
        return false;
    *frame = line.number;
    while (reader->in.rest.len > 0)
        if (!text_reader_line(&reader->in, &line) || !read_state_line(reader, &line))
            return false;
    end_system(reader);
    return true;
}

// Reads the line with the version of the specification, which files of the first form do not have.
static bool read_spec(TextReader *reader, unsigned *old_rules) {
    enum { MAX_VERSION = 20 };
    char version[MAX_VERSION + 1] = SPEC_FIRST;
    if (text_reader_skip(reader, STR(HEADER_1)))
        return spec_find(version, old_rules);
    if (!text_reader_skip(reader, STR(HEADER "spec ")))
        return false;
    const char *end = memchr(reader->rest.bytes, '\n', reader->rest.len < MAX_VERSION ? reader->rest.len : MAX_VERSION);
    if (!end)
        return false;
    snprintf(version, sizeof version, "%.*s", (int)(end - reader->rest.bytes), reader->rest.bytes);
    size_t length = (size_t)(end + 1 - reader->rest.bytes);
    reader->rest = (Str){end + 1, reader->rest.len - length};
    return spec_find(version, old_rules);
}

const char *image_read_state(PetriSession *session, Incoming *incoming, Str text, int64_t *frame) {
    StateReader reader = {.in = {session, &incoming->arena, text}, .incoming = incoming};
    if (!str_starts_with(text, STR("petri-state ")))
        return "not a petri state file";
    if (!read_spec(&reader.in, &incoming->old_rules))
        return "written by another version of petri";
    size_t header = text.len - reader.in.rest.len;
    bool good = utf8_find_error(text) == text.len && hash_matches(&text) && text.len >= header;
    reader.in.rest = good ? (Str){text.bytes + header, text.len - header} : (Str){"", 0};
    good = good && read_state_body(&reader, frame);
    if (state_clear_exhausted(incoming->state)) // running out of memory must not be reported as a corrupt file
        arena_exhausted(&incoming->arena);
    return good ? NULL : "file is truncated or corrupt";
}
