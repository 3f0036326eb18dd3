// window_manager.h: what a window has to know of its screen that SDL does not tell: whether somebody fills the screen
// with a window when SDL asks for it, and that the screen is gone.
#ifndef PETRI_SRC_WINDOW_MANAGER_H
#define PETRI_SRC_WINDOW_MANAGER_H

#include <stdbool.h>

struct SDL_Window;

// False on an X11 screen without a window manager, or with one that knows of no full screen: SDL asks it, is not heard,
// and takes the window to be as large as the screen all the same.
bool window_manager_fills_screen(struct SDL_Window *window);
// From here on the end of an X11 screen does not end the process, as Xlib else would: what is asked of the screen then
// fails, and `*gone` is set, which must live as long as the process.
void window_manager_watch(struct SDL_Window *window, bool *gone);

#endif
