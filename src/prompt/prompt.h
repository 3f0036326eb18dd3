// prompt.h: the commands and expressions of petri's prompt, without a terminal. `petri repl` reads its lines from a
// terminal or a pipe; the playground gets them from a page, and `petri view` from a socket. Files, from those that call
// to those that are called:
//
//   prompt.c                 executes an input
//   bare.c                   commands typed without their dot
//   complete.c               completion of words
//   commands.c               table of all commands, and help
//   *_commands.c, move_command.c, why_command.c   the commands
//   breaks.c                 conditions that end commands
//   recall.c                 earlier values and inputs
//   expression.c             expressions that depend on the frame before
//   arguments.c, particle.c  their operands
//   messages.c               notes, messages and interruption
#pragma once

#include "cli/memory.h"
#include "cli/output.h"
#include "petri-edit.h"
#include "petri-live.h"

typedef struct Prompt Prompt;

// An expression that commands evaluate in several frames (expression.c). Its text may contain `prev(EXPR)`, the value
// of EXPR in the frame before, and may begin with `changes`: true if the value differs from that of the frame before.
typedef struct Inner {
    size_t start; // of `prev(EXPR)` in Expression.text, in bytes
    size_t end;
    char *text;  // EXPR
    char *value; // value of EXPR in the frame before; NULL: not known
} Inner;
typedef struct Expression {
    char *typed; // as typed
    char *text;  // without `changes`
    bool changes;
    char *before; // with `changes`: the value in the frame before; NULL: not known
    Inner *inner;
    size_t inner_count;
} Expression;
typedef struct Expressions {
    Expression *items;
    size_t count;
} Expressions;

// Reads an expression and evaluates it once in the current frame. Returns false, after a message, if it is not valid.
// The caller frees *out with expression_free.
bool expression_parse(Prompt *prompt, const char *text, Expression *out);
void expression_free(Expression *expression);
// Keeps what the expression needs of the frame before, to which it goes for this. Returns false after a message.
bool expression_learn(Prompt *prompt, Expression *expression);
// Appends a text of the language to `out`, with each `prev(EXPR)` replaced by the value of EXPR in the frame before, to
// which it goes for this. Appends nothing if there is no `prev`. Returns false after a message.
bool expression_expand(Prompt *prompt, const char *text, Text *out);
// Returns true if the value depends on the frame before.
bool expression_uses_previous(const Expression *expression);
// Keeps what the expression needs of the current frame when it is evaluated in the next one.
PetriStatus expression_remember(Prompt *prompt, Expression *expression);
// Evaluates the expression in the current frame. Appends the printed value to `value` unless it is NULL.
PetriStatus expression_evaluate(Prompt *prompt, const Expression *expression, PetriEvaluation *result, Text *value);
// Takes over an expression.
void expressions_add(Expressions *list, const Expression *expression);
// Returns the index of the expression that was typed as this text, or list->count.
size_t expressions_find(const Expressions *list, const char *typed);
// Removes this expression, or all if the text is empty. Returns false if it is not in the list.
bool expressions_remove(Expressions *list, const char *typed);
void expressions_free(Expressions *list);

// What a host does for a command.
typedef struct PromptHostCommand {
    const char *name;                              // with its dot
    bool (*run)(Prompt *prompt, const char *rest); // as PromptCommand.run, which it replaces; NULL: see `instead`
    const char *instead; // if `run` is NULL: the message that the command fails with, after its name and a blank
} PromptHostCommand;

