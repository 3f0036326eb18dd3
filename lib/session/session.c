// session.c: opening, loading, diagnostics; see petri.h.
#include "session/session.h"

#include "base/unicode.h"
#include "ast/literal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COOKIE UINT32_C(0x70657472)
enum { MOST_TOLD = 1000, MOST_LINES = 100000 };

PetriOptions petri_default_options(void) {
    return (PetriOptions){.fps = 60,
                          .run_time = NAN,
                          .simplify = true,
                          .stack_bytes = (size_t)4 << 20,
                          .memory_bytes = (size_t)2 << 30,
                          .cookie = COOKIE};
}

static void tell_once(PetriSession *session, const Diag *diag, Str key);

static void tell_scene(void *host, DiagLevel level, const char *code, const Origin *origin, Str node, Str key,
                       Str text) {
    PetriSession *session = host;
    Arena *arena = &session->scene_arena;
    Str whole = str_format(arena, "%.*s: %.*s", (int)node.len, node.bytes, (int)text.len, text.bytes);
    Diag diag = {.level = level, .text = whole, .code = code};
    if (origin) {
        diag.source = origin->source;
        diag.span = origin->span;
    }
    diag_report(&session->errors, &diag);
    // A loop may make a thousand nodes at one place: that is one thing to say.
    Str where = diag.source
                    ? str_format(arena, "%.*s %u", (int)diag.source->path.len, diag.source->path.bytes, diag.span.start)
                    : node;
    tell_once(session, &diag,
              str_format(arena, "%s %.*s %.*s", code, (int)where.len, where.bytes, (int)key.len, key.bytes));
}

static void tell_machine(void *host, const Diag *diag) {
    PetriSession *session = host;
    if (session->in_frame)
        diag_report(&session->errors, diag);
    session_tell(session, diag);
}

// What is wrong with an expression that is evaluated ahead is told when it is really reached.
static void tell_nobody(void *host, const Diag *diag) {
    (void)host;
    (void)diag;
}

static void log_machine(void *host, Str text) {
    PetriSession *session = host;
    diag_report(&session->log, &(Diag){.level = DIAG_NOTE, .text = text});
}

_Static_assert((int)PETRI_NEIGHBOURS_NEVER == (int)PHYS_NEIGHBOURS_NEVER &&
                   (int)PETRI_NEIGHBOURS_ALWAYS == (int)PHYS_NEIGHBOURS_ALWAYS,
               "the public choices are those of the engine");

// The environment may choose the instruction set; results do not depend on it. Unknown words count as none.
static PhysOptions physics_options(const PetriOptions *options) {
    PhysOptions physics = {.threads = options->threads,
                           .neighbours = (PhysNeighbours)options->neighbours,
                           .keep_forces = options->keep_forces};
    cpu_choose(getenv("PETRI_CPU"), &physics.cpu);
    return physics;
}

PetriSession *petri_open(const PetriOptions *options) {
    if (!options || options->cookie != COOKIE || !(options->fps > 0) || !isfinite(options->fps))
        return NULL;
    PetriSession *session = calloc(1, sizeof *session);
    if (!session)
        return NULL;
    session->options = *options;
    arena_init(&session->arena, "session", SIZE_MAX);
    arena_init(&session->frame_arena, "frame", options->memory_bytes);
    arena_init(&session->scene_arena, "systems", SIZE_MAX);
    arena_init(&session->text_arena, "text", SIZE_MAX);
    arena_init(&session->prompt_arena, "expression", options->memory_bytes);
    session->symbols = symbol_table_new(&session->arena);
    session->log = diag_sink_new(&session->frame_arena, MOST_LINES);
    session->errors = diag_sink_new(&session->frame_arena, MOST_LINES);
    session->state = state_new();
    session->scene = scene_new(&session->symbols, (SceneHost){session, tell_scene});
    canvas_schema_init(&session->canvas, &session->symbols, (CanvasHost){session, tell_scene});
    session->files = file_cache_new();
    session->noise = noise_cache_new();
    vm_init(&session->vm, &session->frame_arena, &session->symbols,
            (VmHost){session, tell_machine, log_machine, session_module}, options->stack_bytes, false);
    vm_init(&session->static_vm, &session->frame_arena, &session->symbols,
            (VmHost){session, tell_nobody, log_machine, session_module}, options->stack_bytes, true);
    session->vm.profile = options->profile ? vm_profile_new() : NULL;
    session->vm.builtins.files = session->files;
    session->vm.builtins.noise = session->static_vm.builtins.noise = session->noise;
    session->frame.number = -1;
    if (!session->state || !session->scene || !session->files || !session->noise ||
        (options->profile && !session->vm.profile))
        petri_close(&session);
    PhysOptions physics = physics_options(options);
    if (session)
        scene_set_physics(session->scene, &physics);
    return session;
}

