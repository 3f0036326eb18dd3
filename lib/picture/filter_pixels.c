// filter_pixels.c: the public functions that compute pixels of noise and filters for hosts that draw display lists.
#include "base/host_struct.h"
#include "petri-draw.h"
#include "picture/filters.h"
#include "picture/noise.h"
#include "picture/painter.h"

#include <limits.h>
#include <math.h>
#include <string.h>

// display_list_filters.c nests at most 100 filters. PETRI_FILTER_SOURCE is one more.
enum { MAX_DEPTH = 101 };

static DisplayMatrix matrix_from(const double m[6]) {
    return (DisplayMatrix){m[0], m[1], m[2], m[3], m[4], m[5]};
}

static bool is_valid_size(int width, int height) {
    return width > 0 && height > 0 && (double)width * height <= IMAGE_MAX_PIXELS;
}

PetriStatus petri_noise_draw(const double operands[8], const double matrix[6], uint32_t *pixels, int width,
                             int height) {
    if (!operands || !matrix || !pixels || !is_valid_size(width, height))
        return PETRI_INVALID;
    DisplayMatrix to_units = matrix_from(matrix);
    DisplaySource source = {.kind = SOURCE_NOISE,
                            .ratio = operands[4],
                            .stop_count = (uint32_t)fmin(fmax(operands[5], 0), UINT8_MAX),
                            .mode = (int)fmin(fmax(operands[6], 0), TURBULENCE_IMPROVED)};
    memcpy(source.ends, operands, sizeof source.ends);
    noise_fill(&source, &to_units, 0, 0, fmin(fmax(operands[7], 0), 1), pixels, width, height);
    return PETRI_OK;
}

// Reads the numbers of a filter and applies it.
typedef struct FilterReader {
    const double *at;
    const double *end;
    DisplayMatrix matrix;
    PetriFilterNeeds *wanted; // receives what the filter needs; NULL: the filter is applied
    int depth;
    bool failed; // the numbers are not a valid filter, or the host could not draw a paint
    FloatImagePool pool;
    FloatImage drawn;
    uint32_t *pixels; // receive the pixels of paints
    PetriPaintCallback *paint;
    void *user_data;
} FilterReader;

// Returns the next numbers, or zeros if fewer are left.
static const double *take(FilterReader *reader, size_t count) {
    static const double zeros[20] = {0};
    if ((size_t)(reader->end - reader->at) < count) {
        reader->failed = true;
        return zeros;
    }
    reader->at += count;
    return reader->at - count;
}

// Returns the next number, which must be an integer from `min` to `max`.
static int take_integer(FilterReader *reader, int min, int max) {
    double number = *take(reader, 1);
    bool valid = number >= min && number <= max;
    reader->failed |= !valid;
    return valid ? (int)number : max;
}

// Reads the commands of a paint. Returns the picture that the host fills with this paint.
static FloatImage take_paint(FilterReader *reader) {
    size_t count = (size_t)take_integer(reader, 0, INT_MAX);
    const double *commands = take(reader, count);
    FloatImage none = {0};
    if (reader->wanted || reader->failed)
        return none;
    int width = reader->drawn.width, height = reader->drawn.height;
    reader->failed |= !reader->paint || !reader->paint(reader->user_data, commands, count, reader->pixels);
    return reader->failed ? none : float_image_read(&reader->pool, reader->pixels, width, height);
}

static FloatImage take_filter(FilterReader *reader);

// Reads the operands of a filter and applies it to its inputs. The names of operands are those of DisplayFilter's
// fields.
static FloatImage take_operands(FilterReader *reader, DisplayFilter filter) {
    FloatImage results[2] = {{0}, {0}};
    const double *table = NULL;
    int count = 0;
    switch (filter.kind) {
#define FILTER_KIND(name, operands)                                                                                    \
    case FILTER_##name:                                                                                                \
        operands break;
#define NUMBER(name) filter.name = take_integer(reader, -1, COMPOSITE_COUNT - 1);
#define PAIR(name) memcpy(filter.name, take(reader, 2), sizeof filter.name);
#define NUMBERS(name, size) table = take(reader, size);
#define COLOUR(name) memcpy(filter.name, take(reader, 4), sizeof filter.name);
#define INPUT(name) results[count++] = take_filter(reader);
#define COMMANDS(name) results[count++] = take_paint(reader);
#include "picture/display_list_rows.h"
    }
    if (filter.kind == FILTER_BLEND && filter.mode >= 0)
        table = NULL;
    if (reader->wanted) {
        FilterNeeds needs = {0};
        filter_add_needs(&filter, table, &reader->matrix, &needs);
        reader->wanted->margin += needs.margin;
        reader->wanted->everywhere |= needs.everywhere;
    } else if (filter.kind == FILTER_SOURCE) {
        return float_image_copy(&reader->pool, &reader->drawn);
    } else if (!reader->failed) {
        filter_apply(&reader->pool, &filter, table, &reader->matrix, &results[0], &results[1]);
    }
    float_image_free(&reader->pool, &results[1]);
    return results[0];
}

static FloatImage take_filter(FilterReader *reader) {
    FloatImage result = {0};
    int kind = take_integer(reader, 0, FILTER_COUNT - 1);
    reader->failed |= reader->depth == MAX_DEPTH;
    reader->depth++;
    if (!reader->failed)
        result = take_operands(reader, (DisplayFilter){.kind = (DisplayFilterKind)kind});
    reader->depth--;
    return result;
}

PetriStatus petri_filter_measure(const double *filter, size_t count, const double matrix[6], PetriFilterNeeds *needs,
                                 size_t size) {
    if (!filter || !matrix || !needs)
        return PETRI_INVALID;
    PetriFilterNeeds found = {0};
    FilterReader reader = {.at = filter, .end = filter + count, .matrix = matrix_from(matrix), .wanted = &found};
    take_filter(&reader);
    host_struct_write(needs, size, &found, sizeof found);
    return reader.failed ? PETRI_INVALID : PETRI_OK;
}

PetriStatus petri_filter_draw(const double *filter, size_t count, const double matrix[6], uint32_t *pixels, int width,
                              int height, PetriPaintCallback *paint, void *user_data) {
    if (!filter || !matrix || !pixels || !is_valid_size(width, height))
        return PETRI_INVALID;
    Budget budget = {.memory_limit = SIZE_MAX};
    FilterReader reader = {.at = filter,
                           .end = filter + count,
                           .matrix = matrix_from(matrix),
                           .pool.budget = &budget,
                           .pixels = pixels,
                           .paint = paint,
                           .user_data = user_data};
    reader.drawn = float_image_read(&reader.pool, pixels, width, height);
    FloatImage result = {0};
    if (reader.drawn.pixels)
        result = take_filter(&reader);
    bool done = !reader.failed && result.pixels;
    if (done)
        float_image_write(&result, pixels);
    float_image_free_all(&reader.pool);
    return done ? PETRI_OK : reader.failed ? PETRI_INVALID : PETRI_OUT_OF_MEMORY;
}
