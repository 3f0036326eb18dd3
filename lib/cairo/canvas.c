// canvas.c: a drawing in progress: its reports, its limits, and the surface that it draws on; see canvas.h. If a
// drawing is aborted, draw_close frees its memory and surfaces.
#include "cairo/canvas.h"

#include <math.h>

const char draw_omitted[] = "parts of the picture are left out";

bool draw_charge(Canvas *canvas, const Origin *place, double work, const char *outcome) {
    if (budget_charge_time(&canvas->painter->budget, work))
        return true;
    draw_report(canvas, place, DIAG_WARNING, "drawing-limit", "drawing exceeded the work limit (--work): %s", outcome);
    return false;
}

static size_t bytes_of(cairo_surface_t *surface) {
    return (size_t)cairo_image_surface_get_stride(surface) * (size_t)cairo_image_surface_get_height(surface);
}

cairo_surface_t *draw_push_offscreen(Canvas *canvas, int width, int height, double x, double y) {
    if (!float_image_reserve(&canvas->pool, (size_t)width * (size_t)height * sizeof(uint32_t)))
        return NULL;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    cairo_surface_set_device_offset(surface, -x, -y);
    cairo_t *cr = cairo_create(surface);
    if (cairo_status(cr) != CAIRO_STATUS_SUCCESS) {
        cairo_destroy(cr);
        cairo_surface_destroy(surface);
        float_image_release(&canvas->pool, (size_t)width * (size_t)height * sizeof(uint32_t));
        return NULL;
    }
    cairo_set_tolerance(cr, cairo_get_tolerance(canvas->cr));
    canvas->offscreen = surface;
    canvas->outer = canvas->cr;
    canvas->cr = cr;
    canvas->outer_hdr_target = canvas->hdr_target;
    canvas->hdr_target.pixels = NULL;
    canvas->path.at = NULL;
    return surface;
}

void draw_pop_offscreen(Canvas *canvas) {
    if (!canvas->offscreen)
        return;
    float_image_release(&canvas->pool, bytes_of(canvas->offscreen));
    cairo_destroy(canvas->cr);
    cairo_surface_destroy(canvas->offscreen);
    canvas->offscreen = NULL;
    canvas->cr = canvas->outer;
    canvas->hdr_target = canvas->outer_hdr_target;
    draw_forget_path(canvas);
}

void draw_report_degraded(Canvas *canvas, const Origin *place, const char *what, bool lacking) {
    Budget *budget = &canvas->painter->budget;
    if (!lacking)
        return;
    if (!budget->memory_refused)
        arena_exhausted(&canvas->painter->arena);
    budget->memory_refused = false;
    canvas->painter->lacks_memory = true;
    draw_report(canvas, place, DIAG_WARNING, "memory-limit",
                "drawing exceeded the memory limit (--memory): the content is drawn without %s", what);
}

void draw_close(Canvas *canvas) {
    draw_pop_offscreen(canvas);
    float_image_free_all(&canvas->pool);
}

void draw_report(Canvas *canvas, const Origin *place, DiagLevel level, const char *code, const char *format, ...) {
    va_list args;
    va_start(args, format);
    painter_report_args(canvas->diags, place, level, code, format, args);
    va_end(args);
}

bool draw_is_invertible(const cairo_matrix_t *m) {
    return display_matrix_is_invertible(&(DisplayMatrix){m->xx, m->yx, m->xy, m->yy, m->x0, m->y0});
}

double draw_scale_of(cairo_t *cr) {
    cairo_matrix_t m;
    cairo_get_matrix(cr, &m);
    return sqrt(fabs(m.xx * m.yy - m.xy * m.yx));
}

void draw_forget_path(Canvas *canvas) {
    cairo_new_path(canvas->cr);
    canvas->path_work = 0;
    canvas->size =
        (PathSize){.left = INFINITY, .right = -INFINITY, .top = INFINITY, .bottom = -INFINITY, .starts = true};
    canvas->path.at = NULL;
}

Str draw_string(Canvas *canvas, const DisplayString *string) {
    enum { MAX_BYTES = 6, REPLACEMENT = 0xFFFD }; // of a code point, in GLib; for bytes that are not UTF-8
    DisplayNumbers points = string->points;
    char *bytes = arena_alloc(&canvas->painter->arena, (size_t)MAX_BYTES * points.count + 1);
    size_t length = 0;
    for (uint32_t i = 0; i < points.count; i++)
        length += (size_t)g_unichar_to_utf8(points.at[i] >= 0 ? (gunichar)points.at[i] : REPLACEMENT, bytes + length);
    bytes[length] = 0;
    return (Str){bytes, length};
}
