// option_groups.h: declarations of options, and the options that several commands share.
//
// Each command has a list of rows in the order of help (OptionTable). To add an option to a command, add a row to the
// list in its folder and a field to its struct.
//
// SHARED(name, letter or 0, "VALUE" or NULL, reader, field, help): an option whose value is a field of Options.
// OWN(...): the same for a field of the command's own struct, which the file calls Own.
// `reader` can be wrapped in the macros below it, which set more members of OptionSpec.
#pragma once

#include "cli/args.h"
#include "cli/options.h"

#include <stddef.h>

// clang-format off
#define SHARED(long_name, short_name, shown, reader, into, text) \
    {.name = long_name, .letter = short_name, .value = shown, .help = text, .field = offsetof(Options, into), .read = reader},
#define OWN(long_name, short_name, shown, reader, into, text) \
    {.own = true, .name = long_name, .letter = short_name, .value = shown, .help = text, .field = offsetof(Own, into), .read = reader},
#define NO_MORE_OPTIONS {.name = NULL} // the end of a list

// Readers with their parameters.
#define WHOLE(from, to) option_integer, .min = from, .max = to
#define VERBOSITY(level) option_verbosity, .min = level
#define ONE_OF(reader, ...) reader, .words = (const char *const[]){__VA_ARGS__, NULL}
// Readers of rows with a mark.
#define NOT_IN_GOLDENS(...) __VA_ARGS__, .not_in_goldens = true
#define ENDS_SHOW(...) __VA_ARGS__, .ends_show = true
#define IS_LIST(...) __VA_ARGS__, .is_list = true
// clang-format on

// Readers: each parses args->value and stores it in a field. They return false after a message.
bool option_flag(const Args *args, void *field);       // bool: sets it
bool option_unset(const Args *args, void *field);      // bool: clears it
bool option_text(const Args *args, void *field);       // const char *
bool option_integer(const Args *args, void *field);    // int64_t, within `min` and `max`
bool option_positive(const Args *args, void *field);   // double
bool option_amount(const Args *args, void *field);     // uint64_t; K, M, G and T multiply by powers of 1024
bool option_fps(const Args *args, void *field);        // double; also sets Options.fps_given
bool option_time(const Args *args, void *field);       // double, in seconds
bool option_choice(const Args *args, void *field);     // int, the index of the word in `words`
bool option_colour(const Args *args, void *field);     // bool; also sets Options.monochrome
bool option_definition(const Args *args, void *field); // TextList: appends NAME=VALUE
bool option_folder(const Args *args, void *field);     // TextList: appends an existing folder; `all` is the root folder
bool option_verbosity(const Args *args, void *field);  // Verbosity: the level in `min`
// Returns true if the environment variable NO_COLOR forbids colours.
bool option_no_colour(void);
// Returns true if messages are coloured when --color is not given.
bool option_default_colour(void);
// Returns the index of a word in a list that ends with NULL, or -1 if it is not in the list.
int option_find_word(const char *const *words, const char *word);
// Reports an invalid value and what is expected. Returns false.
bool option_invalid(const Args *args, const char *expected);

// clang-format off
// How long a run lasts.
#define LENGTH_OPTIONS \
    SHARED("frames", 0, "N", WHOLE(0, INT64_MAX), frames, "stop after N frames (default: 600 without --runtime)") \
    SHARED("runtime", 0, "T", option_time, run_time, "stop after a time T: seconds, or minutes and hours as m:s or h:m:s")
// The clock.
#define FPS_OPTION \
    SHARED("fps", 0, "F", option_fps, fps, "set the frames per second (default: 60); '%pragma fps' in a script overrides it")
#define CLOCK_OPTIONS \
    FPS_OPTION \
    SHARED("lockstep", 0, NULL, option_unset, realtime, "run as fast as possible with time = frame/fps (default)") \
    SHARED("realtime", 0, NULL, option_flag, realtime, "follow the wall clock; frame 0 is at time 0")
// The script and its state.
#define DEFINE_OPTION \
    SHARED("define", 'D', "NAME=VALUE", option_definition, definitions, "set a parameter of the script; may be repeated")
