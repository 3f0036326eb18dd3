// image.c: the parts of an image, written and read; see image.h.
#include "base/file.h"
#include "session/session.h"

#include <math.h>

static void add_image_numbers(ImageSink *sink, const char *name, const double *numbers, uint32_t count) {
    sink->line(sink, name, value_numbers_view(numbers, count), VALUE_NULL);
}

static void add_image_string(ImageSink *sink, const char *name, Str text) {
    String string = {text};
    Item item = {.type = ITEM_STRING, .as.string = &string};
    sink->line(sink, name, (Value){.kind = VALUE_MIXED, .len = 1, .as.items = &item}, VALUE_NULL);
}

static void add_rates(ImageSink *sink, const char *name, const ClockRates *rates) {
    add_image_numbers(sink, name, (double[]){rates->fps, rates->tempo, rates->quantum}, 3);
}

static void add_configuration(const PetriSession *session, ImageSink *sink) {
    const Config *config = &session->config;
    const ClockBase *base = &session->clock.base;
    Str script = config->program->source->name;
    size_t folder = path_directory(script).len;
    double run_time = session->options.run_time;
    add_image_numbers(sink, "run_time", &run_time, !isnan(run_time));
    add_image_numbers(sink, "realtime", (double[]){session->frame_realtime}, 1);
    add_image_string(sink, "script", (Str){script.bytes + folder, script.len - folder});
    add_image_numbers(sink, "host_names", (double[]){config->program->program->param_count}, 1);
    for (uint32_t i = 0; i < config->define_count; i++)
        add_image_string(sink, "define", str_from(config->defines[i].text));
    for (uint32_t i = 0; i < config->prompts->count; i++)
        add_image_string(sink, "prompt", str_from(config->prompts->statements[i].text));
    add_rates(sink, "rates", &session->clock.rates);
    add_rates(sink, "pragma_rates", &config->pragma_rates);
    add_image_numbers(sink, "base", (double[]){(double)base->number, base->time, base->beat}, 3);
    add_image_numbers(sink, "resolution", &config->resolution, 1);
}

static void add_clock(const Clock *clock, ImageSink *sink) {
    add_image_numbers(sink, "clock",
                      (double[]){clock->time, clock->beat, clock->wall.performance, clock->wall.slow_frame}, 4);
}

static void add_host_names(const HostGlobals *globals, ImageSink *sink) {
    for (uint32_t i = 0; i < globals->count; i++) {
        add_image_string(sink, "global", globals->names[i]->name);
        sink->line(sink, "value", globals->items[i]->value, VALUE_NULL);
    }
}

static void add_switch(ImageSink *sink, int number, const InputSwitch *item) {
    if (item->down || item->frame_down || item->toggled || item->pushes)
        add_image_numbers(sink, "switch", (double[]){number, item->down, item->frame_down, item->toggled, item->pushes},
                          5);
    if (!isnan(item->pushed))
        add_image_numbers(sink, "pushed", (double[]){number, item->pushed}, 2);
    if (!isnan(item->released))
        add_image_numbers(sink, "released", (double[]){number, item->released}, 2);
}

static void add_input(const Input *input, ImageSink *sink) {
    for (uint32_t i = 0; i < input->bindings.count; i++)
        sink->line(sink, "binding", value_numbers_view(&(double){input->bindings.items[i].key}, 1),
                   input->bindings.items[i].state);
    const InputState *state = &input->state;
    if (!state->has_reports)
        return;
    add_image_numbers(sink, "pointer", (double[]){state->inside, state->position[0], state->position[1]}, 3);
    for (int i = 0; i < INPUT_KEYS; i++)
        add_switch(sink, i, &state->keys[i]);
    for (int i = 0; i < INPUT_BUTTONS; i++)
        add_switch(sink, INPUT_KEYS + i, &state->buttons[i]);
}

static void add_image_entries(State *state, ImageSink *sink) {
    double buffer[STATE_KEY_BUFFER];
    uint32_t cursor = 0, count = sink->all_slots ? state_slot_count(state) : 0;
    for (StateSlot i = 0; i < count; i++)
        sink->entry(sink, state_slot_key_in(state, i, buffer), state_slot_get(state, i));
    for (Value key, value; !sink->all_slots && state_next(state, &cursor, &key, &value, buffer);)
        sink->entry(sink, key, value);
}

