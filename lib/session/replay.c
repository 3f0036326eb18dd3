// replay.c: writing and restoring of keyframes and inputs of recordings; see recorder.h and image_text.h.
#include "session/image_text.h"
#include "session/session.h"

#include <math.h>
#include <string.h>

// --- writing

void recorder_report_script(PetriSession *session) {
    const Source *source = session->config.program->source;
    recorder_file(session, str_to_c(&session->text_arena, source->name), source->text);
}

bool recorder_has_script(const PetriSession *session) {
    return session->config.program;
}

typedef struct Writing {
    RecorderText what;
    Str text;
} Writing;

static PetriStatus write_text(PetriSession *session, void *context) {
    static const unsigned parts[] = {
        [RECORDER_SETUP] = IMAGE_CONFIGURATION | IMAGE_CLOCK | IMAGE_HOST_NAMES | IMAGE_INPUT,
        [RECORDER_CONFIGURATION] = IMAGE_CONFIGURATION,
    };
    Writing *writing = context;
    writing->text =
        writing->what == RECORDER_STATE ? image_state_text(session) : image_setup_text(session, parts[writing->what]);
    return PETRI_OK;
}

PetriStatus recorder_write(PetriSession *session, RecorderText what, Str *text) {
    Writing writing = {.what = what};
    PetriStatus status = session_run(session, write_text, &writing, "the recording");
    *text = writing.text;
    return status;
}

// --- reading of lines

// A setup that is being read. Its contents are from a stranger, so each value is checked before it is used.
typedef struct Setup {
    Arena arena;
    Str text;
    TextLine *lines;
    uint32_t count;
    uint32_t capacity;
} Setup;

static PetriStatus parse_lines(PetriSession *session, void *context) {
    Setup *setup = context;
    TextReader reader = {session, &setup->arena, setup->text};
    for (TextLine line; reader.rest.len > 0;) {
        if (!text_reader_line(&reader, &line) || !line.name.len || line.has_number || line.has_key || !line.has_value)
            return PETRI_INVALID;
        setup->lines =
            arena_grow_array(&setup->arena, setup->lines, setup->count, &setup->capacity, sizeof *setup->lines);
        setup->lines[setup->count++] = line;
    }
    return PETRI_OK;
}

static PetriStatus setup_read(PetriSession *session, Str text, SessionCall *parse, Setup *setup) {
    *setup = (Setup){.text = text};
    session_arena(session, &setup->arena, "setup", SIZE_MAX);
    if (utf8_find_error(text) < text.len)
        return PETRI_INVALID;
    return session_protect(session, &setup->arena, parse, setup);
}

// Returns the next line with a name, starting at *at, or NULL.
static const TextLine *next_line(const Setup *setup, const char *name, uint32_t *at) {
    while (*at < setup->count) {
        const TextLine *line = &setup->lines[(*at)++];
        if (str_equal(line->name, str_from(name)))
            return line;
    }
    return NULL;
}

static bool find_numbers(const Setup *setup, const char *name, double *numbers, uint32_t count) {
    uint32_t at = 0;
    const TextLine *line = next_line(setup, name, &at);
    return line && image_numbers(line->value, numbers, count);
}

// Returns the text of the element `index` as a NUL-terminated string, or NULL if it is not a string without NUL bytes.
static const char *text_at(Value value, uint32_t index) {
    if (index >= value.len)
        return NULL;
    Item item = value_at(&value, index);
    if (item.type != ITEM_STRING || memchr(item.as.string->text.bytes, 0, item.as.string->text.len))
        return NULL;
    return item.as.string->text.bytes;
}

// --- configuration

typedef PetriStatus ApplyText(PetriSession *session, const char *text);

// Passes the text of each line with a name to a function.
static PetriStatus apply_texts(PetriSession *session, const Setup *setup, const char *name, ApplyText *apply) {
    PetriStatus status = PETRI_OK;
    uint32_t at = 0;
    for (const TextLine *line; status == PETRI_OK && (line = next_line(setup, name, &at));) {
        const char *text = text_at(line->value, 0);
        status = text ? apply(session, text) : PETRI_INVALID;
    }
    return status;
}