// The functions of a host. Those that can be NULL have a default.
typedef struct PromptHost {
    // Writes a message about the current input, which is one line without its line feed.
    void (*complain)(Prompt *prompt, const char *text);
    bool (*interrupted)(Prompt *prompt); // returns true if the user has interrupted the current input
    const PromptHostCommand *commands;   // ends with a row without a name. Commands in no row use PromptCommand.run

    // Called before and after the session works for the user, so that it can be interrupted; NULL: none.
    void (*begin)(Prompt *prompt);
    void (*end)(Prompt *prompt);
    // Called before frames are computed, and after them; NULL: none.
    void (*before_frames)(Prompt *prompt);
    void (*after_frames)(Prompt *prompt);
    // Shows that `done` of `total` frames are computed. If `total` is 0, erases what it has shown. NULL: shows nothing.
    void (*show_progress)(Prompt *prompt, int64_t done, int64_t total);
    size_t (*rows)(Prompt *prompt);    // number of lines that can be read at once, SIZE_MAX: any; NULL: any
    size_t (*columns)(Prompt *prompt); // width of help texts; NULL: 80
    // Adds the names of files that begin with a text; NULL: none.
    void (*add_files)(Prompt *prompt, const char *typed, TextList *names);

    // The timeline. NULL: functions of Prompt.history.
    PetriStatus (*step)(Prompt *prompt);
    PetriStatus (*go_to)(Prompt *prompt, int64_t frame); // also computes the current frame again if it is incomplete
    void (*timeline)(Prompt *prompt, PetriHistoryInfo *info); // sets `first`, `last` and `reason`
    // Sets a parameter of the script; NULL: by petri_define and petri_reload, also names that are not parameters.
    PetriStatus (*set_parameter)(Prompt *prompt, const char *name, const char *value);

    // Moves a particle in the current frame; NULL: by petri_history_move_particle.
    PetriStatus (*move)(Prompt *prompt, size_t system, uint32_t particle, const double *position,
                        const double *velocity);

    const char *keys_help; // sentences about keys for .help, each followed by a blank; NULL: none
} PromptHost;

// The state of a prompt. The host sets the fields up to `colour`; the others are zero at first, and prompt_end frees
// them.
struct Prompt {
    const PromptHost *host;
    void *user_data; // for the host
    PetriSession *session;
    PetriHistory *history; // can be NULL if the host has the functions of the timeline
    Output *output;
    int64_t limit; // maximum frames of .run and .until
    bool live;     // true if lines are shown as soon as a frame is computed
    bool colour;   // true if notes are dimmed

    Expressions watched;  // expressions that are printed after each step
    Expressions breaks;   // expressions that end stepping commands
    TextList inputs;      // earlier inputs, oldest first
    bool inputs_dropped;  // true if there were too many to keep all
    TextList values;      // printed forms of earlier values, oldest first
    char *repeated;       // the last stepping command, which an empty input repeats; NULL: none
    TextList definitions; // definitions NAME=VALUE from -D and .set
    bool failed;          // true if the current input has failed
    bool quit;            // true if the user has asked to end the session
    bool incomplete;      // true if a step was interrupted: the current frame has its state, but no systems or nodes
    bool rates_changed;   // true if .tempo or .fps was used since the script was loaded
};

// Executes one input: a command, or statements and expressions of the language, with a line feed at the end. A blank
// input repeats the last stepping command. Writes the result to prompt->output, which it flushes. Returns false, after
// a message, if the input failed.
bool prompt_execute(Prompt *prompt, const char *text, size_t length);
// Frees what the prompt owns, but not what its host has set.
void prompt_end(Prompt *prompt);

// Completion of a word (complete.c).
typedef struct Completion {
    TextList words; // words that begin with the typed text, sorted, without duplicates
    Text common;    // text that all words share after the typed text
} Completion;

// Completes the last word in the first `length` bytes of a line. The caller frees *completion with complete_free.
void complete_line(Prompt *prompt, const char *line, size_t length, Completion *completion);
void complete_free(Completion *completion);
// Writes the words in columns.
void complete_show(const Completion *completion, Output *output);

// For commands, also those of hosts (messages.c).

