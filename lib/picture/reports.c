// reports.c: the limits of a painter, and reports of what they leave out; see painter.h.
#include "picture/painter.h"

void painter_report_args(DiagSink *diags, const Origin *place, DiagLevel level, const char *code, const char *format,
                         va_list args) {
    Text text = text_new(diags->arena);
    text_add_va(&text, format, args);
    Diag diag = {.level = level, .text = text_str(&text), .code = code};
    if (place)
        diag.at = *place;
    diag_report(diags, &diag);
}

void painter_report(DiagSink *diags, const Origin *place, DiagLevel level, const char *code, const char *format, ...) {
    va_list args;
    va_start(args, format);
    painter_report_args(diags, place, level, code, format, args);
    va_end(args);
}

bool painter_report_refused(PetriPainter *painter, DiagLevel level, const Origin *place, const char *node, int width,
                            int height, DiagSink *diags) {
    if (!painter->budget.memory_refused)
        return false;
    painter->budget.memory_refused = false;
    painter->lacks_memory = true;
    painter_report(diags, place, level, "memory-limit",
                   "%s: a picture of %d x %d pixels exceeds the memory limit (--memory); it is left out", node, width,
                   height);
    return true;
}

void painter_limit(PetriPainter *painter, const CanvasPicture *picture) {
    painter->budget.memory_limit = picture->memory;
    painter->lacks_memory = false;
    // Drawing has a separate work limit. Its work is not charged to the frame.
    budget_begin(&painter->budget, budget_drawing_limit(picture->work), NULL);
}

// The context of report_needed, which is called through arena_protect.
typedef struct Needed {
    PetriPainter *painter;
    const CanvasPicture *picture;
    DiagSink *diags;
} Needed;

static void report_needed(void *context) {
    const Needed *needed = context;
    PetriPainter *painter = needed->painter;
    if (painter->budget.refused_time > 0)
        painter_report(needed->diags, NULL, DIAG_NOTE, "drawing-limit", "--work %.0fM suffices to draw everything",
                       budget_suggest_work(&painter->budget));
    if (painter->lacks_memory)
        painter_report(needed->diags, NULL, DIAG_NOTE, "memory-limit", "--memory %.0fM suffices to draw everything",
                       budget_suggest_memory(&painter->budget, needed->picture->session_memory));
}

void painter_report_needed(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags) {
    Needed needed = {painter, picture, diags};
    (void)arena_protect(&diags->arena, 1, report_needed, &needed); // without memory, the note is left out
}

static void report_limit(void *diags) {
    painter_report(diags, NULL, DIAG_ERROR, "memory-limit",
                   "drawing exceeded the memory limit (--memory): the picture is not drawn");
}

PetriStatus painter_report_limit(DiagSink *diags) {
    return arena_protect(&diags->arena, 1, report_limit, diags) == ARENA_OK ? PETRI_INVALID : PETRI_OUT_OF_MEMORY;
}

static void report_no_backend(void *diags) {
#ifdef __EMSCRIPTEN__
    const char *advice = "petri for Node.js draws with `petri render` only; use the native petri";
#else
    const char *advice = "this build of petri cannot draw: it lacks Cairo, Pango, libjpeg or libpng; install them and "
                         "build it again (Debian: libcairo2-dev libpango1.0-dev libjpeg-dev libpng-dev)";
#endif
    painter_report(diags, NULL, DIAG_ERROR, "cannot-draw", "%s", advice);
}

PetriStatus painter_report_no_backend(DiagSink *diags) {
    bool reported = arena_protect(&diags->arena, 1, report_no_backend, diags) == ARENA_OK;
    return reported ? PETRI_UNSUPPORTED : PETRI_OUT_OF_MEMORY;
}
