// commands.c: looks up and executes commands; implements .help, .time and .quit.
#include "base/clock.h"
#include "cli/help.h"
#include "cli/text_table.h"
#include "prompt/prompt.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const PromptCommand *prompt_command_at(size_t index) {
    static const PromptCommand *const groups[] = {STEP_COMMANDS,   BREAK_COMMANDS,   PRINT_COMMANDS, WHY_COMMANDS,
                                                  MOVE_COMMANDS,   PICTURE_COMMANDS, SET_COMMANDS,   HOST_COMMANDS,
                                                  RECALL_COMMANDS, OTHER_COMMANDS};
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++) {
        for (const PromptCommand *command = groups[i]; command->name; command++)
            if (index-- == 0)
                return command;
    }
    return NULL;
}

const PromptCommand *prompt_find_command(const char *name, size_t length) {
    const PromptCommand *command;
    size_t bare = length > 0 && name[0] == '.' ? 0 : 1;
    for (size_t i = 0; (command = prompt_command_at(i)); i++)
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

// The commands that an empty input repeats, with their short names.
static const struct {
    const char *name;
    const char *command;
} short_names[] = {{".s", ".step"}, {".b", ".back"}, {".u", ".until"}, {".r", ".run"}};

// Returns the command with this name, or the only command that begins with it. Otherwise returns NULL and adds the
// names of the commands that begin with it to `candidates`.
static const PromptCommand *match_command(const char *name, TextList *candidates) {
    const PromptCommand *command, *found = prompt_find_command(name, strlen(name));
    for (size_t i = 0; i < sizeof short_names / sizeof short_names[0] && !found; i++)
        if (strcmp(short_names[i].name, name) == 0)
            found = prompt_find_command(short_names[i].command, strlen(short_names[i].command));
    if (found || name[1] == '\0')
        return found;
    for (size_t i = 0; (command = prompt_command_at(i)); i++)
        if (strncmp(command->name, name, strlen(name)) == 0) {
            texts_add(candidates, command->name);
            found = command;
        }
    return candidates->count == 1 ? found : NULL;
}

static void list_commands(Prompt *prompt, Text *text) {
    SCOPED_TEXT_TABLE table = text_table_new(2);
    const PromptCommand *command;
    for (size_t i = 0; (command = prompt_command_at(i)); i++) {
        char head[64];
        snprintf(head, sizeof head, "%s%s%s", command->name, command->operands[0] == '\0' ? "" : " ",
                 command->operands);
        text_table_add(&table, head);
        text_table_add(&table, command->help);
    }
    table_text(&table, text);
    text_add_format(
        text,
        "A command can be shortened to letters with which no other command begins, as in .part; .s, .b, .u and "
        ".r are .step, .back, .until and .run. "
        "A number can be given as an expression, as in '.resolution 1/240'. Input that is not a command is "
        "code: the value of an expression is printed; let, func, import and nodes are kept. %sTry '.help "
        "builtins', '.help nodes', '.help !particle', '.help polar' or '.help tempo'.\n",
        prompt->host->keys_help ? prompt->host->keys_help : "");
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

static bool suggest_topic(Prompt *prompt, const char *topic) {
    StrNearest nearest = str_nearest(str_from(topic));
    const PromptCommand *command;
    for (size_t i = 0; (command = prompt_command_at(i)); i++)
        if (nearest_offer(&nearest, command->name + (topic[0] != '.')))
            nearest.found = str_from(command->name);
    topics_offer(&nearest);
    return !nearest.found.bytes
               ? prompt_fail(prompt, "no help for '%.40s'; run .help for a list", topic)
               : prompt_fail(prompt, "no help for '%.40s'; did you mean '%s'?", topic, nearest.found.bytes);
}

static bool add_help(Prompt *prompt, Text *text, const char *topic) {
    if (topic[0] == '\0') {
        list_commands(prompt, text);
    } else if (strcmp(topic, "builtins") == 0) {
        list_builtins(text);
    } else if (strcmp(topic, "nodes") == 0) {
        list_nodes(text);
    } else {
        bool found = topic[0] != '.' && topics_print(text, topic);
        TextList candidates = {0};
        const PromptCommand *command =
            topic[0] == '.' ? match_command(topic, &candidates) : prompt_find_command(topic, strlen(topic));
        texts_free(&candidates);
        if (command) {
            text_add_format(text, "%s%s%s\n    %s\n", command->name, command->operands[0] == '\0' ? "" : " ",
                            command->operands, command->help);
        }
        return found || command || suggest_topic(prompt, topic);
    }
    return true;
}

static bool run_help(Prompt *prompt, const char *topic) {
    SCOPED_TEXT text = {0};
    bool found = add_help(prompt, &text, topic);
    help_wrap(prompt->output, &text, prompt->host->columns ? prompt->host->columns(prompt) : 80);
    return found;
}

static void note_seconds(Prompt *prompt, double seconds, const char *more) {
    static const struct {
        double unit;
        const char *name;
    } units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}};
    size_t i = 0;
    while (i < 3 && seconds < units[i].unit)
        i++;
    prompt_note(prompt, "%.3g %s%s", seconds / units[i].unit, units[i].name, more);
}