// Writes a note, `-- text`, on a separate line of the output.
__attribute__((format(printf, 2, 3))) void prompt_note(Prompt *prompt, const char *format, ...);
// Writes a message and marks the current input as failed. Returns false.
__attribute__((format(printf, 2, 3))) bool prompt_fail(Prompt *prompt, const char *format, ...);
// Returns true for PETRI_OK. For other statuses, marks the current input as failed and writes a message unless a
// diagnostic was already written.
bool prompt_status(Prompt *prompt, PetriStatus status);
// Between prompt_busy and prompt_idle, the session can be interrupted. prompt_idle returns true if it was.
void prompt_busy(Prompt *prompt);
bool prompt_idle(Prompt *prompt);
// Gets the bounds of the timeline.
PetriHistoryInfo prompt_timeline(Prompt *prompt);
// Goes to a frame of the timeline, or steps forward to a frame after its end, without output.
PetriStatus prompt_go_to(Prompt *prompt, int64_t frame);
// If the current frame was interrupted, computes it again, because an interrupted frame has no systems and no nodes.
void prompt_complete_frame(Prompt *prompt);

// Conditions that end stepping commands (breaks.c). An expression `until` is that of .until or `.back until`; NULL:
// none.
typedef enum StepOutcome {
    STEP_RUNNING,
    STEP_REACHED, // `until` is true
    STEP_STOPPED, // a break is true
    STEP_ABORTED, // a frame failed
} StepOutcome;
// Keep what expressions need of the current frame when they are evaluated in the next one: those of a list; `until`,
// the breaks and the watched expressions.
PetriStatus breaks_remember_all(Prompt *prompt, Expressions *list);
PetriStatus breaks_remember(Prompt *prompt, Expression *until);
// Evaluates `until` and the breaks in the current frame. Sets *outcome to STEP_REACHED, STEP_STOPPED or STEP_RUNNING;
// if it is STEP_STOPPED, *number is the index of the break.
PetriStatus breaks_test(Prompt *prompt, const Expression *until, StepOutcome *outcome, size_t *number);
// Writes the note that a break has ended a command.
void breaks_note(Prompt *prompt, size_t number);
// A search backwards for the last frame in which `until` or a break is true.
typedef struct BreakSearch {
    Expression *until;
    int64_t first;       // first frame of the timeline
    int64_t found;       // the frame; INT64_MIN: none yet
    StepOutcome outcome; // in the frame that was found
    size_t number;       // of the break that is true there
} BreakSearch;
// Searches the frames before the current one, from `min` on, in parts that are about as long as the distance of two
// stored frames. Afterwards, the session is at any of these frames.
PetriStatus breaks_search(Prompt *prompt, BreakSearch *search, int64_t min);

// Commands (commands.c). Each file that implements commands ends with a table of them. To add a command, add a row and
// its function.
typedef enum Completes {
    COMPLETE_LANGUAGE,
    COMPLETE_BREAKS,
    COMPLETE_FILES,
    COMPLETE_IDS,
    COMPLETE_KEYS,
    COMPLETE_KINDS,
    COMPLETE_MOVE,
    COMPLETE_PARAMETERS,
    COMPLETE_SYSTEMS,
    COMPLETE_TOPICS,
    COMPLETE_WATCHED
} Completes;
typedef struct PromptCommand {
    const char *name;     // with its dot
    const char *operands; // as shown in help; "": none
    const char *needed;   // how messages name the operand if it is required; NULL: it is not required
    const char *help;
    // Returns false, after a message, if the command failed. NULL: only hosts have the command.
    bool (*run)(Prompt *prompt, const char *rest);
    Completes complete; // how the operand is completed
} PromptCommand;
// Each table ends with a row without a name.
extern const PromptCommand STEP_COMMANDS[], BREAK_COMMANDS[], RECALL_COMMANDS[], PRINT_COMMANDS[], WHY_COMMANDS[],
    MOVE_COMMANDS[], SET_COMMANDS[], PICTURE_COMMANDS[], HOST_COMMANDS[], OTHER_COMMANDS[];
