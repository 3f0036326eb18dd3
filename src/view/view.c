// view.c: `petri view`: the main loop, which connects a live script (live_script.h) and a display (display.h).
#include "view/view.h"

#include "base/clock.h"
#include "cli/script.h"
#include "petri-live.h"
#include "view/options.h"
#include "view/still.h"

#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Maximum delay in seconds before a saved script is noticed.
static const double MAX_SLEEP = 0.05;
// Seconds before a frame is due at which petri_step is called, which waits for the rest. Otherwise all frames would be
// late, because events are handled with a precision of 1 ms. The frame counts as in time with more than 1 ms to spare.
static const double EARLY = 0.002;
enum { MAX_EVENTS = 256, DEFAULT_SIZE = 512 };

// Global, because a signal handler has no other access.
static volatile sig_atomic_t interrupted;

static void on_interrupt(int number) {
    interrupted = number;
}

static int pending_signal(void) {
    return interrupted;
}

// The first signal closes the view in an orderly way. A second signal terminates the process.
static void catch_interrupts(void) {
    signal_catch(SIGINT, on_interrupt, (int)SA_RESETHAND);
    signal_catch(SIGTERM, on_interrupt, (int)SA_RESETHAND);
    signal_catch(SIGHUP, on_interrupt, (int)SA_RESETHAND);
}

// Updates the size and title of the display. The script may change them in any frame.
static void follow_script(View *view) {
    int width = DEFAULT_SIZE, height = DEFAULT_SIZE;
    const char *title = view->live.options->script;
    if (view->live.picture) {
        petri_picture_size(view->live.picture, &width, &height);
        const char *own = petri_picture_title(view->live.picture);
        title = own[0] != '\0' ? own : title;
    }
    bool resized = width != view->width || height != view->height;
    view->width = width;
    view->height = height;
    bool renamed = overlay_set(view->title, sizeof view->title, title);
    if (view->display && resized && view->kind->resize)
        view->kind->resize(view->display, width, height);
    if (view->display && renamed)
        view->kind->set_title(view->display, view->title);
    windows_follow(view);
}

static void step_script(View *view) {
    live_script_step(&view->live);
    view->step_once = view->paused && view->live.before_first_picture; // continue until a frame is visible
    follow_script(view);
    view_update_error_text(view);
    if (view->paused)
        view_update_status(view);
    view->redraw = true;
    live_script_save(&view->live, false);
}

static bool at_end(const View *view) {
    PetriFrame frame;
    petri_frame(view->live.session, &frame, sizeof frame);
    return !options_due(view->live.options, view->live.frames, view->start, frame.fps);
}

static bool can_step(const View *view) {
    return !live_script_halted(&view->live) && (!view->paused || view->step_once);
}

static double seconds_until_step(const View *view) {
    return view->step_once ? 0 : fmax(0, petri_seconds_until_due(view->live.session) - EARLY);
}

// Returns the number of seconds until the next action: a step, a picture, or the end of a notice.
static double idle_seconds(const View *view) {
    double now = clock_seconds(), idle = MAX_SLEEP;
    if (can_step(view))
        idle = fmin(idle, seconds_until_step(view));
    if (view->redraw)
        idle = fmin(idle, view->drawn + view->kind->min_seconds - now);
    return fmax(0, fmin(idle, view->notice_ends - now));
}

// Reports the pointer to the session, relative to the picture, which is centred in the display.
static void report_pointer(View *view, const Event *event) {
    const Pane *pane = windows_find(view, event->display);
    int across, down, width = pane ? pane->width : view->width, height = pane ? pane->height : view->height;
    view->kind->size(pane ? pane->display : view->display, width, height, &across, &down);
    double scale = fmin((double)across / width, (double)down / height);
    PetriPointer pointer = {.size = sizeof pointer,
                            .x = (event->x - across / 2.0) / (width * scale) + 0.5,
                            .y = (event->y - down / 2.0) / (height * scale) + 0.5,
                            .buttons = event->buttons};
    pointer.inside = event->inside && pointer.x >= 0 && pointer.x <= 1 && pointer.y >= 0 && pointer.y <= 1;
    petri_report_pointer(view->live.session, &pointer);
}

