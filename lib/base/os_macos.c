// os_macos.c: see os.h. For macOS.
#include "base/os.h"

#include <fcntl.h>
#include <mach-o/dyld.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/random.h>
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

bool os_lock(int file) {
    return flock(file, LOCK_EX | LOCK_NB) == 0;
}

// fsync does not flush the cache of the disk. F_FULLFSYNC does, but not all file systems have it.
bool os_sync(int file) {
    return fcntl(file, F_FULLFSYNC) == 0 || fsync(file) == 0;
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

bool os_terminal_size(int terminal, OsTerminalSize *size) {
    struct winsize found;
    if (ioctl(terminal, TIOCGWINSZ, &found) != 0)
        return false;
    *size = (OsTerminalSize){found.ws_col, found.ws_row, found.ws_xpixel, found.ws_ypixel};
    return true;
}
