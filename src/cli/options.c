// options.c: see options.h.
#include "cli/options.h"

#include "base/clock.h"
#include "cli/archive.h"
#include "cli/args.h"
#include "cli/memory.h"
#include "cli/option_groups.h"
#include "cli/script.h"
#include "petri-edit.h"
#include "petri-inspect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_FRAMES = 600 };

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
        options->scripts.suffixes = command->suffixes;
        if (!scripts_find(&options->scripts, args->value))
            texts_add(&options->unreadable, args->value);
    } else if (options->script && command->accepts_expressions) {
        texts_add(&options->expressions, args->value);
        return true;
    } else if (options->script && command->accepts_two && !options->second) {
        options->second = args->value;
        return true;
    } else if (options->script && command->second_operand_error) {
        message(command->second_operand_error, args->value);
        return false;
    } else if (options->script) {
        script_report_second(options->script, args->value);
        return false;
    } else if (args->value[0] == '\0' && command->options && !command->second_operand_error) {
        message("the script name is empty");
        return false;
    }
    options->script = args->value;
    return true;
}

static void *find_field(const Options *options, const OptionSpec *spec) {
    return (spec->own ? (char *)options->own : (char *)options) + spec->field;
}

static int read_all(Args *args) {
    for (int id = args_next(args); id != ARG_END; id = args_next(args)) {
        if (id == ARG_HELP)
            return args->version ? help_version() : help_for(args->command);
        bool good = id == ARG_OPERAND  ? read_operand(args)
                    : id == ARG_OPTION ? args->option->read(args, find_field(args->options, args->option))
                                       : false;
        if (!good)
            return STATUS_USAGE;
    }
    if (!args->options->script && args->command->missing_operand) {
        message(!args->command->options ? "%s: petri %s%s%s" : "%s; usage: petri %s [options]%s%s",
                args->command->missing_operand, args->command->name, args->command->operands[0] == '\0' ? "" : " ",
                args->command->operands);
        return STATUS_USAGE;
    }
    scripts_sort(&args->options->scripts);
    return OPTIONS_READ;
}

// Returns the initial values of the options that only this command has. The caller frees them.
static void *default_own(const OptionTable *table) {
    void *own = table && table->own_size > 0 ? memory_calloc(table->own_size) : NULL;
    if (own && table->own_defaults)
        memcpy(own, table->own_defaults, table->own_size);
    return own;
}

int options_parse(Options *options, const Command *command, const CommandContext *context, int argc, char **argv) {
    Args args = {.command = command, .similar = context->similar, .options = options, .argc = argc, .argv = argv};
    *options = (Options){
        .frame = -1,
        .from = -1,
        .keyframe_every = 1000,
        .digest_every = 1,
        .frames = -1,
        .run_time = NAN,
        .fps = 60,
        .realtime = command->live,
        .verbosity = LOG_NORMAL,
        .colour = option_default_colour(),
        .monochrome = option_no_colour(),
        .table = command->options,
        .own = default_own(command->options),
        .argc = argc,
        .argv = argv,
    };
    int status = command->parses_arguments ? OPTIONS_READ : read_all(&args);
    if (status == OPTIONS_READ)
        status = replay_open(options, command);
    if (options->frames < 0)
        options->frames = isnan(options->run_time) && !command->live ? DEFAULT_FRAMES : INT64_MAX;
    return status;
}

void options_free(Options *options) {
    for (const OptionSpec *spec = options->table ? options->table->rows : NULL; spec && spec->name; spec++)
        if (spec->is_list)
            texts_free(find_field(options, spec));
    free(options->own);
    texts_free(&options->definitions);
    texts_free(&options->expressions);
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
    int status = options_parse(&options, command, host, argc, argv);
    status = status == OPTIONS_READ ? command->run(host, &options) : status;
    options_free(&options);
    return status;
}

uint64_t options_work_limit(const Options *options) {
    return options->work > 0 ? options->work : petri_default_options().work_limit;
}

size_t options_memory_limit(const Options *options) {
    uint64_t bytes = options->memory > 0 ? options->memory : petri_default_options().memory_limit;
    return bytes < SIZE_MAX ? (size_t)bytes : SIZE_MAX;
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
    wanted.spec = options->spec;
    PetriTuning tuning = {.size = sizeof tuning,
                          .neighbours = (PetriNeighbours)options->neighbours,
                          .no_simplify = options->unsimplified,
                          .no_batches = options->no_batches,
                          .cpu = host->cpu};
    wanted.tuning = &tuning;
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
    wanted.ranks = host->ranks;
    *session = petri_open(&wanted);
    if (!*session) {
        const char *problem = petri_options_problem(&wanted);
        message("%s", problem ? problem : "out of memory");
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
