// filters.c: draws commands, through filters if there are any (filters.h). A filtered drawing is rendered to a
// transparent float image, which is then filtered and composited.
#include "picture/filters.h"

#include "cairo/hdr_composite.h"

#include <math.h>

// The inputs of a filter.
typedef struct FilterContext {
    Canvas *canvas;
    DisplayMatrix matrix; // transform of the drawing
    double x;             // position of the images on the target
    double y;
    const FloatImage *drawn; // the unfiltered drawing
} FilterContext;

static void report_blur_limit(void *argument, const double *filter) {
    const FilterContext *context = argument;
    Origin place = display_list_note(context->canvas->list, filter).place;
    draw_report(context->canvas, &place, DIAG_WARNING, "blur-limit", "!%s: the radius is limited to %d pixels",
                (int)*filter == PETRI_FILTER_BLUR ? "blur" : "shadow", FLOAT_IMAGE_MAX_SIGMA);
}

// Returns the pixels of an image surface as a float image.
static FloatImage read_surface(Canvas *canvas, cairo_surface_t *surface) {
    cairo_surface_flush(surface);
    return float_image_read(&canvas->pool, (const uint32_t *)(const void *)cairo_image_surface_get_data(surface),
                            cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
}

// Returns a new image that is filled with the paint that the commands set.
static FloatImage paint_all(void *argument, DisplayNumbers commands) {
    const FilterContext *context = argument;
    Canvas *canvas = context->canvas;
    const DisplayPaint paint = {.source = commands.at};
    if (canvas->hdr_target.pixels && display_paint_is_plain(&paint)) {
        DisplayRow row;
        FloatImage plain = float_image_new(&canvas->pool, context->drawn->width, context->drawn->height);
        display_list_read(paint.source, &row);
        float_image_fill(&plain, row.COLOR.colour);
        return plain;
    }
    cairo_surface_t *surface =
        draw_push_offscreen(canvas, context->drawn->width, context->drawn->height, context->x, context->y);
    FloatImage image = {0};
    if (!surface)
        return image;
    const DisplayMatrix *m = &context->matrix;
    cairo_set_matrix(canvas->cr, &(cairo_matrix_t){m->xx, m->yx, m->xy, m->yy, m->x0, m->y0});
    draw_set_source(canvas, &paint);
    cairo_paint(canvas->cr);
    image = read_surface(canvas, surface);
    draw_pop_offscreen(canvas);
    return image;
}

typedef struct Box {
    double x;
    double y;
    double width;
    double height;
} Box;

// Computes the area of the target that the image must cover, from the clip and, if it is known, the bounding box of the
// shape. Returns false if nothing is visible.
static bool find_box(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint, const FilterNeeds *needs,
                     Box *box) {
    cairo_t *cr = canvas->cr;
    double seen[4], figure[4], margin = ceil(needs->margin + 2);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_clip_extents(cr, &seen[0], &seen[1], &seen[2], &seen[3]);
    cairo_restore(cr);
    if (seen[2] <= seen[0] || seen[3] <= seen[1])
        return false;
    bool known = row->kind == PETRI_DRAW_PATH && !needs->everywhere;
    if (known) {
        draw_set_path(canvas, row->PATH.path);
        known = draw_find_box(canvas, &row->PATH, paint, figure);
    }
    for (int k = 0; k < 2; k++) {
        double low = known ? fmax(seen[k], figure[k]) : seen[k];
        double high = known ? fmin(seen[2 + k], figure[2 + k]) : seen[2 + k];
        // The filter changes pixels at most `margin` beyond the shape. If these pixels are all outside the clip,
        // nothing is visible.
        if (known && (figure[k] - margin >= seen[2 + k] || figure[2 + k] + margin <= seen[k]))
            return false;
        low = known ? fmax(seen[k] - margin, figure[k] - margin) : low - margin;
        high = known ? fmin(seen[2 + k] + margin, figure[2 + k] + margin) : high + margin;
        *(k ? &box->y : &box->x) = floor(low);
        *(k ? &box->height : &box->width) = ceil(high) - floor(low);
    }
    return box->width >= 1 && box->height >= 1;
}

// Charges the cost of the filter. If the cost exceeds a limit, reports this and returns false.
static bool can_filter(Canvas *canvas, const Origin *place, const Box *box, const FilterNeeds *needs) {
    double pixels = box->width * box->height, work = pixels <= IMAGE_MAX_PIXELS ? pixels * needs->work : INFINITY;
    return draw_charge(canvas, place, work, "the content is drawn without the filter");
}

// Draws a command, but ignores the paint's filter.
static void draw_unfiltered(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint) {
    DisplayPaint smooth = *paint;
    if (row->kind == PETRI_DRAW_PATH) {
        draw_set_path(canvas, row->PATH.path);
        draw_current_path(canvas, &row->PATH, paint);
    } else if (row->kind != PETRI_DRAW_TEXT) {
        draw_image(canvas, row, paint);
    } else if (draw_set_text_path(canvas, &row->TEXT, paint)) {
        smooth.style.antialias = true;
        draw_current_path(
            canvas, &(PATHOperands){.fill = row->TEXT.fill, .stroke = row->TEXT.stroke, .rule = FILL_WINDING}, &smooth);
        draw_forget_path(canvas);
    }
}

// Draws the command to a new image, without its filter and composite mode, and returns the image.
static FloatImage draw_offscreen(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint, const Box *box) {
    cairo_matrix_t matrix;
    cairo_get_matrix(canvas->cr, &matrix);
    cairo_surface_t *surface = draw_push_offscreen(canvas, (int)box->width, (int)box->height, box->x, box->y);
    FloatImage image = {0};
    if (!surface)
        return image;
    cairo_set_matrix(canvas->cr, &matrix);
    DisplayPaint plain = *paint;
    plain.filter.count = 0;
    plain.style.mode = COMPOSITE_OVER;
    if (canvas->outer_hdr_target.pixels) {
        image = canvas->hdr_target = float_image_new(&canvas->pool, (int)box->width, (int)box->height);
        canvas->hdr_target.x = (int)box->x;
        canvas->hdr_target.y = (int)box->y;
    }
    if (!canvas->outer_hdr_target.pixels || image.pixels)
        draw_unfiltered(canvas, row, &plain);
    if (!canvas->outer_hdr_target.pixels)
        image = read_surface(canvas, surface);
    draw_pop_offscreen(canvas);
    return image;
}

// Composites the filtered image onto the target.
static void composite_result(Canvas *canvas, const FloatImage *image, const Box *box, int composite) {
    cairo_t *cr = canvas->cr;
    if (canvas->hdr_target.pixels) {
        hdr_composite(canvas, image, box->x, box->y, composite);
        return;
    }
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image->width, image->height);
    float_image_write(image, (uint32_t *)(void *)cairo_image_surface_get_data(surface));
    cairo_surface_mark_dirty(surface);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_source_surface(cr, surface, box->x, box->y);
    cairo_set_operator(cr, draw_operator(composite));
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(surface);
}

