// os_posix.c: see os.h.
//
// For systems of which only POSIX.1-2008 is known. What POSIX lacks fails with ENOTSUP, and petri then does without it.
#include "base/os.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

int os_processor_count(void) {
#ifdef _SC_NPROCESSORS_ONLN // not in POSIX, but common
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 && count < INT_MAX ? (int)count : 1;
#else
    return 1;
#endif
}

struct timespec os_time_modified(const struct stat *info) {
    return info->st_mtim;
}

struct timespec os_time_changed(const struct stat *info) {
    return info->st_ctim;
}

#ifdef O_SEARCH
const int OS_SEARCH = O_SEARCH;
#else
const int OS_SEARCH = O_RDONLY;
#endif

// POSIX locks belong to the process, and closing any descriptor of the file releases them.
bool os_lock(int file) {
    (void)file;
    errno = ENOTSUP;
    return false;
}

bool os_sync(int file) {
    return fsync(file) == 0;
}

bool os_folder_path(int folder, char path[PATH_MAX]) {
    (void)folder;
    (void)path;
    errno = ENOTSUP;
    return false;
}

// The device is not in POSIX, but all systems have it.
bool os_random(void *bytes, size_t count) {
    int device = open("/dev/urandom", O_RDONLY | O_CLOEXEC);
    bool good = device >= 0;
    for (char *at = bytes; good && count > 0;) {
        ssize_t got = read(device, at, count);
        good = got > 0 || (got < 0 && errno == EINTR);
        at += got > 0 ? got : 0;
        count -= got > 0 ? (size_t)got : 0;
    }
    if (device >= 0)
        close(device);
    return good;
}

bool os_program_path(char path[PATH_MAX]) {
    (void)path;
    errno = ENOTSUP;
    return false;
}

const char *os_program(char path[PATH_MAX]) {
    (void)path;
    return NULL;
}

#ifdef __EMSCRIPTEN__
// Sets columns and rows, and returns 0 on success. JavaScript provides it (src/web/engine/system.mjs).
__attribute__((import_module("petri"), import_name("terminal_size"))) int host_terminal_size(int terminal,
                                                                                             int extent[2]);

bool os_terminal_size(int terminal, OsTerminalSize *size) {
    int extent[2] = {0};
    bool good = host_terminal_size(terminal, extent) == 0;
    *size = (OsTerminalSize){.columns = extent[0], .rows = extent[1]};
    return good;
}
#else
bool os_terminal_size(int terminal, OsTerminalSize *size) {
    (void)terminal;
    (void)size;
    errno = ENOTSUP;
    return false;
}
#endif
