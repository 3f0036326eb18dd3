// new.c: `petri test --new`, which creates the golden of a script, or an .err file if the script has an error.
#include "base/file.h"
#include "base/source.h"
#include "cli/output.h"
#include "cli/script.h"
#include "cli/words.h"
#include "golden/suite.h"
#include "render/options.h"
#include "run/options.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The run whose output becomes the golden.
typedef struct NewGolden {
    const CommandContext *host;
    const char *script;
    TextList words;   // as given, without --new
    TextList options; // of the run
    bool renders;     // true if the golden contains pictures
    RunOutput run;
} NewGolden;

// Parses the options of `petri render`, whose command is in another program.
static const Command RENDER_WORDS = {
    .name = "render", .operands = "SCRIPT", .options = &RENDER_OPTIONS, .missing_operand = "no script given"};

static bool fail(const char *what, const char *path, const char *problem) {
    message("cannot %s %s: %s", what, path, problem);
    return false;
}

static const char *script_name(const NewGolden *new) {
    return new->script + path_directory(str_from(new->script)).len;
}

// Runs the script with the options. Returns false after a message.
static bool run_script(NewGolden *new) {
    SCOPED_STRING folder = memory_folder(new->script);
    TextList words = {0};
    texts_add(&words, "petri");
    texts_add(&words, "run");
    for (size_t i = 0; i < new->options.count; i++)
        texts_add(&words, new->options.items[i]);
    texts_add(&words, "--");
    texts_add(&words, script_name(new));
    text_free(&new->run.output);
    text_free(&new->run.errors);
    new->run.status = subprocess_run(new->host->program, folder, words.items, SUBPROCESS_MAX_SECONDS, &new->run.output,
                                     &new->run.errors);
    texts_free(&words);
    return new->run.status >= 0 || fail("run", new->script, strerror(errno));
}

static void add_option(NewGolden *new, const char *name, const char *value) {
    texts_add(&new->options, name);
    texts_add(&new->options, value);
}

static bool is_complete(const NewGolden *new) {
    return run_is_complete(new->run.status, &new->run.errors);
}

static bool write_file(const char *script, const char *suffix, const Text *text) {
    SCOPED_STRING path = kind_path(script, suffix);
    SCOPED_TEXT done = {0};
    const char *problem = file_replace(path, text_str(text), 0);
    text_add_format(&done, "created %s\n", path);
    return problem ? fail("write", path, problem) : output_text(done.bytes, done.len, STATUS_DONE) == STATUS_DONE;
}

// Records the errors of a script that cannot be run.
static bool write_rejection(NewGolden *new) {
    texts_free(&new->options);
    add_option(new, "--threads", "1");
    add_option(new, "--frames", "1");
    if (!run_script(new))
        return false;
    SCOPED_TEXT text = is_complete(new) ? (Text){0} : rejection_text(script_name(new), &new->run.errors);
    if (text.len > 0)
        return write_file(new->script, ".err", &text);
    SCOPED_TEXT problem = {0};
    subprocess_describe(new->run.status, &new->run.errors, &problem);
    message("no golden is created: the run %s", problem.bytes);
    return false;
}

static bool write_golden(const NewGolden *new) {
    SCOPED_TEXT text = {0};
    text_add_c(&text, new->renders ? "# render" : "# run");
    for (size_t i = 0; i < new->options.count; i++) {
        text_add_c(&text, " ");
        shell_add_word(&text, new->options.items[i]);
    }
    text_add_c(&text, "\n");
    if (new->run.output.len > 0)
        text_add(&text, text_str(&new->run.output));
    return write_file(new->script, ".golden", &text);
}

// Runs the script and writes its golden. By default, a golden contains the state of every 20th of 61 frames, or the
// tree if the script has no state.
static bool create(NewGolden *new, const Options *run) {
    char *const *words = new->words.items;
    bool limited = words_have_option(words, "frames") || words_have_option(words, "runtime");
    bool prints = run_options(run)->sections != 0;
    if (!limited)
        add_option(new, "--frames", "61");
    if (!limited && !words_have_option(words, "every"))
        add_option(new, "--every", "20");
    if (!prints)
        add_option(new, "--print", "state,log");
    if (!run_script(new))
        return false;
    if (!prints && is_complete(new) && !strstr(new->run.output.bytes, "\n$")) {
        char **last = &new->options.items[new->options.count - 1];
        free(*last);
        *last = memory_strdup("tree,log");
        if (!run_script(new))
            return false;
    }
    if (!is_complete(new))
        return write_rejection(new);
    SCOPED_TEXT problem = {0};
    if (run_has_diverged(&new->run.errors, &problem)) {
        message("no golden is created: %s", problem.bytes);
        return false;
    }
    return write_golden(new);
}

