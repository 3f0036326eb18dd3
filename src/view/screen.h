// screen.h: the screens for windows that the environment names, and whether they are there.
//
// SDL takes whatever is left if they are not, such as a window in memory that nobody sees, and the libraries below it
// wait for minutes if a network does not answer. So we ask first.
#ifndef PETRI_SRC_SCREEN_H
#define PETRI_SRC_SCREEN_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Screen {
    const char *driver;   // what SDL calls the way to it
    const char *variable; // of the environment, which names it
} Screen;

// Those that SDL can show windows on, in the order in which to try them; NULL beyond the last.
const Screen *screen_kind(size_t number);
// What the environment calls it; NULL if it names none.
const char *screen_name(const Screen *screen);
// Whether somebody answers there, within seconds.
bool screen_answers(const Screen *screen);

#endif
