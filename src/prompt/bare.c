// bare.c: commands typed without their dot; see prompt.h.
//
// A word that the script, the prompt or petri binds is never taken for a command.
#include "cli/help.h"
#include "prompt/prompt.h"

#include <stdlib.h>
#include <string.h>

// Returns true if the script, the prompt or petri binds the word.
static bool is_bound(Prompt *prompt, const char *word, size_t length) {
    PetriBuiltin builtin;
    const char *name;
    for (size_t i = 0; (name = petri_visible_name(prompt->session, i)); i++)
        if (str_equal(str_from(name), (Str){word, length}))
            return true;
    return topic_find_builtin((Str){word, length}, &builtin);
}

static size_t word_length(const char *text) {
    return text[0] == '?' ? 1 : strcspn(text, " \t\n(");
}

// Evaluates a trivial expression, because petri_visible_name finds names only after an evaluation.
static void compile_names(Prompt *prompt) {
    PetriEvaluation result;
    prompt_busy(prompt);
    petri_evaluate(prompt->session, "0", PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
    prompt_idle(prompt);
}

// Executes `help`, `quit` and their synonyms. Returns false if the text is not one of these commands or if the word is
// bound. If the word is bound, also sets *remark.
static bool execute_alias(Prompt *prompt, const char *word, size_t length, const char *rest, Text *remark) {
    bool alone = rest[0] == '\0' || strcmp(rest, "()") == 0;
    const char *command = bare_alias(word, length);
    bool topic = length > 1 || word[0] == '?'; // only `help` and `?` take an operand; `h` does not
    if (!command || !(alone || (topic && strcmp(command, ".help") == 0)))
        return false;
    if (is_bound(prompt, word, length)) {
        text_add_format(remark, "'%.*s' is a name here; the command is %s", (int)length, word, command);
        return false;
    }
    SCOPED_TEXT line = {0};
    size_t inner = strlen(rest);
    bool called = !alone && rest[0] == '(' && rest[inner - 1] == ')'; // as in help(sin)
    text_add_format(&line, "%s %.*s", command, (int)(alone ? 0 : inner - 2 * called), rest + called);
    prompt_command(prompt, line.bytes);
    return true;
}

bool bare_execute(Prompt *prompt, const char *text, Text *remark) {
    SCOPED_STRING line = argument_trimmed(text);
    size_t length = word_length(line);
    SCOPED_STRING rest = argument_trimmed(line + length);
    bool alias = bare_alias(line, length), command = line[0] != '.' && prompt_find_command(line, length), done = false;
    if ((alias || command) && !strchr(line, '\n')) {
        compile_names(prompt);
        done = execute_alias(prompt, line, length, rest, remark);
        if (!done && !alias && !is_bound(prompt, line, length)) {
            prompt_fail(prompt, "commands begin with a dot: did you mean .%s?", line);
            done = true;
        } else if (!done && command && rest[0] != '\0') {
            text_add_format(remark, "commands begin with a dot: did you mean .%s?", line);
        }
    }
    return done;
}
