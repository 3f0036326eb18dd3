// repl.c: `petri repl`, which runs a script frame by frame at a prompt.
#include "repl/repl.h"

#include "cli/option_groups.h"
#include "cli/options.h"
#include "cli/parameters.h"
#include "cli/script.h"
#include "repl/line.h"

#include <errno.h>
#include <inttypes.h>
#include <langinfo.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    int64_t limit; // maximum frames of .run and .until
} Own;

// Writes to the output; a PetriWriteCallback.
static bool repl_write(void *host, const char *text, size_t length) {
    Repl *repl = host;
    return output_write(&repl->output, text, length);
}

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Repl *repl = host;
    if (diagnostic->code && strcmp(diagnostic->code, "unread-definition") == 0)
        return; // not shown, because an expression that is typed later can still read the definition
    repl->invalid_definition = repl->invalid_definition || is_invalid_definition(diagnostic);
    if (diagnostic->code && strcmp(diagnostic->code, "memory-limit") == 0)
        repl->failed = repl->any_failed = true;
    output_flush(&repl->output);
    fputs(diagnostic->rendered, stderr);
}

static void execute_statement(Repl *repl, const char *text, size_t length) {
    PetriPromptResult done;
    repl_busy(repl);
    PetriStatus status = petri_prompt(repl->session, text, length, repl_write, repl, &done, sizeof done);
    repl_idle(repl);
    if (done.shadowed) {
        SCOPED_STRING name = memory_strdup(done.shadowed);
        repl_warn_shadowed(repl, name);
    }
    if (done.nodes > 0)
        repl_note(repl, "nodes are added to the scene at the next step; .drop removes them");
    repl_status(repl, status);
}

// If the text begins with a dot and is not a number such as .5, executes it as a command. Otherwise tries to execute it
// as a command without its dot (bare_execute), and then as code.
static void execute_text(Repl *repl, const char *text, size_t length) {
    SCOPED_TEXT remark = {0};
    size_t start = strspn(text, " \t");
    if (text[start] == '.' && (text[start + 1] < '0' || text[start + 1] > '9') && text[start + 1] != '.')
        repl_command(repl, text + start);
    else if (!bare_execute(repl, text, &remark))
        execute_statement(repl, text, length);
    if (remark.len > 0 && (repl->failed || bare_alias(text + start, strcspn(text + start, " \t\n"))))
        repl_note(repl, "%s", remark.bytes);
}

// Executes one input, which must not be blank: a command, or a statement or expression of the language.
static void repl_execute(Repl *repl, const char *text, size_t length) {
    repl->failed = false;
    execute_text(repl, text, length);
    repl->any_failed = repl->any_failed || repl->failed;
}

static void make_prompt(const Repl *repl, char *prompt, size_t size) {
    int64_t frame = petri_frame_number(repl->session);
    if (frame < 0)
        snprintf(prompt, size, "petri> ");
    else
        snprintf(prompt, size, "@%" PRId64 "> ", frame);
}

// Reads the remaining lines of the statement in `text`. If a line starts the next statement, appends it to `next`.
static LineStatus read_rest(Repl *repl, LineReader *reader, Text *text, Text *next) {
    size_t consumed = 0;
    while (line_needs_more(repl, text->bytes, text->len, &consumed)) {
        SCOPED_TEXT line = {0};
        LineStatus status = line_read(reader, "... ", &line);
        text_add(text, text_str(&line));
        if (status != LINE_READ)
            return status;
        text_add_c(text, "\n");
    }
    if (!line_is_blank(text->bytes + consumed))
        text_add(next, (Str){text->bytes + consumed, text->len - consumed - 1});
    text->bytes[text->len = consumed] = '\0';
    return LINE_READ;
}

// Reads the rest of an input whose first line is in `text`, and executes the input.
static LineStatus execute_input(Repl *repl, LineReader *reader, Text *text, Text *next) {
    text_add_c(text, "\n");
    LineStatus status = read_rest(repl, reader, text, next);
    if (status != LINE_INTERRUPTED) // at the end of the input, an incomplete statement is executed as it is
        repl_execute(repl, text->bytes, text->len);
    return status;
}

