// args.c: reading a command line, one option or operand at a time.
#include "cli/args.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "petri.h"

Args args_start(const Command *command, int argc, char **argv) {
    return (Args){.command = command, .argc = argc, .argv = argv};
}

static int wrong_line(const Args *args, const char *word, const char *nearest) {
    if (nearest != NULL) {
        message("unknown option '%s', did you mean '--%s'?", word, nearest);
    } else {
        message("unknown option '%s'; 'petri help %s' lists the options", word, args->command->name);
    }
    return ARG_WRONG;
}

// Another of the commands that run scripts, which has the option: what is asked of one is at times another's.
static const char *find_elsewhere(const Args *args, const char *name) {
    static const struct {
        const char *command;
        unsigned options;
    } others[] = {{"run", FOR_RUN}, {"render", FOR_RENDER}, {"view", FOR_VIEW}};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        for (const OptionSpec *spec = OPTIONS; spec->name != NULL; spec++) {
            bool same = strcmp(name, spec->name) == 0 || (name[0] == spec->letter && name[1] == '\0');
            if (same && spec->commands & others[i].options && !(others[i].options & args->command->options)) {
                return others[i].command;
            }
        }
    }
    return NULL;
}

static int unknown_option(const Args *args, const char *word, const char *name) {
    const char *nearest = NULL;
    size_t best = SIZE_MAX;
    for (const OptionSpec *spec = OPTIONS; spec->name != NULL; spec++) {
        if (spec->commands & args->command->options && is_nearer(name, spec->name, &best)) {
            nearest = spec->name;
        }
    }
    static const char *const everywhere[] = {"help", "version"};
    for (size_t i = 0; i < sizeof everywhere / sizeof everywhere[0]; i++) {
        nearest = is_nearer(name, everywhere[i], &best) ? everywhere[i] : nearest;
    }
    nearest = strcmp(name, "v") == 0 ? "version" : nearest;
    const char *elsewhere = nearest == NULL || best > 1 ? find_elsewhere(args, name) : NULL;
    if (elsewhere != NULL) {
        message("'petri %s' has no option '%s', but 'petri %s' has; 'petri help %s' lists the options",
                args->command->name, word, elsewhere, args->command->name);
        return ARG_WRONG;
    }
    return wrong_line(args, word, nearest);
}

// Takes the value from the next word of the command line.
static int take_value(Args *args, const char *shown) {
    if (args->next == args->argc) {
        message("option '%s' needs a value: %s, %s", shown, args->option->value, args->option->help);
        return ARG_WRONG;
    }
    args->value = args->argv[args->next++];
    return ARG_OPTION;
}

static int long_option(Args *args, const char *word) {
    char name[64];
    const char *equals = strchr(word, '=');
    size_t length = equals == NULL ? strlen(word) - 2 : (size_t)(equals - word) - 2;
    if (length >= sizeof name) {
        return wrong_line(args, word, NULL);
    }
    memcpy(name, word + 2, length);
    name[length] = '\0';
    args->version = strcmp(name, "version") == 0;
    if ((strcmp(name, "help") == 0 || args->version) && equals == NULL) {
        return ARG_HELP;
    }
    const OptionSpec *spec = OPTIONS;
    while (spec->name != NULL && !(spec->commands & args->command->options && strcmp(spec->name, name) == 0)) {
        spec++;
    }
    if (spec->name == NULL) {
        return unknown_option(args, word, name);
    }
    args->option = spec;
    args->value = NULL;
    if (spec->value == NULL && equals != NULL) {
        message("option '--%s' takes no value", spec->name);
        return ARG_WRONG;
    }
    if (spec->value == NULL) {
        return ARG_OPTION;
    }
    if (equals != NULL) {
        args->value = equals + 1;
        return ARG_OPTION;
    }
    return take_value(args, word);
}

static int short_option(Args *args, const char *word) {
    args->version = word[1] == 'V';
    if ((word[1] == 'h' || args->version) && word[2] == '\0') {
        return ARG_HELP;
    }
    const OptionSpec *spec = OPTIONS;
    while (spec->name != NULL && !(spec->commands & args->command->options && spec->letter == word[1])) {
        spec++;
    }
    // No flag has a short form, so a letter is always followed by a value.
    if (spec->name == NULL) {
        return unknown_option(args, word, word + 1);
    }
    args->option = spec;
    if (word[2] != '\0') {
        args->value = word + 2;
        return ARG_OPTION;
    }
    return take_value(args, word);
}

int args_next(Args *args) {
    if (args->next == args->argc) {
        return ARG_END;
    }
    const char *word = args->argv[args->next++];
    if (args->operands_only || word[0] != '-' || word[1] == '\0') {
        args->value = word;
        return ARG_OPERAND;
    }
    if (word[1] != '-') {
        return short_option(args, word);
    }
    if (word[2] == '\0') {
        args->operands_only = true;
        return args_next(args);
    }
    return long_option(args, word);
}

int args_help(const Args *args) {
    return args->version ? help_version() : help_for(args->command);
}

bool args_wrong_value(const Args *args, const char *expected) {
    message("option '--%s' expects %s, not '%s'", args->option->name, expected, args->value);
    return false;
}

bool args_integer(const Args *args, int64_t least, int64_t most, int64_t *out) {
    char *end = NULL;
    errno = 0;
    intmax_t value = strtoimax(args->value, &end, 10);
    bool is_number = args->value[0] >= '-' && end != args->value && *end == '\0';
    if (!is_number || errno != 0 || value < least || value > most) {
        char expected[80];
        if (most == INT64_MAX) {
            snprintf(expected, sizeof expected, "a whole number from %" PRId64, least);
        } else {
            snprintf(expected, sizeof expected, "a whole number from %" PRId64 " to %" PRId64, least, most);
        }
        return args_wrong_value(args, expected);
    }
    *out = value;
    return true;
}

bool args_positive(const Args *args, double *out) {
    double value = 0;
    if (!petri_read_number(args->value, &value) || !isfinite(value) || value <= 0) {
        return args_wrong_value(args, "a number above 0");
    }
    *out = value;
    return true;
}

bool args_choice(const Args *args, const char *const *words, int *out) {
    char expected[128] = "one of";
    for (int i = 0; words[i] != NULL; i++) {
        if (strcmp(words[i], args->value) == 0) {
            *out = i;
            return true;
        }
        size_t length = strlen(expected);
        snprintf(expected + length, sizeof expected - length, "%s %s", i == 0 ? "" : ",", words[i]);
    }
    return args_wrong_value(args, expected);
}

bool colour_by_default(void) {
    const char *refused = getenv("NO_COLOR");
    const char *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && (refused == NULL || refused[0] == '\0') &&
           (terminal == NULL || strcmp(terminal, "dumb") != 0);
}

bool args_colour(const Args *args, bool *colour) {
    static const char *const words[] = {"auto", "always", "never", NULL};
    int choice = 0;
    if (!args_choice(args, words, &choice)) {
        return false;
    }
    *colour = choice == 0 ? colour_by_default() : choice == 1;
    return true;
}
