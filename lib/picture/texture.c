// texture.c: see texture.h.
//
// A texture has pixels as bytes or as floats, an image on the GPU, or both. Uploads and downloads keep the pixels that
// exist. The tables for sRGB are filled once for all threads, before their first use.
#include "picture/texture.h"

#include "base/heap.h"
#include "gl/colour_formulas.h"
#include "gl/functions.h"
#include "maths/maths.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

static void *alloc_pixels(Texture *texture, size_t each, bool cleared) {
    size_t count = (size_t)texture->width * (size_t)texture->height;
    if (!budget_reserve(texture->budget, count * each))
        return NULL;
    texture->charged += count * each;
    return cleared ? heap_calloc(count, each) : heap_alloc(count * each);
}

Texture *texture_new(Budget *budget, int width, int height, bool linear) {
    Texture *texture = heap_calloc(1, sizeof *texture);
    if (!texture)
        return NULL;
    *texture = (Texture){.references = 1, .width = width, .height = height, .budget = budget};
    if (linear)
        texture->linear = alloc_pixels(texture, 4 * sizeof(float), true);
    else
        texture->bytes = alloc_pixels(texture, sizeof(uint32_t), true);
    if (texture->linear || texture->bytes)
        return texture;
    texture_free(texture);
    return NULL;
}

Texture *texture_from_image(Budget *budget, Gl *gl, GlImage image) {
    Texture *texture = heap_calloc(1, sizeof *texture);
    if (!texture)
        gl_call.image_free(gl, image);
    else
        *texture = (Texture){
            .references = 1, .width = image.width, .height = image.height, .image = image, .gl = gl, .budget = budget};
    return texture;
}

bool texture_upload(Gl *gl, Texture *texture) {
    if (texture->gl)
        return true;
    GlFormat format = texture->bytes ? GL_FORMAT_SRGB8 : gl_call.format(gl, 16);
    texture->image = gl_call.image_new(gl, texture->width, texture->height, format);
    if (!texture->image.texture)
        return false;
    texture->gl = gl;
    if (texture->bytes)
        gl_call.upload_bytes(gl, texture->image, texture->bytes);
    else
        gl_call.upload_linear(gl, texture->image, texture->linear);
    return true;
}

bool texture_download(Gl *gl, Texture *texture) {
    if (texture->bytes || texture->linear)
        return true;
    if (texture->image.format == GL_FORMAT_SRGB8) {
        texture->bytes = alloc_pixels(texture, sizeof *texture->bytes, false);
        return texture->bytes && gl_call.read_bytes(gl, texture->image, texture->bytes);
    }
    texture->linear = alloc_pixels(texture, 4 * sizeof *texture->linear, false);
    return texture->linear && gl_call.read_linear(gl, texture->image, texture->linear);
}

Texture *texture_retain(Texture *texture) {
    texture->references++;
    return texture;
}

void texture_free(Texture *texture) {
    if (!texture || --texture->references > 0)
        return;
    if (texture->gl)
        gl_call.image_free(texture->gl, texture->image);
    heap_free(texture->bytes);
    heap_free(texture->linear);
    budget_release(texture->budget, texture->charged);
    heap_free(texture);
}

// `decoded` holds the linear values of the 256 sRGB bytes. `thresholds` holds the linear values that lie halfway, in
// sRGB, between each byte and the next.
static float decoded[256], thresholds[256];
// below[h] is the number of thresholds that do not exceed the float whose upper 16 bits are h and whose lower bits are
// zero. Starting from below[h], one or two comparisons find the number for any float with these upper bits.
enum { ONE = 0x3f80 }; // upper 16 bits of the float 1.0
static uint8_t below[ONE + 1];

static float float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static void make_tables(void) {
    for (int i = 0; i < 256; i++) {
        decoded[i] = (float)SRGB_DECODE(i / 255.0, maths_pow);
        thresholds[i] = (float)SRGB_DECODE((i + 0.5) / 255.0, maths_pow);
    }
    for (uint32_t half = 0, count = 0; half <= ONE; half++) {
        while (count < 255 && float_of(half << 16) >= thresholds[count])
            count++;
        below[half] = (uint8_t)count;
    }
}

static void init_tables(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, make_tables);
}

const float *texture_thresholds(void) {
    init_tables();
    return thresholds;
}

float texture_decode(unsigned byte) {
    init_tables();
    return decoded[byte & 255];
}

unsigned texture_encode(float c) {
    init_tables();
    uint32_t bits;
    if (!(c > 0))
        return 0;
    if (c >= 1)
        return 255;
    memcpy(&bits, &c, sizeof bits);
    unsigned count = below[bits >> 16];
    while (c >= thresholds[count]) // terminates because the last threshold is above 1
        count++;
    return count;
}

static uint32_t encode_pixel(const float color[4], bool opaque) {
    float alpha = opaque || !(color[3] < 1) ? 1 : color[3] > 0 ? color[3] : 0;
    uint32_t pixel = (uint32_t)lrintf(255 * alpha) << 24;
    for (unsigned k = 0; k < 3 && alpha > 0; k++)
        pixel |= (uint32_t)lrintf((float)texture_encode(color[k] / alpha) * alpha) << (16 - 8 * k);
    return pixel;
}