// Draws a command through the paint's filter.
static void draw_filtered(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint) {
    const double *filter = paint->filter.at;
    FilterContext context = {.canvas = canvas};
    FilterTask task = {.reader = {filter, paint->filter.count, false},
                       .matrix = &context.matrix,
                       .pool = &canvas->pool,
                       .paint = paint_all,
                       .exceeds = report_blur_limit,
                       .context = &context};
    cairo_matrix_t m;
    Box box;
    cairo_get_matrix(canvas->cr, &m);
    context.matrix = (DisplayMatrix){m.xx, m.yx, m.xy, m.yy, m.x0, m.y0};
    FilterNeeds needs = filter_measure(&task);
    if (!find_box(canvas, row, paint, &needs, &box))
        return;
    Origin place = display_list_note(canvas->list, filter).place;
    FloatImage result = {0};
    if (can_filter(canvas, &place, &box, &needs)) {
        FloatImage drawn = draw_offscreen(canvas, row, paint, &box);
        context.x = box.x;
        context.y = box.y;
        context.drawn = task.drawn = &drawn;
        task.reader = (DisplayReader){filter, paint->filter.count, false};
        if (drawn.pixels)
            result = filter_apply(&task);
        float_image_free(&canvas->pool, &drawn);
        draw_report_degraded(canvas, &place, "a filter", !result.pixels);
    }
    if (result.pixels)
        composite_result(canvas, &result, &box, (int)paint->style.mode);
    else
        draw_unfiltered(canvas, row, paint);
    float_image_free(&canvas->pool, &result);
}

void draw_command(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint) {
    (paint->filter.count > 0 ? draw_filtered : draw_unfiltered)(canvas, row, paint);
}
