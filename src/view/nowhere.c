// nowhere.c: a display where there is none any more.
#include <time.h>

#include "view/display.h"

static Event nowhere_next_event(Display *display, double seconds) {
    (void)display;
    const double nanoseconds = 1e9;
    struct timespec pause = {.tv_sec = (time_t)seconds};
    pause.tv_nsec = (long)((seconds - (double)pause.tv_sec) * nanoseconds);
    if (seconds > 0) {
        nanosleep(&pause, NULL); // until a signal comes, at most
    }
    return (Event){.kind = EVENT_NONE};
}

static void nowhere_size(Display *display, int width, int height, int *drawn_width, int *drawn_height) {
    (void)display;
    (void)width;
    (void)height;
    *drawn_width = *drawn_height = 0;
}

static bool nowhere_show(Display *display, PetriPicture *picture, const Overlay *overlay, PetriStatus *status) {
    (void)display;
    (void)picture;
    (void)overlay;
    *status = PETRI_OK;
    return true;
}

static void nowhere_set_title(Display *display, const char *title) {
    (void)display;
    (void)title;
}

static const DisplayKind NOWHERE = {
    .next_event = nowhere_next_event,
    .size = nowhere_size,
    .show_directly = nowhere_show,
    .set_title = nowhere_set_title,
    .logs = true,
};

const DisplayKind *nowhere_display(void) {
    return &NOWHERE;
}
