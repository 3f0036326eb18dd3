// load.c: loading of scripts, modules and includes (spec language.md L13, L14).
#include "base/file.h"
#include "base/heap.h"
#include "petri-inspect.h"
#include "session/session.h"
#include "syntax/parse.h"

#include <string.h>

#define MAX_SOURCE_BYTES ((size_t)256 << 20)
enum { MAX_ERRORS = 50 };

static void report_and_free(PetriSession *session, DiagSink *sink) {
    session_report_all(session, sink);
    diag_sink_free(sink);
}

// Adds a path to the unit's included files. Returns false if it is already included.
static bool add_include(Unit *unit, Str path) {
    for (uint32_t i = 0; i < unit->included_count; i++)
        if (str_equal(unit->included[i], path))
            return false;
    size_t size = unit->included_count * sizeof(Str);
    unit->included = arena_grow(&unit->arena, unit->included, size, size + sizeof(Str));
    unit->included[unit->included_count++] = path;
    return true;
}

static const Ast *parse_loaded_source(PetriSession *session, Unit *unit, Arena *arena, const Source *source) {
    unit->parse_sink = diag_sink_new(unit_arena(session, unit), MAX_ERRORS);
    const Ast *ast = parse_program(arena, &session->symbols, source, &unit->parse_sink);
    report_and_free(session, &unit->parse_sink);
    return ast;
}

// Returns a cached tree, but charges the work of parsing it. The work limit is then reached at the same point as
// without the cache.
static const Ast *charge_cached_parse(PetriSession *session, const Ast *ast, uint64_t work) {
    arena_charge(&session->arena, work);
    return ast;
}

static const Parsed *find_parsed(const Unit *unit, Str name, Str path, Str version) {
    const Parsed *parsed = unit->parse_cache ? unit->parse_cache->parsed : NULL;
    while (parsed && (!str_equal(parsed->source->name, name) || !str_equal(parsed->source->path, path) ||
                      !str_equal(parsed->version, version)))
        parsed = parsed->next;
    return parsed;
}

static const Ast *cache_parsed(PetriSession *session, Unit *cache, const Source *source, Str version) {
    uint64_t before = session->budget.work;
    const Ast *ast = parse_loaded_source(session, cache, &cache->arena, source);
    if (!ast)
        return NULL;
    Parsed *parsed = arena_alloc(&cache->arena, sizeof *parsed);
    *parsed = (Parsed){cache->parsed, source, ast, session->budget.work - before, str_copy(&cache->arena, version)};
    cache->parsed = parsed;
    return ast;
}

// Reads and parses an included file. If it cannot be read, sets *problem to the reason and returns false. If it has
// syntax errors, sets *ast to NULL and returns true.
static bool read_include(PetriSession *session, Unit *unit, Str path, Str canonical, const Source **source,
                         const Ast **ast, const char **problem) {
    const char *file = str_to_c(&unit->arena, path);
    Str version = {0}, text;
    bool versioned = unit->parse_cache && file_version(&unit->scratch, &session->reach, file, &version);
    const Parsed *parsed = versioned ? find_parsed(unit, path, canonical, version) : NULL;
    if (parsed) {
        *source = parsed->source;
        *ast = charge_cached_parse(session, parsed->ast, parsed->work);
        return true;
    }
    Arena *arena = unit->parse_cache ? unit_arena(session, unit->parse_cache) : &unit->arena;
    if (!file_read(arena, &session->reach, file, true, MAX_SOURCE_BYTES, &text, &version, problem))
        return false;
    *source = source_new(arena, path, canonical, text);
    *ast = unit->parse_cache ? cache_parsed(session, unit->parse_cache, *source, version)
                             : parse_loaded_source(session, unit, &unit->scratch, *source);
    return true;
}

