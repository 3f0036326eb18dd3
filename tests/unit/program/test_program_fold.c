// test_program_fold.c: tests which expressions are folded, and the resulting code.
#include "compiling.h"

static void test_constants_are_folded(void **state) {
    static const CodeRow rows[] = {
        {"1+2*3\n", "move r0 = 7\nreturn r0\n"},
        {"let x=2\nlet y=x*x\ny+1\n", "move r0 = 2\nmove r1 = 4\nmove r2 = 5\nreturn r2\n"},
        {"let a;b;c=(1;2)\nc;b;a\n", "unpack r0-r2 = 1;2\nmove r3 = 1;2;1\nreturn r3\n"},
        {"frame+(1+2)\n", "global r1 = frame\nadd r0 = r1 3\nreturn r0\n"},
        // Sums are not re-associated.
        {"frame+1+2\n", "global r2 = frame\nadd r1 = r2 1\nadd r0 = r1 2\nreturn r0\n"},
        {"(y*2 where y=3)\n", "move r1 = 6\nreturn r1\n"},
        // Expressions that the test's evaluator cannot evaluate stay unchanged.
        {"1-2\n", "sub r0 = 1 2\nreturn r0\n"},
    };
    check_code(*state, rows, COUNT_OF(rows));
}

static void test_constant_branches_are_pruned(void **state) {
    static const CodeRow rows[] = {
        {"frame if 1 else time\n", "global r0 = frame\nreturn r0\n"},
        {"frame if 0 else time\n", "global r0 = time\nreturn r0\n"},
        {"frame if 0\n", "move r0 = null\nreturn r0\n"},
        {"if 0\n    1\nelif frame\n    2\nelif 1\n    3\nelse\n    4\n",
         "global r1 = frame\njump false r1 to 4\nmove r0 = 2\njump to 8\njump false 1 to 7\nmove r0 = 3\njump to 8\n"
         "move r0 = 4\nreturn r0\n"},
    };
    check_code(*state, rows, COUNT_OF(rows));
}

// No attempt is made to fold an expression that contains a dynamic part, or a part that could not be folded.
static void test_static_evaluation_requests(void **state) {
    static const struct {
        const char *script;
        uint32_t fold_count;
    } rows[] = {
        {"frame+1\n", 0},
        {"1+1\n", 1},
        {"((((1-1))))*2+3;4\n", 1}, // only the difference is tried, and it fails
        {"$:k;$(1;2)\n", 1},        // only (1;2) is tried
        {"csv\n", 0},               // csv is not pure
        {"realtime\n", 1},          // realtime is constant during a run
        {"!a v=frame\n", 1},        // only the node without attributes is tried
        {"func f()\n    frame\n", 1},
        {"for i in frame;1\n    func() 1\n", 1}, // only the loop's body is tried, and it fails
        {"let x=frame\nlet y=x+1\nx;y\n", 0},
    };
    Desk *desk = *state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        compile(desk, rows[i].script);
        if (desk->evaluate_calls != rows[i].fold_count)
            print_error("%s: %u expressions\n", rows[i].script, desk->evaluate_calls);
        assert_int_equal(desk->evaluate_calls, rows[i].fold_count);
    }
    desk->options.simplify = false;
    assert_text("without", code_of(desk, "1+2\n"), "add r0 = 1 2\nreturn r0\n");
}

// A closure is an object with identity, so it may be folded only if it would be created once.
static void test_closures_are_folded_once(void **state) {
    static const CodeRow rows[] = {
        {"let f=func(x) x\nf\n", "move r0 = (<anon>)\nmove r1 = (<anon>)\nreturn r1\n"},
        {"for i in frame\n    func() 1\n",
         "global r2 = frame\nfor loop 0 r0 = r2 to 5\nclosure r3 = () <anon>\nyield loop 0 r3\nnext loop 0 r0 = to "
         "2\n"
         "end loop r1 = loop 0\nreturn r1\n\n<anon>: parameters=0 captures=0 registers=0\nreturn 1\n"},
    };
    Desk *desk = *state;
    check_code(desk, rows, COUNT_OF(rows));
    desk->options.module = true; // a module may be evaluated several times
    assert_non_null(strstr(code_of(desk, rows[0].script), "closure r0 = (null) <anon>"));
}

// A failed attempt leaves no data in the program's memory.
static void test_failed_folding_frees_memory(void **state) {
    Desk *desk = *state;
    compile(desk, "!a v=1\n");
    size_t used = desk->program.used;
    compile(desk, "!a v=frame+1\n");
    size_t once = desk->program.used - used;
    used = desk->program.used;
    compile(desk, "!a v=frame+(((((1-1)-1)-1)-1)-1)\n"); // five folding attempts, and five more instructions
    assert_true(desk->program.used - used < once + 5 * (sizeof(Instr) + sizeof(Origin) + 3 * sizeof(Value)));
}

// The path of an %include is folded even if the simplifier is off.
static void test_include_paths_are_folded(void **state) {
    static const struct {
        const char *script;
        uint32_t included;
        const char *reported;
    } rows[] = {
        {"let seen=1\n%include 'inc.fl'\n", 1, ""},
        {"let seen=frame name='inc';'.fl'\nfor i in ..2\n    %include name\n", 1, NULL},
        {"%include null\n", 0, ""},
        {"%include 'gone.fl'\n", 1, "1:10 cannot include 'gone.fl': no such file [cannot-include]\n"},
        {"let a=frame\n%include a\n", 0, "2:10 the file name of an %include must be constant [cannot-include]\n"},
        {"%include nohting\n", 0, "1:10 unbound name 'nohting' is null [unbound-name]\n"},
    };
    Desk *desk = *state;
    for (int simplify = 1; simplify >= 0; simplify--) {
        desk->options.simplify = simplify;
        for (size_t i = 0; i < COUNT_OF(rows); i++) {
            compile(desk, rows[i].script);
            assert_int_equal(desk->include_calls, rows[i].included);
            if (rows[i].reported)
                assert_text(rows[i].script, text_c(&desk->reported), rows[i].reported);
        }
    }
    assert_text("names", code_of(desk, "let seen=5\n%include 'inc.fl'\n"),
                "move r0 = 5\nadd r1 = 5 1\nnode r2 = (v=r1) none included\nreturn r2\n");
}

TEST_GROUP(program_fold) {
    const struct CMUnitTest tests[] = {
        DESK_TEST(test_constants_are_folded),        DESK_TEST(test_constant_branches_are_pruned),
        DESK_TEST(test_static_evaluation_requests),  DESK_TEST(test_closures_are_folded_once),
        DESK_TEST(test_failed_folding_frees_memory), DESK_TEST(test_include_paths_are_folded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
