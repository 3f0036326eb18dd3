// commands.c: looks up and executes commands; implements .help, .time and .quit.
#include "base/clock.h"
#include "cli/help.h"
#include "cli/text_table.h"
#include "repl/repl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const ReplCommand *repl_command_at(size_t index) {
    static const ReplCommand *const groups[] = {STEP_COMMANDS, PRINT_COMMANDS,  WHY_COMMANDS,    PLOT_COMMANDS,
                                                SET_COMMANDS,  SCRIPT_COMMANDS, RECORD_COMMANDS, OTHER_COMMANDS};
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++) {
        for (const ReplCommand *command = groups[i]; command->name; command++)
            if (index-- == 0)
                return command;
    }
    return NULL;
}

const ReplCommand *repl_find_command(const char *name, size_t length) {
    const ReplCommand *command;
    size_t bare = length > 0 && name[0] == '.' ? 0 : 1;
    for (size_t i = 0; (command = repl_command_at(i)); i++)
        if (strlen(command->name + bare) == length && memcmp(command->name + bare, name, length) == 0)
            break;
    return command;
}

// Common words for quitting and for help. `?` is never code, because the language does not use it.
static const struct {
    const char *word;
    const char *command;
} bare_words[] = {
    {"help", ".help"}, {"?", ".help"}, {"h", ".help"}, {"quit", ".quit"}, {"exit", ".quit"}, {"q", ".quit"},
};

enum { BARE_COUNT = sizeof bare_words / sizeof bare_words[0] };

const char *bare_alias(const char *name, size_t length) {
    for (size_t i = 0; i < BARE_COUNT; i++)
        if (str_equal(str_from(bare_words[i].word), (Str){name, length}))
            return bare_words[i].command;
    return NULL;
}

static void list_commands(Text *text) {
    SCOPED_TEXT_TABLE table = text_table_new(2);
    const ReplCommand *command;
    for (size_t i = 0; (command = repl_command_at(i)); i++) {
        char head[64];
        snprintf(head, sizeof head, "%s%s%s", command->name, command->operands[0] == '\0' ? "" : " ",
                 command->operands);
        text_table_add(&table, head);
        text_table_add(&table, command->help);
    }
    table_text(&table, text);
    text_add_c(text,
               "A number can be given as an expression, as in '.resolution 1/240'. Input that is not a command is "
               "code: the value of an expression is printed; let, func, import and nodes are kept. Indented lines "
               "belong to the line above them; Up returns to earlier lines, and an empty line ends the block. Ctrl-C "
               "interrupts. Try '.help builtins', '.help nodes', '.help !particle', '.help polar' or '.help tempo'.\n");
}

static void list_builtins(Text *text) {
    SCOPED_TEXT_TABLE table = text_table_new(2);
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++) {
        char head[128];
        snprintf(head, sizeof head, "%s(%s)", builtin.name, builtin.parameters);
        text_table_add(&table, head);
        text_table_add(&table, builtin.help);
    }
    table_text(&table, text);
}

static void list_nodes(Text *text) {
    SCOPED_TEXT_TABLE table = text_table_new(3);
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        char head[80];
        snprintf(head, sizeof head, "!%s", kind.name);
        text_table_add(&table, head);
        text_table_add(&table, kind.area);
        text_table_add(&table, kind.help);
    }
    table_text(&table, text);
}

static bool suggest_topic(Repl *repl, const char *topic) {
    StrNearest nearest = str_nearest(str_from(topic));
    const ReplCommand *command;
    for (size_t i = 0; (command = repl_command_at(i)); i++)
        if (nearest_offer(&nearest, command->name + (topic[0] != '.')))
            nearest.found = str_from(command->name);
    topics_offer(&nearest);
    return !nearest.found.bytes
               ? repl_fail(repl, "no help for '%.40s'; run .help for a list", topic)
               : repl_fail(repl, "no help for '%.40s'; did you mean '%s'?", topic, nearest.found.bytes);
}

