// test_vm_nodes.c: tests the creation of nodes: their positions, and which parts of the tree are shared between frames.
#include "runner.h"

static const Node *top_node(const Runner *runner, uint32_t i) {
    assert_true(runner->result.kind == VALUE_MIXED && i < runner->result.len);
    return runner->result.as.items[i].as.node;
}

// Returns `line:column` of a node, or of one of its attributes.
static const char *place(Runner *runner, const Node *node, const char *attr) {
    Origin origin = node_origin(node, attr ? name_of(&runner->world, attr) : NULL);
    if (!origin.source)
        return "unknown";
    SourcePosition at = source_locate(origin.source, origin.span.start);
    return str_format(&runner->world.arena, "%u:%u", at.line, at.column).bytes;
}

// Positions remain available after the syntax tree has been freed (runner.h overwrites it).
static void test_positions_of_nodes(void **state) {
    Runner *runner = *state;
    for (int simplify = 1; simplify >= 0; simplify--) {
        runner->simplify = simplify;
        runner_run(runner, "let z=frame\n!a x=1 y=z\n    !b w=z\n(!c q=2)\n", 1);
        const Node *a = top_node(runner, 0);
        assert_text("node", place(runner, a, NULL), "2:1");
        assert_text("static attribute", place(runner, a, "x"), "2:4");
        assert_text("attribute", place(runner, a, "y"), "2:8");
        assert_text("no attribute", place(runner, a, "none"), "2:1");
        assert_text("child", place(runner, a->children[0], "w"), "3:8");
        assert_text("static", place(runner, top_node(runner, 1), "q"), "4:5");
    }
}

// Constant parts of the tree are created once and shared by all frames.
static void test_constant_children_are_shared(void **state) {
    Runner *runner = *state;
    static const char script[] = "!a v=frame\n    !b\n        !c x=1\n    !d\n!e x=frame\n    !f x=frame\n    !g\n";
    runner_run(runner, script, 1);
    const Node *a = top_node(runner, 0), *const *children = a->children, *e = top_node(runner, 1);
    assert_true(a->program_lifetime_children && !a->program_lifetime && children[0]->program_lifetime);
    assert_true(!e->program_lifetime_children && !e->children[0]->program_lifetime);
    assert_true(e->children[1]->program_lifetime);
    runner_frame(runner, 1);
    assert_ptr_equal(top_node(runner, 0)->children, children);
    runner->simplify = false;
    runner_run(runner, script, 1);
    assert_false(top_node(runner, 0)->program_lifetime_children);
}

// Nodes that one instruction creates equal those that are created step by step.
static void test_node_construction(void **state) {
    static const ScriptRow rows[] = {
        {"let z=frame*0\n!a #t x=1+z y='s' z=z\n", "!a #t x=1 y='s' z=0\n"},
        {"let z=frame*0 n=!a\n(n #t x=1+z y='s') z=z\n", "!a #t x=1 y='s' z=0\n"},
        {"let z=frame*0\n!a x=z x=null+z y=2 x=z+1\n", "!a y=2 x=1\n"},
        {"let z=frame*0\n!a x=(!b v=z) y=uniform(:a+z)\n    !c\n    z\n", "!a x=(!b)\n    !c\n"},
        {"let z=frame*0\n(!a;!b;7) #k v=z\n", "!a #k v=0\n!b #k v=0\n"},
        {"let z=frame*0\n(!a;!b) << ((!c v=i+z) for i in ..2)\n",
         "!a\n    !c v=0\n    !c v=1\n!b\n    !c v=0\n    !c v=1\n"},
        {"let z=frame*0\n(7+z) v=1\nnull << !a\n", ""},
    };
    check_trees(*state, rows, COUNT_OF(rows), 2);
}

// More attributes than the compiler checks for duplicates.
static void test_many_attributes(void **state) {
    Runner *runner = *state;
    Text script = text_new(&runner->world.arena), wanted = text_new(&runner->world.arena);
    text_add_c(&script, "!a");
    text_add_c(&wanted, "!a");
    for (int i = 0; i < 100; i++) {
        text_add_format(&script, " x%d=frame+%d", i, i);
        text_add_format(&wanted, " x%d=%d", i, i);
    }
    text_add_c(&script, " x5=null\n");
    const char *tree = text_c(&wanted), *fifth = strstr(tree, " x5=5");
    runner_run(runner, text_c(&script), 1);
    assert_text("tree", runner_tree(runner),
                str_format(&runner->world.arena, "%.*s%s\n", (int)(fifth - tree), tree, fifth + 5).bytes);
}

// A loop frees the temporary data of each iteration that it adds to a node batch, even after an error was reported.
static void test_iterations_free_their_data(void **state) {
    enum { ITERATIONS = 20000, MAX_BYTES = 50 * ITERATIONS };
    // The inner loop of the second row prevents the execution of several iterations at once.
    static const char *const attributes[] = {"id=i x=((..100)+i+frame)[5]",
                                             "id=(i for k in ..1) x=((..100)+i+frame)[5]"};
    static const char *const before[] = {"null", "(..1e12)"};
    Runner *runner = *state;
    symbol_intern_batched(&runner->world.symbols, STR("particle"));
    for (size_t i = 0; i < COUNT_OF(attributes) * COUNT_OF(before); i++) {
        Str script = str_format(&runner->world.arena, "let n=%s\n!top v=n\n    for i in ..%d\n        !particle %s\n",
                                before[i % 2], ITERATIONS, attributes[i / 2]);
        runner_run(runner, script.bytes, 1);
        assert_int_equal(runner->vm.reported_count, i % 2);
        assert_in_range(runner->frame.used, ITERATIONS, MAX_BYTES);
    }
}

TEST_GROUP(vm_nodes) {
    const struct CMUnitTest tests[] = {
        RUNNER_TEST(test_positions_of_nodes),         RUNNER_TEST(test_constant_children_are_shared),
        RUNNER_TEST(test_node_construction),          RUNNER_TEST(test_many_attributes),
        RUNNER_TEST(test_iterations_free_their_data),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
