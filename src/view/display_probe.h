// display_probe.h: the screens that the environment names, and whether they can be reached.
//
// If none can be reached, SDL falls back to drivers such as an invisible window in memory, and libraries wait for
// minutes on a network that does not answer. So petri checks first.
#ifndef PETRI_SRC_DISPLAY_PROBE_H
#define PETRI_SRC_DISPLAY_PROBE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct DisplayProbe {
    const char *driver;   // SDL's name of the video driver
    const char *variable; // environment variable that names the screen
} DisplayProbe;

// Returns the kinds of screens in the order in which to try them, or NULL after the last.
const DisplayProbe *display_probe_kind(size_t number);
// Returns the name of the screen in the environment, or NULL if there is none.
const char *display_probe_name(const DisplayProbe *screen);
// Returns true if the screen answers within seconds.
bool display_probe_answers(const DisplayProbe *screen);

#endif
