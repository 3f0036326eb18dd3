// display.h: what `petri view` shows its pictures on: a window, or the terminal.
//
// A display shows pictures, tells what the user's hands do, and can be closed at any time. It belongs to one thread.
#ifndef PETRI_SRC_DISPLAY_H
#define PETRI_SRC_DISPLAY_H

#include "petri-draw.h"
#include "view/overlay_text.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Display Display;

typedef enum EventKind {
    EVENT_NONE,
    EVENT_CLOSE,      // the user wants to go
    EVENT_KEY,        // `key` went down or up
    EVENT_KEY_TAP,    // `key` was pressed; when it is let go cannot be known
    EVENT_POINTER,    // it moved, its buttons changed, or it left
    EVENT_FOCUS_LOST, // the user turned to something else: nothing is pressed any more
    EVENT_REDRAW,     // another size, or a part was covered
} EventKind;

typedef struct Event {
    EventKind kind;
    const char *key; // its name as petri_report_key knows it; NULL: another key
    bool pressed;
    bool repeated; // repeated by the keyboard
    bool control;  // pressed with Control
    bool inside;   // the pointer is over the display's picture area
    double x;      // … in pixels, as `size` counts them
    double y;
    unsigned buttons; // PETRI_BUTTON_...
} Event;

// The name, as petri_report_key knows it, of the key that a character is on: a letter of either case, a digit, a space,
// a sign of ASCII (+ is on that of =); NULL for others (terminal_keys.c).
const char *key_of_character(char character);

typedef struct DisplayKind {
    // `width` x `height` is the script's size. The painter, which has made nothing yet and is closed first, draws what
    // is shown; `colour` is for terminals. NULL after a message.
    Display *(*open)(const char *title, int width, int height, PetriPainter *painter, bool colour);
    // NULL is fine.
    void (*close)(Display *display);
    // The next event, waited for no longer than `seconds`; EVENT_NONE if there was none.
    Event (*next_event)(Display *display, double seconds);
    // How many pixels a picture of width x height is to be drawn with.
    void (*size)(Display *display, int width, int height, int *drawn_width, int *drawn_height);
    // Returns true if pictures may be made with as few pixels as `size` says. NULL: they are made in full detail.
    bool (*coarse)(const Display *display);
    // Shows a picture (NULL: black) and the overlay's texts without having its pixels; what became of it in *status.
    // False, and nothing is done, if it cannot, NULL if it never can: then `show` is to be called.
    bool (*show_directly)(Display *display, PetriPicture *picture, const Overlay *overlay, PetriStatus *status);
    // Shows that many pixels (32 bits each, alpha in the highest byte, premultiplied, opaque) and the overlay's texts.
    // False if there is no going on, after a message.
    bool (*show)(Display *display, uint32_t *pixels, int width, int height, const Overlay *overlay);
    void (*set_title)(Display *display, const char *title);
    // The script's size has changed; NULL: a display has the size that it has.
    void (*resize)(Display *display, int width, int height);
    void (*toggle_full_screen)(Display *display); // NULL: it cannot
    // Whether the display has gone, with its screen: after that nothing of it may be called, `close` neither. NULL: its
    // functions fail then.
    bool (*gone)(const Display *display);
    double min_seconds; // between two pictures
    bool logs;          // standard error may be written to while it is open
} DisplayKind;

// None at all, for what goes on without: nothing is shown, nothing comes.
const DisplayKind *null_display(void);
// A window; NULL if petri was built without SDL.
const DisplayKind *window_display(void);
// Whether there is a screen for windows, as far as the environment tells.
bool window_has_screen(void);
// The terminal; NULL if petri was built without libchafa.
const DisplayKind *terminal_display(void);

#endif
