// session.c: opening and closing sessions, protected calls, definitions and loading.
#include "session/session.h"

#include "ast/literal.h"
#include "base/heap.h"
#include "base/unicode.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_LINES = 100000 };
// Bytes that a session may hold for its own data, in addition to PetriOptions.memory_limit. The script has little
// influence on this amount.
#define OWN_BYTES ((size_t)64 << 20)

void petri_options_init(PetriOptions *options, size_t size) {
    const PetriOptions usual = {.size = size,
                                .fps = 60,
                                .run_time = NAN,
                                .simplify = true,
                                .stack_limit = (size_t)4 << 20,
                                .memory_limit = (size_t)2 << 30,
                                .work_limit = UINT64_C(1) << 30};
    if (options)
        memcpy(options, &usual, size < sizeof usual ? size : sizeof usual);
}

// Reads the options of a host, which may have been compiled with an older petri.h and a shorter struct. Returns false
// if they were not initialised, come from a newer petri.h, or are not valid.
static bool read_options(PetriOptions *options, const PetriOptions *given) {
    if (!given || given->size < offsetof(PetriOptions, cpu) || given->size > sizeof *options)
        return false;
    petri_options_init(options, sizeof *options);
    memcpy(options, given, given->size);
    return options->fps > 0 && isfinite(options->fps);
}

static void report_scene(void *host, DiagLevel level, const char *code, const Origin *origin, Str node, Str key,
                         Str text) {
    PetriSession *session = host;
    Arena *arena = &session->frame.systems_arena;
    Str whole = str_format(arena, "%.*s: %.*s", STR_ARGS(node), STR_ARGS(text));
    Diag diag = {.level = level, .text = whole, .code = code};
    if (origin)
        diag.at = *origin;
    diag_report(&session->frame.errors, &diag);
    // A loop can create a thousand nodes from one position in the script. A problem that they share is reported once,
    // because the key contains their position instead of their names.
    Str where =
        diag.at.source ? str_format(arena, "%.*s %u", STR_ARGS(diag.at.source->path), diag.at.span.start) : node;
    session_report_keyed(session, &diag, str_format(arena, "%s %.*s %.*s", code, STR_ARGS(where), STR_ARGS(key)));
}

static void report_vm(void *host, const Diag *diag) {
    PetriSession *session = host;
    if (session->frame.evaluating)
        diag_report(&session->frame.errors, diag);
    session_report(session, diag);
}

// Receives errors in expressions that are folded at load time. They are ignored here, because they are reported when a
// frame evaluates the expression.
static void ignore_diagnostic(void *host, const Diag *diag) {
    (void)host;
    (void)diag;
}

static void log_vm(void *host, Str text) {
    PetriSession *session = host;
    diag_report(&session->frame.log, &(Diag){.level = DIAG_NOTE, .text = text});
}

_Static_assert((int)PETRI_NEIGHBOURS_NEVER == (int)PHYS_NEIGHBOURS_NEVER &&
                   (int)PETRI_NEIGHBOURS_ALWAYS == (int)PHYS_NEIGHBOURS_ALWAYS,
               "the public values match those of the engine");

static PhysOptions physics_options(const PetriOptions *options) {
    PhysOptions physics = {.threads = options->threads,
                           .neighbours = (PhysNeighbours)options->neighbours,
                           .keep_forces = options->keep_forces};
    cpu_choose(options->cpu, &physics.cpu);
    const PetriRanks *ranks = options->ranks;
    if (ranks)
        physics.ranks = (PhysRanks){ranks->rank,          ranks->rank_count,  ranks->min_pairs, ranks->user_data,
                                    ranks->send,          ranks->receive,     ranks->broadcast, ranks->allgatherv,
                                    ranks->allreduce_max, ranks->alloc_shared};
    return physics;
}

typedef struct Call {
    PetriSession *session;
    SessionCall *call;
    void *context;
    PetriStatus status;
} Call;

static void run_call(void *context) {
    Call *call = context;
    call->status = call->call(call->session, call->context);
}