// Returns the command at an index, in the order of .help. Returns NULL after the last command.
const PromptCommand *prompt_command_at(size_t index);
// Returns the command with this name, with or without the dot, or NULL. Names are not shortened.
const PromptCommand *prompt_find_command(const char *name, size_t length);
// Returns the command that an input runs, or NULL. Its name may be shortened.
const PromptCommand *prompt_command_of(const char *input);
void prompt_command(Prompt *prompt, const char *line);

// Earlier inputs and values (recall.c).
// Keeps an input, without blanks at its ends.
void recall_add_input(Prompt *prompt, const char *text);
// Keeps the value in the last line of what an input has printed, unless it is a node.
void recall_add_value(Prompt *prompt, const Text *output);
// Appends a text to `out` with each `_` replaced by the last value, and `_1`, `_2` ... by the values before it. Returns
// false after a message.
bool recall_expand(Prompt *prompt, const char *text, size_t length, Text *out);

// Commands without a dot (bare.c; bare_alias is in commands.c).
// Executes the text if its first word is `help`, `?`, `h`, `quit`, `exit` or `q`. If the first word is the name of
// another command, writes a message. Returns true in both cases.
// Returns false if the text is code, for example because the script, the prompt or petri binds the first word. If the
// first word is also the name of a command, this function can set *remark to a hint. The caller prints the hint if the
// code fails, or if the word is one of the six above.
bool bare_execute(Prompt *prompt, const char *text, Text *remark);
// Returns the command that one of these six words executes, such as ".quit" for "q". Returns NULL for other words.
const char *bare_alias(const char *name, size_t length);

// Parsing of operands (arguments.c). Functions that return bool return false after a message.
// Returns a copy without blanks at its ends. The caller frees it with free.
char *argument_trimmed(const char *text);
// Parses a finite number: a number, a time code, or an expression, which is evaluated in the current frame.
bool argument_number(Prompt *prompt, const char *text, double *number);
// Parses an integer >= min, or an expression with such a value. Does not change *count if the text is empty.
bool argument_count(Prompt *prompt, const char *text, int64_t min, int64_t *count);
// Removes `--limit N` from the beginning or the end of the text and sets *limit.
bool argument_limit(Prompt *prompt, char *text, int64_t *limit);
// If the text ends with a positive integer that follows other text and a blank, removes the integer and sets *count.
void argument_last_count(char *text, int64_t *count);
// Returns the maximum number of lines to print. If the text ends with a positive integer or `all`, removes it and
// returns the integer, or SIZE_MAX for `all`. Otherwise returns the number of lines that the host can show at once
// minus `around`.
size_t argument_lines(Prompt *prompt, char *text, size_t around);

// The particle that an operand names, by its id or by its key in the state, such as `:cells;3` (particle.c).
typedef struct ParticleName {
    const char *typed;
    Text value;    // value of the operand
    double number; // the value, if it is a single number, else NaN
} ParticleName;
// Evaluates an operand. Computes an interrupted frame again, so that its systems can be searched. Returns false after a
// message. The caller frees name->value with text_free.
bool particle_read(Prompt *prompt, const char *text, ParticleName *name);
// Finds the particle in system `number`. Returns false if it has no such particle.
bool particle_find(Prompt *prompt, const ParticleName *name, size_t number, const PetriSystem *system,
                   uint32_t *particle);
// Appends the particle's key in the state.
void particle_add_key(Prompt *prompt, size_t number, const PetriSystem *system, uint32_t particle, Text *key);
// Returns the reason why the frame has no systems.
const char *particle_none(const Prompt *prompt);
// Writes the message that no system has the particle. Returns false.
bool particle_unknown(Prompt *prompt, const ParticleName *name);

// Writes a note that the script still uses its own binding of a name that was just bound at the prompt
// (set_commands.c).
void prompt_warn_shadowed(Prompt *prompt, const char *name);
