// test_session_allocator.c: tests petri_set_allocator. libpetri and libpetri-draw must allocate all memory with the
// host's functions and release all of it, whichever allocation fails.
#include "folder.h"
#include "petri-draw.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "player.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>

// Header of each block. If a released block has no valid header, it was never allocated or was released twice.
typedef struct Head {
    size_t bytes;
    uint64_t mark;
} Head;
enum { ALIGNMENT = 16, JUNK = 0xa5 };
static const uint64_t ALLOCATED = 0x7065747269, RELEASED = 1;

typedef struct Host {
    atomic_long asked;
    atomic_long blocks; // number of allocated blocks
    atomic_long bytes;
    atomic_long peak;    // maximum of `bytes`
    atomic_bool strayed; // an unknown block was released, or a size of 0 was requested
    long fail_at;        // number of the call that fails; 0: none
    bool all;            // true if all later calls fail as well
} Host;

static bool should_fail(Host *host, size_t bytes) {
    long number = ++host->asked;
    host->strayed = host->strayed || bytes == 0;
    return number == host->fail_at || (host->all && host->fail_at > 0 && number > host->fail_at);
}

static void *record_allocation(Host *host, Head *head, size_t bytes) {
    *head = (Head){bytes, ALLOCATED};
    host->bytes += (long)bytes;
    if (host->bytes > host->peak)
        host->peak = host->bytes;
    return head + 1;
}

static bool record_release(Host *host, Head *head) {
    if (head->mark != ALLOCATED) {
        host->strayed = true;
        return false;
    }
    host->bytes -= (long)head->bytes;
    head->mark = RELEASED;
    return true;
}

static void *host_allocate(void *context, size_t bytes) {
    Host *host = context;
    Head *head = should_fail(host, bytes) ? NULL : malloc(sizeof *head + bytes);
    if (!head)
        return NULL;
    host->blocks++;
    memset(head + 1, JUNK, bytes); // callers must not assume zeroed blocks
    return record_allocation(host, head, bytes);
}

static void *host_resize(void *context, void *block, size_t bytes) {
    Host *host = context;
    Head *head = (Head *)block - 1, *moved = NULL;
    if (should_fail(host, bytes) || !record_release(host, head) || !(moved = malloc(sizeof *head + bytes))) {
        if (head->mark == RELEASED)
            record_allocation(host, head, head->bytes);
        return NULL;
    }
    size_t kept = head->bytes < bytes ? head->bytes : bytes;
    memcpy(moved + 1, head + 1, kept);
    memset((unsigned char *)(moved + 1) + kept, JUNK, bytes - kept);
    free(head);
    return record_allocation(host, moved, bytes);
}

static void host_release(void *context, void *block) {
    Host *host = context;
    Head *head = (Head *)block - 1;
    if (!record_release(host, head))
        return;
    host->blocks--;
    memset(block, JUNK, head->bytes);
    free(head);
}

static Host host;

static PetriAllocator allocator_of(Host *its) {
    *its = (Host){0};
    return (PetriAllocator){sizeof(PetriAllocator), host_allocate, host_resize, host_release, its};
}

static void use_host(void) {
    PetriAllocator allocator = allocator_of(&host);
    assert_int_equal(petri_set_allocator(&allocator), PETRI_OK);
}

// Checks that each block was released exactly once.
static void check_all_released(const char *when) {
    assert_number(when, (double)host.blocks, 0);
    assert_number(when, (double)host.bytes, 0);
    assert_false(host.strayed);
}

static const char *const MODULE = "func twice(x)\n    x*2\n";
static const char *const SCRIPT =
    "import twice from 'module.fl'\n"
    "let N=N or 5 -- 1..9 how many\n"
    "func area(x)\n    twice(x)*x\n"
    "!physics state=:cells dimensions=2 resolution=0.1\n"
    "    for i in ..(N if frame < 2 else 400)\n"
    "        !particle id=i position=9*uniform(:a)[i];9*uniform(:b)[i] radius=0.1\n"
    "    !anchor id='hub' position=0;0\n"
    "    !distance from=0 to='hub' fixed=2 strength=9\n    !collision\n"
    "!counter state=:count rate=2;3\n"
    "!shown value=area($:count) text=read('module.fl') x=debug(frame) y=noise(:n, frame)\n"
    "!exact z=0.12345678901234567890123456789012345678901234567890123456789012345678901234567\n"
    "!window size=40;40\n    !key name=:space state=:space\n"
    "    !canvas size=40;40\n        !fill color=0;1;0\n            !rect size=20;20\n"
    "        !shadow radius=2\n            !text text='text' point=20;30\n"
    "            !image filename='missing.jpg' point=0;0\n";

// Data of run_lifetime, which calls functions of all parts of the interface.
typedef struct Life {
    Folder *folder;
    bool simplify;
    Notebook written; // output of the calls
    bool short_of;    // true if an allocation failed
} Life;

static bool write_note(void *context, const char *text, size_t length) {
    return note(&((Life *)context)->written, text, length);
}

