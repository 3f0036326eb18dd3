// test_canvas.c: compares each pixel of canvases with the formulas of canvas.md 4 to 7, computed with doubles.
#include "drawn.h"
#include "model.h"
#include "turbulence.h"

#include <math.h>

// Draws a canvas of 60 x 60. `inside` is its content, in lines that are indented by eight spaces.
static void draw_script(Drawn *drawn, const char *canvas, const char *inside) {
    char script[8000];
    snprintf(script, sizeof script, "!window size=60;60\n    !canvas %s\n%s", canvas, inside);
    drawn_open(drawn, script, 1);
    assert_string_equal(drawn->reported, "");
}

static void check_pixel(const Drawn *drawn, int x, int y, const double c[3], const char *what) {
    for (int k = 0; k < 3; k++) {
        int wanted = (int)lround(255 * fmin(fmax(c[k], 0), 1));
        if (abs(drawn_byte(drawn, x, y, k) - wanted) > 2)
            fail_msg("%s: channel %d at %d;%d is %d, not %d", what, k, x, y, drawn_byte(drawn, x, y, k), wanted);
    }
}

// Section 4: the blend modes of W3C's Compositing and Blending 1. Colours are not premultiplied.
typedef struct Blending {
    const char *word;
    double (*of)(double s, double d); // blend function of source s and destination d; NULL: `fs` and `fd` are used
    double fs[3];                     // the factor of s is fs[0] + fs[1]·dₐ, where dₐ is the alpha of d
    double fd[3];                     // the factor of d is fd[0] + fd[1]·sₐ, where sₐ is the alpha of s
} Blending;

static double multiply(double s, double d) {
    return s * d;
}
static double screen(double s, double d) {
    return 1 - (1 - s) * (1 - d);
}
static double hard(double s, double d) {
    return s <= 0.5 ? multiply(2 * s, d) : screen(2 * s - 1, d);
}
static double overlay(double s, double d) {
    return hard(d, s);
}
static double darken(double s, double d) {
    return s < d ? s : d;
}
static double lighten(double s, double d) {
    return s > d ? s : d;
}
static double dodge(double s, double d) {
    return d == 0 ? 0 : s == 1 ? 1 : fmin(1, d / (1 - s));
}
static double burn(double s, double d) {
    return d == 1 ? 1 : s == 0 ? 0 : 1 - fmin(1, (1 - d) / s);
}
static double soft(double s, double d) {
    double g = d <= 0.25 ? ((16 * d - 12) * d + 4) * d : sqrt(d);
    return s <= 0.5 ? d - (1 - 2 * s) * d * (1 - d) : d + (2 * s - 1) * (g - d);
}
static double difference(double s, double d) {
    return fabs(s - d);
}
static double exclusion(double s, double d) {
    return s + d - 2 * s * d;
}

static const Blending blendings[] = {
    {"clear", NULL, {0, 0}, {0, 0}},   {"source", NULL, {1, 0}, {0, 0}},     {"dest", NULL, {0, 0}, {1, 0}},
    {"over", NULL, {1, 0}, {1, -1}},   {"dest_over", NULL, {1, -1}, {1, 0}}, {"in", NULL, {0, 1}, {0, 0}},
    {"dest_in", NULL, {0, 0}, {0, 1}}, {"out", NULL, {1, -1}, {0, 0}},       {"dest_out", NULL, {0, 0}, {1, -1}},
    {"atop", NULL, {0, 1}, {1, -1}},   {"dest_atop", NULL, {1, -1}, {0, 1}}, {"xor", NULL, {1, -1}, {1, -1}},
    {"add", NULL, {1, 0}, {1, 0}},     {"multiply", multiply, {0}, {0}},     {"screen", screen, {0}, {0}},
    {"overlay", overlay, {0}, {0}},    {"darken", darken, {0}, {0}},         {"lighten", lighten, {0}, {0}},
    {"color_dodge", dodge, {0}, {0}},  {"color_burn", burn, {0}, {0}},       {"hard_light", hard, {0}, {0}},
    {"soft_light", soft, {0}, {0}},    {"difference", difference, {0}, {0}}, {"exclusion", exclusion, {0}, {0}},
};

// Blends colours with alpha (the last of the four numbers). The result is premultiplied.
static void blend(const Blending *how, const double s[4], const double d[4], double out[4]) {
    for (int k = 0; k < 4; k++) {
        double cs = k < 3 ? s[k] * s[3] : s[3], cd = k < 3 ? d[k] * d[3] : d[3];
        if (!how->of)
            out[k] = cs * (how->fs[0] + how->fs[1] * d[3]) + cd * (how->fd[0] + how->fd[1] * s[3]);
        else
            out[k] = k == 3 ? s[3] + d[3] - s[3] * d[3]
                            : cs * (1 - d[3]) + cd * (1 - s[3]) + s[3] * d[3] * how->of(s[k], d[k]);
    }
}