static const Ast *host_include(void *host, Str path, const Source **source, Str *reason) {
    PetriSession *session = host;
    Unit *unit = session->loader.compiling;
    Str canonical = file_canonical(&unit->arena, &session->reach, str_to_c(&unit->arena, path));
    const char *problem;
    const Ast *ast;
    if (str_equal(canonical, unit->path) || !add_include(unit, canonical)) {
        *reason = STR("already included");
        return NULL;
    }
    if (!read_include(session, unit, path, canonical, source, &ast, &problem)) {
        *reason = str_from(problem);
        return NULL;
    }
    if (!ast) {
        *reason = STR("it has syntax errors");
        return NULL;
    }
    // Pragmas of an included file are ignored (L12).
    uint32_t skip = 0;
    while (skip < ast->count && ast->children[skip]->kind == AST_PRAGMA)
        skip++;
    return ast_new(&unit->scratch, AST_SUITE, ast->span, NULL, ast->children + skip, ast->count - skip);
}

// Limits of constant folding: bytes and work units per expression, and work units per load. An expression that exceeds
// a limit is evaluated in each frame instead.
#define STATIC_BUDGET ((size_t)1 << 29)
enum { STATIC_WORK = 3 << 24, MAX_STATIC_WORK = 1 << 26 };

typedef struct StaticEvaluation {
    const Code *code;
    Value value;
} StaticEvaluation;

static PetriStatus evaluate_static(PetriSession *session, void *context) {
    StaticEvaluation *evaluation = context;
    Arena *arena = &session->loader.compiling->arena;
    return vm_run_static(&session->static_vm, arena, evaluation->code, &evaluation->value) ? PETRI_OK : PETRI_INVALID;
}

// Folds a constant expression. Returns false if it could not be folded; each frame then evaluates it instead.
static bool host_evaluate(void *host, const Code *code, Value *value) {
    PetriSession *session = host;
    Arena *arena = &session->loader.compiling->arena;
    size_t limit = arena->limit;
    StaticEvaluation evaluation = {.code = code};
    if (arena->limit - arena->used > STATIC_BUDGET)
        arena->limit = arena->used + STATIC_BUDGET;
    Budget *budget = &session->budget, saved = *budget;
    uint64_t left = session->loader.static_work < MAX_STATIC_WORK ? MAX_STATIC_WORK - session->loader.static_work : 0;
    budget_begin(budget, left < STATIC_WORK ? left : STATIC_WORK, budget->interrupt);
    PetriStatus status = session_protect(session, arena, evaluate_static, &evaluation);
    arena->limit = limit;
    session->loader.static_work += budget->work;
    session->total_work += budget->work;
    budget_begin(budget, saved.work_limit, saved.interrupt);
    budget->work = saved.work;
    if (status == PETRI_OUT_OF_MEMORY || status == PETRI_INTERRUPTED)
        arena_escape(arena, status == PETRI_OUT_OF_MEMORY ? ARENA_OUT_OF_MEMORY : ARENA_INTERRUPTED);
    *value = status == PETRI_OK ? evaluation.value : VALUE_NULL;
    return status == PETRI_OK;
}

// Sorts diagnostics of the same file by position. They can be out of order because, for example, an unused name is
// reported only at the end of its scope.
static void sort_by_place(DiagSink *sink) {
    for (uint32_t i = 1; i < sink->count; i++) {
        Diag diag = sink->items[i];
        uint32_t at = i;
        for (; at > 0 && sink->items[at - 1].at.source == diag.at.source &&
               sink->items[at - 1].at.span.start > diag.at.span.start;
             at--)
            sink->items[at] = sink->items[at - 1];
        sink->items[at] = diag;
    }
}

// Returns the file access if the host provides the files (PetriOptions.read_file), else NULL.
static const FileAccess *host_files(const PetriSession *session) {
    return session->reach.read_file ? &session->reach : NULL;
}

