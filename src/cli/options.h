// options.h: the values of options that several commands share, and of operands.
#pragma once

#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/scripts.h"
#include "petri.h"

#include <stdint.h>

typedef enum Verbosity { LOG_QUIET, LOG_NORMAL, LOG_VERBOSE, LOG_DEBUG, LOG_TRACE } Verbosity;

typedef struct Size {
    int width;
    int height;
} Size;

// Values from a command line. Strings point into argv.
typedef struct Options {
    int64_t frame;       // render: frame number; -1: not given
    const char *archive; // file; NULL: none
    int64_t from;        // first frame of an archive's replay; -1: not given
    int64_t keyframe_every;
    int64_t digest_every;
    int64_t frames;       // -1: not given; INT64_MAX: unlimited
    double run_time;      // seconds; NaN: unlimited
    TextList definitions; // each "NAME=VALUE"
    double fps;
    bool fps_given;
    bool realtime;
    TextList read_folders; // folders that scripts may read
    TextList write_folders;
    bool no_files;
    const char *state_file; // NULL: none
    int64_t save_every;     // frames between saves; 0: every few seconds
    int64_t threads;        // 0: number of CPUs
    uint64_t memory;        // bytes; 0: default of the library
    uint64_t work;          // units per frame; 0: default of the library
    int neighbours;         // PetriNeighbours
    const char *spec;       // PetriOptions.spec
    bool unsimplified;
    bool no_batches;
    bool keep_modules; // modules are not read again during the run
    bool profile;
    Verbosity verbosity;
    bool colour;
    bool monochrome;          // no colours even in terminal pictures
    const OptionTable *table; // the options of the command
    void *own;                // values of the options that only this command has; NULL: none
    const char *script;       // the last operand; NULL: none
    const char *second;       // the operand after `script`, for commands that accept two; NULL: none
    TextList expressions;     // operands after the script, for commands that accept expressions
    ScriptList scripts;       // scripts in the operands, for commands that accept several; sorted
    TextList unreadable;      // paths that could not be read
    const char *(*read)(void *host, const char *path, size_t *length);    // PetriOptions.read_file; NULL: none
    const char *(*unsaved)(void *host, const char *path, size_t *length); // PetriOptions.read_unsaved; NULL: none
    void *unsaved_host;                                                   // first argument of both functions
    // PetriOptions.on_file_read; NULL: none
    void (*on_file_read)(void *context, const char *name, const char *bytes, size_t length);
    bool (*should_interrupt)(void *context); // PetriOptions.should_interrupt; NULL: none
    // view: called after each frame, with `unsaved_host`; NULL: none
    void (*after_frame)(void *context, PetriSession *session);
    bool keep_forces;              // PetriOptions.keep_forces
    struct PetriArchive *replayed; // archive that is used instead of a script; NULL: none
    bool prompt;                   // true if the session must keep forces for display and roll back interrupted frames
    int argc;                      // arguments after the command's name
    char **argv;
} Options;

enum { OPTIONS_READ = -1 }; // success, from functions that otherwise return an exit status

// Parses the arguments that follow a command's name. Returns OPTIONS_READ or an exit status. The caller frees the
// options with options_free in both cases.
int options_parse(Options *options, const Command *command, const CommandContext *context, int argc, char **argv);
void options_free(Options *options);

// Loads the script, or the archive from which a run is replayed. A missing script causes a suggestion.
PetriStatus options_load(const Options *options, PetriSession *session);

// Returns true if another frame must be computed according to --frames and --runtime. `frames` frames have been
// computed since `start`, a time of the monotonic clock in seconds.
bool options_due(const Options *options, int64_t frames, double start, double fps);

// Return the limits of a session: those of the options, or the defaults.
uint64_t options_work_limit(const Options *options);
size_t options_memory_limit(const Options *options);

// Opens a session with the options and defines the names of -D. Returns OPTIONS_READ. On failure, sets *session to NULL
// and returns an exit status after a message.
int options_open(const Options *options, const CommandContext *host,
                 void (*diagnostic)(void *context, const PetriDiagnostic *diagnostic), void *context,
                 PetriSession **session);
