// os.h: the differences between operating systems.
//
// One of os_linux.c, os_macos.c and os_posix.c is compiled, the last two with os_not_linux.c. os_posix.c uses
// POSIX.1-2008 alone. It has a substitute for each function, or fails with the error ENOTSUP.
#pragma once

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

#ifdef PETRI_PLAIN_POSIX
// In POSIX.1-2008, but glibc declares it for its XSI option only.
char *realpath(const char *restrict path, char *restrict resolved);
#endif

// Unless stated otherwise, the functions return false with errno set on failure, and are safe in a signal handler.

// Returns the number of processors that this process may run on, at least 1.
int os_processor_count(void);
// Return the times of the last change of a file's contents, and of contents or permissions.
struct timespec os_time_modified(const struct stat *info);
struct timespec os_time_changed(const struct stat *info);

// A flag of open for folders of which only files are opened, so that permission to list them is not needed. O_RDONLY
// where there is no such flag.
extern const int OS_SEARCH;
// Opens a relative path below an open folder; fails if any component is a symbolic link or leads out of the folder.
// Returns -1 with errno set on failure; ENOSYS: the system cannot do this in one step.
int os_open_below(int folder, const char *path, int flags);
// Takes an exclusive lock on an open file, which lasts until the file is closed. Fails with EWOULDBLOCK if another open
// file holds the lock, with other errors if there are no such locks.
bool os_lock(int file);
// Writes a file or folder to disk.
bool os_sync(int file);
// Opens a new file without a name in a folder. On failure returns -1.
int os_open_unnamed(int folder);
// Gives the file of os_open_unnamed a name in a folder. Fails if the name exists.
bool os_link_unnamed(int file, int folder, const char *name);
// Sets `path` to a path of an open folder. The path is valid while the folder is open.
bool os_folder_path(int folder, char path[PATH_MAX]);
// Fills at most 256 bytes with random bits.
bool os_random(void *bytes, size_t count);

// Sets `path` to the path of this program.
bool os_program_path(char path[PATH_MAX]);
// Returns a path that executes this program, even if its file was replaced where the system supports that. It may be in
// `path`. NULL: unknown.
const char *os_program(char path[PATH_MAX]);
// Sends `signal` to this process when its parent ends, if the system can do this.
void os_signal_after_parent(int signal);
// Create a pipe, and a pair of connected sockets, which are closed by exec.
bool os_pipe(int ends[2]);
bool os_socket_pair(int ends[2]);
// Sets the size of a terminal in characters and in pixels (0: unknown).
typedef struct OsTerminalSize {
    int columns;
    int rows;
    int width;
    int height;
} OsTerminalSize;
bool os_terminal_size(int terminal, OsTerminalSize *size);
