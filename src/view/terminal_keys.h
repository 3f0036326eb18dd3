// terminal_keys.h: converts terminal input to events: characters, escape sequences of keys, reports of mouse and focus.
#ifndef PETRI_SRC_TERMINAL_KEYS_H
#define PETRI_SRC_TERMINAL_KEYS_H

#include "view/display.h"

#include <stddef.h>

typedef struct TerminalInput {
    unsigned char bytes[256]; // input that is not decoded yet
    size_t count;
    double since;     // time at which the last bytes came; a lone escape is a key only after a delay
    unsigned buttons; // mouse buttons that are pressed
    bool closed;      // end of input
} TerminalInput;

// Reads available input; sets `closed` at its end.
void terminal_input_read(TerminalInput *input, int fd);
// Returns the next event, or EVENT_NONE if there is none yet. The pointer's position is the middle of a cell, in cells
// from 0.
Event terminal_input_next(TerminalInput *input);

#endif
