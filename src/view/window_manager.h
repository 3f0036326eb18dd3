// window_manager.h: X11 functions that SDL lacks: whether full screen is supported, and surviving the loss of the
// screen.
#pragma once

#include <stdbool.h>

struct SDL_Window;

// Prevents Xlib from terminating the process when an event is sent to a closed window of an X11 screen. To be called
// before SDL starts, because SDL restores the earlier error handler before it closes its connections.
void window_manager_prepare(void);
// Returns true if a request for full screen has an effect: always, except on an X11 screen without a window manager
// that supports full screen. SDL does not notice that such a screen ignores the request.
bool window_manager_fills_screen(struct SDL_Window *window);
// Prevents Xlib from terminating the process when an X11 screen is lost. Instead, requests to the screen fail and
// `*gone` is set. `gone` must remain valid until the process ends.
void window_manager_watch(struct SDL_Window *window, bool *gone);
// Returns true if the X server has closed the connection, even if Xlib has not noticed it yet.
bool window_manager_is_lost(struct SDL_Window *window);
