// run_options.c: the command lines of `petri run` and of those that run scripts as it does.
#include "run/run_options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/args.h"
#include "cli/script.h"
#include "petri.h"
#include "run/trajectory.h"

enum { DEFAULT_FRAMES = 600, MOST_THREADS = 1024 };

enum {
    OPT_FRAMES = 1,
    OPT_RUNTIME,
    OPT_FPS,
    OPT_LOCKSTEP,
    OPT_REALTIME,
    OPT_DEFINE,
    OPT_PRINT,
    OPT_EVERY,
    OPT_STATE,
    OPT_THREADS,
    OPT_NEIGHBOURS,
    OPT_NOSIMPLIFY,
    OPT_PROFILE,
    OPT_QUIET,
    OPT_VERBOSE,
    OPT_DEBUG,
    OPT_TRACE,
    OPT_COLOR,
    OPT_DUMP,
    OPT_STATS,
    OPT_TRAJECTORY,
    OPT_OUTPUT,
    OPT_FORMAT,
    OPT_FRAME,
    OPT_SIZE,
    OPT_SCALE,
    OPT_AUTO,
    OPT_TERMINAL,
    OPT_SHOW,
    OPT_PARAMETERS,
};

// Options that mean the same everywhere, by where help lists them.
#define FRAME_RATE                                                                                                     \
    { "fps", 0, OPT_FPS, "F", "frames per second (60); a script's %pragma fps wins" }
#define WORLD_OPTIONS                                                                                                  \
    {"define", 'D', OPT_DEFINE, "NAME=VALUE", "set a parameter of the script; may be repeated"},                       \
        {"state", 0, OPT_STATE, "FILE", "go on from the state in FILE, if it exists, and keep it there"},              \
        {"threads", 0, OPT_THREADS, "N", "worker threads (as many as CPUs); results never depend on it"},              \
        {"neighbours", 0, OPT_NEIGHBOURS, "WHEN",                                                                      \
         "lists of neighbours in physics: auto, never or always; results never depend on it"},                         \
    {                                                                                                                  \
        "nosimplify", 0, OPT_NOSIMPLIFY, NULL, "evaluate everything in every frame; results never depend on it"        \
    }
#define LOG_OPTIONS                                                                                                    \
    {"quiet", 0, OPT_QUIET, NULL, "report errors only"},                                                               \
        {"verbose", 0, OPT_VERBOSE, NULL, "also report a summary at the end"},                                         \
        {"debug", 0, OPT_DEBUG, NULL, "also report the time that each printed frame took"},                            \
        {"trace", 0, OPT_TRACE, NULL, "also report the time that every frame took"}, {                                 \
        "color", 0, OPT_COLOR, "WHEN", "colour messages: auto, always or never"                                        \
    }

const OptionSpec RUN_OPTION_SPECS[] = {
    {"frames", 0, OPT_FRAMES, "N", "stop after N frames (600 if neither this nor --runtime is given)"},
    {"runtime", 0, OPT_RUNTIME, "T", "stop after T seconds, or a time code (m:s, h:m:s)"},
    FRAME_RATE,
    {"lockstep", 0, OPT_LOCKSTEP, NULL, "time is frame/fps, as fast as possible (the default)"},
    {"realtime", 0, OPT_REALTIME, NULL, "follow the wall clock; time counts from frame 0"},
    {"print", 0, OPT_PRINT, "LIST",
     "print tree, state, log, error (any of them, with commas); logs alone if not given"},
    {"every", 0, OPT_EVERY, "K", "print and record each K-th frame, starting with frame 0"},
    WORLD_OPTIONS,
    {"show", 0, OPT_SHOW, NULL, "on a terminal, show its picture there, if it has one and no text is asked for"},
    {"stats", 0, OPT_STATS, NULL, "close with a table of times, speeds and each system's energy"},
    {"trajectory", 0, OPT_TRAJECTORY, "FILE", "write where the particles are to FILE.xyz (extended XYZ) or FILE.csv"},
    {"profile", 0, OPT_PROFILE, NULL, "close with the time that each line of the script took, the slowest first"},
    LOG_OPTIONS,
    {"parameters", 0, OPT_PARAMETERS, NULL, "list what -D can set: name, default, range and comment; do not run it"},
    {"dump", 0, OPT_DUMP, "WHAT", "print the script's ast or code and do not run it"},
    {0},
};

