// args.c: see args.h.
#include "cli/args.h"

#include "cli/memory.h"

#include <stdint.h>
#include <string.h>

static const OptionSpec NO_OPTIONS[] = {{.name = NULL}};

const OptionSpec *command_options(const Command *command) {
    return command->options ? command->options->rows : NO_OPTIONS;
}

const OptionSpec *option_find(const OptionSpec *rows, const char *name, char letter) {
    for (const OptionSpec *spec = rows; spec->name; spec++)
        if (letter != '\0' ? spec->letter == letter : strcmp(spec->name, name) == 0)
            return spec;
    return NULL;
}

// Returns the name of another command that has the option, or NULL.
static const char *find_other_command(const Args *args, const char *name) {
    char letter = strlen(name) == 1 ? name[0] : '\0';
    for (const SimilarCommand *other = args->similar; other && other->name; other++)
        if (other->options != args->command->options && option_find(other->options->rows, name, letter))
            return other->name;
    return NULL;
}

static int unknown_option(const Args *args, const char *word, const char *name) {
    StrNearest nearest = str_nearest(str_from(name));
    for (const OptionSpec *spec = command_options(args->command); spec->name; spec++)
        nearest_offer(&nearest, spec->name);
    nearest_offer(&nearest, "help");
    nearest_offer(&nearest, "version");
    const char *meant = strcmp(name, "v") == 0 ? "version" : nearest.found.bytes;
    const char *elsewhere = !meant || nearest.limit > 1 ? find_other_command(args, name) : NULL;
    if (elsewhere) {
        message("'petri %s' has no option '%s', but 'petri %s' has; see 'petri help %s'", args->command->name, word,
                elsewhere, args->command->name);
    } else if (meant) {
        message("unknown option '%s'; did you mean '--%s'?", word, meant);
    } else {
        message("unknown option '%s'; see 'petri help %s'", word, args->command->name);
    }
    return ARG_INVALID;
}

// Sets args->option and, if the option takes a value, args->value. `value` is the value if it is part of the same
// argument. If `value` is NULL, the next argument is the value.
static int accept_option(Args *args, const OptionSpec *spec, const char *word, const char *value) {
    args->option = spec;
    args->value = value;
    if (!spec->value && value) {
        message("option '--%s' takes no value", spec->name);
        return ARG_INVALID;
    }
    if (spec->value && !value) {
        if (args->next == args->argc) {
            message("option '%s' needs a value; '%s %s' means: %s", word, word, spec->value, spec->help);
            return ARG_INVALID;
        }
        args->value = args->argv[args->next++];
    }
    return ARG_OPTION;
}

static int long_option(Args *args, const char *word) {
    const char *equals = strchr(word, '=');
    SCOPED_STRING name = memory_strndup(word + 2, strcspn(word + 2, "="));
    args->version = strcmp(name, "version") == 0;
    if ((strcmp(name, "help") == 0 || args->version) && !equals)
        return ARG_HELP;
    const OptionSpec *spec = option_find(command_options(args->command), name, '\0');
    return !spec ? unknown_option(args, word, name) : accept_option(args, spec, word, !equals ? NULL : equals + 1);
}

static int short_option(Args *args, const char *word) {
    args->version = word[1] == 'V';
    if ((word[1] == 'h' || args->version) && word[2] == '\0')
        return ARG_HELP;
    // Flags have no short form, so a letter is always followed by a value.
    const OptionSpec *spec = option_find(command_options(args->command), "", word[1]);
    return !spec ? unknown_option(args, word, word + 1)
                 : accept_option(args, spec, word, word[2] == '\0' ? NULL : word + 2);
}

int args_next(Args *args) {
    if (args->next == args->argc)
        return ARG_END;
    const char *word = args->argv[args->next++];
    if (args->operands_only || word[0] != '-' || word[1] == '\0') {
        args->value = word;
        return ARG_OPERAND;
    }
    if (word[1] != '-')
        return short_option(args, word);
    if (word[2] == '\0') {
        args->operands_only = true;
        return args_next(args);
    }
    return long_option(args, word);
}