void texture_row(const Texture *texture, int y, bool opaque, uint32_t *row) {
    size_t start = (size_t)y * (size_t)texture->width;
    for (size_t x = 0; x < (size_t)texture->width; x++)
        row[x] = texture->linear ? encode_pixel(texture->linear + 4 * (start + x), opaque)
                                 : texture->bytes[start + x] | (opaque ? 0xff000000u : 0);
}

static void read_texel(const Texture *texture, int x, int y, float color[4]) {
    size_t at = (size_t)y * (size_t)texture->width + (size_t)x;
    if (texture->linear) {
        for (int k = 0; k < 4; k++)
            color[k] = texture->linear[4 * at + (size_t)k];
        return;
    }
    uint32_t pixel = texture->bytes[at];
    for (unsigned k = 0; k < 3; k++)
        color[k] = decoded[pixel >> (16 - 8 * k) & 255];
    color[3] = (float)(pixel >> 24) / 255.0f;
}

// Wraps or clamps a coordinate to the picture. Returns false if the border colour applies.
static bool wrap_coordinate(int *at, int size, bool repeat, bool clamped) {
    if (repeat)
        *at = (*at % size + size) % size;
    else if (clamped)
        *at = *at < 0 ? 0 : *at >= size ? size - 1 : *at;
    return *at >= 0 && *at < size;
}

static void sample_texel(const Texture *texture, const Sampler *sampler, int x, int y, float color[4]) {
    bool any = sampler->repeat[0] || sampler->repeat[1];
    if (wrap_coordinate(&x, texture->width, sampler->repeat[0], any || sampler->clamped) &&
        wrap_coordinate(&y, texture->height, sampler->repeat[1], any || sampler->clamped)) {
        read_texel(texture, x, y, color);
        return;
    }
    for (int k = 0; k < 4; k++)
        color[k] = sampler->border[k];
}

void texture_sample(const Texture *texture, const Sampler *sampler, double u, double v, float color[4]) {
    init_tables();
    double x = u * texture->width, y = v * texture->height;
    if (sampler->nearest) {
        sample_texel(texture, sampler, (int)floor(x), (int)floor(y), color);
        return;
    }
    double left = floor(x - 0.5), top = floor(y - 0.5);
    float right = (float)(x - 0.5 - left), low = (float)(y - 0.5 - top);
    for (int k = 0; k < 4; k++)
        color[k] = 0;
    for (int corner = 0; corner < 4; corner++) {
        float weight = (corner & 1 ? right : 1 - right) * (corner & 2 ? low : 1 - low), part[4];
        if (weight == 0)
            continue;
        sample_texel(texture, sampler, (int)left + (corner & 1), (int)top + (corner >> 1), part);
        for (int k = 0; k < 4; k++)
            color[k] += weight * part[k];
    }
}

unsigned texture_unpremultiply(unsigned byte, unsigned alpha) {
    unsigned plain = alpha > 0 ? (byte * 255 + alpha / 2) / alpha : byte;
    return plain < 255 ? plain : 255;
}

uint32_t texture_linear_pixel(uint32_t pixel) {
    uint32_t alpha = pixel >> 24, out = alpha << 24;
    for (unsigned k = 0; k < 24 && alpha > 0; k += 8)
        out |= (uint32_t)lrintf(texture_decode(texture_unpremultiply(pixel >> k & 255, alpha)) * (float)alpha) << k;
    return out;
}

void texture_linear_row(const Texture *texture, int y, uint32_t *row) {
    size_t start = (size_t)y * (size_t)texture->width;
    for (size_t x = 0; x < (size_t)texture->width; x++) {
        const float *color = texture->linear ? texture->linear + 4 * (start + x) : NULL;
        row[x] = 0;
        for (unsigned k = 0; k < 4; k++) {
            unsigned shift = k < 3 ? 16 - 8 * k : 24, byte = color ? 0 : texture->bytes[start + x] >> shift & 255;
            float c = color ? color[k] : k < 3 ? texture_decode(byte) : (float)byte / 255;
            row[x] |= (uint32_t)lrintf(255 * (c > 0 ? c < 1 ? c : 1 : 0)) << shift;
        }
    }
}

void texture_copy_linear(const Texture *bytes, float *linear) {
    size_t count = (size_t)bytes->width * (size_t)bytes->height;
    for (size_t i = 0; i < count; i++)
        for (unsigned k = 0; k < 4; k++)
            linear[4 * i + k] = (float)(bytes->bytes[i] >> (k < 3 ? 16 - 8 * k : 24) & 255) / 255;
}

Texture *texture_from_linear_bytes(Budget *budget, const Texture *bytes) {
    Texture *texture = texture_new(budget, bytes->width, bytes->height, true);
    if (texture)
        texture_copy_linear(bytes, texture->linear);
    return texture;
}