static void check_status(Life *life, PetriStatus status) {
    if (status != PETRI_OK)
        assert_int_equal(status, PETRI_OUT_OF_MEMORY);
    life->short_of |= status == PETRI_OUT_OF_MEMORY;
}

static void use_session(Life *life, PetriSession *session) {
    PetriPromptResult done;
    PetriEvaluation result;
    PetriParameter parameter;
    PetriValue seven = {1, &(double){7}, NULL};
    check_status(life, petri_set_global(session, "given", seven));
    check_status(life, petri_load(session, folder_file(life->folder, "s.fl")));
    if (life->short_of)
        return;
    for (int i = 0; i < 2; i++)
        check_status(life, petri_step(session));
    petri_parameter(session, 0, &parameter, sizeof parameter);
    check_status(life,
                 petri_prompt(session, "let more=area(2)", PETRI_NUL_TERMINATED, write_note, life, &done, sizeof done));
    check_status(life, petri_evaluate(session, "uniform(:x)[..3];'t'", PETRI_NUL_TERMINATED, &result, sizeof result,
                                      write_note, life));
    PetriSnapshot *snapshot = petri_snapshot(session);
    PetriConfig *config = petri_config_get(session);
    life->short_of |= !snapshot || !config;
    folder_write(life->folder, "module.fl", MODULE); // the module is loaded again
    check_status(life, petri_set_parameter(session, "N", "3"));
    check_status(life, petri_step(session));
    check_status(life, petri_save(session, folder_file(life->folder, "state")));
    check_status(life, petri_restore(session, folder_file(life->folder, "state")));
    if (snapshot)
        check_status(life, petri_rewind(session, snapshot));
    check_status(life, petri_step(session));
    petri_particle_ids(session, 0);
    check_status(life, petri_print(session, PETRI_PRINT_TREE | PETRI_PRINT_STATE | PETRI_PRINT_LOG, write_note, life));
    petri_config_free(config);
    petri_snapshot_free(snapshot);
}

// Pictures and painters may outlive the session.
static void use_picture(Life *life, PetriSession **session) {
    static uint32_t pixels[40 * 40];
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    PetriPainter *painter = petri_painter_open();
    check_status(life, painter ? PETRI_OK : PETRI_OUT_OF_MEMORY);
    check_status(life, petri_picture(*session, &options, &picture));
    petri_close(session);
    if (picture && painter) {
        PetriStatus status = petri_picture_draw(picture, painter, pixels, 40, 40, 160);
        if (status != PETRI_UNSUPPORTED) { // a build without Cairo
            check_status(life, status);
            check_status(life, petri_picture_save(picture, painter, folder_file(life->folder, "a.png")));
        }
    }
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

static void run_lifetime(Life *life) {
    PetriOptions options = petri_default_options();
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !life->simplify};
    options.profile = true;
    options.threads = 2;
    life->short_of = false;
    life->written.len = 0;
    PetriSession *session = petri_open(&options);
    check_status(life, session ? PETRI_OK : PETRI_OUT_OF_MEMORY);
    if (!session)
        return;
    use_session(life, session);
    if (!life->short_of)
        use_picture(life, &session);
    petri_close(&session);
}

static void test_everything_is_released(void **state) {
    Life own = {.folder = *state, .simplify = true}, theirs = own;
    run_lifetime(&own);
    use_host();
    run_lifetime(&theirs);
    assert_false(own.short_of || theirs.short_of);
    assert_true(host.asked > 100);
    check_all_released("a whole life");
    assert_string_equal(theirs.written.text, own.written.text);
    free(own.written.text);
    free(theirs.written.text);
}

// Lets a sample of the allocations fail in each way. TRIES=1000000 tries all of them.
static void test_failing_allocation_leaks_nothing(void **state) {
    const char *tries = getenv("TRIES");
    Life life = {.folder = *state, .simplify = true};
    use_host();
    run_lifetime(&life);
    long total = host.asked, stride = 1 + total / (tries ? strtol(tries, NULL, 10) : 40), short_of = 0;
    for (long number = 1; number <= total; number += stride)
        for (int all = 0; all < 2; all++) {
            char when[60];
            snprintf(when, sizeof when, "call %ld%s fails", number, all ? " and all later ones" : "");
            use_host();
            host.fail_at = number;
            host.all = all;
            run_lifetime(&life);
            short_of += life.short_of;
            check_all_released(when);
        }
    assert_true(short_of > 20);
    free(life.written.text);
}

