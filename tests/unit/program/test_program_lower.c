// test_program_lower.c: tests the instructions that expressions are compiled to, and that code does not refer to the
// compiler's data.
#include "compiling.h"

static void test_each_expression_has_its_instructions(void **state) {
    static const CodeRow rows[] = {
        {"1\n", "move r0 = 1\nreturn r0\n"},
        {"frame and time\n",
         "global r1 = frame\nmove r2 = r1\njump false r2 to 4\nglobal r2 = time\nmove r0 = r2\nreturn r0\n"},
        {"frame<time\n", "global r1 = frame\nglobal r2 = time\nlt r0 = r1 r2\nreturn r0\n"},
        {"(1;2;3)[frame..2]\n", "compose r1 = (1, 2, 3)\nglobal r2 = frame\nslice r0 = r1 r2 2\nreturn r0\n"},
        {"(1;2)[frame..2|1]\n",
         "compose r1 = (1, 2)\nglobal r3 = frame\nrange r2 = r3 2 1\nindex r0 = r1 r2\nreturn r0\n"},
        {"$(:k;frame)\n", "global r1 = frame\nlookup r0 = (:k, r1) #0\nreturn r0\n"},
        {"$:a;$:b\n", "lookup r1 = (:a) #0\nlookup r2 = (:b) #1\ncompose r0 = (r1, r2)\nreturn r0\n"},
        {"let a;b=frame\nb\n", "global r3 = frame\nunpack r0-r1 = r3\nmove r2 = r1\nreturn r2\n"},
        {"import a;b from 'm.fl'\n", "import r0-r1 = 'm.fl'\nmove r2 = null\nreturn r2\n"},
        {"if frame\n    1\n",
         "global r1 = frame\njump false r1 to 4\nmove r0 = 1\njump to 5\nmove r0 = null\nreturn r0\n"},
    };
    Desk *desk = *state;
    desk->options.simplify = false;
    check_code(desk, rows, COUNT_OF(rows));
}

// A call of a built-in that passes exactly one argument per parameter becomes a BUILTIN instruction.
static void test_only_an_exact_call_becomes_a_builtin_instruction(void **state) {
    static const CodeRow rows[] = {
        {"sin(frame)\n", "global r1 = frame\nbuiltin r0 = (r1) sin\nreturn r0\n"},
        {"sin(x=frame)\n", "global r1 = frame\ncall r0 = (sin) (r1)\nreturn r0\n"},
        {"sin(frame, 2)\n", "global r1 = frame\ncall r0 = (sin) (r1, 2)\nreturn r0\n"},
        {"func f(x, y=frame)\n    x*y\nf(1, y=2)\n",
         "global r2 = frame\nclosure r0 = (null, r2) f\ncall r1 = r0 (1, 2)\nreturn r1\n\n"
         "f: parameters=2 captures=0 registers=3\nmul r2 = r0 r1\nreturn r2\n"},
    };
    Desk *desk = *state;
    desk->options.simplify = false;
    check_code(desk, rows, COUNT_OF(rows));
    compile(desk, "func f(x)\n    x\nf(1, 2, b=3, c=frame)\n");
    const Code *code = desk->compiled->code;
    const CallCode *call = code->instrs[code->count - 2].as.call;
    assert_int_equal(code->instrs[code->count - 2].op, OP_CALL);
    assert_int_equal(call->arg_count, 2);
    assert_int_equal(call->named_count, 2);
    assert_ptr_equal(call->names[1], name_of(&desk->world, "c"));
}

// A node is created by one instruction if the result is the same. In a loop, small parts of the body are yielded one by
// one.
static void test_nodes_and_loops(void **state) {
    static const CodeRow rows[] = {
        {"!a #t v=frame\n    !b\n", "global r1 = frame\nnode r2 = () none b\nnode r0 = (v=r1) r2 a\nreturn r0\n"},
        {"!a v=frame v=1\n", "node r1 = () none a\nglobal r2 = frame\ndecorate r0 = r1 (r2, 1) v v\nreturn r0\n"},
        {"(frame v=1 w=2)\n", "global r1 = frame\ndecorate r0 = r1 (1, 2) v w\nreturn r0\n"},
        {"frame << !a\n", "global r1 = frame\nnode r2 = () none a\nappend r0 = r1 r2\nreturn r0\n"},
        {"for i in frame;1\n    !a v=i\n    !b\n",
         "global r3 = frame\ncompose r2 = (r3, 1)\nfor loop 0 r0 = r2 to 8\nnode r3 = (v=r0) none a\nyield loop 0 "
         "r3\n"
         "node r3 = () none b\nyield loop 0 r3\nnext loop 0 r0 = to 3\nend loop r1 = loop 0\nreturn r1\n"},
        {"for i in frame\n    !a\n    !b if i else (i;2)\n",
         "global r2 = frame\nfor loop 0 r0 = r2 to 10\nnode r4 = () none a\njump false r0 to 6\n"
         "node r5 = () none b\njump to 7\ncompose r5 = (r0, 2)\ncompose r3 = (r4, r5)\nyield loop 0 r3\n"
         "next loop 0 r0 = to 2\nend loop r1 = loop 0\nreturn r1\n"},
        {"for i in frame\n    !a\n    2 if i else 'x'\n",
         "global r2 = frame\nfor loop 0 r0 = r2 to 9\nnode r3 = () none a\nyield loop 0 r3\njump false r0 to 7\n"
         "yield loop 0 2\njump to 8\nyield loop 0 'x'\nnext loop 0 r0 = to 2\nend loop r1 = loop 0\nreturn r1\n"},
    };
    static const CodeRow simplified[] = {
        {"for i in frame\n    !a\n    if i\n        !b\n    elif i>1\n        i;2\n    else\n        3\n",
         "global r2 = frame\nfor loop 0 r0 = r2 to 13\njump false r0 to 5\nmove r4 = (!b)\njump to 10\n"
         "gt r5 = r0 1\njump false r5 to 9\ncompose r4 = (r0, 2)\njump to 10\nmove r4 = 3\n"
         "compose r3 = ((!a), r4)\nyield loop 0 r3\nnext loop 0 r0 = to 2\nend loop r1 = loop 0\nreturn r1\n"},
    };
    Desk *desk = *state;
    desk->options.simplify = false;
    check_code(desk, rows, COUNT_OF(rows));
    desk->options.simplify = true;
    check_code(desk, simplified, COUNT_OF(simplified));
}

