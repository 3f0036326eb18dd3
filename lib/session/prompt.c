// prompt.c: evaluation of text that a user types at the prompt (petri_prompt, petri_evaluate).
//
// Each statement is a separate program whose parameters are the visible names (prompt.h). Names of the script have
// their values of the last frame, before its systems were updated (frame.c). Names bound at the prompt are
// evaluated in the state after the frame, as if they were typed again (session_update_names). In both cases, the values
// do not depend on how the session reached the frame. Expressions are evaluated in a separate arena and retain nothing.
#include "base/clock.h"
#include "base/heap.h"
#include "base/host_struct.h"
#include "session/session.h"
#include "session/text_sink.h"
#include "syntax/parse.h"
#include "value/format.h"

#include <math.h>
#include <string.h>

enum { MAX_PROMPT_LINES = 10000 };

// The execution of one statement. Results that are needed after a call was aborted are stored here, because the abort
// (longjmp) loses local variables.
typedef struct Job {
    Str text;
    Unit *unit;
    const Ast *ast; // syntax tree of the statement
    Span lines;     // of the statement in the text of the unit, with comments before it
    const Program *program;
    Arena *arena; // arena of the statement's value
    Value value;
    Value *exports;
    double seconds;
    DiagSink log; // output of debug()
    TextSink out;
    bool binds;      // true if the statement binds names
    bool adds_nodes; // true if the value of the statement is added to the tree
    // New contents of the prompt and the frame, if the statement is retained:
    PromptList *list;
    Value *values;
    Value tree;
    const Symbol *shadowed; // a name bound by both the statement and the script; NULL: none
} Job;

// --- lists

void prompt_list_compile(PetriSession *session, const PromptList *list, const Program *script, PromptChoice choice,
                         PromptList **result) {
    *result = prompt_list_new((Names){session->host_globals.names, session->host_globals.count}, script);
    for (uint32_t i = 0; *result && i < list->count; i++) {
        PromptStatement statement = list->statements[i];
        if (choice == PROMPT_NONE || (choice == PROMPT_BINDINGS && statement.adds_nodes))
            continue;
        statement.program = unit_compile(session, statement.unit, statement.ast, false, (*result)->names);
        arena_free(&statement.unit->scratch);
        PromptList *shorter = *result;
        *result = prompt_list_add(shorter, &statement);
        prompt_list_free(shorter);
    }
    if (!*result)
        arena_exhausted(&session->arena);
}

// --- checking and executing input

static PetriStatus probe_text(PetriSession *session, void *context) {
    Job *job = context;
    Arena *arena = &session->prompt.arena;
    const Source *source = source_new(arena, STR("prompt"), STR("prompt"), job->text);
    job->value = value_number(parse_completeness(arena, &session->symbols, source));
    return PETRI_OK;
}

PetriCompleteness petri_prompt_check(PetriSession *session, const char *text, size_t length) {
    if (!session || !text)
        return PETRI_COMPLETE;
    Job job = {.text = {text, length == PETRI_NUL_TERMINATED ? strlen(text) : length}};
    arena_reset(&session->prompt.arena);
    PetriStatus status = session_run(session, probe_text, &job, "the input");
    arena_reset(&session->prompt.arena);
    return status == PETRI_OK ? (PetriCompleteness)job.value.as.number : PETRI_COMPLETE;
}

// Compiles and runs a statement with the visible names.
static PetriStatus run_prompt_program(PetriSession *session, void *context) {
    Job *job = context;
    session_set_globals(session, &session->static_vm);
    job->program = unit_compile(session, job->unit, job->ast, false, session->config.prompts->names);
    arena_free(&job->unit->scratch);
    session->vm.state = session->state;
    session->vm.arena = session->vm.builtins.arena = job->arena;
    job->exports = arena_alloc_array(job->arena, job->program->export_count, sizeof *job->exports);
    double start = clock_seconds();
    job->value = vm_run(&session->vm, job->program, session->frame.values, job->exports);
    job->seconds = clock_seconds() - start;
    session->vm.arena = session->vm.builtins.arena = &session->frame.arena;
    return PETRI_OK;
}

// Runs a statement. Collects up to max_lines lines of its debug() output, separately from the output of the frame.
static PetriStatus run_statement(PetriSession *session, Job *job, uint32_t max_lines) {
    DiagSink log = session->frame.log;
    session->frame.log = diag_sink_new(&session->prompt.arena, max_lines);
    PetriStatus status = session_protect(session, NULL, run_prompt_program, job);
    job->log = session->frame.log;
    session->frame.log = log;
    return session_report_abort(session, status, "the input");
}

