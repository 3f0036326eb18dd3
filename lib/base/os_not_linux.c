// os_not_linux.c: see os.h. Functions that are the same in os_macos.c and os_posix.c, with which it is compiled.
#include "base/os.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

int os_open_below(int folder, const char *path, int flags) {
    (void)folder;
    (void)path;
    (void)flags;
    errno = ENOSYS;
    return -1;
}

int os_open_unnamed(int folder) {
    (void)folder;
    errno = ENOTSUP;
    return -1;
}

bool os_link_unnamed(int file, int folder, const char *name) {
    (void)file;
    (void)folder;
    (void)name;
    errno = ENOTSUP;
    return false;
}

void os_signal_after_parent(int signal) {
    (void)signal;
}

static bool close_on_exec(const int ends[2]) {
    return fcntl(ends[0], F_SETFD, FD_CLOEXEC) == 0 && fcntl(ends[1], F_SETFD, FD_CLOEXEC) == 0;
}

bool os_pipe(int ends[2]) {
    return pipe(ends) == 0 && close_on_exec(ends);
}

bool os_socket_pair(int ends[2]) {
    return socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0 && close_on_exec(ends);
}
