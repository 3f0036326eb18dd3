// window.c: the window display, which uses SDL.
#include "cli/cli.h"
#include "cli/memory.h"
#include "petri-live.h"
#include "view/display.h"
#include "view/display_probe.h"
#include "view/overlay.h"
#include "view/window_manager.h"

#include <stdlib.h>
#include <string.h>

// Returns the video driver that SDL_VIDEODRIVER selects, or NULL.
static const char *chosen_driver(void) {
    const char *driver = getenv("SDL_VIDEODRIVER");
    return driver && driver[0] != '\0' ? driver : NULL;
}

bool window_has_screen(void) {
    bool named = chosen_driver();
    for (size_t i = 0; display_probe_kind(i); i++)
        named = named || display_probe_name(display_probe_kind(i));
    return named;
}

#ifdef HAVE_SDL
#include <SDL.h>

// The limits of a window's width and height: at least MIN_SIZE, and at most MAX_SCREEN_FRACTION of the screen.
enum { MIN_SIZE = 64 };
static const double MAX_SCREEN_FRACTION = 0.9;

struct Display {
    Display *first; // owner of the context and of SDL
    Display *next;  // list of further displays, which begins with the first
    SDL_Window *window;
    SDL_GLContext context;  // context in which the painter draws into the window; NULL: `renderer` is used
    SDL_Renderer *renderer; // shows the painter's pixels; NULL: `context` is used
    SDL_Texture *texture;
    int texture_width;
    int texture_height;
    PetriPainter *painter; // borrowed
    bool gone;             // true if the screen was lost; set in the first display
    bool filled;           // true if petri made the window as large as the screen, because no window manager can
    SDL_Rect windowed;     // position and size of the window before it filled the screen
};

// Scales the script's size down to fit on the screen.
static void fit_screen(int *width, int *height) {
    SDL_Rect screen;
    if (SDL_GetDisplayUsableBounds(0, &screen) != 0)
        return;
    double across = screen.w * MAX_SCREEN_FRACTION / *width, down = screen.h * MAX_SCREEN_FRACTION / *height;
    double scale = across < down ? across : down;
    if (scale < 1) {
        *width = (int)(*width * scale);
        *height = (int)(*height * scale);
    }
    *width = *width < MIN_SIZE ? MIN_SIZE : *width;
    *height = *height < MIN_SIZE ? MIN_SIZE : *height;
}

static void window_close(Display *display) {
    if (!display)
        return;
    bool is_first = display->first == display;
    if (display->context && is_first)
        SDL_GL_DeleteContext(display->context);
    if (display->texture)
        SDL_DestroyTexture(display->texture);
    if (display->renderer)
        SDL_DestroyRenderer(display->renderer);
    if (display->window)
        SDL_DestroyWindow(display->window);
    if (is_first)
        SDL_Quit();
    Display **at = &display->first->next;
    while (*at && *at != display)
        at = &(*at)->next;
    if (*at)
        *at = display->next;
    free(display);
}

// Releases SDL's OpenGL context. SDL leaves it current in this thread, which would prevent the use of petri's EGL
// contexts. SDL makes its context current again when it draws.
static void release_context(const Display *display) {
    if (!display->context && SDL_GL_GetCurrentContext())
        SDL_GL_MakeCurrent(display->window, NULL);
}

// Creates a window that is hidden at first, because SDL may replace it when SDL creates the context or renderer.
// The first window is centred. The window manager places the others, so that they do not cover it.
static bool create_window(Display *display, const char *title, int width, int height, Uint32 flags) {
    int place = display->first == display ? (int)SDL_WINDOWPOS_CENTERED : (int)SDL_WINDOWPOS_UNDEFINED;
    display->window = SDL_CreateWindow(title, place, place, width, height,
                                       SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI | SDL_WINDOW_HIDDEN | flags);
    if (display->window)
        SDL_SetWindowMinimumSize(display->window, MIN_SIZE, MIN_SIZE);
    return display->window;
}

