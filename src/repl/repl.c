// repl.c: `petri repl`, which runs a script frame by frame at a prompt.
#include "repl/repl.h"

#include "cli/help.h"
#include "cli/option_groups.h"
#include "cli/options.h"
#include "cli/parameters.h"
#include "cli/script.h"
#include "repl/line.h"

#include <errno.h>
#include <glob.h>
#include <inttypes.h>
#include <langinfo.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    int64_t limit;    // maximum frames of .run and .until
    TextList execute; // lines to execute before the first prompt
} Own;

static bool add_line(const Args *args, void *field) {
    texts_add(field, args->value);
    return true;
}

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Repl *repl = host;
    if (diagnostic->code && strcmp(diagnostic->code, "unread-definition") == 0)
        return; // not shown, because an expression that is typed later can still read the definition
    repl->invalid_definition = repl->invalid_definition || is_invalid_definition(diagnostic);
    if (diagnostic->code && strcmp(diagnostic->code, "memory-limit") == 0)
        repl->prompt.failed = repl->any_failed = true;
    output_flush(&repl->output);
    fputs(diagnostic->rendered, stderr);
}

static void make_prompt(const Repl *repl, char *prompt, size_t size) {
    int64_t frame = petri_frame_number(repl->prompt.session);
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
        repl->any_failed = !prompt_execute(&repl->prompt, text->bytes, text->len) || repl->any_failed;
    return status;
}

static void run_prompt(Repl *repl) {
    LineReader *reader = line_reader_new(repl);
    Text next = {0};
    LineStatus status = LINE_READ;
    while (status != LINE_END && !repl->prompt.quit && repl->output.error == 0) {
        char prompt[40];
        Text text = next;
        next = (Text){0};
        make_prompt(repl, prompt, sizeof prompt);
        repl_report_changes(repl, false);
        status = text.len > 0 ? LINE_READ : line_read(reader, prompt, &text);
        if (status == LINE_READ && !line_is_blank(text.bytes))
            status = execute_input(repl, reader, &text, &next);
        else if (status == LINE_READ && repl->terminal)
            prompt_execute(&repl->prompt, "", 0); // repeats the last stepping command
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
        return prompt_fail(&repl->prompt, "cannot read '%s': %s", file, strerror(errno));
    return prompt_status(&repl->prompt, petri_restore(repl->prompt.session, file));
}

// Loads the script and the state. If the script has errors, the prompt starts nevertheless: the script is reloaded when
// it changes.
static void start_session(Repl *repl, const char *state) {
    Prompt *prompt = &repl->prompt;
    petri_load_text(prompt->session, "prompt", "", 0);
    if (repl->options->replayed)
        repl_replay(repl);
    else if (repl->script)
        repl_load(repl, repl->script);
    if (!read_state(repl, state))
        prompt->failed = true;
    prompt->history = petri_history_new(prompt->session, 0);
    if (!prompt->history)
        prompt_status(prompt, PETRI_OUT_OF_MEMORY);
    repl->any_failed = prompt->failed;
}

// Executes the lines of --execute, which are shown like typed ones.
static void execute_lines(Repl *repl) {
    const TextList *lines = &((const Own *)repl->options->own)->execute;
    for (size_t i = 0; i < lines->count && !repl->prompt.quit; i++) {
        SCOPED_TEXT text = {0};
        char prompt[40];
        make_prompt(repl, prompt, sizeof prompt);
        text_add_format(&text, "%s\n", lines->items[i]);
        output_format(&repl->output, "%s%s", prompt, text.bytes);
        repl->any_failed = !prompt_execute(&repl->prompt, text.bytes, text.len) || repl->any_failed;
    }
    output_flush(&repl->output);
}

static int run_session(Repl *repl, const char *state) {
    // Use only the character encoding of the locale, because its number format would break the parsing of scripts.
    setlocale(LC_CTYPE, "");
    repl->utf8 = strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    repl->prompt.live = repl->terminal = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO);
    repl->files = file_watch_new();
    repl_catch_interrupt();
    start_session(repl, state);
    if (repl->invalid_definition)
        return STATUS_USAGE;
    if (repl->terminal)
        prompt_note(&repl->prompt, "petri %s; .help lists the commands, Ctrl-D quits", petri_version());
    execute_lines(repl);
    run_prompt(repl);
    return repl->any_failed && !repl->terminal ? STATUS_FAILED : STATUS_DONE;
}

static void complain(Prompt *prompt, const char *text) {
    (void)prompt;
    message("%s", text);
}

static bool was_interrupted(Prompt *prompt) {
    (void)prompt;
    return repl_interrupted();
}

static void after_frames(Prompt *prompt) {
    repl_watch_files(prompt->user_data); // the frames may have imported modules
}

static void show_progress(Prompt *prompt, int64_t done, int64_t total) {
    Repl *repl = prompt->user_data;
    if (total == 0 && repl->progresses) {
        progress_erase(&repl->progress);
        repl->progresses = false;
    } else if (total > 0) {
        if (!repl->progresses)
            progress_start(&repl->progress, repl->terminal && progress_possible(), total);
        repl->progresses = true;
        progress_update(&repl->progress, done);
    }
}