static PetriStatus parse_prompt_text(PetriSession *session, void *context) {
    Job *job = context;
    job->unit = unit_parse(session, job->text);
    return PETRI_OK;
}

// Parses the text into a unit. Evaluates the script and the prompt's bindings if the visible names have no values yet.
static PetriStatus begin_job(PetriSession *session, const char *text, size_t length, Job *job) {
    job->text = (Str){text, length == PETRI_NUL_TERMINATED ? strlen(text) : length};
    if (session->call_depth > 0)
        return PETRI_INVALID;
    if (petri_clear_interrupt(session))
        return PETRI_INTERRUPTED;
    session->loader.pending = NULL;
    PetriStatus status = session_run(session, parse_prompt_text, job, "the input");
    if (status != PETRI_OK) {
        unit_free(session->loader.pending);
        return status;
    }
    if (!job->unit->ast)
        return PETRI_INVALID;
    status = petri_preview(session);
    return status == PETRI_OK ? session_update_names(session) : status;
}

static bool all_nodes(Value v) {
    bool all = v.kind == VALUE_MIXED;
    for (uint32_t i = 0; all && i < v.len; i++)
        all = v.as.items[i].type == ITEM_NODE;
    return all;
}

static void write_prompt_value(PetriSession *session, TextSink *out, Value v) {
    if (!all_nodes(v)) {
        format_value(&out->text, &session->symbols, v);
        text_add_char(&out->text, '\n');
    }
    for (uint32_t i = 0; all_nodes(v) && i < v.len && !out->stopped; i++)
        text_sink_add_tree(out, &session->symbols, v.as.items[i].as.node);
    text_sink_flush(out);
}

// Writes the debug() output of a statement.
static PetriStatus write_log(PetriSession *session, void *context) {
    Job *job = context;
    TextSink *out = &job->out;
    out->text = text_new(&session->prompt.arena);
    for (uint32_t i = 0; i < job->log.count; i++) {
        text_add_c(&out->text, "> ");
        text_add(&out->text, job->log.items[i].text);
        text_add_char(&out->text, '\n');
    }
    text_sink_flush(out);
    return PETRI_OK;
}

static bool binds(const Ast *ast) {
    return ast->kind == AST_LET || ast->kind == AST_LET_STABLE || ast->kind == AST_IMPORT ||
           (ast->kind == AST_FUNC && ast->name);
}

// Returns true if a statement starts with a node, or is a loop, condition or template around one.
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

static const char *statement_text(PetriSession *session, const Job *job) {
    Str text = {job->unit->source->text.bytes + job->lines.start, job->lines.end - job->lines.start};
    return str_copy(unit_arena(session, job->unit), str_trim(text)).bytes;
}

// Prepares the new contents of the prompt and the frame for a statement that will be retained.
static void prepare_statement(PetriSession *session, Job *job) {
    const SessionFrame *frame = &session->frame;
    uint32_t count = job->program->export_count, before = frame->value_count;
    PromptStatement statement = {job->unit, statement_text(session, job), job->ast, job->program, job->adds_nodes};
    job->tree = frame->tree;
    job->values = arena_alloc_array(job->arena, before + count, sizeof *job->values);
    if (before)
        memcpy(job->values, frame->values, before * sizeof *job->values);
    if (count)
        memcpy(job->values + before, job->exports, count * sizeof *job->values);
    if (makes_nodes(job->ast)) {
        Vector tree = vector_new(job->arena);
        vector_add(&tree, frame->tree);
        vector_add(&tree, job->value);
        job->tree = vector_finish(&tree);
    }
    job->list = prompt_list_add(session->config.prompts, &statement);
    if (!job->list)
        arena_exhausted(job->arena);
}

static PetriStatus finish_statement(PetriSession *session, void *context) {
    Job *job = context;
    if (job->binds || job->adds_nodes)
        prepare_statement(session, job);
    write_log(session, job);
    if (!job->binds)
        write_prompt_value(session, &job->out, job->value);
    return PETRI_OK;
}

static void store_statement(PetriSession *session, Job *job) {
    session_use_unit(session, job->unit);
    session_set_prompts(session, job->list);
    session_change_config(session, true);
    session->frame.values = job->values;
    session->frame.value_count += job->program->export_count;
    session->frame.tree = job->tree;
}

