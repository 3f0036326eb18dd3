// window_manager.h: whether somebody fills the screen with a window when SDL asks for it.
#ifndef PETRI_SRC_WINDOW_MANAGER_H
#define PETRI_SRC_WINDOW_MANAGER_H

#include <stdbool.h>

struct SDL_Window;

// False on an X11 screen without a window manager, or with one that knows of no full screen: SDL asks it, is not heard,
// and takes the window to be as large as the screen all the same.
bool window_manager_fills_screen(struct SDL_Window *window);

#endif
