// repl.h: what the files of `petri repl` share: the session at the prompt and how it speaks.
#ifndef PETRI_SRC_REPL_H
#define PETRI_SRC_REPL_H

#include "cli/bytes.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/watch.h"
#include "petri.h"
#include "repl/history.h"

typedef struct Repl {
    PetriSession *session;
    ReplHistory history;
    Output output;
    Watch *files;      // NULL: changes are not noticed
    char *script;      // NULL: none was named
    bool loaded;       // the script named is the one that is running
    Bytes script_text; // as it was loaded
    bool changed;      // the script's files have changed since: it is reloaded before the next step
    char **watched;    // expressions that are printed after each step
    size_t watched_count;
    int64_t limit; // frames that .run and .until make at the most
    bool terminal; // a person types and reads
    bool colour;
    bool utf8;             // other characters than ASCII can be shown
    bool failed;           // the input at hand was in error
    bool any_failed;       // some input was
    bool wrong_definition; // the script cannot take a value that was set
    bool quit;
    bool incomplete;    // a step was interrupted: of the frame at hand only the state is there
    bool rates_changed; // .tempo or .fps was used since the script was loaded
    bool record_fps;    // --fps was given: goldens must say so
    double fps;
    char **definitions; // of -D and .set, as given
    size_t definition_count;
} Repl;

// Writes a remark, `-- text`, in a line of its own.
__attribute__((format(printf, 2, 3))) void repl_say(Repl *repl, const char *format, ...);
// The same as a message of the command, on standard error; the input at hand has failed. Returns false.
__attribute__((format(printf, 2, 3))) bool repl_fail(Repl *repl, const char *format, ...);
// What a status means, unless diagnostics have told it; true for PETRI_OK.
bool repl_status(Repl *repl, PetriStatus status);
// Takes one line or suite, which is not blank: a command or something of the language.
void repl_take(Repl *repl, const char *text, size_t length);
// A PetriWrite to Bytes, and one to the output; `host` is the Bytes or the Repl.
bool repl_collect(void *bytes, const char *text, size_t length);
bool repl_write(void *repl, const char *text, size_t length);

// Keeps a definition for recordings.
void repl_keep_definition(Repl *repl, const char *definition);

// While `busy`, Ctrl-C interrupts the session. Tells whether it was typed since, when that ends.
void repl_busy(Repl *repl);
bool repl_idle(Repl *repl);
// Whether Ctrl-C was typed since the last repl_busy or prompt.
bool repl_interrupted(void);

// Loading (script.c). True if the script is running now.
bool repl_load(Repl *repl, const char *file);
bool repl_reload(Repl *repl);
// Looks whether files have changed and says so: true if it did. `at_prompt`: something stands in the line already.
bool repl_notice(Repl *repl, bool at_prompt);
// Reloads if files have changed: before a step. The old script stays where the new one is wrong.
void repl_refresh(Repl *repl);
void repl_watch_files(Repl *repl);

// Lines that belong together (block.c).
// Whether more lines are wanted after these, each ended. *taken is how much of them belongs together: the last line may
// be no part of what is above it, or the empty one that ends it.
bool repl_wants_more(Repl *repl, const char *text, size_t length, size_t *taken);
bool repl_is_blank(const char *line);

// Commands (commands.c).
typedef struct ReplCommand {
    const char *name; // with its dot
    const char *operands;
    const char *help;
    bool (*run)(Repl *repl, const char *rest); // false if it failed, after a message
} ReplCommand;
extern const ReplCommand REPL_COMMANDS[]; // the last has no name
void repl_command(Repl *repl, const char *line);

// Commands without a dot (bare.c).
// `help`, `?`, `quit`, `exit`, `q`: true if the text was one of those and is done; also if it begins with the name of
// another command, after a message. Where the word is a name of the script, the prompt or petri, the text is left to
// the language, and a remark is for when that has failed or, with the words above, has shown its value.
bool bare_take(Repl *repl, const char *text, Bytes *remark);
// The command that such a word stands for, or NULL.
const char *bare_alias(const char *name, size_t length);

// Parameters (parameters.c).
bool repl_set(Repl *repl, const char *rest);
bool repl_show_parameters(Repl *repl);
// Says that the script has a name of its own which was bound at the prompt just now.
void repl_tell_hidden(Repl *repl, const char *name);

// Steps (step.c): frames until `count` are made, an expression is true or Ctrl-C; what they say is written.
typedef struct Walk {
    int64_t count;
    const char *until; // NULL: no condition
    bool limited;      // reaching the count is worth a word
} Walk;
bool repl_walk(Repl *repl, const Walk *walk);
// Writes the present frame's `@` line, what it logged and what is watched.
void repl_show_frame(Repl *repl);
bool repl_goto(Repl *repl, int64_t frame);
// Makes the present frame again if Ctrl-C has taken away what it computed beside the state: the systems, the tree.
void repl_complete_frame(Repl *repl);

// Shows (show.c, particles.c, picture.c, plot.c, help.c, record.c).
// Of long ones a screenful, or as many lines as a number or `all` at the end of the text says.
bool repl_show_state(Repl *repl, const char *rest);
bool repl_show_tree(Repl *repl, const char *rest);
bool repl_show_particles(Repl *repl, const char *rest);
bool repl_show_energy(Repl *repl, const char *rest);
bool repl_show_picture(Repl *repl);
bool repl_plot(Repl *repl, const char *rest);
bool repl_time(Repl *repl, const char *rest);
bool repl_help(Repl *repl, const char *topic);
bool repl_record(Repl *repl, const char *rest);

#endif
