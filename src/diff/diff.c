// diff.c: `petri diff`, which finds the first frame in which two runs differ, and why.
#include "diff/diff.h"

#include "cli/json.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/script.h"
#include "cli/words.h"
#include "golden/golden.h"
#include "petri-inspect.h"
#include "run/options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    bool against;     // options of the second run follow
    const char *with; // program of the second run; NULL: this one
    bool json;
} Own;

enum { STATUS_SAME = 0, STATUS_DIFFERS = 1, STATUS_TROUBLE = 2 };

typedef struct Diff {
    const CommandContext *host;
    Options *options;      // of the whole command line
    Options first_options; // of the first run: those before --against
    Options golden;        // options of a golden's run
    Golden recorded;       // the golden whose options are in `golden`
    TextList definitions;  // of the first run, while `options` has those of the second
    char *script;          // script beside a golden; NULL: none
    Side sides[2];
    TextList reported;
    bool json;
} Diff;

// --- operands

// Returns the path of the script beside a golden. The caller frees it.
static char *script_of_golden(const char *golden) {
    Text path = {0};
    text_add_format(&path, "%.*s.fl", (int)(strlen(golden) - strlen(".golden")), golden);
    return path.bytes;
}

// Adds the options of a golden's run to those of a script that is compared with it.
static bool apply_golden(Diff *diff, const char *golden, Side *script) {
    SCOPED_TEXT problem = {0};
    if (!golden_read(&diff->recorded, golden, &problem)) {
        message("cannot use the golden '%s': %s", golden, problem.bytes);
        return false;
    }
    TextList *words = &diff->recorded.options;
    texts_add(words, script->source);
    if (options_parse(&diff->golden, &RUN_COMMAND, diff->host, (int)words->count, words->items) != OPTIONS_READ)
        return false;
    if (!(run_options(&diff->golden)->sections & PETRI_PRINT_STATE)) {
        message("%s has no state to compare: its first line needs '--print state'", golden);
        return false;
    }
    for (size_t i = 0; i < script->options->definitions.count; i++)
        texts_add(&diff->golden.definitions, script->options->definitions.items[i]);
    if (script->options->threads > 0)
        diff->golden.threads = script->options->threads;
    diff->golden.verbosity = script->options->verbosity;
    diff->golden.keep_forces = true;
    script->options = &diff->golden;
    script->frames = diff->golden.frames < script->frames ? diff->golden.frames : script->frames;
    return true;
}

static void set_label(Side *side, bool settings) {
    text_add_c(&side->label, script_display_name(side->source));
    for (size_t i = 0; settings && i < side->options->definitions.count; i++)
        text_add_format(&side->label, " -D %s", side->options->definitions.items[i]);
    if (side->with)
        text_add_format(&side->label, " with %s", side->with);
}

// Sets the sources and options of both sides. Returns false after a message.
static bool read_sides(Diff *diff, const CommandContext *host) {
    Options *options = diff->options;
    const Own *own = options->own;
    Side *sides = diff->sides;
    if (!options->second && !own->against && !own->with && !side_is_golden(options->script)) {
        message("nothing to compare with %s: give a second run, --against or --with", options->script);
        return false;
    }
    if (!options->second && side_is_golden(options->script))
        diff->script = script_of_golden(options->script);
    sides[0].source = options->script;
    sides[1].source = options->second ? options->second : diff->script ? diff->script : options->script;
    sides[0].options = own->against ? &diff->first_options : options;
    sides[1].options = options;
    sides[1].with = own->with;
    for (int i = 0; i < 2; i++) {
        sides[i].host = host;
        sides[i].frames = options->frames;
        sides[i].reported = &diff->reported;
    }
    for (int i = 0; i < 2; i++)
        if (side_is_golden(sides[i].source) && !side_is_golden(sides[1 - i].source) &&
            !apply_golden(diff, sides[i].source, &sides[1 - i]))
            return false;
    bool same = strcmp(sides[0].source, sides[1].source) == 0;
    for (int i = 0; i < 2; i++)
        set_label(&sides[i], same && !side_is_golden(sides[i].source));
    return true;
}

// --- comparison

// Returns true if both states have the same digest. If a digest cannot be computed, the printed states are compared.
static bool same_digest(PetriSession *a, PetriSession *b) {
    enum { DIGEST_SIZE = 16 };
    uint8_t digests[2][DIGEST_SIZE];
    return petri_digest(a, digests[0]) == PETRI_OK && petri_digest(b, digests[1]) == PETRI_OK &&
           memcmp(digests[0], digests[1], DIGEST_SIZE) == 0;
}

// Compares the current frames. Returns true if they are the same. Otherwise prints the report.
static bool compare_frame(Diff *diff, Output *output) {
    Side *sides = diff->sides;
    if (sides[0].session && sides[1].session && same_digest(sides[0].session, sides[1].session))
        return true;
    SCOPED_TEXT first = {0};
    SCOPED_TEXT second = {0};
    SCOPED_TEXT report = {0};
    sides[0].kind->print(&sides[0], &first);
    sides[1].kind->print(&sides[1], &second);
    StateText a = state_text_read(text_str(&first)), b = state_text_read(text_str(&second));
    StateDifferences differences = state_text_compare(&a, &b);
    bool same = differences.count == 0;
    if (!same) {
        ForceDifference force;
        forces_compare(sides, &differences, &force);
        (diff->json ? report_json : report_text)(&(DiffReport){sides, &differences, &force}, &report);
        output_write(output, report.bytes, report.len);
        forces_free(&force);
    }
    state_differences_free(&differences);
    state_text_free(&a);
    state_text_free(&b);
    return same;
}