static const double above[4] = {0.9, 0.35, 0.2, 0.7}, below[4] = {0.3, 0.6, 0.95, 0.8};

// Tests modes on 8-bit and floating-point canvases, with fully and half covered pixels, and as filters.
static void test_blend_modes_match_model(void **state) {
    (void)state;
    static const char *const canvases[] = {"", "linear=true", "linear=true colorbits=32", "linear=true colorbits=16"};
    for (size_t i = 0; i < COUNT_OF(blendings) * COUNT_OF(canvases); i++) {
        const Blending *how = &blendings[i % COUNT_OF(blendings)];
        const char *canvas = canvases[i / COUNT_OF(blendings)];
        char inside[1000];
        double out[4], whole[3], half[3], cover = 0.5;
        Drawn drawn;
        snprintf(inside, sizeof inside,
                 "        !rect size=60 fill=true color=0.3;0.6;0.95;0.8\n"
                 "        !rect point=10;10 size=20.5;20 fill=true color=0.9;0.35;0.2;0.7 composite=:%s\n",
                 how->word);
        draw_script(&drawn, canvas, inside);
        blend(how, above, below, out);
        for (int k = 0; k < 3; k++) {
            whole[k] = out[k];
            half[k] = cover * out[k] + (1 - cover) * below[k] * below[3];
            if (*canvas) {
                whole[k] = model_enc(out[k]);
                half[k] = model_enc(half[k]);
            }
        }
        // Bytes in linear light are compared before encoding, which enlarges the rounding errors of dark colours.
        bool bytes = strcmp(canvas, "linear=true") == 0;
        if (!bytes) {
            check_pixel(&drawn, 20, 20, whole, how->word);
            check_pixel(&drawn, 30, 20, half, how->word);
        } else {
            for (int k = 0; k < 3; k++) {
                double light = model_lin(drawn_byte(&drawn, 20, 20, k) / 255.0);
                assert_true(fabs(light - fmin(fmax(out[k], 0), 1)) < 2.0 / 255);
            }
        }
        drawn_close(&drawn);
    }
}

// Section 6: `blend` as a filter. The first input is the destination d, the second the source s.
static void test_filter_blend(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(blendings); i++) {
        const Blending *how = &blendings[i];
        char inside[1000];
        double out[4];
        Drawn drawn;
        snprintf(inside, sizeof inside,
                 "        !blend mode=:%s\n            !source\n            !paint color=0.9;0.35;0.2;0.7\n"
                 "        !rect size=60 fill=true color=0.3;0.6;0.95;0.8\n",
                 how->word);
        draw_script(&drawn, "", inside);
        blend(how, above, below, out);
        for (int k = 0; k < 3; k++)
            out[k] = fmin(out[k], fmin(out[3], 1));
        check_pixel(&drawn, 20, 20, out, how->word);
        drawn_close(&drawn);
    }
    // These four modes mix channels. On 8-bit canvases, Cairo's results are accepted.
    static const char *const whole[] = {"hue", "saturation", "color", "luminosity"};
    for (size_t i = 0; i < 2 * COUNT_OF(whole); i++) {
        const char *word = whole[i / 2], *s = i % 2 ? "1;0.9;0.1" : "0.1;0.35;0.9";
        char inside[1000];
        Drawn drawn;
        snprintf(
            inside, sizeof inside,
            "        !group\n            !blend mode=:%s\n                !source\n                !paint color=%s\n"
            "            !rect size=30;60 fill=true color=0.95;0.6;0.3\n"
            "        !rect point=30;0 size=30;60 fill=true color=0.95;0.6;0.3\n"
            "        !rect point=30;0 size=30;60 fill=true color=%s composite=:%s\n",
            word, s, s, word);
        draw_script(&drawn, "", inside);
        double right[3];
        for (int k = 0; k < 3; k++)
            right[k] = drawn_byte(&drawn, 45, 20, k) / 255.0;
        check_pixel(&drawn, 15, 20, right, word);
        drawn_close(&drawn);
    }
    static const struct {
        const char *attrs;
        double k[4];
    } sums[] = {{"ratio=0.25", {0, 0.75, 0.25, 0}},
                {"coefficients=0.5;0.25;0.4;-0.05", {0.5, 0.25, 0.4, -0.05}},
                {"coefficients=0;1;1;0.5", {0, 1, 1, 0.5}}};
    for (size_t i = 0; i < COUNT_OF(sums); i++) {
        char inside[1000];
        double out[4];
        Drawn drawn;
        snprintf(inside, sizeof inside,
                 "        !blend %s\n            !source\n            !paint color=0.9;0.35;0.2;0.7\n"
                 "        !rect size=60 fill=true color=0.3;0.6;0.95;0.8\n",
                 sums[i].attrs);
        draw_script(&drawn, "", inside);
        for (int c = 3; c >= 0; c--) {
            double s = c < 3 ? above[c] * above[3] : above[3], d = c < 3 ? below[c] * below[3] : below[3];
            out[c] = sums[i].k[0] * s * d + sums[i].k[1] * s + sums[i].k[2] * d + sums[i].k[3];
            out[c] = fmin(fmax(out[c], 0), c == 3 ? 1 : out[3]);
        }
        check_pixel(&drawn, 20, 20, out, sums[i].attrs);
        drawn_close(&drawn);
    }
}

