// null_display.c: a display that shows nothing, for a run whose display was lost.
#include "view/display.h"

#include <time.h>

static Event null_next_event(Display *display, double seconds) {
    (void)display;
    const double nanoseconds = 1e9;
    struct timespec pause = {.tv_sec = (time_t)seconds};
    pause.tv_nsec = (long)((seconds - (double)pause.tv_sec) * nanoseconds);
    if (seconds > 0)
        nanosleep(&pause, NULL); // a signal may end the sleep early
    return (Event){.kind = EVENT_NONE};
}

static void null_size(Display *display, int width, int height, int *drawn_width, int *drawn_height) {
    (void)display;
    (void)width;
    (void)height;
    *drawn_width = *drawn_height = 0;
}

static bool null_show(Display *display, PetriPicture *picture, const Overlay *overlay, PetriStatus *status) {
    (void)display;
    (void)picture;
    (void)overlay;
    *status = PETRI_OK;
    return true;
}

static void null_set_title(Display *display, const char *title) {
    (void)display;
    (void)title;
}

static const DisplayKind NULL_DISPLAY = {
    .next_event = null_next_event,
    .size = null_size,
    .show_directly = null_show,
    .set_title = null_set_title,
    .logs = true,
};

const DisplayKind *null_display(void) {
    return &NULL_DISPLAY;
}
