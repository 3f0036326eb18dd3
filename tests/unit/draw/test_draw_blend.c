// test_draw_blend.c: tests the formulas of composite_list.h by laws that hold between modes.
#include "check.h"
#include "picture/blend.h"

// Colours with all combinations of transparent, half transparent and opaque alpha, and of dark and bright channels.
enum { COLOURS = 27 };
static void set_colour(int number, float out[4]) {
    out[3] = (float)(number % 3) / 2;
    for (int k = 0; k < 3; k++)
        out[k] = out[3] * (float)((number / 3 + 4 * k) % 9) / 8;
}

static const struct {
    CompositeMode mode;
    CompositeMode swapped;
} pairs[] = {
    {COMPOSITE_SRC, COMPOSITE_DST},           {COMPOSITE_OVER, COMPOSITE_DST_OVER},
    {COMPOSITE_IN, COMPOSITE_DST_IN},         {COMPOSITE_OUT, COMPOSITE_DST_OUT},
    {COMPOSITE_ATOP, COMPOSITE_DST_ATOP},     {COMPOSITE_OVERLAY, COMPOSITE_HARD_LIGHT},
    {COMPOSITE_XOR, COMPOSITE_XOR},           {COMPOSITE_ADD, COMPOSITE_ADD},
    {COMPOSITE_MULTIPLY, COMPOSITE_MULTIPLY}, {COMPOSITE_SCREEN, COMPOSITE_SCREEN},
    {COMPOSITE_DARKEN, COMPOSITE_DARKEN},     {COMPOSITE_DIFFERENCE, COMPOSITE_DIFFERENCE},
    {COMPOSITE_LIGHTEN, COMPOSITE_LIGHTEN},   {COMPOSITE_EXCLUSION, COMPOSITE_EXCLUSION},
    {COMPOSITE_CLEAR, COMPOSITE_CLEAR},       {COMPOSITE_MODULATE, COMPOSITE_MODULATE},
};

static void test_swapped_colours_give_the_swapped_mode(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        for (int n = 0; n < COLOURS * COLOURS; n++) {
            float a[4], b[4], one[4], other[4];
            set_colour(n % COLOURS, a);
            set_colour(n / COLOURS, b);
            blend_colors(pairs[i].mode, a, b, one);
            blend_colors(pairs[i].swapped, b, a, other);
            for (int k = 0; k < 4; k++)
                assert_float_equal(one[k], other[k], 1e-6f);
        }
}

static void test_transparent_source_changes_nothing_in_bounded_modes(void **state) {
    (void)state;
    for (int mode = 0; mode < COMPOSITE_COUNT; mode++) {
        bool kept = true;
        for (int n = 0; n < COLOURS; n++) {
            const float nothing[4] = {0};
            float d[4], out[4];
            set_colour(n, d);
            blend_colors((CompositeMode)mode, nothing, d, out);
            for (int k = 0; k < 4; k++)
                kept = kept && fabsf(out[k] - d[k]) < 1e-6f;
        }
        assert_int_equal(kept, blend_is_bounded((CompositeMode)mode));
    }
}

static void test_modes_of_opaque_colours_keep_them_opaque(void **state) {
    (void)state;
    for (int mode = COMPOSITE_MULTIPLY; mode < COMPOSITE_COUNT; mode++)
        for (int n = 0; n < COLOURS * COLOURS; n++) {
            float s[4], d[4], out[4];
            set_colour(n % COLOURS / 3 * 3 + 2, s);
            set_colour(n / COLOURS / 3 * 3 + 2, d);
            blend_colors((CompositeMode)mode, s, d, out);
            assert_float_equal(out[3], 1, 1e-6f);
            for (int k = 0; k < 3; k++)
                assert_true(out[k] >= -1e-6f && out[k] <= 1 + 1e-6f);
        }
}

TEST_GROUP(draw_blend) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_swapped_colours_give_the_swapped_mode),
        cmocka_unit_test(test_transparent_source_changes_nothing_in_bounded_modes),
        cmocka_unit_test(test_modes_of_opaque_colours_keep_them_opaque),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
