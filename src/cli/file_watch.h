// file_watch.h: detection of files that have changed on disk.
//
// A file has changed if its size, modification time or inode differs from the values at the last report. A change is
// reported when the file has been stable for a moment. While inotify shows that a process has not closed the file after
// writing, the file must be stable for longer. A missing file is reported when it exists again. Inotify (Linux) or
// kqueue (macOS) wakes the caller. All files are also polled about once per second, because both miss changes on some
// file systems.
#pragma once

#include <stdbool.h>

typedef struct FileWatch FileWatch;

// Returns an empty watch. The caller frees it with file_watch_free.
FileWatch *file_watch_new(void);
// NULL is ignored.
void file_watch_free(FileWatch *watch);
// Watches a file, which need not exist. Only changes after this call are reported. A path that is already watched is
// ignored.
void file_watch_add(FileWatch *watch, const char *path);
// Returns true once after one or more files have changed. Does not block. Call it when the descriptor is readable, or
// periodically.
bool file_watch_changed(FileWatch *watch);
// Returns a descriptor for poll that is readable when file_watch_changed should be called. Returns -1 if there is none
// (neither Linux nor macOS, or no free descriptors). In this case, call file_watch_changed a few times per second.
int file_watch_descriptor(const FileWatch *watch);
