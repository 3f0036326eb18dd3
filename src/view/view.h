// view.h: what the files of `petri view` share.
#ifndef PETRI_SRC_VIEW_VIEW_H
#define PETRI_SRC_VIEW_VIEW_H

#include "view/display.h"
#include "view/listen.h"
#include "view/live_script.h"
#include "view/parameters.h"

typedef struct View {
    const CommandContext *host;
    LiveScript live;
    Listener listener; // for editors
    const DisplayKind *kind;
    Display *display;
    Overlay overlay;
    bool paused;
    bool step_once;
    bool shows_status;
    bool shows_warnings;
    bool redraw;
    bool closing;
    bool broken; // the display, or memory for it, is gone
    double start;
    double drawn;       // when the drawing of the last picture began
    double notice_ends; // INFINITY: it stays
    // The frame rate
    double measured;
    int64_t measured_frames;
    double rate;
    // Pixels of the display
    uint32_t *pixels;
    int drawn_width; // 0: nothing was drawn into them
    int drawn_height;
    int64_t pictures; // shown since the view was opened
    // The script's size and title as the display knows them
    int width;
    int height;
    char title[300];
    Event pointer; // the last that moved
    ParameterKeys parameters;
} View;

// status_text.c: the texts over the picture, which is drawn again where they change.

// Tells what was done just now, for some seconds.
__attribute__((format(printf, 2, 3))) void view_notice(View *view, const char *format, ...);
// Shows for three seconds which key lists the others, unless there is something else to show.
void view_hint_keys(View *view);
// Shows what there is when there is nothing to tell.
void view_reset_notice(View *view);
// What is wrong with the script, and the number or list of its warnings.
void view_update_error_text(View *view);
// Frame rate, clocks and keys.
void view_update_status(View *view);
// The same, if it is time to: twice a second is as much as can be read; while paused the numbers are those of the frame
// that is seen.
void view_measure_rate(View *view);

#endif