const OptionSpec RENDER_OPTION_SPECS[] = {
    {"output", 'o', OPT_OUTPUT, "FILE",
     "OUT.png, OUT%05d.png (a series), OUT.svg, OUT.pdf, OUT.mp4, OUT.webm or OUT.gif; - for standard output"},
    {"format", 0, OPT_FORMAT, "F", "what '-o -' writes: png (if not given), svg, pdf, mp4, webm or gif"},
    {"frame", 0, OPT_FRAME, "N", "draw frame N (0 is the first); the last one if not given"},
    {"frames", 0, OPT_FRAMES, "N", "stop after N frames (600 if neither this nor --runtime is given)"},
    {"runtime", 0, OPT_RUNTIME, "T", "stop after T seconds, or a time code (m:s, h:m:s)"},
    {"every", 0, OPT_EVERY, "K", "draw each K-th frame, starting with the first"},
    {"size", 0, OPT_SIZE, "WxH", "size of the picture in pixels (that of the script's window)"},
    {"scale", 0, OPT_SCALE, "S", "S pixels for each unit of the window's size (1)"},
    {"auto", 0, OPT_AUTO, NULL, "draw the particles themselves, not the script's own canvas"},
    FRAME_RATE,
    {"lockstep", 0, OPT_LOCKSTEP, NULL, "time is frame/fps, as fast as possible (the default)"},
    {"realtime", 0, OPT_REALTIME, NULL, "follow the wall clock; time counts from frame 0"},
    WORLD_OPTIONS,
    LOG_OPTIONS,
    {0},
};

const OptionSpec VIEW_OPTION_SPECS[] = {
    {"terminal", 0, OPT_TERMINAL, NULL, "show it in the terminal, even if there is a display"},
    {"auto", 0, OPT_AUTO, NULL, "show the particles themselves, not the script's own canvas"},
    {"frames", 0, OPT_FRAMES, "N", "close after N frames"},
    {"runtime", 0, OPT_RUNTIME, "T", "close after T seconds, or a time code (m:s, h:m:s)"},
    FRAME_RATE,
    {"lockstep", 0, OPT_LOCKSTEP, NULL, "time is frame/fps, as fast as possible"},
    {"realtime", 0, OPT_REALTIME, NULL, "follow the wall clock (the default); time counts from frame 0"},
    WORLD_OPTIONS,
    LOG_OPTIONS,
    {0},
};

static bool section_bit(const char *word, size_t length, unsigned *bit) {
    static const struct {
        const char *name;
        unsigned bit;
    } names[] = {
        {"tree", PETRI_PRINT_TREE},
        {"state", PETRI_PRINT_STATE},
        {"log", PETRI_PRINT_LOG},
        {"error", PETRI_PRINT_ERROR},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strlen(names[i].name) == length && memcmp(names[i].name, word, length) == 0) {
            *bit = names[i].bit;
            return true;
        }
    }
    return false;
}

static bool read_sections(const Args *args, unsigned *sections) {
    *sections = 0;
    const char *word = args->value;
    for (;;) {
        size_t length = strcspn(word, ",");
        unsigned bit = 0;
        if (!section_bit(word, length, &bit)) {
            return args_wrong_value(args, "a list of tree, state, log, error");
        }
        *sections |= bit;
        if (word[length] == '\0') {
            return true;
        }
        word += length + 1;
    }
}

static bool read_run_time(const Args *args, double *seconds) {
    if (!petri_read_number(args->value, seconds) || !isfinite(*seconds) || *seconds < 0) {
        return args_wrong_value(args, "seconds or a time code");
    }
    return true;
}

