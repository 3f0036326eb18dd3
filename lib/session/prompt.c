// prompt.c: text typed by a person: what it means in the present frame, and what of it is kept (petri.h).
//
// Each statement is a program of its own whose parameters are the names in sight: the exports of the script and of the
// statements kept before it. Their values are those of the last evaluation (session_evaluate); what a kept statement
// binds is added to them. Expressions are evaluated in an arena of their own and leave nothing behind.
#include "session/session.h"

#include "syntax/parse.h"
#include "value/format.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_LINES = 10000, PIECE = 64 << 10 };

// One statement at work. What is known after an escape is here, not in locals.
typedef struct Job {
    Str text;
    Unit *unit;
    const Ast *ast; // of the statement
    const Program *program;
    Arena *arena; // for its value
    Value value;
    Value *exports;
    double seconds;
    bool stopped;
    DiagSink log; // what debug() said
    struct Writing *out;
    bool shown;           // the value is written, too
    const Symbol *hidden; // bound by the script as well
} Job;

// Text on its way to the host.
typedef struct Writing {
    PetriWrite *write;
    void *host;
    Text text;
    bool stopped;
} Writing;

static bool guarded(PetriSession *session, void (*stage)(PetriSession *, Job *), Job *job) {
    jmp_buf escape;
    session->frame_arena.escape = session->prompt_arena.escape = &escape;
    if (job->unit)
        job->unit->arena.escape = &escape;
    bool escaped = setjmp(escape) != 0;
    if (!escaped)
        stage(session, job);
    session->frame_arena.escape = session->prompt_arena.escape = NULL;
    if (job->unit)
        job->unit->arena.escape = NULL;
    session->vm.arena = session->vm.builtins.arena = &session->frame_arena;
    session->loading = NULL;
    session->in_frame = false;
    return !escaped;
}

static PetriStatus memory_status(PetriSession *session) {
    session_tell_text(session, DIAG_ERROR, "memory-limit", STR("not enough memory; given up"));
    return PETRI_LIMIT;
}

static bool add_name(PetriSession *session, const Symbol *name) {
    if (session->name_count == session->name_capacity) {
        uint32_t capacity = session->name_capacity ? session->name_capacity * 2 : 64;
        const Symbol **larger = realloc(session->names, capacity * sizeof *larger);
        if (!larger)
            return false;
        session->names = larger;
        session->name_capacity = capacity;
    }
    session->names[session->name_count++] = name;
    return true;
}

static void add_names(PetriSession *session, const Program *program) {
    for (uint32_t i = 0; i < program->export_count; i++)
        if (!add_name(session, program->exports[i].name))
            return;
}

void session_collect_names(PetriSession *session) {
    session->name_count = 0;
    if (session->program)
        add_names(session, session->program->program);
    for (uint32_t i = 0; i < session->prompt_count; i++)
        add_names(session, session->prompts[i].program);
}

static void compile(PetriSession *session, Job *job) {
    job->program = unit_compile(session, job->unit, job->ast, false, session->name_count);
    arena_free(&job->unit->scratch);
}

// A statement that does not fit in memory any more is dropped.
void session_compile_prompts(PetriSession *session) {
    uint32_t count = session->prompt_count, kept = 0;
    session->prompt_count = 0;
    session_collect_names(session);
    session_set_globals(session, &session->static_vm);
    for (uint32_t i = 0; i < count; i++) {
        Prompt prompt = session->prompts[i];
        Job job = {.unit = prompt.unit, .ast = prompt.ast};
        if (!guarded(session, compile, &job)) {
            unit_free(prompt.unit);
            continue;
        }
        prompt.program = job.program;
        session->prompts[kept++] = prompt;
        add_names(session, prompt.program);
    }
    session->prompt_count = kept;
}

void session_free_prompts(PetriSession *session) {
    for (uint32_t i = 0; i < session->prompt_count; i++)
        unit_free(session->prompts[i].unit);
    free(session->prompts);
    session->prompts = NULL;
    session->prompt_count = 0;
}

static void probe(PetriSession *session, Job *job) {
    Arena *arena = &session->prompt_arena;
    const Source *source = source_new(arena, STR("prompt"), STR("prompt"), job->text);
    job->value = value_number(parse_need(arena, &session->symbols, source));
}

