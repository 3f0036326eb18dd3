// options.c: see options.h.
#include "cli/options.h"

#include "base/clock.h"
#include "cli/archive.h"
#include "cli/args.h"
#include "cli/memory.h"
#include "cli/motion.h"
#include "cli/progress.h"
#include "cli/script.h"
#include "petri-draw.h"
#include "petri-edit.h"
#include "petri-inspect.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { DEFAULT_FRAMES = 600 };

// The read_ functions parse args->value and store it in a field of Options. They return false after a message.

// Reports an invalid value and what is expected. Returns false.
static bool report_invalid_value(const Args *args, const char *expected) {
    message("option '--%s' expects %s, not '%s'", args->option->name, expected, args->value);
    return false;
}

static bool read_flag(const Args *args, void *field) {
    (void)args;
    *(bool *)field = true;
    return true;
}

static bool read_unset(const Args *args, void *field) {
    (void)args;
    *(bool *)field = false;
    return true;
}

// Reads --quiet, --verbose, --debug or --trace. The level is in option->min.
static bool read_verbosity(const Args *args, void *field) {
    *(Verbosity *)field = (Verbosity)args->option->min;
    return true;
}

static bool read_text(const Args *args, void *field) {
    *(const char **)field = args->value;
    return true;
}

static bool read_integer(const Args *args, void *field) {
    const OptionSpec *option = args->option;
    char *end = NULL;
    errno = 0;
    intmax_t value = strtoimax(args->value, &end, 10);
    bool is_number = args->value[0] >= '-' && end != args->value && *end == '\0';
    if (!is_number || errno != 0 || value < option->min || value > option->max) {
        SCOPED_TEXT expected = {0};
        if (option->max < INT64_MAX - 1)
            text_add_format(&expected, "an integer from %" PRId64 " to %" PRId64, option->min, option->max);
        else
            text_add_format(&expected, "an integer >= %" PRId64, option->min);
        return report_invalid_value(args, expected.bytes);
    }
    *(int64_t *)field = value;
    return true;
}

static bool read_positive(const Args *args, void *field) {
    double value = 0;
    bool good = petri_parse_number(args->value, &value) && isfinite(value) && value > 0;
    *(double *)field = value;
    return good || report_invalid_value(args, "a positive number");
}

// Reads an amount such as 512M. K, M, G and T multiply by 2^10, 2^20, 2^30 and 2^40.
static bool read_amount(const Args *args, void *field) {
    static const char suffixes[] = "KMGT";
    char *end = NULL;
    double amount = strtod(args->value, &end);
    const char *suffix = end == args->value || *end == '\0' ? NULL : strchr(suffixes, *end & ~0x20);
    if (suffix) {
        amount = ldexp(amount, 10 * (int)(suffix - suffixes + 1));
        end++;
    }
    *(uint64_t *)field = amount >= 1 && amount <= 0x1p62 ? (uint64_t)amount : 0;
    bool good = end != args->value && *end == '\0' && *(uint64_t *)field > 0;
    return good || report_invalid_value(args, "a number >= 1, such as 500M or 2G");
}

static bool read_fps(const Args *args, void *field) {
    args->options->fps_given = true;
    return read_positive(args, field);
}

static bool read_percentage(const Args *args, void *field) {
    char *end = NULL;
    double value = *(double *)field = strtod(args->value, &end);
    end += *end == '%';
    bool good = end != args->value && *end == '\0' && value >= 0 && value <= 100;
    return good || report_invalid_value(args, "a percentage such as 1%");
}

static bool read_time(const Args *args, void *field) {
    double seconds = 0;
    bool good = petri_parse_number(args->value, &seconds) && isfinite(seconds) && seconds >= 0;
    *(double *)field = seconds;
    return good || report_invalid_value(args, "seconds or a time code such as 1:30");
}

// Returns the index of a word in a list that ends with NULL, or -1 if it is not in the list.
static int find_word(const char *const *words, const char *word) {
    int i = 0;
    while (words[i] && strcmp(words[i], word) != 0)
        i++;
    return words[i] ? i : -1;
}

// Reads one of option->words and stores its index.
static bool read_choice(const Args *args, void *field) {
    const char *const *words = args->option->words;
    int choice = *(int *)field = find_word(words, args->value);
    if (choice < 0) {
        SCOPED_TEXT expected = {0};
        for (int i = 0; words[i]; i++)
            text_add_format(&expected, "%s %s", i == 0 ? "one of" : ",", words[i]);
        return report_invalid_value(args, expected.bytes);
    }
    return true;
}

// Reads a list of option->words and stores the PETRI_PRINT_... bits. The words are in the order of the bits.
static bool read_sections(const Args *args, void *field) {
    unsigned *sections = field;
    SCOPED_STRING list = memory_strdup(args->value);
    *sections = 0;
    for (char *rest = list; rest;) {
        int section = find_word(args->option->words, str_split(&rest, ','));
        if (section < 0)
            return report_invalid_value(args,
                                        "one or more of tree, state, log, error, hash and digest, separated by commas");
        *sections |= (unsigned)PETRI_PRINT_TREE << section;
    }
    return true;
}

