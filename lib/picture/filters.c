// filters.c: see filters.h.
#include "picture/filters.h"

#include <math.h>

static const double MAX_OFFSET = 2000; // maximum number of pixels by which an offset or radius extends the image

void filter_radius(const DisplayFilter *filter, const DisplayMatrix *m, double radius[2]) {
    radius[0] = filter->radius[0] * sqrt(m->xx * m->xx + m->yx * m->yx);
    radius[1] = filter->radius[1] * sqrt(m->xy * m->xy + m->yy * m->yy);
}

static void find_offset(const DisplayFilter *filter, const DisplayMatrix *m, double offset[2]) {
    offset[0] = m->xx * filter->offset[0] + m->xy * filter->offset[1];
    offset[1] = m->yx * filter->offset[0] + m->yy * filter->offset[1];
}

void filter_add_needs(const DisplayFilter *filter, const double *table, const DisplayMatrix *m, FilterNeeds *needs) {
    double offset[2], radii[2];
    bool blurs = filter->kind == FILTER_BLUR || filter->kind == FILTER_SHADOW;
    filter_radius(filter, m, radii);
    find_offset(filter, m, offset);
    double radius = fmax(radii[0], radii[1]);
    needs->margin += fmin(fmax(fabs(offset[0]), fabs(offset[1])), MAX_OFFSET);
    needs->margin += blurs ? 3 * fmin(radius, FLOAT_IMAGE_MAX_SIGMA) : fmin(radius, MAX_OFFSET);
    needs->work += blurs ? 20 + 4 * fmin(radius, 16) : 20;
    needs->everywhere |= filter->kind == FILTER_PAINT || (filter->kind == FILTER_COLOUR_MATRIX && table[19] != 0) ||
                         (filter->kind == FILTER_BLEND && table && table[3] != 0);
}

// A filter to apply, whose lengths are in pixels.
typedef struct FilterTask {
    FloatImagePool *pool;
    const DisplayFilter *filter;
    const double *table;
    const FloatImage *other; // result of the second input; NULL: none
    double radius[2];
    double offset[2];
} FilterTask;

// These functions change the image of the filter's input to that of its result.
static void apply_blur(const FilterTask *task, FloatImage *image) {
    float_image_blur(task->pool, image, task->radius);
}

static void apply_offset(const FilterTask *task, FloatImage *image) {
    float_image_move(task->pool, image, task->offset[0], task->offset[1]);
}

static void apply_shadow(const FilterTask *task, FloatImage *image) {
    FloatImage shadow = float_image_copy(task->pool, image);
    float_image_tint(&shadow, task->filter->colour);
    apply_blur(task, &shadow);
    apply_offset(task, &shadow);
    if (!task->filter->only)
        float_image_composite_over(&shadow, image);
    float_image_free(task->pool, image);
    *image = shadow;
}

static void apply_dilate(const FilterTask *task, FloatImage *image) {
    float_image_morphology(task->pool, image, task->radius, false);
}

static void apply_erode(const FilterTask *task, FloatImage *image) {
    float_image_morphology(task->pool, image, task->radius, true);
}

static void apply_color_matrix(const FilterTask *task, FloatImage *image) {
    float_image_recolor(image, task->table);
}

static void apply_blend(const FilterTask *task, FloatImage *image) {
    float_image_combine(image, task->other, task->table, (CompositeMode)task->filter->mode);
    if (!task->other->pixels)
        float_image_free(task->pool, image);
}

// The image of a paint is the input.
static void apply_paint(const FilterTask *task, FloatImage *image) {
    (void)task, (void)image;
}

static void apply_source(const FilterTask *task, FloatImage *image) {
    (void)task, (void)image;
}

static void (*const filters[])(const FilterTask *task, FloatImage *image) = {
#define FILTER(id, name, reader, children, inputs, help) [FILTER_##id] = apply_##name,
#include "schema/schema_list.h"
};

void filter_apply(FloatImagePool *pool, const DisplayFilter *filter, const double *table, const DisplayMatrix *m,
                  FloatImage *image, const FloatImage *other) {
    FilterTask task = {.pool = pool, .filter = filter, .table = table, .other = other};
    filter_radius(filter, m, task.radius);
    find_offset(filter, m, task.offset);
    filters[filter->kind](&task, image);
}
