// float_image.c: see float_image.h.
//
// A pool has a list of its images, so that those of an aborted drawing can be freed. If memory was refused, an image
// has no pixels, and all functions accept such an image and do nothing.
#include "picture/float_image.h"

#include "base/heap.h"
#include "maths/maths.h"
#include "picture/blend.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct FloatImageMemory {
    FloatImageMemory *next;
    FloatImageMemory **link; // the pointer that refers to this block: `next` of another block or the list's head
    size_t bytes;
    float pixels[];
};

static FloatImageMemory *memory_of(const FloatImage *image) {
    return (FloatImageMemory *)(void *)((char *)image->pixels - offsetof(FloatImageMemory, pixels));
}

static size_t count_of(const FloatImage *image) {
    return image->pixels ? (size_t)image->width * (size_t)image->height : 0;
}

bool float_image_reserve(FloatImagePool *pool, size_t bytes) {
    if (!budget_reserve(pool->budget, bytes))
        return false;
    pool->charged += bytes;
    return true;
}

void float_image_release(FloatImagePool *pool, size_t bytes) {
    budget_release(pool->budget, bytes);
    pool->charged -= bytes;
}

FloatImage float_image_new(FloatImagePool *pool, int width, int height) {
    size_t bytes = sizeof(FloatImageMemory) + (size_t)width * (size_t)height * 4 * sizeof(float);
    bool fits = (double)width * height * 4 * sizeof(float) < (double)(SIZE_MAX - sizeof(FloatImageMemory)); // 32-bit
    FloatImageMemory *memory = fits && float_image_reserve(pool, bytes) ? heap_calloc(1, bytes) : NULL;
    if (!memory)
        return (FloatImage){.width = width, .height = height};
    memory->bytes = bytes;
    memory->next = pool->images;
    memory->link = &pool->images;
    if (memory->next)
        memory->next->link = &memory->next;
    pool->images = memory;
    return (FloatImage){.width = width, .height = height, .pixels = memory->pixels};
}

void float_image_free(FloatImagePool *pool, FloatImage *image) {
    if (!image->pixels)
        return;
    FloatImageMemory *memory = memory_of(image);
    *memory->link = memory->next;
    if (memory->next)
        memory->next->link = memory->link;
    float_image_release(pool, memory->bytes);
    heap_free(memory);
    image->pixels = NULL;
}

void float_image_free_all(FloatImagePool *pool) {
    while (pool->images)
        float_image_free(pool, &(FloatImage){.pixels = pool->images->pixels});
    float_image_release(pool, pool->charged);
}

FloatImage float_image_copy(FloatImagePool *pool, const FloatImage *image) {
    FloatImage out = *image;
    if (image->pixels)
        out = float_image_new(pool, image->width, image->height);
    if (out.pixels)
        memcpy(out.pixels, image->pixels, count_of(image) * 4 * sizeof(float));
    return out;
}

FloatImage float_image_read(FloatImagePool *pool, const uint32_t *pixels, int width, int height) {
    FloatImage image = {0};
    if (pixels)
        image = float_image_new(pool, width, height);
    for (size_t i = 0; i < count_of(&image); i++)
        for (unsigned k = 0; k < 4; k++)
            image.pixels[4 * i + k] = (float)(pixels[i] >> (k < 3 ? 16 - 8 * k : 24) & 255) / 255;
    return image;
}

void float_image_write(const FloatImage *image, uint32_t *pixels) {
    for (size_t i = 0; pixels && i < count_of(image); i++) {
        uint32_t pixel = 0;
        for (unsigned k = 0; k < 4; k++)
            pixel |= (uint32_t)lrintf(255 * fminf(fmaxf(image->pixels[4 * i + k], 0), 1)) << (k < 3 ? 16 - 8 * k : 24);
        pixels[i] = pixel;
    }
}

// Limits of a LineFilter, a one-dimensional filter that is applied to each row or column of an image.
enum { MAX_REACH = 24 };
static const double MAX_EXACT_SIGMA = 8; // maximum standard deviation, in pixels, of a blur without cells

typedef struct LineFilter {
    void (*apply)(const struct LineFilter *filter, float *line, float *other, int count);
    int reach; // radius of the filter, in pixels, or in cells if `cell` is above 1
    bool erode;
    int cell; // number of pixels that are averaged to one cell; not used by find_extremes
    float weights[MAX_REACH + 1];
} LineFilter;