static void set_paused(View *view, bool paused) {
    view->paused = paused;
    petri_resync_clock(view->live.session);
    view_reset_notice(view);
    view_update_status(view);
}

// Saves the picture of the window that has the focus.
static void take_screenshot(View *view) {
    char name[300];
    PetriPicture *picture = view->live.picture;
    const Pane *pane = windows_find(view, view->focused);
    int first = petri_picture_window(picture);
    if (pane && petri_picture_select(picture, pane->window) != PETRI_OK)
        pane = NULL;
    if (live_script_screenshot(&view->live, name, sizeof name)) {
        view_notice(view, "saved %s", name);
    } else {
        view_notice(view, "cannot save %s", name);
        view->live.failed = true;
    }
    if (pane)
        petri_picture_select(picture, first);
    if (view->kind->logs)
        message("%s", view->overlay.notice);
}

static void reset_script(View *view) {
    live_script_reset(&view->live);
    view->step_once = true; // show the first frame even while paused
    view_update_error_text(view);
    view_notice(view, "reset");
}

// Handles a key for the script's parameters. Returns false if it is no such key.
static bool change_parameters(View *view, const char *key) {
    SCOPED_TEXT text = {0};
    ParameterResult act = parameter_key(&view->parameters, &view->live, key, &text);
    if (act != PARAMETER_NOT_A_KEY) {
        view_notice(view, "%s", text.bytes);
        view_update_status(view);
    }
    if (act == PARAMETER_CHANGED) {
        view->step_once = view->step_once || view->paused;
        view_update_error_text(view);
    }
    return act != PARAMETER_NOT_A_KEY;
}

// Executes the view's action for a key. Returns false if there is none.
static bool execute_key(View *view, const char *key) {
    if (strcmp(key, "q") == 0 || strcmp(key, "escape") == 0) {
        view->closing = true;
    } else if (strcmp(key, "space") == 0) {
        set_paused(view, !view->paused);
    } else if (strcmp(key, "period") == 0) {
        set_paused(view, true);
        view->step_once = true;
    } else if (strcmp(key, "r") == 0) {
        reset_script(view);
    } else if (strcmp(key, "f") == 0) {
        if (view->kind->toggle_full_screen)
            view->kind->toggle_full_screen(windows_find(view, view->focused) ? view->focused : view->display);
        view->redraw = true;
    } else if (strcmp(key, "s") == 0) {
        take_screenshot(view);
    } else if (strcmp(key, "w") == 0) {
        view->shows_warnings = !view->shows_warnings;
        view_update_error_text(view);
    } else if (strcmp(key, "h") == 0) {
        view->shows_status = !view->shows_status;
        view_update_status(view);
    } else if (strcmp(key, "p") == 0) {
        view_toggle_sliders(view);
    } else {
        return change_parameters(view, key);
    }
    return true;
}

// Executes the view's action for a key, unless the script binds this key and Control is not held. Reports the key to
// the session, unless it was meant for the view because Control is held.
static void handle_key(View *view, const Event *event) {
    if (!event->key)
        return;
    bool pressed = event->kind == EVENT_KEY_TAP || event->pressed;
    bool repeated = event->repeated && !parameter_key_repeats(event->key);
    bool executed = pressed && !repeated && (event->control || !petri_key_is_bound(view->live.session, event->key)) &&
                    execute_key(view, event->key);
    if (!(pressed && event->control && (executed || repeated)))
        petri_report_key(view->live.session, event->key, pressed);
    if (event->kind == EVENT_KEY_TAP)
        petri_report_key(view->live.session, event->key, false);
}

static void handle_event(View *view, const Event *event) {
    view->focused = event->display;
    switch (event->kind) {
    case EVENT_CLOSE:
        view->closing = !windows_hide(view, event->display);
        break;
    case EVENT_KEY:
    case EVENT_KEY_TAP:
        handle_key(view, event);
        break;
    case EVENT_POINTER: {
        unsigned buttons_before = view->pointer.buttons;
        view->pointer = *event;
        Event away = {.kind = EVENT_POINTER, .display = event->display};
        report_pointer(view, view_drag_slider(view, event, buttons_before) ? &away : event);
        break;
    }
    case EVENT_FOCUS_LOST:
        petri_report_pointer(view->live.session, NULL);
        break;
    case EVENT_REDRAW:
        view->redraw = true;
        break;
    case EVENT_NONE:
        break;
    }
}

