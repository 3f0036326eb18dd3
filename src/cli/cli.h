// cli.h: what the commands of `petri` share: exit codes, messages, the table of commands.
#ifndef PETRI_SRC_CLI_H
#define PETRI_SRC_CLI_H

#include "base/str.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct Args;
struct Mail;
struct Options;
struct PetriRanks;
struct PlotSupport;

enum { STATUS_DONE = 0, STATUS_FAILED = 1, STATUS_USAGE = 2, STATUS_SIGNAL = 128 }; // plus its number

// Which commands an option is for.
// clang-format off
enum { FOR_RUN = 1, FOR_RENDER = 2, FOR_VIEW = 4, FOR_REPL = 8, FOR_TEST = 16, FOR_CHECK = 32, FOR_GOLDEN = 64,
       FOR_SWEEP = 128, FOR_FMT = 256, FOR_LSP = 512, FOR_LINK = 1024, FOR_OPEN = 2048 };
// clang-format on

// One option.
typedef struct OptionSpec {
    unsigned commands; // FOR_…
    const char *name;  // without the dashes
    char letter;       // short form, or 0
    const char *value; // how help names the value; NULL for a flag
    const char *help;
    size_t field; // where it is in Options
    bool (*read)(const struct Args *args, void *field);
    int64_t min; // of whole numbers
    int64_t max;
    const char *const *words; // to choose from (some, with commas, if the value is a LIST), ended by NULL
} OptionSpec;

// All options; the last has no name.
extern const OptionSpec OPTIONS[];

// What main found out about the process, for all commands.
typedef struct CommandContext CommandContext;
struct CommandContext {
    size_t stack_bytes;                     // C stack that evaluation may use
    const char *program;                    // path of this program, from wherever it is started
    const char *invoked_as;                 // … as the user called it, for hints
    const char *cpu;                        // PetriOptions.cpu
    const struct PlotSupport *plot_support; // what petri sweep takes libraries for; NULL: petri-pictures has it
    int (*run_lsp)(const CommandContext *context, struct Options *options); // petri lsp; NULL: petri-lsp has it
    const struct PetriRanks *ranks; // the processes that share the work, as mpirun has started them; NULL: this alone
    const struct Mail *channel;     // … between them; NULL likewise
    void (*leave_ranks)(void);      // … are no longer waited for, after a signal; a signal handler may call it
};

typedef struct Command {
    const char *name;
    const char *operands; // how usage names what follows the options
    const char *summary;  // one line, for the list of commands
    const char *details;  // a few sentences, for the command's own help
    const char *examples; // lines to try, for its own help; NULL: none
    unsigned options;     // FOR_…
    const char
        *missing_operand; // what is said where there is no operand; NULL: none is needed, or the command says it itself
    const char *no_stdin; // what is said of `-`; NULL: it stands for a script on standard input
    const char *second_operand_error; // what is said of a second operand, if it is not of scripts
    bool accepts_many;                // takes many scripts and folders
    bool live;                        // follows the wall clock and goes on until it is stopped
    bool parses_arguments;            // reads the words of the command line itself
    int (*run)(const CommandContext *context, struct Options *options); // returns the exit status
} Command;

extern const Command RUN_COMMAND;
extern const Command RENDER_COMMAND;
extern const Command REPL_COMMAND;
extern const Command SWEEP_COMMAND;
extern const Command VIEW_COMMAND;
extern const Command TEST_COMMAND;
extern const Command CHECK_COMMAND;
extern const Command FMT_COMMAND;
extern const Command LSP_COMMAND;
extern const Command SEND_COMMAND;
extern const Command LINK_COMMAND;
extern const Command OPEN_COMMAND;
extern const Command NEW_COMMAND;
extern const Command HELP_COMMAND;

// Reads the words that follow a command's name and runs it; returns the exit status.
int command_run(const Command *command, const CommandContext *context, int argc, char **argv);

// Prints a command's own help on standard output; returns the exit status.
int help_for(const Command *command);
// `commands` are in the order of help, ended by NULL.
int help_overview(const Command *const *commands);
int help_version(void);

// Calls the handler for a signal, unless that is SIGHUP and nohup has it ignored.
void signal_catch(int number, void (*handler)(int), int flags);
// Writes `petri: text` and a newline to standard error.
__attribute__((format(printf, 1, 2))) void message(const char *format, ...);

// Looks for what a mistyped word was meant to be, near enough to be a slip of the hand. `found` is of C, too.
StrNearest nearest_start(const char *word);
// True if the name is nearer than those before it.
bool nearest_offer(StrNearest *nearest, const char *name);

#endif
