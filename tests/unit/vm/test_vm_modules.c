// test_vm_modules.c: tests imports (language.md L13): names that a module sees, imported values, and diagnostics.
#include "runner.h"

static const ModuleText modules[] = {
    {"m.fl", "let a=1 b=a+1\nfunc f(x, y=b)\n    x+y\nlet a=10\n"},
    {"state.fl", "let s=$:k\nlet t=frame\n"},
    {"outer.fl", "import a from 'm.fl'\nlet c=a*2\n"},
    {"round.fl", "import again from 'round.fl'\nlet again=3\n"},
};

typedef struct ImportRow {
    const char *script;
    const char *tree;
    const char *reported;
} ImportRow;

static void test_module_sees_no_state_or_engine_names(void **state) {
    static const ImportRow rows[] = {
        {"import a;b;f from 'm.fl'\n!r v=a;b;f(5);f(5, 1)\n", "!r v=10;2;7;6\n", ""},
        {"import c from 'outer.fl'\n!r v=c\n", "!r v=20\n", ""},
        {"import a from 'm';'.fl'\n!r v=a\n", "!r v=10\n", ""},
        {"if frame==0\n    import a from 'm.fl'\n    !r v=a\n", "!r v=10\n", ""},
        {"import f from 'm.fl'\nlet g=f\nimport f from 'm.fl'\n!r v=f==g\n", "!r v=0\n",
         ""}, // each import evaluates the module again
        // A module sees neither the state nor names of the engine.
        {"import s;t from 'state.fl'\n!r v=$:k s=s t=t\n", "!r v=5\n",
         "2:7 unbound name 'frame' is null [unbound-name]\n"},
        {"import a;none;b;nothing from 'm.fl'\n!r v=a;b;none\n", "!r v=10;2\n",
         "1:1 'm.fl' does not bind 'none' 'nothing' [unknown-import]\n"},
        {"import a from 'gone.fl'\n!r v=a\n", "!r\n", "1:1 cannot import 'gone.fl': no such file [cannot-import]\n"},
        {"for i in ..2\n    let name='m.fl' if i==0 else 'gone.fl'\n    import a;b from name\n    !r v=a;b\n",
         "!r v=10;2\n!r\n", "3:5 cannot import 'gone.fl': no such file [cannot-import]\n"},
        {"func f()\n    import a;b from 'm.fl'\n    a;b\n!r v=f()\n", "!r v=10;2\n", ""},
        {"import a from null\n!r v=a\n", "!r\n", "1:1 cannot import '': no file name [cannot-import]\n"},
        {"import again from 'round.fl'\n!r v=again\n", "!r v=3\n",
         "1:1 circular import of 'round.fl' [circular-import]\n"},
    };
    Runner *runner = *state;
    runner->modules = modules;
    runner->module_count = COUNT_OF(modules);
    assert_true(state_set(runner->state, read_value(&runner->world, ":k"), value_number(5)));
    for (int simplify = 1; simplify >= 0; simplify--) {
        runner->simplify = simplify;
        for (size_t i = 0; i < COUNT_OF(rows); i++) {
            runner_run(runner, rows[i].script, 1);
            assert_text(rows[i].script, runner_tree(runner), rows[i].tree);
            assert_text(rows[i].script, text_c(&runner->reported), rows[i].reported);
        }
    }
}

// Returns the work of an import of `depth` modules, each of which imports the next.
static uint64_t import_chain(Runner *runner, uint32_t depth) {
    Arena *arena = &runner->world.arena;
    ModuleText *chain = arena_alloc_array(arena, depth, sizeof *chain);
    for (uint32_t i = 0; i < depth; i++)
        chain[i] =
            (ModuleText){str_format(arena, "%u.fl", i).bytes,
                         i + 1 < depth ? str_format(arena, "import a from '%u.fl'\n", i + 1).bytes : "let a=7\n"};
    runner->modules = chain;
    runner->module_count = depth;
    Budget budget = {.memory_limit = SIZE_MAX};
    runner->frame.budget = NULL;
    budget_begin(&budget, UINT64_MAX / 2, NULL);
    runner->frame.budget = &budget;
    runner_run(runner, "import a from '0.fl'\n!r v=a\n", 1);
    assert_text("chain", runner_tree(runner), "!r v=7\n");
    runner->frame.budget = NULL;
    return budget.work;
}

// Each import is charged for the search for a circular import, which takes longer in nested modules.
static void test_nested_imports_cost_more(void **state) {
    uint64_t work = import_chain(*state, 100);
    assert_true(import_chain(*state, 200) > 2 * work);
}

TEST_GROUP(vm_modules) {
    const struct CMUnitTest tests[] = {RUNNER_TEST(test_module_sees_no_state_or_engine_names),
                                       RUNNER_TEST(test_nested_imports_cost_more)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
