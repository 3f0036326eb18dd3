// parameters.c: see parameters.h.
//
// The first key only shows the selected parameter. The number of parameters is read again for each key, because a
// reload can change it.
#include "view/parameters.h"

#include "cli/parameters.h"
#include "view/parameter_step.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LARGE_STEP = 10 };

typedef enum KeyMeaning { MEANS_NOTHING, MEANS_CHOICE, MEANS_STEP, MEANS_DEFAULT } KeyMeaning;

static const struct {
    const char *key;
    KeyMeaning meaning;
    int by;
} KEYS[] = {
    {"tab", MEANS_CHOICE, 1},
    {"right_bracket", MEANS_CHOICE, 1},
    {"left_bracket", MEANS_CHOICE, -1},
    {"up", MEANS_STEP, 1},
    {"equal", MEANS_STEP, 1},
    {"kp_add", MEANS_STEP, 1},
    {"down", MEANS_STEP, -1},
    {"minus", MEANS_STEP, -1},
    {"kp_subtract", MEANS_STEP, -1},
    {"page_up", MEANS_STEP, LARGE_STEP},
    {"page_down", MEANS_STEP, -LARGE_STEP},
    {"0", MEANS_DEFAULT, 0},
    {"backspace", MEANS_DEFAULT, 0},
};

static KeyMeaning meaning_of(const char *key, int *by) {
    for (size_t i = 0; i < sizeof KEYS / sizeof KEYS[0]; i++) {
        if (strcmp(KEYS[i].key, key) == 0) {
            *by = KEYS[i].by;
            return KEYS[i].meaning;
        }
    }
    return MEANS_NOTHING;
}

bool parameter_key_repeats(const char *key) {
    int by;
    return meaning_of(key, &by) == MEANS_STEP;
}

// Returns the number of parameters that can be set.
static size_t count_parameters(PetriSession *session) {
    PetriParameter parameter;
    size_t count = 0;
    while (petri_parameter(session, count, &parameter, sizeof parameter) && parameter.settable)
        count++;
    return count;
}

static void describe_parameter(LiveScript *live, size_t chosen, Text *text) {
    PetriParameter parameter;
    if (petri_parameter(live->session, chosen, &parameter, sizeof parameter)) {
        parameter_describe(text, &parameter);
        text_add_format(text, "%s%s", parameter.comment[0] == '\0' ? "" : "  ", parameter.comment);
    }
}

static ParameterResult set_value(const ParameterKeys *keys, LiveScript *live, const char *value, Text *text) {
    PetriParameter parameter;
    petri_parameter(live->session, keys->chosen, &parameter, sizeof parameter);
    SCOPED_STRING name = memory_strdup(parameter.name);
    bool done = live_script_set_parameter(live, name, value);
    describe_parameter(live, keys->chosen, text);
    return done ? PARAMETER_CHANGED : PARAMETER_MESSAGE;
}

ParameterResult parameter_set(const ParameterKeys *keys, LiveScript *live, double value, Text *text) {
    PetriParameter parameter;
    char printed[40];
    snprintf(printed, sizeof printed, "%.12g", value);
    bool regular =
        petri_parameter(live->session, keys->chosen, &parameter, sizeof parameter) && value == parameter.default_number;
    return set_value(keys, live, regular ? NULL : printed, text);
}

static ParameterResult step_value(ParameterKeys *keys, LiveScript *live, int steps, Text *text) {
    PetriParameter parameter;
    petri_parameter(live->session, keys->chosen, &parameter, sizeof parameter);
    double to = parameter_stepped(&parameter, steps);
    if (isnan(to) || to == parameter.number) {
        describe_parameter(live, keys->chosen, text);
        text_add_format(text, "%s",
                        isnan(parameter.number) ? ": the keys change only numbers"
                        : isnan(to)             ? ": the keys do not set 0, because 0 selects the default"
                                                : "");
        return PARAMETER_MESSAGE;
    }
    return parameter_set(keys, live, to, text);
}

ParameterResult parameter_key(ParameterKeys *keys, LiveScript *live, const char *key, Text *text) {
    int by = 0;
    KeyMeaning meaning = meaning_of(key, &by);
    if (meaning == MEANS_NOTHING)
        return PARAMETER_NOT_A_KEY;
    size_t count = count_parameters(live->session);
    if (count == 0) {
        text_add_format(text, "the script has no parameters; 'let SIZE=SIZE or 20' declares one");
        return PARAMETER_MESSAGE;
    }
    bool first = !keys->used || keys->chosen >= count; // the number of parameters may have changed
    keys->used = true;
    keys->chosen = keys->chosen < count ? keys->chosen : 0;
    if (meaning == MEANS_CHOICE && !first)
        keys->chosen = (keys->chosen + (by > 0 ? 1 : count - 1)) % count;
    if (meaning == MEANS_CHOICE || first) { // the first key press only shows the selected parameter
        describe_parameter(live, keys->chosen, text);
        return PARAMETER_MESSAGE;
    }
    return meaning == MEANS_STEP ? step_value(keys, live, by, text) : set_value(keys, live, NULL, text);
}

void parameter_status(const ParameterKeys *keys, LiveScript *live, bool has_sliders, Text *text) {
    size_t count = count_parameters(live->session);
    if (count > 0) {
        text_add_format(text, "\ntab parameter  up down change  0 default%s\n", has_sliders ? "  p sliders" : "");
        describe_parameter(live, keys->chosen < count ? keys->chosen : 0, text);
    }
}
