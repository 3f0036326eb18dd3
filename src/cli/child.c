// child.c: `petri run` in a process of its own.
#include "cli/child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

int child_unnamed_file(void) {
    const char *folder = getenv("TMPDIR");
    SCOPED_BYTES path = {0};
    bytes_format(&path, "%s/petri-XXXXXX", folder == NULL || folder[0] == '\0' ? "/tmp" : folder);
    int fd = mkstemp(path.data);
    if (fd >= 0) {
        unlink(path.data);
        fcntl(fd, F_SETFD, FD_CLOEXEC);
    }
    return fd;
}

// In the child: nothing here may depend on what other threads held when it was forked.
static void become_run(const Child *child, const char *program, const char *folder, char **argv) {
    int nothing = open("/dev/null", O_RDONLY);
    if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(child->output, STDOUT_FILENO) < 0 ||
        dup2(child->errors, STDERR_FILENO) < 0 || chdir(folder) != 0) {
        _exit(STATUS_FAILED);
    }
    // Ends a script that hangs, whatever it does; an alarm outlives exec.
    alarm(CHILD_SECONDS);
    execvp(program, argv);
    _exit(STATUS_FAILED);
}

bool child_start(Child *child, const char *program, const char *folder, char **argv) {
    *child = (Child){.output = child_unnamed_file(), .errors = child_unnamed_file()};
    child->pid = child->output < 0 || child->errors < 0 ? -1 : fork();
    if (child->pid == 0) {
        become_run(child, program, folder, argv);
    }
    if (child->pid < 0) {
        int error = errno;
        close(child->output);
        close(child->errors);
        errno = error;
    }
    return child->pid > 0;
}

pid_t child_wait(int *status) {
    for (;;) {
        pid_t pid = waitpid(-1, status, 0);
        if (pid >= 0 || errno != EINTR) {
            return pid;
        }
    }
}

static void collect(int fd, Bytes *text) {
    bytes_add(text, "", 0);
    if (lseek(fd, 0, SEEK_SET) == 0 && !bytes_read(text, fd, SIZE_MAX)) {
        message("cannot read the output of a script: %s", strerror(errno));
    }
    close(fd);
}

void child_collect(Child *child, Bytes *output, Bytes *errors) {
    collect(child->output, output);
    collect(child->errors, errors);
}

void child_describe(int status, const Bytes *errors, Bytes *trouble) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
        bytes_format(trouble, "did not end within %d s", CHILD_SECONDS);
    } else if (WIFSIGNALED(status)) {
        bytes_format(trouble, "was killed by signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    } else {
        bytes_format(trouble, "ended with status %d", WEXITSTATUS(status));
    }
    size_t length = strcspn(errors->data, "\n");
    if (length > 0) {
        bytes_format(trouble, ": %.*s", length > 200 ? 200 : (int)length, errors->data);
    }
}
