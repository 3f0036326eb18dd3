// view.c: `petri view`: a script's picture, live: the loop between a world (view_world.h) and a display (display.h).
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "display.h"
#include "hints.h"
#include "progress.h"
#include "view_parameters.h"
#include "view_world.h"

// Seconds: the longest sleep (a saved script is seen after at most that); how long a notice stays; between two measures
// of the frame rate, and between two saves of the state.
static const double LONGEST_SLEEP = 0.05, NOTICE = 4, MEASURE = 0.5, BETWEEN_SAVES = 5;
enum { MOST_EVENTS = 256, DEFAULT_SIZE = 512 };

// A signal handler can reach nothing but a global.
static volatile sig_atomic_t interrupted;

static void on_interrupt(int number) {
    interrupted = number;
}

// The first of these closes the view with all that belongs to it; a second one ends the process.
static void catch_interrupts(void) {
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        sigaction(numbers[i], &action, NULL);
    }
}

typedef struct View {
    const Host *host;
    World world;
    const DisplayKind *kind;
    Display *display;
    Overlay overlay;
    bool paused;
    bool step_once;
    bool shows_status;
    bool shows_warnings;
    bool redraw;
    bool closing;
    bool broken; // the display, or memory for it, is gone
    double start;
    double drawn; // when the picture was drawn last
    double saved;
    double notice_ends; // INFINITY: it stays
    // The frame rate
    double measured;
    int64_t measured_frames;
    double rate;
    // Pixels of the display
    uint32_t *pixels;
    size_t pixel_count;
    // The script's size and title as the display knows them
    int width;
    int height;
    char title[300];
    Event pointer; // the last that moved
    ParameterKeys parameters;
} View;

static void set_notice(View *view, const char *text, double ends) {
    view->redraw = overlay_set(view->overlay.notice, sizeof view->overlay.notice, text) || view->redraw;
    view->notice_ends = ends;
}

__attribute__((format(printf, 2, 3))) static void notice(View *view, const char *format, ...) {
    char text[sizeof view->overlay.notice];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    set_notice(view, text, clock_seconds() + NOTICE);
}

// What is shown when there is nothing to tell.
static void settle_notice(View *view) {
    set_notice(view, view->paused ? "paused: space goes on, . steps" : "", INFINITY);
}

// What stops the script comes first; warnings are listed if that is wanted, else a mark tells that there are some.
static void update_trouble(View *view) {
    Overlay *overlay = &view->overlay;
    const char *trouble = world_trouble(&view->world);
    char text[sizeof overlay->trouble] = "", mark[sizeof overlay->mark] = "";
    overlay->mild = trouble[0] == '\0';
    if (overlay->mild && view->shows_warnings) {
        warnings_list(&view->world.warnings, text, sizeof text);
    } else if (overlay->mild) {
        warnings_mark(&view->world.warnings, mark, sizeof mark);
    }
    bool changed = overlay_set(overlay->trouble, sizeof overlay->trouble, overlay->mild ? text : trouble);
    changed = overlay_set(overlay->mark, sizeof overlay->mark, mark) || changed;
    view->redraw = changed || view->redraw;
}

static void add_parameters(View *view, char *text, size_t size) {
    Bytes more = {0};
    size_t length = strlen(text);
    parameter_status(&view->parameters, &view->world, &more);
    snprintf(text + length, size - length, "%s", more.length == 0 ? "" : more.data);
    bytes_free(&more);
}

static void update_status(View *view) {
    char text[sizeof view->overlay.status] = "";
    if (view->shows_status) {
        PetriFrame frame = petri_frame(view->world.session);
        double seconds = frame.beat * 60 / frame.tempo;
        snprintf(text, sizeof text,
                 "%.1f fps  frame %" PRId64 "  %d:%05.2f  beat %.2f\n"
                 "script %.2f ms  physics %.2f ms  steps %" PRIu64 "\n"
                 "space pause  . step  r reset  f full screen\n"
                 "s screenshot  w warnings  h this  q quit",
                 view->rate, frame.number, (int)(seconds / 60), fmod(seconds, 60), frame.beat,
                 frame.evaluation_seconds * 1e3, frame.physics_seconds * 1e3, frame.physics_steps);
        add_parameters(view, text, sizeof text);
    }
    view->redraw = overlay_set(view->overlay.status, sizeof view->overlay.status, text) || view->redraw;
}

// Twice a second is as much as can be read; while paused the numbers are those of the frame that is seen.
static void measure_rate(View *view) {
    double now = clock_seconds(), passed = now - view->measured;
    if (passed < MEASURE) {
        return;
    }
    view->rate = (double)(view->world.frames - view->measured_frames) / passed;
    view->measured = now;
    view->measured_frames = view->world.frames;
    update_status(view);
}

