// filters.c: drawing through filters (spec canvas.md 6). The drawing is rendered to a transparent float image, which is
// then filtered and composited.
#include "draw/float_image.h"
#include "draw/hdr_composite.h"

#include <math.h>

enum { MAX_PIXELS = 1 << 26 };         // maximum number of pixels of a filtered image
static const double MAX_OFFSET = 2000; // maximum number of pixels by which an offset or radius extends the image

// The inputs of a filter.
typedef struct FilterContext {
    Canvas *canvas;
    cairo_matrix_t matrix; // transform of the drawing
    double x;              // position of the images on the target
    double y;
    const FloatImage *drawn; // the unfiltered drawing
} FilterContext;

static double scale_in(const cairo_matrix_t *m, int axis) {
    return axis ? sqrt(m->xy * m->xy + m->yy * m->yy) : sqrt(m->xx * m->xx + m->yx * m->yx);
}

static void report_blur_limit(Canvas *canvas, const DisplayFilter *filter, const double radius[2]) {
    if (fmax(radius[0], radius[1]) > FLOAT_IMAGE_MAX_SIGMA)
        draw_report_canvas_at(canvas, &filter->place, DIAG_WARNING, "blur-limit",
                              "!%s: the radius is limited to %d pixels",
                              filter->kind == FILTER_BLUR ? "blur" : "shadow", FLOAT_IMAGE_MAX_SIGMA);
}

static FloatImage apply_filter(const FilterContext *context, uint32_t number);

// A filter to apply. Its lengths are in pixels.
typedef struct FilterTask {
    const FilterContext *context;
    const DisplayFilter *filter;
    const double *numbers; // NULL: none
    double radius[2];
    double dx, dy; // offset
} FilterTask;

// These functions change the image of the filter's input to that of its result.
static void apply_blur(const FilterTask *task, FloatImage *image) {
    report_blur_limit(task->context->canvas, task->filter, task->radius);
    float_image_blur(task->context->canvas, image, task->radius);
}

static void apply_offset(const FilterTask *task, FloatImage *image) {
    float_image_move(task->context->canvas, image, task->dx, task->dy);
}

static void apply_shadow(const FilterTask *task, FloatImage *image) {
    Canvas *canvas = task->context->canvas;
    FloatImage drawn = *image;
    *image = float_image_copy(canvas, &drawn);
    float_image_tint(image, task->filter->color);
    apply_blur(task, image);
    apply_offset(task, image);
    if (!task->filter->only)
        float_image_composite_over(image, &drawn);
    float_image_free(canvas, &drawn);
}

static void apply_dilate(const FilterTask *task, FloatImage *image) {
    float_image_morphology(task->context->canvas, image, task->radius, false);
}

static void apply_erode(const FilterTask *task, FloatImage *image) {
    float_image_morphology(task->context->canvas, image, task->radius, true);
}

static void apply_color_matrix(const FilterTask *task, FloatImage *image) {
    float_image_recolor(image, task->numbers);
}

static void apply_blend(const FilterTask *task, FloatImage *image) {
    Canvas *canvas = task->context->canvas;
    FloatImage other = apply_filter(task->context, task->filter->inputs[1]);
    float_image_combine(image, &other, task->numbers, (CompositeMode)task->filter->mode);
    if (!other.pixels)
        float_image_free(canvas, image);
    float_image_free(canvas, &other);
}

// Creates an image that is filled with the paint.
static void apply_paint(const FilterTask *task, FloatImage *image) {
    const FilterContext *context = task->context;
    Canvas *canvas = context->canvas;
    const DisplayPaint *paint = &canvas->list->paints.at[task->filter->paint];
    if (canvas->hdr_target.pixels && paint->source == DISPLAY_NONE) {
        *image = float_image_new(canvas, context->drawn->width, context->drawn->height);
        float_image_fill(image, paint->color);
        return;
    }
    cairo_surface_t *surface =
        draw_push_offscreen(canvas, context->drawn->width, context->drawn->height, context->x, context->y);
    if (!surface)
        return;
    cairo_set_matrix(canvas->cr, &context->matrix);
    draw_set_source(canvas, paint);
    cairo_paint(canvas->cr);
    *image = float_image_read(canvas, surface);
    draw_pop_offscreen(canvas);
}

static void apply_source(const FilterTask *task, FloatImage *image) {
    (void)task, (void)image;
}

static void (*const filters[])(const FilterTask *task, FloatImage *image) = {
#define FILTER(id, name, reader, children, inputs, help) [FILTER_##id] = apply_##name,
#include "schema/schema_list.h"
};

// Returns the result of a filter as a new image.
static FloatImage apply_filter(const FilterContext *context, uint32_t number) {
    const DisplayList *list = context->canvas->list;
    if (number == DISPLAY_NONE)
        return float_image_copy(context->canvas, context->drawn);
    const DisplayFilter *filter = &list->filters.at[number];
    FilterTask task = {.context = context,
                       .filter = filter,
                       .numbers = filter->numbers == DISPLAY_NONE ? NULL : list->numbers.at + filter->numbers,
                       .radius = {filter->radius[0] * scale_in(&context->matrix, 0),
                                  filter->radius[1] * scale_in(&context->matrix, 1)},
                       .dx = filter->offset[0],
                       .dy = filter->offset[1]};
    cairo_matrix_transform_distance(&context->matrix, &task.dx, &task.dy);
    FloatImage image = {0};
    if (filter->kind != FILTER_PAINT) // has no input
        image = apply_filter(context, filter->inputs[0]);
    filters[filter->kind](&task, &image);
    return image;
}