PetriStatus session_protect(PetriSession *session, Arena *extra, SessionCall *call, void *context) {
    static const PetriStatus statuses[] = {[ARENA_OUT_OF_MEMORY] = PETRI_OUT_OF_MEMORY,
                                           [ARENA_MEMORY_LIMIT] = PETRI_LIMIT_EXCEEDED,
                                           [ARENA_WORK_LIMIT] = PETRI_LIMIT_EXCEEDED,
                                           [ARENA_INTERRUPTED] = PETRI_INTERRUPTED};
    SessionFrame *frame = &session->frame;
    Arena *arenas[] = {&session->arena, &session->text_arena,  &session->view_arena,   &session->key_arena,
                       &frame->arena,   &frame->systems_arena, &session->prompt.arena, extra};
    Unit *compiling = session->loader.compiling;
    bool working = frame->evaluating;
    uint64_t before = 0;
    Call made = {session, call, context, PETRI_OK};
    if (session->rollback_pending && !session_rollback(session))
        return PETRI_OUT_OF_MEMORY;
    if (session->call_depth++ == 0) {
        budget_begin(&session->budget, session->options.work_limit,
                     session->uninterruptible ? NULL : &session->interrupt);
        session->budget.work = before = session->spent;
        session->spent = 0;
        session->vm.at = NULL;
        session->schema.current_node = NULL;
    }
    ArenaOutcome end = arena_protect(arenas, sizeof arenas / sizeof *arenas, run_call, &made);
    if (--session->call_depth == 0)
        session->total_work += session->budget.work - before;
    if (end == ARENA_OK)
        return made.status;
    session->last_outcome = end;
    session->loader.compiling = compiling;
    frame->evaluating = working;
    session->vm.arena = session->vm.builtins.arena = &frame->arena;
    return statuses[end];
}

PetriStatus session_run(PetriSession *session, SessionCall *call, void *context, const char *what) {
    return session_report_abort(session, session_protect(session, NULL, call, context), what);
}

PetriStatus session_report_abort(PetriSession *session, PetriStatus status, const char *what) {
    if (status == PETRI_INTERRUPTED)
        petri_clear_interrupt(session);
    if (status != PETRI_OUT_OF_MEMORY && status != PETRI_LIMIT_EXCEEDED)
        return status;
    bool work = status == PETRI_LIMIT_EXCEEDED && session->last_outcome == ARENA_WORK_LIMIT;
    char text[120];
    if (status == PETRI_OUT_OF_MEMORY)
        snprintf(text, sizeof text, "out of memory: %s was aborted", what);
    else if (work)
        snprintf(text, sizeof text, "%s exceeded its limit of %" PRIu64 " work units and was aborted", what,
                 session->options.work_limit);
    else
        snprintf(text, sizeof text, "%s exceeded its memory limit of %zu MiB and was aborted", what,
                 session->options.memory_limit >> 20);
    Diag diag = {.level = DIAG_ERROR, .text = str_from(text), .code = work ? "work-limit" : "memory-limit"};
    if (status == PETRI_LIMIT_EXCEEDED)
        diag.at = session->vm.at                 ? *session->vm.at
                  : session->schema.current_node ? node_origin(session->schema.current_node, NULL)
                                                 : (Origin){0};
    size_t limit = session->budget.memory_limit;
    session->budget.memory_limit = SIZE_MAX; // the report itself needs memory
    session_report(session, &diag);
    session->budget.memory_limit = limit;
    return status;
}

bool session_rollback(PetriSession *session) {
    session->rollback_pending = false; // so that the protected call of checkpoint_restore does not roll back again
    session->uninterruptible = true;
    session->rollback_pending = checkpoint_restore(session, &session->undo) != PETRI_OK;
    session->uninterruptible = false;
    return !session->rollback_pending;
}

// Creates the components of a session.
static PetriStatus init_components(PetriSession *session, void *context) {
    (void)context;
    const PetriOptions *options = &session->options;
    schema_init(&session->schema, &session->symbols, (SchemaSink){session, report_scene});
    session->scene = scene_new(&session->arena, &session->schema);
    session->state = state_new(&session->budget);
    session->files = file_cache_new();
    session->noise = noise_cache_new();
    session->vm.profile = options->profile ? vm_profile_new() : NULL;
    session->vm.builtins.files = session->files;
    session->vm.builtins.file_access = session->schema.file_access = &session->reach;
    session->reach.no_files = options->no_files;
    session->reach.read_file = options->read_file;
    session->reach.read_user_data = options->read_user_data;
    session->reach.read_unsaved = options->read_unsaved;
    file_access_add(&session->arena, &session->reach, FILE_ACCESS_READ, (const char *const[]){".", NULL});
    file_access_add(&session->arena, &session->reach, FILE_ACCESS_READ, options->read_folders);
    file_access_add(&session->arena, &session->reach, FILE_ACCESS_WRITE, options->write_folders);
    session->options.read_folders = session->options.write_folders = NULL; // they pointed to the host's memory
    session->vm.builtins.noise = session->static_vm.builtins.noise = session->noise;
    session->config.prompts = prompt_list_new((Names){0}, NULL);
    if (!session->state || !session->files || !session->noise || !session->config.prompts ||
        (options->profile && !session->vm.profile))
        return PETRI_OUT_OF_MEMORY;
    PhysOptions physics = physics_options(options);
    session->options.cpu = NULL; // like `ranks`, it pointed to the host's memory
    session->options.ranks = NULL;
    scene_set_physics(session->scene, &physics);
    return PETRI_OK;
}