PetriInput petri_input(PetriSession *session, const char *text, size_t length) {
    Job job = {.text = {text, length == PETRI_Z ? strlen(text) : length}};
    arena_reset(&session->prompt_arena);
    bool done = guarded(session, probe, &job);
    arena_reset(&session->prompt_arena);
    return done ? (PetriInput)job.value.as.number : PETRI_INPUT_WHOLE;
}

static void evaluate_script(PetriSession *session, Job *job) {
    job->stopped = !session_evaluate(session);
}

PetriStatus petri_preview(PetriSession *session) {
    if (session->evaluated)
        return PETRI_OK;
    if (!session->program)
        return PETRI_INVALID;
    Job job = {0};
    PetriFrame frame = session->frame;
    if (frame.number < 0)
        session->frame.number = 0;
    session_set_globals(session, &session->vm);
    session->frame = frame;
    if (!guarded(session, evaluate_script, &job))
        return memory_status(session);
    if (!job.stopped)
        return PETRI_OK;
    return petri_interrupted(session) ? PETRI_INTERRUPTED : PETRI_LIMIT;
}

static double seconds_now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static void run(PetriSession *session, Job *job) {
    session->vm.state = session->state;
    session->vm.interrupt = &session->interrupt;
    session->vm.arena = session->vm.builtins.arena = job->arena;
    uint32_t count = job->program->export_count;
    job->exports = arena_alloc_array(job->arena, count, sizeof *job->exports);
    double start = seconds_now();
    job->value = vm_run(&session->vm, job->program, session->values, job->exports);
    job->seconds = seconds_now() - start;
    job->stopped = session->vm.stopped;
}

// Compiles and runs a statement in the names in sight.
static PetriStatus take_statement(PetriSession *session, Job *job) {
    session_set_globals(session, &session->static_vm);
    if (!guarded(session, compile, job) || !guarded(session, run, job))
        return memory_status(session);
    if (job->stopped)
        return petri_interrupted(session) ? PETRI_INTERRUPTED : PETRI_LIMIT;
    return PETRI_OK;
}

static void parse(PetriSession *session, Job *job) {
    job->unit = unit_parse(session, STR("prompt"), job->text);
}

// Parses the text into a unit; the names in sight have values from then on.
static PetriStatus begin(PetriSession *session, const char *text, size_t length, Job *job) {
    *job = (Job){.text = {text, length == PETRI_Z ? strlen(text) : length}};
    if (petri_interrupted(session))
        return PETRI_INTERRUPTED;
    session->fresh = NULL;
    if (!guarded(session, parse, job) || !job->unit) {
        unit_free(session->fresh);
        job->unit = NULL;
        return memory_status(session);
    }
    job->unit->arena.escape = NULL;
    return job->unit->ast ? petri_preview(session) : PETRI_INVALID;
}

static void flush(Writing *out) {
    if (out->text.len && !out->stopped && out->write)
        out->stopped = !out->write(out->host, out->text.bytes, out->text.len);
    out->text.len = 0;
}

static bool all_nodes(Value v) {
    bool all = v.kind == VALUE_MIXED;
    for (uint32_t i = 0; all && i < v.len; i++)
        all = v.as.items[i].type == ITEM_NODE;
    return all;
}

static void write_value(PetriSession *session, Writing *out, Value v) {
    if (!all_nodes(v)) {
        format_value(&out->text, &session->symbols, v);
        text_add_char(&out->text, '\n');
    }
    for (uint32_t i = 0; all_nodes(v) && i < v.len && !out->stopped; i++) {
        format_tree(&out->text, &session->symbols, v.as.items[i].as.node, 0);
        if (out->text.len >= PIECE)
            flush(out);
    }
    flush(out);
}

// What a statement has said and what it is worth.
static void write_all(PetriSession *session, Job *job) {
    Writing *out = job->out;
    out->text = text_new(&session->prompt_arena);
    for (uint32_t i = 0; i < job->log.count; i++) {
        text_add_c(&out->text, "> ");
        text_add(&out->text, job->log.items[i].text);
        text_add_char(&out->text, '\n');
    }
    if (job->shown)
        write_value(session, out, job->value);
    flush(out);
}

