// apart.c: what drawing takes for a while: memory beside the picture's own, and surfaces to draw on. Whoever gives a
// drawing up midway leaves them to draw_close.
#include "draw/sheets.h"

bool draw_take(Canvas *canvas, size_t bytes) {
    if (!meter_take(&canvas->painter->meter, bytes))
        return false;
    canvas->taken += bytes;
    return true;
}

void draw_give(Canvas *canvas, size_t bytes) {
    meter_give(&canvas->painter->meter, bytes);
    canvas->taken -= bytes;
}

const char draw_left_out[] = "what comes now is left out";

bool draw_spend(Canvas *canvas, const Origin *place, double work, const char *outcome) {
    static const double UNIT = 10; // nanoseconds (meter.h)
    Meter *meter = &canvas->painter->meter;
    if (work / UNIT <= (double)(meter->work_limit - meter->work)) {
        meter->work += (uint64_t)(work / UNIT);
        return true;
    }
    draw_fault_at(canvas, place, DIAG_WARNING, "drawing-limit", "drawing takes longer than a script may (--work): %s",
                  outcome);
    return false;
}

static size_t bytes_of(cairo_surface_t *surface) {
    return (size_t)cairo_image_surface_get_stride(surface) * (size_t)cairo_image_surface_get_height(surface);
}

cairo_surface_t *draw_begin_apart(Canvas *canvas, int width, int height, double x, double y) {
    if (!draw_take(canvas, (size_t)width * (size_t)height * sizeof(uint32_t)))
        return NULL;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    cairo_surface_set_device_offset(surface, -x, -y);
    cairo_t *cr = cairo_create(surface);
    if (cairo_status(cr) != CAIRO_STATUS_SUCCESS) {
        cairo_destroy(cr);
        cairo_surface_destroy(surface);
        draw_give(canvas, (size_t)width * (size_t)height * sizeof(uint32_t));
        return NULL;
    }
    cairo_set_tolerance(cr, cairo_get_tolerance(canvas->cr));
    canvas->apart = surface;
    canvas->outer = canvas->cr;
    canvas->cr = cr;
    canvas->outer_wide = canvas->wide;
    canvas->wide.pixels = NULL;
    canvas->path_of = NULL;
    return surface;
}

void draw_end_apart(Canvas *canvas) {
    if (!canvas->apart)
        return;
    draw_give(canvas, bytes_of(canvas->apart));
    cairo_destroy(canvas->cr);
    cairo_surface_destroy(canvas->apart);
    canvas->apart = NULL;
    canvas->cr = canvas->outer;
    canvas->wide = canvas->outer_wide;
    draw_forget_path(canvas);
}

void draw_lacks(Canvas *canvas, const Origin *place, const char *what, bool lacking) {
    Meter *meter = &canvas->painter->meter;
    if (!lacking)
        return;
    if (!meter->memory_refused)
        arena_exhausted(&canvas->painter->arena);
    meter->memory_refused = false;
    draw_fault_at(canvas, place, DIAG_WARNING, "memory-limit",
                  "drawing takes more memory than a script may have (--memory); this is drawn without %s", what);
}

void draw_close(Canvas *canvas) {
    draw_end_apart(canvas);
    sheets_free_all(canvas);
    draw_give(canvas, canvas->taken);
}