static void note_shadowed(const PetriSession *session, Job *job) {
    const Program *script = session->config.program->program;
    for (uint32_t i = 0; i < job->program->export_count; i++)
        if (program_find_export(script, job->program->exports[i].name))
            job->shadowed = job->program->exports[i].name;
}

static PetriStatus prompt_statement(PetriSession *session, Job *job, PetriPromptResult *done) {
    job->binds = binds(job->ast->children[0]);
    job->adds_nodes = !job->binds && makes_nodes(job->ast->children[0]);
    bool persists = job->binds || job->adds_nodes;
    arena_reset(&session->prompt.arena);
    job->arena = persists ? &session->frame.arena : &session->prompt.arena;
    job->list = NULL;
    PetriStatus status = run_statement(session, job, MAX_PROMPT_LINES);
    if (status == PETRI_OK)
        status = session_run(session, finish_statement, job, "the input");
    else if (status != PETRI_OUT_OF_MEMORY)
        session_protect(session, NULL, write_log, job);
    diag_sink_free(&job->log);
    if (status != PETRI_OK) {
        prompt_list_free(job->list);
        return status;
    }
    if (persists)
        store_statement(session, job);
    note_shadowed(session, job);
    done->bindings += job->binds;
    done->nodes += job->adds_nodes;
    done->values += !persists;
    return PETRI_OK;
}

static bool reject_pragmas(PetriSession *session, const Unit *unit) {
    const Ast *ast = unit->ast;
    if (ast->count == 0 || ast->children[0]->kind != AST_PRAGMA)
        return false;
    Str text = STR("pragmas are allowed only at the start of a script");
    session_report(session, &(Diag){DIAG_ERROR, {unit->source, ast->children[0]->span}, text, .code = "syntax"});
    return true;
}

// Wraps the current statement in a suite, which can be compiled as a program.
static PetriStatus wrap_statement(PetriSession *session, void *context) {
    Job *job = context;
    const Ast *statement = job->ast;
    Ast *children[] = {(Ast *)statement};
    job->ast = ast_new(unit_arena(session, job->unit), AST_SUITE, statement->span, NULL, children, 1);
    return PETRI_OK;
}

PetriStatus petri_prompt(PetriSession *session, const char *text, size_t length, PetriWriteCallback *write, void *host,
                         PetriPromptResult *result, size_t size) {
    if (!session || !text || !result)
        return PETRI_INVALID;
    Job job = {.out = {.write = write, .user_data = host}};
    PetriPromptResult done = {0};
    diagnostics_repeat(&session->diagnostics, true);
    PetriStatus status = begin_job(session, text, length, &job);
    if (status == PETRI_OK && reject_pragmas(session, job.unit))
        status = PETRI_INVALID;
    for (uint32_t i = 0; status == PETRI_OK && i < job.unit->ast->count; i++) {
        job.ast = job.unit->ast->children[i];
        job.lines = (Span){job.lines.end, job.ast->end};
        status = session_run(session, wrap_statement, &job, "the input");
        if (status == PETRI_OK)
            status = prompt_statement(session, &job, &done);
    }
    diagnostics_repeat(&session->diagnostics, false);
    if (job.shadowed)
        done.shadowed = job.shadowed->name.bytes;
    host_struct_write(result, size, &done, sizeof done);
    unit_free(job.unit);
    return status;
}

// Compiles a statement and prepares a list that also contains it.
static PetriStatus append_statement(PetriSession *session, void *context) {
    Job *job = context;
    job->unit = unit_parse(session, job->text);
    if (!job->unit->ast || job->unit->ast->count != 1)
        return PETRI_INVALID;
    job->ast = job->unit->ast->children[0];
    job->lines = (Span){0, job->ast->end};
    bool adds_nodes = !binds(job->ast) && makes_nodes(job->ast);
    const char *text = statement_text(session, job);
    wrap_statement(session, job);
    job->program = unit_compile(session, job->unit, job->ast, false, session->config.prompts->names);
    arena_free(&job->unit->scratch);
    if (!job->program)
        return PETRI_INVALID;
    job->list = prompt_list_add(session->config.prompts,
                                &(PromptStatement){job->unit, text, job->ast, job->program, adds_nodes});
    if (!job->list)
        arena_exhausted(&session->arena);
    return PETRI_OK;
}

