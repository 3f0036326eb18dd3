// test_src_options.c: tests of the command line, from words to values: src/cli/args.c and src/cli/options.c.
#include "captured.h"
#include "cli/options.h"
#include "petri-inspect.h"
#include "render/options.h"
#include "run/options.h"
#include "sweep/options.h"
#include "view/options.h"

#include <math.h>

static Captured captured;
static Options given; // options that the command received
static RunOptions run_given;
static RenderOptions render_given;
static int runs;

static int store_options(const CommandContext *context, Options *options) {
    (void)context;
    given = *options;
    if (options->table == &RUN_OPTIONS)
        run_given = *run_options(options);
    if (options->table == &RENDER_OPTIONS)
        render_given = *render_options(options);
    runs++;
    return 42;
}

static const Command PLAIN = {.name = "run",
                              .options = &RUN_OPTIONS,
                              .operands = "SCRIPT.fl",
                              .run = store_options,
                              .missing_operand = "no script given"};
static const Command PICTURE = {
    .name = "render", .options = &RENDER_OPTIONS, .operands = "SCRIPT.fl", .run = store_options};

// Runs the command with words that end with NULL. Returns the messages.
static const char *run_words(const Command *command, int status, const char *const words[]) {
    static const SimilarCommand similar[] = {
        {"run", &RUN_OPTIONS}, {"render", &RENDER_OPTIONS}, {"view", &VIEW_OPTIONS}, {.name = NULL}};
    const CommandContext host = {.similar = similar};
    int count = 0;
    runs = 0;
    while (words[count])
        count++;
    captured_begin(&captured, STDERR_FILENO);
    int got = command_run(command, &host, count, (char **)words);
    captured_end(&captured);
    assert_int_equal(got, status);
    assert_int_equal(runs, status == 42);
    return captured.text;
}

#define RUN(...) assert_string_equal(run_words(&PLAIN, 42, (const char *const[]){__VA_ARGS__, NULL}), "")
#define RENDER(...) assert_string_equal(run_words(&PICTURE, 42, (const char *const[]){__VA_ARGS__, NULL}), "")
#define REJECT(text, ...) REJECT_OF(&PLAIN, text, __VA_ARGS__)
#define REJECT_OF(command, text, ...)                                                                                  \
    assert_string_equal(run_words(command, STATUS_USAGE, (const char *const[]){__VA_ARGS__, NULL}), "petri: " text "\n")

static void test_values_can_be_attached(void **state) {
    (void)state;
    RUN("a.fl", "--frames", "7");
    assert_int_equal(given.frames, 7);
    assert_string_equal(given.script, "a.fl");
    RUN("--frames=8", "a.fl");
    assert_int_equal(given.frames, 8);
    RENDER("-oout.png", "a.fl");
    assert_string_equal(render_given.output, "out.png");
    RENDER("-o", "-", "a.fl");
    assert_string_equal(render_given.output, "-");
    RUN("--", "--frames");
    assert_string_equal(given.script, "--frames");
    RUN("-"); // standard input
    assert_string_equal(given.script, "-");
}

static void test_omitted_options_have_their_defaults(void **state) {
    (void)state;
    RUN("a.fl");
    assert_int_equal(given.frames, 600);
    assert_true(isnan(given.run_time));
    assert_int_equal(run_given.every, 1);
    assert_int_equal(given.verbosity, LOG_NORMAL);
    assert_false(given.fps_given);
    RUN("a.fl", "--runtime", "1:30");
    assert_true(given.frames == INT64_MAX);
    assert_true(given.run_time == 90);
}

static void test_each_kind_of_value_is_read(void **state) {
    (void)state;
    RUN("a.fl", "--memory=1.5k", "--work", "2G");
    assert_true(given.memory == 1536);
    assert_true(given.work == (uint64_t)2 << 30);
    RENDER("a.fl", "--size", "640X480", "--scale=0.5", "--fps", "24");
    assert_int_equal(render_given.size.width, 640);
    assert_int_equal(render_given.size.height, 480);
    assert_true(render_given.scale == 0.5 && given.fps == 24 && given.fps_given);
    RUN("a.fl", "--print", "hash,tree", "--neighbours=always", "--trace", "--realtime");
    assert_int_equal(run_given.sections, PETRI_PRINT_HASH | PETRI_PRINT_TREE);
    assert_int_equal(given.neighbours, PETRI_NEIGHBOURS_ALWAYS);
    assert_int_equal(given.verbosity, LOG_TRACE);
    assert_true(given.realtime);
    RUN("a.fl", "--realtime", "--lockstep", "--color=never");
    assert_false(given.realtime);
    assert_true(given.monochrome);
    assert_false(given.colour);
    RUN("a.fl", "--color=always");
    assert_true(given.colour);
    assert_false(given.monochrome);
}

