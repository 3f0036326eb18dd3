// complete_command.c: the command `petri complete`, which the completion scripts of shells call.
//
// The arguments are the words after `petri` on a command line, up to the cursor. It completes the last one. Each
// line of the output is a candidate for the whole word, a tab and a description. The lines `:files`, `:folders` and
// `:scripts` (also archives) mean that the shell completes such paths; `:nospace` means that candidates are not
// complete words.
#include "cli/args.h"
#include "cli/help.h"
#include "cli/options.h"
#include "cli/parameters.h"
#include "main/commands.h"

#include <stdio.h>
#include <string.h>

typedef struct Completion {
    Output *output;
    const char *word; // word to complete
    size_t kept;      // characters of the word before the completed part, such as those of `--color=`
    const Command *command;
    const char *script; // last operand before the word; NULL: none
} Completion;

static void offer(const Completion *completion, const char *name, const char *help) {
    const char *typed = completion->word + completion->kept;
    if (strncmp(name, typed, strlen(typed)) == 0)
        output_format(completion->output, "%.*s%s\t%s\n", (int)completion->kept, completion->word, name, help);
}

static void offer_commands(const Completion *completion) {
    for (const CommandRow *row = COMMANDS; row->listed; row++)
        offer(completion, row->name, row->command->summary);
}

// Offers the words that select a part of the command. Returns false if there are none.
static bool offer_parts(const Completion *completion) {
    bool offered = false;
    for (const Command *const *part = completion->command->parts; part && *part; part++) {
        const char *word = strchr((*part)->name, ' ') + 1;
        if (command_part(completion->command, word) == *part) {
            offer(completion, word, (*part)->summary);
            offered = true;
        }
    }
    return offered;
}

static void offer_topics(const Completion *completion) {
    PetriBuiltin builtin;
    PetriNodeKind kind;
    offer(completion, "builtins", "list all functions");
    offer(completion, "nodes", "list all nodes with their attributes");
    offer(completion, "version", "print the version");
    offer_commands(completion);
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        offer(completion, builtin.name, builtin.help);
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++)
        offer(completion, kind.name, kind.help);
    for (size_t i = 0; TOPICS[i].word; i++)
        offer(completion, TOPICS[i].word, TOPICS[i].help);
}

static void offer_options(const Completion *completion) {
    char name[64];
    for (const OptionSpec *option = command_options(completion->command); option->name; option++) {
        snprintf(name, sizeof name, "--%s", option->name);
        offer(completion, name, option->help);
        snprintf(name, sizeof name, "-%c", option->letter);
        if (option->letter != '\0')
            offer(completion, name, option->help);
    }
    offer(completion, "--help", "show help for the command");
}

// Offers the parameters of the script as `NAME=`. Loads the script without files and with little work, because a user
// who presses Tab does not expect that it runs.
static void offer_parameters(const Completion *completion) {
    PetriOptions wanted = petri_default_options();
    wanted.no_files = true;
    wanted.work_limit = 10000000;
    PetriSession *session = petri_open(&wanted);
    PetriParameter parameter;
    if (session && petri_load(session, completion->script) == PETRI_OK) {
        output_format(completion->output, ":nospace\n");
        for (size_t i = 0; petri_parameter(session, i, &parameter, sizeof parameter) && parameter.settable; i++) {
            SCOPED_TEXT name = {0}, help = {0};
            text_add_format(&name, "%s=", parameter.name);
            parameter_describe(&help, &parameter);
            text_add_format(&help, "%s%s", parameter.comment[0] == '\0' ? "" : ": ", parameter.comment);
            offer(completion, name.bytes, help.bytes);
        }
    }
    petri_close(&session);
}

static void offer_values(Completion *completion, const OptionSpec *option) {
    bool is_list = strcmp(option->value, "LIST") == 0;
    const char *comma = is_list ? strrchr(completion->word + completion->kept, ',') : NULL;
    if (comma)
        completion->kept = (size_t)(comma + 1 - completion->word);
    for (int i = 0; option->words && option->words[i]; i++)
        offer(completion, option->words[i], "");
    if (option->letter == 'D' && completion->script)
        offer_parameters(completion);
    output_format(completion->output, "%s",
                  is_list                                                                      ? ":nospace\n"
                  : strcmp(option->value, "FILE") == 0 || strcmp(option->value, "SOCKET") == 0 ? ":files\n"
                  : strcmp(option->value, "DIR") == 0                                          ? ":folders\n"
                                                                                               : "");
}

// Completes the last of `count` words, those after the command. args_next reports an option that still expects its
// value as an error. The scripts of the shells discard messages.
static void complete_argument(Completion *completion, int count, char **words) {
    Args args = {.command = completion->command, .argc = count - 1, .argv = words};
    const OptionSpec *expecting = NULL; // the option of which the last word is the value
    for (int id = ARG_OPERAND; id != ARG_END;) {
        args.option = NULL;
        id = args_next(&args);
        if (id == ARG_OPERAND)
            completion->script = args.value;
        else if (id == ARG_INVALID && args.option && args.option->value && !args.value)
            expecting = args.option;
    }
    args.argc = count;
    if (expecting) {
        offer_values(completion, expecting);
    } else if (completion->word[0] != '-' || args.operands_only) {
        output_format(completion->output, ":scripts\n");
    } else if (args_next(&args) == ARG_OPTION && args.value) {
        completion->kept = (size_t)(args.value - completion->word);
        offer_values(completion, args.option);
    } else {
        offer_options(completion);
    }
}

static int complete_run(const CommandContext *context, Options *options) {
    (void)context;
    if (options->argc == 0) {
        message("no words given; 'petri complete' is for the completion scripts of shells");
        return STATUS_USAGE;
    }
    const CommandRow *named = options->argc > 1 ? command_find(options->argv[0]) : NULL;
    const Command *command = named ? named->command : &RUN_COMMAND;
    const Command *part = options->argc > 2 ? command_part(command, options->argv[1]) : NULL;
    int skipped = (named ? 1 : 0) + (part ? 1 : 0);
    Completion completion = {
        .output = help_begin(), .word = options->argv[options->argc - 1], .command = part ? part : command};
    if (options->argc == 1 && completion.word[0] != '-')
        offer_commands(&completion);
    if (completion.command == &HELP_COMMAND)
        offer_topics(&completion);
    else if (options->argc != 2 || !offer_parts(&completion))
        complete_argument(&completion, options->argc - skipped, options->argv + skipped);
    return help_end(completion.output);
}

const Command COMPLETE_COMMAND = {.name = "complete", .parses_arguments = true, .run = complete_run};