// The allocator cannot be changed while any block is allocated.
static void test_allocator_in_use_is_not_replaced(void **state) {
    (void)state;
    Host other;
    PetriAllocator allocator = allocator_of(&other), wrong = allocator;
    use_host();
    wrong.size = 0;
    assert_int_equal(petri_set_allocator(&wrong), PETRI_INVALID);
    wrong = allocator;
    wrong.resize = NULL;
    assert_int_equal(petri_set_allocator(&wrong), PETRI_INVALID);
    PetriSession *session = petri_open(&(PetriOptions){0});
    assert_null(session);
    PetriOptions options = petri_default_options();
    session = petri_open(&options);
    assert_int_equal(petri_set_allocator(&allocator), PETRI_INVALID);
    assert_int_equal(petri_set_allocator(NULL), PETRI_INVALID);
    assert_int_equal(petri_load_text(session, "t.fl", "!a x=1\n", PETRI_NUL_TERMINATED), PETRI_OK);
    petri_close(&session);
    PetriPainter *painter = petri_painter_open();
    assert_int_equal(petri_set_allocator(NULL), PETRI_INVALID);
    petri_painter_close(&painter);
    check_all_released("refused");
    assert_true(host.asked > 0);
    assert_int_equal(other.asked, 0);
    assert_int_equal(petri_set_allocator(&allocator), PETRI_OK);
    session = petri_open(&options);
    petri_close(&session);
    assert_true(other.asked > 0);
    assert_int_equal(petri_set_allocator(NULL), PETRI_OK);
    long asked = other.asked;
    session = petri_open(&options);
    petri_close(&session);
    assert_int_equal(other.asked, asked);
}

// Draws two layers of `side` x `side` pixels, one inside the other. Returns the maximum of the bytes allocated, or 0 if
// this build has no Cairo. Sets *reported to true if the memory limit was reported.
static long draw_layers(int side, size_t memory_limit, bool *reported) {
    static uint32_t pixels[40 * 40];
    char script[500];
    Player player;
    PetriOptions options = player_options(&player);
    options.memory_limit = memory_limit;
    use_host();
    player_open_with(&player, &options);
    snprintf(script, sizeof script,
             "!window size=40;40\n    !canvas size=%d;%d\n        !layer size=%d;%d alpha=0.5\n"
             "            !layer size=%d;%d\n                !rect size=9000 fill=true color=1;0;0\n",
             side, side, side, side, side, side);
    player_run(&player, script, 1);
    PetriPictureOptions wanted = petri_default_picture_options();
    PetriPicture *picture = NULL;
    PetriPainter *painter = petri_painter_open();
    assert_int_equal(petri_picture(player.session, &wanted, &picture), PETRI_OK);
    PetriStatus status = petri_picture_draw(picture, painter, pixels, 40, 40, 160);
    assert_true(status == PETRI_OK || status == PETRI_UNSUPPORTED);
    petri_picture_report(player.session, picture);
    *reported = strstr(player.diagnostics.text, "[memory-limit]") != NULL;
    petri_picture_free(&picture);
    petri_painter_close(&painter);
    player_close(&player);
    check_all_released("layers");
    return status == PETRI_OK ? host.peak : 0;
}

// The memory limit counts what libpetri-draw allocates, whether it is a static or a shared library.
static void test_drawing_counts_towards_memory_limit(void **state) {
    (void)state;
    bool reported;
    long peaks[2];
    for (int i = 0; i < 2; i++) {
        peaks[i] = draw_layers(1500 * (i + 1), (size_t)1 << 30, &reported);
        assert_false(reported);
    }
    if (peaks[0] == 0)
        skip();
    assert_true(peaks[1] > 3 * peaks[0]); // pixels are allocated by the host's functions
    long limited = draw_layers(3000, (size_t)peaks[1] / 2, &reported);
    assert_true(reported);
    assert_true(limited <= peaks[1] / 2);
}

// Runs a session in a thread. All threads share the heap.
static void *run_in_thread(void *context) {
    Player player;
    player_open(&player);
    for (int i = 0; i < 20; i++)
        player_run(&player, "!physics state=:s dimensions=1\n    for i in ..50\n        !particle id=i position=i\n",
                   2);
    player_close(&player);
    return context;
}

static void test_threads_share_allocator(void **state) {
    (void)state;
    pthread_t threads[4];
    use_host();
    for (size_t i = 0; i < COUNT_OF(threads); i++)
        assert_int_equal(pthread_create(&threads[i], NULL, run_in_thread, NULL), 0);
    for (size_t i = 0; i < COUNT_OF(threads); i++)
        pthread_join(threads[i], NULL);
    assert_true(host.asked > 100);
    check_all_released("four threads");
}

static int set_up(void **state) {
    static Folder folder;
    folder_open(&folder);
    folder_write(&folder, "module.fl", MODULE);
    folder_write(&folder, "s.fl", SCRIPT);
    *state = &folder;
    return 0;
}

static int tear_down(void **state) {
    folder_close(*state);
    return 0;
}

// Restores the default allocator after each test.
static int restore_heap(void **state) {
    (void)state;
    return petri_set_allocator(NULL) == PETRI_OK ? 0 : -1;
}

TEST_GROUP(session_allocator) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_everything_is_released, restore_heap),
        cmocka_unit_test_teardown(test_failing_allocation_leaks_nothing, restore_heap),
        cmocka_unit_test_teardown(test_allocator_in_use_is_not_replaced, restore_heap),
        cmocka_unit_test_teardown(test_drawing_counts_towards_memory_limit, restore_heap),
        cmocka_unit_test_teardown(test_threads_share_allocator, restore_heap),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