// Creates a window with an OpenGL context that the painter uses, so that pictures stay on the graphics card. Returns
// false if this fails or if the user has selected a driver for SDL's renderer.
static bool create_with_gl(Display *display, const char *title, int width, int height) {
    const char *driver = getenv("SDL_RENDER_DRIVER");
    if (driver && driver[0] != '\0')
        return false;
    setenv("EGL_LOG_LEVEL", "fatal", 0); // errors need no messages, because there is a fallback
    SDL_SetHint(SDL_HINT_VIDEO_X11_FORCE_EGL, "1");
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
    SDL_GL_SetAttribute(SDL_GL_RED_SIZE, 8);
    SDL_GL_SetAttribute(SDL_GL_GREEN_SIZE, 8);
    SDL_GL_SetAttribute(SDL_GL_BLUE_SIZE, 8);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
    if (create_window(display, title, width, height, SDL_WINDOW_OPENGL))
        display->context = SDL_GL_CreateContext(display->window);
    if (display->context && petri_painter_use_gl(display->painter) == PETRI_OK) {
        SDL_GL_SetSwapInterval(1);
        return true;
    }
    if (display->context) {
        SDL_GL_DeleteContext(display->context);
        display->context = NULL;
    }
    if (display->window) {
        SDL_DestroyWindow(display->window);
        display->window = NULL;
    }
    return false;
}

// Returns a renderer that copies pixels to the screen. Without a graphics card, it is a software renderer. If
// `synchronises` is true, it waits for the screen after each picture. Only one window may wait, because the waits of
// all windows add up.
static SDL_Renderer *new_renderer(SDL_Window *window, bool synchronises) {
    SDL_Renderer *renderer = SDL_CreateRenderer(window, -1, synchronises ? SDL_RENDERER_PRESENTVSYNC : 0);
    return renderer ? renderer : SDL_CreateRenderer(window, -1, SDL_RENDERER_SOFTWARE);
}

static bool start_on(const DisplayProbe *screen) {
    if (!display_probe_answers(screen)) {
        SDL_SetError("no display server answers at %s=%s", screen->variable, display_probe_name(screen));
        return false;
    }
    if (strcmp(screen->driver, "x11") == 0)
        window_manager_prepare();
    SDL_SetHint(SDL_HINT_VIDEODRIVER, screen->driver);
    return SDL_Init(SDL_INIT_VIDEO) == 0;
}

// Starts SDL only on screens that environment variables name, because other screens are not visible to the user.
static bool start_video(void) {
    const char *driver = chosen_driver();
    bool started = false, tried = false;
    SDL_SetError("neither DISPLAY nor WAYLAND_DISPLAY is set");
    for (size_t i = 0; display_probe_kind(i) && !started; i++) {
        const DisplayProbe *screen = display_probe_kind(i);
        if (display_probe_name(screen) && (!driver || strcmp(driver, screen->driver) == 0)) {
            tried = true;
            started = start_on(screen);
        }
    }
    return started || (!tried && driver && SDL_Init(SDL_INIT_VIDEO) == 0);
}

// Shows a window. If it is not open, writes a message, frees the display and returns NULL.
static Display *show_opened(Display *display, bool open) {
    if (!open) {
        message("cannot open a window: %s", SDL_GetError());
        window_close(display);
        return NULL;
    }
    SDL_ShowWindow(display->window);
    release_context(display);
    return display;
}

static Display *window_open(const char *title, int width, int height, PetriPainter *painter, bool colour) {
    (void)colour;
    Display *display = memory_calloc(sizeof *display);
    display->painter = painter;
    display->first = display;
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    SDL_SetMainReady();
    bool started = start_video(), open = false;
    if (started) {
        fit_screen(&width, &height);
        open = create_with_gl(display, title, width, height);
    }
    if (started && !open && create_window(display, title, width, height, 0)) {
        display->renderer = new_renderer(display->window, true);
        open = display->renderer;
    }
    display = show_opened(display, open);
    if (display)
        window_manager_watch(display->window, &display->gone);
    return display;
}

static Display *window_open_another(Display *first, const char *title, int width, int height) {
    Display *display = memory_calloc(sizeof *display);
    *display = (Display){.first = first, .painter = first->painter, .context = first->context};
    fit_screen(&width, &height);
    bool open = create_window(display, title, width, height, first->context ? SDL_WINDOW_OPENGL : 0);
    if (open && !first->context) {
        display->renderer = new_renderer(display->window, false);
        open = display->renderer;
    }
    display = show_opened(display, open);
    if (display) {
        display->next = first->next;
        first->next = display;
    }
    return display;
}

