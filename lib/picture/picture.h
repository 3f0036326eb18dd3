// picture.h: a picture: a copy of the visible nodes of a frame (picture.c), ready to be drawn (painter.c).
#pragma once

#include "picture/canvas_picture.h"

struct DrawAccess; // session/draw_access.h

// Properties of a window that its DrawNode does not contain.
typedef struct PictureWindow {
    bool has_picture; // canvas_window_has_picture
    bool has_size;    // true if the attribute `size` is set, even if its value is not valid
} PictureWindow;

struct PetriPicture {
    Arena arena; // holds all other data
    CanvasPicture picture;
    AutoPicture automatic;
    PetriPictureOptions options; // as passed to petri_picture
    PictureWindow *windows;      // properties of each window in `picture.tops`
    int shown;                   // number of the shown window; -1: none
    int width;                   // size in pixels
    int height;
    int64_t frame;
    const char *title;
    uint64_t work;  // units of work of petri_picture_render that petri_picture_report has not added to the session
    DiagSink diags; // diagnostics reported so far while the picture was drawn
};

// Returns true if this size in pixels is allowed for a picture.
static inline bool picture_is_good_size(double width, double height) {
    return width >= 1 && height >= 1 && width <= PETRI_MAX_PICTURE_SIDE && height <= PETRI_MAX_PICTURE_SIDE;
}

// shown_window.c
// Returns the window with this number. If the number is negative, returns the first `!window` with content, else the
// first `!offscreen` with content, else the first of all windows.
const Node *picture_find_window(const struct DrawAccess *access, int number);
// Reports the second `!window` if only the first is drawn.
void picture_report_other_windows(PetriPicture *picture, const struct DrawAccess *access);
// Lets the picture show the window with this number (-1: none), and sets its size and title. Returns NULL on success.
// Otherwise returns the reason, a text that lives as long as the picture, and changes nothing.
const char *picture_show_window(PetriPicture *picture, int number);