void session_arena(PetriSession *session, Arena *arena, const char *name, size_t limit) {
    arena_init(arena, name, limit);
    arena->budget = &session->budget;
}

PetriSession *petri_open(const PetriOptions *options) {
    PetriOptions wanted;
    if (!read_options(&wanted, options))
        return NULL;
    options = &wanted;
    PetriSession *session = heap_calloc(1, sizeof *session);
    if (!session)
        return NULL;
    SessionFrame *frame = &session->frame;
    session->options = *options;
    session->budget.memory_limit =
        options->memory_limit < SIZE_MAX - OWN_BYTES ? options->memory_limit + OWN_BYTES : SIZE_MAX;
    session->budget.should_interrupt = options->should_interrupt;
    session->budget.user_data = options->user_data;
    budget_begin(&session->budget, options->work_limit, NULL);
    session_arena(session, &session->arena, "session", SIZE_MAX);
    session_arena(session, &session->text_arena, "text", SIZE_MAX);
    session_arena(session, &session->view_arena, "view", SIZE_MAX);
    session_arena(session, &session->key_arena, "key", SIZE_MAX);
    session_arena(session, &session->prompt.arena, "expression", options->memory_limit);
    session_arena(session, &frame->arena, "frame", options->memory_limit);
    session_arena(session, &frame->systems_arena, "systems", SIZE_MAX);
    frame->log = diag_sink_new(&frame->arena, MAX_LINES);
    frame->errors = diag_sink_new(&frame->arena, MAX_LINES);
    session->symbols = symbol_table_new(&session->arena);
    session->clock = (Clock){.realtime = options->realtime, .number = -1};
    vm_init(&session->vm, &frame->arena, &session->symbols, (VmHost){session, report_vm, log_vm, session_module},
            options->stack_limit, false);
    vm_init(&session->static_vm, &frame->arena, &session->symbols,
            (VmHost){session, ignore_diagnostic, log_vm, session_module}, options->stack_limit, true);
    if (session_protect(session, NULL, init_components, NULL) != PETRI_OK)
        petri_close(&session);
    return session;
}

void petri_close(PetriSession **handle) {
    if (!handle)
        return;
    PetriSession *session = *handle;
    *handle = NULL;
    if (!session)
        return;
    petri_config_free(session->shared_config);
    session_free_host_globals(session);
    prompt_list_free(session->config.prompts);
    unit_free(session->config.program);
    for (Unit *unit = session->loader.modules, *next; unit; unit = next) {
        next = unit->next;
        unit_free(unit);
    }
    heap_free(session->undo.bytes);
    scene_free(session->scene);
    state_free(session->state);
    file_cache_free(session->files);
    noise_cache_free(session->noise);
    vm_profile_free(session->vm.profile);
    vm_free(&session->vm);
    vm_free(&session->static_vm);
    diag_sink_free(&session->frame.log);
    diag_sink_free(&session->frame.errors);
    diagnostics_free(&session->diagnostics);
    symbol_table_free(&session->symbols);
    Arena *arenas[] = {&session->frame.arena, &session->frame.systems_arena, &session->text_arena, &session->view_arena,
                       &session->key_arena,   &session->prompt.arena,        &session->arena};
    for (size_t i = 0; i < sizeof arenas / sizeof *arenas; i++)
        arena_free(arenas[i]);
    arena_free_retained(&session->budget);
    heap_free(session);
}

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

bool session_is_name(Str text) {
    while (text.len > 1 && text.bytes[text.len - 1] == '\'')
        text.len--;
    for (size_t at = 0, next = 0; at < text.len; at = next) {
        int32_t c = utf8_next(text, &next);
        if (c < 0 || !(at == 0 ? unicode_starts_name((uint32_t)c) : unicode_continues_name((uint32_t)c)))
            return false;
    }
    return text.len > 0;
}

