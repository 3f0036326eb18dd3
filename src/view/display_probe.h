// display_probe.h: the screens for windows that the environment names, and whether they are there.
//
// SDL takes whatever is left if they are not, such as a window in memory that nobody sees, and the libraries below it
// wait for minutes if a network does not answer. So we ask first.
#ifndef PETRI_SRC_DISPLAY_PROBE_H
#define PETRI_SRC_DISPLAY_PROBE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct DisplayProbe {
    const char *driver;   // what SDL calls the way to it
    const char *variable; // of the environment, which names it
} DisplayProbe;

// Those that SDL can show windows on, in the order in which to try them; NULL beyond the last.
const DisplayProbe *display_probe_kind(size_t number);
// What the environment calls it; NULL if it names none.
const char *display_probe_name(const DisplayProbe *screen);
// Whether somebody answers there, within seconds.
bool display_probe_answers(const DisplayProbe *screen);

#endif
