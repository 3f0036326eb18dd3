// parameters.c: `.set` and `.parameters`: what the script leaves to whoever runs it.
#include <stdlib.h>
#include <string.h>

#include "cli/parameters.h"
#include "repl/repl.h"
#include "repl/words.h"

// Is a text, a name or NAME=VALUE, of the name?
static bool is_of(const char *text, const char *name) {
    size_t length = strlen(name);
    return strncmp(text, name, length) == 0 && (text[length] == '\0' || text[length] == '=');
}

// Does something else than a definition give the name its value? What the script and the prompt bind, and the names of
// the engine, come before it.
static bool is_bound(const Repl *repl, const char *name) {
    size_t seen = 0, defined = 0;
    const char *known;
    for (size_t i = 0; (known = petri_name(repl->session, i)) != NULL; i++) {
        seen += is_of(known, name);
    }
    for (size_t i = 0; i < repl->definition_count; i++) {
        defined += is_of(repl->definitions[i], name);
    }
    return seen > defined;
}

// `-- CELLS = 200  (1..500)  how many`
static void say_parameter(Repl *repl, const PetriParameter *parameter) {
    Bytes text = {0};
    parameter_describe(&text, parameter);
    repl_say(repl, "%s%s%s", text.data, parameter->comment[0] == '\0' ? "" : "  ", parameter->comment);
    bytes_free(&text);
}

// What has become of a name that was set.
static void report_set(Repl *repl, const char *name, bool warned) {
    PetriParameter parameter;
    if (parameter_find(repl->session, name, &parameter)) {
        say_parameter(repl, &parameter);
    } else if (!warned && is_bound(repl, name)) {
        repl_say(repl, "%s keeps the value that the script or the prompt gives it", name);
    }
}

// Defines the name and compiles the script for it. Where that fails everything is as before.
static bool set(Repl *repl, const char *name, const char *definition) {
    PetriConfig *before = petri_config(repl->session);
    if (before == NULL) {
        return repl_status(repl, PETRI_MEMORY);
    }
    uint64_t warnings = petri_diagnostic_count(repl->session, PETRI_WARNING);
    bool good = petri_define(repl->session, definition) == PETRI_OK ||
                repl_fail(repl, ".set expects NAME VALUE, such as .set COUNT 50");
    if (good && petri_reload(repl->session, NULL) != PETRI_OK) {
        petri_config_use(repl->session, before);
        good = false;
        repl->failed = true;
    }
    petri_config_free(before);
    if (good) {
        repl_keep_definition(repl, definition);
        report_set(repl, name, petri_diagnostic_count(repl->session, PETRI_WARNING) > warnings);
    }
    return good;
}

static bool show_one(Repl *repl, const char *name) {
    PetriParameter parameter;
    if (!parameter_find(repl->session, name, &parameter)) {
        return repl_fail(repl, ".set expects NAME VALUE, such as .set COUNT 50; '%.40s' is no parameter of the script",
                         name);
    }
    say_parameter(repl, &parameter);
    return true;
}

bool repl_set(Repl *repl, const char *rest) {
    if (rest[0] == '\0') {
        return repl_show_parameters(repl);
    }
    size_t length = strcspn(rest, " \t=");
    char *name = memory_copied(rest, length);
    const char *value = rest + length + strspn(rest + length, " \t");
    bool given = *value != '\0';
    char *text = word_trimmed(value + (*value == '='));
    Bytes definition = {0};
    bytes_format(&definition, "%s=%s", name, text);
    bool good = given ? set(repl, name, definition.data) : show_one(repl, name);
    bytes_free(&definition);
    free(text);
    free(name);
    return good;
}

bool repl_show_parameters(Repl *repl) {
    if (parameters_list(repl->session, &repl->output) == 0) {
        repl_say(repl, "the script has no parameters; `let SIZE=SIZE or 20 -- 1..100 how large` makes one");
    }
    return true;
}

void repl_tell_hidden(Repl *repl, const char *name) {
    PetriParameter parameter;
    if (parameter_find(repl->session, name, &parameter)) {
        repl_say(repl, "the script keeps its own %s, which is %s; .set %s VALUE changes that", parameter.name,
                 parameter.value, parameter.name);
    } else {
        repl_say(repl, "the script keeps its own %s; only what is typed here sees the new one", name);
    }
}
