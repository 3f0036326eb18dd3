// repl.h: internal declarations of `petri repl`, the host of a prompt (prompt/prompt.h) on a terminal or a pipe. Its
// files, from those that call to those that are called:
//
//   repl.c                   the session: reads input, which the prompt executes; functions of the host
//   line.c, edit.c           reading lines, with libedit on a terminal
//   plot.c, record.c, record_session.c, script.c, show.c   commands that only this host has
//   transcript.c             repeating a recorded session
//   interrupt.c              Ctrl-C
#pragma once

#include "cli/archive.h"
#include "cli/file_watch.h"
#include "cli/memory.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "petri-edit.h"
#include "petri-live.h"
#include "prompt/prompt.h"

enum { DEFAULT_LIMIT = 100000 }; // of --limit

typedef struct Repl {
    const CommandContext *context;
    Options *options;
    Prompt prompt;
    bool utf8;           // true if plots may use braille characters, else only ASCII
    Archiving archiving; // the archive of .archive
    Output output;
    Progress progress;       // of the current command
    bool progresses;         // true if the progress line was started
    FileWatch *files;        // watches the script and the files that it uses
    char *script;            // path; NULL: no script was named
    bool loaded;             // true if `script` is the running script
    Text script_text;        // text of the script when it was loaded
    bool changed;            // true if the script's files have changed; the script is reloaded before the next step
    bool terminal;           // true if standard input and output are terminals
    bool any_failed;         // true if any input has failed
    bool invalid_definition; // true if the script rejected the value of a definition
} Repl;

// Begin and end an operation that Ctrl-C interrupts.
void repl_begin(Prompt *prompt);
void repl_end(Prompt *prompt);
// Returns true if Ctrl-C was typed since the last repl_clear_interrupt.
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
void repl_refresh(Prompt *prompt);
// Watches the script and all files that it uses.
void repl_watch_files(Repl *repl);

// Repeats a session (transcript.c). A file with this suffix is a transcript.
#define TRANSCRIPT_SUFFIX ".session"
bool transcript_is_named(const char *path);
// Runs the prompt with the inputs of a transcript and prints the new one. Returns the exit status.
int transcript_run(const CommandContext *context, const char *path);

// Records the inputs so far as a transcript (record_session.c). Returns false after a message.
bool repl_record_session(Repl *repl, const char *path);
// Returns true if both files are in the same folder (record.c).
bool repl_same_folder(const char *a, const char *b);

// The commands, as PromptHostCommand.run.
bool repl_run_load(Prompt *prompt, const char *rest);
bool repl_run_reload(Prompt *prompt, const char *rest);
bool repl_run_save(Prompt *prompt, const char *rest);
bool repl_run_restore(Prompt *prompt, const char *rest);
bool repl_run_archive(Prompt *prompt, const char *rest);
bool repl_run_record(Prompt *prompt, const char *rest);
bool repl_run_plot(Prompt *prompt, const char *rest);
bool repl_run_show(Prompt *prompt, const char *rest);
