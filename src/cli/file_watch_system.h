// file_watch_system.h: the parts of file_watch.c that differ between operating systems: events of files, and a timer.
// One of file_watch_linux.c, file_watch_macos.c and file_watch_posix.c is compiled.
#pragma once

#include "cli/file_watch.h"

#include <stddef.h>
#include <stdint.h>

// Identity and version of a file, from stat. All zero if there is no regular file.
typedef struct Stamp {
    int64_t exists; // 1 or 0
    int64_t device;
    int64_t inode;
    int64_t size;
    int64_t seconds; // modification time
    int64_t nanoseconds;
} Stamp;

typedef struct File {
    char *path;
    Stamp reported; // stamp at the last reported change
    Stamp found;    // stamp at the last poll
    double since;   // time when `found` was first seen
    bool pending;   // true if `found` differs from `reported` and this change is not reported yet
    bool written;   // true while a process has written to the file and not closed it yet; only Linux reports this
    // What the system watches; -1: nothing. Linux: numbers of inotify watches of the folders of `path` and of `target`
    // (often the same watch). macOS: descriptors of the folder of `path` and of the file.
    int watched[2];
    const char *names[2]; // Linux: file names in the two folders; they point into `path` and `target`
    char *target;         // Linux: `path` with symbolic links resolved; NULL: the file does not exist
} File;

struct FileWatch {
    int wake;   // descriptor of epoll or kqueue; -1: none
    int events; // Linux: inotify descriptor
    int timer;  // Linux: timerfd
    File *files;
    size_t count;
    double last_check; // time of the last poll
};

// Opens the descriptors, which are -1 before. If this fails, for example because no descriptor is free, they stay -1,
// and files are only polled.
void watch_open(FileWatch *watch);
// Closes all descriptors.
void watch_close(FileWatch *watch);
// Watches the file that is at `path` now, and its folder. The call replaces earlier watches of this File.
void watch_follow(const FileWatch *watch, File *file);
// Reads all pending events, also that of the timer. Returns true if there were any.
bool watch_read(FileWatch *watch);
// Makes the watch's descriptor readable after this many seconds. 0 stops the timer.
void watch_set_timer(const FileWatch *watch, double seconds);
