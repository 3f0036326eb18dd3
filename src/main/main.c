// main.c: the main function, which prepares the process and runs a command on a thread with a large stack.
#include "base/os.h"
#include "cli/cli.h"
#include "cli/helper_exec.h"
#include "cli/memory.h"
#include "cli/words.h"
#include "main/commands.h"
#include "main/large_stack.h"
#include "mpi/ranks.h"
#include "render/options.h"
#include "run/options.h"
#include "view/options.h"

#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Returns true if the word contains a dot or a slash, or is the name of an existing file.
static bool looks_like_file(const char *word) {
    return strpbrk(word, "./") || access(word, F_OK) == 0;
}

static bool is_script_without_suffix(const char *word) {
    SCOPED_TEXT path = {0};
    text_add_format(&path, "%s.fl", word);
    bool found = access(path.bytes, F_OK) == 0;
    return found;
}

static int unknown_command(const char *word) {
    StrNearest nearest = str_nearest(str_from(word));
    for (const CommandRow *row = COMMANDS; row->listed; row++)
        nearest_offer(&nearest, row->name);
    if (nearest_offer(&nearest, "builtins") || nearest_offer(&nearest, "nodes")) {
        message("no such command or file: '%s'; did you mean 'petri help %s'?", word, nearest.found.bytes);
        return STATUS_USAGE;
    }
    if (word[0] == '\0')
        message("the script name is empty");
    else if (is_script_without_suffix(word))
        message("no such command or file: '%s'; did you mean 'petri %s.fl'?", word, word);
    else if (nearest.found.bytes)
        message("no such command or file: '%s'; did you mean 'petri %s'?", word, nearest.found.bytes);
    else
        message("no such command or file: '%s'; see 'petri help'", word);
    return STATUS_USAGE;
}

static bool is_version(const char *word) {
    return strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0 || strcmp(word, "version") == 0;
}

// Returns the row for a form of the command that the words request, such as `run LINK`, or the command's own row.
static const CommandRow *find_form(const CommandRow *row, char *const *words) {
    const char *const forms[] = {words_have_option(words, "send") ? "--send" : NULL,
                                 words_have_option(words, "new") ? "--new" : NULL,
                                 words_name_link(words) ? "LINK" : NULL};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        SCOPED_TEXT name = {0};
        text_add_format(&name, "%s %s", row->name, forms[i] ? forms[i] : "");
        const CommandRow *form = forms[i] ? command_find(name.bytes) : NULL;
        if (form)
            return form;
    }
    return row;
}

// Runs the command if this program can. Otherwise executes the program that can.
static int dispatch(const CommandContext *host, int argc, char **argv) {
    if (argc < 2) {
        message("no script given; try 'petri new NAME' or 'petri help'");
        return STATUS_USAGE;
    }
    if (is_version(argv[1]))
        return help_version();
    const CommandRow *row = command_find(argv[1]);
    bool is_script = !row && (strchr("-#", argv[1][0]) || looks_like_file(argv[1]));
    if (is_script)
        row = command_find(RUN_COMMAND.name);
    if (!row)
        return unknown_command(argv[1]);
    int first = is_script ? 1 : 2;
    row = find_form(row, argv + first);
    bool divides = PROGRAM != RANKS && row->programs & RANKS;
    int status = divides ? helper_exec_ranks(argv, row->programs & NEEDS_RANKS) : -1;
    if (status >= 0)
        return status;
    const Command *command = row->command;
    if (!command || (PROGRAM == PETRI && command->needs_pictures && command->needs_pictures(argv + 1)))
        return helper_exec_pictures(argv);
    return command_run(command, host, argc - first, argv + first);
}

// Opens standard descriptors that are closed. Otherwise the next file to be opened would get such a descriptor and
// receive output.
static void open_standard_descriptors(void) {
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++) {
        if (fcntl(fd, F_GETFD) == -1) {
            // Opened in the wrong direction, so that reading or writing fails, as with a closed descriptor.
            (void)open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

// Users often confuse these commands.
static const SimilarCommand SIMILAR[] = {
    {"run", &RUN_OPTIONS}, {"render", &RENDER_OPTIONS}, {"view", &VIEW_OPTIONS}, {.name = NULL}};

typedef struct Job {
    CommandContext host;
    int argc;
    char **argv;
    int status;
} Job;

static void run_job(void *context, size_t stack_bytes) {
    Job *job = context;
    job->host.stack_bytes = stack_bytes;
    job->status = dispatch(&job->host, job->argc, job->argv);
}

// Returns the path of this program. argv[0] is only a fallback, because it may be a name that the shell found in PATH.
static const char *program_path(const char *name, char *resolved) {
    const char *path = os_program(resolved);
    return path ? path : name && realpath(name, resolved) ? resolved : "petri";
}

int main(int argc, char **argv) {
    open_standard_descriptors();
    // With these signals ignored, write fails at a closed pipe or an exceeded file size limit, and the process
    // continues.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    char resolved[PATH_MAX];
    Job job = {.host.program = program_path(argc > 0 ? argv[0] : NULL, resolved),
               .host.similar = SIMILAR,
               .host.invoked_as = argc > 0 ? argv[0] : "petri",
               .argc = argc,
               .argv = argv,
               .status = STATUS_FAILED};
    ranks_begin(&job.host);
    if (!large_stack_run(run_job, &job)) {
        message("cannot start a thread");
        return STATUS_FAILED;
    }
    ranks_end(job.status);
    return job.status;
}
