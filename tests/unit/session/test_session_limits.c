// test_session_limits.c: tests that a frame that exceeds a limit of work or memory is aborted without effect.
#include "petri-inspect.h"
#include "player.h"

// Loops that would run practically forever exceed the work limit.
static void test_work_limit_aborts_frame(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.work_limit = 1 << 27;
    player_reopen(player, &options);
    assert_int_equal(
        player_load(player, "!counter state=:c rate=1\nlet v=..20000\n!a v=(frame if 0 for y in v for x in v)\n"),
        PETRI_OK);
    assert_int_equal(petri_step(player->session), PETRI_LIMIT_EXCEEDED);
    assert_non_null(strstr(player_diagnostics(player),
                           "the frame exceeded its limit of 134217728 work units and was aborted [work-limit]"));
    assert_text("state", player_state(player), "");
    player_run(player, "!a v=1\n", 1);
    assert_text("continues", player_tree(player), "!a v=1\n");
}

static void open_small(Player *player, size_t memory_bytes) {
    PetriOptions options = player_options(player);
    options.memory_limit = memory_bytes;
    player_reopen(player, &options);
}

static void test_memory_limit_aborts_frame(void **state) {
    Player *player = *state;
    open_small(player, 1 << 20);
    assert_int_equal(player_load(player, "!counter state=:c rate=1\n!a v=len(..1e6+frame) if frame==1\n"), PETRI_OK);
    player_step(player, 1);
    assert_text("before", player_state(player), "$:c = 0\n$(:c;:time) = 0\n");
    assert_int_equal(petri_step(player->session), PETRI_LIMIT_EXCEEDED);
    assert_text("diagnostics", player_diagnostics(player),
                "error t.fl:2:10 the frame exceeded its memory limit of 1 MiB and was aborted [memory-limit]\n");
    assert_text("unchanged", player_state(player), "$:c = 0\n$(:c;:time) = 0\n");
    assert_text("no tree", player_tree(player), "");
    assert_int_equal(petri_frame_number(player->session), 1);
    assert_int_equal(petri_step(player->session), PETRI_OK); // the next frame is within the limit
    assert_text("after", player_state(player), "$:c = 0.03333333333333333\n$(:c;:time) = 0.03333333333333333\n");
}

// Wherever in a frame the memory limit is exceeded, nothing changes, because systems do not use the script's budget.
static void test_abort_leaves_state_unchanged(void **state) {
    Player *player = *state;
    static const char script[] = "!counter state=:c rate=1\n"
                                 "!physics state=:p dimensions=2\n"
                                 "    !random strength=5\n"
                                 "    for i in ..400+0*frame\n" // not constant, so it is created again in each frame
                                 "        !particle id=i position=i;1 velocity=1;2\n"
                                 "!physics state=:q dimensions=20\n"
                                 "    for i in ..40\n"
                                 "        !particle id=i position=1\n"
                                 "!counter state=:d initial=..500\n";
    int aborted = 0, done = 0;
    for (size_t bytes = 2 << 10; bytes < 64 << 10; bytes += 256) {
        open_small(player, bytes);
        assert_int_equal(player_load(player, script), PETRI_OK);
        Notebook before = {0};
        note(&before, "", 0);
        for (int frame = 0; frame < 3; frame++) {
            PetriStatus status = petri_step(player->session);
            const char *after = player_state(player);
            if (status == PETRI_LIMIT_EXCEEDED)
                assert_text("a frame that hits a limit leaves the state as it was", after, before.text);
            else
                assert_int_equal(status, PETRI_OK);
            aborted += status == PETRI_LIMIT_EXCEEDED;
            done += status == PETRI_OK;
            before.len = 0;
            note(&before, after, strlen(after));
        }
        free(before.text);
    }
    assert_true(aborted > 20);
    assert_true(done > 20);
}