// Section 6.2, with the matrices given there.
static void test_color_matrix(void **state) {
    (void)state;
    static const struct {
        const char *attrs;
        double m[4][5];
        double bcs[3]; // brightness, contrast, saturation; used if the matrix is all 0
    } cases[] = {
        {"matrix=0;1;0;0;0;0;0;1;0;0.1;1;0;0;0;0;0;0;0.5;0.5;0",
         {{0, 1, 0, 0, 0}, {0, 0, 1, 0, 0.1}, {1, 0, 0, 0, 0}, {0, 0, 0.5, 0.5, 0}},
         {0}},
        {"red=0.5;0.5;0;0;0.1 alpha=0;0;0;2;-0.5 saturation=0 scale=3",
         {{0.5, 0.5, 0, 0, 0.1}, {0, 1, 0, 0, 0}, {0, 0, 1, 0, 0}, {0, 0, 0, 2, -0.5}},
         {0}},
        {"scale=0.5;1;2 offset=0.2;-0.1;0 contrast=3",
         {{0.5, 0, 0, 0, 0.2}, {0, 1, 0, 0, -0.1}, {0, 0, 2, 0, 0}, {0, 0, 0, 1, 0}},
         {0}},
        {"offset=0.1", {{1, 0, 0, 0, 0.1}, {0, 1, 0, 0, 0.1}, {0, 0, 1, 0, 0.1}, {0, 0, 0, 1, 0}}, {0}},
        {"brightness=0.1 contrast=1.5 saturation=0.4", {{0}}, {0.1, 1.5, 0.4}},
        {"saturation=0", {{0}}, {0, 1, 0}},
        {"contrast=0.5", {{0}}, {0, 0.5, 1}},
        {"", {{0}}, {0, 1, 1}},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char inside[1000];
        double out[4], one[5] = {below[0], below[1], below[2], below[3], 1};
        Drawn drawn;
        snprintf(inside, sizeof inside,
                 "        !color_matrix %s\n        !rect size=60 fill=true color=0.3;0.6;0.95;0.8\n", cases[i].attrs);
        draw_script(&drawn, "", inside);
        for (int row = 0; row < 4; row++) {
            const double *bcs = cases[i].bcs;
            out[row] = 0;
            for (int k = 0; k < 5; k++)
                out[row] += cases[i].m[row][k] * one[k];
            if (bcs[1] > 0) // the case gives brightness, contrast and saturation
                out[row] =
                    row == 3 ? one[3]
                             : bcs[1] * (bcs[2] * one[row] + (1 - bcs[2]) * model_lum(one)) + bcs[0] + (1 - bcs[1]) / 2;
            out[row] = fmin(fmax(out[row], 0), 1);
        }
        for (int k = 0; k < 3; k++)
            out[k] *= out[3];
        check_pixel(&drawn, 20, 20, out, cases[i].attrs);
        drawn_close(&drawn);
    }
}

// The blurred image of a bar from 20 to 40 is the difference of two error functions, for small and large radii.
static void test_blurred_bar_is_a_difference_of_error_functions(void **state) {
    (void)state;
    static const double sigmas[] = {0.5, 1, 3, 7.9, 8.1, 12, 20, 40};
    for (size_t i = 0; i < COUNT_OF(sigmas); i++)
        for (int across = 0; across < 2; across++) {
            char inside[1000];
            Drawn drawn;
            snprintf(inside, sizeof inside,
                     "        !blur radius=%s%g%s\n        !rect point=%s size=%s fill=true color=1\n",
                     across ? "0;" : "", sigmas[i], across ? "" : ";0", across ? "-500;20" : "20;-500",
                     across ? "1000;20" : "20;1000");
            draw_script(&drawn, "", inside);
            for (int x = 0; x < 60; x++) {
                double at = x + 0.5, part = sigmas[i] * sqrt(2);
                double light = (erf((at - 20) / part) - erf((at - 40) / part)) / 2;
                // If the blur is small, the expected value is a sum over pixels, because each is an average.
                if (sigmas[i] < 2) {
                    double sum = 0, all = 0;
                    for (int k = -10; k <= 10; k++) {
                        double weight = exp(-k * k / (2 * sigmas[i] * sigmas[i]));
                        all += weight;
                        sum += x + k >= 20 && x + k < 40 ? weight : 0;
                    }
                    light = sum / all;
                }
                check_pixel(&drawn, across ? 30 : x, across ? x : 30, (double[]){light, light, light}, inside);
            }
            drawn_close(&drawn);
        }
}