static bool binds(const Ast *ast) {
    return ast->kind == AST_LET || ast->kind == AST_LET_STABLE || ast->kind == AST_IMPORT ||
           (ast->kind == AST_FUNC && ast->name);
}

// Does a statement begin with a node, or is it a loop, condition or template around one?
static bool makes_nodes(const Ast *ast) {
    switch (ast->kind) {
    case AST_NODE:
    case AST_TEMPLATE:
    case AST_INCLUDE:
        return true;
    case AST_DECORATE:
    case AST_APPEND:
    case AST_WHERE:
    case AST_COND:
        return makes_nodes(ast->children[0]);
    case AST_FOR:
        return makes_nodes(ast->children[2]);
    case AST_IF:
    case AST_SUITE:
    case AST_COMPOSE:
        for (uint32_t i = 0; i < ast->count; i++)
            if (makes_nodes(ast->children[i]))
                return true;
        return false;
    default:
        return false;
    }
}

// Keeps a statement that has been run, and puts what it binds in sight.
static bool keep(PetriSession *session, const Job *job, bool adds) {
    Prompt *prompts = realloc(session->prompts, (session->prompt_count + 1) * sizeof *prompts);
    if (!prompts)
        return false;
    session->prompts = prompts;
    prompts[session->prompt_count++] = (Prompt){session_put(session, job->unit), job->ast, job->program, adds};
    job->unit->references++;
    add_names(session, job->program);
    session_change_config(session, true);
    return true;
}

// Makes what a kept statement has given part of the present frame.
static void show_in_frame(PetriSession *session, Job *job) {
    Arena *arena = &session->frame_arena;
    uint32_t count = job->program->export_count, before = session->value_count;
    Value *values = arena_alloc_array(arena, before + count, sizeof *values);
    if (before)
        memcpy(values, session->values, before * sizeof *values);
    if (count)
        memcpy(values + before, job->exports, count * sizeof *values);
    session->values = values;
    session->value_count = before + count;
    if (makes_nodes(job->ast)) {
        Vector tree = vector_new(arena);
        vector_add(&tree, session->tree);
        vector_add(&tree, job->value);
        session->tree = vector_finish(&tree);
    }
}

static void note_hidden(const PetriSession *session, Job *job) {
    const Program *script = session->program->program;
    for (uint32_t i = 0; i < job->program->export_count; i++)
        if (program_find_export(script, job->program->exports[i].name))
            job->hidden = job->program->exports[i].name;
}

static PetriStatus prompt_statement(PetriSession *session, Job *job, Writing *out, PetriPrompted *done) {
    bool is_binding = binds(job->ast->children[0]), adds = !is_binding && makes_nodes(job->ast->children[0]);
    bool is_kept = is_binding || adds;
    arena_reset(&session->prompt_arena);
    job->arena = is_kept ? &session->frame_arena : &session->prompt_arena;
    DiagSink log = session->log;
    session->log = diag_sink_new(&session->prompt_arena, MOST_LINES);
    PetriStatus status = take_statement(session, job);
    job->log = session->log;
    session->log = log;
    job->out = out;
    job->shown = status == PETRI_OK && !is_binding;
    if (!guarded(session, write_all, job) && status == PETRI_OK)
        status = memory_status(session);
    diag_sink_free(&job->log);
    if (status != PETRI_OK)
        return status;
    if (is_kept && (!keep(session, job, adds) || !guarded(session, show_in_frame, job)))
        return memory_status(session);
    note_hidden(session, job);
    done->bindings += is_binding;
    done->nodes += adds;
    done->values += !is_kept;
    return PETRI_OK;
}

static bool refuse_pragmas(PetriSession *session, const Unit *unit) {
    const Ast *ast = unit->ast;
    if (ast->count == 0 || ast->children[0]->kind != AST_PRAGMA)
        return false;
    session_tell(session, &(Diag){.level = DIAG_ERROR,
                                  .source = unit->source,
                                  .span = ast->children[0]->span,
                                  .text = STR("pragmas count at the beginning of a script only"),
                                  .code = "syntax"});
    return true;
}