static bool read_trajectory(const Args *args, void *field) {
    bool known = script_suffix(args->value, ".xyz .csv .h5 .h5md") >= 0;
    return known ? read_text(args, field) : report_invalid_value(args, "a file name that ends in .xyz, .csv or .h5");
}

static bool no_colour(void) {
    const char *refused = getenv("NO_COLOR");
    return refused && refused[0] != '\0';
}

// Returns true if messages are coloured when --color is not given.
static bool colour_by_default(void) {
    return progress_possible() && !no_colour();
}

static bool read_colour(const Args *args, void *field) {
    int choice = 0;
    bool good = read_choice(args, &choice);
    args->options->monochrome = choice == 2;
    *(bool *)field = choice == 0 ? colour_by_default() : choice == 1;
    return good;
}

static bool read_definition(const Args *args, void *field) {
    const char *equals = strchr(args->value, '=');
    if (!equals || equals == args->value)
        return report_invalid_value(args, args->option->value);
    texts_add(field, args->value);
    return true;
}

// Reads NAME=EXPR or the name of a quantity (motion.h).
static bool read_metric(const Args *args, void *field) {
    if (motion_quantity(args->value) == MOTION_QUANTITIES && !strchr(args->value, '='))
        return report_invalid_value(
            args, "NAME=EXPR, energy, kinetic_energy, potential_energy, momentum or angular_momentum");
    if (strchr(args->value, '=') == args->value)
        return report_invalid_value(args, args->option->value);
    texts_add(field, args->value);
    return true;
}

// Reads a folder and adds it to a list. "all" means the root folder.
static bool read_folder(const Args *args, void *field) {
    const char *folder = strcmp(args->value, "all") == 0 ? "/" : args->value;
    struct stat info;
    if (stat(folder, &info) != 0 || !S_ISDIR(info.st_mode))
        return report_invalid_value(args, "an existing folder");
    texts_add(field, folder);
    return true;
}

// Reads WIDTHxHEIGHT, in pixels.
static bool read_size(const Args *args, void *field) {
    char *end = NULL;
    long width = strtol(args->value, &end, 10);
    long height = end != args->value && (*end == 'x' || *end == 'X') ? strtol(end + 1, &end, 10) : 0;
    if (*end != '\0' || width < 1 || height < 1 || width > PETRI_MAX_PICTURE_SIDE || height > PETRI_MAX_PICTURE_SIDE) {
        SCOPED_TEXT expected = {0};
        text_add_format(&expected, "WIDTHxHEIGHT, each from 1 to %d", PETRI_MAX_PICTURE_SIDE);
        return report_invalid_value(args, expected.bytes);
    }
    *(Size *)field = (Size){(int)width, (int)height};
    return true;
}

// Values for the argument `reader` of OPTION in option_list.h: a reader with its parameters.
#define WHOLE(from, to) read_integer, .min = from, .max = to
#define VERBOSITY(level) read_verbosity, .min = level
#define ONE_OF(reader, ...)                                                                                            \
    reader, .words = (const char *const[]) {                                                                           \
        __VA_ARGS__, NULL                                                                                              \
    }

const OptionSpec OPTIONS[] = {
#define FIELD(type, name, at_first)
#define OPTION(who, long_name, short_name, shown, reader, into, text)                                                  \
    {.commands = who,                                                                                                  \
     .name = long_name,                                                                                                \
     .letter = short_name,                                                                                             \
     .value = shown,                                                                                                   \
     .help = text,                                                                                                     \
     .field = offsetof(Options, into),                                                                                 \
     .read = reader},
#include "cli/option_list.h"
#undef FIELD
#undef OPTION
    {.name = NULL},
};

static bool read_operand(const Args *args) {
    const Command *command = args->command;
    Options *options = args->options;
    bool is_stdin = script_is_stdin(args->value);
    if (is_stdin && command->no_stdin && (command->accepts_many || !options->script)) {
        message("%s", command->no_stdin);
        return false;
    }
    if (command->accepts_many && is_stdin) {
        scripts_add(&options->scripts, args->value);
    } else if (command->accepts_many) {
        options->scripts.goldens = command->options == FOR_TEST;
        if (!scripts_find(&options->scripts, args->value))
            texts_add(&options->unreadable, args->value);
    } else if (options->script && command->accepts_two && !options->second) {
        options->second = args->value;
        return true;
    } else if (options->script && command->second_operand_error) {
        message(command->second_operand_error, args->value);
        return false;
    } else if (options->script) {
        script_report_second(options->script, args->value);
        return false;
    } else if (args->value[0] == '\0' && command->options != 0) {
        message("the script name is empty");
        return false;
    }
    options->script = args->value;
    return true;
}