// The window's size and title, of which the script may change its mind at any time.
static void follow_script(View *view) {
    int width = DEFAULT_SIZE, height = DEFAULT_SIZE;
    const char *title = view->world.options.script;
    if (view->world.picture != NULL) {
        petri_picture_size(view->world.picture, &width, &height);
        const char *own = petri_picture_title(view->world.picture);
        title = own[0] != '\0' ? own : title;
    }
    bool resized = width != view->width || height != view->height;
    view->width = width;
    view->height = height;
    bool renamed = overlay_set(view->title, sizeof view->title, title);
    if (view->display != NULL && resized) {
        view->kind->resize(view->display, width, height);
    }
    if (view->display != NULL && renamed) {
        view->kind->set_title(view->display, view->title);
    }
}

static void step(View *view) {
    world_step(&view->world);
    view->step_once = view->paused && view->world.early; // what is not seen is no step
    follow_script(view);
    update_trouble(view);
    if (view->paused) {
        update_status(view);
    }
    view->redraw = true;
    if (clock_seconds() - view->saved > BETWEEN_SAVES) {
        world_save(&view->world);
        view->saved = clock_seconds();
    }
}

static bool at_end(const View *view) {
    const RunOptions *options = &view->world.options;
    if (view->world.frames >= options->frames) {
        return true;
    }
    if (isnan(options->run_time)) {
        return false;
    }
    double fps = petri_frame(view->world.session).fps;
    double time = options->realtime ? clock_seconds() - view->start : (double)view->world.frames / fps;
    return time >= options->run_time;
}

static bool may_step(const View *view) {
    return !view->world.halted && (!view->paused || view->step_once);
}

// Seconds until something is to be done: a step, a picture, the end of a notice.
static double idle_seconds(const View *view) {
    double now = clock_seconds(), idle = LONGEST_SLEEP;
    if (may_step(view)) {
        idle = fmin(idle, view->step_once ? 0 : petri_due(view->world.session));
    }
    if (view->redraw) {
        idle = fmin(idle, view->drawn + view->kind->least_seconds - now);
    }
    return fmax(0, fmin(idle, view->notice_ends - now));
}

// The pixels that the picture takes in the middle of the display's.
static void picture_area(const View *view, double *left, double *top, double *width, double *height) {
    int across, down;
    view->kind->size(view->display, view->width, view->height, &across, &down);
    double scale = fmin((double)across / view->width, (double)down / view->height);
    *width = view->width * scale;
    *height = view->height * scale;
    *left = (across - *width) / 2;
    *top = (down - *height) / 2;
}

static void report_pointer(View *view, const Event *event) {
    double left, top, width, height;
    picture_area(view, &left, &top, &width, &height);
    PetriPointer pointer = {.x = (event->x - left) / width, .y = (event->y - top) / height, .buttons = event->buttons};
    pointer.inside = event->inside && pointer.x >= 0 && pointer.x <= 1 && pointer.y >= 0 && pointer.y <= 1;
    petri_pointer(view->world.session, &pointer);
}

static void set_paused(View *view, bool paused) {
    view->paused = paused;
    petri_hold(view->world.session);
    settle_notice(view);
    update_status(view);
}

static void take_screenshot(View *view) {
    char name[300];
    if (world_screenshot(&view->world, name, sizeof name)) {
        notice(view, "saved %s", name);
    } else {
        notice(view, "cannot save %s", name);
        view->world.failed = true;
    }
    if (view->kind->logs) {
        message("%s", view->overlay.notice);
    }
}

static void reset(View *view) {
    world_reset(&view->world);
    view->step_once = true; // so that the first frame is seen even while paused
    update_trouble(view);
    notice(view, "reset");
}

// Keys for the script's parameters; what they do is seen at once.
static void change_parameters(View *view, const char *key) {
    Bytes text = {0};
    ParameterAct act = parameter_key(&view->parameters, &view->world, key, &text);
    if (act != PARAMETER_OTHER) {
        notice(view, "%s", text.data);
        update_status(view);
    }
    if (act == PARAMETER_CHANGES) {
        view->step_once = view->step_once || view->paused;
        update_trouble(view);
    }
    bytes_free(&text);
}

