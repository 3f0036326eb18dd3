// compiling.h: compiles scripts without a VM. Constant expressions are folded by a simple calculator.
#pragma once

#include "program/code.h"
#include "syntax/parse.h"
#include "value/ops.h"
#include "values.h"

typedef struct Desk {
    World world;
    Arena program;
    Arena scratch;
    CompileOptions options;
    uint32_t evaluate_calls; // number of attempts to fold an expression
    uint32_t include_calls;  // number of attempts to include a file
    Text reported;           // `line:column text [code]` of each diagnostic, one per line
    const Program *compiled;
} Desk;

// Evaluates sums, products, vectors, nodes without attributes and children, and functions. Returns false for all other
// expressions.
static inline bool calculate(void *host, const Code *code, Value *value) {
    enum { MAX_REGISTERS = 64 };
    Desk *desk = host;
    Arena *arena = &desk->program;
    Value memory[MAX_REGISTERS], *slots = memory + code->constant_count;
    desk->evaluate_calls++;
    *value = VALUE_NULL;
    assert_true(code->constant_count + code->register_count <= MAX_REGISTERS);
    memcpy(memory, code->constants, code->constant_count * sizeof *memory);
    for (const Instr *instr = code->instrs;; instr++) {
        Vector vector = vector_new(arena);
        switch (instr->op) {
        case OP_MOVE:
            slots[instr->d] = slots[instr->a];
            break;
        case OP_ADD:
            slots[instr->d] = op_arith(arena, ARITH_ADD, slots[instr->a], slots[instr->b]);
            break;
        case OP_MUL:
            slots[instr->d] = op_arith(arena, ARITH_MUL, slots[instr->a], slots[instr->b]);
            break;
        case OP_JUMP_TRUE:
            if (value_true(slots[instr->a]))
                instr = code->instrs + instr->target - 1;
            break;
        case OP_COMPOSE:
            for (uint32_t i = 0; i < instr->count; i++)
                vector_add(&vector, slots[code->operands[instr->list + i]]);
            slots[instr->d] = vector_finish(&vector);
            break;
        case OP_NODE:
            if (instr->count || instr->b != CODE_NO_OPERAND)
                return false;
            slots[instr->d] = value_node(arena, instr->as.node->base);
            break;
        case OP_CLOSURE:
            slots[instr->d] =
                value_function(arena, arena_copy(arena, &(Function){instr->as.function->name, NULL}, sizeof(Function)));
            break;
        case OP_RETURN:
            *value = slots[instr->a];
            return true;
        default:
            return false;
        }
    }
}

static inline const Ast *parse_text(Desk *desk, const char *name, const char *text, const Source **source) {
    DiagSink sink = diag_sink_new(&desk->program, 50);
    *source = source_new(&desk->program, str_from(name), str_from(name), str_copy(&desk->program, str_from(text)));
    const Ast *ast = parse_program(&desk->scratch, &desk->world.symbols, *source, &sink);
    diag_sink_free(&sink);
    assert_claim(text, ast != NULL);
    return ast;
}

// Provides the only file that can be included. It binds `inner` and creates a node.
static inline const Ast *include_file(void *host, Str path, const Source **source, Str *reason) {
    Desk *desk = host;
    desk->include_calls++;
    if (str_equal(path, STR("inc.fl")))
        return parse_text(desk, "inc.fl", "let inner=seen+1\n!included v=inner\n", source);
    *reason = STR("no such file");
    return NULL;
}

static inline int desk_setup(void **state) {
    Desk *desk = calloc(1, sizeof *desk);
    arena_init(&desk->world.arena, "test", (size_t)1 << 30);
    desk->world.symbols = symbol_table_new(&desk->world.arena);
    arena_init(&desk->program, "program", (size_t)1 << 30);
    arena_init(&desk->scratch, "compiler", (size_t)1 << 30);
    desk->options = (CompileOptions){.simplify = true, .host = {desk, include_file, calculate}};
    desk->reported = text_new(&desk->world.arena);
    *state = desk;
    return 0;
}

static inline int desk_teardown(void **state) {
    Desk *desk = *state;
    arena_free(&desk->scratch);
    arena_free(&desk->program);
    symbol_table_free(&desk->world.symbols);
    arena_free(&desk->world.arena);
    free(desk);
    return 0;
}

#define DESK_TEST(function) cmocka_unit_test_setup_teardown(function, desk_setup, desk_teardown)

static inline const Program *compile(Desk *desk, const char *script) {
    const Source *source;
    desk->evaluate_calls = desk->include_calls = 0;
    desk->reported.len = 0;
    const Ast *ast = parse_text(desk, "t.fl", script, &source);
    DiagSink sink = diag_sink_new(&desk->program, 50);
    desk->compiled =
        program_compile(&desk->program, &desk->scratch, &desk->world.symbols, source, ast, &desk->options, &sink);
    for (uint32_t i = 0; i < sink.count; i++) {
        SourcePosition at = source_locate(sink.items[i].at.source, sink.items[i].at.span.start);
        text_add_format(&desk->reported, "%u:%u %.*s [%s]\n", at.line, at.column, (int)sink.items[i].text.len,
                        sink.items[i].text.bytes, sink.items[i].code);
    }
    diag_sink_free(&sink);
    // Overwrite temporary data, to detect programs that still refer to it.
    for (ArenaBlock *block = desk->scratch.first; block && !ARENA_POISONS; block = block->next)
        memset(block->bytes, 0xdb, block->capacity);
    arena_free(&desk->scratch);
    return desk->compiled;
}

// Returns the output of --dump=code without numbers and lines: one `op operands` per line. The code of a function
// follows a line with its name.
static inline const char *code_of(Desk *desk, const char *script) {
    Text dump = text_new(&desk->world.arena), out = text_new(&desk->world.arena);
    program_print(&dump, &desk->world.symbols, compile(desk, script));
    unsigned number, line;
    int skip;
    for (char *at = str_to_c(dump.arena, text_str(&dump)), *end; (end = strchr(at, '\n')); at = end + 1) {
        *end = 0;
        if (strncmp(at, "number,", 7) == 0)
            continue;
        if (sscanf(at, " %u %u %n", &number, &line, &skip) == 2)
            at += skip;
        bool blank = false;
        for (; *at; at++) { // skip the padding between columns
            if (*at != ' ' && blank)
                text_add_char(&out, ' ');
            blank = *at == ' ';
            if (!blank)
                text_add_char(&out, *at);
        }
        text_add_char(&out, '\n');
    }
    return text_c(&out);
}

typedef struct CodeRow {
    const char *script;
    const char *code;
} CodeRow;

static inline void check_code(Desk *desk, const CodeRow *rows, size_t count) {
    for (size_t i = 0; i < count; i++)
        assert_text(rows[i].script, code_of(desk, rows[i].script), rows[i].code);
}
