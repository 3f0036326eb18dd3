// repl.h: what the files of `petri repl` share: the session at the prompt and how it speaks.
#ifndef PETRI_SRC_REPL_H
#define PETRI_SRC_REPL_H

#include "cli/byte_buffer.h"
#include "cli/file_watch.h"
#include "cli/history.h"
#include "cli/options.h"
#include "cli/output.h"
#include "petri.h"

typedef struct Repl {
    Options *options;
    PetriSession *session;
    FrameHistory history;
    Output output;
    FileWatch *files;        // that the script is made from
    char *script;            // NULL: none was named
    bool loaded;             // the script named is the one that is running
    ByteBuffer script_text;  // as it was loaded
    bool changed;            // the script's files have changed since: it is reloaded before the next step
    TextList watched;        // expressions that are printed after each step
    bool terminal;           // a person types and reads
    bool utf8;               // other characters than ASCII can be shown
    bool failed;             // the input at hand was in error
    bool any_failed;         // some input was
    bool invalid_definition; // the script cannot take a value that was set
    bool quit;
    bool incomplete;      // a step was interrupted: of the frame at hand only the state is there
    bool rates_changed;   // .tempo or .fps was used since the script was loaded
    TextList definitions; // of -D and .set, as given
} Repl;

// Writes a remark, `-- text`, in a line of its own.
__attribute__((format(printf, 2, 3))) void repl_note(Repl *repl, const char *format, ...);
// The same as a message of the command, on standard error; the input at hand has failed. Returns false.
__attribute__((format(printf, 2, 3))) bool repl_fail(Repl *repl, const char *format, ...);
// What a status means, unless diagnostics have told it; true for PETRI_OK.
bool repl_status(Repl *repl, PetriStatus status);
// Takes one line or suite, which is not blank: a command or something of the language.
void repl_execute(Repl *repl, const char *text, size_t length);
// A PetriWriteCallback to the output.
bool repl_write(void *repl, const char *text, size_t length);

// While `busy`, Ctrl-C interrupts the session. Tells whether it was typed since, when that ends.
void repl_busy(Repl *repl);
bool repl_idle(Repl *repl);
// Whether Ctrl-C was typed since the last repl_busy or prompt.
bool repl_interrupted(void);

// Loading (script.c). True if the script is running now.
bool repl_load(Repl *repl, const char *file);
// Looks whether files have changed and says so: true if it did. `at_prompt`: something stands in the line already.
bool repl_report_changes(Repl *repl, bool at_prompt);
// Reloads if files have changed: before a step. The old script stays where the new one is wrong.
void repl_refresh(Repl *repl);
void repl_watch_files(Repl *repl);

// Commands (commands.c). Those of a file are in a table at its end: a new one is a row there and its function.
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
    const char *operands; // "": it takes none
    const char *needed;   // what is missing where there is none; NULL: nothing
    const char *help;
    bool (*run)(Repl *repl, const char *rest); // false if it failed, after a message
    Completes complete;                        // how its operand goes on
} ReplCommand;
// Each ends with a row without a name.
extern const ReplCommand STEP_COMMANDS[], PRINT_COMMANDS[], PLOT_COMMANDS[], SET_COMMANDS[], SCRIPT_COMMANDS[],
    RECORD_COMMANDS[], OTHER_COMMANDS[];
// All of them in the order of help; NULL beyond the last.
const ReplCommand *repl_command_at(size_t index);
// By its name with or without the dot; NULL if there is none.
const ReplCommand *repl_find_command(const char *name, size_t length);
void repl_command(Repl *repl, const char *line);

// Commands without a dot (arguments.c).
// `help`, `?`, `quit`, `exit`, `q`: true if the text was one of those and is done; also if it begins with the name of
// another command, after a message. Where the word is a name of the script, the prompt or petri, the text is left to
// the language, and a remark is for when that has failed or, with the words above, has shown its value.
bool bare_execute(Repl *repl, const char *text, ByteBuffer *remark);
// The command that such a word stands for, or NULL.
const char *bare_alias(const char *name, size_t length);

// What follows a command's name (arguments.c).
// A copy without blanks at its ends; to be freed.
char *argument_trimmed(const char *text);
// A finite number: one as the command line takes it, a time code, or an expression of the present frame. False after a
// message.
bool argument_number(Repl *repl, const char *text, double *number);
// A whole number from `least` on, or an expression for one; an empty text leaves *count. False after a message.
bool argument_count(Repl *repl, const char *text, int64_t min, int64_t *count);
// Takes `--limit N` off the text's beginning or end. False after a message.
bool argument_limit(Repl *repl, char *text, int64_t *limit);
// Takes a whole number off the text's end, if there is one after a blank and something before it.
void argument_last_count(char *text, int64_t *count);
// Takes a whole number, or `all`, off the end of what a table is asked for: how many lines to show. What is not said is
// a screenful, less `around` lines, on a terminal and everything elsewhere.
size_t argument_lines(const Repl *repl, char *text, size_t around);

// Says that the script has a name of its own which was bound at the prompt just now (set_commands.c).
void repl_warn_shadowed(Repl *repl, const char *name);
// Writes the present frame's `@` line, what it logged and what is watched (step_commands.c).
void repl_show_frame(Repl *repl);
// Makes the present frame again if Ctrl-C has taken away what it computed beside the state: the systems, the tree.
void repl_complete_frame(Repl *repl);

// What a word may go on with (complete.c).
typedef struct Completion {
    TextList words;    // that begin with what was typed, sorted, each once
    ByteBuffer common; // what all of them have beyond what was typed
} Completion;

// For the first `length` bytes of a line. To be freed.
void complete_line(Repl *repl, const char *line, size_t length, Completion *completion);
void complete_free(Completion *completion);
// Writes the words in columns.
void complete_show(const Completion *completion, Output *output);

#endif
