// view.h: the state of `petri view`, shared by its files.
#pragma once

#include "view/display.h"
#include "view/listen.h"
#include "view/live_script.h"
#include "view/parameters.h"

enum { MAX_OTHERS = 15 }; // maximum number of windows besides the first

// A window of the script besides the first.
typedef struct Pane {
    Display *display;
    int window; // number of the window in the last picture
    int width;  // size and title as last passed to the display
    int height;
    char title[300];
    bool hidden; // true if the user has closed the window
} Pane;

typedef struct View {
    const CommandContext *host; // borrowed
    LiveScript live;
    Listener listener;       // for `petri view --send`
    const DisplayKind *kind; // functions of `display`
    Display *display;        // shows the first window; NULL: the null display
    Pane others[MAX_OTHERS]; // the other windows
    int other_count;
    bool hidden;      // true if the user has closed the first window
    Display *focused; // the display of the last event; NULL: the first
    Overlay overlay;
    bool paused;
    bool step_once; // true if one frame must be computed although the view is paused
    bool shows_status;
    bool shows_warnings;
    bool redraw;        // true if the picture must be drawn again
    bool closing;       // true if the user has closed the view
    bool broken;        // true if the view must end, because the display was lost or memory is exhausted
    double start;       // time at which the view was opened
    double drawn;       // time at which drawing of the last picture began
    double notice_ends; // time at which the notice disappears; INFINITY: never
    // The frame rate
    double measured;         // time of the last measurement
    int64_t measured_frames; // number of frames computed until the last measurement
    double rate;             // frames per second
    // Pixels of the display
    uint32_t *pixels;
    int drawn_width; // 0: not drawn yet
    int drawn_height;
    int64_t pictures; // number of pictures shown since the view was opened
    // Size and title of the script as last passed to the display
    int width;
    int height;
    char title[300];
    Event pointer; // last pointer event
    ParameterKeys parameters;
    int dragged;          // index of the slider that the pointer drags; -1: none
    double dragged_to;    // value to which it was dragged
    bool dragged_further; // true if `dragged_to` has not been set in the script yet
} View;

// view.c
// Draws a picture (NULL: black) and an overlay on one of the displays. Returns the status of drawing.
PetriStatus view_show(View *view, Display *display, PetriPicture *picture, const Overlay *overlay);

// drag_sliders.c
// Shows or hides the sliders.
void view_toggle_sliders(View *view);
// Lets the pointer drag the sliders. `buttons_before` are the buttons of the previous pointer event. Returns true if
// the event belongs to the sliders, so that the script must not see it.
bool view_drag_slider(View *view, const Event *event, unsigned buttons_before);
// Sets the parameter to the value to which its slider was dragged. Many pointer events set it once.
void view_apply_drag(View *view);

// windows.c
// Opens, updates and closes displays, so that there is one for each window of the last picture.
void windows_follow(View *view);
// Draws a picture (NULL: black) on all displays but the first.
void windows_draw(View *view, PetriPicture *picture);
// Returns the pane of a display. Returns NULL for the first display.
Pane *windows_find(View *view, const Display *display);
// Hides a display that the user has closed. Returns false if no display is visible any more.
bool windows_hide(View *view, Display *display);
// Closes all displays but the first.
void windows_close(View *view);

// status_text.c: the texts shown over the picture. After a change of a text, the picture is drawn again.

// Shows a message about the last action for some seconds.
__attribute__((format(printf, 2, 3))) void view_notice(View *view, const char *format, ...);
// Shows for three seconds which key lists all keys, unless another text is shown.
void view_hint_keys(View *view);
// Replaces the notice by the default one: how to resume while paused, else nothing.
void view_reset_notice(View *view);
// Updates the errors of the script, and the number or the list of its warnings.
void view_update_error_text(View *view);
// Updates frame rate, clocks and keys.
void view_update_status(View *view);
// Measures the frame rate and updates the status, but at most twice a second, so that the status remains readable.
void view_measure_rate(View *view);
