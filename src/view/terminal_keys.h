// terminal_keys.h: what a terminal sends, as events: characters, the sequences of special keys, mouse and focus
// reports.
#ifndef PETRI_SRC_TERMINAL_KEYS_H
#define PETRI_SRC_TERMINAL_KEYS_H

#include "view/display.h"

#include <stddef.h>

typedef struct TerminalInput {
    unsigned char bytes[256]; // not understood yet
    size_t count;
    double since;     // when the first of them came: an escape by itself is a key, but only after a moment
    unsigned buttons; // of the mouse, that are down
    bool closed;      // nothing more will come
} TerminalInput;

// Reads what has come; sets `closed` at the end.
void terminal_input_read(TerminalInput *input, int fd);
// The next event, EVENT_NONE if there is none yet. The pointer is told in cells, from 0, in the middle of a cell.
Event terminal_input_next(TerminalInput *input);

#endif