static void handle_events(View *view) {
    Event event = view->kind->next_event(view->display, idle_seconds(view));
    for (int i = 0; event.kind != EVENT_NONE && !view->closing && i < MAX_EVENTS; i++) {
        handle_event(view, &event);
        event = view->kind->next_event(view->display, 0);
    }
    view_apply_drag(view);
}

// Reduces the detail of pictures to the resolution of the display.
static void choose_detail(View *view) {
    int width = 0, height = 0;
    if (!view->kind->coarse || !view->kind->coarse(view->display))
        return;
    view->kind->size(view->display, view->width, view->height, &width, &height);
    live_script_set_detail(&view->live, width > 0 && width < view->width ? (double)width / view->width : 1);
}

// Makes pixels opaque, as if they were drawn on black.
static void make_opaque(uint32_t *pixels, size_t count) {
    for (size_t i = 0; i < count; i++)
        pixels[i] |= 0xFF000000;
}

// Draws the picture into view->pixels and shows the pixels.
static PetriStatus show_pixels(View *view, Display *display, PetriPicture *picture, const Overlay *overlay) {
    int width, height;
    PetriStatus status = PETRI_OK;
    view->kind->size(display, view->width, view->height, &width, &height);
    size_t count = (size_t)width * (size_t)height;
    if (count == 0)
        return PETRI_OK;
    view->pixels = memory_realloc(view->pixels, count * sizeof *view->pixels);
    if (picture) {
        status = petri_picture_draw(picture, view->live.painter, view->pixels, width, height,
                                    (size_t)width * sizeof *view->pixels);
    } else {
        memset(view->pixels, 0, count * sizeof *view->pixels);
    }
    make_opaque(view->pixels, count);
    view->drawn_width = width;
    view->drawn_height = height;
    view->broken = !view->kind->show(display, view->pixels, width, height, overlay);
    return status;
}

PetriStatus view_show(View *view, Display *display, PetriPicture *picture, const Overlay *overlay) {
    PetriStatus status;
    if (view->kind->show_directly && view->kind->show_directly(display, picture, overlay, &status))
        return status;
    return show_pixels(view, display, picture, overlay);
}

static void draw_view(View *view) {
    choose_detail(view);
    sliders_update(&view->overlay.sliders, view->live.session);
    PetriPicture *picture = live_script_draw(&view->live);
    view->redraw = false;
    view->drawn = clock_seconds(); // taken before drawing, so that slow drawing does not delay the next picture
    live_script_check_drawn(&view->live, view_show(view, view->display, picture, &view->overlay));
    windows_draw(view, picture);
    if (picture) {
        petri_picture_report(view->live.session, picture);
        view_update_error_text(view); // show diagnostics reported during drawing
    }
    view->pictures++;
}

static void handle_changes(View *view) {
    ListenerResult result = listener_serve(&view->listener, &view->live);
    if (result != LISTENER_NOTHING) {
        view->step_once = (view->step_once || view->paused) && result == LISTENER_ACCEPTED; // show what was sent
        view->redraw = true;
        view_update_status(view);
        view_update_error_text(view);
    }
    if (!live_script_reload(&view->live))
        return;
    if (live_script_error_text(&view->live)[0] == '\0') {
        view_notice(view, "loaded the changed script");
        view->step_once = view->paused; // show the change
    }
    view_update_error_text(view);
}

// Returns true if the run has an effect even without a display.
static bool has_purpose(const View *view) {
    const Options *options = view->live.options;
    return options->frames < INT64_MAX || !isnan(options->run_time) || options->state_file ||
           view_options(options)->listen || (view->live.picture && petri_picture_needs_history(view->live.picture));
}

// If the screen was lost, replaces the display: its resources can no longer be used or even closed.
static void check_display(View *view) {
    if (!view->kind->gone || !view->kind->gone(view->display))
        return;
    view->broken = !has_purpose(view);
    message(view->broken ? "display lost; the run ends" : "display lost; continuing without it");
    view->kind = null_display();
    view->display = view->focused = NULL;
    view->other_count = 0;
    view->paused = false; // because there is no longer a keyboard with which to resume
    petri_report_pointer(view->live.session, NULL);
    petri_resync_clock(view->live.session);
}