static void add_systems(const Scene *scene, ImageSink *sink) {
    const void *cursor = NULL;
    for (SceneSystem system; scene_next_system(scene, &cursor, &system);)
        sink->system(sink, &system);
}

void image_write(PetriSession *session, unsigned parts, ImageSink *sink) {
    if (parts & IMAGE_CONFIGURATION)
        add_configuration(session, sink);
    if (parts & IMAGE_CLOCK)
        add_clock(&session->clock, sink);
    if (parts & IMAGE_HOST_NAMES)
        add_host_names(&session->host_globals, sink);
    if (parts & IMAGE_INPUT)
        add_input(scene_input(session->scene), sink);
    if (parts & IMAGE_ENTRIES)
        add_image_entries(session->state, sink);
    if (parts & IMAGE_SYSTEMS)
        add_systems(session->scene, sink);
}

// --- reading. Values of recordings are from a stranger, so each is checked before it is used.

bool image_number_at(Value value, uint32_t index, double *number) {
    if (index >= value.len)
        return false;
    Item item = value_at(&value, index);
    *number = item.as.number;
    return item.type == ITEM_NUMBER && isfinite(*number);
}

bool image_numbers(Value value, double *numbers, uint32_t count) {
    if (value.len != count)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (!image_number_at(value, i, &numbers[i]))
            return false;
    return true;
}

bool image_is_integer(double x, double min, double max) {
    return x >= min && x <= max && x == floor(x);
}

static InputSwitch *find_switch(InputState *state, double number) {
    if (!image_is_integer(number, 0, INPUT_KEYS + INPUT_BUTTONS - 1))
        return NULL;
    int index = (int)number;
    return index < INPUT_KEYS ? &state->keys[index] : &state->buttons[index - INPUT_KEYS];
}

static bool read_switch(InputState *state, Value value) {
    double numbers[5];
    InputSwitch *item = image_numbers(value, numbers, 5) ? find_switch(state, numbers[0]) : NULL;
    if (!item || !image_is_integer(numbers[4], 0, UINT32_MAX))
        return false;
    item->down = numbers[1] != 0;
    item->frame_down = numbers[2] != 0;
    item->toggled = numbers[3] != 0;
    item->pushes = (uint32_t)numbers[4];
    return true;
}

static bool read_switch_beat(InputState *state, Value value, bool pushed) {
    double numbers[2];
    InputSwitch *item = image_numbers(value, numbers, 2) ? find_switch(state, numbers[0]) : NULL;
    if (item)
        *(pushed ? &item->pushed : &item->released) = numbers[1];
    return item;
}

static bool read_pointer(InputState *state, Value value) {
    double numbers[3];
    if (!image_numbers(value, numbers, 3))
        return false;
    state->has_reports = true;
    state->inside = numbers[0] != 0;
    state->position[0] = numbers[1];
    state->position[1] = numbers[2];
    return true;
}

static bool read_binding(Incoming *incoming, Value value) {
    double key;
    if (!image_number_at(value, 0, &key) || !image_is_integer(key, INPUT_KEY_NONE, INPUT_KEYS - 1))
        return false;
    Value state = value_slice(&incoming->arena, value, 1, value.len - 1);
    if (!state_key_valid(state))
        return false;
    input_add_binding(&incoming->bindings, state, (int)key);
    return true;
}

bool image_read_input(Incoming *incoming, Str name, Value value) {
    bool pushed = str_equal(name, STR("pushed"));
    if (str_equal(name, STR("binding")))
        return read_binding(incoming, value);
    if (str_equal(name, STR("pointer")))
        return read_pointer(&incoming->input_state, value);
    if (str_equal(name, STR("switch")))
        return read_switch(&incoming->input_state, value);
    if (pushed || str_equal(name, STR("released")))
        return read_switch_beat(&incoming->input_state, value, pushed);
    return true;
}

void image_read_system(PetriSession *session, Incoming *incoming, const SceneSystem *system) {
    SceneFrame frame = {.state = incoming->state, .arena = &incoming->arena};
    if (!scene_restore_system(session->scene, system, &frame))
        arena_exhausted(&incoming->arena);
}