static bool read_rates(const Setup *setup, const char *name, ClockRates *rates) {
    double numbers[3];
    if (!find_numbers(setup, name, numbers, 3) || !(numbers[0] > 0) || !(numbers[1] > 0))
        return false;
    *rates = (ClockRates){numbers[0], numbers[1], numbers[2]};
    return true;
}

// Sets rates and the clock's base without the effects that petri_set_fps would have.
static PetriStatus apply_rates(PetriSession *session, const Setup *setup) {
    ClockRates rates, pragma_rates;
    double base[3], resolution;
    if (!read_rates(setup, "rates", &rates) || !read_rates(setup, "pragma_rates", &pragma_rates) ||
        !find_numbers(setup, "base", base, 3) || !image_is_integer(base[0], -1, 1e17) ||
        !find_numbers(setup, "resolution", &resolution, 1) || resolution < 0)
        return PETRI_INVALID;
    session->clock.rates = rates;
    session->clock.base = (ClockBase){(int64_t)base[0], base[1], base[2]};
    session->config.pragma_rates = pragma_rates;
    session->config.resolution = resolution;
    session_change_config(session, false);
    return PETRI_OK;
}

// Loads the recorded script. `realtime` and `run_time` are constants of a script.
static PetriStatus load_recorded_script(PetriSession *session, const Setup *setup, const char *script) {
    double run_time = NAN, realtime;
    bool follows_clock = session->clock.realtime;
    if (!find_numbers(setup, "realtime", &realtime, 1))
        return PETRI_INVALID;
    find_numbers(setup, "run_time", &run_time, 1);
    session->options.run_time = run_time;
    session->clock.realtime = session->frame_realtime = realtime != 0;
    PetriStatus status = session->config.program ? petri_reload(session, script) : petri_load(session, script);
    session->clock.realtime = follows_clock;
    return status;
}

static PetriStatus apply_configuration(PetriSession *session, const Setup *setup) {
    uint32_t at = 0;
    const TextLine *line = next_line(setup, "script", &at);
    const char *script = line ? text_at(line->value, 0) : NULL;
    if (!script)
        return PETRI_INVALID;
    petri_prompt_clear(session, true);
    session->config.defines = NULL;
    session->config.define_count = session->reported_defines = 0;
    PetriStatus status = apply_texts(session, setup, "define", petri_define);
    if (status == PETRI_OK)
        status = load_recorded_script(session, setup, script);
    if (status == PETRI_OK)
        status = apply_texts(session, setup, "prompt", session_restore_statement);
    return status == PETRI_OK ? apply_rates(session, setup) : status;
}

// --- host globals

static PetriStatus apply_global(PetriSession *session, Value name, Value value) {
    const char *text = text_at(name, 0);
    return text ? petri_set_global(session, text, session_export_value(&value)) : PETRI_INVALID;
}

// Sets the recorded names from number `first` to `end` - 1. The line after that of a name has its value.
static PetriStatus apply_globals(PetriSession *session, const Setup *setup, uint32_t first, uint32_t end) {
    PetriStatus status = PETRI_OK;
    uint32_t at = 0, number = 0;
    for (const TextLine *line; status == PETRI_OK && (line = next_line(setup, "global", &at)); number++) {
        const TextLine *value = at < setup->count ? &setup->lines[at] : NULL;
        if (!value || !str_equal(value->name, STR("value")))
            return PETRI_INVALID;
        if (number >= first && number < end)
            status = apply_global(session, line->value, value->value);
    }
    return status;
}

// --- keyframes

typedef struct ReplayKeyframe {
    const Setup *setup;
    Str state;
} ReplayKeyframe;

static PetriStatus fill_keyframe(PetriSession *session, Incoming *incoming, void *context) {
    const ReplayKeyframe *keyframe = context;
    double numbers[4];
    int64_t frame;
    const char *reason = image_read_state(session, incoming, keyframe->state, &frame);
    if (reason || !find_numbers(keyframe->setup, "clock", numbers, 4))
        return PETRI_INVALID;
    if (!session->spec_chosen)
        scene_set_rules(session->scene, session->old_rules = incoming->old_rules);
    incoming->has_input = true;
    for (uint32_t i = 0; i < keyframe->setup->count; i++)
        if (!image_read_input(incoming, keyframe->setup->lines[i].name, keyframe->setup->lines[i].value))
            return PETRI_INVALID;
    Clock *clock = &incoming->clock;
    clock->number = frame;
    clock->time = numbers[0];
    clock->beat = numbers[1];
    clock->wall = (WallClock){.performance = numbers[2], .slow_frame = numbers[3] != 0};
    return PETRI_OK;
}

