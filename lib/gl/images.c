// images.c: pictures on the GPU; see gl.h.
#include "base/heap.h"
#include "gl/context.h"

#include <math.h>
#include <string.h>

static const struct {
    GLenum inner;
    size_t bytes; // bytes of a pixel
} formats[] = {
    [GL_FORMAT_SRGB8] = {GL_SRGB8_ALPHA8, 4},
    [GL_FORMAT_RGBA8] = {GL_RGBA8, 4},
    [GL_FORMAT_RGBA16F] = {GL_RGBA16F, 8},
    [GL_FORMAT_RGBA32F] = {GL_RGBA32F, 16},
};

size_t gl_pixel_size(GlFormat format) {
    return formats[format].bytes;
}

static size_t size_of(GlImage image) {
    return (size_t)image.width * (size_t)image.height * formats[image.format].bytes;
}

GlFormat gl_format(const Gl *gl, int bits) {
    if (bits == 32 && gl->floats && gl->float_filter)
        return GL_FORMAT_RGBA32F;
    return bits >= 16 && gl->halves ? GL_FORMAT_RGBA16F : bits >= 16 ? GL_FORMAT_SRGB8 : GL_FORMAT_RGBA8;
}

static bool is_like(GlImage image, int width, int height, GlFormat format) {
    return image.width == width && image.height == height && image.format == format;
}

static void drop_oldest(Gl *gl) {
    glDeleteTextures(1, &gl->spare[0].texture);
    memmove(gl->spare, gl->spare + 1, (size_t)--gl->spare_count * sizeof *gl->spare);
}

// Frees spare images, oldest first, until their total size fits into the budget's remaining memory. Spare images are
// not charged to the budget.
static void free_spare(Gl *gl) {
    size_t spare = 0;
    for (int i = 0; i < gl->spare_count; i++)
        spare += size_of(gl->spare[i]);
    while (gl->budget && gl->spare_count > 0 && spare > budget_memory_left(gl->budget)) {
        spare -= size_of(gl->spare[0]);
        drop_oldest(gl);
    }
}

GlImage gl_image_new(Gl *gl, int width, int height, GlFormat format) {
    GlImage image = {.width = width, .height = height, .format = format};
    if (!budget_reserve(gl->budget, size_of(image)))
        return image;
    for (int i = gl->spare_count; i-- > 0;)
        if (is_like(gl->spare[i], width, height, format)) {
            image = gl->spare[i];
            gl->spare[i] = gl->spare[--gl->spare_count];
            return image;
        }
    free_spare(gl);
    while (glGetError() != GL_NO_ERROR)
        ;
    glGenTextures(1, &image.texture);
    glBindTexture(GL_TEXTURE_2D, image.texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, formats[format].inner, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (glGetError() != GL_NO_ERROR) {
        glDeleteTextures(1, &image.texture);
        budget_release(gl->budget, size_of(image));
        image.texture = 0;
    }
    return image;
}

void gl_image_free(Gl *gl, GlImage image) {
    if (!image.texture)
        return;
    budget_release(gl->budget, size_of(image));
    if (gl->spare_count == GL_SPARE_IMAGES)
        drop_oldest(gl);
    gl->spare[gl->spare_count++] = image;
}

void gl_images_close(Gl *gl) {
    while (gl->spare_count > 0)
        glDeleteTextures(1, &gl->spare[--gl->spare_count].texture);
}

void gl_upload_bytes(Gl *gl, GlImage image, const uint32_t *pixels) {
    (void)gl;
    size_t width = (size_t)image.width;
    unsigned char *row = heap_alloc(width * 4);
    glBindTexture(GL_TEXTURE_2D, image.texture);
    for (int y = 0; row && y < image.height; y++) {
        const uint32_t *from = pixels + (size_t)(image.height - 1 - y) * width;
        for (size_t x = 0; x < width; x++) {
            row[4 * x] = (unsigned char)(from[x] >> 16);
            row[4 * x + 1] = (unsigned char)(from[x] >> 8);
            row[4 * x + 2] = (unsigned char)from[x];
            row[4 * x + 3] = (unsigned char)(from[x] >> 24);
        }
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, y, image.width, 1, GL_RGBA, GL_UNSIGNED_BYTE, row);
    }
    heap_free(row);
}

void gl_upload_linear(Gl *gl, GlImage image, const float *pixels) {
    (void)gl;
    glBindTexture(GL_TEXTURE_2D, image.texture);
    for (int y = 0; y < image.height; y++)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, y, image.width, 1, GL_RGBA, GL_FLOAT,
                        pixels + (size_t)(image.height - 1 - y) * (size_t)image.width * 4);
}

void gl_target(Gl *gl, GlImage image) {
    glBindFramebuffer(GL_FRAMEBUFFER, gl->framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, image.texture, 0);
    glViewport(0, 0, image.width, image.height);
}

bool gl_read_bytes(Gl *gl, GlImage image, uint32_t *pixels) {
    size_t width = (size_t)image.width;
    gl->readback_count++;
    gl_target(gl, image);
    glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (size_t i = 0; i < width * (size_t)image.height; i++) {
        unsigned char c[4];
        memcpy(c, pixels + i, 4);
        pixels[i] = (uint32_t)c[3] << 24 | (uint32_t)c[0] << 16 | (uint32_t)c[1] << 8 | c[2];
    }
    for (int y = 0; y < image.height / 2; y++)
        for (size_t x = 0; x < width; x++) {
            uint32_t *one = pixels + (size_t)y * width + x,
                     *other = pixels + (size_t)(image.height - 1 - y) * width + x;
            uint32_t swapped = *one;
            *one = *other;
            *other = swapped;
        }
    return glGetError() == GL_NO_ERROR;
}

bool gl_read_linear(Gl *gl, GlImage image, float *pixels) {
    gl->readback_count++;
    gl_target(gl, image);
    for (int y = 0; y < image.height; y++)
        glReadPixels(0, image.height - 1 - y, image.width, 1, GL_RGBA, GL_FLOAT,
                     pixels + (size_t)y * (size_t)image.width * 4);
    return glGetError() == GL_NO_ERROR;
}

uint64_t gl_readback_count(const Gl *gl) {
    return gl->readback_count;
}