static void obey(View *view, const char *key) {
    if (strcmp(key, "q") == 0 || strcmp(key, "escape") == 0) {
        view->closing = true;
    } else if (strcmp(key, "space") == 0) {
        set_paused(view, !view->paused);
    } else if (strcmp(key, "period") == 0) {
        set_paused(view, true);
        view->step_once = true;
    } else if (strcmp(key, "r") == 0) {
        reset(view);
    } else if (strcmp(key, "f") == 0) {
        view->kind->toggle_full_screen(view->display);
        view->redraw = true;
    } else if (strcmp(key, "s") == 0) {
        take_screenshot(view);
    } else if (strcmp(key, "w") == 0) {
        view->shows_warnings = !view->shows_warnings;
        update_trouble(view);
    } else if (strcmp(key, "h") == 0) {
        view->shows_status = !view->shows_status;
        update_status(view);
    } else {
        change_parameters(view, key);
    }
}

// A key that the script asks for is the script's, unless it is pressed with Control.
static void take_key(View *view, const Event *event) {
    if (event->key == NULL) {
        return;
    }
    bool pressed = event->kind == EVENT_TAP || event->pressed;
    bool repeated = event->again && !parameter_key_repeats(event->key);
    if (pressed && !repeated && (event->control || !petri_key_bound(view->world.session, event->key))) {
        obey(view, event->key);
    }
    petri_key(view->world.session, event->key, pressed);
    if (event->kind == EVENT_TAP) {
        petri_key(view->world.session, event->key, false);
    }
}

static void take_event(View *view, const Event *event) {
    switch (event->kind) {
    case EVENT_CLOSE:
        view->closing = true;
        break;
    case EVENT_KEY:
    case EVENT_TAP:
        take_key(view, event);
        break;
    case EVENT_POINTER:
        view->pointer = *event;
        report_pointer(view, event);
        break;
    case EVENT_AWAY:
        petri_pointer(view->world.session, NULL);
        break;
    case EVENT_REDRAW:
        view->redraw = true;
        break;
    case EVENT_NONE:
        break;
    }
}

static void take_events(View *view) {
    Event event = view->kind->next_event(view->display, idle_seconds(view));
    for (int i = 0; event.kind != EVENT_NONE && !view->closing && i < MOST_EVENTS; i++) {
        take_event(view, &event);
        event = view->kind->next_event(view->display, 0);
    }
}

static bool use_pixels(View *view, size_t count) {
    if (count > view->pixel_count) {
        free(view->pixels);
        view->pixels = memory_zeroed(count * sizeof *view->pixels);
        view->pixel_count = count;
    }
    return view->pixels != NULL;
}

static void blacken(uint32_t *pixels, size_t count) {
    for (size_t i = 0; i < count; i++) {
        pixels[i] = 0xFF000000;
    }
}

// What shines through a picture without a window is black.
static void make_opaque(uint32_t *pixels, size_t count) {
    for (size_t i = 0; i < count; i++) {
        pixels[i] |= 0xFF000000;
    }
}

static void draw(View *view) {
    int width, height;
    view->kind->size(view->display, view->width, view->height, &width, &height);
    size_t count = (size_t)width * (size_t)height;
    if (count == 0 || !use_pixels(view, count)) {
        return;
    }
    PetriStatus status = PETRI_INVALID;
    if (view->world.picture != NULL && !view->world.unseen) {
        status = petri_picture_draw(view->world.picture, view->world.painter, view->pixels, width, height,
                                    (size_t)width * sizeof *view->pixels);
        petri_picture_tell(view->world.session, view->world.picture);
        update_trouble(view); // what drawing has found wrong
    }
    if (status == PETRI_OK) {
        make_opaque(view->pixels, count);
    } else {
        blacken(view->pixels, count);
    }
    view->broken = !view->kind->show(view->display, view->pixels, width, height, &view->overlay);
    view->redraw = false;
    view->drawn = clock_seconds();
}

static void take_changes(View *view) {
    if (!world_reload(&view->world)) {
        return;
    }
    if (world_trouble(&view->world)[0] == '\0') {
        notice(view, "loaded the changed script");
        view->step_once = view->paused; // so that the change is seen
    }
    update_trouble(view);
}

static void run_loop(View *view) {
    while (!view->closing && !view->broken && !interrupted && !at_end(view)) {
        take_events(view);
        take_changes(view);
        if (clock_seconds() >= view->notice_ends) {
            settle_notice(view);
        }
        if (may_step(view) && (view->step_once || petri_due(view->world.session) <= 0)) {
            if (view->paused) {
                petri_hold(view->world.session);
            }
            step(view);
        }
        // A run that is to end by itself ends when nothing more can come.
        if (view->world.halted && (view->world.options.frames < INT64_MAX || !isnan(view->world.options.run_time))) {
            return;
        }
        measure_rate(view);
        if (view->redraw && clock_seconds() - view->drawn >= view->kind->least_seconds) {
            draw(view);
        }
    }
}

