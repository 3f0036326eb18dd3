// file_watch.c: see file_watch.h. Decides from the files' stamps what is reported, and when.
#include "cli/file_watch.h"

#include "base/clock.h"
#include "base/os.h"
#include "cli/file_watch_system.h"
#include "cli/memory.h"

#include <stdlib.h>
#include <string.h>

// QUIET_SECONDS: how long a file must be stable before a change is reported. MAX_WRITE_SECONDS: the same for a file
// that a process has written to and not closed yet. SLOW_POLL_SECONDS: interval between polls of all files if the
// system reports changes. FAST_POLL_SECONDS: the same if it does not.
static const double QUIET_SECONDS = 0.05, MAX_WRITE_SECONDS = 2, SLOW_POLL_SECONDS = 1, FAST_POLL_SECONDS = 0.2;

static Stamp stamp_of(const char *path) {
    struct stat info;
    // A pipe counts as missing, because reading it again could block.
    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode))
        return (Stamp){0};
    struct timespec modified = os_time_modified(&info);
    return (Stamp){true,
                   (int64_t)info.st_dev,
                   (int64_t)info.st_ino,
                   (int64_t)info.st_size,
                   (int64_t)modified.tv_sec,
                   (int64_t)modified.tv_nsec};
}

static bool is_same_stamp(const Stamp *a, const Stamp *b) {
    return memcmp(a, b, sizeof *a) == 0;
}

FileWatch *file_watch_new(void) {
    FileWatch *watch = memory_calloc(sizeof *watch);
    watch->wake = watch->events = watch->timer = -1;
    watch->last_check = clock_seconds();
    watch_open(watch);
    return watch;
}

void file_watch_free(FileWatch *watch) {
    if (!watch)
        return;
    watch_close(watch);
    for (size_t i = 0; i < watch->count; i++) {
        free(watch->files[i].path);
        free(watch->files[i].target);
    }
    free(watch->files);
    free(watch);
}

// Returns true if a change of this file must be reported now. Otherwise, if a change is pending, limits *wait to the
// seconds until that change can be reported.
static bool check_file(const FileWatch *watch, File *file, double time, double *wait) {
    Stamp stamp = stamp_of(file->path);
    if (!is_same_stamp(&stamp, &file->found)) {
        file->found = stamp;
        file->since = time;
        watch_follow(watch, file);
    }
    file->pending = stamp.exists && !is_same_stamp(&stamp, &file->reported);
    if (!file->pending)
        return false;
    double left = file->since + (file->written ? MAX_WRITE_SECONDS : QUIET_SECONDS) - time;
    if (left > 0) {
        *wait = left < *wait ? left : *wait;
        return false;
    }
    file->reported = stamp;
    file->pending = file->written = false;
    return true;
}

static bool any_pending(const FileWatch *watch) {
    for (size_t i = 0; i < watch->count; i++)
        if (watch->files[i].pending)
            return true;
    return false;
}

// Returns true if the system can miss a change, because a folder or file cannot be watched or does not exist.
static bool needs_polling(const FileWatch *watch) {
    for (size_t i = 0; i < watch->count; i++)
        if (watch->files[i].watched[0] < 0 || watch->files[i].watched[1] < 0 || !watch->files[i].found.exists)
            return true;
    return false;
}

static void schedule_wake(const FileWatch *watch, double wait) {
    if (any_pending(watch))
        watch_set_timer(watch, wait);
    else
        watch_set_timer(watch, needs_polling(watch) ? SLOW_POLL_SECONDS : 0);
}

void file_watch_add(FileWatch *watch, const char *path) {
    for (size_t i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0)
            return;
    watch->files = memory_realloc(watch->files, (watch->count + 1) * sizeof *watch->files);
    File *file = &watch->files[watch->count++];
    *file = (File){.path = memory_strdup(path), .watched = {-1, -1}};
    watch_follow(watch, file); // before stamp_of, so that no change between the two calls is missed
    file->reported = file->found = stamp_of(path);
    schedule_wake(watch, QUIET_SECONDS);
}

bool file_watch_changed(FileWatch *watch) {
    double time = clock_seconds(), wait = MAX_WRITE_SECONDS;
    bool woken = watch_read(watch),
         late = time - watch->last_check >= (watch->wake >= 0 ? SLOW_POLL_SECONDS : FAST_POLL_SECONDS);
    if (!woken && !late && !any_pending(watch))
        return false;
    watch->last_check = time;
    bool changed = false;
    for (size_t i = 0; i < watch->count; i++) {
        if (late && !watch->files[i].found.exists)
            watch_follow(watch, &watch->files[i]); // the file's folder may have been re-created
        changed = check_file(watch, &watch->files[i], time, &wait) || changed;
    }
    schedule_wake(watch, wait);
    return changed;
}

int file_watch_descriptor(const FileWatch *watch) {
    return watch->wake;
}