void petri_close(PetriSession **handle) {
    PetriSession *session = *handle;
    *handle = NULL;
    if (!session)
        return;
    session_free_prompts(session);
    petri_config_free(session->config);
    free(session->undo.bytes);
    free(session->names);
    unit_free(session->program);
    for (Unit *unit = session->modules, *next; unit; unit = next) {
        next = unit->next;
        unit_free(unit);
    }
    scene_free(session->scene);
    state_free(session->state);
    file_cache_free(session->files);
    noise_cache_free(session->noise);
    vm_profile_free(session->vm.profile);
    vm_free(&session->vm);
    vm_free(&session->static_vm);
    diag_sink_free(&session->log);
    diag_sink_free(&session->errors);
    index_free(&session->told_index);
    free(session->told);
    symbol_table_free(&session->symbols);
    arena_free(&session->frame_arena);
    arena_free(&session->scene_arena);
    arena_free(&session->text_arena);
    arena_free(&session->prompt_arena);
    arena_free(&session->arena);
    free(session);
}

static bool told_same(const void *owner, uint32_t entry, const void *key) {
    return ((const PetriSession *)owner)->told[entry] == *(const uint64_t *)key;
}

// Remembers a text; false if it was told before or too many were.
static bool told_add(PetriSession *session, Str text) {
    uint64_t hash = hash_bytes(0, text.bytes, text.len);
    if (session->told_count >= MOST_TOLD ||
        index_find(&session->told_index, hash, told_same, session, &hash) != INDEX_NONE)
        return false;
    if (session->told_count == session->told_capacity) {
        uint32_t capacity = session->told_capacity ? session->told_capacity * 2 : 16;
        uint64_t *told = realloc(session->told, capacity * sizeof *told);
        if (!told)
            return false;
        session->told = told;
        session->told_capacity = capacity;
    }
    session->told[session->told_count] = hash;
    return index_add(&session->told_index, hash, session->told_count++);
}

static void give(PetriSession *session, const Diag *diag, Str rendered) {
    session->counts[diag->level]++;
    if (!session->options.diagnostic)
        return;
    Arena *arena = &session->text_arena;
    SourcePlace place = {0};
    if (diag->source)
        place = source_locate(diag->source, diag->span.start);
    PetriDiagnostic public_diag = {.level = (PetriLevel)diag->level,
                                   .file = diag->source ? str_to_c(arena, diag->source->name) : NULL,
                                   .line = place.line,
                                   .column = place.column,
                                   .text = str_to_c(arena, diag_text(diag)),
                                   .code = diag->code,
                                   .rendered = str_to_c(arena, rendered)};
    session->options.diagnostic(session->options.host, &public_diag);
}

