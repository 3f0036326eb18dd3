// test_vm_limits.c: every limit is a diagnostic and null.
#include "runner.h"

#include <sys/resource.h>

static void check_tree_and_told(Runner *runner, const char *script, const char *tree, const char *told) {
    runner_run(runner, script, 1);
    assert_text(script, runner_tree(runner), tree);
    if (told)
        assert_text(script, text_c(&runner->told), told);
}

static void test_closure_depth(void **state) {
    Runner *runner = *state;
    check_tree_and_told(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(499)\n", "!a v=499\n", "");
    check_tree_and_told(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(500)\n", "!a\n",
                        "2:7 recursion too deep in 'f': the limit is 500 calls of one function "
                        "[recursion-depth]\n");
    // After it the limit is as before.
    runner_run(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\nlet x=f(600)\n!a v=f(499)\n", 2);
    assert_text("again", runner_tree(runner), "!a v=499\n");
}

// Closures made anew are other objects: only the nesting of all calls limits them.
static void test_call_depth(void **state) {
    Runner *runner = *state;
    // A stack whose limit comes after the 8192 calls, also with the larger frames of a sanitizer.
    struct rlimit stack;
    assert_int_equal(getrlimit(RLIMIT_STACK, &stack), 0);
    stack.rlim_cur = (rlim_t)120 << 20;
    if (setrlimit(RLIMIT_STACK, &stack) != 0)
        skip();
    runner->vm.stack_bytes = (size_t)100 << 20;
    runner->simplify = false;
    // Each level calls a fresh closure (1) and nothing else is on the stack when it does.
    static const char deep[] = "let level=func(k, level) (func() 1+level(k-1, level)() if k>0 else 0)\n"
                               "!a v=level(%d, level)()\n";
    char text[200];
    snprintf(text, sizeof text, deep, 8191);
    check_tree_and_told(runner, text, "!a v=8191\n", "");
    snprintf(text, sizeof text, deep, 8192);
    runner_run(runner, text, 1);
    assert_text("8192", runner_tree(runner), "!a\n");
    assert_non_null(strstr(text_c(&runner->told), "the limit is 8192 nested calls [recursion-depth]"));
}

// A small stack limits sooner, with the same kind of diagnostic.
static void test_stack(void **state) {
    Runner *runner = *state;
    runner->vm.stack_bytes = (size_t)256 << 10;
    runner->simplify = false;
    runner_run(runner,
               "let level=func(k, level) (func() 1+level(k-1, level)() if k>0 else 0)\n!a v=level(8000, level)()\n", 1);
    assert_text("tree", runner_tree(runner), "!a\n");
    assert_non_null(strstr(text_c(&runner->told), "the limit is the stack [recursion-depth]"));
    runner_run(runner, "!a v=1\n", 1);
    assert_text("goes on", runner_tree(runner), "!a v=1\n");
}

// Deep trees are walked by ==, by seeds and by printing: none may use up the stack, however the depth was made.
static void test_deep_nodes(void **state) {
    Runner *runner = *state;
    static const char make[] = "func wrap(v, n)\n    wrap((!a << v), n-1) if n>0 else v\n"
                               "func wraps(v, n)\n    wraps(wrap(v, 400), n-1) if n>0 else v\n"
                               "let deep=wraps(!b, 400) same=wraps(!b, 400)\n"
                               "!c v=deep==same;uniform(deep)[0]==uniform(same)[0]\n";
    runner_run(runner, make, 1);
    assert_text("children", runner_tree(runner), "!c v=1;1\n");
    assert_non_null(strstr(text_c(&runner->told), "the limit is 12000 levels"));
    const char *at = strstr(make, "(!a << v)");
    Str script = str_format(&runner->world.arena, "%.*s(!a x=v)%s", (int)(at - make), make, at + 9);
    runner_run(runner, script.bytes, 1);
    assert_text("attributes", runner_tree(runner), "!c v=1;1\n");
}

static void test_too_long(void **state) {
    Runner *runner = *state;
    check_tree_and_told(runner, "!a v=..1e12\n", "!a\n",
                        "1:6 range too long: the limit is 134217728 elements [too-long]\n");
    check_tree_and_told(runner, "!a v=0..1|1e-12\n", "!a\n",
                        "1:6 range too long: the limit is 134217728 elements [too-long]\n");
}

// A frame whose work is used up is given up: it has no result, and this is told once.
static void test_work(void **state) {
    Runner *runner = *state;
    runner->vm.work_limit = 1000;
    check_tree_and_told(runner, "let n=frame\n!a v=len(i for i in ..900+n)\n", "!a v=900\n", "");
    check_tree_and_told(
        runner, "let n=frame\n!a v=len(i for i in ..1100+n)\n!b v=len(i for i in ..1100+n)\n", "",
        "2:10 the frame makes more than 134217728 calls and loop rounds; it is given up [work-limit]\n");
    check_tree_and_told(runner, "let n=frame f=func(x) x\n!a v=f(1+n)\n", "!a v=1\n", ""); // the next frame has its own
}

// Whoever waits for a frame may end it.
static void test_interrupt(void **state) {
    Runner *runner = *state;
    atomic_bool wish = true;
    runner->vm.interrupt = &wish;
    check_tree_and_told(runner, "let n=frame\n!a v=len(i for i in ..2000+n)\n", "", "");
    assert_true(runner->vm.stopped);
    wish = false;
    check_tree_and_told(runner, "let n=frame\n!a v=len(i for i in ..2000+n)\n", "!a v=2000\n", "");
}

// What cannot be evaluated ahead is left for the frames: the simplifier's machine gives up, and says nothing.
static void test_ahead(void **state) {
    Runner *runner = *state;
    check_tree_and_told(runner, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(600)\n", "!a\n", NULL);
    assert_int_equal(runner->ahead.reported_count > 0, true);
    runner->ahead.work_limit = 100;
    check_tree_and_told(runner, "!a v=len(i for i in ..200)\n", "!a v=200\n", "");
    assert_true(runner->ahead.stopped);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        RUNNER_TEST(test_closure_depth), RUNNER_TEST(test_stack),     RUNNER_TEST(test_too_long),
        RUNNER_TEST(test_work),          RUNNER_TEST(test_interrupt), RUNNER_TEST(test_ahead),
        RUNNER_TEST(test_deep_nodes), // it used to overflow the stack
        RUNNER_TEST(test_call_depth), // makes the stack larger for what follows
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
