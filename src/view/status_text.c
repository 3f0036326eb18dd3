// status_text.c: updates the texts shown over the picture; see view.h.
//
// A function requests a new picture only if it has changed a text (View.redraw).
#include "base/clock.h"
#include "petri-live.h"
#include "view/view.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// In seconds: how long a notice is shown (NOTICE), how long the hint about keys is shown (HINT), and the interval
// between measurements of the frame rate (MEASURE).
static const double NOTICE = 4, HINT = 3, MEASURE = 0.5;
static const char KEYS[] = "h: keys";

static void set_notice(View *view, const char *text, double ends) {
    view->redraw = overlay_set(view->overlay.notice, sizeof view->overlay.notice, text) || view->redraw;
    view->notice_ends = ends;
}

void view_notice(View *view, const char *format, ...) {
    char text[sizeof view->overlay.notice];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    set_notice(view, text, clock_seconds() + NOTICE);
}

void view_hint_keys(View *view) {
    const Overlay *overlay = &view->overlay;
    bool free = overlay->error_text[0] == '\0' && overlay->mark[0] == '\0' && overlay->notice[0] == '\0';
    if (free && view->live.options->verbosity > LOG_QUIET && !petri_key_is_bound(view->live.session, "h"))
        set_notice(view, KEYS, clock_seconds() + HINT);
}

void view_reset_notice(View *view) {
    set_notice(view, view->paused ? "paused: space resumes, . steps" : "", INFINITY);
}

// Errors take precedence. Without errors, shows the list of warnings if the user has requested it, else their number.
void view_update_error_text(View *view) {
    Overlay *overlay = &view->overlay;
    const char *error_text = live_script_error_text(&view->live);
    char text[sizeof overlay->error_text] = "", mark[sizeof overlay->mark] = "";
    overlay->is_warning = error_text[0] == '\0';
    if (overlay->is_warning && view->shows_warnings)
        warnings_list(&view->live.warnings, text, sizeof text);
    else if (overlay->is_warning)
        warnings_mark(&view->live.warnings, mark, sizeof mark);
    bool changed =
        overlay_set(overlay->error_text, sizeof overlay->error_text, overlay->is_warning ? text : error_text);
    changed = overlay_set(overlay->mark, sizeof overlay->mark, mark) || changed;
    if ((overlay->error_text[0] != '\0' || overlay->mark[0] != '\0') && strcmp(overlay->notice, KEYS) == 0)
        view_reset_notice(view);
    view->redraw = changed || view->redraw;
}

static void add_parameters(View *view, char *text, size_t size) {
    SCOPED_TEXT more = {0};
    size_t length = strlen(text);
    parameter_status(&view->parameters, &view->live, view->kind && view->kind->scale, &more);
    snprintf(text + length, size - length, "%s", more.len == 0 ? "" : more.bytes);
}

void view_update_status(View *view) {
    char text[sizeof view->overlay.status] = "";
    if (view->shows_status) {
        PetriFrame frame;
        petri_frame(view->live.session, &frame, sizeof frame);
        double seconds = frame.time;
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

void view_measure_rate(View *view) {
    double now = clock_seconds(), passed = now - view->measured;
    if (passed < MEASURE)
        return;
    view->rate = (double)(view->live.frames - view->measured_frames) / passed;
    view->measured = now;
    view->measured_frames = view->live.frames;
    view_update_status(view);
}