static bool read_dump(const Args *args, int *dump) {
    static const char *const words[] = {"ast", "code", NULL};
    int choice = 0;
    if (!args_choice(args, words, &choice)) {
        return false;
    }
    *dump = choice == 0 ? PETRI_DUMP_AST : PETRI_DUMP_CODE;
    return true;
}

static bool read_trajectory(const Args *args, const char **file) {
    TrajectoryFormat format;
    if (!trajectory_format(args->value, &format)) {
        return args_wrong_value(args, "a file name that ends in .xyz or .csv");
    }
    *file = args->value;
    return true;
}

static bool read_threads(const Args *args, int *threads) {
    int64_t number = 0;
    if (!args_integer(args, 1, MOST_THREADS, &number)) {
        return false;
    }
    *threads = (int)number;
    return true;
}

static bool read_definition(const Args *args, RunOptions *options) {
    const char *equals = strchr(args->value, '=');
    if (equals == NULL || equals == args->value) {
        return args_wrong_value(args, "NAME=VALUE");
    }
    options->definitions[options->definition_count++] = args->value;
    return true;
}

// WIDTHxHEIGHT.
static bool read_size(const Args *args, RunOptions *options) {
    char *end = NULL;
    long width = strtol(args->value, &end, 10);
    long height = end != args->value && (*end == 'x' || *end == 'X') ? strtol(end + 1, &end, 10) : 0;
    if (*end != '\0' || width < 1 || height < 1 || width > PETRI_MOST_PIXELS || height > PETRI_MOST_PIXELS) {
        char expected[80];
        snprintf(expected, sizeof expected, "WIDTHxHEIGHT, each from 1 to %d", PETRI_MOST_PIXELS);
        return args_wrong_value(args, expected);
    }
    options->width = (int)width;
    options->height = (int)height;
    return true;
}

static bool read_script(const Args *args, RunOptions *options) {
    if (options->script != NULL) {
        script_second(options->script, args->value);
        return false;
    }
    if (args->value[0] == '\0') {
        message("the name of the script is empty");
        return false;
    }
    if (args->command->live && script_is_stdin(args->value)) {
        message("'petri %s' follows its script's file as it is saved and cannot take it from standard input; "
                "'petri render -' can",
                args->command->name);
        return false;
    }
    options->script = args->value;
    return true;
}

// The script and the options with a value; false after a message.
static bool apply_option(const Args *args, int id, RunOptions *options) {
    switch (id) {
    case ARG_OPERAND:
        return read_script(args, options);
    case OPT_FRAMES:
        return args_integer(args, 0, INT64_MAX, &options->frames);
    case OPT_RUNTIME:
        return read_run_time(args, &options->run_time);
    case OPT_FPS:
        return args_positive(args, &options->fps);
    case OPT_DEFINE:
        return read_definition(args, options);
    case OPT_PRINT:
        return read_sections(args, &options->sections);
    case OPT_EVERY:
        return args_integer(args, 1, INT64_MAX, &options->every);
    case OPT_STATE:
        options->state_file = args->value;
        return true;
    case OPT_THREADS:
        return read_threads(args, &options->threads);
    case OPT_NEIGHBOURS:
        return args_choice(args, (const char *const[]){"auto", "never", "always", NULL}, &options->neighbours);
    case OPT_COLOR:
        options->monochrome = strcmp(args->value, "never") == 0;
        return args_colour(args, &options->colour);
    case OPT_DUMP:
        return read_dump(args, &options->dump);
    case OPT_OUTPUT:
        options->output = args->value;
        return true;
    case OPT_FORMAT:
        options->format = args->value;
        return true;
    case OPT_FRAME:
        return args_integer(args, 0, INT64_MAX - 1, &options->frame);
    case OPT_SIZE:
        return read_size(args, options);
    case OPT_SCALE:
        return args_positive(args, &options->scale);
    case OPT_TRAJECTORY:
        return read_trajectory(args, &options->trajectory);
    default:
        return false;
    }
}

