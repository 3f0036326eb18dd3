// test_draw_canvas.c: compares single pixels of canvases with the formulas of spec canvas.md: composite modes, linear
// light, gradients and text positions.
#include "drawing.h"

#include <math.h>

enum { SIDE = 8 };

typedef double Colour[4]; // channels are premultiplied by alpha

static void assert_near(const char *what, uint32_t pixel, const Colour wanted, int tolerance) {
    for (unsigned k = 0; k < 4; k++) {
        int found = (int)(pixel >> (k < 3 ? 16 - 8 * k : 24) & 255);
        if (fabs(found - 255 * wanted[k]) > tolerance)
            fail_msg("%s: channel %u is %d, not %.2f", what, k, found, 255 * wanted[k]);
    }
}

// Returns the blend function B(s, d) of a channel; sa and da are the alphas.
static double combine_channel(const char *mode, double s, double sa, double d, double da) {
    double c = sa > 0 ? s / sa : 0, b = da > 0 ? d / da : 0, mixed;
    if (!strcmp(mode, "clear"))
        return 0;
    if (!strcmp(mode, "source"))
        return s;
    if (!strcmp(mode, "dest"))
        return d;
    if (!strcmp(mode, "over"))
        return s + d * (1 - sa);
    if (!strcmp(mode, "dest_over"))
        return d + s * (1 - da);
    if (!strcmp(mode, "in"))
        return s * da;
    if (!strcmp(mode, "dest_in"))
        return d * sa;
    if (!strcmp(mode, "out"))
        return s * (1 - da);
    if (!strcmp(mode, "dest_out"))
        return d * (1 - sa);
    if (!strcmp(mode, "atop"))
        return s * da + d * (1 - sa);
    if (!strcmp(mode, "dest_atop"))
        return d * sa + s * (1 - da);
    if (!strcmp(mode, "xor"))
        return s * (1 - da) + d * (1 - sa);
    if (!strcmp(mode, "add"))
        return fmin(s + d, 1);
    if (!strcmp(mode, "modulate"))
        return s * d;
    if (!strcmp(mode, "screen"))
        return s + d - s * d;
    if (!strcmp(mode, "multiply"))
        mixed = c * b;
    else if (!strcmp(mode, "darken"))
        mixed = fmin(c, b);
    else if (!strcmp(mode, "lighten"))
        mixed = fmax(c, b);
    else if (!strcmp(mode, "difference"))
        mixed = fabs(c - b);
    else if (!strcmp(mode, "exclusion"))
        mixed = c + b - 2 * c * b;
    else if (!strcmp(mode, "color_dodge"))
        mixed = b == 0 ? 0 : c >= 1 ? 1 : fmin(1, b / (1 - c));
    else if (!strcmp(mode, "color_burn"))
        mixed = b >= 1 ? 1 : c <= 0 ? 0 : 1 - fmin(1, (1 - b) / c);
    else if (!strcmp(mode, "overlay"))
        mixed = b <= 0.5 ? 2 * b * c : 1 - 2 * (1 - b) * (1 - c);
    else
        mixed = c <= 0.5 ? 2 * b * c : 1 - 2 * (1 - b) * (1 - c); // hard_light
    return s * (1 - da) + d * (1 - sa) + sa * da * mixed;
}