// Applies a filter to all rows (axis 0) or all columns (axis 1).
static void change_lines(FloatImagePool *pool, FloatImage *image, int axis, const LineFilter *filter) {
    int count = axis ? image->height : image->width, lines = axis ? image->width : image->height;
    size_t step = axis ? 4 * (size_t)image->width : 4, between = axis ? 4 : 4 * (size_t)image->width;
    if (!image->pixels)
        return;
    FloatImage scratch = float_image_new(pool, count + 2 * filter->reach + 8, 2);
    if (!scratch.pixels) {
        float_image_free(pool, image);
        return;
    }
    float *line = scratch.pixels, *other = line + 4 * (size_t)scratch.width;
    for (int i = 0; i < lines; i++) {
        float *at = image->pixels + (size_t)i * between;
        for (int k = 0; k < count; k++)
            memcpy(line + 4 * (size_t)k, at + (size_t)k * step, 4 * sizeof(float));
        filter->apply(filter, line, other, count);
        for (int k = 0; k < count; k++)
            memcpy(at + (size_t)k * step, line + 4 * (size_t)k, 4 * sizeof(float));
    }
    float_image_free(pool, &scratch);
}

// Computes the weighted sum of the pixels within reach of pixel `at`. Pixels beyond the ends are transparent.
static void convolve_at(const LineFilter *filter, const float *from, int count, int at, float *to) {
    float sum[4] = {0, 0, 0, 0};
    int first = at - filter->reach < 0 ? 0 : at - filter->reach,
        last = at + filter->reach >= count ? count - 1 : at + filter->reach;
    for (int j = first; j <= last; j++)
        for (int k = 0; k < 4; k++)
            sum[k] += filter->weights[abs(at - j)] * from[4 * j + k];
    memcpy(to, sum, sizeof sum);
}

static void convolve_line(const LineFilter *filter, float *line, float *other, int count) {
    memcpy(other, line, (size_t)count * 4 * sizeof(float));
    for (int i = 0; i < count; i++)
        convolve_at(filter, other, count, i, line + 4 * (size_t)i);
}

// Like convolve_line, for a long reach: averages the pixels of each cell, convolves the cells, and interpolates between
// the centres of the cells.
static void convolve_cells(const LineFilter *filter, float *line, float *other, int count) {
    int cell = filter->cell, cells = (count + cell - 1) / cell;
    float *weighed = other + 4 * (size_t)cells + 4; // convolved cells; the first index is -1
    memset(other, 0, (size_t)cells * 4 * sizeof(float));
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 4; k++)
            other[4 * (i / cell) + k] += line[4 * i + k] / (float)cell;
    for (int i = -1; i <= cells; i++)
        convolve_at(filter, other, cells, i, weighed + 4 * (ptrdiff_t)i);
    for (int i = 0; i < count; i++) {
        double at = (i - (cell - 1) / 2.0) / cell;
        int low = (int)floor(at);
        float fraction = (float)(at - low);
        for (int k = 0; k < 4; k++)
            line[4 * i + k] = (1 - fraction) * weighed[4 * low + k] + fraction * weighed[4 * (low + 1) + k];
    }
}

// Replaces each pixel by the maximum or minimum within reach. Computes the extremes of runs of 2, 4, 8 and so on
// pixels. Then combines two of the longest runs, which overlap and together cover the reach.
static void find_extremes(const LineFilter *filter, float *line, float *other, int count) {
    int reach = filter->reach, all = count + 2 * reach, run = 1, wanted = 2 * reach + 1;
    memset(other, 0, (size_t)all * 4 * sizeof(float));
    memcpy(other + 4 * (size_t)reach, line, (size_t)count * 4 * sizeof(float));
    for (; 2 * run <= wanted; run *= 2)
        for (int i = 0; i + run < all; i++)
            for (int k = 0; k < 4; k++) {
                float a = other[4 * i + k], b = other[4 * (i + run) + k];
                other[4 * i + k] = filter->erode == (a < b) ? a : b;
            }
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 4; k++) {
            float a = other[4 * i + k], b = other[4 * (i + wanted - run) + k];
            line[4 * i + k] = filter->erode == (a < b) ? a : b;
        }
}

// Averaging over cells and interpolating between cells also blur: their variances are (cell² - 1)/12 and (cell² - 1)/6.
// Variances add up, so the weights must provide only the remaining variance.
static void set_weights(LineFilter *filter, double sigma) {
    double sum = 0, cell = sigma > MAX_EXACT_SIGMA ? floor(sigma / 4) : 1;
    filter->cell = (int)cell;
    filter->apply = filter->cell > 1 ? convolve_cells : convolve_line;
    sigma = sqrt(sigma * sigma - (cell * cell - 1) / 4) / cell;
    filter->reach = (int)ceil(3 * sigma);
    for (int i = 0; i <= filter->reach; i++)
        sum += (i ? 2 : 1) * maths_exp(-0.5 * i * i / (sigma * sigma));
    for (int i = 0; i <= filter->reach; i++)
        filter->weights[i] = (float)(maths_exp(-0.5 * i * i / (sigma * sigma)) / sum);
}