// Goes to the next frame that both sides have. Returns false if there is none.
static bool next_common_frame(Side *sides) {
    bool more = sides[0].kind->next(&sides[0]) && sides[1].kind->next(&sides[1]);
    while (more && sides[0].frame != sides[1].frame) {
        Side *behind = sides[0].frame < sides[1].frame ? &sides[0] : &sides[1];
        more = behind->kind->next(behind);
    }
    return more;
}

static int compare_runs(Diff *diff, Output *output) {
    Side *sides = diff->sides;
    int64_t compared = 0;
    for (; next_common_frame(sides); compared++)
        if (!compare_frame(diff, output))
            return STATUS_DIFFERS;
    if (sides[0].failed || sides[1].failed)
        return STATUS_TROUBLE;
    if (compared == 0) {
        message("nothing to compare: no frame is in both %s and %s", sides[0].label.bytes, sides[1].label.bytes);
        return STATUS_TROUBLE;
    }
    if (diff->json) {
        SCOPED_TEXT report = {0};
        JsonWriter json = {.out = &report};
        json_open(&json, NULL, "{");
        json_put_bool(&json, "same", true);
        json_put_integer(&json, "frames", compared);
        json_close(&json, "}\n");
        output_write(output, report.bytes, report.len);
    }
    return STATUS_SAME;
}

// --- the command

// Returns the number of arguments before --against.
static int arguments_before(const Options *options) {
    int count = 0;
    while (count < options->argc && strcmp(options->argv[count], "--against") != 0)
        count++;
    return count;
}

// Reads the options of the first run. After --against, -D sets parameters of the second run only.
static bool read_first_options(Diff *diff) {
    Options *options = diff->options;
    if (!((const Own *)options->own)->against)
        return true;
    if (options_parse(&diff->first_options, &DIFF_COMMAND, diff->host, arguments_before(options), options->argv) !=
        OPTIONS_READ)
        return false;
    diff->first_options.keep_forces = true;
    for (size_t i = diff->first_options.definitions.count; i < options->definitions.count; i++)
        texts_add(&diff->definitions, options->definitions.items[i]);
    TextList all = options->definitions;
    options->definitions = diff->definitions;
    diff->definitions = all;
    return true;
}

static int diff_runs(Diff *diff, const CommandContext *host, Output *output) {
    if (!read_first_options(diff) || !read_sides(diff, host) || !side_open(&diff->sides[0]) ||
        !side_open(&diff->sides[1]))
        return STATUS_TROUBLE;
    return compare_runs(diff, output);
}

static int diff_run(const CommandContext *host, Options *options) {
    Diff diff = {.host = host, .options = options, .json = ((const Own *)options->own)->json};
    Output output;
    output_start(&output, STDOUT_FILENO);
    options->keep_forces = true;
    int status = diff_runs(&diff, host, &output);
    for (int i = 0; i < 2; i++)
        side_close(&diff.sides[i]);
    options_free(&diff.first_options);
    options_free(&diff.golden);
    golden_free(&diff.recorded);
    texts_free(&diff.definitions);
    free(diff.script);
    texts_free(&diff.reported);
    return output_finish(&output, status);
}

// clang-format off
static const OptionSpec ROWS[] = {
    SHARED("frames", 0, "N", WHOLE(0, INT64_MAX), frames, "compare N frames (default: 600)")
    OWN("against", 0, NULL, option_flag, against, "begin the operand and options of the second run")
    OWN("with", 0, "PROGRAM", option_text, with, "compute the second run with PROGRAM, another build of petri")
    OWN("json", 0, NULL, option_flag, json, "print the result as JSON")
    FPS_OPTION DEFINE_OPTION READ_OPTIONS THREADS_OPTION LIMIT_OPTIONS METHOD_OPTIONS NO_BATCHES_OPTION QUIET_OPTION
    COLOUR_OPTION NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable DIFF_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command DIFF_COMMAND = {
    .name = "diff",
    .operands = "A [B]",
    .summary = "find where two runs differ, and why",
    .details =
        "Compares two runs frame by frame, to the last bit. Prints the first frame that differs: the first value of\n"
        "its state that differs, and for a particle the first force whose contribution differs, with its position in\n"
        "the script. A and B are scripts, archives, goldens or state files, or REVISION:SCRIPT for a script in git; a\n"
        "golden is compared with its script if B is not given. Exits with 0 if the runs are the same, 1 if they\n"
        "differ, and 2 after an error.\n"
        "\n"
        "Options apply to both runs, those after --against only to the second one. If there is an --against, -D\n"
        "before it sets parameters of the first run only.",
    .examples = "  petri diff old.fl new.fl --frames 1000          compare two scripts\n"
                "  petri diff dish.fl -D N=10 --against -D N=11    compare two values of a parameter\n"
                "  petri diff run.petri dish.fl                    compare an archive with the script as it is now\n"
                "  petri diff HEAD:dish.fl dish.fl                 compare a script with the one in git\n"
                "  petri diff dish.golden                          compare a golden with its script\n"
                "  petri diff dish.fl --with ./old/petri           compare two builds of petri\n",
    .missing_operand = "no script given",
    .no_stdin = "cannot read a run from standard input; give files",
    .second_operand_error = "too many arguments: '%s'; petri diff compares two runs",
    .options = &DIFF_OPTIONS,
    .needs_pictures = words_name_archive,
    .accepts_two = true,
    .run = diff_run,
};
