// help_command.c: `petri help`: all there is help on.
//
// Apart from help.c, which the program that does not draw has as well: this knows the prompt.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/help.h"
#include "cli/options.h"
#include "main/commands.h"
#include "petri.h"
#include "repl/repl.h"

enum { ATTRIBUTE_COLUMN = 22, BUILTIN_COLUMN = 38 };

static int help_builtins(void) {
    Output *output = help_begin();
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        char head[128];
        snprintf(head, sizeof head, "%s(%s)", builtin.name, builtin.parameters);
        output_format(output, "%-*s  %s\n", BUILTIN_COLUMN, head, builtin.help);
    }
    return help_end(output);
}

static void write_attributes(Output *output, size_t kind) {
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_attribute(kind, i, &attribute); i++) {
        char head[48];
        snprintf(head, sizeof head, "      %s", attribute.name);
        output_format(output, "%-*s  %s", ATTRIBUTE_COLUMN, head, attribute.type);
        if (attribute.unit[0] != '\0') {
            output_format(output, ", in %s", attribute.unit);
        }
        if (attribute.fallback[0] != '\0') {
            output_format(output, " (%s)", attribute.fallback);
        }
        output_format(output, "%s%s\n", attribute.help[0] == '\0' ? "" : ": ", attribute.help);
    }
}

// All kinds of nodes that do something.
static int help_nodes(void) {
    Output *output = help_begin();
    PetriNodeKind kind;
    const char *area = "";
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        if (strcmp(kind.area, area) != 0) {
            output_format(output, "%s%s\n", area[0] == '\0' ? "" : "\n", kind.area);
            area = kind.area;
        }
        output_format(output, "  !%s: %s\n", kind.name, kind.help);
        help_formula(output, &kind);
        write_attributes(output, i);
    }
    return help_end(output);
}

// `--NAME`, `-X` or `-X...`: what the commands that have the option say of it. False if none has it.
static bool tell_option(Output *output, const char *word) {
    bool found = false, is_long = word[1] == '-';
    for (size_t i = 0; COMMANDS[i] != NULL; i++) {
        for (const OptionSpec *spec = OPTIONS; spec->name != NULL; spec++) {
            if (!(spec->commands & COMMANDS[i]->options)) {
                continue;
            }
            if (is_long ? strcmp(spec->name, word + 2) == 0 : spec->letter != '\0' && spec->letter == word[1]) {
                output_format(output, "petri %s\n", COMMANDS[i]->name);
                help_option(output, spec);
                found = true;
            }
        }
    }
    return found;
}

static int unknown_topic(const char *topic) {
    StrNearest nearest = nearest_start(topic);
    for (size_t i = 0; COMMANDS[i] != NULL; i++) {
        nearest_offer(&nearest, COMMANDS[i]->name);
    }
    nearest_offer(&nearest, "builtins");
    nearest_offer(&nearest, "nodes");
    nearest_offer(&nearest, "version");
    topics_offer(&nearest);
    if (nearest.found.bytes != NULL) {
        message("there is no help on '%.60s', did you mean 'petri help %s'?", topic, nearest.found.bytes);
    } else {
        message("there is no help on '%.60s'; 'petri help' tells what there is help on", topic);
    }
    return STATUS_USAGE;
}

// Tells of a command of the prompt; false if there is none of this name.
static bool help_prompt(Output *output, const char *name) {
    const ReplCommand *command = repl_find_command(name, strlen(name));
    if (command != NULL) {
        output_format(output, "%s %s\n    at the prompt of petri repl: %s\n", name, command->operands, command->help);
    }
    return command != NULL;
}

static int help_word(const char *topic) {
    Output *output = help_begin();
    bool found = topic[0] == '-'   ? tell_option(output, topic)
                 : topic[0] == '.' ? help_prompt(output, topic)
                                   : topics_tell(output, topic);
    if (found) {
        return help_end(output);
    }
    free(output);
    return unknown_topic(topic);
}

static int help_topic(const char *topic) {
    if (strcmp(topic, "builtins") == 0) {
        return help_builtins();
    }
    if (strcmp(topic, "nodes") == 0) {
        return help_nodes();
    }
    if (strcmp(topic, "version") == 0) {
        return help_version();
    }
    const Command *command = command_find(topic);
    return command != NULL ? help_for(command) : help_word(topic);
}

// What follows is a topic, even if it looks like an option.
static int help_run(const Host *host, Options *options) {
    char **words = options->argv;
    (void)host;
    if (options->argc > 0 && (strcmp(words[0], "--help") == 0 || strcmp(words[0], "-h") == 0)) {
        return help_for(&HELP_COMMAND);
    }
    if (options->argc > 1) {
        message("help is given on one thing at a time; '%s' is too many", words[1]);
        return STATUS_USAGE;
    }
    return options->argc == 0 ? help_overview(COMMANDS) : help_topic(words[0]);
}

const Command HELP_COMMAND = {
    .name = "help",
    .operands = "[TOPIC]",
    .summary = "tell of a command, a function, a node or another word of scripts",
    .details =
        "Lists the commands, or tells of a TOPIC:\n\n"
        "  run, render, ...    a command and its options\n"
        "  builtins, nodes     all functions that scripts can call; all nodes that drive particles or draw\n"
        "  sin, particle       one function, one node with its attributes ('!random' if a function is called so, "
        "too)\n"
        "  tempo, let, radius  a value that petri gives, a word of the language, an attribute\n"
        "  --frames, .step     an option, a command of the prompt",
    .raw = true,
    .run = help_run,
};
