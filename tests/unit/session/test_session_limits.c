// test_session_limits.c: every limit is a diagnostic and null, and a frame that is given up changes nothing.
#include "player.h"

#include <sys/resource.h>

static void check_tree_and_told(Player *player, const char *script, const char *tree, const char *told) {
    player_forget(player);
    player_run(player, script, 1);
    assert_text(script, player_tree(player), tree);
    assert_text(script, player_told(player), told);
}

static void test_closure_depth(void **state) {
    Player *player = *state;
    check_tree_and_told(player, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(499)\n", "!a v=499\n", "");
    check_tree_and_told(player, "func f(n)\n    1+f(n-1) if n>0 else 0\n!a v=f(500)\n", "!a\n",
                        "warning t.fl:2:7 recursion too deep in 'f': the limit is 500 calls of one function "
                        "[recursion-depth]\n");
    // After it the limit is as before.
    player_run(player, "func f(n)\n    1+f(n-1) if n>0 else 0\nlet x=f(600)\n!a v=f(499)\n", 2);
    assert_text("again", player_tree(player), "!a v=499\n");
}

// Closures made anew are other objects: only the nesting of all calls limits them.
static void test_call_depth(void **state) {
    Player *player = *state;
    // A stack whose limit comes after the 8192 calls, also with the larger frames of a sanitizer.
    struct rlimit stack;
    assert_int_equal(getrlimit(RLIMIT_STACK, &stack), 0);
    stack.rlim_cur = (rlim_t)120 << 20;
    if (setrlimit(RLIMIT_STACK, &stack) != 0)
        skip();
    PetriOptions options = player_options(player);
    options.stack_bytes = (size_t)100 << 20;
    player_reopen(player, &options);
    // Each level calls a fresh closure (1) and nothing else is on the stack when it does.
    static const char deep[] = "let level=func(k, level) (func() 1+level(k-1, level)() if k>0 else 0)\n"
                               "!a v=level(%d, level)()\n";
    char text[200];
    snprintf(text, sizeof text, deep, 8191);
    check_tree_and_told(player, text, "!a v=8191\n", "");
    snprintf(text, sizeof text, deep, 8192);
    player_forget(player);
    player_run(player, text, 1);
    assert_text("8192", player_tree(player), "!a\n");
    assert_non_null(strstr(player_told(player), "the limit is 8192 nested calls [recursion-depth]"));
}

// A small stack limits sooner, with the same kind of diagnostic.
static void test_stack(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.stack_bytes = (size_t)256 << 10;
    player_reopen(player, &options);
    player_run(player,
               "let level=func(k, level) (func() 1+level(k-1, level)() if k>0 else 0)\n!a v=level(8000, level)()\n", 1);
    assert_text("tree", player_tree(player), "!a\n");
    assert_non_null(strstr(player_told(player), "the limit is the stack [recursion-depth]"));
    player_run(player, "!a v=1\n", 1);
    assert_text("goes on", player_tree(player), "!a v=1\n");
}

// Deep trees are walked by ==, by seeds and by printing: none may use up the stack, however the depth was made.
static void test_deep_nodes(void **state) {
    Player *player = *state;
    static const char make[] = "func wrap(v, n)\n    wrap((!a << v), n-1) if n>0 else v\n"
                               "func wraps(v, n)\n    wraps(wrap(v, 400), n-1) if n>0 else v\n"
                               "let deep=wraps(!b, 400) same=wraps(!b, 400)\n"
                               "!c v=deep==same;uniform(deep)[0]==uniform(same)[0]\n";
    player_run(player, make, 1);
    assert_text("children", player_tree(player), "!c v=1;1\n");
    assert_non_null(strstr(player_told(player), "the limit is 12000 levels"));
    Notebook script = {0};
    const char *at = strstr(make, "(!a << v)");
    note(&script, make, (size_t)(at - make));
    note(&script, "(!a x=v)", 8);
    note(&script, at + 9, strlen(at + 9));
    player_run(player, script.text, 1);
    assert_text("attributes", player_tree(player), "!c v=1;1\n");
    free(script.text);
}

static void test_too_long(void **state) {
    Player *player = *state;
    check_tree_and_told(player, "!a v=..1e12\n", "!a\n",
                        "warning t.fl:1:6 range too long: the limit is 134217728 elements [too-long]\n");
    check_tree_and_told(player, "!a v=0..1|1e-12\n", "!a\n",
                        "warning t.fl:1:6 range too long: the limit is 134217728 elements [too-long]\n");
}

// Loops that never end in practice: the frame's work is limited.
static void test_work(void **state) {
    Player *player = *state;
    assert_int_equal(player_load(player, "!counter state=:c\nlet v=..20000\n!a v=(frame if 0 for y in v for x in v)\n"),
                     PETRI_OK);
    assert_int_equal(petri_step(player->session), PETRI_LIMIT);
    assert_non_null(strstr(player_told(player), "more than 134217728 calls and loop rounds"));
    assert_text("state", player_state(player), "");
    player_run(player, "!a v=1\n", 1);
    assert_text("goes on", player_tree(player), "!a v=1\n");
}

static void open_small(Player *player, size_t memory_bytes) {
    PetriOptions options = player_options(player);
    options.memory_bytes = memory_bytes;
    player_reopen(player, &options);
}

static void test_memory(void **state) {
    Player *player = *state;
    open_small(player, 1 << 20);
    assert_int_equal(player_load(player, "!counter state=:c\n!a v=len(..1e6+frame) if frame==1\n"), PETRI_OK);
    player_step(player, 1);
    assert_text("before", player_state(player), "$:c = 0\n$(:c;:time) = 0\n");
    assert_int_equal(petri_step(player->session), PETRI_LIMIT);
    assert_text("told", player_told(player),
                "error the frame needs more than its 1 MiB of memory; it is given up [memory-limit]\n");
    assert_text("unchanged", player_state(player), "$:c = 0\n$(:c;:time) = 0\n");
    assert_text("no tree", player_tree(player), "");
    assert_int_equal(petri_frame(player->session).number, 1);
    assert_int_equal(petri_step(player->session), PETRI_OK); // the next frame fits again
    assert_text("after", player_state(player), "$:c = 0.03333333333333333\n$(:c;:time) = 0.03333333333333333\n");
}

// Wherever in a frame the memory runs out, nothing has changed: systems do not draw on the script's budget.
static void test_memory_anywhere(void **state) {
    Player *player = *state;
    static const char script[] = "!counter state=:c\n"
                                 "!physics state=:p dimensions=2\n"
                                 "    !random strength=5\n"
                                 "    for i in ..40+0*frame\n" // made anew in each frame
                                 "        !particle id=i position=i;1 velocity=1;2\n"
                                 "!physics state=:q dimensions=20\n"
                                 "    for i in ..40\n"
                                 "        !particle id=i position=1\n"
                                 "!counter state=:d initial=..500\n";
    int given_up = 0, done = 0;
    for (size_t bytes = 2 << 10; bytes < 64 << 10; bytes += 256) {
        open_small(player, bytes);
        assert_int_equal(player_load(player, script), PETRI_OK);
        Notebook before = {0};
        note(&before, "", 0);
        for (int frame = 0; frame < 3; frame++) {
            PetriStatus status = petri_step(player->session);
            const char *after = player_state(player);
            if (status == PETRI_LIMIT)
                assert_text("a frame that hits a limit leaves the state as it was", after, before.text);
            else
                assert_int_equal(status, PETRI_OK);
            given_up += status == PETRI_LIMIT;
            done += status == PETRI_OK;
            before.len = 0;
            note(&before, after, strlen(after));
        }
        free(before.text);
    }
    assert_true(given_up > 20);
    assert_true(done > 20);
}

// Nothing is kept from frame to frame that grows.
static void test_frames_do_not_add_up(void **state) {
    Player *player = *state;
    open_small(player, 64 << 10);
    player_run(player, "!a v=debug(..100);(x*2 for x in ..100)\n!b v=nothing(..50);'s'(3)\n!counter state=:c\n", 2000);
    assert_text("state", player_state(player), "$:c = 33.31666666666667\n$(:c;:time) = 33.31666666666667\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_closure_depth),
        PLAYER_TEST(test_stack),
        PLAYER_TEST(test_too_long),
        PLAYER_TEST(test_work),
        PLAYER_TEST(test_memory),
        PLAYER_TEST(test_memory_anywhere),
        PLAYER_TEST(test_frames_do_not_add_up),
        PLAYER_TEST(test_deep_nodes), // it used to overflow the stack
        PLAYER_TEST(test_call_depth), // makes the stack larger for what follows
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
