// setup.c: writing of setups; see setup.h.
#include "session/setup.h"

#include "value/format.h"

typedef struct SetupWriter {
    Text text;
    PetriSession *session;
    Vector vector; // the value of the current line
} SetupWriter;

static void begin_line(SetupWriter *writer, const char *name) {
    text_add_c(&writer->text, name);
    text_add_c(&writer->text, " = ");
    writer->vector = vector_new(&writer->session->text_arena);
}

static void end_line(SetupWriter *writer) {
    format_value(&writer->text, &writer->session->symbols, vector_finish(&writer->vector));
    text_add_char(&writer->text, '\n');
}

static void add_string(SetupWriter *writer, Str text) {
    vector_add(&writer->vector, value_string(&writer->session->text_arena, text));
}

static void add_text_line(SetupWriter *writer, const char *name, Str text) {
    begin_line(writer, name);
    add_string(writer, text);
    end_line(writer);
}

static void add_numbers(SetupWriter *writer, const char *name, const double *numbers, size_t count) {
    begin_line(writer, name);
    for (size_t i = 0; i < count; i++)
        vector_add_number(&writer->vector, numbers[i]);
    end_line(writer);
}

static void add_rates(SetupWriter *writer, const char *name, const ClockRates *rates) {
    add_numbers(writer, name, (double[]){rates->fps, rates->tempo, rates->quantum}, 3);
}

static void add_configuration(SetupWriter *writer) {
    const PetriSession *session = writer->session;
    const Config *config = &session->config;
    const ClockBase *base = &session->clock.base;
    double run_time = session->options.run_time;
    add_numbers(writer, "run_time", &run_time, !isnan(run_time));
    add_numbers(writer, "realtime", (double[]){session->frame_realtime}, 1);
    add_text_line(writer, "script", str_from(recorder_script_name(session)));
    add_numbers(writer, "host_names", (double[]){config->program->program->param_count}, 1);
    for (uint32_t i = 0; i < config->define_count; i++)
        add_text_line(writer, "define", str_from(config->defines[i].text));
    for (uint32_t i = 0; i < config->prompts->count; i++)
        add_text_line(writer, "prompt", str_from(config->prompts->statements[i].text));
    add_rates(writer, "rates", &session->clock.rates);
    add_rates(writer, "pragma_rates", &config->pragma_rates);
    add_numbers(writer, "base", (double[]){(double)base->number, base->time, base->beat}, 3);
    add_numbers(writer, "resolution", &config->resolution, 1);
}

static void add_globals(SetupWriter *writer) {
    for (uint32_t i = 0; i < writer->session->host_globals.count; i++) {
        const HostGlobal *global = writer->session->host_globals.items[i];
        add_text_line(writer, "global", global->name->name);
        begin_line(writer, "value");
        vector_add(&writer->vector, global->value);
        end_line(writer);
    }
}

static void add_switch(SetupWriter *writer, int number, const InputSwitch *item) {
    if (item->down || item->frame_down || item->toggled || item->pushes)
        add_numbers(writer, "switch", (double[]){number, item->down, item->frame_down, item->toggled, item->pushes}, 5);
    if (!isnan(item->pushed))
        add_numbers(writer, "pushed", (double[]){number, item->pushed}, 2);
    if (!isnan(item->released))
        add_numbers(writer, "released", (double[]){number, item->released}, 2);
}

static void add_input(SetupWriter *writer) {
    const Input *input = scene_input(writer->session->scene);
    for (uint32_t i = 0; i < input->bindings.count; i++) {
        begin_line(writer, "binding");
        vector_add_number(&writer->vector, input->bindings.items[i].key);
        vector_add(&writer->vector, input->bindings.items[i].state);
        end_line(writer);
    }
    const InputState *state = &input->state;
    if (!state->has_reports)
        return;
    add_numbers(writer, "pointer", (double[]){state->inside, state->position[0], state->position[1]}, 3);
    for (int i = 0; i < INPUT_KEYS; i++)
        add_switch(writer, i, &state->keys[i]);
    for (int i = 0; i < INPUT_BUTTONS; i++)
        add_switch(writer, INPUT_KEYS + i, &state->buttons[i]);
}

Str setup_write(PetriSession *session, bool whole) {
    SetupWriter writer = {.text = text_new(&session->text_arena), .session = session};
    const Clock *clock = &session->clock;
    add_configuration(&writer);
    if (whole) {
        add_numbers(&writer, "clock",
                    (double[]){clock->time, clock->beat, clock->wall.performance, clock->wall.slow_frame}, 4);
        add_globals(&writer);
        add_input(&writer);
    }
    return text_str(&writer.text);
}