static void test_invalid_values_are_reported(void **state) {
    (void)state;
    REJECT("option '--frames' expects an integer >= 0, not '-1'", "a.fl", "--frames", "-1");
    REJECT("option '--frames' expects an integer >= 0, not '1x'", "--frames=1x");
    REJECT("option '--frames' expects an integer >= 0, not ''", "--frames=");
    REJECT("option '--frames' expects an integer >= 0, not '99999999999999999999'", "--frames=99999999999999999999");
    REJECT("option '--threads' expects an integer from 1 to 1024, not '0'", "--threads=0");
    REJECT("option '--fps' expects a positive number, not '0'", "--fps=0");
    REJECT("option '--fps' expects a positive number, not 'inf'", "--fps=inf");
    REJECT("option '--memory' expects a number >= 1, such as 500M or 2G, not '2X'", "--memory=2X");
    REJECT("option '--memory' expects a number >= 1, such as 500M or 2G, not '1e30'", "--memory=1e30");
    REJECT("option '--runtime' expects seconds or a time code such as 1:30, not '-1'", "--runtime=-1");
    REJECT_OF(&PICTURE, "option '--size' expects WIDTHxHEIGHT, each from 1 to 16384, not '10x'", "--size=10x");
    REJECT_OF(&PICTURE, "option '--size' expects WIDTHxHEIGHT, each from 1 to 16384, not '20000x10'",
              "--size=20000x10");
    REJECT("option '--print' expects one or more of tree, state, log, error, hash and digest, separated by commas, not "
           "'tree,'",
           "--print=tree,");
    REJECT("option '--neighbours' expects one of auto, never, always, not 'some'", "--neighbours=some");
    REJECT("option '--trajectory' expects a file name that ends in .xyz, .csv or .h5, not 'a.txt'",
           "--trajectory=a.txt");
    REJECT("option '--define' expects NAME=VALUE, not '=3'", "-D=3");
    REJECT("option '--allow-read' expects an existing folder, not '/no such'", "--allow-read=/no such");
}

static void test_mistakes_are_reported(void **state) {
    (void)state;
    REJECT("option '--quiet' takes no value", "--quiet=1");
    REJECT("option '--frames' needs a value; '--frames N' means: stop after N frames (default: 600 without --runtime)",
           "a.fl", "--frames");
    REJECT("unknown option '--frame-count'; see 'petri help run'", "--frame-count");
    REJECT("unknown option '--colour'; did you mean '--color'?", "--colour");
    REJECT("unknown option '-v'; did you mean '--version'?", "-v");
    REJECT("'petri run' has no option '--listen', but 'petri view' has; see 'petri help run'", "--listen", "x");
    REJECT("'petri run' has no option '--size', but 'petri render' has; see 'petri help run'", "--size", "1x1");
    REJECT("'petri run' has no option '-o', but 'petri render' has; see 'petri help run'", "-o", "x");
    REJECT_OF(&PICTURE, "'petri render' has no option '--trajectory', but 'petri run' has; see 'petri help render'",
              "--trajectory", "x");
    REJECT("no script given; usage: petri run [options] SCRIPT.fl", "--quiet");
    REJECT("the script name is empty", "");
}

static void test_operands_of_other_commands(void **state) {
    (void)state;
    Command command = PLAIN;
    command.no_stdin = "not from standard input";
    assert_string_equal(run_words(&command, STATUS_USAGE, (const char *const[]){"-", NULL}),
                        "petri: not from standard input\n");
    command = PLAIN;
    command.second_operand_error = "one is enough: '%s'";
    assert_string_equal(run_words(&command, STATUS_USAGE, (const char *const[]){"a", "b", NULL}),
                        "petri: one is enough: 'b'\n");
    command = PLAIN;
    command.parses_arguments = true;
    assert_string_equal(run_words(&command, 42, (const char *const[]){"--frames=x", NULL}), "");
    assert_int_equal(given.argc, 1);
    command = PLAIN;
    command.live = true;
    assert_string_equal(run_words(&command, 42, (const char *const[]){"a", NULL}), "");
    assert_true(given.realtime && given.frames == INT64_MAX);
}

static void test_options_stay_in_their_struct(void **state) {
    (void)state;
    static const OptionTable *const tables[] = {&RUN_OPTIONS, &RENDER_OPTIONS, &VIEW_OPTIONS, &SWEEP_OPTIONS};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        for (const OptionSpec *spec = tables[i]->rows; spec->name; spec++) {
            assert_true(spec->field < (spec->own ? tables[i]->own_size : sizeof(Options)));
            for (const OptionSpec *other = tables[i]->rows; other != spec; other++)
                if (strcmp(other->name, spec->name) == 0)
                    fail_msg("option --%s is listed twice", spec->name);
        }
    }
}

static void test_lists_of_a_command_are_freed(void **state) {
    (void)state;
    Command command = {.name = "sweep", .options = &SWEEP_OPTIONS, .run = store_options};
    assert_string_equal(
        run_words(&command, 42,
                  (const char *const[]){"-DA=1", "-D", "B=2", "--metric=energy", "--metric", "n=1", NULL}),
        "");
    Options options;
    assert_int_equal(options_parse(&options, &command, &(const CommandContext){0}, 3,
                                   (char *[]){(char *)"-DA=1", (char *)"-D", (char *)"B=2", NULL}),
                     OPTIONS_READ);
    assert_int_equal(sweep_options(&options)->axes.count, 2);
    assert_int_equal(options.definitions.count, 0);
    options_free(&options);
}

static void test_due_frames(void **state) {
    (void)state;
    Options options = {.frames = 10, .run_time = NAN};
    assert_true(options_due(&options, 9, 0, 60));
    assert_false(options_due(&options, 10, 0, 60));
    options = (Options){.frames = INT64_MAX, .run_time = 0.5};
    assert_true(options_due(&options, 29, 0, 60));
    assert_false(options_due(&options, 30, 0, 60));
}

TEST_GROUP(src_options) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_can_be_attached),
        cmocka_unit_test(test_omitted_options_have_their_defaults),
        cmocka_unit_test(test_each_kind_of_value_is_read),
        cmocka_unit_test(test_invalid_values_are_reported),
        cmocka_unit_test(test_mistakes_are_reported),
        cmocka_unit_test(test_operands_of_other_commands),
        cmocka_unit_test(test_options_stay_in_their_struct),
        cmocka_unit_test(test_lists_of_a_command_are_freed),
        cmocka_unit_test(test_due_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