static void window_hide(Display *display) {
    SDL_HideWindow(display->window);
}

// Returns the name of a key. For keys that type no character, SDL's codes contain the keyboard's scancodes.
static const char *key_name(SDL_Keycode code) {
    static const char *const keys[] = {
        "caps_lock", "f1",   "f2",         "f3",        "f4",          "f5",           "f6",          "f7",
        "f8",        "f9",   "f10",        "f11",       "f12",         "print_screen", "scroll_lock", "pause",
        "insert",    "home", "page_up",    "delete",    "end",         "page_down",    "right",       "left",
        "down",      "up",   "num_lock",   "kp_divide", "kp_multiply", "kp_subtract",  "kp_add",      "kp_enter",
        "kp_1",      "kp_2", "kp_3",       "kp_4",      "kp_5",        "kp_6",         "kp_7",        "kp_8",
        "kp_9",      "kp_0", "kp_decimal", NULL,        "menu",        NULL,           "kp_equal",
    };
    static const char *const modifiers[] = {"left_control",  "left_shift",  "left_alt",  "left_super",
                                            "right_control", "right_shift", "right_alt", "right_super"};
    const SDL_Keycode first = SDLK_CAPSLOCK, first_modifier = SDLK_LCTRL;
    if (code == SDLK_DELETE)
        return "delete";
    if (code >= first_modifier && code <= SDLK_RGUI)
        return modifiers[code - first_modifier];
    if (code >= first && code <= SDLK_KP_EQUALS)
        return keys[code - first];
    return code > 0 && code < 127 ? key_of_character((char)code) : NULL;
}

static void output_size(const Display *display, int *width, int *height) {
    if (display->context)
        SDL_GL_GetDrawableSize(display->window, width, height);
    else if (SDL_GetRendererOutputSize(display->renderer, width, height) != 0)
        *width = *height = MIN_SIZE;
}

// Sets *across and *down to the number of pixels per unit of the window's width and height. They are more than 1 on
// high-density screens.
static void density(const Display *display, double *across, double *down) {
    int width = 1, height = 1, pixels_across = 1, pixels_down = 1;
    SDL_GetWindowSize(display->window, &width, &height);
    output_size(display, &pixels_across, &pixels_down);
    *across = width > 0 ? (double)pixels_across / width : 1;
    *down = height > 0 ? (double)pixels_down / height : 1;
}

static unsigned button_bit(int button) {
    switch (button) {
    case SDL_BUTTON_LEFT:
        return PETRI_BUTTON_LEFT;
    case SDL_BUTTON_MIDDLE:
        return PETRI_BUTTON_MIDDLE;
    case SDL_BUTTON_RIGHT:
        return PETRI_BUTTON_RIGHT;
    default:
        return button > 3 && button <= 8 ? 1U << (button - 1) : 0;
    }
}

static Event pointer_event(const Display *display, int x, int y, unsigned state) {
    Event event = {.kind = EVENT_POINTER, .inside = true};
    double across, down;
    density(display, &across, &down);
    event.x = (x + 0.5) * across;
    event.y = (y + 0.5) * down;
    for (int button = 1; button <= 8; button++)
        event.buttons |= state & SDL_BUTTON(button) ? button_bit(button) : 0;
    return event;
}

static Event window_event(const SDL_WindowEvent *event) {
    switch (event->event) {
    case SDL_WINDOWEVENT_CLOSE:
        return (Event){.kind = EVENT_CLOSE};
    case SDL_WINDOWEVENT_EXPOSED:
    case SDL_WINDOWEVENT_SIZE_CHANGED:
        return (Event){.kind = EVENT_REDRAW};
    case SDL_WINDOWEVENT_FOCUS_LOST:
        return (Event){.kind = EVENT_FOCUS_LOST};
    case SDL_WINDOWEVENT_LEAVE:
        return (Event){.kind = EVENT_POINTER};
    default:
        return (Event){.kind = EVENT_NONE};
    }
}

