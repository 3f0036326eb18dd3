// recorder.c: reports of inputs and files to the callbacks of a recorder; see recorder.h.
#include "session/recorder.h"

#include "base/file.h"
#include "session/session.h"
#include "session/setup.h"
#include "session/state_text.h"
#include "value/format.h"

#include <string.h>

static void on_read(void *user_data, const char *path, Str bytes) {
    recorder_file(user_data, path, bytes);
}

void recorder_set(PetriSession *session, const Recorder *recorder) {
    Recorder before = session->recorder;
    session->recorder = (Recorder){0};
    if (before.end)
        before.end(before.user_data);
    session->recorder = recorder ? *recorder : (Recorder){0};
    session->reach.on_read = session->recorder.file || session->options.on_file_read ? on_read : NULL;
    session->reach.on_read_user_data = session;
}

void recorder_ignore_input(PetriSession *session, bool ignores) {
    session->recorder.ignores_input = ignores;
}

bool recorder_is_interrupted(const PetriSession *session) {
    return atomic_load_explicit(session->interrupt_source, memory_order_relaxed);
}

uint32_t recorder_host_functions(const PetriSession *session) {
    return session->functions.count;
}

void recorder_jump(PetriSession *session) {
    if (session->recorder.jump)
        session->recorder.jump(session->recorder.user_data);
}

// --- files

// Returns the length of the part of a path that is the script's folder.
static size_t folder_length(const FileAccess *reach, Str path) {
    if (reach->directory.len && str_starts_with(path, reach->directory))
        return reach->directory.len;
    Str folder = reach->script_folder; // canonical, and without a slash at its end
    return folder.len && str_starts_with(path, folder) && path.bytes[folder.len] == '/' ? folder.len + 1 : 0;
}

void recorder_file(PetriSession *session, const char *path, Str bytes) {
    char name[PATH_MAX + 2];
    Str whole = str_from(path);
    PetriOptions *options = &session->options;
    bool wanted = session->recorder.file || options->on_file_read;
    if (!wanted || !file_access_normalise(path + folder_length(&session->reach, whole), name))
        return;
    if (str_ends_with(whole, STR("/")))
        strcat(name, name[0] ? "/" : "./");
    if (session->recorder.file)
        session->recorder.file(session->recorder.user_data, name, bytes);
    if (options->on_file_read)
        options->on_file_read(options->user_data, name, bytes.bytes, bytes.len);
}

// --- inputs

typedef struct Report {
    const char *kind;
    const char *name;
    PetriValue key;
    PetriValue value;
    const PetriPointer *pointer;
    bool pressed;
    Str payload;
} Report;

static PetriStatus describe_pointer(PetriSession *session, void *context) {
    Report *report = context;
    const PetriPointer *pointer = report->pointer;
    Vector vector = vector_new(&session->text_arena);
    if (pointer) {
        vector_add_number(&vector, pointer->buttons);
        if (pointer->inside) {
            vector_add_number(&vector, pointer->x);
            vector_add_number(&vector, pointer->y);
        }
    }
    report->payload = format_text(&session->text_arena, &session->symbols, vector_finish(&vector));
    return PETRI_OK;
}

static PetriStatus describe_key(PetriSession *session, void *context) {
    Report *report = context;
    Vector vector = vector_new(&session->text_arena);
    vector_add(&vector, value_string(&session->text_arena, str_from(report->name)));
    vector_add_number(&vector, report->pressed);
    report->payload = format_text(&session->text_arena, &session->symbols, vector_finish(&vector));
    return PETRI_OK;
}

// Describes an assignment as `KEY = VALUE`.
static PetriStatus describe_state(PetriSession *session, void *context) {
    Report *report = context;
    Value key, value;
    Text text = text_new(&session->text_arena);
    session_import_value(&session->text_arena, report->key, &key);
    session_import_value(&session->text_arena, report->value, &value);
    format_value(&text, &session->symbols, key);
    text_add_c(&text, " = ");
    format_value(&text, &session->symbols, value);
    report->payload = text_str(&text);
    return PETRI_OK;
}

static PetriStatus describe_global(PetriSession *session, void *context) {
    Report *report = context;
    Value value;
    Text text = text_new(&session->text_arena);
    session_import_value(&session->text_arena, report->value, &value);
    format_value(&text, &session->symbols, value_string(&session->text_arena, str_from(report->name)));
    text_add_c(&text, " = ");
    format_value(&text, &session->symbols, value);
    report->payload = text_str(&text);
    return PETRI_OK;
}

static void report_input(PetriSession *session, SessionCall *describe, Report *report) {
    ArenaMark mark = arena_mark(&session->text_arena);
    if (session_protect(session, NULL, describe, report) == PETRI_OK)
        session->recorder.input(session->recorder.user_data, report->kind, report->payload);
    arena_rewind(&session->text_arena, mark);
}

void recorder_pointer(PetriSession *session, const PetriPointer *pointer) {
    if (session->recorder.input)
        report_input(session, describe_pointer, &(Report){.kind = "pointer", .pointer = pointer});
}

void recorder_key(PetriSession *session, const char *name, bool pressed) {
    if (session->recorder.input)
        report_input(session, describe_key, &(Report){.kind = "key", .name = name, .pressed = pressed});
}

void recorder_state(PetriSession *session, PetriValue key, PetriValue value) {
    if (session->recorder.input)
        report_input(session, describe_state, &(Report){.kind = "state", .key = key, .value = value});
}

void recorder_global(PetriSession *session, const char *name, PetriValue value) {
    if (session->recorder.input)
        report_input(session, describe_global, &(Report){.kind = "global", .name = name, .value = value});
}

// --- keyframes

void recorder_report_script(PetriSession *session) {
    const Source *source = session->config.program->source;
    recorder_file(session, str_to_c(&session->text_arena, source->name), source->text);
}

bool recorder_has_script(const PetriSession *session) {
    return session->config.program;
}

PetriStatus recorder_read_again(PetriSession *session) {
    return session_read_again(session);
}

const char *recorder_script_name(const PetriSession *session) {
    Str name = session->config.program->source->name;
    return name.bytes + path_directory(name).len;
}

static PetriStatus write_setup(PetriSession *session, void *context) {
    *(Str *)context = setup_write(session, true);
    return PETRI_OK;
}

static PetriStatus write_configuration(PetriSession *session, void *context) {
    *(Str *)context = setup_write(session, false);
    return PETRI_OK;
}

static PetriStatus write_state(PetriSession *session, void *context) {
    *(Str *)context = session_write_state(session);
    return PETRI_OK;
}

static PetriStatus write_text(PetriSession *session, SessionCall *write, Str *text) {
    return session_run(session, write, text, "the recording");
}

PetriStatus recorder_write_setup(PetriSession *session, Str *text) {
    return write_text(session, write_setup, text);
}

PetriStatus recorder_write_configuration(PetriSession *session, Str *text) {
    return write_text(session, write_configuration, text);
}

PetriStatus recorder_write_state(PetriSession *session, Str *text) {
    return write_text(session, write_state, text);
}
