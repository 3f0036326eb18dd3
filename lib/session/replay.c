// replay.c: restoring of keyframes and inputs of recordings; see recorder.h and setup.h.
#include "session/recorder.h"
#include "session/session.h"
#include "session/state_text.h"
#include "session/value_reader.h"

#include <math.h>
#include <string.h>

typedef struct SetupLine {
    Str name;
    Value value;
} SetupLine;

// A setup that is being read. Its contents are from a stranger, so each value is checked before it is used.
typedef struct Setup {
    Arena arena;
    Str text;
    SetupLine *lines;
    uint32_t count;
    uint32_t capacity;
} Setup;

static PetriStatus parse_lines(PetriSession *session, void *context) {
    Setup *setup = context;
    ValueReader reader = {session, &setup->arena, setup->text};
    while (reader.rest.len > 0) {
        size_t length = 0;
        while (length < reader.rest.len && reader.rest.bytes[length] != ' ')
            length++;
        SetupLine line = {.name = {reader.rest.bytes, length}};
        value_reader_skip(&reader, line.name);
        if (!value_reader_skip(&reader, STR(" = ")) || !value_reader_read(&reader, &line.value) ||
            !value_reader_skip(&reader, STR("\n")))
            return PETRI_INVALID;
        setup->lines =
            arena_grow_array(&setup->arena, setup->lines, setup->count, &setup->capacity, sizeof *setup->lines);
        setup->lines[setup->count++] = line;
    }
    return PETRI_OK;
}

static PetriStatus setup_read(PetriSession *session, Str text, Setup *setup) {
    *setup = (Setup){.text = text};
    session_arena(session, &setup->arena, "setup", SIZE_MAX);
    if (utf8_find_error(text) < text.len)
        return PETRI_INVALID;
    return session_protect(session, &setup->arena, parse_lines, setup);
}

// Returns the next line with a name, starting at *at, or NULL.
static const SetupLine *next_line(const Setup *setup, const char *name, uint32_t *at) {
    while (*at < setup->count) {
        const SetupLine *line = &setup->lines[(*at)++];
        if (str_equal(line->name, str_from(name)))
            return line;
    }
    return NULL;
}

static bool read_number_at(Value value, uint32_t index, double *number) {
    if (index >= value.len)
        return false;
    Item item = value_at(&value, index);
    *number = item.as.number;
    return item.type == ITEM_NUMBER && isfinite(*number);
}

// Copies `count` finite numbers from a value. Returns false if the value is not of this form.
static bool read_numbers(Value value, double *numbers, uint32_t count) {
    if (value.len != count)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (!read_number_at(value, i, &numbers[i]))
            return false;
    return true;
}

