// terminal_keys.h: converts terminal input to events: characters, escape sequences of keys, reports of mouse and focus.
#pragma once

#include "view/display.h"

#include <stddef.h>

typedef struct TerminalInput {
    unsigned char bytes[256]; // input that is not decoded yet
    size_t count;
    double since; // time at which the last bytes arrived; a single escape counts as the Escape key only after a delay
    unsigned buttons; // mouse buttons that are currently pressed
    bool closed;      // end of input
} TerminalInput;

// Reads the available input without waiting. Sets `closed` at the end of the input.
void terminal_input_read(TerminalInput *input, int fd);
// Returns the next event, or EVENT_NONE if there is none yet. The pointer's position is the centre of a cell, in units
// of cells, counted from 0.
Event terminal_input_next(TerminalInput *input);
