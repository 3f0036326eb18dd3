// file_watch.c: see file_watch.h.
//
// On Linux, one epoll descriptor combines inotify and a timer that expires when a changed file has been stable long
// enough. Elsewhere the files are only polled. With kqueue, macOS and BSD could report changes earlier, but every file
// and folder would need an open descriptor.
#include "cli/file_watch.h"

#include "base/clock.h"
#include "base/os.h"
#include "base/source.h"
#include "cli/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#if defined __linux__ && !defined PETRI_PLAIN_POSIX
#include <sys/epoll.h>
#include <sys/inotify.h>
#include <sys/timerfd.h>
#define HAVE_INOTIFY 1
#else
#define HAVE_INOTIFY 0
#endif

// QUIET_SECONDS: how long a file must be stable before a change is reported. MAX_WRITE_SECONDS: the same for a file
// that a process has written to and not closed yet. SLOW_POLL_SECONDS: interval between polls of all files if inotify
// is used. FAST_POLL_SECONDS: the same without inotify.
static const double QUIET_SECONDS = 0.05, MAX_WRITE_SECONDS = 2, SLOW_POLL_SECONDS = 1, FAST_POLL_SECONDS = 0.2;

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
    bool written;   // true while a process has written to the file and not closed it yet
    // Numbers of inotify watches: [0] of the folder of `path`, [1] of the folder of `target` (often the same watch);
    // -1: none.
    int folders[2];
    const char *names[2]; // file names in these folders; they point into `path` and `target`
    char *target;         // `path` with symbolic links resolved; NULL: the file does not exist
} File;

struct FileWatch {
    int wake;   // epoll descriptor; -1: none
    int events; // inotify descriptor
    int timer;  // timerfd
    File *files;
    size_t count;
    double last_check; // time of the last poll
};

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

#if HAVE_INOTIFY
static void close_all(FileWatch *watch) {
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

// Opens inotify and the descriptors for waiting. If this fails, for example because no descriptor is free, files are
// only polled.
static void open_wake(FileWatch *watch) {
    watch->wake = epoll_create1(EPOLL_CLOEXEC);
    watch->events = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    watch->timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    if (watch->wake < 0 || !add_wake_source(watch, watch->events) || !add_wake_source(watch, watch->timer))
        close_all(watch);
}

// Watches the folder of a path. Returns the number of the watch, or -1.
static int watch_folder(const FileWatch *watch, const char *path) {
    const uint32_t kinds = IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO;
    size_t length = path_directory(str_from(path)).len;
    SCOPED_STRING folder = length == 0 ? memory_strdup(".") : memory_strndup(path, length);
    return watch->events < 0 ? -1 : inotify_add_watch(watch->events, folder, kinds);
}

static const char *name_in_folder(const char *path) {
    return path + path_directory(str_from(path)).len;
}

// Updates the watches of a file's folders. If a folder is unchanged, inotify returns the same number again. If it was
// deleted and created again, it gets a new number.
static void watch_folders(const FileWatch *watch, File *file) {
    free(file->target);
    file->target = realpath(file->path, NULL);
    file->folders[0] = watch_folder(watch, file->path);
    file->names[0] = name_in_folder(file->path);
    file->folders[1] = !file->target ? -1 : watch_folder(watch, file->target);
    file->names[1] = !file->target ? "" : name_in_folder(file->target);
}

static void handle_event(FileWatch *watch, const struct inotify_event *event) {
    for (size_t i = 0; i < watch->count; i++) {
        File *file = &watch->files[i];
        for (int j = 0; j < 2; j++)
            if (event->len > 0 && event->wd == file->folders[j] && strcmp(event->name, file->names[j]) == 0)
                file->written = (event->mask & IN_MODIFY) != 0;
    }
}

// Reads all pending events of inotify and the timer. Returns true if there were any.
static bool handle_events(FileWatch *watch) {
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

// Makes the watch's descriptor readable after this many seconds. 0 stops the timer.
static void set_timer(const FileWatch *watch, double seconds) {
    struct itimerspec time = {.it_value = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)}};
    if (watch->timer >= 0)
        timerfd_settime(watch->timer, 0, &time, NULL);
}
#else
static void close_all(FileWatch *watch) {
    (void)watch;
}

static void open_wake(FileWatch *watch) {
    (void)watch;
}

static void watch_folders(const FileWatch *watch, File *file) {
    (void)watch;
    (void)file;
}

static bool handle_events(FileWatch *watch) {
    (void)watch;
    return false;
}

static void set_timer(const FileWatch *watch, double seconds) {
    (void)watch;
    (void)seconds;
}
#endif

FileWatch *file_watch_new(void) {
    FileWatch *watch = memory_calloc(sizeof *watch);
    watch->wake = watch->events = watch->timer = -1;
    watch->last_check = clock_seconds();
    open_wake(watch);
    return watch;
}

void file_watch_free(FileWatch *watch) {
    if (!watch)
        return;
    close_all(watch);
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
        watch_folders(watch, file);
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

// Returns true if inotify can miss a change, because a folder cannot be watched or a file (perhaps with its folder)
// does not exist.
static bool needs_polling(const FileWatch *watch) {
    for (size_t i = 0; i < watch->count; i++)
        if (watch->files[i].folders[0] < 0 || !watch->files[i].found.exists)
            return true;
    return false;
}

static void schedule_wake(const FileWatch *watch, double wait) {
    if (any_pending(watch))
        set_timer(watch, wait);
    else
        set_timer(watch, needs_polling(watch) ? SLOW_POLL_SECONDS : 0);
}

void file_watch_add(FileWatch *watch, const char *path) {
    for (size_t i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0)
            return;
    watch->files = memory_realloc(watch->files, (watch->count + 1) * sizeof *watch->files);
    File *file = &watch->files[watch->count++];
    *file = (File){.path = memory_strdup(path)};
    watch_folders(watch, file); // before stamp_of, so that no change between the two calls is missed
    file->reported = file->found = stamp_of(path);
    schedule_wake(watch, QUIET_SECONDS);
}

bool file_watch_changed(FileWatch *watch) {
    double time = clock_seconds(), wait = MAX_WRITE_SECONDS;
    bool woken = handle_events(watch),
         late = time - watch->last_check >= (watch->wake >= 0 ? SLOW_POLL_SECONDS : FAST_POLL_SECONDS);
    if (!woken && !late && !any_pending(watch))
        return false;
    watch->last_check = time;
    bool changed = false;
    for (size_t i = 0; i < watch->count; i++) {
        if (late && !watch->files[i].found.exists)
            watch_folders(watch, &watch->files[i]); // the file's folder may have been re-created
        changed = check_file(watch, &watch->files[i], time, &wait) || changed;
    }
    schedule_wake(watch, wait);
    return changed;
}

int file_watch_descriptor(const FileWatch *watch) {
    return watch->wake;
}