static bool find_numbers(const Setup *setup, const char *name, double *numbers, uint32_t count) {
    uint32_t at = 0;
    const SetupLine *line = next_line(setup, name, &at);
    return line && read_numbers(line->value, numbers, count);
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

static bool is_integer(double x, double min, double max) {
    return x >= min && x <= max && x == floor(x);
}

// --- configuration

// Sets the definitions of a recorded configuration, and nothing else.
static PetriStatus apply_defines(PetriSession *session, const Setup *setup) {
    session->config.defines = NULL;
    session->config.define_count = session->reported_defines = 0;
    PetriStatus status = PETRI_OK;
    uint32_t at = 0;
    for (const SetupLine *line; status == PETRI_OK && (line = next_line(setup, "define", &at));) {
        const char *text = text_at(line->value, 0);
        status = text ? petri_define(session, text) : PETRI_INVALID;
    }
    return status;
}

static PetriStatus apply_prompts(PetriSession *session, const Setup *setup) {
    PetriStatus status = PETRI_OK;
    uint32_t at = 0;
    for (const SetupLine *line; status == PETRI_OK && (line = next_line(setup, "prompt", &at));) {
        const char *text = text_at(line->value, 0);
        status = text ? session_restore_statement(session, str_from(text)) : PETRI_INVALID;
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
        !find_numbers(setup, "base", base, 3) || !is_integer(base[0], -1, 1e17) ||
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
static PetriStatus load_script(PetriSession *session, const Setup *setup, const char *script) {
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
    const SetupLine *line = next_line(setup, "script", &at);
    const char *script = line ? text_at(line->value, 0) : NULL;
    if (!script)
        return PETRI_INVALID;
    petri_prompt_clear(session, true);
    PetriStatus status = apply_defines(session, setup);
    if (status == PETRI_OK)
        status = load_script(session, setup, script);
    if (status == PETRI_OK)
        status = apply_prompts(session, setup);
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
    for (const SetupLine *line; status == PETRI_OK && (line = next_line(setup, "global", &at)); number++) {
        const SetupLine *value = at < setup->count ? &setup->lines[at] : NULL;
        if (!value || !str_equal(value->name, STR("value")))
            return PETRI_INVALID;
        if (number >= first && number < end)
            status = apply_global(session, line->value, value->value);
    }
    return status;
}

// --- keyframes

static InputSwitch *find_switch(InputState *state, double number) {
    if (!is_integer(number, 0, INPUT_KEYS + INPUT_BUTTONS - 1))
        return NULL;
    int index = (int)number;
    return index < INPUT_KEYS ? &state->keys[index] : &state->buttons[index - INPUT_KEYS];
}

static bool read_switch(InputState *state, Value value) {
    double numbers[5];
    InputSwitch *item = read_numbers(value, numbers, 5) ? find_switch(state, numbers[0]) : NULL;
    if (!item || !is_integer(numbers[4], 0, UINT32_MAX))
        return false;
    item->down = numbers[1] != 0;
    item->frame_down = numbers[2] != 0;
    item->toggled = numbers[3] != 0;
    item->pushes = (uint32_t)numbers[4];
    return true;
}

static bool read_switch_beat(InputState *state, const SetupLine *line) {
    double numbers[2];
    InputSwitch *item = read_numbers(line->value, numbers, 2) ? find_switch(state, numbers[0]) : NULL;
    if (item)
        *(str_equal(line->name, STR("pushed")) ? &item->pushed : &item->released) = numbers[1];
    return item;
}

static bool read_pointer(InputState *state, Value value) {
    double numbers[3];
    if (!read_numbers(value, numbers, 3))
        return false;
    state->has_reports = true;
    state->inside = numbers[0] != 0;
    state->position[0] = numbers[1];
    state->position[1] = numbers[2];
    return true;
}

static bool read_binding(Incoming *incoming, Value value) {
    double key;
    if (!read_number_at(value, 0, &key) || !is_integer(key, INPUT_KEY_NONE, INPUT_KEYS - 1))
        return false;
    Value state = value_slice(&incoming->arena, value, 1, value.len - 1);
    if (!state_key_valid(state))
        return false;
    input_add_binding(&incoming->bindings, state, (int)key);
    return true;
}

static bool read_input_line(Incoming *incoming, const SetupLine *line) {
    if (str_equal(line->name, STR("binding")))
        return read_binding(incoming, line->value);
    if (str_equal(line->name, STR("pointer")))
        return read_pointer(&incoming->input_state, line->value);
    if (str_equal(line->name, STR("switch")))
        return read_switch(&incoming->input_state, line->value);
    if (str_equal(line->name, STR("pushed")) || str_equal(line->name, STR("released")))
        return read_switch_beat(&incoming->input_state, line);
    return true;
}

typedef struct Keyframe {
    const Setup *setup;
    Str state;
} Keyframe;

static PetriStatus fill_keyframe(PetriSession *session, Incoming *incoming, void *context) {
    const Keyframe *keyframe = context;
    double numbers[4];
    int64_t frame;
    uint32_t omitted;
    const char *reason = session_read_state(session, incoming, keyframe->state, &frame, &omitted);
    if (reason || omitted || !find_numbers(keyframe->setup, "clock", numbers, 4))
        return PETRI_INVALID;
    incoming->has_input = true;
    for (uint32_t i = 0; i < keyframe->setup->count; i++)
        if (!read_input_line(incoming, &keyframe->setup->lines[i]))
            return PETRI_INVALID;
    Clock *clock = &incoming->clock;
    clock->number = frame;
    clock->time = numbers[0];
    clock->beat = numbers[1];
    clock->wall = (WallClock){.performance = numbers[2], .slow_frame = numbers[3] != 0};
    return PETRI_OK;
}

static PetriStatus restore_setup(PetriSession *session, const Setup *setup, Str state) {
    Keyframe keyframe = {setup, state};
    double host_names;
    if (!find_numbers(setup, "host_names", &host_names, 1) || !is_integer(host_names, 0, UINT32_MAX))
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
    PetriStatus status = setup_read(session, setup_text, &setup);
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
    if (!read_numbers(value, numbers, value.len > 1 ? 3 : 1) || !is_integer(numbers[0], 0, UINT32_MAX))
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
    if (!name || !read_number_at(value, 1, &pressed))
        return PETRI_INVALID;
    return petri_report_key(session, name, pressed != 0);
}

// An input other than a configuration: one value, or two with " = " between them.
typedef struct InputValues {
    Arena arena;
    Str text;
    Value first;
    Value second;
    bool has_second;
} InputValues;

static PetriStatus parse_values(PetriSession *session, void *context) {
    InputValues *values = context;
    ValueReader reader = {session, &values->arena, values->text};
    if (!value_reader_read(&reader, &values->first))
        return PETRI_INVALID;
    values->has_second = value_reader_skip(&reader, STR(" = "));
    if (values->has_second && !value_reader_read(&reader, &values->second))
        return PETRI_INVALID;
    return reader.rest.len == 0 ? PETRI_OK : PETRI_INVALID;
}

static PetriStatus apply_values(PetriSession *session, Str kind, const InputValues *values) {
    Value first = values->first, second = values->second;
    if (str_equal(kind, STR("state")) && values->has_second)
        return petri_state_set(session, session_export_value(&first), session_export_value(&second));
    if (str_equal(kind, STR("global")) && values->has_second)
        return apply_global(session, first, second);
    if (str_equal(kind, STR("pointer")) && !values->has_second)
        return apply_pointer(session, first);
    if (str_equal(kind, STR("key")) && !values->has_second)
        return apply_key(session, first);
    return PETRI_INVALID;
}

PetriStatus recorder_apply_input(PetriSession *session, Str kind, Str payload) {
    if (str_equal(kind, STR("configuration"))) {
        Setup setup;
        PetriStatus status = setup_read(session, payload, &setup);
        if (status == PETRI_OK)
            status = apply_configuration(session, &setup);
        arena_free(&setup.arena);
        return status;
    }
    if (utf8_find_error(payload) < payload.len)
        return PETRI_INVALID;
    InputValues values = {.text = payload};
    session_arena(session, &values.arena, "input", SIZE_MAX);
    PetriStatus status = session_protect(session, &values.arena, parse_values, &values);
    if (status == PETRI_OK)
        status = apply_values(session, kind, &values);
    arena_free(&values.arena);
    return status;
}