// Shadows are blurred, offset, and drawn below the shape. Dilated boxes grow, and eroded boxes shrink.
static void test_shadow_offset_dilate_erode(void **state) {
    (void)state;
    Drawn drawn;
    draw_script(&drawn, "",
                "        !shadow radius=6;0 offset=10;4 color=0;1;0;0.5\n"
                "        !rect point=10;-500 size=20;530 fill=true color=1;0;0\n");
    for (int x = 0; x < 60; x++) {
        double part = 6 * sqrt(2), at = x + 0.5 - 10;
        double shade = 0.5 * (erf((at - 10) / part) - erf((at - 30) / part)) / 2;
        bool covered = x >= 10 && x < 30;
        check_pixel(&drawn, x, 20, (double[]){covered, covered ? 0 : shade, 0}, "shadow");
        check_pixel(&drawn, x, 32, (double[]){0, shade, 0}, "shadow below");
        check_pixel(&drawn, x, 36, (double[]){0, 0, 0}, "no shadow");
    }
    drawn_close(&drawn);
    for (int grows = 0; grows < 2; grows++)
        for (int r = 1; r < 9; r++) {
            char inside[300];
            int by = grows ? r : -r;
            snprintf(inside, sizeof inside,
                     "        !%s radius=%d;2\n        !rect point=20;20 size=17;20 fill=true color=0.2;0.4;1\n",
                     grows ? "dilate" : "erode", r);
            draw_script(&drawn, "", inside);
            for (int x = 0; x < 60; x++) {
                int high = grows ? 2 : -2, y = 20 - high;
                double on = x >= 20 - by && x < 37 + by;
                check_pixel(&drawn, x, 30, (double[]){0.2 * on, 0.4 * on, on}, inside);
                check_pixel(&drawn, x, y, (double[]){0.2 * on, 0.4 * on, on}, inside);
                check_pixel(&drawn, x, y - 1, (double[]){0, 0, 0}, inside);
            }
            drawn_close(&drawn);
        }
}

// Section 1.5: sums of light are not clamped to 1. A layer halves them, and an image of the canvas preserves them.
static void test_hdr_light_is_not_clamped(void **state) {
    (void)state;
    static const char script[] = "!window size=60;60 alpha=0.125\n"
                                 "    !canvas linear=true colorbits=%d\n"
                                 "        !group composite=:add\n"
                                 "            for i in ..1000\n"
                                 "                !rect point=10;10 size=20.5;20 fill=true color=0.004;0.0005;0.002;1\n"
                                 "        !layer size=60;60 alpha=0.5\n"
                                 "            !rect point=40;10 size=10 fill=true color=4;8;12\n"
                                 "            !blur radius=0.01\n"
                                 "            !rect point=40;30 size=10 fill=true color=4;8;12\n";
    for (int bits = 16; bits <= 32; bits += 16) {
        char text[1000];
        Drawn drawn;
        snprintf(text, sizeof text, script, bits);
        drawn_open(&drawn, text, 1);
        assert_string_equal(drawn.reported, "");
        check_pixel(&drawn, 20, 20, (double[]){model_enc(0.5), model_enc(0.0625), model_enc(0.25)}, "added");
        // Each draw of a half-covered edge adds 128/255.
        double k = 128.0 / 255;
        check_pixel(&drawn, 30, 20, (double[]){model_enc(0.5 * k), model_enc(0.0625 * k), model_enc(0.25 * k)}, "half");
        double alpha = floor(255 * 0.5) / 255 * 0.125;
        for (int y = 15; y < 40; y += 20)
            check_pixel(&drawn, 45, y, (double[]){model_enc(4 * alpha), model_enc(8 * alpha), model_enc(12 * alpha)},
                        "layer");
        drawn_close(&drawn);
    }
}

// Checks that a pixel is a grey of this linear value.
static void check_light(const Drawn *drawn, int x, int y, double light, const char *what) {
    double grey = model_enc(light);
    check_pixel(drawn, x, y, (double[]){grey, grey, grey}, what);
}

