// bare.c: commands of the prompt that were typed without their dot.
#include <stdlib.h>
#include <string.h>

#include "repl/repl.h"
#include "repl/words.h"

// What people type to leave and to get help. A question mark is no word of the language.
static const struct {
    const char *word;
    const char *command;
    bool topic; // something may follow
} bare_words[] = {
    {"help", ".help", true},  {"?", ".help", true},     {"h", ".help", false},
    {"quit", ".quit", false}, {"exit", ".quit", false}, {"q", ".quit", false},
};

enum { BARE_COUNT = sizeof bare_words / sizeof bare_words[0] };

static bool is_word(const char *name, const char *word, size_t length) {
    return strlen(name) == length && memcmp(name, word, length) == 0;
}

const char *bare_alias(const char *name, size_t length) {
    for (size_t i = 0; i < BARE_COUNT; i++) {
        if (is_word(bare_words[i].word, name, length)) {
            return bare_words[i].command;
        }
    }
    return NULL;
}

// Does the script, the prompt or petri itself give the word a meaning?
static bool is_bound(Repl *repl, const char *word, size_t length) {
    PetriBuiltin builtin;
    const char *name;
    for (size_t i = 0; (name = petri_name(repl->session, i)) != NULL; i++) {
        if (is_word(name, word, length)) {
            return true;
        }
    }
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        if (is_word(builtin.name, word, length)) {
            return true;
        }
    }
    return false;
}

static size_t word_length(const char *text) {
    return text[0] == '?' ? 1 : strcspn(text, " \t\n(");
}

// Names are known once something was evaluated.
static void learn_names(Repl *repl) {
    PetriResult result;
    repl_busy(repl);
    petri_evaluate(repl->session, "0", PETRI_Z, &result, NULL, NULL);
    repl_idle(repl);
}

// `help`, `quit` and the like.
static bool take_alias(Repl *repl, const char *word, size_t length, const char *rest, Bytes *remark) {
    bool alone = rest[0] == '\0' || strcmp(rest, "()") == 0, topic = false;
    const char *command = NULL;
    for (size_t i = 0; i < BARE_COUNT; i++) {
        if (is_word(bare_words[i].word, word, length)) {
            command = bare_words[i].command;
            topic = bare_words[i].topic;
        }
    }
    if (command == NULL || !(alone || topic)) {
        return false;
    }
    if (is_bound(repl, word, length)) {
        bytes_format(remark, "%.*s is a name here; the command is %s", (int)length, word, command);
        return false;
    }
    Bytes line = {0};
    size_t inner = strlen(rest);
    bool called = !alone && rest[0] == '(' && rest[inner - 1] == ')'; // help(sin)
    bytes_format(&line, "%s %.*s", command, (int)(alone ? 0 : inner - 2 * called), rest + called);
    repl_command(repl, line.data);
    bytes_free(&line);
    return true;
}

static bool is_command(const char *word, size_t length) {
    const ReplCommand *command = REPL_COMMANDS;
    while (command->name != NULL && !is_word(command->name + 1, word, length)) {
        command++;
    }
    return command->name != NULL;
}

bool bare_take(Repl *repl, const char *text, Bytes *remark) {
    char *line = word_trimmed(text);
    size_t length = word_length(line);
    char *rest = word_trimmed(line + length);
    bool alias = bare_alias(line, length) != NULL, command = is_command(line, length), done = false;
    if ((alias || command) && strchr(line, '\n') == NULL) {
        learn_names(repl);
        done = take_alias(repl, line, length, rest, remark);
        if (!done && !alias && !is_bound(repl, line, length)) {
            repl_fail(repl, "commands begin with a dot: did you mean .%s?", line);
            done = true;
        } else if (!done && command && rest[0] != '\0') {
            bytes_format(remark, "commands begin with a dot: did you mean .%s?", line);
        }
    }
    free(line);
    free(rest);
    return done;
}
