// window_manager.h: what a window has to know of its screen that SDL does not tell: whether somebody fills the screen
// with a window when SDL asks for it, and that the screen is gone.
#ifndef PETRI_SRC_WINDOW_MANAGER_H
#define PETRI_SRC_WINDOW_MANAGER_H

#include <stdbool.h>

struct SDL_Window;

// False on an X11 screen without a window manager, or with one that knows of no full screen: SDL asks it, is not heard,
// and takes the window to be as large as the screen all the same.
bool window_manager_fills_screen(struct SDL_Window *window);
// On X11 `lost` is called, in the midst of whatever SDL does, when the screen has gone: after that nothing can be done
// with it, so it ends the process. Without this Xlib does. `host` is kept until then.
void window_manager_watch(struct SDL_Window *window, void (*lost)(void *host), void *host);

#endif