// Gradients, colours, blends, images and patterns of HDR canvases are neither rounded to bytes nor clamped to 1.
static void test_hdr_sources_are_not_rounded(void **state) {
    (void)state;
    static const char script[] =
        "!window size=60;60 alpha=0.125\n"
        "    !canvas size=2;2 id=:dark hidden=true\n"
        "        !rect size=2;2 fill=true color=0.04\n"
        "    !canvas linear=true colorbits=32 size=2;2 id=:bright hidden=true\n"
        "        !rect size=2;2 fill=true color=6\n        !rect size=1;2 fill=true color=2\n"
        "    !canvas linear=true colorbits=32\n"
        "        !group\n            !gradient start=0;0 end=60;0\n                !stop color=0\n"
        "                !stop color=0.4\n            !rect size=60;10 fill=true\n"
        "        !group color=0;0;0;0.5\n            !gradient radius=60 point=0;15\n                !stop color=0\n"
        "                !stop color=0.4\n            !rect point=0;10 size=60;10 fill=true\n"
        "        !group\n            !blend ratio=0.25\n                !color color=2\n"
        "                !color color=6\n            !rect point=0;20 size=60;10 fill=true\n"
        "        !image image_id=:dark point=0;30 size=60;10\n"
        "        !image image_id=:bright point=0;40 size=60;10\n"
        "        !group\n            !pattern image_id=:bright translate=1;0\n"
        "            !rect point=0;50 size=60;10 fill=true\n";
    Drawn drawn;
    drawn_open(&drawn, script, 1);
    assert_string_equal(drawn.reported, "");
    double end = model_lin(102 / 255.0) * 0.125;
    for (int x = 0; x < 60; x++) {
        check_light(&drawn, x, 5, (x + 0.5) / 60 * end, "linear");
        double far = sqrt((x + 0.5) * (x + 0.5) + 0.25) / 60;
        check_light(&drawn, x, 15, fmin(far, 1) * end / 2, "radial");
        check_light(&drawn, x, 25, 3 * 0.125, "blend");
        check_light(&drawn, x, 35, model_lin(10 / 255.0) * 0.125, "bytes");
        check_light(&drawn, x, 45, (x < 30 ? 2 : 6) * 0.125, "light");
        check_light(&drawn, x, 55, (x % 2 == 1 ? 2 : 6) * 0.125, "pattern");
    }
    drawn_close(&drawn);
}

static void test_noise_equals_the_turbulence_model(void **state) {
    (void)state;
    static Turbulence t;
    static const struct {
        const char *attrs;
        double frequency[2];
        int octaves;
        long seed;
        int wrap[2];
        bool folded;
    } cases[] = {
        {"frequency=0.1", {0.1, 0.1}, 8, 0, {0, 0}, false},
        {"frequency=0.05;0.2 octaves=3 seed=7", {0.05, 0.2}, 3, 7, {0, 0}, false},
        {"frequency=0.07 octaves=4 seed=-3 type=:turbulence", {0.07, 0.07}, 4, -3, {0, 0}, true},
        // A tile has a whole number of noise cells. 2.6 (20 · 0.13) and 3.9 cells become 3 and 4, the closest by ratio.
        {"frequency=0.13 octaves=2 seed=2 size=20;30", {3 / 20.0, 4 / 30.0}, 2, 2, {3, 4}, false},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char inside[300];
        Drawn drawn;
        snprintf(
            inside, sizeof inside,
            "        !noise %s\n        !transform translate=3;-2\n            !rect point=-3;2 size=60 fill=true\n",
            cases[i].attrs);
        draw_script(&drawn, "", inside);
        turbulence_init(&t, cases[i].seed);
        for (int p = 0; p < 3600; p += 7) {
            double c[4];
            double x = p % 60 + 0.5 - 3, y = p / 60 + 0.5 + 2;
            if (x < 0 && cases[i].wrap[0]) // the specification does not define noise left of the first tile
                continue;
            for (int k = 0; k < 4; k++) {
                double sum = 0;
                for (int octave = 0; octave < cases[i].octaves; octave++) {
                    int by = 1 << octave, wrap[2] = {cases[i].wrap[0] * by, cases[i].wrap[1] * by};
                    double noise =
                        turbulence_noise(&t, k, x * cases[i].frequency[0] * by, y * cases[i].frequency[1] * by, wrap);
                    sum += (cases[i].folded ? fabs(noise) : noise) / by;
                }
                c[k] = fmin(fmax(cases[i].folded ? sum : (sum + 1) / 2, 0), 1);
            }
            check_pixel(&drawn, p % 60, p / 60, (double[]){c[0] * c[3], c[1] * c[3], c[2] * c[3]}, cases[i].attrs);
        }
        drawn_close(&drawn);
    }
}

// Returns true if the centre of a pixel is covered.
static bool is_on(const Drawn *drawn, int x, int y) {
    return drawn_byte(drawn, x, y, 0) > 127;
}

