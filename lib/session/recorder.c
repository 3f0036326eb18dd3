// recorder.c: reports of inputs and files to the callbacks of a recorder; see recorder.h.
#include "session/recorder.h"

#include "base/file.h"
#include "session/session.h"
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
    bool varies = session->variation.parts > 1 || session->variation.shift > 0;
    return session->functions.count + (session->step_forces.callback != NULL) + varies;
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

// An input. Its payload is `KEY`, or `KEY = VALUE` if there is a value.
typedef struct Report {
    PetriValue key;
    const PetriValue *value;
    Str payload;
} Report;

static PetriStatus describe_input(PetriSession *session, void *context) {
    Report *report = context;
    Arena *arena = &session->text_arena;
    Value value;
    Text text = text_new(arena);
    session_import_value(arena, report->key, &value);
    format_value(&text, &session->symbols, value);
    if (report->value) {
        text_add_c(&text, " = ");
        session_import_value(arena, *report->value, &value);
        format_value(&text, &session->symbols, value);
    }
    report->payload = text_str(&text);
    return PETRI_OK;
}

static void report_input(PetriSession *session, const char *kind, PetriValue key, const PetriValue *value) {
    if (!session->recorder.input)
        return;
    Report report = {.key = key, .value = value};
    ArenaMark mark = arena_mark(&session->text_arena);
    if (session_protect(session, NULL, describe_input, &report) == PETRI_OK)
        session->recorder.input(session->recorder.user_data, kind, report.payload);
    arena_rewind(&session->text_arena, mark);
}

void recorder_pointer(PetriSession *session, const PetriPointer *pointer) {
    const PetriPointer none = {0}, *shown = pointer ? pointer : &none;
    const double numbers[] = {shown->buttons, shown->x, shown->y};
    uint32_t length = !pointer ? 0 : pointer->inside ? 3 : 1;
    report_input(session, "pointer", (PetriValue){.length = length, .numbers = numbers}, NULL);
}

void recorder_key(PetriSession *session, const char *name, bool pressed) {
    const PetriItem items[] = {{.type = PETRI_STRING, .as.string = &(PetriString){name, strlen(name)}},
                               {.type = PETRI_NUMBER, .as.number = pressed}};
    report_input(session, "key", (PetriValue){.length = 2, .items = items}, NULL);
}

void recorder_state(PetriSession *session, PetriValue key, PetriValue value) {
    report_input(session, "state", key, &value);
}

void recorder_global(PetriSession *session, const char *name, PetriValue value) {
    const PetriItem item = {.type = PETRI_STRING, .as.string = &(PetriString){name, strlen(name)}};
    report_input(session, "global", (PetriValue){.length = 1, .items = &item}, &value);
}

const char *recorder_script_name(const PetriSession *session) {
    Str name = session->config.program->source->name;
    return name.bytes + path_directory(name).len;
}
