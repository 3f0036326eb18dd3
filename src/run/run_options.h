// run_options.h: the command lines of `petri run` and of those that run scripts as it does.
#ifndef PETRI_SRC_RUN_OPTIONS_H
#define PETRI_SRC_RUN_OPTIONS_H

#include <stdint.h>

#include "cli/cli.h"
#include "petri.h"

typedef enum Verbosity { LOG_QUIET, LOG_NORMAL, LOG_VERBOSE, LOG_DEBUG, LOG_TRACE } Verbosity;

typedef struct RunOptions {
    const char *script;
    const char **definitions; // as many as definition_count; each "name=value"
    size_t definition_count;
    int64_t frames;  // INT64_MAX: not limited by their number
    double run_time; // NaN: not limited by time
    double fps;
    bool realtime;
    int64_t every;
    unsigned sections; // PETRI_PRINT_...; 0: logs alone
    int threads;
    int neighbours; // PetriNeighbours
    Verbosity verbosity;
    bool colour;
    bool simplify;
    bool profile;
    const char *state_file; // NULL: the state is neither taken from a file nor kept in one
    int dump;               // PetriDump, or -1
    bool show;              // run: in the terminal, if somebody watches
    bool parameters;        // they are listed, and nothing is run
    bool stats;
    const char *trajectory; // NULL: none is written
    bool automatic;         // the particles themselves are drawn
    const char *output;     // render: what to write
    const char *format;     // … to standard output; NULL: not given
    int64_t frame;          // render: the only one to draw, or -1
    int width;              // of pictures; 0: what the script says
    int height;
    double scale;
    bool terminal;   // view: in the terminal
    bool monochrome; // … without colours
} RunOptions;

enum { RUN_OPTIONS_OK = -1 };

// Reads the options of a command. RUN_OPTIONS_OK, or the status to exit with because help was asked for or something is
// wrong. Texts point into argv.
int run_options_read(RunOptions *options, const Command *command, int argc, char **argv);
void run_options_free(RunOptions *options);
// Opens a session as the options say, with the names that they define. RUN_OPTIONS_OK, or the status to exit with after
// a message; *session is then NULL.
int run_options_open(const RunOptions *options, const Host *host,
                     void (*diagnostic)(void *context, const PetriDiagnostic *diagnostic), void *context,
                     PetriSession **session);

#endif