static bool add_help(Repl *repl, Text *text, const char *topic) {
    if (topic[0] == '\0') {
        list_commands(text);
    } else if (strcmp(topic, "builtins") == 0) {
        list_builtins(text);
    } else if (strcmp(topic, "nodes") == 0) {
        list_nodes(text);
    } else {
        bool found = topic[0] != '.' && topics_print(text, topic);
        const ReplCommand *command = repl_find_command(topic, strlen(topic));
        if (command) {
            text_add_format(text, "%s%s%s\n    %s\n", command->name, command->operands[0] == '\0' ? "" : " ",
                            command->operands, command->help);
        }
        return found || command || suggest_topic(repl, topic);
    }
    return true;
}

static bool run_help(Repl *repl, const char *topic) {
    SCOPED_TEXT text = {0};
    bool found = add_help(repl, &text, topic);
    help_write(&repl->output, &text);
    return found;
}

static void note_seconds(Repl *repl, double seconds, const char *more) {
    static const struct {
        double unit;
        const char *name;
    } units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}};
    size_t i = 0;
    while (i < 3 && seconds < units[i].unit)
        i++;
    repl_note(repl, "%.3g %s%s", seconds / units[i].unit, units[i].name, more);
}

// Prints the shortest time of many evaluations, because other programs can only slow an evaluation down.
static bool time_expression(Repl *repl, const char *expression) {
    double best = INFINITY, start = clock_seconds();
    int64_t count = 0;
    PetriStatus status = PETRI_OK;
    repl_busy(repl);
    while (status == PETRI_OK && count < 100000 && (count < 3 || clock_seconds() - start < 0.2)) {
        PetriEvaluation result;
        status = petri_evaluate(repl->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
        best = status == PETRI_OK ? fmin(best, result.seconds) : best;
        count++;
    }
    repl_idle(repl);
    if (repl_status(repl, status))
        note_seconds(repl, best, ", the fastest of several evaluations");
    return status == PETRI_OK;
}

static bool run_time(Repl *repl, const char *rest) {
    if (rest[0] != '.' || (rest[1] >= '0' && rest[1] <= '9') || rest[1] == '.')
        return time_expression(repl, rest);
    double start = clock_seconds();
    repl_command(repl, rest);
    double seconds = clock_seconds() - start;
    note_seconds(repl, seconds, "");
    return !repl->failed;
}

static bool run_quit(Repl *repl, const char *rest) {
    (void)rest;
    repl->quit = true;
    return true;
}

const ReplCommand OTHER_COMMANDS[] = {
    {".time", "EXPR", "an expression, or a command", "measure the time of an expression or a command", run_time,
     COMPLETE_LANGUAGE},
    {".help", "[TOPIC]", NULL, "show help for a topic; `builtins` lists all functions, `nodes` all nodes", run_help,
     COMPLETE_TOPICS},
    {".quit", "", NULL, "quit", run_quit, COMPLETE_LANGUAGE},
    {0},
};

static void report_unknown(Repl *repl, const char *name) {
    StrNearest nearest = str_nearest(str_from(name));
    const ReplCommand *command;
    for (size_t i = 0; (command = repl_command_at(i)); i++)
        nearest_offer(&nearest, command->name);
    if (nearest.found.bytes)
        repl_fail(repl, "no such command: '%.40s'; did you mean '%s'?", name, nearest.found.bytes);
    else
        repl_fail(repl, "no such command: '%.40s'; run .help for a list", name);
}

void repl_command(Repl *repl, const char *line) {
    size_t length = strcspn(line, " \t\n");
    SCOPED_STRING name = memory_strndup(line, length);
    SCOPED_STRING rest = argument_trimmed(line + length);
    const char *alias = bare_alias(name + 1, length - 1); // accepts .exit and .q too
    const ReplCommand *command = alias ? repl_find_command(alias, strlen(alias)) : repl_find_command(name, length);
    if (!command)
        report_unknown(repl, name);
    else if (command->operands[0] == '\0' && rest[0] != '\0')
        repl_fail(repl, "%s takes no arguments: '%.40s'", name, rest);
    else if (command->needed && rest[0] == '\0')
        repl_fail(repl, "%s needs %s", command->name, command->needed);
    else if (!command->run(repl, rest))
        repl->failed = true;
}
