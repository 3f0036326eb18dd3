// session.c: opening and closing sessions, with their options and components.
#include "session/session.h"

#include "base/heap.h"
#include "base/host_struct.h"
#include "base/spec.h"
#include "builtin/files.h"

#include <math.h>
#include <string.h>

enum { MAX_LOG_LINES = 100000 };
// Bytes that a session may hold for its own data, in addition to PetriOptions.memory_limit. The script has little
// influence on this amount.
#define OWN_BYTES ((size_t)64 << 20)

void petri_options_init(PetriOptions *options, size_t size) {
    const PetriOptions usual = {.size = size,
                                .fps = 60,
                                .run_time = NAN,
                                .stack_limit = (size_t)4 << 20,
                                .memory_limit = (size_t)2 << 30,
                                .work_limit = UINT64_C(1) << 30};
    host_struct_write(options, size, &usual, sizeof usual);
}

// The options of a host, and copies of the structs to which they point.
typedef struct Wanted {
    PetriOptions options;
    PetriTuning tuning;
    PetriRanks ranks;
} Wanted;

// Reads the options of a host. Returns the reason why they are not valid, or NULL.
static const char *read_options(Wanted *wanted, const PetriOptions *given) {
    PetriOptions *options = &wanted->options;
    unsigned old_rules;
    *wanted = (Wanted){.tuning = {.size = sizeof wanted->tuning}};
    petri_options_init(options, sizeof *options);
    if (!host_struct_read(options, sizeof *options, given))
        return "the options were not initialised, or a later version of petri knows one of them";
    if (options->ranks && !host_struct_read(&wanted->ranks, sizeof wanted->ranks, options->ranks))
        return "ranks were not initialised";
    if (options->ranks && !ranks_available())
        return "this build of libpetri has no ranks";
    if (options->tuning && !host_struct_read(&wanted->tuning, sizeof wanted->tuning, options->tuning))
        return "tuning was not initialised";
    options->ranks = options->ranks ? &wanted->ranks : NULL;
    options->tuning = &wanted->tuning;
    if (!(options->fps > 0) || !isfinite(options->fps))
        return "fps is not positive and finite";
    return options->spec && !spec_find(options->spec, &old_rules) ? "spec is not a version of the specification" : NULL;
}

const char *petri_options_problem(const PetriOptions *options) {
    Wanted wanted;
    return read_options(&wanted, options);
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

static PhysOptions physics_options(const PetriOptions *options, Ranks *ranks) {
    PhysOptions physics = {.threads = options->threads,
                           .neighbours = (PhysNeighbours)options->tuning->neighbours,
                           .keep_forces = options->keep_forces,
                           .division = ranks_init(ranks, options->ranks)};
    if (options->spec)
        spec_find(options->spec, &physics.old_rules);
    cpu_choose(options->tuning->cpu, &physics.cpu);
    return physics;
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
    recorder_set(session, NULL);
    file_access_add(&session->arena, &session->reach, FILE_ACCESS_READ, (const char *const[]){".", NULL});
    file_access_add(&session->arena, &session->reach, FILE_ACCESS_READ, options->read_folders);
    file_access_add(&session->arena, &session->reach, FILE_ACCESS_WRITE, options->write_folders);
    session->options.read_folders = session->options.write_folders = NULL; // they pointed to the host's memory
    session->vm.builtins.noise = session->static_vm.builtins.noise = session->noise;
    session->config.prompts = prompt_list_new((Names){0}, NULL);
    if (!session->state || !session->files || !session->noise || !session->config.prompts ||
        (options->profile && !session->vm.profile))
        return PETRI_OUT_OF_MEMORY;
    PhysOptions physics = physics_options(options, &session->ranks);
    session->spec_chosen = options->spec;
    session->options.spec = NULL;  // pointed to the host's memory
    session->options.ranks = NULL; // these pointed to local variables of petri_open
    session->options.tuning = NULL;
    scene_set_physics(session->scene, &physics);
    session->old_rules = physics.old_rules;
    return PETRI_OK;
}

const char *petri_spec(const PetriSession *session) {
    return spec_version(session ? session->old_rules : 0);
}

PetriSession *petri_open(const PetriOptions *options) {
    Wanted wanted;
    if (read_options(&wanted, options))
        return NULL;
    options = &wanted.options;
    PetriSession *session = heap_calloc(1, sizeof *session);
    if (!session)
        return NULL;
    SessionFrame *frame = &session->frame;
    session->options = *options;
    session->budget.memory_limit =
        options->memory_limit < SIZE_MAX - OWN_BYTES ? options->memory_limit + OWN_BYTES : SIZE_MAX;
    session->interrupt_source = &session->interrupt;
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
    frame->log = diag_sink_new(&frame->arena, MAX_LOG_LINES);
    frame->errors = diag_sink_new(&frame->arena, MAX_LOG_LINES);
    session->symbols = symbol_table_new(&session->arena);
    session->clock = (Clock){.realtime = options->realtime, .number = -1};
    session->frame_realtime = options->realtime;
    vm_init(&session->vm, &frame->arena, &session->symbols, (VmHost){session, report_vm, log_vm, session_module},
            options->stack_limit, false);
    vm_init(&session->static_vm, &frame->arena, &session->symbols,
            (VmHost){session, ignore_diagnostic, log_vm, session_module}, options->stack_limit, true);
    session->vm.no_batches = session->static_vm.no_batches = options->tuning->no_batches;
    session->no_simplify = options->tuning->no_simplify;
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
    recorder_set(session, NULL);
    petri_config_free(session->shared_config);
    session_free_host_globals(session);
    prompt_list_free(session->config.prompts);
    unit_free(session->config.program);
    for (Unit *unit = session->loader.modules, *next; unit; unit = next) {
        next = unit->next;
        unit_free(unit);
    }
    heap_free(session->undo.bytes);
    phys_explanation_free(&session->explanation);
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
