// event.h: the part of kqueue that file_watch_macos.c uses, so that a test of it runs on Linux (../kqueue.c). Values
// are not those of macOS.
#pragma once

#include <stdint.h>
#include <time.h>

enum { EVFILT_VNODE = -4, EVFILT_TIMER = -7 };
enum { EV_ADD = 1, EV_DELETE = 2, EV_ONESHOT = 16, EV_CLEAR = 32 };
enum { NOTE_DELETE = 1, NOTE_WRITE = 2, NOTE_ATTRIB = 8, NOTE_RENAME = 32 };
enum { NOTE_USECONDS = 2 };

struct kevent {
    uintptr_t ident;
    int16_t filter;
    uint16_t flags;
    uint32_t fflags;
    intptr_t data;
    void *udata;
};

#define EV_SET(event, ident, filter, flags, fflags, data, udata)                                                       \
    (*(event) = (struct kevent){(ident), (filter), (uint16_t)(flags), (fflags), (data), (udata)})

int kqueue(void);
int kevent(int queue, const struct kevent *changes, int change_count, struct kevent *events, int event_count,
           const struct timespec *timeout);
