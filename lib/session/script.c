// script.c: definitions (petri_define), and loading and reloading of the script.
#include "ast/literal.h"
#include "session/session.h"

#include <string.h>

// Adds one element of a -D value (spec language.md L16.3).
static void add_define_element(PetriSession *session, Vector *vector, Str part) {
    double x;
    const Symbol *symbol = part.len > 1 && part.bytes[0] == ':'
                               ? symbol_register(&session->symbols, (Str){part.bytes + 1, part.len - 1})
                               : NULL;
    if (symbol)
        vector_add_number(vector, symbol->number);
    else if (literal_parse_number(part, &x) || literal_parse_timecode(part, &x))
        vector_add_number(vector, x);
    else
        vector_add(vector, value_string(&session->arena, part));
}

static Value define_value(PetriSession *session, Str text) {
    Vector vector = vector_new(&session->arena);
    for (;;) {
        const char *end = memchr(text.bytes, ';', text.len);
        Str part = {text.bytes, end ? (size_t)(end - text.bytes) : text.len};
        add_define_element(session, &vector, part);
        if (!end)
            return vector_finish(&vector);
        text = (Str){end + 1, text.len - part.len - 1};
    }
}

typedef struct Definition {
    Str name;
    Str value; // text as in petri_define; if `bytes` is NULL: the parameter gets its default
} Definition;

// Removes the definition of a name, from a new array with room for one more, because checkpoints use the old one.
static void remove_define(PetriSession *session, const Symbol *name) {
    Config *config = &session->config;
    Define *defines = arena_alloc_array(&session->arena, config->define_count + 1, sizeof *defines);
    uint32_t count = 0, reported = 0;
    for (uint32_t i = 0; i < config->define_count; i++)
        if (config->defines[i].name != name) {
            defines[count++] = config->defines[i];
            reported += i < session->reported_defines;
        }
    config->defines = defines;
    config->define_count = count;
    session->reported_defines = reported;
}

static PetriStatus add_define(PetriSession *session, void *context) {
    const Definition *definition = context;
    Str name = definition->name, value = definition->value;
    if (!session_is_name(name) || utf8_find_error(value) != value.len)
        return PETRI_INVALID;
    const Symbol *symbol = symbol_intern(&session->symbols, name);
    Str text = str_format(&session->arena, "%.*s=%.*s", STR_ARGS(name), STR_ARGS(value));
    value = (Str){text.bytes + name.len + 1, value.len};
    Define define = {symbol, define_value(session, value), str_to_c(&session->arena, text)};
    remove_define(session, symbol);
    ((Define *)session->config.defines)[session->config.define_count++] = define;
    session_change_config(session, true);
    return PETRI_OK;
}

PetriStatus petri_define(PetriSession *session, const char *definition) {
    const char *equals = session && definition ? strchr(definition, '=') : NULL;
    if (!equals)
        return PETRI_INVALID;
    Definition added = {{definition, (size_t)(equals - definition)}, str_from(equals + 1)};
    return session_protect(session, NULL, add_define, &added);
}

typedef enum LoadPurpose { LOAD_RESTART, LOAD_CONTINUE } LoadPurpose;

typedef struct Load {
    const char *file; // NULL: load `text`, or compile `reload_of`
    bool regular;     // the file must not be a pipe, which can be read only once
    Str name;         // name for messages
    Str text;
    Unit *reload_of; // script whose text is compiled again, or NULL
    bool read_again; // included files are also read again
    // Results
    Unit *unit;
    ClockRates rates;
    PromptList *prompts;
} Load;

static PetriStatus make_unit(PetriSession *session, void *context) {
    Load *load = context;
    session_set_globals(session, &session->static_vm);
    Unit *unit = load->reload_of ? unit_reload(session, load->reload_of, load->read_again)
                 : load->file    ? unit_load_file(session, load->file, false, load->regular)
                                 : unit_load_text(session, load->name, load->text);
    if (!unit->source)
        session_report_text(
            session, DIAG_ERROR, "cannot-read",
            str_format(&session->text_arena, "cannot read '%.*s': %.*s", STR_ARGS(load->name), STR_ARGS(unit->error)));
    load->unit = unit;
    if (unit->program && !session_check_definitions(session, unit))
        unit->program = NULL;
    if (!unit->program)
        return PETRI_INVALID;
    load->rates = session_pragma_rates(session, unit->program);
    prompt_list_compile(session, session->config.prompts, unit->program, PROMPT_ALL, &load->prompts);
    return PETRI_OK;
}

