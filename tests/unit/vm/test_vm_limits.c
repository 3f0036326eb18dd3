// test_vm_limits.c: tests that exceeding a limit gives a diagnostic and null.
#include "runner.h"

#include <sys/resource.h>

static void check_tree_and_reports(Runner *runner, const char *script, const char *tree, const char *reported) {
    runner_run(runner, script, 1);
    assert_text(script, runner_tree(runner), tree);
    if (reported)
        assert_text(script, text_c(&runner->reported), reported);
}

static void test_closure_depth(void **state) {
    Runner *runner = *state;
    check_tree_and_reports(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(499)\n", "!a v=499\n", "");
    check_tree_and_reports(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(500)\n", "!a\n",
                           "2:7 recursion too deep in 'f': limit of 500 calls of one function reached "
                           "[recursion-depth]\n");
    // After a call that failed, the limit is still the same.
    runner_run(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\nlet x=f(600)\n!a v=f(499)\n", 2);
    assert_text("again", runner_tree(runner), "!a v=499\n");
}

// The recursion limit of a function does not apply here, because each call is of a new closure. Only the total depth of
// calls is limited.
static void test_call_depth(void **state) {
    Runner *runner = *state;
    // A stack that is large enough for 8192 calls, even with the larger stack frames of sanitizers.
    struct rlimit stack;
    assert_int_equal(getrlimit(RLIMIT_STACK, &stack), 0);
    stack.rlim_cur = (rlim_t)120 << 20;
    if (setrlimit(RLIMIT_STACK, &stack) != 0)
        skip();
    runner->vm.stack_bytes = (size_t)100 << 20;
    runner->simplify = false;
    // Each level calls a new closure and needs little else on the stack.
    static const char deep[] = "let level=func(k, level) (func() 1+level(k-1, level)() if k>0 else 0)\n"
                               "!a v=level(%d, level)()\n";
    char text[200];
    snprintf(text, sizeof text, deep, 8191);
    check_tree_and_reports(runner, text, "!a v=8191\n", "");
    snprintf(text, sizeof text, deep, 8192);
    runner_run(runner, text, 1);
    assert_text("8192", runner_tree(runner), "!a\n");
    assert_non_null(strstr(text_c(&runner->reported), "limit of 8192 nested calls reached [recursion-depth]"));
}

// With a small stack, the depth limit is lower. The kind of diagnostic is the same.
static void test_stack_limit(void **state) {
    Runner *runner = *state;
    runner->vm.stack_bytes = (size_t)256 << 10;
    runner->simplify = false;
    runner_run(runner,
               "let level=func(k, level) (func() 1+level(k-1, level)() if k>0 else 0)\n!a v=level(8000, level)()\n", 1);
    assert_text("tree", runner_tree(runner), "!a\n");
    assert_non_null(strstr(text_c(&runner->reported), "stack limit reached [recursion-depth]"));
    runner_run(runner, "!a v=1\n", 1);
    assert_text("continues", runner_tree(runner), "!a v=1\n");
}

// ==, seeds and printing traverse deep trees without overflowing the stack.
static void test_deep_nodes(void **state) {
    Runner *runner = *state;
    static const char make[] = "func wrap(v, n)\n    wrap((!a << v), n-1) if n>0 else v\n"
                               "func wraps(v, n)\n    wraps(wrap(v, 400), n-1) if n>0 else v\n"
                               "let deep=wraps(!b, 400) same=wraps(!b, 400)\n"
                               "!c v=deep==same;uniform(deep)[0]==uniform(same)[0]\n";
    runner_run(runner, make, 1);
    assert_text("children", runner_tree(runner), "!c v=1;1\n");
    assert_non_null(strstr(text_c(&runner->reported), "the limit is 12000 levels"));
    const char *at = strstr(make, "(!a << v)");
    Str script = str_format(&runner->world.arena, "%.*s(!a x=v)%s", (int)(at - make), make, at + 9);
    runner_run(runner, script.bytes, 1);
    assert_text("attributes", runner_tree(runner), "!c v=1;1\n");
}

static void test_long_vectors_are_reported(void **state) {
    Runner *runner = *state;
    check_tree_and_reports(runner, "!a v=..1e12\n", "!a\n",
                           "1:6 range too long: the limit is 134217728 elements [too-long]\n");
    check_tree_and_reports(runner, "!a v=0..1|1e-12\n", "!a\n",
                           "1:6 range too long: the limit is 134217728 elements [too-long]\n");
}

static void make_frame(void *runner) {
    runner_frame(runner, 0);
}

// Evaluates a frame with a work limit. Returns how the frame ends.
static ArenaOutcome run_with_budget(Runner *runner, const char *script, uint64_t work, atomic_bool *interrupt) {
    Budget budget = {.memory_limit = SIZE_MAX};
    Arena *frame = &runner->frame;
    budget_begin(&budget, work, interrupt);
    assert_true(runner_load(runner, script));
    arena_free(frame);
    frame->budget = &budget;
    ArenaOutcome end = arena_protect(&frame, 1, make_frame, runner);
    arena_free(frame);
    frame->budget = NULL;
    return end;
}

// Evaluation that exceeds the work limit is aborted, and the current position is available.
static void test_work_limit_aborts(void **state) {
    Runner *runner = *state;
    static const char rounds[] = "let n=frame\n!a v=len(i for i in ..900+n)\n";
    assert_int_equal(run_with_budget(runner, rounds, 2000, NULL), ARENA_OK);
    assert_int_equal(run_with_budget(runner, rounds, 800, NULL), ARENA_WORK_LIMIT);
    assert_int_equal(runner->vm.at->span.start, strlen("let n=frame\n!a v=len("));
    check_tree_and_reports(runner, "let n=frame f=func(x) x\n!a v=f(1+n)\n", "!a v=1\n",
                           ""); // the next frame has a new budget
}

static const char shared[] = "func f(n, v)\n    f(n-1, (!n << (v;v))) if n>0 else v\n";

// All expensive operations are charged: a budget of a small part of their work is exceeded.
static void test_expensive_operations_are_charged(void **state) {
    Runner *runner = *state;
    static const char *const rows[] = {
        "!a v=sum((..1e6)+frame)",
        "!a v=len(sort(uniform(1+frame)[..1e5]))",
        "!a v=len(noise(1, (..200)+frame, ..200))",
        "!a v=count((..1e5)+frame, ..1e5)[0]",
        "let x=0*(..4000)+frame\n!a v=((x;1) in (x;x))",
        "!a v=len(concat((..1e4)+frame))",
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_int_equal(run_with_budget(runner, rows[i], (uint64_t)1 << 24, NULL), ARENA_OK);
        assert_claim(rows[i], run_with_budget(runner, rows[i], 1000, NULL) == ARENA_WORK_LIMIT);
    }
}

// A tree that represents 2^60 nodes, although it has only 61 distinct ones.
static void test_shared_nodes(void **state) {
    Runner *runner = *state;
    Arena *arena = &runner->world.arena;
    Str script = str_format(arena,
                            "%slet x=f(60+frame, !x) y=f(60+frame, !x)\n"
                            "!a v=(x==y);(uniform(x)[0]==uniform(y)[0]);((x;1)<(y;2));(x in (1;y))\n",
                            shared);
    assert_int_equal(run_with_budget(runner, script.bytes, 1 << 20, NULL), ARENA_OK);
    script = str_format(arena, "%s!a v=len(debug(f(60+frame, !x)))\n", shared);
    assert_int_equal(run_with_budget(runner, script.bytes, 1 << 16, NULL), ARENA_WORK_LIMIT);
}

static void test_interrupt_aborts_frame(void **state) {
    Runner *runner = *state;
    atomic_bool interrupt = true;
    static const char rounds[] = "let n=frame\n!a v=len(i for i in ..2000+n)\n";
    assert_int_equal(run_with_budget(runner, rounds, 1 << 20, &interrupt), ARENA_INTERRUPTED);
    interrupt = false;
    assert_int_equal(run_with_budget(runner, rounds, 1 << 20, &interrupt), ARENA_OK);
}

// Expressions that exceed a limit are not folded. At load time, nothing is reported.
static void test_static_evaluation_reports_limit(void **state) {
    Runner *runner = *state;
    check_tree_and_reports(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(600)\n", "!a\n", NULL);
    assert_int_equal(runner->static_vm.reported_count > 0, true);
}

TEST_GROUP(vm_limits) {
    const struct CMUnitTest tests[] = {
        RUNNER_TEST(test_closure_depth),
        RUNNER_TEST(test_stack_limit),
        RUNNER_TEST(test_long_vectors_are_reported),
        RUNNER_TEST(test_work_limit_aborts),
        RUNNER_TEST(test_interrupt_aborts_frame),
        RUNNER_TEST(test_static_evaluation_reports_limit),
        RUNNER_TEST(test_expensive_operations_are_charged),
        RUNNER_TEST(test_shared_nodes),
        RUNNER_TEST(test_deep_nodes), // a regression test for a stack overflow
        RUNNER_TEST(test_call_depth), // enlarges the stack, so it runs last
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
