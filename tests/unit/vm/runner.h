// runner.h: parses, compiles and evaluates scripts with a VM but without a session.
#pragma once

#include "builtin/files.h"
#include "builtin/noise.h"
#include "syntax/parse.h"
#include "values.h"
#include "vm/machine.h"

// A module that a script may import.
typedef struct ModuleText {
    const char *path;
    const char *text;
} ModuleText;

typedef struct Runner {
    World world; // symbols and data of the tests
    Arena program;
    Arena scratch;
    Arena frame;
    State *state;
    FileCache *files;
    NoiseCache *noise;
    Vm vm;
    Vm static_vm;
    bool simplify;
    const ModuleText *modules;
    size_t module_count;
    const Program *compiled;
    Value result;
    Text reported; // `line:column text [code]` of each diagnostic, one per line
    Text log;
} Runner;

static inline void runner_report(void *host, const Diag *diag) {
    Runner *runner = host;
    SourcePosition place = source_locate(diag->at.source, diag->at.span.start);
    text_add_format(&runner->reported, "%u:%u %.*s [%s]\n", place.line, place.column, (int)diag->text.len,
                    diag->text.bytes, diag->code);
}

static inline void runner_ignore_diagnostic(void *host, const Diag *diag) {
    (void)host;
    (void)diag;
}

static inline void runner_log(void *host, Str text) {
    Runner *runner = host;
    text_add_format(&runner->log, "> %.*s\n", (int)text.len, text.bytes);
}

// Folds an expression. Its value lives as long as the program.
static inline bool runner_evaluate(void *host, const Code *code, Value *value) {
    Runner *runner = host;
    return vm_run_static(&runner->static_vm, &runner->program, code, value);
}

static inline const Program *runner_compile_text(Runner *runner, const char *path, const char *text, bool module) {
    const Source *source = source_new(&runner->program, str_from(path), str_copy(&runner->program, str_from(path)),
                                      str_copy(&runner->program, str_from(text)));
    DiagSink sink = diag_sink_new(&runner->program, 50);
    const Ast *ast = parse_program(&runner->scratch, &runner->world.symbols, source, &sink);
    CompileOptions options = {
        .module = module, .simplify = runner->simplify, .host = {.user_data = runner, .evaluate = runner_evaluate}};
    const Program *program = NULL;
    if (ast)
        program =
            program_compile(&runner->program, &runner->scratch, &runner->world.symbols, source, ast, &options, &sink);
    for (uint32_t i = 0; i < sink.count; i++)
        runner_report(runner, &sink.items[i]);
    diag_sink_free(&sink);
    // Overwrite temporary data, to detect programs that still refer to it.
    for (ArenaBlock *block = runner->scratch.first; block && !ARENA_POISONS; block = block->next)
        memset(block->bytes, 0xdb, block->capacity);
    arena_free(&runner->scratch);
    return program;
}

static inline const Program *runner_module(void *host, Str path, Str *reason) {
    Runner *runner = host;
    for (size_t i = 0; i < runner->module_count; i++)
        if (str_equal(path, str_from(runner->modules[i].path)))
            return runner_compile_text(runner, runner->modules[i].path, runner->modules[i].text, true);
    *reason = STR("no such file");
    return NULL;
}

static inline int runner_setup(void **state) {
    enum { STACK_BYTES = 4 << 20 };
    Runner *runner = calloc(1, sizeof *runner);
    World *world = &runner->world;
    arena_init(&world->arena, "test", (size_t)1 << 30);
    world->symbols = symbol_table_new(&world->arena);
    arena_init(&runner->program, "program", (size_t)1 << 30);
    arena_init(&runner->scratch, "compiler", (size_t)1 << 30);
    arena_init(&runner->frame, "frame", (size_t)2 << 30);
    runner->state = state_new(NULL);
    runner->files = file_cache_new();
    runner->noise = noise_cache_new();
    vm_init(&runner->vm, &runner->frame, &world->symbols, (VmHost){runner, runner_report, runner_log, runner_module},
            STACK_BYTES, false);
    vm_init(&runner->static_vm, &runner->frame, &world->symbols,
            (VmHost){runner, runner_ignore_diagnostic, runner_log, runner_module}, STACK_BYTES, true);
    runner->vm.state = runner->state;
    runner->vm.builtins.files = runner->files;
    runner->vm.builtins.noise = runner->static_vm.builtins.noise = runner->noise;
    runner->simplify = true;
    runner->reported = text_new(&world->arena);
    runner->log = text_new(&world->arena);
    *state = runner;
    return 0;
}

static inline int runner_teardown(void **state) {
    Runner *runner = *state;
    vm_free(&runner->vm);
    vm_free(&runner->static_vm);
    noise_cache_free(runner->noise);
    file_cache_free(runner->files);
    state_free(runner->state);
    arena_free(&runner->frame);
    arena_free(&runner->scratch);
    arena_free(&runner->program);
    symbol_table_free(&runner->world.symbols);
    arena_free(&runner->world.arena);
    free(runner);
    return 0;
}

#define RUNNER_TEST(function) cmocka_unit_test_setup_teardown(function, runner_setup, runner_teardown)

// Evaluates a frame of the program that was loaded last.
static inline void runner_frame(Runner *runner, double number) {
    runner->vm.globals[ENGINE_FRAME] = value_number(number);
    arena_reset(&runner->frame);
    runner->log.len = 0;
    runner->result = vm_run(&runner->vm, runner->compiled, NULL, NULL);
}

// Returns false if the script has syntax errors.
static inline bool runner_load(Runner *runner, const char *script) {
    runner->reported.len = 0;
    runner->compiled = runner_compile_text(runner, "t.fl", script, false);
    return runner->compiled != NULL;
}

// Loads a script, which must have no syntax errors, and evaluates frames.
static inline void runner_run(Runner *runner, const char *script, int frames) {
    assert_claim(script, runner_load(runner, script));
    for (int i = 0; i < frames; i++)
        runner_frame(runner, i);
}

// Returns the nodes of the last frame as a string.
static inline const char *runner_tree(Runner *runner) {
    Text text = text_new(&runner->world.arena);
    for (uint32_t i = 0; runner->result.kind == VALUE_MIXED && i < runner->result.len; i++)
        if (runner->result.as.items[i].type == ITEM_NODE)
            format_tree(&text, &runner->world.symbols, runner->result.as.items[i].as.node, 0, NULL, NULL);
    return text_c(&text);
}

typedef struct ScriptRow {
    const char *script;
    const char *wanted;
} ScriptRow;

// Runs each script for `frames` frames, with and without the simplifier, and checks the tree of the last frame.
static inline void check_trees(Runner *runner, const ScriptRow *rows, size_t count, int frames) {
    for (int simplify = 1; simplify >= 0; simplify--) {
        runner->simplify = simplify;
        for (size_t i = 0; i < count; i++) {
            runner_run(runner, rows[i].script, frames);
            assert_text(rows[i].script, runner_tree(runner), rows[i].wanted);
        }
    }
}