// Options without a value; false if `id` is none of them.
static bool apply_flag(int id, RunOptions *options) {
    switch (id) {
    case OPT_LOCKSTEP:
    case OPT_REALTIME:
        options->realtime = id == OPT_REALTIME;
        return true;
    case OPT_NOSIMPLIFY:
        options->simplify = false;
        return true;
    case OPT_PROFILE:
        options->profile = true;
        return true;
    case OPT_SHOW:
        options->show = true;
        return true;
    case OPT_PARAMETERS:
        options->parameters = true;
        return true;
    case OPT_STATS:
        options->stats = true;
        return true;
    case OPT_TERMINAL:
        options->terminal = true;
        return true;
    case OPT_AUTO:
        options->automatic = true;
        return true;
    case OPT_QUIET:
        options->verbosity = LOG_QUIET;
        return true;
    case OPT_VERBOSE:
        options->verbosity = LOG_VERBOSE;
        return true;
    case OPT_DEBUG:
        options->verbosity = LOG_DEBUG;
        return true;
    case OPT_TRACE:
        options->verbosity = LOG_TRACE;
        return true;
    default:
        return false;
    }
}

static int read_all(RunOptions *options, Args *args) {
    for (int id = args_next(args); id != ARG_END; id = args_next(args)) {
        if (id == ARG_HELP) {
            return args_help(args);
        }
        if (id == ARG_WRONG || (!apply_flag(id, options) && !apply_option(args, id, options))) {
            return STATUS_USAGE;
        }
    }
    if (options->script == NULL) {
        message("no script was given; usage: petri %s [options] SCRIPT.fl", args->command->name);
        return STATUS_USAGE;
    }
    return RUN_OPTIONS_OK;
}

int run_options_read(RunOptions *options, const Command *command, int argc, char **argv) {
    *options = (RunOptions){
        .frames = -1,
        .run_time = NAN,
        .fps = 60,
        .realtime = command->live,
        .every = 1,
        .frame = -1,
        .scale = 1,
        .verbosity = LOG_NORMAL,
        .colour = colour_by_default(),
        .monochrome = getenv("NO_COLOR") != NULL && getenv("NO_COLOR")[0] != '\0',
        .simplify = true,
        .dump = -1,
    };
    // Each definition takes at least one word.
    options->definitions = calloc((size_t)argc + 1, sizeof *options->definitions);
    if (options->definitions == NULL) {
        message("out of memory");
        return STATUS_FAILED;
    }
    Args args = args_start(command, argc, argv);
    int status = read_all(options, &args);
    if (options->frames < 0) {
        options->frames = isnan(options->run_time) && !command->live ? DEFAULT_FRAMES : INT64_MAX;
    }
    return status;
}

void run_options_free(RunOptions *options) {
    free(options->definitions);
    options->definitions = NULL;
}

int run_options_open(const RunOptions *options, const Host *host,
                     void (*diagnostic)(void *context, const PetriDiagnostic *diagnostic), void *context,
                     PetriSession **session) {
    PetriOptions wanted = petri_default_options();
    wanted.fps = options->fps;
    wanted.realtime = options->realtime;
    wanted.run_time = options->run_time;
    wanted.colour = options->colour;
    wanted.stack_bytes = host->stack_bytes;
    wanted.threads = options->threads;
    wanted.neighbours = (PetriNeighbours)options->neighbours;
    wanted.simplify = options->simplify;
    wanted.profile = options->profile;
    wanted.diagnostic = diagnostic;
    wanted.host = context;
    *session = petri_open(&wanted);
    if (*session == NULL) {
        message("out of memory");
        return STATUS_FAILED;
    }
    for (size_t i = 0; i < options->definition_count; i++) {
        if (petri_define(*session, options->definitions[i]) != PETRI_OK) {
            message("option '--define' expects NAME=VALUE, not '%s'", options->definitions[i]);
            petri_close(session);
            return STATUS_USAGE;
        }
    }
    return RUN_OPTIONS_OK;
}