// The requirements of a filter.
typedef struct Needs {
    double margin;   // number of pixels by which the image must extend beyond the visible area
    double work;     // time in nanoseconds per pixel of the image
    bool everywhere; // true if the filter changes transparent pixels
} Needs;

static void add_needs(const DisplayList *list, uint32_t number, const cairo_matrix_t *m, Needs *needs) {
    if (number == DISPLAY_NONE)
        return;
    const DisplayFilter *filter = &list->filters.at[number];
    const double *numbers = filter->numbers == DISPLAY_NONE ? NULL : list->numbers.at + filter->numbers;
    double dx = filter->offset[0], dy = filter->offset[1];
    double radius = fmax(filter->radius[0] * scale_in(m, 0), filter->radius[1] * scale_in(m, 1));
    bool blurs = filter->kind == FILTER_BLUR || filter->kind == FILTER_SHADOW;
    cairo_matrix_transform_distance(m, &dx, &dy);
    needs->margin += fmin(fmax(fabs(dx), fabs(dy)), MAX_OFFSET);
    needs->margin += blurs ? 3 * fmin(radius, FLOAT_IMAGE_MAX_SIGMA) : fmin(radius, MAX_OFFSET);
    needs->work += blurs ? 20 + 4 * fmin(radius, 16) : 20;
    needs->everywhere |= filter->kind == FILTER_PAINT || (filter->kind == FILTER_COLOUR_MATRIX && numbers[19] != 0) ||
                         (filter->kind == FILTER_BLEND && numbers && numbers[3] != 0);
    add_needs(list, filter->inputs[0], m, needs);
    add_needs(list, filter->inputs[1], m, needs);
}

typedef struct Box {
    double x;
    double y;
    double width;
    double height;
} Box;

// Computes the area of the target that the image must cover, from the clip and, if it is known, the bounding box of the
// shape. Returns false if nothing is visible.
static bool find_box(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint, const Needs *needs,
                     Box *box) {
    cairo_t *cr = canvas->cr;
    double seen[4], figure[4], margin = ceil(needs->margin + 2);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_clip_extents(cr, &seen[0], &seen[1], &seen[2], &seen[3]);
    cairo_restore(cr);
    if (seen[2] <= seen[0] || seen[3] <= seen[1])
        return false;
    bool known = command->kind == DISPLAY_DRAW && !needs->everywhere;
    if (known) {
        draw_set_path(canvas, command);
        known = draw_find_box(canvas, command, paint, figure);
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
static bool can_filter(Canvas *canvas, const DisplayFilter *filter, const Box *box, const Needs *needs) {
    double pixels = box->width * box->height, work = pixels <= MAX_PIXELS ? pixels * needs->work : INFINITY;
    return draw_charge(canvas, &filter->place, work, "the content is drawn without the filter");
}

// Draws the command to a new image, without its filter and composite mode, and returns the image.
static FloatImage draw_offscreen(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint,
                                 const Box *box) {
    cairo_matrix_t matrix;
    cairo_get_matrix(canvas->cr, &matrix);
    cairo_surface_t *surface = draw_push_offscreen(canvas, (int)box->width, (int)box->height, box->x, box->y);
    FloatImage image = {0};
    if (!surface)
        return image;
    cairo_set_matrix(canvas->cr, &matrix);
    DisplayPaint plain = *paint;
    plain.filter = DISPLAY_NONE;
    plain.composite = COMPOSITE_OVER;
    if (canvas->outer_hdr_target.pixels) {
        image = canvas->hdr_target = float_image_new(canvas, (int)box->width, (int)box->height);
        canvas->hdr_target.x = (int)box->x;
        canvas->hdr_target.y = (int)box->y;
    }
    if (!canvas->outer_hdr_target.pixels || image.pixels)
        draw_unfiltered(canvas, command, &plain);
    if (!canvas->outer_hdr_target.pixels)
        image = float_image_read(canvas, surface);
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
    float_image_write(image, surface);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_source_surface(cr, surface, box->x, box->y);
    cairo_set_operator(cr, draw_operator(composite));
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(surface);
}

void draw_filtered(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    FilterContext context = {.canvas = canvas};
    Needs needs = {0};
    Box box;
    cairo_get_matrix(canvas->cr, &context.matrix);
    add_needs(canvas->list, paint->filter, &context.matrix, &needs);
    if (!find_box(canvas, command, paint, &needs, &box))
        return;
    const DisplayFilter *filter = &canvas->list->filters.at[paint->filter];
    FloatImage result = {0};
    if (can_filter(canvas, filter, &box, &needs)) {
        FloatImage drawn = draw_offscreen(canvas, command, paint, &box);
        context.x = box.x;
        context.y = box.y;
        context.drawn = &drawn;
        if (drawn.pixels)
            result = apply_filter(&context, paint->filter);
        float_image_free(canvas, &drawn);
        draw_report_degraded(canvas, &filter->place, "a filter", !result.pixels);
    }
    if (result.pixels)
        composite_result(canvas, &result, &box, paint->composite);
    else
        draw_unfiltered(canvas, command, paint);
    float_image_free(canvas, &result);
}