// Section 3.3: arcs of the two circles of radius 20 through 20;30 and 40;30, on either side of their chord.
static void test_arc_to(void **state) {
    (void)state;
    for (int which = 0; which < 4; which++) {
        bool large = which & 1, ccw = which & 2;
        char inside[300];
        Drawn drawn;
        snprintf(inside, sizeof inside,
                 "        !path\n            !move_to point=20;30\n"
                 "            !arc_to point=40;30 radius=15;30 large=%s ccw=%s\n            !fill color=1\n",
                 large ? "true" : "false", ccw ? "true" : "false");
        draw_script(&drawn, "", inside);
        // A clockwise arc from left to right is above its chord. The centre of the smaller arc is below the chord.
        double half = sqrt(1 - 100.0 / 225) * 30, middle = 30 + (large == ccw ? half : -half) * 1;
        for (int p = 0; p < 3600; p++) {
            double x = p % 60 + 0.5, y = p / 60 + 0.5;
            double far = hypot((x - 30) / 15, (y - middle) / 30);
            bool side = ccw ? y > 30 : y < 30;
            if (fabs(far - 1) > 0.05 && fabs(y - 30) > 1)
                assert_int_equal(is_on(&drawn, p % 60, p / 60), far < 1 && side);
        }
        drawn_close(&drawn);
    }
}

// Section 7: the curve of a rounded corner, points transformed by a matrix, and dashes after other effects.
static void test_path_effects(void **state) {
    (void)state;
    Drawn drawn;
    draw_script(&drawn, "",
                "        !round_corners radius=16\n        !rect point=10;10 size=40;40 fill=true color=1\n");
    for (int p = 0; p < 3600; p++) {
        double x = fmin(p % 60 + 0.5 - 10, 50 - (p % 60 + 0.5)) / 16,
               y = fmin(p / 60 + 0.5 - 10, 50 - (p / 60 + 0.5)) / 16;
        if (x < 0 || y < 0) {
            assert_false(is_on(&drawn, p % 60, p / 60));
            continue;
        }
        // The quadratic curve from (0, 1) to (1, 0) with the control point (0, 0) is √x + √y = 1.
        double along = sqrt(x) + sqrt(y);
        if (fabs(along - 1) > 0.08)
            assert_int_equal(is_on(&drawn, p % 60, p / 60), along > 1);
    }
    drawn_close(&drawn);
    draw_script(
        &drawn, "",
        "        !path_matrix matrix=0;-1;40;2;0;5;0;0;1\n        !rect point=5;10 size=20;10 fill=true color=1\n");
    for (int p = 0; p < 3600; p++) // x' = 40 − y, y' = 2x + 5
        assert_int_equal(is_on(&drawn, p % 60, p / 60), p % 60 >= 20 && p % 60 < 30 && p / 60 >= 15 && p / 60 < 55);
    drawn_close(&drawn);
    draw_script(&drawn, "",
                "        !path_matrix scale=2;1 rotate=0.25 translate=50;5\n            !dash intervals=6;4 offset=2\n"
                "        !line points=0;20;20;20 stroke=true stroke_width=4 color=1\n");
    for (int y = 0; y < 60; y++) { // dashes on the line: 0 to 4, 8 to 14, 18 to 20; the matrix doubles and turns them
        double x = (y + 0.5 - 5) / 2;
        bool on = x > 0 && x < 20 && (x < 4 || (x > 8 && x < 14) || x > 18);
        assert_int_equal(is_on(&drawn, 30, y), on);
        assert_int_equal(is_on(&drawn, 29, y), on);
        assert_false(is_on(&drawn, 26, y));
    }
    drawn_close(&drawn);
}

// Jitter stays within its deviation, changes the line, is the same in each frame, and depends on the seed.
static void test_jitter_stays_within_its_deviation(void **state) {
    (void)state;
    uint32_t *seen[2];
    for (int i = 0; i < 2; i++) {
        char inside[300];
        Drawn drawn;
        snprintf(inside, sizeof inside,
                 "        !jitter length=3 deviation=5 seed=%d\n        !line points=-5;30;65;30 stroke=true color=1 "
                 "stroke_width=2\n",
                 i);
        draw_script(&drawn, "", inside);
        int off = 0;
        for (int p = 0; p < 3600; p++) {
            int from = abs(p / 60 - 30);
            assert_false(is_on(&drawn, p % 60, p / 60) && from > 8);
            off += is_on(&drawn, p % 60, p / 60) && from > 2;
        }
        assert_true(off > 20);
        size_t bytes = (size_t)drawn.width * (size_t)drawn.height * sizeof(uint32_t);
        seen[i] = malloc(bytes);
        memcpy(seen[i], drawn.pixels, bytes);
        drawn_next(&drawn);
        assert_memory_equal(seen[i], drawn.pixels, bytes);
        drawn_close(&drawn);
    }
    assert_true(memcmp(seen[0], seen[1], 3600 * sizeof(uint32_t)) != 0);
    free(seen[0]);
    free(seen[1]);
}

