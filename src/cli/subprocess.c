// subprocess.c: see subprocess.h.
#include "cli/subprocess.h"

#include "base/file.h"
#include "base/os.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __EMSCRIPTEN__
#include "cli/wasm_host.h"
#endif

int subprocess_temporary_file(void) {
    const char *folder = getenv("TMPDIR");
    SCOPED_TEXT path = {0};
    text_add_format(&path, "%s/petri-XXXXXX", !folder || folder[0] == '\0' ? "/tmp" : folder);
    int fd = mkstemp(path.bytes);
    if (fd >= 0) {
        unlink(path.bytes);
        fcntl(fd, F_SETFD, FD_CLOEXEC);
    }
    return fd;
}

#ifdef __EMSCRIPTEN__ // there are no processes, so that JavaScript runs each command in a thread
int subprocess_default_jobs(void) {
    return host_processors();
}

bool subprocess_start(Subprocess *child, const char *program, const char *folder, char **argv, unsigned seconds) {
    (void)program;
    (void)seconds;
    if (strcmp(argv[0], "petri") != 0) {
        errno = ENOSYS;
        return false;
    }
    *child = (Subprocess){.output = subprocess_temporary_file(), .errors = subprocess_temporary_file()};
    child->pid = child->output < 0 || child->errors < 0 ? -1 : host_start(folder, argv, child->output, child->errors);
    return child->pid > 0;
}

pid_t subprocess_spawn(const char *program, const char *const *words, const int *files, int count, bool own_group) {
    (void)program;
    (void)words;
    (void)files;
    (void)count;
    (void)own_group;
    errno = ENOSYS;
    return -1;
}

pid_t subprocess_wait(int *status) {
    return host_wait(-1, status);
}

int subprocess_wait_for(pid_t pid) {
    int status = -1;
    host_wait(pid, &status);
    return status;
}
#else
int subprocess_default_jobs(void) {
    int processors = os_processor_count();
    return processors < 1 ? 1 : processors;
}

// Runs in the child after fork. Must not take locks or allocate memory, because another thread may have
// held a lock during fork.
static void exec_program(const Subprocess *child, const char *program, const char *folder, char **argv,
                         unsigned seconds) {
    int nothing = open("/dev/null", O_RDONLY);
    if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(child->output, STDOUT_FILENO) < 0 ||
        dup2(child->errors, STDERR_FILENO) < 0 || chdir(folder) != 0)
        _exit(STATUS_FAILED);
    // Ends a script that hangs. The alarm remains set after exec.
    alarm(seconds);
    execvp(program, argv);
    _exit(STATUS_FAILED);
}

bool subprocess_start(Subprocess *child, const char *program, const char *folder, char **argv, unsigned seconds) {
    *child = (Subprocess){.output = subprocess_temporary_file(), .errors = subprocess_temporary_file()};
    child->pid = child->output < 0 || child->errors < 0 ? -1 : fork();
    if (child->pid == 0)
        exec_program(child, program, folder, argv, seconds);
    if (child->pid < 0) {
        int error = errno;
        close(child->output);
        close(child->errors);
        errno = error;
    }
    return child->pid > 0;
}

pid_t subprocess_spawn(const char *program, const char *const *words, const int *files, int count, bool own_group) {
    extern char **environ;
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, usual;
    pid_t pid = -1;
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | (own_group ? POSIX_SPAWN_SETPGROUP : 0));
    int error = 0;
    for (int i = 0; i < count && error == 0; i++)
        error = files[i] >= 0 ? posix_spawn_file_actions_adddup2(&actions, files[i], i)
                              : posix_spawn_file_actions_addopen(&actions, i, "/dev/null", O_RDWR, 0);
    if (error == 0)
        error = posix_spawnp(&pid, program, &actions, &attributes, (char **)(void *)words, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    errno = error;
    return error == 0 ? pid : -1;
}

pid_t subprocess_wait(int *status) {
    for (;;) {
        pid_t pid = waitpid(-1, status, 0);
        if (pid >= 0 || errno != EINTR)
            return pid;
    }
}

int subprocess_wait_for(pid_t pid) {
    int status = -1;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}
#endif

static const char *read_output(int fd, Text *text) {
    text_add_c(text, "");
    const char *problem = lseek(fd, 0, SEEK_SET) == 0 && text_read(text, fd, SIZE_MAX) ? NULL : strerror(errno);
    close(fd);
    return problem;
}

const char *subprocess_collect(Subprocess *child, Text *output, Text *errors) {
    const char *problem = read_output(child->output, output), *second = read_output(child->errors, errors);
    return problem ? problem : second;
}

int subprocess_run(const char *program, const char *folder, char **argv, unsigned seconds, Text *output, Text *errors) {
    Subprocess child;
    if (!subprocess_start(&child, program, folder, argv, seconds))
        return -1;
    int status = subprocess_wait_for(child.pid);
    return subprocess_collect(&child, output, errors) ? -1 : status;
}

int subprocess_git(const char *folder, const TextList *words, unsigned seconds, Text *output, Text *errors) {
    TextList all = {0};
    texts_add(&all, "git");
    for (size_t i = 0; i < words->count; i++)
        texts_add(&all, words->items[i]);
    // git would fetch an object that a partial clone lacks, by a program that the configuration names.
    setenv("GIT_NO_LAZY_FETCH", "1", true);
    setenv("GIT_ALLOW_PROTOCOL", "none", true);
    int status = subprocess_run("git", folder, all.items, seconds, output, errors);
    texts_free(&all);
    return status;
}

void subprocess_describe(int status, const Text *errors, Text *error_text) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        text_add_format(error_text, "did not end within %d s", SUBPROCESS_MAX_SECONDS);
    else if (WIFSIGNALED(status))
        text_add_format(error_text, "was killed by signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else
        text_add_format(error_text, "ended with status %d", WEXITSTATUS(status));
    size_t length = strcspn(errors->bytes, "\n");
    if (length > 0)
        text_add_format(error_text, ": %.*s", length > 200 ? 200 : (int)length, errors->bytes);
}