// A window if there is a screen for it, else the terminal.
static bool open_display(View *view) {
    const RunOptions *options = &view->world.options;
    bool window = !options->terminal && window_display() != NULL && window_has_screen();
    if (!window && terminal_display() == NULL) {
        message(options->terminal || window_display() != NULL
                    ? "this petri was built without libchafa, so it shows no pictures in terminals"
                    : "this petri was built without SDL and libchafa, so it has no way to show pictures");
        return false;
    }
    view->kind = window ? window_display() : terminal_display();
    view->world.mute = !window && isatty(STDERR_FILENO);
    view->display = view->kind->open(view->title, view->width, view->height, !options->monochrome);
    if (view->display == NULL && window && terminal_display() != NULL && isatty(STDOUT_FILENO)) {
        view->kind = terminal_display();
        view->world.mute = isatty(STDERR_FILENO);
        view->display = view->kind->open(view->title, view->width, view->height, !options->monochrome);
    }
    return view->display != NULL;
}

// To a person who watches, as the other commands do; on the screen that is there again after the pictures.
static void report_summary(const View *view) {
    Verbosity verbosity = view->world.options.verbosity;
    double seconds = clock_seconds() - view->start;
    if (verbosity >= LOG_VERBOSE || (verbosity == LOG_NORMAL && isatty(STDERR_FILENO))) {
        message("%" PRId64 " frame%s in %.3f s (%.1f frames/s)", view->world.frames, view->world.frames == 1 ? "" : "s",
                seconds, seconds > 0 ? (double)view->world.frames / seconds : 0);
    }
    if (view->world.options.terminal && verbosity == LOG_VERBOSE) {
        hint_pictures(view->host, view->world.options.script);
    } else if (window_has_screen() && window_display() == NULL && verbosity >= LOG_NORMAL) {
        message("it was shown in the terminal, for this petri was built without SDL; './dev build' adds windows");
    }
}

static int run_view(View *view) {
    view->start = view->saved = view->measured = clock_seconds();
    view->notice_ends = INFINITY;
    view->redraw = true;
    if (view->world.options.frames > 0) {
        step(view); // before anything opens: it tells the size
    }
    follow_script(view);
    catch_interrupts();
    bool opened = open_display(view);
    if (opened) {
        petri_pointer(view->world.session, &(PetriPointer){.inside = false});
        petri_hold(view->world.session);
        run_loop(view);
        view->kind->close(view->display);
    }
    world_unmute(&view->world);
    if (!opened) {
        return STATUS_FAILED;
    }
    if (!view->world.halted) {
        world_save(&view->world);
    }
    report_summary(view);
    bool failed = view->world.halted || view->world.failed || view->broken;
    return interrupted ? STATUS_SIGNAL + interrupted : failed ? STATUS_FAILED : STATUS_DONE;
}

static int view_run(const Host *host, int argc, char **argv) {
    View *view = memory_zeroed(sizeof *view);
    view->host = host;
    int status = run_options_read(&view->world.options, &VIEW_COMMAND, argc, argv);
    if (status == RUN_OPTIONS_OK) {
        status = world_open(&view->world, host);
        if (status == RUN_OPTIONS_OK) {
            status = run_view(view);
        }
        world_close(&view->world);
    }
    run_options_free(&view->world.options);
    free(view->pixels);
    free(view);
    return status;
}

const Command VIEW_COMMAND = {
    .name = "view",
    .live = true,
    .operands = "SCRIPT.fl",
    .summary = "show a script's picture as it runs, in a window or in the terminal",
    .details =
        "Shows what a script draws, or its particles, as it runs: in a window, or in the terminal where there is no\n"
        "display. Saving the script loads it anew and keeps its state; while it has mistakes they are shown, and the\n"
        "last good version goes on.\n"
        "\n"
        "Keys: space pauses, . makes one step, r starts anew, f fills the screen, s saves the picture, h shows frame\n"
        "rate and clocks, w lists warnings, whose number a corner shows, q or Escape quits. Tab or ] and [ choose a\n"
        "parameter of the script (petri help run), up and down or + and - change it (page up and down: ten steps), 0\n"
        "or backspace sets its default. Those that the script asks for by !key are the script's; with Control they\n"
        "have the meaning above.",
    .examples =
        "  petri view dish.fl                              until it is closed; save dish.fl to see what changed\n"
        "  petri view dish.fl --terminal -D DROPS=50       in the terminal\n",
    .options = VIEW_OPTION_SPECS,
    .run = view_run,
};