#define DEFINE_NAME_OPTION \
    SHARED("define", 'D', "NAME=VALUE", option_definition, definitions, "define a name for the scripts; may be repeated")
#define STATE_OPTION \
    SHARED("state", 0, "FILE", NOT_IN_GOLDENS(option_text), state_file, "load the state from FILE if the file exists; save the state to FILE")
// Files that scripts may use.
#define ALLOW_READ_OPTION \
    SHARED("allow-read", 0, "DIR", option_folder, read_folders, "also allow reading below DIR; `all`: everywhere")
#define NO_FILES_OPTION \
    SHARED("no-files", 0, NULL, option_flag, no_files, "forbid reading and writing files")
#define READ_OPTIONS \
    ALLOW_READ_OPTION \
    NO_FILES_OPTION
#define FILE_OPTIONS \
    ALLOW_READ_OPTION \
    SHARED("allow-write", 0, "DIR", NOT_IN_GOLDENS(option_folder), write_folders, "also allow writing pictures (!record) below DIR; `all`: everywhere") \
    NO_FILES_OPTION
// Limits, and how the session computes.
#define THREADS_OPTION \
    SHARED("threads", 0, "N", WHOLE(1, 1024), threads, "use N worker threads (default: number of CPUs); does not change results")
#define MEMORY_OPTION \
    SHARED("memory", 0, "BYTES", option_amount, memory, "limit the script's memory, e.g. 512M (default: 2G)")
#define LIMIT_OPTIONS \
    MEMORY_OPTION \
    SHARED("work", 0, "N", option_amount, work, "limit each frame to N units of work (default: 1G, about 10 s)")
#define NOSIMPLIFY_OPTION \
    SHARED("nosimplify", 0, NULL, option_flag, unsimplified, "evaluate the whole script in every frame, without simplifying it; does not change results")
#define METHOD_OPTIONS \
    SHARED("neighbours", 0, "WHEN", ONE_OF(option_choice, "auto", "never", "always"), neighbours, "use neighbour lists: auto, never or always; does not change results") \
    NOSIMPLIFY_OPTION
#define NO_BATCHES_OPTION \
    SHARED("no-batches", 0, NULL, ENDS_SHOW(NOT_IN_GOLDENS(option_flag)), no_batches, "execute the iterations of loops one by one; does not change results")
// Archives.
#define FROM_OPTION \
    SHARED("from", 0, "FRAME", NOT_IN_GOLDENS(WHOLE(0, INT64_MAX - 1)), from, "start the replay of an archive with this frame (default: the first)")
#define RECORDING_OPTIONS \
    SHARED("archive", 0, "FILE", NOT_IN_GOLDENS(option_text), archive, "write an archive of the run, which 'petri archive verify' can verify, to FILE.petri") \
    FROM_OPTION \
    SHARED("keyframe-every", 0, "N", NOT_IN_GOLDENS(WHOLE(1, INT64_MAX - 1)), keyframe_every, "store the state in the archive every N frames (default: 1000)") \
    SHARED("digest-every", 0, "K", NOT_IN_GOLDENS(WHOLE(1, INT64_MAX - 1)), digest_every, "store a digest of every K-th frame in the archive (default: 1)")
// Messages.
#define QUIET_OPTION \
    SHARED("quiet", 0, NULL, VERBOSITY(LOG_QUIET), verbosity, "report only errors")
#define COLOUR_OPTION \
    SHARED("color", 0, "WHEN", ONE_OF(option_colour, "auto", "always", "never"), colour, "use colours in messages: auto, always or never")
#define REPORT_OPTIONS \
    QUIET_OPTION \
    SHARED("verbose", 0, NULL, VERBOSITY(LOG_VERBOSE), verbosity, "also report a summary at the end") \
    SHARED("debug", 0, NULL, VERBOSITY(LOG_DEBUG), verbosity, "also report the time that each printed frame took") \
    SHARED("trace", 0, NULL, VERBOSITY(LOG_TRACE), verbosity, "also report the time that every frame took") \
    COLOUR_OPTION
// clang-format on