static size_t terminal_rows(Prompt *prompt) {
    const Repl *repl = prompt->user_data;
    int columns = 0, rows = 24;
    terminal_extent(STDOUT_FILENO, &columns, &rows);
    return repl->terminal ? (size_t)rows : SIZE_MAX;
}

static size_t terminal_columns(Prompt *prompt) {
    return help_columns(prompt->output->fd);
}

static void add_files(Prompt *prompt, const char *typed, TextList *names) {
    SCOPED_TEXT pattern = {0};
    glob_t found = {0};
    (void)prompt;
    text_add_format(&pattern, "%s*", typed);
    glob(pattern.bytes, 0, NULL, &found);
    for (size_t i = 0; i < found.gl_pathc; i++)
        if (str_starts_with(str_from(found.gl_pathv[i]), str_from(typed)))
            texts_add(names, found.gl_pathv[i]);
    globfree(&found);
}

static const PromptHostCommand COMMANDS[] = {
    {".plot", repl_run_plot, NULL},       {".show", repl_run_show, NULL},     {".load", repl_run_load, NULL},
    {".reload", repl_run_reload, NULL},   {".save", repl_run_save, NULL},     {".restore", repl_run_restore, NULL},
    {".archive", repl_run_archive, NULL}, {".record", repl_run_record, NULL}, {0},
};

static const PromptHost HOST = {
    .complain = complain,
    .interrupted = was_interrupted,
    .commands = COMMANDS,
    .begin = repl_begin,
    .end = repl_end,
    .before_frames = repl_refresh,
    .after_frames = after_frames,
    .show_progress = show_progress,
    .rows = terminal_rows,
    .columns = terminal_columns,
    .add_files = add_files,
    .keys_help = "Indented lines belong to the line above them; Up returns to earlier lines, and an empty line ends "
                 "the block. Ctrl-C interrupts. ",
};

static int repl_run(const CommandContext *context, Options *options) {
    const Own *own = options->own;
    if (options->script && transcript_is_named(options->script))
        return transcript_run(context, options->script);
    Repl repl = {.context = context, .options = options, .output.fd = STDOUT_FILENO};
    repl.prompt = (Prompt){
        .host = &HOST, .user_data = &repl, .output = &repl.output, .limit = own->limit, .colour = options->colour};
    repl.script = !options->script || options->replayed ? NULL : memory_strdup(options->script);
    for (size_t i = 0; i < options->definitions.count; i++)
        texts_add(&repl.prompt.definitions, options->definitions.items[i]);
    options->prompt = true;
    int status = options_open(options, context, on_diagnostic, &repl, &repl.prompt.session);
    if (status == OPTIONS_READ)
        status = output_finish(&repl.output, run_session(&repl, options->state_file));
    if (!archiving_end(&repl.archiving) && status == STATUS_DONE)
        status = STATUS_FAILED;
    petri_history_free(repl.prompt.history);
    petri_close(&repl.prompt.session);
    file_watch_free(repl.files);
    prompt_end(&repl.prompt);
    free(repl.script);
    text_free(&repl.script_text);
    return status;
}

// clang-format off
static const OptionSpec ROWS[] = {
    FPS_OPTION DEFINE_OPTION
    SHARED("state", 0, "FILE", option_text, state_file, "start with the state in FILE")
    FILE_OPTIONS
    OWN("execute", 0, "TEXT", IS_LIST(add_line), execute, "execute a line before the prompt, such as '.step 60'; may be repeated")
    OWN("limit", 0, "N", WHOLE(1, INT64_MAX), limit, "limit .run and .until to N frames (default: 100000)")
    THREADS_OPTION LIMIT_OPTIONS NOSIMPLIFY_OPTION FROM_OPTION
    SHARED("color", 0, "WHEN", ONE_OF(option_colour, "auto", "always", "never"), colour, "use colours in prompts and messages: auto, always or never")
    NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable REPL_OPTIONS = {ROWS, sizeof(Own), &(const Own){.limit = DEFAULT_LIMIT}};

const Command REPL_COMMAND = {
    .name = "repl",
    .operands = "[SCRIPT.fl]",
    .summary = "step through a script interactively",
    .details =
        "Reads code and commands. Prints the values of expressions; keeps let, func, import and nodes. Commands begin\n"
        "with a dot: .step computes a frame, .help lists the others. When the script changes, it is reloaded and its\n"
        "state is kept. Ctrl-C interrupts; Ctrl-D or .quit quits. Exits with 0, or with 1 if input from a file or a\n"
        "pipe had an error. The output of such a session can be kept as NAME.session: 'petri repl NAME.session' "
        "repeats\n"
        "its inputs, and 'petri test NAME.session' compares the answers.",
    .examples = "  petri repl dish.fl                              then: .step 60, .particles 5, .help\n"
                "  petri repl dish.fl --execute '.step 60'         begin at frame 59\n"
                "  petri repl                                      start without a script\n",
    .no_stdin = "cannot read the script from standard input: the prompt uses it",
    .options = &REPL_OPTIONS,
    .run = repl_run,
};