// Parts that exceed the memory limit are omitted or drawn without effects, and reported once. The rest is drawn in each
// frame, and all memory is released.
static void test_memory_limit_omits_only_expensive_parts(void **state) {
    (void)state;
    static const struct {
        const char *script; // inserted after a green square at the left and before a blue one at the right
        const char *reported;
        int red; // expected red channel in the middle
    } cases[] = {
        {"        !group\n            !blur radius=9\n            !rect point=1000;0 size=1000;3000 fill=true "
         "color=1;0;0\n",
         "5 [memory-limit] drawing exceeded the memory limit (--memory): the content is drawn without a "
         "filter\n",
         255},
        {"        !group\n            !layer size=3000;3000 alpha=0.5\n                !layer size=3000;3000\n"
         "                    !rect point=1000;0 size=1000;3000 fill=true color=1;0;0\n",
         "6 [memory-limit] drawing exceeded the memory limit (--memory): the content is drawn without the "
         "layer\n",
         127},
        {"        !blend ratio=0.5\n            !paint color=1;0;0\n            !paint color=0;1;0\n"
         "        !rect point=1000;0 size=1000;3000 fill=true color=1;0;0\n        !color color=0\n"
         "    !canvas size=9000;9000\n        !rect size=9000 fill=true\n    !canvas size=3000\n",
         "4 [memory-limit] drawing exceeded the memory limit (--memory): the content is drawn without a "
         "filter\n"
         "9 [memory-limit] !canvas: a picture of 9000 x 9000 pixels exceeds the memory limit "
         "(--memory); it is left out\n",
         255},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char script[2000];
        Drawn drawn;
        snprintf(script, sizeof script,
                 "!window size=60;60\n    !canvas size=3000;3000\n"
                 "        !rect size=1000;3000 fill=true color=0;1;0\n%s"
                 "        !rect point=2000;0 size=1000;3000 fill=true color=0;0;1\n",
                 cases[i].script);
        // more memory, because the previous frame is kept as well
        drawn_open_with(&drawn, script, i == 0 ? 3 : 1, 100 << 20);
        assert_string_equal(drawn.reported, cases[i].reported);
        check_pixel(&drawn, 10, 30, (double[]){0, 1, 0}, "before");
        check_pixel(&drawn, 50, 30, (double[]){0, 0, 1}, "after");
        assert_true(abs(drawn_byte(&drawn, 30, 30, 0) - cases[i].red) <= 2);
        drawn_close(&drawn);
    }
}

// Section 8.2: the picture of any node can be used as an image or pattern: plain nodes, effects, nodes without inputs.
static void test_pictures_of_nodes(void **state) {
    (void)state;
    static const struct {
        const char *node;
        bool runs; // needs OpenGL
        double light;
    } cases[] = {{"shader alpha=0.5", false, 0.5},
                 {"record", false, 1},
                 {"adjust exposure=-1", true, 0.735357}, // encoded value of 1/2
                 {"blur", true, 1},
                 {"noise components=4 multiplier=0 offset=0.25", true, 0.25}}; // with components=4, alpha is also 0.25
    bool can = drawn_can_run();
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char script[1000];
        Drawn drawn;
        if (cases[i].runs && !can)
            continue;
        snprintf(script, sizeof script,
                 "!window size=60;60\n    !%s id=:s hidden=true\n        !canvas\n            !rect size=60 fill=true "
                 "color=1\n"
                 "    !canvas\n        !image image_id=:s size=30;60\n        !pattern texture_id=:s\n"
                 "        !rect point=30;0 size=30;60 fill=true\n",
                 cases[i].node);
        drawn_open(&drawn, script, 1);
        assert_string_equal(drawn.reported, "");
        double light = cases[i].light;
        for (int x = 15; x < 60; x += 30)
            check_pixel(&drawn, x, 30, (double[]){light, light, light}, cases[i].node);
        drawn_close(&drawn);
    }
}

