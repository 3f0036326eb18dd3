// filters.c: see filters.h.
#include "picture/filters.h"

#include <math.h>

// display_list_build_filter nests at most 100 filters. PETRI_FILTER_SOURCE is one more.
enum { MAX_DEPTH = 101 };

static const double MAX_OFFSET = 2000; // maximum number of pixels by which an offset or radius extends the image

// A filter without those inside it.
typedef struct FilterStep {
    FloatImagePool *pool;
    DisplayRow filter;
    double radius[2]; // in pixels
    double offset[2];
    const FloatImage *other; // result of the second input
} FilterStep;

static const uint8_t input_counts[] = {
#define FILTER(id, name, writer, children, inputs, help) [PETRI_FILTER_##id] = inputs,
#include "schema/schema_list.h"
};

static bool blurs(const FilterStep *step) {
    return step->filter.kind == PETRI_FILTER_BLUR || step->filter.kind == PETRI_FILTER_SHADOW;
}

static void scale_lengths(FilterStep *step, const DisplayMatrix *m) {
    static const double none[2] = {0, 0};
    const DisplayRow *filter = &step->filter;
    const double *radius = none, *offset = none;
    if (filter->kind == PETRI_FILTER_SHADOW) {
        radius = filter->FILTER_SHADOW.radius;
        offset = filter->FILTER_SHADOW.offset;
    } else if (filter->kind == PETRI_FILTER_OFFSET) {
        offset = filter->FILTER_OFFSET.offset;
    } else if (filter->kind == PETRI_FILTER_BLUR || filter->kind == PETRI_FILTER_DILATE ||
               filter->kind == PETRI_FILTER_ERODE) {
        radius = filter->FILTER_BLUR.radius;
    }
    step->radius[0] = radius[0] * sqrt(m->xx * m->xx + m->yx * m->yx);
    step->radius[1] = radius[1] * sqrt(m->xy * m->xy + m->yy * m->yy);
    step->offset[0] = m->xx * offset[0] + m->xy * offset[1];
    step->offset[1] = m->yx * offset[0] + m->yy * offset[1];
}

static void add_needs(const FilterStep *step, FilterNeeds *needs) {
    const DisplayRow *filter = &step->filter;
    double radius = fmax(step->radius[0], step->radius[1]);
    needs->margin += fmin(fmax(fabs(step->offset[0]), fabs(step->offset[1])), MAX_OFFSET);
    needs->margin += blurs(step) ? 3 * fmin(radius, FLOAT_IMAGE_MAX_SIGMA) : fmin(radius, MAX_OFFSET);
    needs->work += blurs(step) ? 20 + 4 * fmin(radius, 16) : 20;
    needs->everywhere |=
        filter->kind == PETRI_FILTER_PAINT ||
        (filter->kind == PETRI_FILTER_COLOUR_MATRIX && filter->FILTER_COLOUR_MATRIX.elements[19] != 0) ||
        (filter->kind == PETRI_FILTER_BLEND && filter->FILTER_BLEND.mode < 0 && filter->FILTER_BLEND.factors[3] != 0);
}

// These functions change the image of the filter's input to that of its result.
static void apply_blur(const FilterStep *step, FloatImage *image) {
    float_image_blur(step->pool, image, step->radius);
}

static void apply_offset(const FilterStep *step, FloatImage *image) {
    float_image_move(step->pool, image, step->offset[0], step->offset[1]);
}

static void apply_shadow(const FilterStep *step, FloatImage *image) {
    FloatImage shadow = float_image_copy(step->pool, image);
    float_image_tint(&shadow, step->filter.FILTER_SHADOW.colour);
    apply_blur(step, &shadow);
    apply_offset(step, &shadow);
    if (step->filter.FILTER_SHADOW.only == 0)
        float_image_composite_over(&shadow, image);
    float_image_free(step->pool, image);
    *image = shadow;
}

static void apply_dilate(const FilterStep *step, FloatImage *image) {
    float_image_morphology(step->pool, image, step->radius, false);
}

static void apply_erode(const FilterStep *step, FloatImage *image) {
    float_image_morphology(step->pool, image, step->radius, true);
}

static void apply_color_matrix(const FilterStep *step, FloatImage *image) {
    float_image_recolor(image, step->filter.FILTER_COLOUR_MATRIX.elements);
}

static void apply_blend(const FilterStep *step, FloatImage *image) {
    const FILTER_BLENDOperands *blend = &step->filter.FILTER_BLEND;
    float_image_combine(image, step->other, blend->mode < 0 ? blend->factors : NULL, (CompositeMode)(int)blend->mode);
    if (!step->other->pixels)
        float_image_free(step->pool, image);
}

// filter_apply has made the image.
static void apply_paint(const FilterStep *step, FloatImage *image) {
    (void)step, (void)image;
}

static void apply_source(const FilterStep *step, FloatImage *image) {
    (void)step, (void)image;
}

static void (*const filters[])(const FilterStep *step, FloatImage *image) = {
#define FILTER(id, name, writer, children, inputs, help) [PETRI_FILTER_##id] = apply_##name,
#include "schema/schema_list.h"
};

// Reads a filter. Returns false if the numbers are not valid.
static bool read_step(FilterTask *task, FilterStep *step) {
    DisplayReader *reader = &task->reader;
    *step = (FilterStep){.pool = task->pool};
    display_list_read_filter(reader, &step->filter);
    double mode = step->filter.kind == PETRI_FILTER_BLEND ? step->filter.FILTER_BLEND.mode : 0;
    reader->failed |= task->depth == MAX_DEPTH || !(mode >= -1 && mode < COMPOSITE_COUNT);
    if (!reader->failed)
        scale_lengths(step, task->matrix);
    return !reader->failed;
}

static void add_all_needs(FilterTask *task, FilterNeeds *needs) {
    FilterStep step;
    if (!read_step(task, &step))
        return;
    if (step.filter.kind != PETRI_FILTER_SOURCE)
        add_needs(&step, needs);
    task->depth++;
    for (int i = 0; i < input_counts[step.filter.kind]; i++)
        add_all_needs(task, needs);
    task->depth--;
}

FilterNeeds filter_measure(FilterTask *task) {
    FilterNeeds needs = {0};
    add_all_needs(task, &needs);
    return needs;
}

FloatImage filter_apply(FilterTask *task) {
    FilterStep step;
    FloatImage results[2] = {{0}, {0}};
    const double *start = task->reader.at;
    if (!read_step(task, &step))
        return results[0];
    if (step.filter.kind == PETRI_FILTER_SOURCE)
        return float_image_copy(task->pool, task->drawn);
    if (step.filter.kind == PETRI_FILTER_PAINT)
        return task->paint(task->context, step.filter.FILTER_PAINT.commands);
    task->depth++;
    for (int i = 0; i < input_counts[step.filter.kind]; i++)
        results[i] = filter_apply(task);
    task->depth--;
    if (task->exceeds && blurs(&step) && fmax(step.radius[0], step.radius[1]) > FLOAT_IMAGE_MAX_SIGMA)
        task->exceeds(task->context, start);
    step.other = &results[1];
    if (!task->reader.failed)
        filters[step.filter.kind](&step, &results[0]);
    float_image_free(task->pool, &results[1]);
    return results[0];
}