static void run_prompt(Repl *repl) {
    LineReader *reader = line_reader_new(repl);
    Text next = {0};
    LineStatus status = LINE_READ;
    while (status != LINE_END && !repl->quit && repl->output.error == 0) {
        char prompt[40];
        Text text = next;
        next = (Text){0};
        make_prompt(repl, prompt, sizeof prompt);
        repl_report_changes(repl, false);
        status = text.len > 0 ? LINE_READ : line_read(reader, prompt, &text);
        if (status == LINE_READ && !line_is_blank(text.bytes))
            status = execute_input(repl, reader, &text, &next);
        text_free(&text);
        output_flush(&repl->output);
        if (status == LINE_INTERRUPTED && !repl->terminal) {
            repl->any_failed = true;
            break;
        }
        repl_clear_interrupt();
    }
    text_free(&next);
    line_reader_free(reader);
}

static bool read_state(Repl *repl, const char *file) {
    if (!file)
        return true;
    if (access(file, F_OK) != 0)
        return repl_fail(repl, "cannot read '%s': %s", file, strerror(errno));
    return repl_status(repl, petri_restore(repl->session, file));
}

// Loads the script and the state. If the script has errors, the prompt starts nevertheless: the script is reloaded when
// it changes.
static void start_session(Repl *repl, const char *state) {
    petri_load_text(repl->session, "prompt", "", 0);
    if (repl->options->replayed)
        repl_replay(repl);
    else if (repl->script)
        repl_load(repl, repl->script);
    if (!read_state(repl, state))
        repl->failed = true;
    repl->history = petri_history_new(repl->session, 0);
    if (!repl->history)
        repl_status(repl, PETRI_OUT_OF_MEMORY);
    repl->any_failed = repl->failed;
}

static int run_session(Repl *repl, const char *state) {
    // Use only the character encoding of the locale, because its number format would break the parsing of scripts.
    setlocale(LC_CTYPE, "");
    repl->utf8 = strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    repl->terminal = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO);
    repl->files = file_watch_new();
    repl_catch_interrupt();
    start_session(repl, state);
    if (repl->invalid_definition)
        return STATUS_USAGE;
    if (repl->terminal)
        repl_note(repl, "petri %s; .help lists the commands, Ctrl-D quits", petri_version());
    run_prompt(repl);
    return repl->any_failed && !repl->terminal ? STATUS_FAILED : STATUS_DONE;
}

static int repl_run(const CommandContext *host, Options *options) {
    const Own *own = options->own;
    Repl repl = {.options = options, .limit = own->limit, .output.fd = STDOUT_FILENO};
    repl.script = !options->script || options->replayed ? NULL : memory_strdup(options->script);
    for (size_t i = 0; i < options->definitions.count; i++)
        texts_add(&repl.definitions, options->definitions.items[i]);
    options->prompt = true;
    int status = options_open(options, host, on_diagnostic, &repl, &repl.session);
    if (status == OPTIONS_READ)
        status = output_finish(&repl.output, run_session(&repl, options->state_file));
    if (!archiving_end(&repl.archiving) && status == STATUS_DONE)
        status = STATUS_FAILED;
    petri_history_free(repl.history);
    petri_close(&repl.session);
    file_watch_free(repl.files);
    texts_free(&repl.watched);
    texts_free(&repl.definitions);
    free(repl.script);
    text_free(&repl.script_text);
    return status;
}

// clang-format off
static const OptionSpec ROWS[] = {
    FPS_OPTION DEFINE_OPTION
    SHARED("state", 0, "FILE", option_text, state_file, "start with the state in FILE")
    FILE_OPTIONS
    OWN("limit", 0, "N", WHOLE(1, INT64_MAX), limit, "limit .run and .until to N frames (default: 100000)")
    THREADS_OPTION LIMIT_OPTIONS NOSIMPLIFY_OPTION FROM_OPTION
    SHARED("color", 0, "WHEN", ONE_OF(option_colour, "auto", "always", "never"), colour, "use colours in prompts and messages: auto, always or never")
    NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable REPL_OPTIONS = {ROWS, sizeof(Own), &(const Own){.limit = 100000}};

const Command REPL_COMMAND = {
    .name = "repl",
    .operands = "[SCRIPT.fl]",
    .summary = "step through a script interactively",
    .details =
        "Reads code and commands. Prints the values of expressions; keeps let, func, import and nodes. Commands begin\n"
        "with a dot: .step computes a frame, .help lists the others. When the script changes, it is reloaded and its\n"
        "state is kept. Ctrl-C interrupts; Ctrl-D or .quit quits. Exits with 0, or with 1 if input from a file or a\n"
        "pipe had an error.",
    .examples = "  petri repl dish.fl                              then: .step 60, .particles 5, .help\n"
                "  petri repl                                      start without a script\n",
    .no_stdin = "cannot read the script from standard input: the prompt uses it",
    .options = &REPL_OPTIONS,
    .run = repl_run,
};