// Replaces the loaded script.
static void install_script(PetriSession *session, const Load *load, LoadPurpose purpose) {
    session_clear_frame(session); // the tree of the last frame can refer to the old unit
    if (!session->config.program || !str_equal(session->config.program->folder, load->unit->folder))
        session_clear_files(session);
    unit_free(session->config.program);
    session->config.program = session_use_unit(session, load->unit);
    session->loader.loads += !session->recompiling;
    session_set_prompts(session, load->prompts);
    if (purpose == LOAD_RESTART)
        session_start(session, &load->rates);
    else
        session_apply_rates(session, &load->rates);
    session->frame.no_frame_yet = true;
}

static PetriStatus load_script(PetriSession *session, Load *load, LoadPurpose purpose) {
    if (session->call_depth > 0)
        return PETRI_INVALID;
    if (!session->recompiling)
        diagnostics_begin_load(&session->diagnostics);
    session->loader.pending = NULL;
    session->loader.static_work = 0;
    FileAccess before = session->reach;
    PetriStatus status = session_protect(session, NULL, make_unit, load);
    if (status == PETRI_OK) {
        install_script(session, load, session->config.program ? purpose : LOAD_RESTART);
        if (purpose == LOAD_RESTART)
            recorder_jump(session);
        return PETRI_OK;
    }
    session->reach = before;
    prompt_list_free(load->prompts);
    unit_free(session->loader.pending);
    return session_report_abort(session, status, "the script");
}

PetriStatus petri_load(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    return load_script(session, &(Load){.file = file, .name = str_from(file)}, LOAD_RESTART);
}

PetriStatus petri_load_text(PetriSession *session, const char *name, const char *text, size_t length) {
    if (!session || !name || !text)
        return PETRI_INVALID;
    Str content = {text, length == PETRI_NUL_TERMINATED ? strlen(text) : length};
    return load_script(session, &(Load){.name = str_from(name), .text = content}, LOAD_RESTART);
}

// Compiles the loaded script again. The text is the same, so diagnostics about it are not repeated.
static PetriStatus recompile_script(PetriSession *session, bool read_again) {
    Unit *unit = session->config.program;
    if (!unit)
        return PETRI_INVALID;
    Load load = {.name = unit->source->name, .reload_of = unit, .read_again = read_again};
    session->recompiling = true;
    PetriStatus status = load_script(session, &load, LOAD_CONTINUE);
    session->recompiling = false;
    return status;
}

PetriStatus recorder_read_again(PetriSession *session) {
    session_clear_files(session);
    return recompile_script(session, true);
}

PetriStatus petri_reload(PetriSession *session, const char *file) {
    if (!session)
        return PETRI_INVALID;
    if (!file)
        return recompile_script(session, false);
    return load_script(session, &(Load){.file = file, .regular = true, .name = str_from(file)}, LOAD_CONTINUE);
}

// --- parameters

// Replaces the definition of a name. If the new value is NULL, only removes it.
static PetriStatus redefine(PetriSession *session, void *context) {
    const Definition *definition = context;
    const Config *config = &session->config;
    const Symbol *symbol = symbol_intern(&session->symbols, definition->name);
    if (!config->program || !program_find_parameter(config->program->program, symbol))
        return PETRI_INVALID;
    if (definition->value.bytes)
        return add_define(session, context);
    remove_define(session, symbol);
    return PETRI_OK;
}

PetriStatus petri_set_parameter(PetriSession *session, const char *name, const char *value) {
    if (!session || !name)
        return PETRI_INVALID;
    Definition definition = {str_from(name), value ? str_from(value) : (Str){0}};
    const Define *defines = session->config.defines;
    uint32_t count = session->config.define_count, reported = session->reported_defines;
    uint64_t number = session->config_revision;
    PetriStatus status = session_protect(session, NULL, redefine, &definition);
    if (status == PETRI_OK)
        status = petri_reload(session, NULL);
    if (status != PETRI_OK) {
        session->config.defines = defines;
        session->config.define_count = count;
        session->reported_defines = reported;
        session_change_config(session, true);
        session->config_revision = number;
    }
    return status;
}