static void run_loop(View *view) {
    while (!view->closing && !view->broken && !interrupted && !at_end(view)) {
        handle_events(view);
        check_display(view);
        handle_changes(view);
        if (clock_seconds() >= view->notice_ends)
            view_reset_notice(view);
        if (can_step(view) && seconds_until_step(view) <= 0) {
            if (view->paused)
                petri_resync_clock(view->live.session);
            step_script(view);
        }
        // If the length of the run is limited, a frame that fails ends the run.
        if (live_script_halted(&view->live) &&
            (view->live.options->frames < INT64_MAX || !isnan(view->live.options->run_time)))
            return;
        view_measure_rate(view);
        if (view->redraw && clock_seconds() - view->drawn >= view->kind->min_seconds) {
            draw_view(view);
            check_display(view);
        }
    }
    // Always show the last frame, even if the run was very short.
    if (view->redraw && at_end(view) && !view->broken)
        draw_view(view);
}

// Moves the open display to the screen of the options, and fills it if required. If this fails, writes a message,
// closes the display and returns false.
static bool place_display(View *view) {
    const Options *options = view->live.options;
    const ViewOptions *own = view_options(options);
    if (own->screen >= 0 && view->kind->move_to_screen &&
        !view->kind->move_to_screen(view->display, (int)own->screen)) {
        view->kind->close(view->display);
        view->display = NULL;
        return false;
    }
    if (own->full_screen && view->kind->toggle_full_screen)
        view->kind->toggle_full_screen(view->display);
    return true;
}

// Opens a window if there is a screen, else the terminal display. Returns false after a message.
static bool open_display(View *view) {
    const Options *options = view->live.options;
    const ViewOptions *own = view_options(options);
    bool window = !own->terminal && window_display() && window_has_screen();
    if (!window && !terminal_display()) {
        message(own->terminal || window_display()
                    ? "cannot show pictures in a terminal: petri was built without libchafa; on Debian, install "
                      "libchafa-dev and build petri again"
                    : "cannot show pictures: petri was built without SDL and libchafa; './dev build' adds both");
        return false;
    }
    view->kind = window ? window_display() : terminal_display();
    view->live.all_windows = window;
    view->live.hold_messages = !window && isatty(STDERR_FILENO);
    view->display = view->kind->open(view->title, view->width, view->height, view->live.painter, !options->monochrome);
    if (!view->display && window && terminal_display() && isatty(STDOUT_FILENO)) {
        view->kind = terminal_display();
        view->live.all_windows = false;
        view->live.hold_messages = isatty(STDERR_FILENO);
        view->display =
            view->kind->open(view->title, view->width, view->height, view->live.painter, !options->monochrome);
    }
    return view->display && place_display(view);
}

// Returns true for `petri run --show`, which passes these options.
static bool is_show(const View *view) {
    return view_options(view->live.options)->terminal && view->live.options->verbosity == LOG_VERBOSE;
}

// Writes the last picture of `petri run --show` to the normal screen, above the output of report_summary.
static void leave_picture(const View *view) {
    enum { LINES_BELOW = 5 };
    if (is_show(view) && !interrupted && view->drawn_width > 0) {
        still_show_pixels(view->pixels, view->drawn_width, view->drawn_height, !view->live.options->monochrome,
                          LINES_BELOW);
    }
}

// Reports the result on the normal screen if standard error is a terminal, as other commands do.
static void report_summary(const View *view) {
    Verbosity verbosity = view->live.options->verbosity;
    double seconds = clock_seconds() - view->start;
    if (verbosity >= LOG_VERBOSE || (verbosity == LOG_NORMAL && isatty(STDERR_FILENO))) {
        message("%" PRId64 " frame%s in %.3f s (%.1f frames/s)", view->live.frames, view->live.frames == 1 ? "" : "s",
                seconds, seconds > 0 ? (double)view->live.frames / seconds : 0);
    }
    if (verbosity >= LOG_DEBUG) {
        message("%" PRId64 " pictures shown, the last of %d x %d pixels; read back from the graphics card: %" PRIu64,
                view->pictures, view->drawn_width, view->drawn_height,
                petri_painter_readback_count(view->live.painter));
    }
    if (is_show(view))
        hint_pictures(view->host, view->live.options->script);
    else if (window_has_screen() && !window_display() && verbosity >= LOG_NORMAL)
        message("petri used the terminal, because it was built without SDL; './dev build' adds windows");
}

