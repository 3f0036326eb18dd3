// window_manager.c: see window_manager.h.
//
// If SDL uses another driver, full screen counts as supported and the screen is never lost.
#include "view/window_manager.h"

#ifdef HAVE_SDL
#include <SDL.h>
#include <SDL_syswm.h>

#ifdef SDL_VIDEO_DRIVER_X11
#include <X11/Xatom.h>
#include <X11/Xproto.h>
#include <poll.h>

// The library is not linked, because that would slow down every start of petri. SDL also loads it at run time.
static const char LIBRARY[] = "libX11.so.6";

typedef struct X11 {
    Status (*get_attributes)(Display *, Window, XWindowAttributes *);
    Atom (*intern)(Display *, const char *, Bool);
    int (*get_property)(Display *, Window, Atom, long, long, Bool, Atom, Atom *, int *, unsigned long *,
                        unsigned long *, unsigned char **);
    int (*release)(void *);
} X11;

static bool find_symbol(void *library, const char *name, void *function) {
    void *address = SDL_LoadFunction(library, name);
    SDL_memcpy(function, &address, sizeof address);
    return address;
}

static bool find_symbols(void *library, X11 *x11) {
    return library && find_symbol(library, "XGetWindowAttributes", &x11->get_attributes) &&
           find_symbol(library, "XInternAtom", &x11->intern) &&
           find_symbol(library, "XGetWindowProperty", &x11->get_property) &&
           find_symbol(library, "XFree", &x11->release);
}

// Returns the connection of a window to the X server, or NULL if SDL uses another driver.
static Display *connection_of(SDL_Window *window) {
    SDL_SysWMinfo info;
    SDL_VERSION(&info.version);
    return SDL_GetWindowWMInfo(window, &info) && info.subsystem == SDL_SYSWM_X11 ? info.info.x11.display : NULL;
}

// Returns true if there is a window manager: a client to which X11 redirects requests to change top-level windows.
static bool is_managed(const X11 *x11, Display *display, Window root) {
    XWindowAttributes attributes;
    return x11->get_attributes(display, root, &attributes) != 0 &&
           (attributes.all_event_masks & SubstructureRedirectMask) != 0;
}

static bool knows_full_screen(const X11 *x11, Display *display, Window root) {
    enum { MAX_ATOMS = 4096 };
    Atom supported = x11->intern(display, "_NET_SUPPORTED", True), type;
    Atom wanted = x11->intern(display, "_NET_WM_STATE_FULLSCREEN", True);
    int bits = 0;
    unsigned long count = 0, left = 0;
    unsigned char *data = NULL;
    bool known = false;
    if (supported == None || wanted == None ||
        x11->get_property(display, root, supported, 0, MAX_ATOMS, False, XA_ATOM, &type, &bits, &count, &left, &data) !=
            Success)
        return false;
    for (unsigned long i = 0; bits == 32 && i < count; i++) { // 32-bit values of the protocol, stored as longs
        Atom one;
        SDL_memcpy(&one, data + i * sizeof one, sizeof one);
        known = known || one == wanted;
    }
    if (data)
        x11->release(data);
    return known;
}

bool window_manager_fills_screen(struct SDL_Window *window) {
    Display *display = connection_of(window);
    X11 x11;
    if (!display)
        return true;
    void *library = SDL_LoadObject(LIBRARY);
    bool fills = true;
    if (find_symbols(library, &x11)) {
        Window root = DefaultRootWindow(display);
        fills = is_managed(&x11, display, root) && knows_full_screen(&x11, display, root);
    }
    if (library)
        SDL_UnloadObject(library);
    return fills;
}

static int (*next_handler)(Display *, XErrorEvent *); // Xlib has one error handler for the whole process

// When SDL waits, it wakes itself by an event that it sends to its window over another connection. If that event
// arrives after the window is destroyed, the server reports an error, which would end the process.
static int ignore_late_event(Display *display, XErrorEvent *error) {
    if (error->error_code == BadWindow && error->request_code == X_SendEvent)
        return 0;
    return next_handler(display, error);
}

void window_manager_prepare(void) {
    int (*(*set_error)(int (*)(Display *, XErrorEvent *)))(Display *, XErrorEvent *);
    void *library = SDL_LoadObject(LIBRARY); // never unloaded, because the handler must stay
    if (library && !next_handler && find_symbol(library, "XSetErrorHandler", &set_error))
        next_handler = set_error(ignore_late_event);
}

static int ignore_io_error(Display *display) {
    (void)display;
    return 0;
}

// Called by Xlib after an I/O error. After it has returned, calls of Xlib fail, but the process does not end.
static void note_loss(Display *display, void *gone) {
    (void)display;
    *(bool *)gone = true;
}

void window_manager_watch(struct SDL_Window *window, bool *gone) {
    Display *display = connection_of(window);
    int (*(*set_error)(int (*)(Display *)))(Display *);
    void (*set_exit)(Display *, void (*)(Display *, void *), void *);
    if (!display)
        return;
    void *library = SDL_LoadObject(LIBRARY); // never unloaded, because SDL also uses it
    if (library && find_symbol(library, "XSetIOErrorHandler", &set_error) &&
        find_symbol(library, "XSetIOErrorExitHandler", &set_exit)) { // available since libX11 1.7
        set_error(ignore_io_error);
        set_exit(display, note_loss, gone);
    }
}

bool window_manager_is_lost(struct SDL_Window *window) {
    Display *display = connection_of(window);
    if (!display)
        return false;
    struct pollfd connection = {.fd = ConnectionNumber(display)};
    return poll(&connection, 1, 0) > 0; // only errors and the end of the connection count
}
#else
void window_manager_prepare(void) {
}

bool window_manager_fills_screen(struct SDL_Window *window) {
    (void)window;
    return true;
}

void window_manager_watch(struct SDL_Window *window, bool *gone) {
    (void)window;
    (void)gone;
}

bool window_manager_is_lost(struct SDL_Window *window) {
    (void)window;
    return false;
}
#endif
#endif
