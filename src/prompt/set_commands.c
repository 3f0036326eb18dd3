// set_commands.c: commands that show and set parameters, tempo, frame rate and resolution.
#include "cli/parameters.h"
#include "petri-live.h"
#include "prompt/prompt.h"

#include <stdlib.h>
#include <string.h>

// Returns true if the text is `name` or has the form `name=VALUE`.
static bool defines_name(const char *text, const char *name) {
    size_t length = strlen(name);
    return strncmp(text, name, length) == 0 && (text[length] == '\0' || text[length] == '=');
}

// Returns true if the script, the prompt or the engine binds the name. Such bindings take precedence over
// definitions.
static bool is_bound(const Prompt *prompt, const char *name) {
    size_t seen = 0, defined = 0;
    const char *known;
    for (size_t i = 0; (known = petri_visible_name(prompt->session, i)); i++)
        seen += defines_name(known, name);
    for (size_t i = 0; i < prompt->definitions.count; i++)
        defined += defines_name(prompt->definitions.items[i], name);
    return seen > defined;
}

// Writes a parameter, such as `-- CELLS = 200  (1..500)  how many`.
static void note_parameter(Prompt *prompt, const PetriParameter *parameter) {
    SCOPED_TEXT text = {0};
    parameter_describe(&text, parameter);
    prompt_note(prompt, "%s%s%s", text.bytes, parameter->comment[0] == '\0' ? "" : "  ", parameter->comment);
}

// Reports the effect of setting a name. `warned` is true if a diagnostic has already reported that the setting has no
// effect.
static void report_set(Prompt *prompt, const char *name, bool warned) {
    PetriParameter parameter;
    if (parameter_find(prompt->session, name, &parameter))
        note_parameter(prompt, &parameter);
    else if (!warned && is_bound(prompt, name))
        prompt_note(prompt, ".set has no effect on %s: the script or the prompt sets it", name);
}

static bool note_named_parameter(Prompt *prompt, const char *name) {
    PetriParameter parameter;
    if (!parameter_find(prompt->session, name, &parameter)) {
        return prompt_fail(
            prompt, "'%.40s' is not a parameter of the script; .set expects NAME VALUE, such as '.set COUNT 50'", name);
    }
    note_parameter(prompt, &parameter);
    return true;
}

// Lets the host set a parameter, if it has a function for this.
static bool set_by_host(Prompt *prompt, const char *name, const char *value) {
    PetriParameter parameter;
    if (!parameter_find(prompt->session, name, &parameter))
        return note_named_parameter(prompt, name);
    if (!prompt_status(prompt, prompt->host->set_parameter(prompt, name, value)))
        return false;
    report_set(prompt, name, false);
    return true;
}

// Defines the name and reloads the script. On failure, restores the old definitions and returns false.
static bool define_parameter(Prompt *prompt, const char *name, const char *value) {
    SCOPED_TEXT definition = {0};
    text_add_format(&definition, "%s=%s", name, value);
    PetriConfig *before = petri_config_get(prompt->session);
    if (!before)
        return prompt_status(prompt, PETRI_OUT_OF_MEMORY);
    uint64_t warnings = petri_diagnostic_count(prompt->session, PETRI_WARNING);
    bool good = petri_define(prompt->session, definition.bytes) == PETRI_OK ||
                prompt_fail(prompt, ".set expects NAME VALUE, such as '.set COUNT 50'");
    if (good && !prompt_status(prompt, petri_reload(prompt->session, NULL))) {
        petri_config_apply(prompt->session, before);
        good = false;
    }
    petri_config_free(before);
    if (good) {
        texts_add(&prompt->definitions, definition.bytes);
        report_set(prompt, name, petri_diagnostic_count(prompt->session, PETRI_WARNING) > warnings);
    }
    return good;
}

static bool run_parameters(Prompt *prompt, const char *rest) {
    (void)rest;
    if (parameters_list(prompt->session, prompt->output) == 0)
        prompt_note(prompt,
                    "the script has no parameters; to add one, write `let SIZE=SIZE or 20 -- 1..100 how large`");
    return true;
}

static bool run_set(Prompt *prompt, const char *rest) {
    if (rest[0] == '\0')
        return run_parameters(prompt, rest);
    size_t length = strcspn(rest, " \t=");
    SCOPED_STRING name = memory_strndup(rest, length);
    const char *value = rest + length + strspn(rest + length, " \t");
    bool given = *value != '\0';
    SCOPED_STRING text = argument_trimmed(value + (*value == '='));
    bool good = !given                        ? note_named_parameter(prompt, name)
                : prompt->host->set_parameter ? set_by_host(prompt, name, text)
                                              : define_parameter(prompt, name, text);
    return good;
}

void prompt_warn_shadowed(Prompt *prompt, const char *name) {
    PetriParameter parameter;
    if (parameter_find(prompt->session, name, &parameter)) {
        prompt_note(prompt, "the script still uses its own %s, which is %s; run .set %s VALUE to change it",
                    parameter.name, parameter.value, parameter.name);
    } else {
        prompt_note(prompt, "the script still uses its own %s; only code typed here uses the new one", name);
    }
}

static void show_number(Prompt *prompt, const char *name, double value) {
    output_format(prompt->output, "%s = %.12g\n", name, value);
}

static bool read_rate(Prompt *prompt, const char *rest, double *value) {
    return argument_number(prompt, rest, value) &&
           (*value > 0 || prompt_fail(prompt, "not a positive number: '%s'", rest));
}

// Shows a rate of the clock: tempo or fps. If `rest` is not empty, first sets the rate to the number in `rest`.
static bool show_rate(Prompt *prompt, const char *rest, const char *name, PetriStatus change(PetriSession *, double)) {
    double rate = 0;
    if (rest[0] != '\0') {
        if (!read_rate(prompt, rest, &rate) || change(prompt->session, rate) != PETRI_OK)
            return false;
        prompt->rates_changed = true;
    }
    PetriFrame frame;
    petri_frame(prompt->session, &frame, sizeof frame);
    show_number(prompt, name, change == petri_set_tempo ? frame.tempo : frame.fps);
    return true;
}

static bool run_tempo(Prompt *prompt, const char *rest) {
    return show_rate(prompt, rest, "tempo", petri_set_tempo);
}

static bool run_fps(Prompt *prompt, const char *rest) {
    return show_rate(prompt, rest, "fps", petri_set_fps);
}

static bool run_resolution(Prompt *prompt, const char *rest) {
    double step = 0;
    bool off = strcmp(rest, "off") == 0;
    if (rest[0] != '\0' && !off && !read_rate(prompt, rest, &step))
        return false;
    if (rest[0] != '\0')
        petri_set_resolution(prompt->session, step);
    step = petri_resolution(prompt->session);
    if (step > 0)
        show_number(prompt, "resolution", step);
    else
        prompt_note(prompt, "each system uses its own resolution");
    return true;
}

const PromptCommand SET_COMMANDS[] = {
    {".parameters", "", NULL, "list the script's parameters: value, default, range, comment", run_parameters,
     COMPLETE_LANGUAGE},
    {".set", "[NAME [VALUE]]", NULL, "set a parameter of the script, as -D does, or show it", run_set,
     COMPLETE_PARAMETERS},
    {".tempo", "[T]", NULL, "show or set the beats per minute", run_tempo, COMPLETE_LANGUAGE},
    {".fps", "[F]", NULL, "show or set the frames per second", run_fps, COMPLETE_LANGUAGE},
    {".resolution", "[R | off]", NULL, "show or set the maximum time step of all systems", run_resolution,
     COMPLETE_LANGUAGE},
    {0},
};
