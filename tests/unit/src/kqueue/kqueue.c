// kqueue.c: see sys/event.h. Files and folders are watched by inotify, the timer is a timerfd, and the queue is an
// epoll descriptor. There is one queue at a time, and kevent does not wait.
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/epoll.h>
#include <sys/event.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <sys/timerfd.h>
#include <unistd.h>

enum { MAX_WATCHES = 64 };

static int changed = -1, timer = -1;
static struct kevent watched[MAX_WATCHES]; // index: number of the inotify watch; its `data` is the inode

int kqueue(void) {
    int queue = epoll_create1(EPOLL_CLOEXEC);
    struct epoll_event readable = {.events = EPOLLIN};
    close(changed);
    close(timer);
    changed = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    epoll_ctl(queue, EPOLL_CTL_ADD, changed, &readable);
    epoll_ctl(queue, EPOLL_CTL_ADD, timer, &readable);
    return queue;
}

// A folder has events for its names only, as with kqueue; writing to its files does not cause one.
static bool add_file(const struct kevent *change) {
    char path[40];
    struct stat info;
    snprintf(path, sizeof path, "/proc/self/fd/%d", (int)change->ident);
    if (fstat((int)change->ident, &info) != 0)
        return false;
    uint32_t kinds = S_ISDIR(info.st_mode) ? IN_CREATE | IN_DELETE | IN_MOVE : IN_MODIFY | IN_ATTRIB;
    int number = inotify_add_watch(changed, path, kinds | IN_DELETE_SELF | IN_MOVE_SELF);
    if (number < 0 || number >= MAX_WATCHES)
        return false;
    watched[number] = *change;
    watched[number].data = (intptr_t)info.st_ino;
    return true;
}

static bool set_timer(const struct kevent *change) {
    bool adds = change->flags & EV_ADD;
    struct itimerspec time = {.it_value = {change->data / 1000000, change->data % 1000000 * 1000}};
    return (!adds || (change->flags & EV_ONESHOT && change->fflags == NOTE_USECONDS)) &&
           timerfd_settime(timer, 0, &time, NULL) == 0;
}

static uint32_t notes_of(uint32_t kinds) {
    return (kinds & (IN_CREATE | IN_DELETE | IN_MOVE | IN_MODIFY) ? NOTE_WRITE : 0U) |
           (kinds & IN_ATTRIB ? NOTE_ATTRIB | NOTE_DELETE : 0U) | (kinds & IN_DELETE_SELF ? NOTE_DELETE : 0U) |
           (kinds & IN_MOVE_SELF ? NOTE_RENAME : 0U);
}

// Returns true if the program asked for this change, and its descriptor is still open.
static bool is_wanted(const struct inotify_event *event) {
    const struct kevent *asked = &watched[event->wd];
    struct stat info;
    return (notes_of(event->mask) & asked->fflags) && fstat((int)asked->ident, &info) == 0 &&
           (intptr_t)info.st_ino == asked->data;
}

int kevent(int queue, const struct kevent *changes, int change_count, struct kevent *events, int event_count,
           const struct timespec *timeout) {
    (void)queue;
    for (int i = 0; i < change_count; i++)
        if (!(changes[i].filter == EVFILT_TIMER ? set_timer(&changes[i]) : add_file(&changes[i])))
            return -1;
    if (event_count == 0)
        return 0;
    if (!timeout || timeout->tv_sec || timeout->tv_nsec)
        return -1;
    union {
        struct inotify_event first; // for its alignment
        char bytes[1 << 12];
    } buffer;
    int count = 0;
    for (ssize_t size; count == 0 && (size = read(changed, buffer.bytes, sizeof buffer)) > 0;) {
        for (char *at = buffer.bytes; at < buffer.bytes + size;) {
            const struct inotify_event *event = (const void *)at;
            if (count < event_count && event->wd > 0 && event->wd < MAX_WATCHES && is_wanted(event))
                events[count++] = watched[event->wd];
            at += sizeof *event + event->len;
        }
    }
    uint64_t expired;
    if (count < event_count && read(timer, &expired, sizeof expired) > 0)
        events[count++] = (struct kevent){.filter = EVFILT_TIMER};
    return count;
}
