// check.c: `petri check`: what is wrong with scripts, without running them.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/args.h"
#include "cli/script.h"
#include "cli/scripts.h"
#include "petri.h"

enum { OPT_DEFINE = 1, OPT_COLOR, OPT_QUIET, OPT_WERROR };

static const OptionSpec OPTIONS[] = {
    {"define", 'D', OPT_DEFINE, "NAME=VALUE", "define a name for the scripts; may be repeated"},
    {"color", 0, OPT_COLOR, "WHEN", "colour messages: auto, always or never"},
    {"quiet", 0, OPT_QUIET, NULL, "report errors only"},
    {"werror", 0, OPT_WERROR, NULL, "exit with 1 if there was a warning, too"},
    {0},
};

typedef struct Check {
    ScriptList scripts;
    const char **definitions; // as many as definition_count; each "name=value"
    size_t definition_count;
    bool colour;
    bool quiet;
    bool warnings_count; // as errors, for the exit status
    bool shown_last;
    bool unreadable; // some path could not be read
} Check;

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Check *check = host;
    // Notes belong to the diagnostic before them.
    if (diagnostic->level != PETRI_NOTE) {
        check->shown_last = diagnostic->level == PETRI_ERROR || !check->quiet;
    }
    if (check->shown_last) {
        fputs(diagnostic->rendered, stderr);
    }
}

static bool apply(Check *check, const Args *args, int id) {
    switch (id) {
    case ARG_OPERAND:
        if (script_is_stdin(args->value)) {
            scripts_add(&check->scripts, args->value);
            return true;
        }
        check->unreadable = !scripts_find(&check->scripts, args->value) || check->unreadable;
        return true;
    case OPT_DEFINE:
        check->definitions[check->definition_count++] = args->value;
        return true;
    case OPT_COLOR:
        return args_colour(args, &check->colour);
    case OPT_QUIET:
        check->quiet = true;
        return true;
    case OPT_WERROR:
        check->warnings_count = true;
        return true;
    default:
        return false;
    }
}

static int check_all(Check *check, const Host *host) {
    PetriOptions options = petri_default_options();
    options.colour = check->colour;
    options.stack_bytes = host->stack_bytes;
    options.diagnostic = on_diagnostic;
    options.host = check;
    PetriSession *session = petri_open(&options);
    if (session == NULL) {
        message("out of memory");
        return STATUS_FAILED;
    }
    for (size_t i = 0; i < check->definition_count; i++) {
        if (petri_define(session, check->definitions[i]) != PETRI_OK) {
            message("--define: expected NAME=VALUE, not '%s'", check->definitions[i]);
            petri_close(&session);
            return STATUS_USAGE;
        }
    }
    size_t rejected = 0;
    for (size_t i = 0; i < check->scripts.count; i++) {
        rejected += script_check(session, check->scripts.items[i].path) == PETRI_OK ? 0 : 1;
    }
    uint64_t errors = petri_diagnostic_count(session, PETRI_ERROR);
    uint64_t warnings = petri_diagnostic_count(session, PETRI_WARNING);
    petri_close(&session);
    message("%zu file%s checked: %" PRIu64 " error%s, %" PRIu64 " warning%s", check->scripts.count,
            check->scripts.count == 1 ? "" : "s", errors, errors == 1 ? "" : "s", warnings, warnings == 1 ? "" : "s");
    bool clean = rejected == 0 && errors == 0 && !check->unreadable && !(check->warnings_count && warnings > 0);
    return clean ? STATUS_DONE : STATUS_FAILED;
}

static int read_and_check(Check *check, const Host *host, Args *args) {
    bool has_path = false;
    for (int id = args_next(args); id != ARG_END; id = args_next(args)) {
        if (id == ARG_HELP) {
            return args_help(args);
        }
        if (id == ARG_WRONG || !apply(check, args, id)) {
            return STATUS_USAGE;
        }
        has_path = has_path || id == ARG_OPERAND;
    }
    if (!has_path) {
        message("nothing to check; usage: petri check PATH...");
        return STATUS_USAGE;
    }
    if (check->scripts.count == 0) {
        if (!check->unreadable) {
            message("no script found: there is no file named *.fl");
        }
        return STATUS_FAILED;
    }
    scripts_sort(&check->scripts);
    return check_all(check, host);
}

static int check_run(const Host *host, int argc, char **argv) {
    Check check = {.colour = colour_by_default(), .definitions = calloc((size_t)argc + 1, sizeof(char *))};
    if (check.definitions == NULL) {
        message("out of memory");
        return STATUS_FAILED;
    }
    Args args = args_start(&CHECK_COMMAND, argc, argv);
    int status = read_and_check(&check, host, &args);
    free(check.definitions);
    scripts_free(&check.scripts);
    return status;
}

const Command CHECK_COMMAND = {
    .name = "check",
    .operands = "PATH...",
    .summary = "tell what is wrong with scripts without running them",
    .details =
        "Reads scripts, or each file named *.fl in a folder and the folders in it, and reports what is wrong with\n"
        "them, and what is hardly meant: names that are unbound or unused, wrong numbers of arguments, unknown "
        "pragmas,\n"
        "branches that are never reached, misspelled nodes and attributes. To see the latter it makes the first\n"
        "frame, of which nothing is printed, drawn or stored. The exit status is 1 if there was an error.",
    .examples = "  petri check dish.fl\n"
                "  petri check --werror .                          all scripts here, for CI\n",
    .options = OPTIONS,
    .run = check_run,
};