PetriStatus petri_prompt(PetriSession *session, const char *text, size_t length, PetriWrite *write, void *host,
                         PetriPrompted *done) {
    Job job;
    Writing out = {.write = write, .host = host};
    *done = (PetriPrompted){0};
    session->tell_again = true;
    PetriStatus status = begin(session, text, length, &job);
    if (status == PETRI_OK && refuse_pragmas(session, job.unit))
        status = PETRI_INVALID;
    for (uint32_t i = 0; status == PETRI_OK && i < job.unit->ast->count; i++) {
        const Ast *statement = job.unit->ast->children[i];
        Ast *children[] = {(Ast *)statement};
        job.ast = ast_new(&job.unit->arena, AST_SUITE, statement->span, NULL, children, 1);
        status = prompt_statement(session, &job, &out, done);
    }
    session->tell_again = false;
    if (job.hidden) {
        arena_reset(&session->text_arena);
        done->hidden = str_to_c(&session->text_arena, job.hidden->name);
    }
    unit_free(job.unit);
    return status;
}

// An expression: one statement that is not kept.
static bool is_expression(PetriSession *session, const Unit *unit) {
    const Ast *ast = unit->ast;
    if (ast->count == 1 && ast->children[0]->kind != AST_PRAGMA && !binds(ast->children[0]))
        return true;
    session_tell(session, &(Diag){.level = DIAG_ERROR,
                                  .source = unit->source,
                                  .span = {0, (uint32_t)unit->source->text.len},
                                  .text = STR("this must be one expression"),
                                  .code = "syntax"});
    return false;
}

static void write_line(PetriSession *session, Job *job) {
    Writing *out = job->out;
    out->text = text_new(&session->prompt_arena);
    format_value(&out->text, &session->symbols, job->value);
    flush(out);
}

PetriStatus petri_evaluate(PetriSession *session, const char *text, size_t length, PetriResult *result,
                           PetriWrite *write, void *host) {
    Job job;
    PetriStatus status = begin(session, text, length, &job);
    if (status == PETRI_OK && !is_expression(session, job.unit))
        status = PETRI_INVALID;
    if (status == PETRI_OK) {
        job.ast = job.unit->ast;
        job.arena = &session->prompt_arena;
        arena_reset(&session->prompt_arena);
        DiagSink log = session->log; // what debug() says here is not the frame's
        session->log = diag_sink_new(&session->prompt_arena, 0);
        status = take_statement(session, &job);
        diag_sink_free(&session->log);
        session->log = log;
    }
    if (status == PETRI_OK) {
        bool one = job.value.kind == VALUE_NUMBERS && job.value.len == 1;
        *result = (PetriResult){.is_true = value_true(job.value),
                                .length = job.value.len,
                                .number = one ? job.value.as.number : NAN,
                                .seconds = job.seconds};
        Writing out = {.write = write, .host = host};
        job.out = &out;
        if (write && !guarded(session, write_line, &job))
            status = memory_status(session);
    }
    unit_free(job.unit);
    return status;
}

uint32_t petri_drop(PetriSession *session, bool bindings) {
    uint32_t kept = 0, count = session->prompt_count;
    session_clear_frame(session); // its tree may lie in what goes
    for (uint32_t i = 0; i < count; i++) {
        Prompt prompt = session->prompts[i];
        if (bindings || prompt.adds)
            unit_free(prompt.unit);
        else
            session->prompts[kept++] = prompt;
    }
    session->prompt_count = kept;
    if (kept == count)
        return 0;
    session_change_config(session, false);
    session_compile_prompts(session);
    return count - kept;
}

const char *petri_kept(PetriSession *session, size_t number) {
    if (number >= session->prompt_count)
        return NULL;
    arena_reset(&session->text_arena);
    const Prompt *prompt = &session->prompts[number];
    Str text = prompt->unit->source->text;
    Span span = prompt->ast->span;
    return str_to_c(&session->text_arena, str_trim((Str){text.bytes + span.start, span.end - span.start}));
}

const char *petri_name(PetriSession *session, size_t number) {
    const Symbol *name = NULL;
    if (number < session->name_count)
        name = session->names[number];
    else if (number - session->name_count < session->define_count)
        name = session->defines[number - session->name_count].name;
    else if (number - session->name_count - session->define_count < ENGINE_NAME_COUNT)
        return engine_name_text((EngineName)(number - session->name_count - session->define_count));
    else
        return NULL;
    arena_reset(&session->text_arena);
    return str_to_c(&session->text_arena, name->name);
}
