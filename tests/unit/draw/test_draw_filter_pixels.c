// test_draw_filter_pixels.c: tests of the public functions that compute the pixels of noise and filters.
#include "check.h"
#include "petri-draw.h"

enum { SIDE = 8 };
static const double IDENTITY[6] = {1, 0, 0, 1, 0, 0}, DOUBLE[6] = {2, 0, 0, 2, 0, 0};

// Draws a filter on a picture with one red pixel at 3, 3. `host` is passed to the paint callback.
static PetriStatus draw(const double *filter, size_t count, PetriPaintCallback *paint, uint32_t pixels[SIDE * SIDE]) {
    memset(pixels, 0, SIDE * SIDE * sizeof *pixels);
    pixels[3 * SIDE + 3] = 0xffff0000;
    return petri_filter_draw(filter, count, IDENTITY, pixels, SIDE, SIDE, paint, NULL);
}

#define DRAW(paint, pixels, ...)                                                                                       \
    draw((const double[]){__VA_ARGS__}, sizeof((const double[]){__VA_ARGS__}) / sizeof(double), paint, pixels)

static void test_offset_moves_the_drawing(void **state) {
    (void)state;
    uint32_t pixels[SIDE * SIDE];
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_OFFSET, 2, 1, PETRI_FILTER_SOURCE), PETRI_OK);
    assert_int_equal(pixels[4 * SIDE + 5], 0xffff0000);
    assert_int_equal(pixels[3 * SIDE + 3], 0);
}

static void test_shadow_lies_below_the_drawing(void **state) {
    (void)state;
    uint32_t pixels[SIDE * SIDE];
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_SHADOW, 0, 0, 1, 0, 0, 0, 1, 1, 0, PETRI_FILTER_SOURCE), PETRI_OK);
    assert_int_equal(pixels[3 * SIDE + 3], 0xffff0000);
    assert_int_equal(pixels[3 * SIDE + 4], 0xff0000ff);
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_SHADOW, 0, 0, 1, 0, 0, 0, 1, 1, 1, PETRI_FILTER_SOURCE), PETRI_OK);
    assert_int_equal(pixels[3 * SIDE + 3], 0);
}

static void test_dilate_enlarges_and_matrix_recolours(void **state) {
    (void)state;
    uint32_t pixels[SIDE * SIDE];
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_COLOUR_MATRIX, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                          0, 1, 0, PETRI_FILTER_DILATE, 1, 1, PETRI_FILTER_SOURCE),
                     PETRI_OK);
    for (int y = 1; y < SIDE; y++)
        for (int x = 1; x < SIDE; x++)
            assert_int_equal(pixels[y * SIDE + x], x >= 2 && x <= 4 && y >= 2 && y <= 4 ? 0xff00ff00 : 0);
}

// Fills the picture with green, if the commands are those of the test.
static bool fill_green(void *user_data, const double *commands, size_t count, uint32_t *pixels) {
    (void)user_data;
    for (int i = 0; i < SIDE * SIDE; i++)
        pixels[i] = 0xff00ff00;
    return count == 2 && commands[0] == 7 && commands[1] == 8;
}

static void test_blend_composites_the_first_filter(void **state) {
    (void)state;
    uint32_t pixels[SIDE * SIDE];
    // Multiplies the red pixel by green. Elsewhere, the paint is shown.
    assert_int_equal(
        DRAW(fill_green, pixels, PETRI_FILTER_BLEND, 14, 0, 0, 0, 0, PETRI_FILTER_PAINT, 2, 7, 8, PETRI_FILTER_SOURCE),
        PETRI_OK);
    assert_int_equal(pixels[3 * SIDE + 3], 0xff000000);
    assert_int_equal(pixels[0], 0xff00ff00);
    // With factors: the sum of both.
    assert_int_equal(
        DRAW(fill_green, pixels, PETRI_FILTER_BLEND, -1, 0, 1, 1, 0, PETRI_FILTER_PAINT, 2, 7, 8, PETRI_FILTER_SOURCE),
        PETRI_OK);
    assert_int_equal(pixels[3 * SIDE + 3], 0xffffff00);
    assert_int_equal(DRAW(fill_green, pixels, PETRI_FILTER_PAINT, 2, 7, 9), // fill_green rejects these commands
                     PETRI_INVALID);
}

static bool accept_all(void *user_data, const double *commands, size_t count, uint32_t *pixels) {
    (void)user_data, (void)commands, (void)count, (void)pixels;
    return true;
}

