// test_draw_encode.c: PNG files have the pixels that were encoded, whatever these are.
#include "base/heap.h"
#include "cairo/encode.h"
#include "check.h"

#include <png.h>
#include <stdlib.h>

typedef uint32_t PixelAt(uint64_t *seed, int x, int y);

static uint32_t random_pixel(uint64_t *seed, int x, int y) {
    (void)x;
    (void)y;
    return (uint32_t)(next_bits(seed) >> 32);
}

static uint32_t gradient(uint64_t *seed, int x, int y) {
    (void)seed;
    return 0xff000000u | (uint32_t)(x & 255) << 16 | (uint32_t)(y & 255) << 8 | (uint32_t)((x + y) & 255);
}

static uint32_t sparse(uint64_t *seed, int x, int y) {
    (void)x;
    (void)y;
    return next_bits(seed) % 97 ? 0xff102030u : (uint32_t)(next_bits(seed) >> 32);
}

static void check_file(PixelAt *pixel_at, int width, int height, bool alpha) {
    uint64_t seed = 1;
    size_t count = (size_t)width * (size_t)height;
    uint32_t *pixels = malloc(count * sizeof *pixels);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            pixels[y * width + x] = pixel_at(&seed, x, y);
    Encoded file = {0};
    assert_true(encode_png_pixels(&file, pixels, width, height, alpha));
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&image, file.bytes, file.length));
    image.format = PNG_FORMAT_RGBA;
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    unsigned char *read = malloc(PNG_IMAGE_SIZE(image));
    assert_true(png_image_finish_read(&image, NULL, read, 0, NULL));
    for (size_t i = 0; i < count; i++) {
        const unsigned char *c = read + 4 * i;
        uint32_t found = (uint32_t)c[3] << 24 | (uint32_t)c[0] << 16 | (uint32_t)c[1] << 8 | c[2];
        uint32_t wanted = alpha ? pixels[i] : pixels[i] | 0xff000000u;
        if (found != wanted)
            fail_msg("pixel %zu of %d x %d is %08x, not %08x", i, width, height, found, wanted);
    }
    free(read);
    free(pixels);
    heap_free(file.bytes);
}

static void test_png_has_the_pixels(void **state) {
    (void)state;
    static PixelAt *const pictures[] = {random_pixel, gradient, sparse};
    static const int sizes[][2] = {{1, 1}, {1, 300}, {300, 1}, {7, 5}, {333, 77}, {1024, 40}};
    for (size_t i = 0; i < COUNT_OF(pictures); i++)
        for (size_t k = 0; k < COUNT_OF(sizes); k++)
            for (int alpha = 0; alpha < 2; alpha++)
                check_file(pictures[i], sizes[k][0], sizes[k][1], alpha);
}

TEST_GROUP(draw_encode) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_png_has_the_pixels)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