static void test_blend_modes_match_formulas(void **state) {
    static const char *const modes[] = {
        "clear",    "source",  "dest",       "over",      "dest_over",   "in",         "dest_in", "out",
        "dest_out", "atop",    "dest_atop",  "xor",       "add",         "modulate",   "screen",  "multiply",
        "darken",   "lighten", "difference", "exclusion", "color_dodge", "color_burn", "overlay", "hard_light"};
    static const Colour s = {1, 0.6, 0.2, 0.6}, d = {0.2, 0.4, 0.8, 0.8}; // not premultiplied by alpha
    Player *player = *state;
    uint32_t pixels[SIDE * SIDE];
    char script[1000];
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        // The shape covers the left half, three quarters of column 4 and nothing on the right.
        snprintf(script, sizeof script,
                 "!offscreen size=8\n    !canvas\n        !rect size=8 fill=true color=0.2;0.4;0.8;0.8\n"
                 "        !rect size=4.75;8 fill=true color=1;0.6;0.2;0.6 composite=:%s\n",
                 modes[i]);
        draw_script(player, script, pixels, SIDE, SIDE);
        Colour inside, edge, outside;
        for (int k = 0; k < 4; k++) {
            double source = k < 3 ? s[k] * s[3] : s[3], dest = k < 3 ? d[k] * d[3] : d[3];
            bool blended = !strcmp(modes[i], "add") || !strcmp(modes[i], "modulate") || k < 3;
            inside[k] = combine_channel(blended || i <= 12 ? modes[i] : "over", source, s[3], dest, d[3]);
            edge[k] = 0.75 * inside[k] + 0.25 * dest;
            outside[k] = dest;
        }
        assert_near(modes[i], pixels[SIDE + 2], inside, 2);
        if (strcmp(modes[i], "add") != 0) // Cairo clamps after applying the coverage, which only makes pixels darker
            assert_near(modes[i], pixels[SIDE + 4], edge, 3);
        assert_near(modes[i], pixels[SIDE + 6], outside, 1);
    }
}

// Like test_blend_modes_match_formulas, but for strokes. The code that restricts these modes to the drawn area is not
// the same as for fills.
static void test_stroke_modes(void **state) {
    static const char *const modes[] = {"in", "out", "dest_in", "dest_atop", "modulate"};
    Player *player = *state;
    uint32_t pixels[SIDE * SIDE];
    char script[1000];
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        snprintf(script, sizeof script,
                 "!offscreen size=8\n    !canvas\n        !rect size=8 fill=true color=0.2;0.4;0.8;0.8\n"
                 "        !line points=0;3;8;3 stroke=true stroke_width=4 color=1;0.6;0.2;0.6 composite=:%s\n",
                 modes[i]);
        draw_script(player, script, pixels, SIDE, SIDE);
        Colour wanted = {
            combine_channel(modes[i], 0.6, 0.6, 0.16, 0.8), combine_channel(modes[i], 0.36, 0.6, 0.32, 0.8),
            combine_channel(modes[i], 0.12, 0.6, 0.64, 0.8), combine_channel(modes[i], 0.6, 0.6, 0.8, 0.8)};
        assert_near(modes[i], pixels[3 * SIDE + 4], wanted, 2);
        assert_near(modes[i], pixels[7 * SIDE + 4], (Colour){0.16, 0.32, 0.64, 0.8}, 1);
    }
}

