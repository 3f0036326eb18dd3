// os_linux.c: see os.h.
//
// For Linux, with glibc or musl. A call that an older kernel, a file system or a sandbox lacks fails, and the caller
// then uses a portable way.
#define _GNU_SOURCE // openat2, O_PATH, O_TMPFILE, pipe2, sched_getaffinity
#include "base/os.h"

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>
#ifdef __has_include
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#include <sys/syscall.h>
#endif
#endif

static const char PROGRAM[] = "/proc/self/exe";

int os_processor_count(void) {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set))
        return 1;
    int count = CPU_COUNT(&set);
    return count > 0 ? count : 1;
}

struct timespec os_time_modified(const struct stat *info) {
    return info->st_mtim;
}

struct timespec os_time_changed(const struct stat *info) {
    return info->st_ctim;
}

const int OS_SEARCH = O_PATH;

int os_open_below(int folder, const char *path, int flags) {
#ifdef RESOLVE_BENEATH
    struct open_how how = {.flags = (unsigned)(flags | O_CLOEXEC | O_NOCTTY),
                           .resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS};
    long file;
    do
        file = syscall(SYS_openat2, folder, path, &how, sizeof how);
    while (file < 0 && (errno == EINTR || errno == EAGAIN));
    if (file < 0 && errno == EPERM) // blocked by a sandbox
        errno = ENOSYS;
    return (int)file;
#else
    (void)folder, (void)path, (void)flags;
    errno = ENOSYS;
    return -1;
#endif
}

bool os_lock(int file) {
    return flock(file, LOCK_EX | LOCK_NB) == 0;
}

bool os_sync(int file) {
    return fsync(file) == 0;
}

// Sets `path` to the path of a descriptor below /proc. Avoids snprintf, because this function may be called from a
// signal handler.
static void descriptor_path(int file, char path[64]) {
    char digits[16];
    int count = 0;
    strcpy(path, "/proc/self/fd/");
    char *end = path + strlen(path);
    for (; count == 0 || file > 0; file /= 10)
        digits[count++] = (char)('0' + file % 10);
    while (count > 0)
        *end++ = digits[--count];
    *end = '\0';
}

int os_open_unnamed(int folder) {
    int file;
    char path[64];
    do
        file = openat(folder, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC | O_NOCTTY, 0666);
    while (file < 0 && errno == EINTR);
    if (file < 0)
        return -1;
    descriptor_path(file, path);
    if (access(path, F_OK) == 0)
        return file;
    close(file); // without /proc, it could not be named later
    errno = ENOTSUP;
    return -1;
}

bool os_link_unnamed(int file, int folder, const char *name) {
    char path[64];
    int result;
    descriptor_path(file, path);
    do
        result = linkat(AT_FDCWD, path, folder, name, AT_SYMLINK_FOLLOW);
    while (result != 0 && errno == EINTR);
    return result == 0;
}

bool os_folder_path(int folder, char path[PATH_MAX]) {
    descriptor_path(folder, path);
    return true;
}

bool os_random(void *bytes, size_t count) {
    return getentropy(bytes, count) == 0;
}

bool os_program_path(char path[PATH_MAX]) {
    ssize_t length = readlink(PROGRAM, path, PATH_MAX - 1);
    if (length <= 0)
        return false;
    path[length] = '\0';
    return true;
}

const char *os_program(char path[PATH_MAX]) {
    (void)path;
    return access(PROGRAM, X_OK) == 0 ? PROGRAM : NULL;
}

void os_signal_after_parent(int signal) {
    prctl(PR_SET_PDEATHSIG, signal);
}

bool os_pipe(int ends[2]) {
    return pipe2(ends, O_CLOEXEC) == 0;
}

bool os_socket_pair(int ends[2]) {
    return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
}

bool os_terminal_size(int terminal, OsTerminalSize *size) {
    struct winsize found;
    if (ioctl(terminal, TIOCGWINSZ, &found) != 0)
        return false;
    *size = (OsTerminalSize){found.ws_col, found.ws_row, found.ws_xpixel, found.ws_ypixel};
    return true;
}