static void test_invalid_filters_are_rejected(void **state) {
    (void)state;
    uint32_t pixels[SIDE * SIDE];
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_SOURCE + 1), PETRI_INVALID);
    assert_int_equal(DRAW(NULL, pixels, 0.0 / 0.0), PETRI_INVALID);
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_BLUR, 1), PETRI_INVALID);
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_PAINT, 5, 0), PETRI_INVALID);
    assert_int_equal(DRAW(accept_all, pixels, PETRI_FILTER_PAINT, 0), PETRI_OK);
    assert_int_equal(DRAW(accept_all, pixels, PETRI_FILTER_PAINT, 5, 0), PETRI_INVALID);
    assert_int_equal(DRAW(accept_all, pixels, PETRI_FILTER_PAINT, -3), PETRI_INVALID);
    assert_int_equal(DRAW(accept_all, pixels, PETRI_FILTER_PAINT, 0.0 / 0.0), PETRI_INVALID);
    // A radius that an int cannot hold has no effect, or covers everything.
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_DILATE, -1e300, 1e300, PETRI_FILTER_SOURCE), PETRI_OK);
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_PAINT, 0), PETRI_INVALID); // there is no callback
    assert_int_equal(DRAW(NULL, pixels, PETRI_FILTER_BLEND, 99, 0, 0, 0, 0, PETRI_FILTER_SOURCE, PETRI_FILTER_SOURCE),
                     PETRI_INVALID);
    enum { DEPTH = 5000 };
    static double deep[3 * DEPTH + 1];
    for (int i = 0; i < DEPTH; i++)
        deep[3 * i] = PETRI_FILTER_OFFSET;
    deep[3 * DEPTH] = PETRI_FILTER_SOURCE;
    assert_int_equal(draw(deep, 3 * DEPTH + 1, NULL, pixels), PETRI_INVALID);
    // petri nests at most 100 filters.
    assert_int_equal(draw(deep + 3 * (DEPTH - 100), 301, NULL, pixels), PETRI_OK);
    assert_int_equal(draw(deep + 3 * (DEPTH - 101), 304, NULL, pixels), PETRI_INVALID);
    assert_int_equal(petri_filter_draw(deep, 1, IDENTITY, pixels, 1 << 20, 1 << 7, NULL, NULL), PETRI_INVALID);
    assert_int_equal(petri_filter_draw(deep, 1, IDENTITY, NULL, SIDE, SIDE, NULL, NULL), PETRI_INVALID);
    // petri nests at most 100 filters.
    assert_int_equal(draw(deep + 3 * (DEPTH - 100), 301, NULL, pixels), PETRI_OK);
    assert_int_equal(draw(deep + 3 * (DEPTH - 101), 304, NULL, pixels), PETRI_INVALID);
    assert_int_equal(petri_filter_draw(deep, 1, IDENTITY, pixels, 1 << 20, 1 << 7, NULL, NULL), PETRI_INVALID);
    assert_int_equal(petri_filter_draw(deep, 1, IDENTITY, pixels, 0, SIDE, NULL, NULL), PETRI_INVALID);
}

static void test_needs_are_in_pixels(void **state) {
    (void)state;
    PetriFilterNeeds needs;
    const double blur[] = {PETRI_FILTER_OFFSET, 1, 4, PETRI_FILTER_BLUR, 2, 3, PETRI_FILTER_SOURCE};
    assert_int_equal(petri_filter_measure(blur, 7, DOUBLE, &needs, sizeof needs), PETRI_OK);
    assert_true(needs.margin == 2 * 4 + 3 * 2 * 3 && !needs.everywhere);
    const double paint[] = {PETRI_FILTER_PAINT, 0}, longer[] = {PETRI_FILTER_PAINT, 5, 0};
    assert_int_equal(petri_filter_measure(longer, 3, DOUBLE, &needs, sizeof needs), PETRI_INVALID);
    assert_int_equal(petri_filter_measure(paint, 2, DOUBLE, &needs, sizeof needs), PETRI_OK);
    assert_true(needs.margin == 0 && needs.everywhere);
    needs.everywhere = true;
    assert_int_equal(petri_filter_measure(blur, 7, DOUBLE, &needs, offsetof(PetriFilterNeeds, everywhere)), PETRI_OK);
    assert_true(needs.margin == 2 * 4 + 3 * 2 * 3 && needs.everywhere); // an older host lacks the second field
    assert_int_equal(petri_filter_measure(blur, 6, DOUBLE, &needs, sizeof needs), PETRI_INVALID);
    assert_int_equal(petri_filter_measure(NULL, 0, DOUBLE, &needs, sizeof needs), PETRI_INVALID);
}

static void test_noise_repeats_in_tiles(void **state) {
    (void)state;
    static const double tiled[8] = {0.3, 0.2, 4, 4, 7, 2, 0, 1}, transparent[8] = {0.3, 0.2, 0, 0, 7, 2, 0, 0};
    uint32_t pixels[SIDE * SIDE], colours = 0;
    assert_int_equal(petri_noise_draw(tiled, IDENTITY, pixels, SIDE, SIDE), PETRI_OK);
    for (int i = 0; i < 4 * SIDE; i++) {
        assert_int_equal(pixels[i], pixels[i + 4 * SIDE]);
        assert_int_equal(pixels[i], pixels[i % SIDE < 4 ? i + 4 : i - 4]);
        colours += pixels[i] != pixels[0];
    }
    assert_true(colours > 4);
    assert_int_equal(petri_noise_draw(transparent, IDENTITY, pixels, SIDE, SIDE), PETRI_OK);
    assert_int_equal(pixels[5], 0);
    assert_int_equal(petri_noise_draw(NULL, IDENTITY, pixels, SIDE, SIDE), PETRI_INVALID);
    assert_int_equal(petri_noise_draw(tiled, IDENTITY, pixels, 1 << 20, 1 << 20), PETRI_INVALID);
}

TEST_GROUP(draw_filter_pixels) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_offset_moves_the_drawing),
        cmocka_unit_test(test_shadow_lies_below_the_drawing),
        cmocka_unit_test(test_dilate_enlarges_and_matrix_recolours),
        cmocka_unit_test(test_blend_composites_the_first_filter),
        cmocka_unit_test(test_invalid_filters_are_rejected),
        cmocka_unit_test(test_needs_are_in_pixels),
        cmocka_unit_test(test_noise_repeats_in_tiles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
