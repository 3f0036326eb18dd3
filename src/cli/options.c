// options.c: see options.h.
#include "cli/options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/args.h"
#include "cli/bytes.h"
#include "cli/script.h"
#include "petri-draw.h"

enum { DEFAULT_FRAMES = 600, MOST_THREADS = 1024, MOST_JOBS = 256 };

// Readers take the value of an option into a field of the Options; false after a message.

static bool read_flag(const Args *args, Options *options, void *field) {
    (void)args;
    (void)options;
    *(bool *)field = true;
    return true;
}

static bool read_unset(const Args *args, Options *options, void *field) {
    (void)args;
    (void)options;
    *(bool *)field = false;
    return true;
}

static bool read_text(const Args *args, Options *options, void *field) {
    (void)options;
    *(const char **)field = args->value;
    return true;
}

static bool read_count(const Args *args, Options *options, void *field) {
    (void)options;
    return args_integer(args, 0, INT64_MAX, field);
}

static bool read_frame(const Args *args, Options *options, void *field) {
    (void)options;
    return args_integer(args, 0, INT64_MAX - 1, field);
}

static bool read_from_one(const Args *args, Options *options, void *field) {
    (void)options;
    return args_integer(args, 1, INT64_MAX, field);
}

static bool read_threads(const Args *args, Options *options, void *field) {
    (void)options;
    return args_integer(args, 1, MOST_THREADS, field);
}

static bool read_jobs(const Args *args, Options *options, void *field) {
    (void)options;
    return args_integer(args, 1, MOST_JOBS, field);
}

static bool read_positive(const Args *args, Options *options, void *field) {
    (void)options;
    return args_positive(args, field);
}

static bool read_fps(const Args *args, Options *options, void *field) {
    options->fps_given = true;
    return args_positive(args, field);
}

static bool read_time(const Args *args, Options *options, void *field) {
    (void)options;
    double seconds = 0;
    bool good = petri_read_number(args->value, &seconds) && isfinite(seconds) && seconds >= 0;
    *(double *)field = seconds;
    return good || args_wrong_value(args, "seconds or a time code");
}

static bool section_bit(const char *word, size_t length, unsigned *bit) {
    static const struct {
        const char *name;
        unsigned bit;
    } names[] = {
        {"tree", PETRI_PRINT_TREE},   {"state", PETRI_PRINT_STATE}, {"log", PETRI_PRINT_LOG},
        {"error", PETRI_PRINT_ERROR}, {"hash", PETRI_PRINT_HASH},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strlen(names[i].name) == length && memcmp(names[i].name, word, length) == 0) {
            *bit = names[i].bit;
            return true;
        }
    }
    return false;
}

static bool read_sections(const Args *args, Options *options, void *field) {
    unsigned *sections = field;
    (void)options;
    *sections = 0;
    for (const char *word = args->value;; word++) {
        size_t length = strcspn(word, ",");
        unsigned bit = 0;
        if (!section_bit(word, length, &bit)) {
            return args_wrong_value(args, "a list of tree, state, log, error, hash");
        }
        *sections |= bit;
        word += length;
        if (*word == '\0') {
            return true;
        }
    }
}

static bool read_dump(const Args *args, Options *options, void *field) {
    int choice = 0;
    (void)options;
    bool good = args_choice(args, (const char *const[]){"ast", "code", NULL}, &choice);
    *(int *)field = choice == 0 ? PETRI_DUMP_AST : PETRI_DUMP_CODE;
    return good;
}

static bool read_neighbours(const Args *args, Options *options, void *field) {
    (void)options;
    return args_choice(args, (const char *const[]){"auto", "never", "always", NULL}, field);
}

static bool read_trajectory(const Args *args, Options *options, void *field) {
    const char *dot = strrchr(args->value, '.');
    bool known = dot != NULL && dot != args->value && (strcmp(dot, ".xyz") == 0 || strcmp(dot, ".csv") == 0);
    return known ? read_text(args, options, field) : args_wrong_value(args, "a file name that ends in .xyz or .csv");
}

// --quiet, --verbose, --debug, --trace.
static bool read_verbosity(const Args *args, Options *options, void *field) {
    (void)options;
    char first = args->option->name[0];
    *(Verbosity *)field = first == 'q' ? LOG_QUIET : first == 'v' ? LOG_VERBOSE : first == 'd' ? LOG_DEBUG : LOG_TRACE;
    return true;
}

static bool read_colour(const Args *args, Options *options, void *field) {
    options->monochrome = strcmp(args->value, "never") == 0;
    return args_colour(args, field);
}

static bool read_definition(const Args *args, Options *options, void *field) {
    (void)field;
    const char *equals = strchr(args->value, '=');
    if (equals == NULL || equals == args->value) {
        return args_wrong_value(args, "NAME=VALUE");
    }
    options->definitions[options->definition_count++] = args->value;
    return true;
}

