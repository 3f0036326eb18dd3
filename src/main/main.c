// main.c: the main function, which prepares the process and runs a command on a thread with a large stack.
#include "base/os.h"
#include "cli/cli.h"
#include "cli/helper_exec.h"
#include "cli/memory.h"
#include "cli/shader_test.h"
#include "main/commands.h"

#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef PETRI_RANKS
#include "mpi/ranks.h"
#endif
#if defined(PETRI_PICTURES) || defined(PETRI_RANKS)
#include "check/meshes.h"
#include "sweep/plot_support.h"
#endif

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
    for (size_t i = 0; COMMANDS[i]; i++)
        nearest_offer(&nearest, COMMANDS[i]->name);
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

static int dispatch(const CommandContext *host, int argc, char **argv) {
    if (argc < 2) {
        message("no script given; try 'petri new NAME' or 'petri help'");
        return STATUS_USAGE;
    }
    const char *first = argv[1];
#ifndef PETRI_RANKS
    int verified = strcmp(first, "verify") == 0 ? helper_exec_ranks(argv, false) : -1;
    if (verified >= 0)
        return verified;
#endif
    if (helper_exec_is_pictures_command(first))
        return helper_exec_pictures(argv);
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return help_overview(COMMANDS);
    if (strcmp(first, "--version") == 0 || strcmp(first, "-V") == 0 || strcmp(first, "version") == 0)
        return help_version();
    const Command *command = command_find(first);
    bool is_script = !command && (first[0] == '-' || looks_like_file(first));
#ifndef PETRI_RANKS
    bool sweeps = command == &SWEEP_COMMAND;
    int status = command == &RUN_COMMAND || is_script || sweeps ? helper_exec_ranks(argv, !sweeps) : -1;
    if (status >= 0)
        return status;
#endif
    bool replays = is_script || command == &RUN_COMMAND || command == &DIFF_COMMAND || command == &CHECK_COMMAND ||
                   command == &SWEEP_COMMAND;
    if ((replays && helper_exec_needs_archives(argv)) || (command == &CHECK_COMMAND && helper_exec_needs_meshes(argv)))
        return helper_exec_pictures(argv);
    if (command)
        return command_run(command, host, argc - 2, argv + 2);
    if (is_script)
        return command_run(&RUN_COMMAND, host, argc - 1, argv + 1);
    return helper_exec_forwards_unknown() ? helper_exec_pictures(argv) : unknown_command(first);
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

typedef struct Job {
    CommandContext host;
    int argc;
    char **argv;
    int status;
} Job;

static void *run_job(void *context) {
    Job *job = context;
    job->status = dispatch(&job->host, job->argc, job->argv);
    return NULL;
}

#ifdef __EMSCRIPTEN__
// In WebAssembly, the stack has a fixed size (src/web/meson.build), and there are no threads.
static bool run_on_large_stack(Job *job) {
    job->host.stack_bytes = (size_t)PETRI_STACK_BYTES - ((size_t)1 << 20);
    run_job(job);
    return true;
}
#else
// Scripts can nest thousands of calls, so evaluation gets a much larger stack than the main thread has. Unused pages
// take no memory. If the address space is limited, tries smaller stacks.
static bool run_on_large_stack(Job *job) {
    const size_t mebibyte = (size_t)1 << 20;
    for (size_t size = 512 * mebibyte; size >= 8 * mebibyte; size /= 2) {
        pthread_attr_t attributes;
        pthread_t thread;
        if (pthread_attr_init(&attributes) != 0)
            return false;
        job->host.stack_bytes = size - mebibyte;
        bool started = pthread_attr_setstacksize(&attributes, size) == 0 &&
                       pthread_create(&thread, &attributes, run_job, job) == 0;
        pthread_attr_destroy(&attributes);
        if (started) {
            sigset_t all; // all signals, blocked in this thread so that the new thread receives them
            sigfillset(&all);
            pthread_sigmask(SIG_BLOCK, &all, NULL);
            return pthread_join(thread, NULL) == 0;
        }
    }
    return false;
}
#endif

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
#ifdef PETRI_PICTURES
    if (shader_test_is_wanted(argc, argv))
        return shader_test_run();
#endif
    char resolved[PATH_MAX];
    Job job = {.host.program = program_path(argc > 0 ? argv[0] : NULL, resolved),
               .host.invoked_as = argc > 0 ? argv[0] : "petri",
               .argc = argc,
               .argv = argv,
               .status = STATUS_FAILED};
#ifdef PETRI_RANKS
    ranks_begin(&job.host);
#endif
#if defined(PETRI_PICTURES) || defined(PETRI_RANKS)
    job.host.plot_support = &PLOT_SUPPORT;
    job.host.print_meshes = check_print_meshes;
#endif
    if (!run_on_large_stack(&job)) {
        message("cannot start a thread");
        return STATUS_FAILED;
    }
#ifdef PETRI_RANKS
    ranks_end(job.status);
#endif
    return job.status;
}