typedef struct Definition {
    Str name;
    Str value;
} Definition;

static PetriStatus run_define(PetriSession *session, void *context) {
    const Definition *definition = context;
    return session_define(session, definition->name, definition->value);
}

PetriStatus petri_define(PetriSession *session, const char *definition) {
    if (!session || !definition)
        return PETRI_INVALID;
    const char *equals = strchr(definition, '=');
    if (!equals)
        return PETRI_INVALID;
    Definition made = {{definition, (size_t)(equals - definition)}, str_from(equals + 1)};
    return session_protect(session, NULL, run_define, &made);
}

PetriStatus session_define(PetriSession *session, Str name, Str value) {
    if (!session_is_name(name) || utf8_find_error(value) != value.len)
        return PETRI_INVALID;
    uint32_t count = session->config.define_count;
    Define *defines = arena_alloc_array(&session->arena, count + 1, sizeof *defines);
    if (count)
        memcpy(defines, session->config.defines, count * sizeof *defines);
    Str text = str_format(&session->arena, "%.*s=%.*s", STR_ARGS(name), STR_ARGS(value));
    value = (Str){text.bytes + name.len + 1, value.len};
    defines[count] =
        (Define){symbol_intern(&session->symbols, name), define_value(session, value), str_to_c(&session->arena, text)};
    session->config.defines = defines;
    session->config.define_count = count + 1;
    session_change_config(session, true);
    return PETRI_OK;
}

typedef enum LoadPurpose { LOAD_RESTART, LOAD_CONTINUE } LoadPurpose;

typedef struct Load {
    const char *file; // NULL: load `text`, or compile `reload_of`
    bool regular;     // the file must not be a pipe, which can be read only once
    Str name;         // name for messages
    Str text;
    Unit *reload_of; // script whose text is compiled again, or NULL
    // Results
    Unit *unit;
    ClockRates rates;
    PromptList *prompts;
} Load;

static PetriStatus make_unit(PetriSession *session, void *context) {
    Load *load = context;
    session_set_globals(session, &session->static_vm);
    Unit *unit = load->reload_of ? unit_reload(session, load->reload_of)
                 : load->file    ? unit_load_file(session, load->file, false, load->regular)
                                 : unit_load_text(session, load->name, load->text);
    if (!unit->source)
        session_report_text(
            session, DIAG_ERROR, "cannot-read",
            str_format(&session->text_arena, "cannot read '%.*s': %.*s", STR_ARGS(load->name), STR_ARGS(unit->error)));
    load->unit = unit;
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
static PetriStatus recompile_script(PetriSession *session) {
    Unit *unit = session->config.program;
    if (!unit)
        return PETRI_INVALID;
    session->recompiling = true;
    PetriStatus status = load_script(session, &(Load){.name = unit->source->name, .reload_of = unit}, LOAD_CONTINUE);
    session->recompiling = false;
    return status;
}

PetriStatus petri_reload(PetriSession *session, const char *file) {
    if (!session)
        return PETRI_INVALID;
    if (!file)
        return recompile_script(session);
    return load_script(session, &(Load){.file = file, .regular = true, .name = str_from(file)}, LOAD_CONTINUE);
}

bool petri_builtin(size_t index, PetriBuiltin *builtin) {
    if (!builtin || index >= builtin_table_count)
        return false;
    const Builtin *row = &builtin_table[index];
    *builtin = (PetriBuiltin){row->name, row->parameters, row->help};
    return true;
}

bool petri_parse_number(const char *text, double *x) {
    return text && x && (literal_parse_number(str_from(text), x) || literal_parse_timecode(str_from(text), x));
}

#define TEXT(x) #x
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *petri_version(void) {
    return VERSION_TEXT(PETRI_VERSION_MAJOR, PETRI_VERSION_MINOR, PETRI_VERSION_PATCH);
}

int petri_version_number(void) {
    return PETRI_VERSION_NUMBER;
}

const char *petri_status_text(PetriStatus status) {
    static const char *const texts[] = {
        [PETRI_OK] = "success",
        [PETRI_INVALID] = "invalid argument",
        [PETRI_LIMIT_EXCEEDED] = "limit exceeded",
        [PETRI_OUT_OF_MEMORY] = "out of memory",
        [PETRI_UNSUPPORTED] = "not supported by this build",
        [PETRI_INTERRUPTED] = "interrupted",
    };
    return (unsigned)status < sizeof texts / sizeof texts[0] ? texts[status] : "unknown status";
}
