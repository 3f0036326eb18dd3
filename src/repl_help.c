// repl_help.c: `.help`: commands, built-in functions, kinds of nodes with their attributes.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "repl.h"
#include "repl_table.h"

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
        "Anything else is of the language. The value of an expression is printed; let, func, import and nodes\n"
        "stay. Lines indented below the first belong to it; an empty line ends them. Ctrl-C stops what is\n"
        "being done. Try .help builtins, .help nodes, .help !particle, .help polar.\n");
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

static bool tell_builtin(Repl *repl, const char *name) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        if (strcmp(builtin.name, name) == 0) {
            output_format(&repl->output, "%s(%s)\n    %s\n", builtin.name, builtin.parameters, builtin.help);
            return true;
        }
    }
    return false;
}

static void tell_attributes(Repl *repl, size_t kind) {
    Table table = table_new(4);
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_attribute(kind, i, &attribute); i++) {
        char head[80], fallback[120] = "";
        snprintf(head, sizeof head, "    %s", attribute.name);
        if (attribute.fallback[0] != '\0') {
            snprintf(fallback, sizeof fallback, "default %s", attribute.fallback);
        }
        table_add(&table, head);
        table_add(&table, attribute.type);
        table_add(&table, fallback);
        table_add(&table, attribute.help);
    }
    table_write(&table, &repl->output);
    table_free(&table);
}

// A kind may belong to several areas, such as `!group`.
static bool tell_node(Repl *repl, const char *name) {
    PetriNodeKind kind;
    bool found = false;
    name += name[0] == '!';
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        if (strcmp(kind.name, name) == 0) {
            output_format(&repl->output, "!%s (%s): %s\n", kind.name, kind.area, kind.help);
            tell_attributes(repl, i);
            found = true;
        }
    }
    return found;
}

static bool tell_nearest(Repl *repl, const char *topic) {
    const char *nearest = NULL;
    size_t best = SIZE_MAX;
    PetriBuiltin builtin;
    PetriNodeKind kind;
    for (const ReplCommand *command = REPL_COMMANDS; command->name != NULL; command++) {
        nearest = is_nearer(topic, command->name + (topic[0] != '.'), &best) ? command->name : nearest;
    }
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        nearest = is_nearer(topic, builtin.name, &best) ? builtin.name : nearest;
    }
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        nearest = is_nearer(topic + (topic[0] == '!'), kind.name, &best) ? kind.name : nearest;
    }
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
        // One name may be a function and a node, such as random.
        bool found = topic[0] != '!' && topic[0] != '.' && tell_builtin(repl, topic);
        found = (topic[0] != '.' && tell_node(repl, topic)) || found;
        found = (topic[0] != '!' && tell_command(repl, topic)) || found;
        return found || tell_nearest(repl, topic);
    }
    return true;
}