// On Wayland, a quit event means that the server was lost. If the user closes the window, a window event arrives first.
static Event quit_event(Display *display) {
    const char *driver = SDL_GetCurrentVideoDriver();
    display->gone = driver && strcmp(driver, "wayland") == 0;
    return (Event){.kind = display->gone ? EVENT_NONE : EVENT_CLOSE};
}

// Returns the display that an event belongs to, or the first if it belongs to none.
static Display *display_of(Display *first, const SDL_Event *event) {
    Uint32 id = event->type == SDL_WINDOWEVENT                                           ? event->window.windowID
                : event->type == SDL_KEYDOWN || event->type == SDL_KEYUP                 ? event->key.windowID
                : event->type == SDL_MOUSEMOTION                                         ? event->motion.windowID
                : event->type == SDL_MOUSEBUTTONDOWN || event->type == SDL_MOUSEBUTTONUP ? event->button.windowID
                                                                                         : 0;
    const SDL_Window *window = SDL_GetWindowFromID(id);
    for (Display *display = first->next; display; display = display->next)
        if (display->window == window)
            return display;
    return first;
}

static Event translate_event(Display *display, const SDL_Event *event) {
    switch (event->type) {
    case SDL_QUIT:
        return quit_event(display->first);
    case SDL_WINDOWEVENT:
        return window_event(&event->window);
    case SDL_KEYDOWN:
    case SDL_KEYUP:
        return (Event){.kind = EVENT_KEY,
                       .key = key_name(event->key.keysym.sym),
                       .pressed = event->type == SDL_KEYDOWN,
                       .repeated = event->key.repeat != 0,
                       .control = (event->key.keysym.mod & KMOD_CTRL) != 0};
    case SDL_MOUSEMOTION:
        return pointer_event(display, event->motion.x, event->motion.y, event->motion.state);
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP: {
        // Set the button of this event explicitly, because SDL's state may already include later events.
        unsigned bit = button_bit(event->button.button);
        Event pointer = pointer_event(display, event->button.x, event->button.y, SDL_GetMouseState(NULL, NULL));
        pointer.buttons = event->type == SDL_MOUSEBUTTONDOWN ? pointer.buttons | bit : pointer.buttons & ~bit;
        return pointer;
    }
    default:
        return (Event){.kind = EVENT_NONE};
    }
}

// Waits only for the first event. If that event is ignored, returns the next one only if it has already arrived.
static Event window_next_event(Display *display, double seconds) {
    SDL_Event found;
    int wait = (int)(seconds * 1000);
    Event event = {.kind = EVENT_NONE};
    while (event.kind == EVENT_NONE && !display->gone &&
           (wait > 0 ? SDL_WaitEventTimeout(&found, wait) : SDL_PollEvent(&found))) {
        Display *source = display_of(display, &found);
        event = translate_event(source, &found);
        event.display = source;
        wait = 0;
    }
    release_context(display);
    return event;
}

static void window_size(Display *display, int width, int height, int *drawn_width, int *drawn_height) {
    (void)width; // the picture is centred in the window, so its size is not needed
    (void)height;
    output_size(display, drawn_width, drawn_height);
    release_context(display);
}

static double window_scale(const Display *display) {
    double across, down;
    density(display, &across, &down);
    release_context(display);
    return across;
}

// Returns false if the screen was lost. Without this check, Mesa's software renderer (22.3) would loop forever: after
// an error of the connection, it computes from a maximum request length of 0 how many rows of pixels to send at once.
static bool can_show(Display *display) {
    if (window_manager_is_lost(display->window))
        display->first->gone = true;
    return !display->first->gone;
}

static bool use_texture(Display *display, int width, int height) {
    if (display->texture && display->texture_width == width && display->texture_height == height)
        return true;
    if (display->texture)
        SDL_DestroyTexture(display->texture);
    display->texture =
        SDL_CreateTexture(display->renderer, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STREAMING, width, height);
    display->texture_width = width;
    display->texture_height = height;
    return display->texture;
}

