// window_manager.h: X11 functions that SDL lacks: whether full screen is supported, and surviving the loss of the
// screen.
#ifndef PETRI_SRC_WINDOW_MANAGER_H
#define PETRI_SRC_WINDOW_MANAGER_H

#include <stdbool.h>

struct SDL_Window;

// Returns false on an X11 screen without a window manager or whose window manager does not support full screen. SDL's
// request is ignored there, but SDL assumes that the window fills the screen.
bool window_manager_fills_screen(struct SDL_Window *window);
// Prevents the loss of an X11 screen from ending the process, which is Xlib's default. Requests to the screen then
// fail, and `*gone` is set. `gone` must live as long as the process.
void window_manager_watch(struct SDL_Window *window, bool *gone);

#endif