static int run_view(View *view) {
    view->start = view->measured = clock_seconds();
    view->dragged = -1;
    view->notice_ends = INFINITY;
    view->redraw = true;
    view->live.awaits_display = view->live.all_windows = true;
    if (view->live.options->frames > 0)
        step_script(view); // before the display is opened, because the picture determines its size
    follow_script(view);
    catch_interrupts();
    bool opened = open_display(view);
    if (opened) {
        live_script_begin(&view->live);
        windows_follow(view);
        petri_report_pointer(view->live.session, &(PetriPointer){.size = sizeof(PetriPointer), .inside = false});
        petri_resync_clock(view->live.session);
        view_hint_keys(view);
        run_loop(view);
        if (view->display) {
            windows_close(view);
            view->kind->close(view->display);
            leave_picture(view);
        }
    }
    live_script_release_messages(&view->live);
    if (!opened)
        return STATUS_FAILED;
    if (!live_script_halted(&view->live))
        live_script_save(&view->live, true);
    report_summary(view);
    bool archived = archiving_end(&view->live.archiving);
    bool failed = !archived || live_script_halted(&view->live) || view->live.failed || view->broken;
    if (interrupted && !view->live.state_file.outdated)
        return STATUS_SIGNAL + interrupted;
    return failed || state_file_failed(&view->live.state_file) ? STATUS_FAILED : STATUS_DONE;
}

static int view_run(const CommandContext *context, Options *options) {
    const ViewOptions *own = view_options(options);
    View view = {.host = context, .live.tester.pending_signal = pending_signal};
    int status = live_script_open(&view.live, context, options);
    if (status == OPTIONS_READ && own->listen &&
        (!live_script_enable_history(&view.live) || !listener_open(&view.listener, own->listen)))
        status = STATUS_FAILED;
    if (status == OPTIONS_READ)
        status = run_view(&view);
    listener_close(&view.listener);
    live_script_close(&view.live);
    free(view.pixels);
    if (view.kind == null_display()) {
        fflush(NULL);
        _exit(status); // exit is not used, because libraries would then wait forever for the lost screen
    }
    return status;
}

const Command VIEW_COMMAND = {
    .name = "view",
    .live = true,
    .operands = "SCRIPT.fl",
    .summary = "show a running script in a window or terminal",
    .details =
        "Runs a script and shows its pictures, or its particles, in a window or, without a display, in the terminal.\n"
        "When the script is saved, it is reloaded and keeps its state. If the script has errors, they are shown and\n"
        "the last good version keeps running. If the display is lost, the run ends, unless its length is limited or\n"
        "it saves a state, listens on a socket or records pictures.\n"
        "\n"
        "Keys: space pauses, . takes one step, r restarts, f toggles full screen, s saves the picture, h shows frame\n"
        "rate and clocks, w lists warnings (a corner shows their number), q or Escape quits. Tab or ] and [ select a\n"
        "parameter of the script (petri help run); up and down or + and - change it (page up and down: ten steps);\n"
        "0 or backspace resets it to its default. p shows sliders, which the pointer drags, for parameters with a "
        "range\n"
        "in a window. Keys that the script requests with !key go to the script unless\n"
        "Control is held.",
    .examples = "  petri view dish.fl                              shows changes whenever dish.fl is saved\n"
                "  petri view dish.fl --terminal -D DROPS=50       in the terminal\n",
    .missing_operand = "no script given",
    .no_stdin = "'petri view' watches the script file and cannot read the script from standard input; "
                "'petri render -' can",
    .options = &VIEW_OPTIONS,
    .parts = (const Command *const[]){&SEND_COMMAND, NULL},
    .run = view_run,
};