// Prints the shortest time of many evaluations, because other programs can only slow an evaluation down.
static bool time_expression(Prompt *prompt, const char *expression) {
    double best = INFINITY, start = clock_seconds();
    int64_t count = 0;
    PetriStatus status = PETRI_OK;
    prompt_busy(prompt);
    while (status == PETRI_OK && count < 100000 && (count < 3 || clock_seconds() - start < 0.2)) {
        PetriEvaluation result;
        status = petri_evaluate(prompt->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
        best = status == PETRI_OK ? fmin(best, result.seconds) : best;
        count++;
    }
    prompt_idle(prompt);
    if (prompt_status(prompt, status))
        note_seconds(prompt, best, ", the fastest of several evaluations");
    return status == PETRI_OK;
}

static bool run_time(Prompt *prompt, const char *rest) {
    if (rest[0] != '.' || (rest[1] >= '0' && rest[1] <= '9') || rest[1] == '.')
        return time_expression(prompt, rest);
    double start = clock_seconds();
    prompt_command(prompt, rest);
    double seconds = clock_seconds() - start;
    note_seconds(prompt, seconds, "");
    return !prompt->failed;
}

static bool run_quit(Prompt *prompt, const char *rest) {
    (void)rest;
    prompt->quit = true;
    return true;
}

static bool run_drop(Prompt *prompt, const char *rest) {
    if (rest[0] != '\0' && strcmp(rest, "all") != 0)
        return prompt_fail(prompt, "invalid argument: '%s'; .drop removes nodes, and .drop all removes nodes and names",
                           rest);
    uint32_t count = petri_prompt_clear(prompt->session, rest[0] != '\0');
    prompt_note(prompt, "%" PRIu32 " statement%s removed", count, count == 1 ? "" : "s");
    return true;
}

// The commands of hosts, except .drop.
const PromptCommand PICTURE_COMMANDS[] = {
    {".plot", "EXPR [N]", "an expression", "plot EXPR, a number or vector, over the last N frames (default: 60)", NULL,
     COMPLETE_LANGUAGE},
    {".show", "", NULL, "show the frame's picture in the terminal", NULL, COMPLETE_LANGUAGE},
    {0},
};

const PromptCommand HOST_COMMANDS[] = {
    {".drop", "[all]", NULL, "remove nodes added at the prompt; with `all`, also names", run_drop, COMPLETE_LANGUAGE},
    {".load", "FILE", "a file", "load another script and start with an empty state", NULL, COMPLETE_FILES},
    {".reload", "", NULL, "reload the script; keep state and frame number", NULL, COMPLETE_LANGUAGE},
    {".save", "FILE", "a file", "write the state to a file", NULL, COMPLETE_FILES},
    {".restore", "FILE", "a file", "load the state from a file and restart the history", NULL, COMPLETE_FILES},
    {".archive", "FILE", "a file", "write an archive of all later frames, for petri archive verify", NULL,
     COMPLETE_FILES},
    {".record", "FILE [K]", "a file", "write every K-th frame (default: 1), or NAME.session, as a test for petri test",
     NULL, COMPLETE_FILES},
    {0},
};

const PromptCommand OTHER_COMMANDS[] = {
    {".time", "EXPR", "an expression, or a command", "measure the time of an expression or a command", run_time,
     COMPLETE_LANGUAGE},
    {".help", "[TOPIC]", NULL, "show help for a topic; `builtins` lists all functions, `nodes` all nodes", run_help,
     COMPLETE_TOPICS},
    {".quit", "", NULL, "quit", run_quit, COMPLETE_LANGUAGE},
    {0},
};

static void report_ambiguous(Prompt *prompt, const char *name, const TextList *candidates) {
    SCOPED_TEXT list = {0};
    for (size_t i = 0; i < candidates->count; i++)
        text_add_format(&list, "%s%s", i == 0 ? "" : ", ", candidates->items[i]);
    prompt_fail(prompt, "ambiguous command: '%.40s' begins %s", name, list.bytes);
}

static void report_unknown(Prompt *prompt, const char *name) {
    StrNearest nearest = str_nearest(str_from(name));
    const PromptCommand *command;
    for (size_t i = 0; (command = prompt_command_at(i)); i++)
        nearest_offer(&nearest, command->name);
    if (nearest.found.bytes)
        prompt_fail(prompt, "no such command: '%.40s'; did you mean '%s'?", name, nearest.found.bytes);
    else
        prompt_fail(prompt, "no such command: '%.40s'; run .help for a list", name);
}

// Runs the host's function for a command or, if it has none, the prompt's own function.
static bool run_command(Prompt *prompt, const PromptCommand *command, const char *rest) {
    const PromptHostCommand *own = prompt->host->commands;
    while (own->name && strcmp(own->name, command->name) != 0)
        own++;
    if (own->name && !own->run)
        return prompt_fail(prompt, "%s %s", command->name, own->instead);
    if (!own->name && !command->run)
        return prompt_fail(prompt, "%s works only in 'petri repl'", command->name);
    return own->name ? own->run(prompt, rest) : command->run(prompt, rest);
}

// Keeps a stepping command for an empty input. A command that is repeated keeps its own text.
static void repeat_later(Prompt *prompt, const PromptCommand *command, const char *rest) {
    for (size_t i = 0; i < sizeof short_names / sizeof short_names[0]; i++) {
        SCOPED_TEXT line = {0};
        if (strcmp(short_names[i].command, command->name) != 0)
            continue;
        text_add_format(&line, "%s %s", command->name, rest);
        free(prompt->repeated);
        prompt->repeated = memory_strdup(line.bytes);
    }
}

// Runs a command whose operand is complete. In expressions, `_` is an earlier value.
static void run_with(Prompt *prompt, const PromptCommand *command, const char *rest) {
    SCOPED_TEXT operand = {0};
    bool is_name = command->complete == COMPLETE_FILES || command->complete == COMPLETE_TOPICS;
    text_add_c(&operand, is_name ? rest : "");
    repeat_later(prompt, command, rest);
    if ((!is_name && !recall_expand(prompt, rest, strlen(rest), &operand)) ||
        !run_command(prompt, command, operand.bytes))
        prompt->failed = true;
}

static const PromptCommand *find_command(const char *name, TextList *candidates) {
    const char *alias = bare_alias(name + 1, strlen(name + 1)); // accepts .exit and .q too
    return alias ? prompt_find_command(alias, strlen(alias)) : match_command(name, candidates);
}

const PromptCommand *prompt_command_of(const char *input) {
    if (input[0] != '.')
        return NULL;
    TextList candidates = {0};
    SCOPED_STRING name = memory_strndup(input, strcspn(input, " \t\n"));
    const PromptCommand *command = find_command(name, &candidates);
    texts_free(&candidates);
    return command;
}

void prompt_command(Prompt *prompt, const char *line) {
    size_t length = strcspn(line, " \t\n");
    SCOPED_STRING name = memory_strndup(line, length);
    SCOPED_STRING rest = argument_trimmed(line + length);
    TextList candidates = {0};
    const PromptCommand *command = find_command(name, &candidates);
    if (candidates.count > 1)
        report_ambiguous(prompt, name, &candidates);
    else if (!command)
        report_unknown(prompt, name);
    else if (command->operands[0] == '\0' && rest[0] != '\0')
        prompt_fail(prompt, "%s takes no arguments: '%.40s'", command->name, rest);
    else if (command->needed && rest[0] == '\0')
        prompt_fail(prompt, "%s needs %s", command->name, command->needed);
    else
        run_with(prompt, command, rest);
    texts_free(&candidates);
}
