// cli.h: common declarations of all commands: exit codes, messages, options and the table of commands.
#pragma once

#include "base/str.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct Args;
struct MpiChannel;
struct Options;
struct PetriRanks;

// Exit codes. After a signal, the exit code is STATUS_SIGNAL plus the number of the signal.
enum { STATUS_DONE = 0, STATUS_FAILED = 1, STATUS_USAGE = 2, STATUS_SIGNAL = 128 };

// The last message of a run with STATUS_FAILED whose frames are complete, although a module has a syntax error.
// `petri test` compares the output of such a run.
#define BROKEN_MODULE_MESSAGE "a module has syntax errors; its names are null"

// An option in the list of a command (option_groups.h).
typedef struct OptionSpec {
    const char *name;  // without the dashes
    char letter;       // letter of the short form, such as o for -o; 0: none
    const char *value; // name of the value in help; NULL: the option takes no value
    const char *help;
    bool own;     // true if the field is in Options.own, false if it is in Options
    size_t field; // offset of the field
    // Parses args->value and stores it in `field`. Returns false after a message.
    bool (*read)(const struct Args *args, void *field);
    int64_t min; // smallest value of an integer; for --quiet, --verbose, --debug and --trace: the level
    int64_t max; // largest value of an integer
    // Allowed values, then a null pointer; NULL: any value. If `value` is "LIST", the argument is a list of these
    // words, separated by commas.
    const char *const *words;
    bool is_list;        // true if the field is a TextList in Options.own, which options_free frees
    bool not_in_goldens; // run: true if a golden must not contain the option, because tests write no files
    bool ends_show;      // run: true if the option requests text or files, so that --show has no effect
} OptionSpec;

// The options of a command.
typedef struct OptionTable {
    const OptionSpec *rows;   // in the order of help, then one without a name
    size_t own_size;          // size of the struct Options.own, in bytes; 0: none
    const void *own_defaults; // initial value of this struct; NULL: zeros
} OptionTable;

// A command that users confuse with others, and its options.
typedef struct SimilarCommand {
    const char *name;
    const OptionTable *options;
} SimilarCommand;

// The environment of a command, set up by main.
typedef struct CommandContext {
    size_t stack_bytes;               // size of the C stack that evaluation can use, in bytes
    const char *program;              // path of this program, valid in any working directory
    const char *invoked_as;           // argv[0], for hints that show commands
    const char *cpu;                  // PetriTuning.cpu
    const SimilarCommand *similar;    // for hints about unknown options, then one without a name; NULL: no hints
    const struct PetriRanks *ranks;   // the processes (ranks) that mpirun has started; NULL: a single process
    const struct MpiChannel *channel; // messages between the ranks; NULL: a single process
    void (*leave_ranks)(void);        // stops waiting for the other ranks; can be called by a signal handler
} CommandContext;

typedef struct Command Command;
struct Command {
    const char *name;                 // may be two words, such as "archive info"
    const char *operands;             // operands as shown in the usage line
    const char *summary;              // one line, for the list of commands
    const char *details;              // a few sentences, for the command's help
    const char *examples;             // example command lines for the help; NULL: none
    const OptionTable *options;       // NULL: no options
    const char *missing_operand;      // message if no operand is given; NULL: not checked before `run`
    const char *no_stdin;             // message if the operand is `-`; NULL: `-` means standard input
    const char *second_operand_error; // message format for a second operand; NULL: it is reported as a second script
    bool accepts_many;                // true if the command accepts several scripts and folders
    const char *const *suffixes;      // of files in folders that are operands like scripts, then NULL; NULL: none
    bool accepts_expressions;         // true if operands after the script are expressions (Options.expressions)
    bool accepts_two;                 // true if the command accepts a second operand (Options.second)
    bool live;             // true if the command, by default, follows the wall clock and runs until it is stopped
    bool parses_arguments; // true if `run` parses argv itself
    // Returns true if a command line, which ends with NULL, needs petri-pictures to read or write an archive or to
    // draw. NULL: none does.
    bool (*needs_pictures)(char *const *words);
    int (*run)(const CommandContext *context, struct Options *options); // returns the exit status
    // Commands that the help of this command also explains, then NULL; NULL: none. A part that is named `NAME WORD`,
    // where NAME is the name of this command, is executed if WORD is the first operand.
    const Command *const *parts;
};

extern const Command RUN_COMMAND, VIEW_COMMAND, RENDER_COMMAND, REPL_COMMAND, SWEEP_COMMAND, TRUST_COMMAND,
    TEST_COMMAND, DIFF_COMMAND;
extern const Command CHECK_COMMAND, FMT_COMMAND, LSP_COMMAND, LINK_COMMAND, ARCHIVE_COMMAND, NEW_COMMAND, HELP_COMMAND;
// The parts of `petri archive`.
extern const Command VERIFY_COMMAND, INFO_COMMAND, CITE_COMMAND, UNPACK_COMMAND;
// Forms of run, render and view: with a link instead of a script, and with --send; and the old name of the latter.
extern const Command RUN_LINK_COMMAND, VIEW_LINK_COMMAND, SEND_COMMAND, OLD_SEND_COMMAND;
// The form of test with --new.
extern const Command TEST_NEW_COMMAND;
// Commands that help does not list: `petri complete`, for the completion scripts of shells, and the tests of a shader
// and of pictures.
extern const Command COMPLETE_COMMAND, SHADER_TEST_COMMAND, COMPARE_PICTURES_COMMAND;
// Part of petri test.
extern const Command CHECK_PROPERTIES_COMMAND;

// Returns the part of a command that this operand selects, or NULL.
const Command *command_part(const Command *command, const char *operand);
// Parses the arguments that follow the command's name and runs the command, or the part that the first argument
// selects. Returns the exit status.
int command_run(const Command *command, const CommandContext *context, int argc, char **argv);

// These print help to standard output and return the exit status.
int help_for(const Command *command);
int help_version(void);

// Installs a signal handler. A SIGHUP that is ignored, as under nohup, stays ignored.
void signal_catch(int number, void (*handler)(int), int flags);
// Writes `petri: text` and a newline to standard error. Control characters become `?`.
__attribute__((format(printf, 1, 2))) void message(const char *format, ...);

// Compares a candidate with a mistyped word, as str_try_nearest does, but also accepts a word that is a prefix of
// `name`. Returns true if the candidate is the most similar one so far; nearest->found then points to the
// NUL-terminated `name`.
bool nearest_offer(StrNearest *nearest, const char *name);