static double srgb_encode(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

// Each draw adds a whole number of byte levels of linear light: 0.01 adds three, and 0.006 adds two (1.5 rounded up).
static void test_linear_light_adds_whole_bytes(void **state) {
    Player *player = *state;
    uint32_t pixels[SIDE * SIDE];
    draw_script(player,
                "!window size=8\n    !canvas linear=true composite=:add\n        for i in ..20\n"
                "            !rect size=8 fill=true color=0.01;0.006;0.01\n",
                pixels, SIDE, SIDE);
    assert_near("linear", pixels[9],
                (Colour){srgb_encode(60.0 / 255), srgb_encode(40.0 / 255), srgb_encode(60.0 / 255), 1}, 1);
}

static void test_paint_gives_expected_pixel(void **state) {
    Player *player = *state;
    uint32_t pixels[SIDE * SIDE];
    static const struct {
        const char *name;
        const char *nodes; // inside a canvas
        Colour wanted;     // pixel at 4;4, whose centre is at 4.5;4.5
    } rows[] = {
        {"default colour is black", "        !rect size=8 fill=true\n", {0, 0, 0, 1}},
        {"0.3 is 76.5 of 255", "        !rect size=8 fill=true color=0.3\n", {0.3, 0.3, 0.3, 1}},
        {"fill and stroke are one shape",
         "        !rect point=2;2 size=4 fill=true stroke=true stroke_width=8 color=1;0;0;0.5\n",
         {0.5, 0, 0, 0.5}},
        {"negative size", "        !rect point=8;8 size=-8;-8 fill=true color=0;1;0\n", {0, 1, 0, 1}},
        {"not premultiplied",
         "        !gradient start=0;0 end=9;0\n            !stop color=1;0;0;1\n            !stop color=0;0;1;0\n"
         "        !rect size=8 fill=true\n",
         {0.25, 0, 0.25, 0.5}},
        {"alpha of a gradient",
         "        !group color=0;0;0;0.5\n            !gradient start=0;0 end=9;0\n                !stop color=1;0;0\n"
         "                !stop color=0;0;1\n            !rect size=8 fill=true\n",
         {0.25, 0, 0.25, 0.5}},
        {"ellipse",
         "        !gradient point=4.5;0.5 radius=1;8 rotate=0\n            !stop color=0\n            !stop color=1\n"
         "        !rect size=8 fill=true\n",
         {0.5, 0.5, 0.5, 1}},
        {"alpha of a layer",
         "        !layer size=8 alpha=0.5\n            !rect size=8 fill=true color=1\n",
         {127 / 255.0, 127 / 255.0, 127 / 255.0, 127 / 255.0}},
        {"blend by ratio",
         "        !blend ratio=0.25\n            !color color=1;0;0\n            !color color=0;0;1\n"
         "        !rect size=8 fill=true\n",
         {0.75, 0, 0.25, 1}},
        {"arc of a whole turn is empty",
         "        !arc point=4;4 radius=4 sweep=1\n        !fill color=1\n",
         {0, 0, 0, 0}},
        {"sweep before end",
         "        !arc point=4;4 radius=9 start=0 sweep=0.25 end=0.1\n        !line_to point=4;4\n        !fill "
         "color=1\n",
         {1, 1, 1, 1}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char script[1000];
        snprintf(script, sizeof script, "!offscreen size=8\n    !canvas\n%s", rows[i].nodes);
        draw_script(player, script, pixels, SIDE, SIDE);
        assert_near(rows[i].name, pixels[4 * SIDE + 4], rows[i].wanted, 2);
    }
}

// Position of a text (section 8.1): the drawn pixels are centred on the point. Their exact extent is checked only if
// Liberation Sans is installed. Otherwise the text has another font, such as DejaVu Sans, which the tests require.
static void test_text_ink_is_at_point(void **state) {
    enum { WIDTH = 1280, HEIGHT = 720 };
    static uint32_t pixels[WIDTH * HEIGHT];
    Player *player = *state;
    draw_script(player,
                "!window size=1280;720\n    !canvas\n        !text text=\"Hello world!\" point=640;360 font_size=100 "
                "font_family=\"Liberation Sans\" color=1\n",
                pixels, WIDTH, HEIGHT);
    int left = WIDTH, right = 0, top = HEIGHT, bottom = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        if ((pixels[i] & 255) > 8) {
            int x = i % WIDTH, y = i / WIDTH;
            left = x < left ? x : left;
            right = x > right ? x : right;
            top = y < top ? y : top;
            bottom = y > bottom ? y : bottom;
        }
    assert_true(abs(left + right + 1 - WIDTH) <= 1 && abs(top + bottom + 1 - HEIGHT) <= 1);
    FILE *font = fopen("/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf", "rb");
    if (!font)
        skip();
    fclose(font);
    assert_true(abs(left - 386) <= 1 && abs(right - 893) <= 1 && abs(top - 322) <= 1 && abs(bottom - 397) <= 1);
}

// Layers that are nested too deeply are drawn directly, with a warning.
static void test_deep_layers_are_drawn(void **state) {
    Player *player = *state;
    uint32_t pixels[SIDE * SIDE];
    draw_script(player,
                "func nest(n)\n    if n > 0\n        !layer size=8\n            nest(n-1)\n    else\n"
                "        !rect size=8 fill=true color=1;0;0\n!window size=8\n    !canvas\n        nest(70)\n",
                pixels, SIDE, SIDE);
    assert_near("deep", pixels[9], (Colour){1, 0, 0, 1}, 0);
}

TEST_GROUP(draw_canvas) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_blend_modes_match_formulas),    PLAYER_TEST(test_stroke_modes),
        PLAYER_TEST(test_linear_light_adds_whole_bytes), PLAYER_TEST(test_paint_gives_expected_pixel),
        PLAYER_TEST(test_text_ink_is_at_point),          PLAYER_TEST(test_deep_layers_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