// Gives a diagnostic unless one of this key was given before; an empty key stands for the whole text.
static void tell_once(PetriSession *session, const Diag *diag, Str key) {
    if (key.len && !told_add(session, key))
        return; // before anything is rendered: it may come in every frame
    ArenaMark mark = arena_mark(&session->text_arena);
    Text rendered = text_new(&session->text_arena);
    diag_format(&rendered, diag, session->options.colour);
    if (key.len || told_add(session, text_str(&rendered)) || session->tell_again) {
        give(session, diag, text_str(&rendered));
        if (session->told_count == MOST_TOLD) {
            Diag last = {.level = DIAG_NOTE, .text = STR("1000 diagnostics were given; no more are shown")};
            rendered.len = 0;
            diag_format(&rendered, &last, session->options.colour);
            give(session, &last, text_str(&rendered));
        }
    }
    arena_rewind(&session->text_arena, mark);
}

void session_tell(PetriSession *session, const Diag *diag) {
    tell_once(session, diag, (Str){0});
}

void session_tell_text(PetriSession *session, DiagLevel level, const char *code, Str text) {
    session_tell(session, &(Diag){.level = level, .text = text, .code = code});
}

void session_tell_all(PetriSession *session, const DiagSink *sink) {
    for (uint32_t i = 0; i < sink->count; i++)
        session_tell(session, &sink->items[i]);
    if (sink->dropped)
        session_tell_text(session, DIAG_NOTE, NULL,
                          str_format(sink->arena, "%u more diagnostics are not shown", sink->dropped));
}

uint64_t petri_diagnostic_count(const PetriSession *session, PetriLevel level) {
    return session->counts[level];
}

// One part of a -D value (L16.3).
static void add_define_part(PetriSession *session, Vector *vector, Str part) {
    double x;
    const Symbol *symbol = part.len > 1 && part.bytes[0] == ':'
                               ? symbol_know(&session->symbols, (Str){part.bytes + 1, part.len - 1})
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
        add_define_part(session, &vector, part);
        if (!end)
            return vector_finish(&vector);
        text = (Str){end + 1, text.len - part.len - 1};
    }
}

// Is a text a name of the language (L2.4)?
static bool is_name(Str text) {
    while (text.len > 1 && text.bytes[text.len - 1] == '\'')
        text.len--;
    for (size_t at = 0, next = 0; at < text.len; at = next) {
        int32_t c = utf8_next(text, &next);
        if (c < 0 || !(at == 0 ? unicode_starts_name((uint32_t)c) : unicode_continues_name((uint32_t)c)))
            return false;
    }
    return text.len > 0;
}

PetriStatus petri_define(PetriSession *session, const char *definition) {
    const char *equals = strchr(definition, '=');
    if (!equals)
        return PETRI_INVALID;
    return session_define(session, (Str){definition, (size_t)(equals - definition)}, str_from(equals + 1));
}

PetriStatus session_define(PetriSession *session, Str name, Str value) {
    if (!is_name(name) || utf8_find_error(value) != value.len)
        return PETRI_INVALID;
    uint32_t count = session->define_count;
    Define *defines = arena_alloc_array(&session->arena, count + 1, sizeof *defines);
    if (count)
        memcpy(defines, session->defines, count * sizeof *defines);
    Str text = str_format(&session->arena, "%.*s=%.*s", (int)name.len, name.bytes, (int)value.len, value.bytes);
    value = (Str){text.bytes + name.len + 1, value.len};
    defines[count] =
        (Define){symbol_intern(&session->symbols, name), define_value(session, value), str_to_c(&session->arena, text)};
    session->defines = defines;
    session->define_count = count + 1;
    session_change_config(session, true);
    return PETRI_OK;
}

typedef struct LoadRequest {
    const char *file; // or, if NULL, a text
    Str name;         // of either
    Str text;
    Str path;    // of the file that the text was read from, if it was, else the name
    Str version; // likewise, else empty
} LoadRequest;

