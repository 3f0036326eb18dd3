// display.h: the interface of a display of `petri view`: a window or the terminal.
//
// A display shows pictures, reports user input, and can be closed at any time. It must be used by one thread.
#ifndef PETRI_SRC_DISPLAY_H
#define PETRI_SRC_DISPLAY_H

#include "petri-draw.h"
#include "view/overlay_text.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Display Display;

typedef enum EventKind {
    EVENT_NONE,
    EVENT_CLOSE,      // the user closes the display
    EVENT_KEY,        // `key` was pressed or released
    EVENT_KEY_TAP,    // `key` was pressed; its release is not reported
    EVENT_POINTER,    // the pointer moved, its buttons changed, or it left the display
    EVENT_FOCUS_LOST, // the display lost the focus: all keys and buttons count as released
    EVENT_REDRAW,     // the size changed, or a covered part became visible
} EventKind;

typedef struct Event {
    EventKind kind;
    const char *key; // name of the key as for petri_report_key; NULL: a key without a name
    bool pressed;
    bool repeated; // by auto-repeat
    bool control;  // pressed with Control
    bool inside;   // the pointer is over the display
    double x;      // position in pixels, in the coordinates of DisplayKind.size
    double y;
    unsigned buttons; // PETRI_BUTTON_...
} Event;

// Returns the name, as for petri_report_key, of the key with an ASCII character: a letter of either case, a digit, a
// space or a sign (+ is on the key of =). Returns NULL for others (terminal_keys.c).
const char *key_of_character(char character);

typedef struct DisplayKind {
    // Opens a display for a script of size `width` x `height`. The painter draws the pictures; it has not drawn yet,
    // and is closed before the display. `colour` is for terminals. Returns NULL after a message.
    Display *(*open)(const char *title, int width, int height, PetriPainter *painter, bool colour);
    // Closes and frees the display. NULL is ignored.
    void (*close)(Display *display);
    // Returns the next event, after waiting at most `seconds`; EVENT_NONE if there is none.
    Event (*next_event)(Display *display, double seconds);
    // Sets the size in pixels with which a picture of width x height must be drawn.
    void (*size)(Display *display, int width, int height, int *drawn_width, int *drawn_height);
    // Returns true if pictures may be rendered at the low resolution of `size`. NULL: always full detail.
    bool (*coarse)(const Display *display);
    // Shows a picture (NULL: black) and the overlay without reading its pixels, and sets *status. Returns false without
    // any effect if this is not possible; NULL: never possible. Then `show` must be called.
    bool (*show_directly)(Display *display, PetriPicture *picture, const Overlay *overlay, PetriStatus *status);
    // Shows pixels (32 bits each, alpha in the highest byte, premultiplied, opaque) and the overlay. Returns false
    // after a message if the display can no longer be used.
    bool (*show)(Display *display, uint32_t *pixels, int width, int height, const Overlay *overlay);
    void (*set_title)(Display *display, const char *title);
    // Called when the script's size has changed. NULL: the display keeps its size.
    void (*resize)(Display *display, int width, int height);
    void (*toggle_full_screen)(Display *display); // NULL: not possible
    // Returns true if the display was lost, together with its screen. After that no function may be called, not even
    // `close`. NULL: the other functions fail instead.
    bool (*gone)(const Display *display);
    double min_seconds; // minimum time between two pictures
    bool logs;          // standard error may be written to while the display is open
} DisplayKind;

// Returns a display that shows nothing and has no events, to continue a run after the display was lost.
const DisplayKind *null_display(void);
// Returns the window display, or NULL if petri was built without SDL.
const DisplayKind *window_display(void);
// Returns true if the environment names a screen for windows.
bool window_has_screen(void);
// Returns the terminal display, or NULL if petri was built without libchafa.
const DisplayKind *terminal_display(void);

#endif
