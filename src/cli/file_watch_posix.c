// file_watch_posix.c: see file_watch_system.h. POSIX cannot report changes of files, so they are only polled.
#include "cli/file_watch_system.h"

void watch_open(FileWatch *watch) {
    (void)watch;
}

void watch_close(FileWatch *watch) {
    (void)watch;
}

void watch_follow(const FileWatch *watch, File *file) {
    (void)watch;
    (void)file;
}

bool watch_read(FileWatch *watch) {
    (void)watch;
    return false;
}

void watch_set_timer(const FileWatch *watch, double seconds) {
    (void)watch;
    (void)seconds;
}
