// repl.h: internal declarations of `petri repl`. Its files, from those that call to those that are called:
//
//   repl.c                   the session: reads and executes input
//   line.c, edit.c           reading lines, with libedit on a terminal; complete.c: completion of words
//   bare.c                   commands typed without their dot
//   commands.c               table of all commands, and help
//   *_commands.c, why_command.c, plot.c, record.c, script.c   the commands
//   arguments.c              their operands
//   interrupt.c              Ctrl-C, notes and messages
#pragma once

#include "cli/archive.h"
#include "cli/file_watch.h"
#include "cli/memory.h"
#include "cli/options.h"
#include "cli/output.h"
#include "petri-edit.h"
#include "petri-live.h"

typedef struct Repl {
    Options *options;
    int64_t limit; // maximum frames of .run and .until (--limit)
    PetriSession *session;
    PetriHistory *history;
    Archiving archiving; // the archive of .archive
    Output output;
    FileWatch *files;        // watches the script and the files that it uses
    char *script;            // path; NULL: no script was named
    bool loaded;             // true if `script` is the running script
    Text script_text;        // text of the script when it was loaded
    bool changed;            // true if the script's files have changed; the script is reloaded before the next step
    TextList watched;        // expressions that are printed after each step
    bool terminal;           // true if standard input and output are terminals
    bool utf8;               // true if the locale's encoding is UTF-8; else only ASCII is printed
    bool failed;             // true if the current input has failed
    bool any_failed;         // true if any input has failed
    bool invalid_definition; // true if the script rejected the value of a definition
    bool quit;               // true if the session must end
    bool incomplete;         // true if a step was interrupted: the current frame has its state, but no systems or nodes
    bool rates_changed;      // true if .tempo or .fps was used since the script was loaded
    TextList definitions;    // definitions NAME=VALUE from -D and .set
} Repl;

// Writes a note, `-- text`, on a separate line of standard output.
__attribute__((format(printf, 2, 3))) void repl_note(Repl *repl, const char *format, ...);
// Writes a message to standard error and marks the current input as failed. Returns false.
__attribute__((format(printf, 2, 3))) bool repl_fail(Repl *repl, const char *format, ...);
// Returns true for PETRI_OK. For other statuses, marks the current input as failed and writes a message unless a
// diagnostic was already written.
bool repl_status(Repl *repl, PetriStatus status);

// Between repl_busy and repl_idle, Ctrl-C interrupts the session. repl_idle returns true if Ctrl-C was typed since
// repl_busy.
void repl_busy(Repl *repl);
bool repl_idle(Repl *repl);
// Returns true if Ctrl-C was typed since the last repl_busy or repl_clear_interrupt.
bool repl_interrupted(void);
void repl_clear_interrupt(void);
// Catches Ctrl-C from now on.
void repl_catch_interrupt(void);

// Loads a script (script.c). Returns true if this script is now running.
bool repl_load(Repl *repl, const char *file);
// Loads the archive that was given instead of a script. Returns false after a message.
bool repl_replay(Repl *repl);
// If the script's files have changed, writes a note and returns true. If `at_prompt` is true, the current line contains
// a prompt, so the note starts on a new line.
bool repl_report_changes(Repl *repl, bool at_prompt);
// Must be called before a step. Reloads the script if its files have changed. If the new version of the script has
// errors, the old version keeps running.
void repl_refresh(Repl *repl);
// Watches the script and all files that it uses.
void repl_watch_files(Repl *repl);

// Commands (commands.c). Each file that implements commands ends with a table of them. To add a command, add a row and
// its function.
typedef enum Completes {
    COMPLETE_LANGUAGE,
    COMPLETE_FILES,
    COMPLETE_KEYS,
    COMPLETE_KINDS,
    COMPLETE_PARAMETERS,
    COMPLETE_SYSTEMS,
    COMPLETE_TOPICS
} Completes;
typedef struct ReplCommand {
    const char *name;     // with its dot
    const char *operands; // as shown in help; "": none
    const char *needed;   // how messages name the operand if it is required; NULL: it is not required
    const char *help;
    bool (*run)(Repl *repl, const char *rest); // returns false, after a message, if the command failed
    Completes complete;                        // how the operand is completed
} ReplCommand;
// Each table ends with a row without a name.
extern const ReplCommand STEP_COMMANDS[], PRINT_COMMANDS[], WHY_COMMANDS[], PLOT_COMMANDS[], SET_COMMANDS[],
    SCRIPT_COMMANDS[], RECORD_COMMANDS[], OTHER_COMMANDS[];
// Returns the command at an index, in the order of .help. Returns NULL after the last command.
const ReplCommand *repl_command_at(size_t index);
// Returns the command with this name, with or without the dot, or NULL.
const ReplCommand *repl_find_command(const char *name, size_t length);
void repl_command(Repl *repl, const char *line);

// Commands without a dot (bare.c; bare_alias is in commands.c).
// Executes the text if its first word is `help`, `?`, `h`, `quit`, `exit` or `q`. If the first word is the name of
// another command, writes a message. Returns true in both cases.
// Returns false if the text is code, for example because the script, the prompt or petri binds the first word. If the
// first word is also the name of a command, this function can set *remark to a hint. The caller prints the hint if the
// code fails, or if the word is one of the six above.
bool bare_execute(Repl *repl, const char *text, Text *remark);
// Returns the command that one of these six words executes, such as ".quit" for "q". Returns NULL for other words.
const char *bare_alias(const char *name, size_t length);

// Parsing of operands (arguments.c). Functions that return bool return false after a message.
// Returns a copy without blanks at its ends. The caller frees it with free.
char *argument_trimmed(const char *text);
// Parses a finite number: a number, a time code, or an expression, which is evaluated in the current frame.
bool argument_number(Repl *repl, const char *text, double *number);
// Parses an integer >= min, or an expression with such a value. Does not change *count if the text is empty.
bool argument_count(Repl *repl, const char *text, int64_t min, int64_t *count);
// Removes `--limit N` from the beginning or the end of the text and sets *limit.
bool argument_limit(Repl *repl, char *text, int64_t *limit);
// If the text ends with a positive integer that follows other text and a blank, removes the integer and sets *count.
void argument_last_count(char *text, int64_t *count);
// Returns the maximum number of lines to print. If the text ends with a positive integer or `all`, removes it and
// returns the integer, or SIZE_MAX for `all`. Otherwise returns the number of screen lines minus `around` on a
// terminal, and SIZE_MAX elsewhere.
size_t argument_lines(const Repl *repl, char *text, size_t around);

// Writes a note that the script still uses its own binding of a name that was just bound at the prompt
// (set_commands.c).
void repl_warn_shadowed(Repl *repl, const char *name);
// If Ctrl-C interrupted the current frame, computes it again, because an interrupted frame has no systems and no nodes.
void repl_complete_frame(Repl *repl);

// Completion of a word (complete.c).
typedef struct Completion {
    TextList words; // words that begin with the typed text, sorted, without duplicates
    Text common;    // text that all words share after the typed text
} Completion;

// Completes the last word in the first `length` bytes of a line. The caller frees *completion with complete_free.
void complete_line(Repl *repl, const char *line, size_t length, Completion *completion);
void complete_free(Completion *completion);
// Writes the words in columns.
void complete_show(const Completion *completion, Output *output);
