// filter_pixels.c: the public functions that compute pixels of noise and filters for hosts that draw display lists.
#include "base/host_struct.h"
#include "petri-draw.h"
#include "picture/filters.h"
#include "picture/noise.h"
#include "picture/painter.h"

#include <math.h>

static bool is_valid_size(int width, int height) {
    return width > 0 && height > 0 && (double)width * height <= IMAGE_MAX_PIXELS;
}

PetriStatus petri_noise_draw(const double operands[8], const double matrix[6], uint32_t *pixels, int width,
                             int height) {
    if (!operands || !matrix || !pixels || !is_valid_size(width, height))
        return PETRI_INVALID;
    const NOISEOperands noise = {.frequency = operands,
                                 .tile = operands + 2,
                                 .seed = operands[4],
                                 .octaves = floor(fmin(fmax(operands[5], 0), UINT8_MAX)),
                                 .type = fmin(fmax(operands[6], 0), TURBULENCE_IMPROVED)};
    noise_fill(&noise, (const DisplayMatrix *)(const void *)matrix, 0, 0, fmin(fmax(operands[7], 0), 1), pixels, width,
               height);
    return PETRI_OK;
}

PetriStatus petri_filter_measure(const double *filter, size_t count, const double matrix[6], PetriFilterNeeds *needs,
                                 size_t size) {
    if (!filter || !matrix || !needs)
        return PETRI_INVALID;
    FilterTask task = {.reader = {filter, count, false}, .matrix = (const DisplayMatrix *)(const void *)matrix};
    FilterNeeds found = filter_measure(&task);
    host_struct_write(needs, size, &(PetriFilterNeeds){.margin = found.margin, .everywhere = found.everywhere},
                      sizeof *needs);
    return task.reader.failed ? PETRI_INVALID : PETRI_OK;
}

// A filter that a host applies.
typedef struct HostFilter {
    FilterTask task;
    uint32_t *pixels; // receive the pixels of paints
    PetriPaintCallback *paint;
    void *user_data;
} HostFilter;

static FloatImage draw_paint(void *context, DisplayNumbers commands) {
    HostFilter *host = context;
    FilterTask *task = &host->task;
    task->reader.failed |= !host->paint || !host->paint(host->user_data, commands.at, commands.count, host->pixels);
    return task->reader.failed ? (FloatImage){0}
                               : float_image_read(task->pool, host->pixels, task->drawn->width, task->drawn->height);
}

PetriStatus petri_filter_draw(const double *filter, size_t count, const double matrix[6], uint32_t *pixels, int width,
                              int height, PetriPaintCallback *paint, void *user_data) {
    if (!filter || !matrix || !pixels || !is_valid_size(width, height))
        return PETRI_INVALID;
    Budget budget = {.memory_limit = SIZE_MAX};
    FloatImagePool pool = {.budget = &budget};
    FloatImage drawn = float_image_read(&pool, pixels, width, height), result = {0};
    HostFilter host = {.task = {.reader = {filter, count, false},
                                .matrix = (const DisplayMatrix *)(const void *)matrix,
                                .pool = &pool,
                                .drawn = &drawn,
                                .paint = draw_paint,
                                .context = &host},
                       .pixels = pixels,
                       .paint = paint,
                       .user_data = user_data};
    if (drawn.pixels)
        result = filter_apply(&host.task);
    bool done = !host.task.reader.failed && result.pixels;
    if (done)
        float_image_write(&result, pixels);
    float_image_free_all(&pool);
    return done ? PETRI_OK : host.task.reader.failed ? PETRI_INVALID : PETRI_OUT_OF_MEMORY;
}