PetriStatus session_restore_statement(PetriSession *session, const char *text) {
    Job job = {.text = str_from(text)};
    session->loader.pending = NULL;
    PetriStatus status = session_run(session, append_statement, &job, "the input");
    if (status == PETRI_OK) {
        session_use_unit(session, job.unit);
        session_set_prompts(session, job.list);
        session_change_config(session, false);
    }
    unit_free(session->loader.pending);
    session->loader.pending = NULL;
    return status;
}

// Returns true if the text is a single expression. Otherwise, reports an error and returns false.
static bool is_expression(PetriSession *session, const Unit *unit) {
    const Ast *ast = unit->ast;
    if (ast->count == 1 && ast->children[0]->kind != AST_PRAGMA && !binds(ast->children[0]))
        return true;
    Origin all = {unit->source, {0, (uint32_t)unit->source->text.len}};
    session_report(session, &(Diag){DIAG_ERROR, all, STR("the input must be a single expression"), .code = "syntax"});
    return false;
}

static PetriStatus write_prompt_line(PetriSession *session, void *context) {
    Job *job = context;
    job->out.text = text_new(&session->prompt.arena);
    format_value(&job->out.text, &session->symbols, job->value);
    text_sink_flush(&job->out);
    return PETRI_OK;
}

PetriStatus petri_evaluate(PetriSession *session, const char *text, size_t length, PetriEvaluation *result, size_t size,
                           PetriWriteCallback *write, void *host) {
    if (!session || !text || !result)
        return PETRI_INVALID;
    Job job = {.arena = &session->prompt.arena, .out = {.write = write, .user_data = host}};
    PetriStatus status = begin_job(session, text, length, &job);
    if (status == PETRI_OK && !is_expression(session, job.unit))
        status = PETRI_INVALID;
    if (status == PETRI_OK) {
        job.ast = job.unit->ast;
        arena_reset(&session->prompt.arena);
        status = run_statement(session, &job, 0); // discards the output of debug()
        diag_sink_free(&job.log);
    }
    if (status == PETRI_OK) {
        bool one = value_is_number(job.value);
        const PetriEvaluation found = {.is_true = value_true(job.value),
                                       .length = job.value.len,
                                       .number = one ? job.value.as.number : NAN,
                                       .seconds = job.seconds};
        host_struct_write(result, size, &found, sizeof found);
        if (write)
            status = session_run(session, write_prompt_line, &job, "the input");
    }
    unit_free(job.unit);
    return status;
}

typedef struct ClearRequest {
    PromptChoice choice;
    PromptList *list;
} ClearRequest;

static PetriStatus clear_statements(PetriSession *session, void *context) {
    ClearRequest *dropped = context;
    const Unit *script = session->config.program;
    prompt_list_compile(session, session->config.prompts, script ? script->program : NULL, dropped->choice,
                        &dropped->list);
    return PETRI_OK;
}

uint32_t petri_prompt_clear(PetriSession *session, bool bindings) {
    if (!session)
        return 0;
    ClearRequest dropped = {.choice = bindings ? PROMPT_NONE : PROMPT_BINDINGS};
    const PromptList *list = session->config.prompts;
    uint32_t dropped_count = 0;
    for (uint32_t i = 0; i < list->count; i++)
        dropped_count += bindings || list->statements[i].adds_nodes;
    if (dropped_count == 0)
        return 0;
    if (session_run(session, clear_statements, &dropped, "the input") != PETRI_OK) {
        prompt_list_free(dropped.list);
        return 0;
    }
    session_clear_frame(session); // the tree of the last frame can refer to removed statements
    session_set_prompts(session, dropped.list);
    session_change_config(session, false);
    return dropped_count;
}

const char *petri_prompt_statement(const PetriSession *session, size_t number) {
    if (!session)
        return NULL;
    const PromptList *list = session->config.prompts;
    return number < list->count ? list->statements[number].text : NULL;
}

const char *petri_visible_name(const PetriSession *session, size_t number) {
    if (!session)
        return NULL;
    Names names = session->config.prompts->names;
    if (number < names.count)
        return names.items[number]->name.bytes;
    number -= names.count;
    if (number < session->config.define_count)
        return session->config.defines[number].name->name.bytes;
    number -= session->config.define_count;
    return number < ENGINE_NAME_COUNT ? engine_name_text((EngineName)number) : NULL;
}
