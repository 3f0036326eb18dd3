// help.c: `.help`: commands, built-in functions, kinds of nodes with their attributes.
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "cli/help.h"
#include "cli/table.h"
#include "cli/topics.h"
#include "repl/repl.h"

static void list_commands(Repl *repl) {
    Table table = table_new(2);
    for (const ReplCommand *command = REPL_COMMANDS; command->name != NULL; command++) {
        char head[64];
        snprintf(head, sizeof head, "%s%s%s", command->name, command->operands[0] == '\0' ? "" : " ",
                 command->operands);
        table_add(&table, head);
        table_add(&table, command->help);
    }
    table_write(&table, &repl->output);
    table_free(&table);
    output_format(
        &repl->output,
        "Numbers may be expressions: .resolution 1/240. Anything else is of the language. The value of an expression\n"
        "is printed; let, func, import and nodes stay. Lines indented below the first belong to it, and Up goes back "
        "to\n"
        "them; an empty line ends them. Ctrl-C stops what is being done. Try .help builtins, .help nodes,\n"
        ".help !particle, .help polar, .help tempo.\n");
}

static void list_builtins(Repl *repl) {
    Table table = table_new(2);
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        char head[128];
        snprintf(head, sizeof head, "%s(%s)", builtin.name, builtin.parameters);
        table_add(&table, head);
        table_add(&table, builtin.help);
    }
    table_write(&table, &repl->output);
    table_free(&table);
}

static void list_nodes(Repl *repl) {
    Table table = table_new(3);
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        char head[80];
        snprintf(head, sizeof head, "!%s", kind.name);
        table_add(&table, head);
        table_add(&table, kind.area);
        table_add(&table, kind.help);
    }
    table_write(&table, &repl->output);
    table_free(&table);
}

static bool tell_command(Repl *repl, const char *name) {
    for (const ReplCommand *command = REPL_COMMANDS; command->name != NULL; command++) {
        if (strcmp(command->name + (name[0] != '.'), name) == 0) {
            output_format(&repl->output, "%s%s%s\n    %s\n", command->name, command->operands[0] == '\0' ? "" : " ",
                          command->operands, command->help);
            return true;
        }
    }
    return false;
}

static bool tell_nearest(Repl *repl, const char *topic) {
    const char *nearest = NULL;
    size_t best = SIZE_MAX;
    for (const ReplCommand *command = REPL_COMMANDS; command->name != NULL; command++) {
        nearest = is_nearer(topic, command->name + (topic[0] != '.'), &best) ? command->name : nearest;
    }
    const char *word = topics_nearest(topic, &best);
    nearest = word != NULL ? word : nearest;
    return nearest == NULL ? repl_fail(repl, "there is no help on '%.40s'; .help lists the commands", topic)
                           : repl_fail(repl, "there is no help on '%.40s', did you mean '%s'?", topic, nearest);
}

bool repl_help(Repl *repl, const char *topic) {
    if (topic[0] == '\0') {
        list_commands(repl);
    } else if (strcmp(topic, "builtins") == 0) {
        list_builtins(repl);
    } else if (strcmp(topic, "nodes") == 0) {
        list_nodes(repl);
    } else {
        bool found = topic[0] != '.' && topics_tell(&repl->output, topic);
        found = (topic[0] != '!' && tell_command(repl, topic)) || found;
        return found || tell_nearest(repl, topic);
    }
    return true;
}

bool help_prompt(Output *output, const char *name) {
    for (const ReplCommand *command = REPL_COMMANDS; command->name != NULL; command++) {
        if (strcmp(command->name, name) == 0) {
            output_format(output, "%s %s\n    at the prompt of petri repl: %s\n", name, command->operands,
                          command->help);
            return true;
        }
    }
    return false;
}