// Returns the instruction that adds a particle to a node batch, or NULL if the loop creates single nodes. `body` is the
// body of the loop.
static const Instr *find_yield_node(Desk *desk, const char *body) {
    Str script = str_format(&desk->world.arena, "!top\n    for i in ..frame\n        %s\n", body);
    const Code *code = compile(desk, script.bytes)->code;
    for (uint32_t i = 0; i < code->count; i++)
        if (code->instrs[i].op == OP_YIELD_NODE)
            return &code->instrs[i];
    return NULL;
}

// Loops create batches of nodes with at most 12 attributes. An iteration's data can be freed unless an instruction may
// keep it.
static void test_node_batches(void **state) {
    static const struct {
        const char *body;
        int frees; // -1: no batch
    } rows[] = {
        {"!particle a=i b=2*i", 1},
        {"!particle a=sin(i)", 1},
        {"!particle a=i b=1 c=1 d=1 e=1 f=1 g=1 h=1 i=1 j=1 k=1 l=1", 1},
        {"!particle a=i b=1 c=1 d=1 e=1 f=1 g=1 h=1 i=1 j=1 k=1 l=1 m=1", -1},
        {"let x=2*i n=(!a v=x)\n        !particle a=len(n)", 0},
        {"let x=2*i f=func(y) x*y\n        !particle a=f(3)", 0},
        {"let x=2*i\n        !particle a=debug(x)", 0},
        {"!other a=i", -1},
    };
    Desk *desk = *state;
    symbol_intern_batched(&desk->world.symbols, STR("particle"));
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        const Instr *instr = find_yield_node(desk, rows[i].body);
        if ((instr ? instr->d : -1) != rows[i].frees)
            fail_msg("%s: %d", rows[i].body, instr ? (int)instr->d : -1);
    }
}

// Each instruction has a source position, even after the syntax tree was freed (compiling.h overwrites it).
static void test_instruction_positions(void **state) {
    static const struct {
        Opcode op;
        uint32_t line, column;
        uint32_t inner; // column of inner_origin; 0: none
    } rows[] = {{OP_GLOBAL, 1, 7, 0}, {OP_GLOBAL, 2, 10, 0}, {OP_SLICE, 2, 6, 10}, {OP_NODE, 2, 1, 0},
                {OP_LOOKUP, 3, 1, 3}, {OP_COMPOSE, 1, 1, 0}, {OP_RETURN, 1, 1, 0}};
    Desk *desk = *state;
    desk->options.lines = true;
    const Code *code = compile(desk, "let x=frame\n!a v=(x)[frame..2]\n$(x;1)\n")->code;
    assert_int_equal(code->count, COUNT_OF(rows));
    for (uint32_t i = 0; i < code->count; i++) {
        const Instr *instr = &code->instrs[i];
        SourcePosition place = source_locate(instr->at->source, instr->at->span.start);
        if (instr->op != rows[i].op || place.line != rows[i].line || place.column != rows[i].column)
            print_error("%u: %u at %u:%u\n", i, instr->op, place.line, place.column);
        assert_true(instr->op == rows[i].op && place.line == rows[i].line && place.column == rows[i].column);
        if (rows[i].inner)
            assert_int_equal(source_locate(code->source, instr->as.inner_origin->span.start).column, rows[i].inner);
        assert_true(instr->op == OP_COMPOSE || instr->op == OP_RETURN || code->lines[i] == rows[i].line);
    }
}

// Limits the memory of a statement: two instructions with their positions, a node, and its names and constants.
static void test_memory_per_statement(void **state) {
    enum { STATEMENTS = 1000, MAX_BYTES = 600 };
    Desk *desk = *state;
    Text script = text_new(&desk->world.arena);
    for (int i = 0; i < STATEMENTS; i++)
        text_add_c(&script, "!a v=frame+1\n");
    compile(desk, text_c(&script));
    assert_true(desk->program.used < STATEMENTS * MAX_BYTES);
}

TEST_GROUP(program_lower) {
    const struct CMUnitTest tests[] = {DESK_TEST(test_each_expression_has_its_instructions),
                                       DESK_TEST(test_only_an_exact_call_becomes_a_builtin_instruction),
                                       DESK_TEST(test_nodes_and_loops),
                                       DESK_TEST(test_node_batches),
                                       DESK_TEST(test_instruction_positions),
                                       DESK_TEST(test_memory_per_statement)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