// The work of a whole run is the sum of the work of its calls. Work of calls that exceed the limit also counts.
static void test_work_is_summed(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.work_limit = 1 << 27;
    player_reopen(player, &options);
    assert_int_equal(petri_work(NULL), 0);
    assert_int_equal(petri_work(player->session), 0);
    // The second expression is constant, so it is evaluated when the script is loaded.
    assert_int_equal(player_load(player, "!a v=(y if x<0 for y in ..10000 for x in ..(20000 if frame==2 else 1))\n"
                                         "!b v=len(i for i in ..30000)\n"),
                     PETRI_OK);
    uint64_t loaded = petri_work(player->session);
    assert_in_range(loaded, 30000, 90000);
    assert_int_equal(petri_step(player->session), PETRI_OK);
    uint64_t frame = petri_work(player->session) - loaded;
    assert_in_range(frame, 10000, 29999);
    assert_int_equal(petri_step(player->session), PETRI_OK);
    assert_int_equal(petri_work(player->session), loaded + 2 * frame);
    assert_int_equal(petri_step(player->session), PETRI_LIMIT_EXCEEDED);
    assert_in_range(petri_work(player->session), loaded + 2 * frame + (1 << 27), loaded + 3 * frame + (1 << 27));
}

// Reading the names of a text is limited like a frame. Besides the work of the parser, which petri_tokenise also does,
// each node of the syntax tree is one unit of work.
static void test_bindings_count_as_work(void **state) {
    Player *player = *state;
    char text[2 * 5000];
    for (size_t i = 0; i < sizeof text; i++)
        text[i] = i % 2 ? ';' : '1';
    assert_int_equal(petri_tokenise(player->session, text, sizeof text - 1, player_ignore_token, NULL), PETRI_OK);
    uint64_t parsing = petri_work(player->session);
    assert_int_equal(petri_bindings(player->session, text, sizeof text - 1, player_ignore_name, NULL), PETRI_OK);
    assert_in_range(petri_work(player->session), 2 * parsing + 5000, 2 * parsing + 6000);
}

// Memory does not grow from frame to frame.
static void test_memory_does_not_grow(void **state) {
    Player *player = *state;
    open_small(player, 64 << 10);
    player_run(player, "!a v=debug(..100);(x*2 for x in ..100)\n!b v=nothing(..50);'s'(3)\n!counter state=:c rate=1\n",
               2000);
    assert_text("state", player_state(player), "$:c = 33.31666666666667\n$(:c;:time) = 33.31666666666667\n");
}

// Diagnostics of scripts that cannot be loaded leave nothing in memory.
static void test_failed_loads_retain_no_memory(void **state) {
    Player *player = *state;
    static char name[100000];
    memset(name, 'n', sizeof name - 1);
    open_small(player, 1 << 20); // the session may use 64 MiB more for its own data
    for (int i = 0; i < 400; i++)
        assert_int_equal(petri_load_text(player->session, name, "!a )", PETRI_NUL_TERMINATED), PETRI_INVALID);
    assert_int_equal(petri_diagnostic_count(player->session, PETRI_ERROR), 400);
}

// A constant expression that needs more than 512 MiB is not evaluated when the script is loaded.
static void test_large_constants_are_not_folded(void **state) {
    Player *player = *state;
    open_small(player, (size_t)500 << 20);
    player_run(player, "!a v=len(..8000000+frame)\n!b v=(len(..70000000) if frame<0 else 1)\n", 1);
    assert_text("tree", player_tree(player), "!a v=8000000\n!b v=1\n");
}

TEST_GROUP(session_limits) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_work_limit_aborts_frame),        PLAYER_TEST(test_memory_limit_aborts_frame),
        PLAYER_TEST(test_abort_leaves_state_unchanged),   PLAYER_TEST(test_work_is_summed),
        PLAYER_TEST(test_memory_does_not_grow),           PLAYER_TEST(test_failed_loads_retain_no_memory),
        PLAYER_TEST(test_large_constants_are_not_folded), PLAYER_TEST(test_bindings_count_as_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
