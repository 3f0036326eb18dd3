// resize.c: see resize.h.
#include "picture/resize.h"

#include "base/heap.h"
#include "schema/table.h"

#include <math.h>
#include <string.h>

// Computes the weights with which the old pixels *first to *first + *count - 1 contribute to the new pixel `at`. The
// filter is a triangle whose radius is one old or one new pixel, whichever is larger.
static void compute_weights(int old, int new, int at, int *first, int *count, float *weights) {
    double scale = (double)old / new, reach = fmax(scale, 1), middle = (at + 0.5) * scale, sum = 0;
    int low = (int)fmax(floor(middle - reach), 0), high = (int)fmin(ceil(middle + reach), old);
    *first = low;
    *count = high - low;
    for (int i = low; i < high; i++) {
        double weight = fmax(0, 1 - fabs((i + 0.5 - middle) / reach));
        weights[i - low] = (float)weight;
        sum += weight;
    }
    for (int i = 0; i < *count; i++)
        weights[i] /= (float)sum;
}

// Resizes lines of `old` pixels to lines of `new` pixels in another array. If `down` is true, the lines are columns,
// otherwise rows. A pixel is four floats.
static void resize_lines(const float *in, float *out, int lines, int old, int new, bool down, float *weights) {
    for (int at = 0; at < new; at++) {
        int first, count;
        compute_weights(old, new, at, &first, &count, weights);
        for (int line = 0; line < lines; line++) {
            float sum[4] = {0, 0, 0, 0};
            for (int i = 0; i < count; i++) {
                size_t from = down ? (size_t)(first + i) * (size_t)lines + (size_t)line
                                   : (size_t)line * (size_t)old + (size_t)(first + i);
                for (size_t k = 0; k < 4; k++)
                    sum[k] += weights[i] * in[4 * from + k];
            }
            size_t to = down ? (size_t)at * (size_t)lines + (size_t)line : (size_t)line * (size_t) new + (size_t)at;
            for (size_t k = 0; k < 4; k++) // rounds after each direction, not only at the end
                out[4 * to + k] = rintf(sum[k]);
        }
    }
}

// Converts pixels to floats a, r, g, b from 0 to 255, not premultiplied.
static void unpack_pixels(const uint32_t *pixels, int width, int height, size_t stride, bool alpha, float *out) {
    for (int y = 0; y < height; y++) {
        const uint32_t *row = (const uint32_t *)(const void *)((const char *)pixels + (size_t)y * stride);
        for (int x = 0; x < width; x++, out += 4) {
            float a = alpha ? (float)(row[x] >> 24) : 255;
            out[0] = a;
            for (unsigned k = 0; k < 3; k++)
                out[k + 1] = a > 0 ? rintf((float)(row[x] >> (16 - 8 * k) & 255) * 255 / a) : 0;
        }
    }
}

static uint32_t pack_pixel(const float *in) {
    uint32_t pixel = (uint32_t)in[0] << 24;
    for (unsigned k = 0; k < 3; k++)
        pixel |= (uint32_t)rintf(in[k + 1] * in[0] / 255) << (16 - 8 * k);
    return pixel;
}

Texture *resize_pixels(Budget *budget, const uint32_t *pixels, int width, int height, size_t stride, bool alpha,
                       int new_width, int new_height, int flip) {
    size_t max_pixels =
        (size_t)(width > new_width ? width : new_width) * (size_t)(height > new_height ? height : new_height);
    size_t bytes = 2 * max_pixels * 4 * sizeof(float); // size of the two temporary arrays together
    if (!budget_reserve(budget, bytes))
        return NULL;
    float *one = heap_alloc(bytes / 2), *other = heap_alloc(bytes / 2);
    float *weights = heap_alloc((2 * (size_t)(width > height ? width : height) + 8) * sizeof *weights);
    Texture *texture = one && other && weights ? texture_new(budget, new_width, new_height, false) : NULL;
    if (texture) {
        unpack_pixels(pixels, width, height, stride, alpha, one);
        resize_lines(one, other, height, width, new_width, false, weights);
        resize_lines(other, one, new_width, height, new_height, true, weights);
        for (int y = 0; y < new_height; y++)
            for (int x = 0; x < new_width; x++) {
                int from_x = flip == FLIP_HORIZONTAL || flip == FLIP_BOTH ? new_width - 1 - x : x;
                int from_y = flip == FLIP_VERTICAL || flip == FLIP_BOTH ? new_height - 1 - y : y;
                texture->bytes[(size_t)y * (size_t)new_width + (size_t)x] =
                    pack_pixel(one + 4 * ((size_t)from_y * (size_t)new_width + (size_t)from_x));
            }
    }
    heap_free(one);
    heap_free(other);
    heap_free(weights);
    budget_release(budget, bytes);
    return texture;
}
