// options.h: the options of all commands: one table, one reader.
#ifndef PETRI_SRC_OPTIONS_H
#define PETRI_SRC_OPTIONS_H

#include "cli/byte_buffer.h"
#include "cli/cli.h"
#include "cli/scripts.h"
#include "petri.h"

#include <stdint.h>

typedef enum Verbosity { LOG_QUIET, LOG_NORMAL, LOG_VERBOSE, LOG_DEBUG, LOG_TRACE } Verbosity;

typedef struct Size {
    int width;
    int height;
} Size;

// What a command line asks for. Texts point into argv.
typedef struct Options {
#define FIELD(type, name, at_first) type name;
#define OPTION(commands, name, letter, value, reader, field, help)
#include "cli/option_list.h"
#undef FIELD
#undef OPTION
    const char *script; // the operand that came last; NULL: none was given
    ScriptList scripts; // of commands for many, sorted
    bool unreadable;    // some path could not be read
    const char *(*read)(void *host, const char *path, size_t *length);    // … likewise, with the same host
    const char *(*unsaved)(void *host, const char *path, size_t *length); // see PetriOptions; NULL
    void *unsaved_host;
    bool prompt; // the session keeps forces to show and can be interrupted
    int argc;    // the words of the command line, from behind the command's name
    char **argv;
} Options;

enum { OPTIONS_READ = -1 };

// Whether frames are still to be made, as --frames and --runtime say: after so many since `start`.
bool options_due(const Options *options, int64_t frames, double start, double fps);

// Opens a session as the options say, with the names that they define. OPTIONS_READ, or the status to exit with after
// a message; *session is then NULL.
int options_open(const Options *options, const CommandContext *host,
                 void (*diagnostic)(void *context, const PetriDiagnostic *diagnostic), void *context,
                 PetriSession **session);

#endif