const Program *unit_compile(PetriSession *session, Unit *unit, const Ast *ast, bool module, Names params) {
    unit->sink = diag_sink_new(unit_arena(session, unit), MAX_ERRORS);
    CompileOptions options = {.module = module,
                              .lint = session->loader.lint,
                              .simplify = !session->no_simplify,
                              .lines = session->options.profile,
                              .defines = session->config.defines,
                              .define_count = session->config.define_count,
                              .params = params.items,
                              .param_count = params.count,
                              .functions = session->functions.rows,
                              .files = host_files(session),
                              .function_count = session->functions.count,
                              .host = {session, host_include, host_evaluate}};
    Unit *outer = session->loader.compiling;
    session->loader.compiling = unit;
    const Program *program =
        program_compile(&unit->arena, &unit->scratch, &session->symbols, unit->source, ast, &options, &unit->sink);
    session->loader.compiling = outer;
    sort_by_place(&unit->sink);
    report_and_free(session, &unit->sink);
    return program;
}

static void compile_unit(PetriSession *session, Unit *unit, const Ast *ast, bool module) {
    Names host_names = {session->host_globals.names, session->host_globals.count};
    unit->empty = ast && ast->count == 0;
    if (ast)
        unit->program = unit_compile(session, unit, ast, module, module ? (Names){0} : host_names);
    else
        unit->error = STR("it has syntax errors");
    arena_free(&unit->scratch);
}

static void load_text(PetriSession *session, Unit *unit, Str name, Str text, bool module) {
    unit->source = source_new(&unit->arena, name, unit->path, text);
    compile_unit(session, unit, parse_loaded_source(session, unit, &unit->scratch, unit->source), module);
}

Unit *unit_parse(PetriSession *session, Str text) {
    const Str name = STR("prompt");
    Unit *unit = session->loader.pending = unit_new(session);
    unit->path = name;
    unit->source = source_new(&unit->arena, name, name, text);
    unit->ast = parse_loaded_source(session, unit, &unit->arena, unit->source);
    return unit;
}

// Gives the script access to its own folder. `name` is the path of the script.
static void set_script_folder(PetriSession *session, Unit *unit, Str name) {
    unit->folder = file_access_folder(&unit->arena, path_directory(name));
    session->reach.script_folder = unit->folder;
    session->reach.directory = str_copy(&unit->arena, path_directory(name));
}

Unit *unit_load_text(PetriSession *session, Str name, Str text) {
    Unit *unit = session->loader.pending = unit_new(session);
    set_script_folder(session, unit, name);
    unit->path = str_copy(&unit->arena, name);
    recorder_file(session, unit->path.bytes, text);
    load_text(session, unit, name, text, false);
    return unit;
}

// Caches the syntax tree of a script in `owner`. Called only when the script is compiled a second time.
static void make_parse_cache(PetriSession *session, Unit *owner, const Unit *unit) {
    owner->parse_cache = unit_new(session);
    Unit *cache = owner->parse_cache;
    Arena *arena = unit_arena(session, cache);
    cache->source = source_new(arena, unit->source->name, unit->path, unit->source->text);
    uint64_t before = session->budget.work;
    cache->ast = parse_loaded_source(session, cache, arena, cache->source);
    cache->work = session->budget.work - before;
}

Unit *unit_reload(PetriSession *session, Unit *unit, bool read_again) {
    Unit *reloaded = session->loader.pending = unit_new(session);
    set_script_folder(session, reloaded, unit->source->name);
    reloaded->path = str_copy(&reloaded->arena, unit->path);
    reloaded->version = str_copy(&reloaded->arena, unit->version);
    // The old cache contains included files, and stays valid because the text of `unit` can be in it.
    Unit *owner = read_again ? reloaded : unit;
    bool parsed = owner->parse_cache && owner->parse_cache->ast;
    if (!parsed) {
        unit_free(owner->parse_cache); // it has no tree if its parsing was aborted
        owner->parse_cache = NULL;
        make_parse_cache(session, owner, unit);
    }
    if (!read_again) {
        reloaded->parse_cache = unit->parse_cache;
        reloaded->parse_cache->references++;
    }
    reloaded->source = reloaded->parse_cache->source;
    compile_unit(session, reloaded,
                 parsed ? charge_cached_parse(session, reloaded->parse_cache->ast, reloaded->parse_cache->work)
                        : reloaded->parse_cache->ast,
                 false);
    return reloaded;
}