static int read_all(Args *args) {
    for (int id = args_next(args); id != ARG_END; id = args_next(args)) {
        if (id == ARG_HELP)
            return args->version ? help_version() : help_for(args->command);
        bool good = id == ARG_OPERAND  ? read_operand(args)
                    : id == ARG_OPTION ? args->option->read(args, (char *)args->options + args->option->field)
                                       : false;
        if (!good)
            return STATUS_USAGE;
    }
    if (!args->options->script && args->command->missing_operand) {
        message(args->command->options == 0 ? "%s: petri %s %s" : "%s; usage: petri %s [options] %s",
                args->command->missing_operand, args->command->name, args->command->operands);
        return STATUS_USAGE;
    }
    scripts_sort(&args->options->scripts);
    return OPTIONS_READ;
}

int options_parse(Options *options, const Command *command, int argc, char **argv) {
    Args args = {.command = command, .options = options, .argc = argc, .argv = argv};
    *options = (Options){
#define FIELD(type, name, at_first) .name = at_first,
#define OPTION(commands, name, letter, value, reader, field, help)
#include "cli/option_list.h"
#undef FIELD
#undef OPTION
        .argc = argc,
        .argv = argv,
    };
    options->realtime = command->live;
    int status = command->parses_arguments ? OPTIONS_READ : read_all(&args);
    if (status == OPTIONS_READ)
        status = replay_open(options, command);
    if (options->frames < 0)
        options->frames = isnan(options->run_time) && !command->live ? DEFAULT_FRAMES : INT64_MAX;
    return status;
}

void options_free(Options *options) {
    texts_free(&options->definitions);
    texts_free(&options->axes);
    texts_free(&options->metrics);
    texts_free(&options->read_folders);
    texts_free(&options->write_folders);
    texts_free(&options->unreadable);
    scripts_free(&options->scripts);
    petri_archive_close(&options->replayed);
}

const Command *command_part(const Command *command, const char *operand) {
    size_t length = strlen(command->name);
    for (const Command *const *part = command->parts; part && *part && operand[0] != '-'; part++)
        if (strncmp((*part)->name, command->name, length) == 0 && strcmp((*part)->name + length + 1, operand) == 0)
            return *part;
    return NULL;
}

int command_run(const Command *command, const CommandContext *host, int argc, char **argv) {
    const Command *part = argc > 0 ? command_part(command, argv[0]) : NULL;
    if (part)
        return command_run(part, host, argc - 1, argv + 1);
    Options options;
    int status = options_parse(&options, command, argc, argv);
    status = status == OPTIONS_READ ? command->run(host, &options) : status;
    options_free(&options);
    return status;
}

uint64_t options_work_limit(const Options *options) {
    return options->work > 0 ? options->work : petri_default_options().work_limit;
}

size_t options_memory_limit(const Options *options) {
    return options->memory > 0 ? options->memory : petri_default_options().memory_limit;
}

int options_open(const Options *options, const CommandContext *host,
                 void (*diagnostic)(void *context, const PetriDiagnostic *diagnostic), void *context,
                 PetriSession **session) {
    PetriOptions wanted = petri_default_options();
    wanted.fps = options->fps;
    wanted.realtime = options->realtime;
    wanted.run_time = options->run_time;
    wanted.colour = options->colour;
    wanted.stack_limit = host->stack_bytes;
    wanted.threads = (int)options->threads;
    wanted.neighbours = (PetriNeighbours)options->neighbours;
    wanted.simplify = !options->unsimplified;
    wanted.no_batches = options->no_batches;
    wanted.keep_modules = options->keep_modules;
    wanted.keep_forces = options->prompt || options->keep_forces;
    wanted.rollback_frames = options->prompt || options->state_file; // a partly computed frame must not be saved
    wanted.profile = options->profile;
    wanted.memory_limit = options_memory_limit(options);
    wanted.work_limit = options_work_limit(options);
    wanted.read_folders = (const char *const *)options->read_folders.items;
    wanted.write_folders = (const char *const *)options->write_folders.items;
    wanted.no_files = options->no_files;
    wanted.read_file = options->replayed ? petri_archive_read : options->read;
    wanted.read_unsaved = options->unsaved;
    wanted.on_file_read = options->on_file_read;
    wanted.read_user_data = options->replayed ? options->replayed : options->unsaved_host;
    wanted.on_diagnostic = diagnostic;
    wanted.user_data = context;
    wanted.should_interrupt = options->should_interrupt;
    wanted.cpu = host->cpu;
    wanted.ranks = host->ranks;
    *session = petri_open(&wanted);
    if (!*session) {
        message("out of memory");
        return STATUS_FAILED;
    }
    for (size_t i = 0; i < options->definitions.count; i++) {
        if (petri_define(*session, options->definitions.items[i]) != PETRI_OK) {
            message("option '--define' expects NAME=VALUE, not '%s'", options->definitions.items[i]);
            petri_close(session);
            return STATUS_USAGE;
        }
    }
    return OPTIONS_READ;
}

PetriStatus options_load(const Options *options, PetriSession *session) {
    return options->replayed ? replay_load(options, session) : script_load(session, options->script);
}

bool options_due(const Options *options, int64_t frames, double start, double fps) {
    double time = options->realtime ? clock_seconds() - start : (double)frames / fps;
    return frames < options->frames && (isnan(options->run_time) || time < options->run_time);
}
