// os_macos.c: see os.h. For macOS.
#include "base/os.h"

#include <errno.h>
#include <fcntl.h>
#include <mach-o/dyld.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/sysctl.h>
#include <unistd.h>

int os_processor_count(void) {
    int count = 0;
    size_t size = sizeof count;
    return sysctlbyname("hw.logicalcpu", &count, &size, NULL, 0) == 0 && count > 0 ? count : 1;
}

struct timespec os_time_modified(const struct stat *info) {
    return info->st_mtimespec;
}

struct timespec os_time_changed(const struct stat *info) {
    return info->st_ctimespec;
}

const int OS_SEARCH = O_RDONLY;

int os_open_below(int folder, const char *path, int flags) {
    (void)folder;
    (void)path;
    (void)flags;
    errno = ENOSYS;
    return -1;
}

bool os_lock(int file) {
    return flock(file, LOCK_EX | LOCK_NB) == 0;
}

// fsync does not flush the cache of the disk. F_FULLFSYNC does, but not all file systems have it.
bool os_sync(int file) {
    return fcntl(file, F_FULLFSYNC) == 0 || fsync(file) == 0;
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

bool os_folder_path(int folder, char path[PATH_MAX]) {
    return fcntl(folder, F_GETPATH, path) == 0;
}

bool os_random(void *bytes, size_t count) {
    return getentropy(bytes, count) == 0;
}

bool os_program_path(char path[PATH_MAX]) {
    char found[PATH_MAX];
    uint32_t size = sizeof found;
    return _NSGetExecutablePath(found, &size) == 0 && realpath(found, path);
}

const char *os_program(char path[PATH_MAX]) {
    return os_program_path(path) ? path : NULL;
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

bool os_terminal_size(int terminal, OsTerminalSize *size) {
    struct winsize found;
    if (ioctl(terminal, TIOCGWINSZ, &found) != 0)
        return false;
    *size = (OsTerminalSize){found.ws_col, found.ws_row, found.ws_xpixel, found.ws_ypixel};
    return true;
}
