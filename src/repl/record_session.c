// record_session.c: `.record NAME.session`, which keeps the session so far as a test for `petri test`.
//
// The inputs are repeated by `petri repl NAME.session`, whose answers become those of the transcript.
#include "base/file.h"
#include "base/source.h"
#include "cli/subprocess.h"
#include "repl/repl.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/wait.h>

// Adds the first line, with the options with which this session was started. Returns false after a message.
static bool add_header(Repl *repl, Text *text) {
    const Options *options = repl->options;
    text_add_c(text, "# repl");
    if (options->fps_given)
        text_add_format(text, " --fps %.17g", options->fps);
    if (repl->prompt.limit != DEFAULT_LIMIT)
        text_add_format(text, " --limit %" PRId64, repl->prompt.limit);
    for (size_t i = 0; i < options->definitions.count; i++) {
        if (strpbrk(options->definitions.items[i], " \t\n"))
            return prompt_fail(&repl->prompt, "cannot record the definition '%s': it contains blanks",
                               options->definitions.items[i]);
        text_add_format(text, " -D %s", options->definitions.items[i]);
    }
    if (options->script)
        text_add_format(text, " %s", options->script + path_directory(str_from(options->script)).len);
    text_add_c(text, "\n");
    return true;
}

// Adds an input with its prompts. If its statement may continue, adds the blank line that ends it.
static void add_input(Repl *repl, const char *input, Text *text) {
    SCOPED_TEXT whole = {0};
    Str line;
    text_add_format(&whole, "%s\n", input);
    for (size_t at = 0; text_next_line(&whole, &at, &line);)
        text_add_format(text, "%s%.*s\n", line.bytes == whole.bytes ? "petri> " : "... ", (int)line.len, line.bytes);
    if (input[0] != '.' && petri_prompt_check(repl->prompt.session, whole.bytes, whole.len) != PETRI_COMPLETE)
        text_add_c(text, "... \n");
}

// Returns true if a test must not repeat an input: it would write its own session, or an archive over one of the user.
static bool is_left_out(const char *input) {
    const PromptCommand *command = prompt_command_of(input);
    return command &&
           (strcmp(command->name, ".archive") == 0 ||
            (strcmp(command->name, ".record") == 0 && str_ends_with(str_from(input), STR(TRANSCRIPT_SUFFIX))));
}

static bool can_record_session(Repl *repl, const char *path) {
    Prompt *prompt = &repl->prompt;
    if (repl->options->replayed || repl->options->state_file)
        return prompt_fail(prompt, "cannot record a session that started with %s",
                           repl->options->replayed ? "an archive" : "--state");
    if (prompt->inputs_dropped)
        return prompt_fail(prompt, "cannot record the session: it has more than 1000 inputs");
    if (repl->options->script && !repl_same_folder(repl->options->script, path))
        return prompt_fail(prompt, "the session must be in the folder of '%s'", repl->options->script);
    return true;
}

// Repeats the inputs in the file and replaces it by the new transcript. Returns false after a message.
static bool repeat_inputs(Repl *repl, const char *path) {
    SCOPED_STRING folder = memory_folder(path);
    SCOPED_TEXT output = {0};
    SCOPED_TEXT errors = {0};
    char name[] = "petri", command[] = "repl", end[] = "--";
    SCOPED_STRING file = memory_strdup(path + path_directory(str_from(path)).len);
    char *words[] = {name, command, end, file, NULL};
    int status = subprocess_run(repl->context->program, folder, words, SUBPROCESS_MAX_SECONDS, &output, &errors);
    if (status < 0 || !WIFEXITED(status) || errors.len > 0)
        return prompt_fail(&repl->prompt, "cannot repeat the session: %s",
                           status < 0       ? strerror(errno)
                           : errors.len > 0 ? errors.bytes
                                            : "the process was ended by a signal");
    const char *problem = file_replace(path, text_str(&output), 0);
    return !problem || prompt_fail(&repl->prompt, "cannot write '%s': %s", path, problem);
}

bool repl_record_session(Repl *repl, const char *path) {
    Prompt *prompt = &repl->prompt;
    SCOPED_TEXT text = {0};
    size_t count = 0;
    if (!can_record_session(repl, path) || !add_header(repl, &text))
        return false;
    for (size_t i = 0; i < prompt->inputs.count; i++) {
        if (is_left_out(prompt->inputs.items[i]))
            continue;
        add_input(repl, prompt->inputs.items[i], &text);
        count++;
    }
    const char *problem = file_replace(path, text_str(&text), 0);
    if (problem)
        return prompt_fail(prompt, "cannot write '%s': %s", path, problem);
    if (!repeat_inputs(repl, path))
        return false;
    prompt_note(prompt, "%zu input%s and their answers written to %s", count, count == 1 ? "" : "s", path);
    return true;
}
