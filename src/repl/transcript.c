// transcript.c: `petri repl NAME.session`, which repeats a recorded session.
//
// A transcript is what `petri repl` prints if its input comes from a file: prompts with inputs, and the answers below
// them. It can begin with `# repl [VARIABLE=VALUE...] [OPTION...] [SCRIPT]`; without this line, the script is NAME.fl.
// It can end with `# exit status N`. Messages are in their places between the answers.
#include "base/file.h"
#include "base/source.h"
#include "cli/subprocess.h"
#include "repl/repl.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char HEADER[] = "# repl";
static const size_t MAX_BYTES = (size_t)64 << 20;

// Returns the length of the prompt at the start of a line, with its blank; 0: the line is not an input.
static size_t prompt_length(Str line) {
    size_t at = 0;
    if (str_starts_with(line, STR("...")))
        at = 3;
    else if (str_starts_with(line, STR("petri>")))
        at = 6;
    else if (line.len > 2 && line.bytes[0] == '@') {
        at = 1;
        while (at < line.len && line.bytes[at] >= '0' && line.bytes[at] <= '9')
            at++;
        at = at > 1 && at < line.len && line.bytes[at] == '>' ? at + 1 : 0;
    }
    // Editors remove blanks at the end of a line.
    return at == 0 || (at < line.len && line.bytes[at] != ' ') ? 0 : at + (at < line.len);
}

// Adds the inputs. An empty last one is the end of the input, as after Ctrl-D.
static void add_inputs(const Text *transcript, Text *inputs) {
    Str line;
    size_t last = 0;
    for (size_t at = 0; text_next_line(transcript, &at, &line);) {
        size_t length = prompt_length(line);
        if (length == 0)
            continue;
        last = inputs->len;
        text_add(inputs, (Str){line.bytes + length, line.len - length});
        text_add_c(inputs, "\n");
    }
    if (inputs->len == last + 1)
        inputs->len = last;
}

// Adds the words of the first line to `words`, and sets its variables. Without this line, adds NAME.fl.
static void add_words(const Text *transcript, const char *path, TextList *words) {
    Str line = {0};
    size_t at = 0;
    text_next_line(transcript, &at, &line);
    if (!str_starts_with(line, str_from(HEADER))) {
        Str name = {path, strlen(path) - strlen(TRANSCRIPT_SUFFIX)};
        texts_add_format(words, "%.*s.fl", (int)name.len, name.bytes);
        return;
    }
    SCOPED_STRING text = memory_strndup(line.bytes + strlen(HEADER), line.len - strlen(HEADER));
    char *rest = NULL;
    for (char *word = strtok_r(text, " \t\r", &rest); word; word = strtok_r(NULL, " \t\r", &rest)) {
        char *value = word[0] >= 'A' && word[0] <= 'Z' ? strchr(word, '=') : NULL;
        if (value && words->count == 0) {
            *value = '\0';
            setenv(word, value + 1, 1);
        } else {
            texts_add(words, word);
        }
    }
}

// Makes a descriptor refer to the file of another one. Not with dup2, which the WebAssembly build does not have.
static bool replace_descriptor(int descriptor, int other) {
    close(descriptor);
    return dup(other) == descriptor;
}

// Makes the inputs the standard input, and writes messages to standard output. Returns false with errno set on failure.
static bool redirect(const Text *inputs) {
    int file = subprocess_temporary_file();
    bool good = file >= 0 && file_write(file, inputs->len > 0 ? inputs->bytes : "", inputs->len) &&
                lseek(file, 0, SEEK_SET) == 0 && replace_descriptor(STDIN_FILENO, file) &&
                replace_descriptor(STDERR_FILENO, STDOUT_FILENO);
    if (file >= 0)
        close(file);
    return good;
}

bool transcript_is_named(const char *path) {
    return str_ends_with(str_from(path), STR(TRANSCRIPT_SUFFIX));
}

int transcript_run(const CommandContext *context, const char *path) {
    SCOPED_TEXT transcript = {0};
    SCOPED_TEXT inputs = {0};
    TextList words = {0};
    const char *problem = text_read_file(&transcript, path, MAX_BYTES);
    if (problem) {
        message("cannot read '%s': %s", path, problem);
        return STATUS_FAILED;
    }
    text_add_c(&transcript, "");
    // Everywhere the same output: 80 columns, ASCII.
    unsetenv("COLUMNS");
    setenv("LC_ALL", "C", 1);
    add_inputs(&transcript, &inputs);
    add_words(&transcript, path, &words);
    int status = STATUS_FAILED;
    if (redirect(&inputs)) {
        SCOPED_TEXT header = {0};
        Str line;
        size_t at = 0;
        if (text_next_line(&transcript, &at, &line) && str_starts_with(line, str_from(HEADER)))
            text_add_format(&header, "%.*s\n", (int)line.len, line.bytes);
        output_text(header.len > 0 ? header.bytes : "", header.len, STATUS_DONE);
        status = command_run(&REPL_COMMAND, context, (int)words.count, words.items);
        char end[40];
        int length = snprintf(end, sizeof end, "# exit status %d\n", status);
        output_text(end, (size_t)length, STATUS_DONE);
    } else {
        message("cannot repeat '%s': %s", path, strerror(errno));
    }
    texts_free(&words);
    return status == STATUS_FAILED ? STATUS_FAILED : STATUS_DONE;
}
