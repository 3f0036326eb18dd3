// file_watch_macos.c: see file_watch_system.h. A kqueue reports changes of open files and folders, and has a timer.
#include "cli/file_watch_system.h"
#include "cli/memory.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/event.h>
#include <unistd.h>

void watch_open(FileWatch *watch) {
    watch->wake = kqueue();
    if (watch->wake >= 0)
        fcntl(watch->wake, F_SETFD, FD_CLOEXEC);
}

// Closing a descriptor also removes it from the kqueue.
static void unfollow(File *file) {
    for (int i = 0; i < 2; i++) {
        if (file->watched[i] >= 0)
            close(file->watched[i]);
        file->watched[i] = -1;
    }
}

void watch_close(FileWatch *watch) {
    for (size_t i = 0; i < watch->count; i++)
        unfollow(&watch->files[i]);
    if (watch->wake >= 0)
        close(watch->wake);
    watch->wake = -1;
}

// Returns a descriptor that is watched for these changes (NOTE_...), or -1.
static int follow_path(const FileWatch *watch, const char *path, unsigned changes) {
    int found = open(path, O_EVTONLY | O_NONBLOCK | O_CLOEXEC); // opening a pipe must not block
    struct kevent added;
    if (found < 0)
        return -1;
    EV_SET(&added, (uintptr_t)found, EVFILT_VNODE, EV_ADD | EV_CLEAR, changes, 0, NULL);
    if (kevent(watch->wake, &added, 1, NULL, 0, NULL) == 0)
        return found;
    close(found);
    return -1;
}

// A folder changes when a name in it is created, removed or replaced. A file that is replaced stays open until the next
// call, and its own event says that it has lost its name.
void watch_follow(const FileWatch *watch, File *file) {
    SCOPED_STRING folder = memory_folder(file->path);
    unfollow(file);
    if (watch->wake < 0)
        return;
    file->watched[0] = follow_path(watch, folder, NOTE_WRITE | NOTE_DELETE | NOTE_RENAME);
    file->watched[1] = follow_path(watch, file->path, NOTE_WRITE | NOTE_ATTRIB | NOTE_DELETE | NOTE_RENAME);
}

bool watch_read(FileWatch *watch) {
    static const struct timespec now;
    struct kevent events[16];
    bool any = false;
    while (watch->wake >= 0 && kevent(watch->wake, NULL, 0, events, 16, &now) > 0)
        any = true;
    return any;
}

void watch_set_timer(const FileWatch *watch, double seconds) {
    struct kevent timer;
    if (watch->wake < 0)
        return;
    EV_SET(&timer, 0, EVFILT_TIMER, seconds > 0 ? EV_ADD | EV_ONESHOT : EV_DELETE, NOTE_USECONDS,
           (intptr_t)(seconds * 1e6), NULL);
    kevent(watch->wake, &timer, 1, NULL, 0, NULL); // to delete a timer that has expired is an error without effect
}