static PetriStatus restore_setup(PetriSession *session, const Setup *setup, Str state) {
    ReplayKeyframe keyframe = {setup, state};
    double host_names;
    if (!find_numbers(setup, "host_names", &host_names, 1) || !image_is_integer(host_names, 0, UINT32_MAX))
        return PETRI_INVALID;
    PetriStatus status = apply_globals(session, setup, 0, (uint32_t)host_names);
    if (status == PETRI_OK)
        status = apply_configuration(session, setup);
    if (status == PETRI_OK)
        status = apply_globals(session, setup, (uint32_t)host_names, UINT32_MAX);
    if (status == PETRI_OK)
        status = checkpoint_replace(session, fill_keyframe, &keyframe);
    return status;
}

PetriStatus recorder_restore(PetriSession *session, Str setup_text, Str state) {
    Setup setup;
    PetriStatus status = setup_read(session, setup_text, parse_lines, &setup);
    if (status == PETRI_OK)
        status = restore_setup(session, &setup, state);
    arena_free(&setup.arena);
    return status;
}

// --- inputs

static PetriStatus apply_pointer(PetriSession *session, Value value) {
    double numbers[3] = {0};
    if (value.len == 0)
        return petri_report_pointer(session, NULL);
    if (!image_numbers(value, numbers, value.len > 1 ? 3 : 1) || !image_is_integer(numbers[0], 0, UINT32_MAX))
        return PETRI_INVALID;
    return petri_report_pointer(session, &(PetriPointer){.size = sizeof(PetriPointer),
                                                         .inside = value.len > 1,
                                                         .x = numbers[1],
                                                         .y = numbers[2],
                                                         .buttons = (unsigned)numbers[0]});
}

static PetriStatus apply_key(PetriSession *session, Value value) {
    const char *name = value.len == 2 ? text_at(value, 0) : NULL;
    double pressed;
    if (!name || !image_number_at(value, 1, &pressed))
        return PETRI_INVALID;
    return petri_report_key(session, name, pressed != 0);
}

// Parses an input other than a configuration, one value, or two with " = " between them, as a line.
static PetriStatus parse_values(PetriSession *session, void *context) {
    Setup *setup = context;
    TextReader reader = {session, &setup->arena, setup->text};
    TextLine *line = setup->lines = arena_alloc(&setup->arena, sizeof *line);
    *line = (TextLine){.has_key = true};
    bool good = text_reader_value(&reader, &line->key);
    line->has_value = text_reader_skip(&reader, STR(" = "));
    good = good && (!line->has_value || text_reader_value(&reader, &line->value));
    return good && reader.rest.len == 0 ? PETRI_OK : PETRI_INVALID;
}

static PetriStatus apply_values(PetriSession *session, Str kind, const TextLine *line) {
    if (str_equal(kind, STR("state")) && line->has_value)
        return petri_state_set(session, session_export_value(&line->key), session_export_value(&line->value));
    if (str_equal(kind, STR("global")) && line->has_value)
        return apply_global(session, line->key, line->value);
    if (str_equal(kind, STR("pointer")) && !line->has_value)
        return apply_pointer(session, line->key);
    if (str_equal(kind, STR("key")) && !line->has_value)
        return apply_key(session, line->key);
    return PETRI_INVALID;
}

PetriStatus recorder_apply_input(PetriSession *session, Str kind, Str payload) {
    Setup setup;
    bool is_setup = str_equal(kind, STR("configuration"));
    PetriStatus status = setup_read(session, payload, is_setup ? parse_lines : parse_values, &setup);
    if (status == PETRI_OK)
        status = is_setup ? apply_configuration(session, &setup) : apply_values(session, kind, setup.lines);
    arena_free(&setup.arena);
    return status;
}
