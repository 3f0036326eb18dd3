// help.c: `petri help`: the commands, the options of one, the built-in functions; the version.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "output.h"
#include "petri.h"

enum { ATTRIBUTE_COLUMN = 22 };
enum { OPTION_COLUMN = 28, BUILTIN_COLUMN = 38 };

static Output *new_output(void) {
    Output *output = malloc(sizeof *output);
    if (output == NULL) {
        message("out of memory");
        return NULL;
    }
    output_start(output, 1);
    return output;
}

static int end_output(Output *output) {
    int status = output_finish(output, STATUS_DONE);
    free(output);
    return status;
}

int help_overview(void) {
    Output *output = new_output();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    output_format(output, "petri %s: runs Flitter scripts that hold systems of particles\n\n", petri_version());
    output_format(output, "usage: petri SCRIPT.fl\n       petri COMMAND [options] ...\n\n");
    for (size_t i = 0; COMMANDS[i] != NULL; i++) {
        output_format(output, "  %-8s %s\n", COMMANDS[i]->name, COMMANDS[i]->summary);
    }
    output_format(output,
                  "\n'petri help COMMAND' tells more of a command, 'petri help builtins' lists the functions\n"
                  "that scripts can call, 'petri help nodes' the nodes that do something, 'petri --version' tells\n"
                  "the version.\n");
    return end_output(output);
}

static void write_option(Output *output, const OptionSpec *spec) {
    char letter[8] = "    ";
    if (spec->letter != '\0') {
        snprintf(letter, sizeof letter, "-%c, ", spec->letter);
    }
    char head[80];
    snprintf(head, sizeof head, "  %s--%s%s%s", letter, spec->name, spec->value == NULL ? "" : " ",
             spec->value == NULL ? "" : spec->value);
    output_format(output, "%-*s  %s\n", OPTION_COLUMN, head, spec->help);
}

int help_for(const Command *command) {
    Output *output = new_output();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    output_format(output, "usage: petri %s%s %s\n\n%s\n", command->name,
                  command->options->name == NULL ? "" : " [options]", command->operands, command->details);
    for (const OptionSpec *spec = command->options; spec->name != NULL; spec++) {
        output_format(output, "%s", spec == command->options ? "\n" : "");
        write_option(output, spec);
    }
    return end_output(output);
}

static int help_builtins(void) {
    Output *output = new_output();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        char head[128];
        snprintf(head, sizeof head, "%s(%s)", builtin.name, builtin.parameters);
        output_format(output, "%-*s  %s\n", BUILTIN_COLUMN, head, builtin.help);
    }
    return end_output(output);
}

static void write_attributes(Output *output, size_t kind) {
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_attribute(kind, i, &attribute); i++) {
        char head[48];
        snprintf(head, sizeof head, "      %s", attribute.name);
        output_format(output, "%-*s  %s", ATTRIBUTE_COLUMN, head, attribute.type);
        if (attribute.fallback[0] != '\0') {
            output_format(output, " (%s)", attribute.fallback);
        }
        output_format(output, "%s%s\n", attribute.help[0] == '\0' ? "" : ": ", attribute.help);
    }
}

// All kinds of nodes that do something, or those of one name.
static int help_nodes(const char *name) {
    Output *output = new_output();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    PetriNodeKind kind;
    const char *area = "";
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        if (name != NULL && strcmp(kind.name, name) != 0) {
            continue;
        }
        if (strcmp(kind.area, area) != 0) {
            output_format(output, "%s%s\n", area[0] == '\0' ? "" : "\n", kind.area);
            area = kind.area;
        }
        output_format(output, "  !%s: %s\n", kind.name, kind.help);
        write_attributes(output, i);
    }
    return end_output(output);
}

// Whether a topic is a kind of node, `!name` or `name`; *name is then without the mark.
static bool is_node(const char *topic, const char **name) {
    PetriNodeKind kind;
    *name = topic[0] == '!' ? topic + 1 : topic;
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        if (strcmp(kind.name, *name) == 0) {
            return true;
        }
    }
    return false;
}

int help_version(void) {
    Output *output = new_output();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    output_format(output, "petri %s\n", petri_version());
    return end_output(output);
}

static int help_topic(const char *topic) {
    if (strcmp(topic, "builtins") == 0) {
        return help_builtins();
    }
    const char *node = NULL;
    if (strcmp(topic, "nodes") == 0) {
        return help_nodes(NULL);
    }
    if (command_find(topic) == NULL && is_node(topic, &node)) {
        return help_nodes(node);
    }
    if (strcmp(topic, "version") == 0) {
        return help_version();
    }
    const Command *command = command_find(topic);
    if (command != NULL) {
        return help_for(command);
    }
    message("there is no help on '%s'; 'petri help' lists the commands", topic);
    return STATUS_USAGE;
}

static int help_run(const Host *host, int argc, char **argv) {
    (void)host;
    Args args = args_start(&HELP_COMMAND, argc, argv);
    const char *topic = NULL;
    for (int id = args_next(&args); id != ARG_END; id = args_next(&args)) {
        if (id == ARG_HELP) {
            return help_for(&HELP_COMMAND);
        }
        if (id == ARG_WRONG) {
            return STATUS_USAGE;
        }
        if (topic != NULL) {
            message("help is given on one thing at a time; '%s' is too many", args.value);
            return STATUS_USAGE;
        }
        topic = args.value;
    }
    return topic == NULL ? help_overview() : help_topic(topic);
}

static const OptionSpec HELP_OPTIONS[] = {{0}};

const Command HELP_COMMAND = {
    .name = "help",
    .operands = "[COMMAND | builtins | nodes | !NODE]",
    .summary = "tell what the commands do, or list the built-in functions",
    .details =
        "Tells what the commands do, what options one of them has, what functions scripts can call, or what nodes\n"
        "and attributes drive particles and draw.",
    .options = HELP_OPTIONS,
    .run = help_run,
};
