// display.h: the interface of a display of `petri view`: a window or the terminal.
//
// A display shows pictures, reports user input, and can be closed at any time. It must be used by one thread.
#pragma once

#include "petri-draw.h"
#include "petri-live.h"
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
    const char *key; // name of the key, as in petri_report_key; NULL: the key has no name
    bool pressed;    // true if the key was pressed, false if it was released
    bool repeated;   // true if auto-repeat generated the press
    bool control;    // true if Control is held
    bool inside;     // true if the pointer is over the display
    double x;        // position of the pointer in pixels, within the area whose size DisplayKind.size sets
    double y;
    unsigned buttons; // PETRI_BUTTON_...
    Display *display; // the display that the event belongs to; NULL: the first
} Event;

// Returns the name, as in petri_report_key, of the key that types an ASCII character: a letter of either case, a digit,
// a space or a symbol. For +, returns the key of =. Returns NULL for other characters (terminal_keys.c).
const char *key_of_character(char character);

typedef struct DisplayKind {
    // Opens a display for a script of size `width` x `height`. The painter draws the pictures, and must not have drawn
    // anything yet. If `colour` is false, terminals show black and white. On failure, writes a message and returns
    // NULL.
    Display *(*open)(const char *title, int width, int height, PetriPainter *painter, bool colour);
    // Opens a further display, which uses the painter of `first` and must be closed before it. On failure, writes a
    // message and returns NULL. NULL: there is only one display.
    Display *(*open_another)(Display *first, const char *title, int width, int height);
    // Closes and frees the display. NULL is ignored.
    void (*close)(Display *display);
    // Hides the display until it is closed. NULL: not possible.
    void (*hide)(Display *display);
    // Waits at most `seconds` for the next event of the first display and all further ones. Returns EVENT_NONE if there
    // is none.
    Event (*next_event)(Display *display, double seconds);
    // Sets *drawn_width and *drawn_height to the size in pixels at which to draw a picture of width x height.
    void (*size)(Display *display, int width, int height, int *drawn_width, int *drawn_height);
    // Returns the number of pixels per unit of the overlay's text. NULL: the display cannot show sliders.
    double (*scale)(const Display *display);
    // Returns true if the display shows too few details for full resolution, so that pictures can be rendered at the
    // lower resolution that `size` returns. NULL: pictures are always rendered in full detail.
    bool (*coarse)(const Display *display);
    // Draws a picture (NULL: black) and the overlay on the display without reading pixels back from the graphics card,
    // and sets *status. If this is not possible, returns false without any effect; the caller then calls `show`. If
    // this function pointer is NULL, drawing in this way is never possible.
    bool (*show_directly)(Display *display, PetriPicture *picture, const Overlay *overlay, PetriStatus *status);
    // Shows pixels (32 bits each, alpha in the highest byte, premultiplied, opaque) and the overlay. If the display can
    // no longer be used, writes a message and returns false.
    bool (*show)(Display *display, uint32_t *pixels, int width, int height, const Overlay *overlay);
    void (*set_title)(Display *display, const char *title);
    // Called when the script's size has changed. NULL: the display keeps its size.
    void (*resize)(Display *display, int width, int height);
    // Moves the display to the screen with this number, counted from 0. If there is no such screen, writes a message
    // and returns false. NULL: there is only one screen.
    bool (*move_to_screen)(Display *display, int screen);
    void (*toggle_full_screen)(Display *display); // NULL: not possible
    // Returns true if the display and its screen were lost. The caller must then not call any other function, not even
    // `close`. NULL: this kind of display cannot be lost; its functions fail instead.
    bool (*gone)(const Display *display);
    double min_seconds; // minimum time between two pictures, in seconds
    bool logs;          // true if text on standard error does not disturb the open display
} DisplayKind;

// Returns a display that shows nothing and has no events, to continue a run after the display was lost.
const DisplayKind *null_display(void);
// Returns the window display, or NULL if petri was built without SDL.
const DisplayKind *window_display(void);
// Returns true if an environment variable names a screen or video driver for windows.
bool window_has_screen(void);
// Returns the terminal display, or NULL if petri was built without libchafa.
const DisplayKind *terminal_display(void);
