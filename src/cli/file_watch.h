// file_watch.h: tells when files have changed on disk.
//
// What counts is what the files are, not what was done to them: a change is told when a file's size, time, or identity
// (editors write a new file and rename it) is another than when it was told last, has been so for a moment, and nobody
// is seen to be writing it still. A file that is away has not changed: it is told when it is back. inotify wakes us
// where there is one; all files are looked at from time to time as well, for file systems whose changes it cannot see.
#ifndef PETRI_SRC_FILE_WATCH_H
#define PETRI_SRC_FILE_WATCH_H

#include <stdbool.h>

typedef struct FileWatch FileWatch;

// A watch over no files.
FileWatch *file_watch_new(void);
// NULL is fine.
void file_watch_free(FileWatch *watch);
// Watches a file from now on, whether it exists or not; its present content is known. A path that is watched already
// stays as it was.
void file_watch_add(FileWatch *watch, const char *path);
// True once after some files have changed. Never waits; call it whenever the descriptor is readable, or often.
bool file_watch_changed(FileWatch *watch);
// For poll: becomes readable when file_watch_changed should be called (also when a change is to be told only after a
// moment of quiet). -1 where there is no such thing: then call file_watch_changed every now and then.
int file_watch_descriptor(const FileWatch *watch);

#endif