static bool window_show_directly(Display *display, PetriPicture *picture, const Overlay *overlay, PetriStatus *status) {
    if (!display->context)
        return false;
    double across, down;
    int width = 0, height = 0;
    density(display, &across, &down);
    output_size(display, &width, &height);
    bool is_first = display->first == display;
    if (!is_first) {
        SDL_GL_MakeCurrent(display->window, display->context);
        SDL_GL_SetSwapInterval(0); // only the first window waits for the screen, because the waits would add up
    }
    *status = overlay_show(display->painter, picture, overlay, across, width, height);
    if (can_show(display))
        SDL_GL_SwapWindow(display->window);
    if (!is_first)
        SDL_GL_MakeCurrent(display->first->window, display->context);
    return true;
}

static bool window_show(Display *display, uint32_t *pixels, int width, int height, const Overlay *overlay) {
    double across, down;
    density(display, &across, &down);
    overlay_draw(display->painter, overlay, across, pixels, width, height);
    if (!use_texture(display, width, height) || SDL_UpdateTexture(display->texture, NULL, pixels, width * 4) != 0) {
        message("cannot show the picture: %s", SDL_GetError());
        return false;
    }
    SDL_SetTextureBlendMode(display->texture, SDL_BLENDMODE_NONE);
    SDL_RenderClear(display->renderer);
    SDL_RenderCopy(display->renderer, display->texture, NULL, NULL);
    if (can_show(display))
        SDL_RenderPresent(display->renderer);
    release_context(display);
    return true;
}

static void window_set_title(Display *display, const char *title) {
    SDL_SetWindowTitle(display->window, title);
}

static void window_resize(Display *display, int width, int height) {
    if (!display->filled &&
        (SDL_GetWindowFlags(display->window) & (SDL_WINDOW_FULLSCREEN | SDL_WINDOW_MAXIMIZED)) == 0) {
        fit_screen(&width, &height);
        SDL_SetWindowSize(display->window, width, height);
    }
}

// Fills the screen by changing the window's position and size. Without a window manager, a window gets what it
// requests.
static void fill_screen(Display *display) {
    SDL_Rect screen, *windowed = &display->windowed;
    int number = SDL_GetWindowDisplayIndex(display->window);
    if (SDL_GetDisplayBounds(number < 0 ? 0 : number, &screen) != 0)
        return;
    SDL_GetWindowPosition(display->window, &windowed->x, &windowed->y);
    SDL_GetWindowSize(display->window, &windowed->w, &windowed->h);
    SDL_SetWindowPosition(display->window, screen.x, screen.y);
    SDL_SetWindowSize(display->window, screen.w, screen.h);
    display->filled = true;
}

static bool window_move_to_screen(Display *display, int screen) {
    int count = SDL_GetNumVideoDisplays();
    if (screen >= count) {
        message("no such screen: %d; the last one is %d", screen, count - 1);
        return false;
    }
    SDL_SetWindowPosition(display->window, SDL_WINDOWPOS_CENTERED_DISPLAY(screen),
                          SDL_WINDOWPOS_CENTERED_DISPLAY(screen));
    return true;
}

static void window_toggle_full_screen(Display *display) {
    bool full = (SDL_GetWindowFlags(display->window) & SDL_WINDOW_FULLSCREEN) != 0;
    if (display->filled) {
        SDL_SetWindowSize(display->window, display->windowed.w, display->windowed.h);
        SDL_SetWindowPosition(display->window, display->windowed.x, display->windowed.y);
        display->filled = false;
    } else if (!full && !window_manager_fills_screen(display->window)) {
        fill_screen(display);
    } else {
        SDL_SetWindowFullscreen(display->window, full ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
    }
}

static bool window_gone(const Display *display) {
    return display->gone;
}

static const DisplayKind WINDOW = {
    .open = window_open,
    .open_another = window_open_another,
    .close = window_close,
    .hide = window_hide,
    .next_event = window_next_event,
    .size = window_size,
    .scale = window_scale,
    .show_directly = window_show_directly,
    .show = window_show,
    .set_title = window_set_title,
    .resize = window_resize,
    .move_to_screen = window_move_to_screen,
    .toggle_full_screen = window_toggle_full_screen,
    .gone = window_gone,
    .min_seconds = 0,
    .logs = true,
};

const DisplayKind *window_display(void) {
    return &WINDOW;
}
#else
const DisplayKind *window_display(void) {
    return NULL;
}
#endif