// A folder, for a list that ends in NULL; "all" stands for the folder that all is in.
static bool read_folder(const Args *args, Options *options, void *field) {
    const char ***list = field;
    const char *folder = strcmp(args->value, "all") == 0 ? "/" : args->value;
    struct stat info;
    (void)options;
    if (stat(folder, &info) != 0 || !S_ISDIR(info.st_mode)) {
        return args_wrong_value(args, "a folder that is there");
    }
    size_t count = 0;
    while (*list != NULL && (*list)[count] != NULL) {
        count++;
    }
    *list = memory_resized(*list, (count + 2) * sizeof **list);
    (*list)[count] = folder;
    (*list)[count + 1] = NULL;
    return true;
}

// WIDTHxHEIGHT.
static bool read_size(const Args *args, Options *options, void *field) {
    (void)options;
    char *end = NULL;
    long width = strtol(args->value, &end, 10);
    long height = end != args->value && (*end == 'x' || *end == 'X') ? strtol(end + 1, &end, 10) : 0;
    if (*end != '\0' || width < 1 || height < 1 || width > PETRI_MOST_PIXELS || height > PETRI_MOST_PIXELS) {
        char expected[80];
        snprintf(expected, sizeof expected, "WIDTHxHEIGHT, each from 1 to %d", PETRI_MOST_PIXELS);
        return args_wrong_value(args, expected);
    }
    *(Size *)field = (Size){(int)width, (int)height};
    return true;
}

const OptionSpec OPTIONS[] = {
#define FIELD(type, name, at_first)
#define OPTION(commands, name, letter, value, reader, field, help)                                                     \
    {commands, name, letter, value, help, reader, offsetof(Options, field)},
#include "cli/option_list.h"
#undef FIELD
#undef OPTION
    {0},
};

static bool read_operand(const Args *args, Options *options) {
    const Command *command = args->command;
    bool is_stdin = script_is_stdin(args->value);
    options->has_path = true;
    if (is_stdin && command->no_stdin != NULL && (command->many || options->script == NULL)) {
        message("%s", command->no_stdin);
        return false;
    }
    if (command->many && is_stdin) {
        scripts_add(&options->scripts, args->value);
    } else if (command->many) {
        options->unreadable = !scripts_find(&options->scripts, args->value) || options->unreadable;
    } else if (options->script != NULL) {
        script_second(options->script, args->value);
        return false;
    } else if (args->value[0] == '\0') {
        message("the name of the script is empty");
        return false;
    } else {
        options->script = args->value;
    }
    return true;
}

static int read_all(Options *options, Args *args) {
    for (int id = args_next(args); id != ARG_END; id = args_next(args)) {
        if (id == ARG_HELP) {
            return args_help(args);
        }
        const OptionSpec *spec = args->option;
        bool good = id == ARG_OPERAND  ? read_operand(args, options)
                    : id == ARG_OPTION ? spec->read(args, options, (char *)options + spec->field)
                                       : false;
        if (!good) {
            return STATUS_USAGE;
        }
    }
    if (!options->has_path && args->command->needed != NULL) {
        message("%s; usage: petri %s [options] %s", args->command->needed, args->command->name,
                args->command->operands);
        return STATUS_USAGE;
    }
    scripts_sort(&options->scripts);
    return OPTIONS_READ;
}

static bool no_colour(void) {
    const char *refused = getenv("NO_COLOR");
    return refused != NULL && refused[0] != '\0';
}

int options_read(Options *options, const Command *command, int argc, char **argv) {
    *options = (Options){
#define FIELD(type, name, at_first) .name = at_first,
#define OPTION(commands, name, letter, value, reader, field, help)
#include "cli/option_list.h"
#undef FIELD
#undef OPTION
        // Each definition takes at least one word.
        .definitions = memory_zeroed(((size_t)argc + 1) * sizeof *options->definitions),
    };
    options->realtime = command->live;
    Args args = args_start(command, argc, argv);
    int status = read_all(options, &args);
    if (options->frames < 0) {
        options->frames = isnan(options->run_time) && !command->live ? DEFAULT_FRAMES : INT64_MAX;
    }
    return status;
}

void options_free(Options *options) {
    free(options->definitions);
    options->definitions = NULL;
    free(options->read_folders);
    free(options->write_folders);
    options->read_folders = options->write_folders = NULL;
    scripts_free(&options->scripts);
}

int options_open(const Options *options, const Host *host,
                 void (*diagnostic)(void *context, const PetriDiagnostic *diagnostic), void *context,
                 PetriSession **session) {
    PetriOptions wanted = petri_default_options();
    wanted.fps = options->fps;
    wanted.realtime = options->realtime;
    wanted.run_time = options->run_time;
    wanted.colour = options->colour;
    wanted.stack_bytes = host->stack_bytes;
    wanted.threads = (int)options->threads;
    wanted.neighbours = (PetriNeighbours)options->neighbours;
    wanted.simplify = !options->unsimplified;
    wanted.keep_forces = wanted.interruptible = options->prompt;
    wanted.profile = options->profile;
    wanted.read_folders = options->read_folders;
    wanted.write_folders = options->write_folders;
    wanted.no_files = options->no_files;
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
    return OPTIONS_READ;
}