// Loads within an escape. What is known after a jump is in *unit, not in a local that the jump may have clobbered.
static bool load_guarded(PetriSession *session, const LoadRequest *request, Unit **unit) {
    jmp_buf escape;
    session->frame_arena.escape = &escape;
    session_set_globals(session, &session->static_vm);
    bool escaped = setjmp(escape) != 0;
    if (!escaped)
        *unit = request->file ? unit_load_file(session, request->file, false)
                              : unit_load_text(session, request->name, request->path, request->text, request->version);
    session->frame_arena.escape = NULL;
    session->loading = NULL;
    return !escaped;
}

static void report_too_large(PetriSession *session) {
    session_tell_text(session, DIAG_ERROR, "memory-limit", STR("the script is too large: the limit is 4 GiB"));
}

typedef enum LoadPurpose { LOAD_AFRESH, LOAD_TO_GO_ON } LoadPurpose;

// Puts a unit in the place of the loaded script.
static void adopt(PetriSession *session, Unit *unit, LoadPurpose purpose) {
    session_clear_frame(session); // its tree may lie in the old unit
    unit_free(session->program);
    session->program = session_put(session, unit);
    if (purpose == LOAD_AFRESH)
        session_start(session, unit->program);
    else
        session_take_rates(session, unit->program);
    session_change_config(session, false);
    session_compile_prompts(session);
    session->unseen = true;
}

static PetriStatus load(PetriSession *session, const LoadRequest *request, LoadPurpose purpose) {
    Unit *unit = NULL;
    PetriStatus status = PETRI_OK;
    if (!session->again) { // each thing once per load
        session->told_count = 0;
        index_clear(&session->told_index);
    }
    session->fresh = NULL;
    if (!load_guarded(session, request, &unit) || !unit) {
        unit_free(session->fresh);
        report_too_large(session);
        return PETRI_MEMORY;
    }
    unit->arena.escape = NULL;
    if (!unit->source)
        session_tell_text(session, DIAG_ERROR, "cannot-read",
                          str_format(&unit->arena, "cannot read '%.*s': %.*s", (int)request->name.len,
                                     request->name.bytes, (int)unit->why.len, unit->why.bytes));
    if (!unit->program)
        status = PETRI_INVALID;
    if (status == PETRI_OK)
        adopt(session, unit, session->program ? purpose : LOAD_AFRESH);
    else
        unit_free(unit);
    return status;
}

PetriStatus petri_load(PetriSession *session, const char *file) {
    return load(session, &(LoadRequest){.file = file, .name = str_from(file)}, LOAD_AFRESH);
}

PetriStatus petri_load_text(PetriSession *session, const char *name, const char *text, size_t length) {
    Str content = {text, length == PETRI_Z ? strlen(text) : length};
    return load(session, &(LoadRequest){.name = str_from(name), .path = str_from(name), .text = content}, LOAD_AFRESH);
}

// The text is the same, so what was told of it stays told.
static PetriStatus load_again(PetriSession *session) {
    if (!session->program)
        return PETRI_INVALID;
    const Unit *unit = session->program;
    LoadRequest request = {
        .name = unit->source->name, .text = unit->source->text, .path = unit->path, .version = unit->version};
    session->again = true;
    PetriStatus status = load(session, &request, LOAD_TO_GO_ON);
    session->again = false;
    return status;
}

PetriStatus petri_reload(PetriSession *session, const char *file) {
    if (!file)
        return load_again(session);
    return load(session, &(LoadRequest){.file = file, .name = str_from(file)}, LOAD_TO_GO_ON);
}

bool petri_builtin(size_t index, PetriBuiltin *builtin) {
    if (index >= builtin_count)
        return false;
    const Builtin *row = &builtin_table[index];
    *builtin = (PetriBuiltin){row->name, row->parameters, row->help};
    return true;
}

bool petri_read_number(const char *text, double *x) {
    return literal_parse_number(str_from(text), x) || literal_parse_timecode(str_from(text), x);
}

const char *petri_version(void) {
    return PETRI_VERSION;
}
