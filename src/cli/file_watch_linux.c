// file_watch_linux.c: see file_watch_system.h. One epoll descriptor combines inotify and a timer.
#include "base/source.h"
#include "cli/file_watch_system.h"
#include "cli/memory.h"

#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/inotify.h>
#include <sys/timerfd.h>
#include <unistd.h>

void watch_close(FileWatch *watch) {
    int *const descriptors[] = {&watch->wake, &watch->events, &watch->timer};
    for (size_t i = 0; i < 3; i++) {
        if (*descriptors[i] >= 0)
            close(*descriptors[i]);
        *descriptors[i] = -1;
    }
}

static bool add_wake_source(const FileWatch *watch, int descriptor) {
    struct epoll_event event = {.events = EPOLLIN};
    return descriptor >= 0 && epoll_ctl(watch->wake, EPOLL_CTL_ADD, descriptor, &event) == 0;
}

void watch_open(FileWatch *watch) {
    watch->wake = epoll_create1(EPOLL_CLOEXEC);
    watch->events = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    watch->timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    if (watch->wake < 0 || !add_wake_source(watch, watch->events) || !add_wake_source(watch, watch->timer))
        watch_close(watch);
}

// Watches the folder of a path. Returns the number of the watch, or -1.
static int watch_folder(const FileWatch *watch, const char *path) {
    const uint32_t kinds = IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO;
    SCOPED_STRING folder = memory_folder(path);
    return watch->events < 0 ? -1 : inotify_add_watch(watch->events, folder, kinds);
}

static const char *name_in_folder(const char *path) {
    return path + path_directory(str_from(path)).len;
}

// If a folder is unchanged, inotify returns the same number again. If it was deleted and created again, it gets a new
// number.
void watch_follow(const FileWatch *watch, File *file) {
    free(file->target);
    file->target = realpath(file->path, NULL);
    file->watched[0] = watch_folder(watch, file->path);
    file->names[0] = name_in_folder(file->path);
    file->watched[1] = !file->target ? -1 : watch_folder(watch, file->target);
    file->names[1] = !file->target ? "" : name_in_folder(file->target);
}

static void handle_event(FileWatch *watch, const struct inotify_event *event) {
    for (size_t i = 0; i < watch->count; i++) {
        File *file = &watch->files[i];
        for (int j = 0; j < 2; j++)
            if (event->len > 0 && event->wd == file->watched[j] && strcmp(event->name, file->names[j]) == 0)
                file->written = (event->mask & IN_MODIFY) != 0;
    }
}

bool watch_read(FileWatch *watch) {
    bool any = false;
    union {
        struct inotify_event first; // for its alignment
        char bytes[1 << 14];
    } buffer;
    for (ssize_t size; watch->events >= 0 && (size = read(watch->events, buffer.bytes, sizeof buffer)) > 0;) {
        for (const char *at = buffer.bytes; at < buffer.bytes + size;) {
            const struct inotify_event *event = (const void *)at;
            handle_event(watch, event);
            at += sizeof *event + event->len;
        }
        any = true;
    }
    uint64_t expired;
    return (watch->timer >= 0 && read(watch->timer, &expired, sizeof expired) > 0) || any;
}

void watch_set_timer(const FileWatch *watch, double seconds) {
    struct itimerspec time = {.it_value = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)}};
    if (watch->timer >= 0)
        timerfd_settime(watch->timer, 0, &time, NULL);
}