Unit *unit_load_file(PetriSession *session, const char *file, bool module, bool regular) {
    Unit *unit = unit_new(session);
    if (module) { // added to the list before it is loaded, so that it is freed even if loading fails with a longjmp
        unit->next = session->loader.modules;
        session->loader.modules = unit;
        unit->retired = true; // reset when loading is complete
    } else {
        session->loader.pending = unit;
        set_script_folder(session, unit, str_from(file));
    }
    Str text;
    const char *problem;
    unit->path = file_canonical(&unit->arena, &session->reach, file);
    // The script itself may be anywhere, because the host chose it.
    const FileAccess *reach = module ? &session->reach : host_files(session);
    bool read = file_read(&unit->arena, reach, file, regular, MAX_SOURCE_BYTES, &text, &unit->version, &problem);
    if (!reach)
        recorder_file(session, file, read ? text : (Str){0});
    if (read)
        load_text(session, unit, str_from(file), text, module);
    else
        unit->error = str_copy(&unit->arena, str_from(problem));
    unit->retired = false;
    return unit;
}

// Reads a module whose file is new or has changed. `before` is its cached version; NULL: none. If it
// cannot be compiled, keeps the last good version.
static Unit *read_module(PetriSession *session, const char *file, Unit *before) {
    Unit *good = before && !before->program ? before->last_good : before;
    if (before) {
        before->retired = true;
        session_change_config(session, true);
    }
    Unit *unit = unit_load_file(session, file, true, true);
    unit->load = session->loader.loads;
    if (!unit->program && good) {
        good->references++;
        unit->last_good = good;
    }
    session_add_module(session, session_use_unit(session, unit));
    return unit;
}

// Returns the module at a path. On failure, sets *reason and returns NULL.
static Unit *current_module(PetriSession *session, const char *file, Str canonical, Str *reason) {
    Unit *unit = session_find_module(session, canonical);
    if (unit && session->options.keep_modules && unit->load == session->loader.loads)
        return unit;
    Str version;
    if (!file_version(&session->frame.arena, host_files(session), file, &version)) {
        recorder_file(session, file, (Str){0});
        *reason = STR("no such file");
        return NULL;
    }
    if (session->reach.read_unsaved)
        file_version(&session->frame.arena, &session->reach, file, &version);
    if (!file_access_allows(&session->reach, FILE_ACCESS_READ, canonical.bytes)) {
        *reason = str_from(file_access_reason(&session->frame.arena, &session->reach, FILE_ACCESS_READ, file));
        return NULL;
    }
    if (!unit || !str_equal(unit->version, version))
        return read_module(session, file, unit);
    unit->load = session->loader.loads;
    return unit;
}

const Program *session_module(void *host, Str path, Str *reason) {
    PetriSession *session = host;
    const char *file = str_to_c(&session->frame.arena, path);
    Str canonical = file_canonical(&session->frame.arena, &session->reach, file);
    Unit *unit = current_module(session, file, canonical, reason);
    if (!unit)
        return NULL;
    *reason = unit->error;
    return unit->program || !unit->last_good ? unit->program : unit->last_good->program;
}

const char *petri_source_file(PetriSession *session, size_t number) {
    if (!session)
        return NULL;
    for (Unit *unit = session->config.program; unit;
         unit = unit == session->config.program ? session->loader.modules : unit->next) {
        if (unit->retired || !unit->version.len) // no version: loaded from memory, or its file could not be read
            continue;
        if (number <= unit->included_count)
            return (number == 0 ? unit->path : unit->included[number - 1]).bytes;
        number -= unit->included_count + 1;
    }
    return NULL;
}