// Bad input is reported once per position, in however many frames it occurs, and the rest is drawn.
static void test_bad_input_is_reported_once(void **state) {
    (void)state;
    static const struct {
        const char *inside; // content between a green square at the left and a blue one at the right
        const char *reported;
        bool red; // true if the middle is expected to be red
    } cases[] = {
        {"        !group translate=nan;0\n            !rect size=60 fill=true color=1;0;0\n",
         "4 [bad-attribute] !group: translate should be x;y, not nan;0\n", false},
        {"        !group rotate=inf\n            !rect size=60 fill=true color=1;0;0\n",
         "4 [bad-attribute] !group: rotate should be number, not inf\n", false},
        {"        !ellipse point=nan radius=9 fill=true color=1;0;0\n",
         "4 [bad-attribute] !ellipse: point should be x;y, not nan\n", false},
        // An attribute with an invalid value counts as missing.
        {"        !transform translate=1;2;3\n            !rect point=25;0 size=10;60 fill=true color=1;0;0\n",
         "4 [bad-attribute] !transform: translate should be x;y, not 1;2;3\n", true},
        {"        !group scale=1e200\n            !group scale=1e200\n                !rect size=60 fill=true\n"
         "        !group scale=0\n            !rect size=60 fill=true\n",
         "", false},
        {"        !group\n            !blur radius=1e9\n            !rect point=25;0 size=10;60 fill=true "
         "color=1;0;0\n",
         "5 [blur-limit] !blur: the radius is limited to 256 pixels\n", false},
        {"        !group\n            !shadow radius=1e300 offset=1e300 color=0\n"
         "                !dilate radius=1e300\n            !rect point=25;0 size=10;60 fill=true color=1;0;0\n",
         "5 [drawing-limit] drawing exceeded the work limit (--work): the content is drawn without the "
         "filter\n",
         true},
        {"        !group\n            !jitter length=1e-300 deviation=1e300\n            !line points=1;1;9;9 "
         "stroke=true\n"
         "            !dash intervals=1e-300;1e-300\n            !line points=1;1;9;9 stroke=true\n"
         "            !jitter length=1 deviation=0\n                !dash intervals=1e-300;0\n"
         "            !line points=1;1;9;9 stroke=true\n            !path_matrix matrix=0\n"
         "            !rect size=9 fill=true stroke=true\n            !path_matrix scale=0\n"
         "            !rect size=9 fill=true stroke=true\n            !round_corners radius=1e300\n"
         "            !rect size=9 fill=true stroke=true\n",
         "12 [bad-attribute] !path_matrix: matrix should be nine numbers, not 0\n", false},
        {"        !group\n            !noise frequency=1e300 octaves=1e9 seed=1e300 size=1e300\n            !rect "
         "size=9 fill=true\n"
         "        !path\n            !arc_to point=1e300;5 radius=1e-300 rotation=1e300\n"
         "            !arc_to point=5;1e-300 radius=1e300\n            !stroke\n",
         "", false},
        {"        !image filename='none.png'\n        !group\n            !pattern filename='gone.png'\n            "
         "!rect fill=true size=9\n"
         "            !rect fill=true size=9\n        !image image_id=:missing\n",
         "4 [cannot-read] !image: cannot read 'none.png': No such file or directory\n"
         "6 [cannot-read] !pattern: cannot read 'gone.png': No such file or directory\n",
         false},
        // Pictures that refer to each other or to themselves.
        {"        !image image_id=:b\n    !canvas id=:b size=60\n        !image image_id=:a\n        !image "
         "image_id=:b\n"
         "    !reference id=:c\n    !offscreen id=:c\n        !reference id=:c\n        !reference id=:a\n"
         "    !canvas size=-5\n    !canvas size=20000\n        !rect size=9 fill=true\n    !canvas\n",
         "12 [bad-attribute] !canvas: size should be one number or two, each 0 or more, not -5\n"
         "13 [bad-size] !canvas: a picture can have 1 to 16384 pixels in width and height\n",
         false},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char script[3000];
        Drawn drawn;
        snprintf(script, sizeof script,
                 "!window size=60;60\n    !canvas id=:a\n        !rect size=20;60 fill=true color=0;1;0\n%s"
                 "        !rect point=40;0 size=20;60 fill=true color=0;0;1\n",
                 cases[i].inside);
        drawn_open(&drawn, script, 3);
        if (strcmp(drawn.reported, cases[i].reported) != 0)
            fail_msg("%s\nreports:\n%s", script, drawn.reported);
        check_pixel(&drawn, 50, 30, (double[]){0, 0, 1}, "after");
        if (i + 1 < COUNT_OF(cases)) // the last case also draws over this pixel
            check_pixel(&drawn, 15, 30, (double[]){0, 1, 0}, "before");
        assert_true((drawn_byte(&drawn, 30, 30, 0) == 255) == cases[i].red);
        drawn_close(&drawn);
    }
}

TEST_GROUP(canvas) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blend_modes_match_model),
        cmocka_unit_test(test_filter_blend),
        cmocka_unit_test(test_color_matrix),
        cmocka_unit_test(test_blurred_bar_is_a_difference_of_error_functions),
        cmocka_unit_test(test_shadow_offset_dilate_erode),
        cmocka_unit_test(test_hdr_light_is_not_clamped),
        cmocka_unit_test(test_hdr_sources_are_not_rounded),
        cmocka_unit_test(test_noise_equals_the_turbulence_model),
        cmocka_unit_test(test_arc_to),
        cmocka_unit_test(test_path_effects),
        cmocka_unit_test(test_jitter_stays_within_its_deviation),
        cmocka_unit_test(test_memory_limit_omits_only_expensive_parts),
        cmocka_unit_test(test_pictures_of_nodes),
        cmocka_unit_test(test_bad_input_is_reported_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
