// set_commands.c: commands that show and set parameters, tempo, frame rate and resolution.
#include "cli/parameters.h"
#include "petri-live.h"
#include "repl/repl.h"

#include <stdlib.h>
#include <string.h>

// Returns true if the text is `name` or has the form `name=VALUE`.
static bool defines_name(const char *text, const char *name) {
    size_t length = strlen(name);
    return strncmp(text, name, length) == 0 && (text[length] == '\0' || text[length] == '=');
}

// Returns true if the script, the prompt or the engine binds the name. Such bindings take precedence over
// definitions.
static bool is_bound(const Repl *repl, const char *name) {
    size_t seen = 0, defined = 0;
    const char *known;
    for (size_t i = 0; (known = petri_visible_name(repl->session, i)); i++)
        seen += defines_name(known, name);
    for (size_t i = 0; i < repl->definitions.count; i++)
        defined += defines_name(repl->definitions.items[i], name);
    return seen > defined;
}

// Writes a parameter, such as `-- CELLS = 200  (1..500)  how many`.
static void note_parameter(Repl *repl, const PetriParameter *parameter) {
    SCOPED_TEXT text = {0};
    parameter_describe(&text, parameter);
    repl_note(repl, "%s%s%s", text.bytes, parameter->comment[0] == '\0' ? "" : "  ", parameter->comment);
}

// Reports the effect of setting a name. `warned` is true if a diagnostic has already reported that the setting has no
// effect.
static void report_set(Repl *repl, const char *name, bool warned) {
    PetriParameter parameter;
    if (parameter_find(repl->session, name, &parameter))
        note_parameter(repl, &parameter);
    else if (!warned && is_bound(repl, name))
        repl_note(repl, ".set has no effect on %s: the script or the prompt sets it", name);
}

// Defines the name and reloads the script. On failure, restores the old definitions and returns false.
static bool set_parameter(Repl *repl, const char *name, const char *definition) {
    PetriConfig *before = petri_config_get(repl->session);
    if (!before)
        return repl_status(repl, PETRI_OUT_OF_MEMORY);
    uint64_t warnings = petri_diagnostic_count(repl->session, PETRI_WARNING);
    bool good = petri_define(repl->session, definition) == PETRI_OK ||
                repl_fail(repl, ".set expects NAME VALUE, such as '.set COUNT 50'");
    if (good && !repl_status(repl, petri_reload(repl->session, NULL))) {
        petri_config_apply(repl->session, before);
        good = false;
    }
    petri_config_free(before);
    if (good) {
        texts_add(&repl->definitions, definition);
        report_set(repl, name, petri_diagnostic_count(repl->session, PETRI_WARNING) > warnings);
    }
    return good;
}

static bool note_named_parameter(Repl *repl, const char *name) {
    PetriParameter parameter;
    if (!parameter_find(repl->session, name, &parameter)) {
        return repl_fail(
            repl, "'%.40s' is not a parameter of the script; .set expects NAME VALUE, such as '.set COUNT 50'", name);
    }
    note_parameter(repl, &parameter);
    return true;
}

static bool run_parameters(Repl *repl, const char *rest) {
    (void)rest;
    if (parameters_list(repl->session, &repl->output) == 0)
        repl_note(repl, "the script has no parameters; to add one, write `let SIZE=SIZE or 20 -- 1..100 how large`");
    return true;
}

static bool run_set(Repl *repl, const char *rest) {
    if (rest[0] == '\0')
        return run_parameters(repl, rest);
    size_t length = strcspn(rest, " \t=");
    SCOPED_STRING name = memory_strndup(rest, length);
    const char *value = rest + length + strspn(rest + length, " \t");
    bool given = *value != '\0';
    SCOPED_STRING text = argument_trimmed(value + (*value == '='));
    SCOPED_TEXT definition = {0};
    text_add_format(&definition, "%s=%s", name, text);
    bool good = given ? set_parameter(repl, name, definition.bytes) : note_named_parameter(repl, name);
    return good;
}

void repl_warn_shadowed(Repl *repl, const char *name) {
    PetriParameter parameter;
    if (parameter_find(repl->session, name, &parameter)) {
        repl_note(repl, "the script still uses its own %s, which is %s; run .set %s VALUE to change it", parameter.name,
                  parameter.value, parameter.name);
    } else {
        repl_note(repl, "the script still uses its own %s; only code typed here uses the new one", name);
    }
}

static void show_number(Repl *repl, const char *name, double value) {
    output_format(&repl->output, "%s = %.12g\n", name, value);
}

static bool read_rate(Repl *repl, const char *rest, double *value) {
    return argument_number(repl, rest, value) && (*value > 0 || repl_fail(repl, "not a positive number: '%s'", rest));
}

// Shows a rate of the clock: tempo or fps. If `rest` is not empty, first sets the rate to the number in `rest`.
static bool show_rate(Repl *repl, const char *rest, const char *name, PetriStatus change(PetriSession *, double)) {
    double rate = 0;
    if (rest[0] != '\0') {
        if (!read_rate(repl, rest, &rate) || change(repl->session, rate) != PETRI_OK)
            return false;
        repl->rates_changed = true;
    }
    PetriFrame frame;
    petri_frame(repl->session, &frame, sizeof frame);
    show_number(repl, name, change == petri_set_tempo ? frame.tempo : frame.fps);
    return true;
}

static bool run_tempo(Repl *repl, const char *rest) {
    return show_rate(repl, rest, "tempo", petri_set_tempo);
}

static bool run_fps(Repl *repl, const char *rest) {
    return show_rate(repl, rest, "fps", petri_set_fps);
}

static bool run_resolution(Repl *repl, const char *rest) {
    double step = 0;
    bool off = strcmp(rest, "off") == 0;
    if (rest[0] != '\0' && !off && !read_rate(repl, rest, &step))
        return false;
    if (rest[0] != '\0')
        petri_set_resolution(repl->session, step);
    step = petri_resolution(repl->session);
    if (step > 0)
        show_number(repl, "resolution", step);
    else
        repl_note(repl, "each system uses its own resolution");
    return true;
}

const ReplCommand SET_COMMANDS[] = {
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