// Writes a golden without pictures, and then records them like `petri test --update`.
static bool create_pictures(NewGolden *new, Options *options) {
    SCOPED_STRING golden = kind_path(new->script, ".golden");
    TestCase test = {.kind = kind_of_file(golden), .script = memory_strdup(new->script), .recorded = golden};
    test.name = test.script + path_directory(str_from(test.script)).len;
    TestOptions own = {.update = true};
    options->own = &own;
    bool created = write_golden(new);
    if (created) {
        execute_again(new->host, options, &test);
        created = test.result.passed;
        if (!created) {
            message("no golden is created: the run %s", test.result.error_text.bytes);
            unlink(golden);
        }
    }
    options->own = NULL;
    test.recorded = NULL;
    test_free(&test);
    return created;
}

// Splits the arguments into the script and the options of the run, which are checked.
static int read_words(NewGolden *new, const Options *given, Options *run) {
    for (int i = 0; i < given->argc; i++)
        if (!word_is_option(given->argv[i], "new") && !word_is_option(given->argv[i], "render"))
            texts_add(&new->words, given->argv[i]);
    if (new->words.count == 0) {
        message("no script given; usage: petri %s %s", TEST_NEW_COMMAND.name, TEST_NEW_COMMAND.operands);
        return STATUS_USAGE;
    }
    new->renders = words_have_option(given->argv, "render");
    int status = options_parse(run, new->renders ? &RENDER_WORDS : &RUN_COMMAND, new->host, (int)new->words.count,
                               new->words.items);
    if (status == OPTIONS_READ && (script_is_stdin(run->script) || run->replayed)) {
        message("cannot create a golden for %s; give a script", run->script);
        status = STATUS_USAGE;
    }
    new->script = run->script;
    for (size_t i = 0; i < new->words.count &&status == OPTIONS_READ; i++)
        if (new->words.items[i] != run->script && strcmp(new->words.items[i], "--") != 0)
            texts_add(&new->options, new->words.items[i]);
    return status;
}

// Checks that the script has no test yet, and that a golden may contain the options.
static bool is_possible(const NewGolden *new) {
    SCOPED_TEXT problem = {0};
    if (!golden_check_options(new->renders ? RENDER_OPTIONS.rows : RUN_OPTIONS.rows, &new->options, &problem)) {
        message("no golden is created: %s", problem.bytes);
        return false;
    }
    for (int i = 0; i < 2; i++) {
        SCOPED_STRING path = kind_path(new->script, i == 0 ? ".golden" : ".err");
        if (!file_exists(path))
            continue;
        message("%s already exists; to record the current output, run: petri test --update %s", path, new->script);
        return false;
    }
    return true;
}

static int new_run(const CommandContext *host, Options *given) {
    NewGolden new = {.host = host};
    Options run = {0};
    if (words_have_option(given->argv, "help"))
        return help_for(&TEST_NEW_COMMAND);
    int status = read_words(&new, given, &run);
    if (status == OPTIONS_READ)
        status = is_possible(&new) && (new.renders ? create_pictures(&new, given) : create(&new, &run)) ? STATUS_DONE
                                                                                                        : STATUS_FAILED;
    options_free(&run);
    texts_free(&new.words);
    texts_free(&new.options);
    text_free(&new.run.output);
    text_free(&new.run.errors);
    return status;
}

const Command TEST_NEW_COMMAND = {
    .name = "test --new",
    .operands = "SCRIPT [OPTION...]",
    .summary = "create the golden of a script",
    .details =
        "Runs the script with these options of 'petri run' and writes NAME.golden, which 'petri test' compares\n"
        "with later runs. The default is the state of every 20th of 61 frames. If the script has an error,\n"
        "NAME.err is written instead, with the line of the error and the messages. With --render, the options are\n"
        "those of 'petri render', and the golden contains pictures, NAME.0000.png and so on.",
    .examples = "  petri test --new dish.fl\n"
                "  petri test --new dish.fl --frames 300 --print hash -D N=5\n"
                "  petri test --new dish.fl --render --frames 3 --size 200x150\n",
    .parses_arguments = true,
    .run = new_run,
};
