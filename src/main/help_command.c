// help_command.c: the command `petri help`.
//
// Only petri-pictures has this file, because it needs the commands of the prompt. Help on single commands is in
// cli/help.c, which every program has.
#include "cli/args.h"
#include "cli/help.h"
#include "cli/options.h"
#include "main/commands.h"
#include "petri.h"
#include "prompt/prompt.h"

#include <stdio.h>
#include <string.h>

enum { ATTRIBUTE_COLUMN = 22, BUILTIN_COLUMN = 38 };

static int help_overview(void) {
    SCOPED_TEXT text = {0};
    text_add_format(&text, "petri %s: %s\n\n", petri_version(), HELP_TITLE);
    text_add_format(&text, "usage: petri SCRIPT.fl\n       petri COMMAND [options] ...\n\n");
    for (const CommandRow *row = COMMANDS; row->listed; row++)
        text_add_format(&text, "  %-8s %s\n", row->name, row->command->summary);
    text_add_c(&text, "\n");
    help_prose(&text, HELP_BEGINNING);
    return help_print(&text);
}

static int help_builtins(void) {
    SCOPED_TEXT text = {0};
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++) {
        char head[128];
        snprintf(head, sizeof head, "%s(%s)", builtin.name, builtin.parameters);
        text_add_format(&text, "%-*s  %s\n", BUILTIN_COLUMN, head, builtin.help);
    }
    return help_print(&text);
}

static void write_attributes(Text *text, size_t kind) {
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_attribute(kind, i, &attribute, sizeof attribute); i++) {
        char head[48];
        snprintf(head, sizeof head, "      %s", attribute.name);
        text_add_format(text, "%-*s  %s", ATTRIBUTE_COLUMN, head, attribute.type);
        if (attribute.unit[0] != '\0')
            text_add_format(text, ", in %s", attribute.unit);
        if (attribute.default_value[0] != '\0')
            text_add_format(text, " (%s)", attribute.default_value);
        text_add_format(text, "%s%s\n", attribute.help[0] == '\0' ? "" : ": ", attribute.help);
    }
}

// Prints all kinds of nodes with their attributes.
static int help_nodes(void) {
    SCOPED_TEXT text = {0};
    PetriNodeKind kind;
    const char *area = "";
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        if (strcmp(kind.area, area) != 0) {
            text_add_format(&text, "%s%s\n", area[0] == '\0' ? "" : "\n", kind.area);
            area = kind.area;
        }
        text_add_format(&text, "  !%s: %s\n", kind.name, kind.help);
        help_formula(&text, &kind);
        write_attributes(&text, i);
    }
    return help_print(&text);
}

// Adds the help for the option `--NAME` or `-X` if the command or one of its parts has it. Returns false if none has
// it.
static bool print_option(Text *text, const char *word, const Command *command) {
    bool found = false, is_long = word[1] == '-';
    for (const OptionSpec *spec = command_options(command); spec->name; spec++) {
        if (is_long ? strcmp(spec->name, word + 2) == 0 : spec->letter != '\0' && spec->letter == word[1]) {
            text_add_format(text, "petri %s\n", command->name);
            help_option(text, spec);
            found = true;
        }
    }
    for (const Command *const *part = command->parts; part && *part; part++)
        found = print_option(text, word, *part) || found;
    return found;
}

static bool print_options(Text *text, const char *word) {
    bool found = false;
    for (const CommandRow *row = COMMANDS; row->listed; row++)
        found = print_option(text, word, row->command) || found;
    return found;
}

static int unknown_topic(const char *topic) {
    StrNearest nearest = str_nearest(str_from(topic));
    for (const CommandRow *row = COMMANDS; row->listed; row++)
        nearest_offer(&nearest, row->name);
    nearest_offer(&nearest, "builtins");
    nearest_offer(&nearest, "nodes");
    nearest_offer(&nearest, "version");
    topics_offer(&nearest);
    if (nearest.found.bytes)
        message("no help for '%.60s'; did you mean 'petri help %s'?", topic, nearest.found.bytes);
    else
        message("no help for '%.60s'; run 'petri help' for a list", topic);
    return STATUS_USAGE;
}

// Adds the help for a command of the prompt. Returns false if there is no such command.
static bool help_prompt(Text *text, const char *name) {
    const PromptCommand *command = prompt_find_command(name, strlen(name));
    if (command)
        text_add_format(text, "%s %s\n    at the prompt of petri repl: %s\n", name, command->operands, command->help);
    return command;
}

static int help_word(const char *topic) {
    SCOPED_TEXT text = {0};
    bool found = topic[0] == '-'   ? print_options(&text, topic)
                 : topic[0] == '.' ? help_prompt(&text, topic)
                                   : topics_print(&text, topic);
    if (found)
        return help_print(&text);
    return unknown_topic(topic);
}

static int help_topic(const char *topic) {
    if (strcmp(topic, "builtins") == 0)
        return help_builtins();
    if (strcmp(topic, "nodes") == 0)
        return help_nodes();
    if (strcmp(topic, "version") == 0)
        return help_version();
    const CommandRow *row = topic[0] == '-' ? NULL : command_find(topic);
    return row && row->command->details ? help_for(row->command) : help_word(topic);
}

// Prints the help for the part of a command that two words name, such as `archive verify`.
static int help_part(char *const *words) {
    SCOPED_TEXT name = {0};
    text_add_format(&name, "%s %s", words[0], words[1]);
    for (const CommandRow *row = COMMANDS; row->listed && !words[2]; row++)
        for (const Command *const *part = row->command->parts; part && *part; part++)
            if (strcmp((*part)->name, name.bytes) == 0)
                return help_for(*part);
    message("too many arguments: '%s'", words[1]);
    return STATUS_USAGE;
}

// Except for --help and -h, the argument is a topic, even if it has the form of an option.
static int help_run(const CommandContext *context, Options *options) {
    char **words = options->argv;
    (void)context;
    if (options->argc > 0 && (strcmp(words[0], "--help") == 0 || strcmp(words[0], "-h") == 0))
        return help_for(&HELP_COMMAND);
    if (options->argc > 1)
        return help_part(words);
    return options->argc == 0 ? help_overview() : help_topic(words[0]);
}

const Command HELP_COMMAND = {
    .name = "help",
    .operands = "[TOPIC]",
    .summary = "show help for a command, function, node or word",
    .details = "Lists the commands, or explains a TOPIC:\n\n"
               "  run, render, ...    a command and its options\n"
               "  builtins, nodes     all functions; all nodes with their attributes\n"
               "  sin, particle       one function, one node ('!random' if a function has the same name)\n"
               "  tempo, let, radius  a predefined value, a word of the language, an attribute\n"
               "  --frames, .step     an option, a command of the prompt\n"
               "  circle, easing      an everyday word, or a word of p5 or NetLogo, and its names in petri",
    .parses_arguments = true,
    .run = help_run,
};