void float_image_blur(FloatImagePool *pool, FloatImage *image, const double sigma[2]) {
    for (int axis = 0; axis < 2; axis++) {
        LineFilter filter;
        if (!(sigma[axis] > 0.05))
            continue;
        set_weights(&filter, fmin(sigma[axis], FLOAT_IMAGE_MAX_SIGMA));
        change_lines(pool, image, axis, &filter);
    }
}

void float_image_morphology(FloatImagePool *pool, FloatImage *image, const double radius[2], bool erode) {
    for (int axis = 0; axis < 2; axis++) {
        double max = axis ? image->height : image->width;
        LineFilter filter = {
            .apply = find_extremes, .erode = erode, .reach = (int)fmin(fmax(rint(radius[axis]), 0), max)};
        if (filter.reach > 0)
            change_lines(pool, image, axis, &filter);
    }
}

void float_image_move(FloatImagePool *pool, FloatImage *image, double dx, double dy) {
    if (!image->pixels)
        return;
    FloatImage out = float_image_new(pool, image->width, image->height);
    int x0 = (int)fmin(fmax(rint(dx), -image->width), image->width);
    int y0 = (int)fmin(fmax(rint(dy), -image->height), image->height);
    int first = x0 > 0 ? x0 : 0, last = x0 > 0 ? image->width : image->width + x0;
    for (int y = 0; out.pixels && y < image->height; y++)
        if (y - y0 >= 0 && y - y0 < image->height && last > first)
            memcpy(out.pixels + 4 * ((size_t)y * (size_t)out.width + (size_t)first),
                   image->pixels + 4 * ((size_t)(y - y0) * (size_t)out.width + (size_t)(first - x0)),
                   (size_t)(last - first) * 4 * sizeof(float));
    float_image_free(pool, image);
    *image = out;
}

void float_image_tint(FloatImage *image, const double color[4]) {
    for (size_t i = 0; i < count_of(image); i++) {
        float *pixel = image->pixels + 4 * i, alpha = pixel[3] * (float)color[3];
        for (int k = 0; k < 3; k++)
            pixel[k] = alpha * (float)color[k];
        pixel[3] = alpha;
    }
}

void float_image_composite_over(FloatImage *below, const FloatImage *above) {
    for (size_t i = 0; above->pixels && i < 4 * count_of(below); i++)
        below->pixels[i] = blend_OVER(above->pixels[i], below->pixels[i], above->pixels[i | 3], below->pixels[i | 3]);
}

void float_image_fill(FloatImage *image, const double color[4]) {
    for (size_t i = 0; i < 4 * count_of(image); i++)
        image->pixels[i] = (float)(i % 4 == 3 ? color[3] : color[3] * color[i % 4]);
}

static float clamp_to(float x, float max) {
    return fminf(fmaxf(x, 0), max);
}

void float_image_recolor(FloatImage *image, const double *matrix) {
    for (size_t i = 0; i < count_of(image); i++) {
        float *pixel = image->pixels + 4 * i, plain[5], out[4];
        for (int k = 0; k < 4; k++)
            plain[k] = k == 3 ? pixel[3] : pixel[3] > 0 ? pixel[k] / pixel[3] : 0;
        plain[4] = 1;
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 5; k++)
                sum += matrix[5 * row + k] * (double)plain[k];
            out[row] = clamp_to((float)sum, 1);
        }
        for (int k = 0; k < 4; k++)
            pixel[k] = k < 3 ? out[k] * out[3] : out[3];
    }
}

void float_image_combine(FloatImage *d, const FloatImage *s, const double *k, CompositeMode mode) {
    for (size_t i = 0; s->pixels && i < count_of(d); i++) {
        const float *above = s->pixels + 4 * i;
        float *below = d->pixels + 4 * i;
        if (!k)
            blend_colors(mode, above, below, below);
        for (int c = 0; k && c < 4; c++)
            below[c] = (float)(k[0] * (double)(above[c] * below[c]) + k[1] * (double)above[c] +
                               k[2] * (double)below[c] + k[3]);
        below[3] = clamp_to(below[3], 1);
        for (int c = 0; c < 3; c++)
            below[c] = clamp_to(below[c], below[3]);
    }
}
