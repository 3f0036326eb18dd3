// display_probe.h: finds the screens that environment variables name, and checks whether they can be reached.
//
// If no screen can be reached, SDL falls back to drivers such as an invisible window in memory. If a network does not
// answer, libraries wait for minutes. So petri checks first.
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct DisplayProbe {
    const char *driver;   // SDL's name of the video driver
    const char *variable; // environment variable that names the screen
} DisplayProbe;

// Returns the kind of screen with this index, in the order in which to try them, or NULL after the last.
const DisplayProbe *display_probe_kind(size_t number);
// Returns the name of the screen in the environment, or NULL if there is none.
const char *display_probe_name(const DisplayProbe *screen);
// Returns true if the screen answers within three seconds.
bool display_probe_answers(const DisplayProbe *screen);
