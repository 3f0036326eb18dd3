// test_effects.c: compares the results of effects with the model (model.h). Each channel may differ by 2 of 255.
#include "drawn.h"
#include "model.h"

enum { WIDTH = 30, HEIGHT = 20 };

// The inputs are shaders. The C and GLSL code uses the same formulas. The third input has a different size.
static const int sizes[MAX_INPUTS][2] = {{WIDTH, HEIGHT}, {WIDTH, HEIGHT}, {11, 7}};
static const char *const formulas[MAX_INPUTS] = {
    ("    float a = p.x < 0.5 ? 1.0 : 1.0 - 0.6 * p.y;\n"
     "    bool bright = p.x > 0.31 && p.x < 0.62 && p.y > 0.22 && p.y < 0.53;\n"
     "    vec3 c = vec3(1.3 * p.x, 0.5 * p.y, 0.4 + 0.3 * sin(7.0 * p.x + 5.0 * p.y + 40.0 * beat));\n"
     "    color = vec4(bright ? vec3(4.0, 3.0, 1.0) : c, 1.0) * a;\n"),
    ("    float a = fract(3.1 * p.x);\n"
     "    color = vec4(0.9 * p.y, 0.7 - 0.7 * p.x, p.x * p.y, 1.0) * a;\n"),
    ("    color = p.x < 1.1 * p.y ? vec4(0.1, 0.8 * p.x, 0.2, 0.9) : vec4(0.5 * p.y, 0.0, 0.0, 0.5);\n"),
};

static Px input_at(int input, double x, double y, double beat) {
    double a = x < 0.5 ? 1 : 1 - 0.6 * y;
    bool bright = x > 0.31 && x < 0.62 && y > 0.22 && y < 0.53;
    switch (input) {
    case 0:
        if (bright)
            return (Px){{4 * a, 3 * a, a, a}};
        return (Px){{1.3 * x * a, 0.5 * y * a, (0.4 + 0.3 * sin(7 * x + 5 * y + 40 * beat)) * a, a}};
    case 1:
        a = 3.1 * x - floor(3.1 * x);
        return (Px){{0.9 * y * a, (0.7 - 0.7 * x) * a, x * y * a, a}};
    default:
        return x < 1.1 * y ? (Px){{0.1, 0.8 * x, 0.2, 0.9}} : (Px){{0.5 * y, 0, 0, 0.5}};
    }
}

static void make_input(int input, double beat, Pic *pic) {
    model_target(pic, sizes[input][0], sizes[input][1]);
    for (int y = 0; y < pic->h; y++)
        for (int x = 0; x < pic->w; x++)
            pic->at[y * pic->w + x] = input_at(input, (x + 0.5) / pic->w, (y + 0.5) / pic->h, beat);
}

typedef struct Case {
    const char *kind;
    const char *attrs;
    int inputs;
    int frames; // number of frames to draw; 0: one frame
} Case;

static void write_script(const Case *of, char *out, size_t size) {
    bool window = strcmp(of->kind, "window") == 0;
    int at = snprintf(out, size, "!window size=%d;%d colorbits=32 %s\n", WIDTH, HEIGHT, window ? of->attrs : "");
    if (!window)
        at += snprintf(out + at, size - (size_t)at, "    !%s %s\n", of->kind, of->attrs);
    for (int i = 0; i < of->inputs; i++)
        at += snprintf(out + at, size - (size_t)at,
                       "        !shader size=%d;%d fragment=\"\"\"${HEADER}\nin vec2 coord;\nout vec4 color;\n"
                       "uniform float beat;\nvoid main() {\n    vec2 p = coord;\n%s}\n\"\"\"\n",
                       sizes[i][0], sizes[i][1], formulas[i]);
}

// Returns the largest difference between the drawn pixels and the model's.
static int distance(const Drawn *drawn, const Pic *wanted, int *at_x, int *at_y) {
    int worst = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int k = 0; k < 3; k++) {
                double c = wanted->at[(HEIGHT - 1 - y) * WIDTH + x].c[k];
                int far = abs(drawn_byte(drawn, x, y, k) - (int)lround(255 * model_enc(c)));
                if (far > worst)
                    worst = far, *at_x = x, *at_y = y;
            }
    return worst;
}

static bool check_case(const Case *of) {
    static char script[8000];
    static Work work;
    static Pic wanted;
    Drawn drawn;
    int worst = 0, x = 0, y = 0;
    const double beats = 1.0 / 30; // one frame at tempo 120 and 60 frames per second
    write_script(of, script, sizeof script);
    drawn_open(&drawn, script, 0);
    work = (Work){.kind = of->kind, .attrs = of->attrs, .n = of->inputs, .w = WIDTH, .h = HEIGHT, .beats = beats};
    for (int frame = 0; frame < (of->frames ? of->frames : 1) && worst <= 2; frame++) {
        for (int i = 0; i < of->inputs; i++)
            make_input(i, frame * beats, &work.in[i]);
        drawn_next(&drawn);
        model_effect(&work, &wanted);
        worst = distance(&drawn, &wanted, &x, &y);
        work.last = wanted;
        work.past = true;
    }
    if (worst > 2 || drawn.reported[0])
        print_error("!%s %s, %d inputs: off by %d at %d;%d\n%s", of->kind, of->attrs, of->inputs, worst, x, y,
                    drawn.reported);
    bool good = worst <= 2 && !drawn.reported[0];
    drawn_close(&drawn);
    return good;
}

static void check_cases(const Case *cases, size_t count) {
    int failed = 0;
    for (size_t i = 0; i < count; i++)
        failed += !check_case(&cases[i]);
    assert_int_equal(failed, 0);
}

static void test_composite_modes_equal_the_model(void **state) {
    (void)state;
    static const Case cases[] = {
        {"window", "", 0, 0},
        {"window", "", 1, 0},
        {"window", "alpha=0.4", 3, 0},
        {"window", "composite=:over", 3, 0},
        {"window", "composite=:dest_over", 3, 0},
        {"window", "composite=:lighten", 3, 0},
        {"window", "composite=:darken", 3, 0},
        {"window", "composite=:add", 3, 0},
        {"window", "composite=:difference", 3, 0},
        {"window", "composite=:multiply", 3, 0},
        {"window", "composite=:multiply border=1;0.5;0.2;1", 3, 0},
        {"window", "composite=:difference repeat=true", 3, 0},
        {"window", "repeat=true;false", 3, 0},
        {"window", "repeat=false;true nearest=true", 3, 0},
        {"window", "nearest=true", 3, 0},
    };
    check_cases(cases, COUNT_OF(cases));
}

static void test_adjust_equals_the_model(void **state) {
    (void)state;
    static const Case cases[] = {
        {"adjust", "", 1, 0},
        {"adjust", "alpha=0.7 composite=:add", 3, 0},
        {"adjust", "hue=0.3 saturation=0.6", 1, 0},
        {"adjust", "saturation=1.8 exposure=-1.5", 2, 0},
        {"adjust", "exposure=0.5 contrast=0.7 brightness=0.1", 1, 0},
        {"adjust", "contrast=1.5 shadows=1.5 highlights=-1", 1, 0},
        {"adjust", "gamma=1.7", 1, 0},
        {"adjust", "color_matrix=0.2;0.7;0.1;0.5;0.1;0.4;0.3;0.2;0.5", 1, 0},
        {"adjust", "color_matrix=0.3", 1, 0},
        {"adjust", "tonemap=:reinhard", 1, 0},
        {"adjust", "tonemap=:reinhard whitepoint=2", 1, 0},
        {"adjust", "tonemap=:reinhard whitepoint=0.5", 1, 0},
        {"adjust", "tonemap=:aces", 1, 0},
        {"adjust", "tonemap=:aces exposure=-2", 2, 0},
        {"adjust", "tonemap=:agx", 1, 0},
        {"adjust", "tonemap=:agx_punchy", 1, 0},
        {"adjust", "tonemap=:agx_punchy exposure=2", 3, 0},
    };
    check_cases(cases, COUNT_OF(cases));
}

static void test_blur_bloom_edges_and_chromakey_equal_the_model(void **state) {
    (void)state;
    static const Case cases[] = {
        {"blur", "", 1, 0},
        {"blur", "radius=4", 1, 0},
        {"blur", "radius=5;2 sigma=0.5;0.2 alpha=0.8", 3, 0},
        {"blur", "radius=0;3.9", 2, 0},
        {"blur", "radius=3 border=0;0;0;0", 1, 0},
        {"blur", "radius=3 repeat=true", 2, 0},
        {"bloom", "", 1, 0},
        {"bloom", "radius=6", 1, 0},
        {"bloom", "radius=8;5 sigma=0.4 exposure=0 downsample=3", 3, 0},
        {"bloom", "radius=4 contrast=1.4 brightness=-0.1 shadows=-1 highlights=0.5 alpha=0.9", 2, 0},
        {"bloom", "radius=5 downsample=1", 1, 0},
        {"edges", "radius=4", 1, 0},
        {"edges", "radius=6;2 mixer=0.5 sigma=0.5", 2, 0},
        {"edges", "radius=3 mixer=1 alpha=0.5 downsample=1", 3, 0},
        {"chromakey", "hue=0.72 range=0.3 saturation=0.2 radius=0", 1, 0},
        {"chromakey", "hue=0.72 range=0.3 saturation=0.2 radius=4 hard=2", 1, 0},
        {"chromakey", "range=0.4 saturation=0.1 alpha=0.6", 3, 0},
    };
    check_cases(cases, COUNT_OF(cases));
}

static void test_feedback_equals_the_model(void **state) {
    (void)state;
    static const Case cases[] = {
        {"feedback", "", 1, 2},
        {"feedback", "mixer=0.5", 1, 1},
        {"feedback", "mixer=0.5 timebase=0.1", 1, 5},
        {"feedback", "mixer=0.8 timebase=0.125 translate=9;-5 glow=0.2", 2, 6},
        {"feedback", "mixer=0.9 timebase=0.2 scale=1.3;0.8 rotate=0.1", 1, 6},
        {"feedback", "mixer=0.9 timebase=0.2 translate=10;4 repeat=true;true alpha=0.9", 3, 4},
        {"feedback", "mixer=0.7 timebase=0.2 translate=30 border=0;1;0;1", 1, 3},
    };
    check_cases(cases, COUNT_OF(cases));
}

static void test_transform_vignette_kaleid(void **state) {
    (void)state;
    static const Case cases[] = {
        {"transform", "", 1, 0},
        {"transform", "translate=5;3.5", 1, 0},
        {"transform", "scale=0.6 rotate=0.1", 2, 0},
        {"transform", "rotate=0.1 scale=0.6;1.4 translate=3;-4", 1, 0},
        {"transform", "translate=3;-4 rotate=0.1 scale=0.6;1.4 alpha=0.5", 3, 0},
        {"transform", "keystone=0.5;-0.3", 1, 0},
        {"transform", "scale=0.7 keystone=0.4;0.2 rotate=0.05", 1, 0},
        {"transform", "scale=0.4 repeat=true", 1, 0},
        {"transform", "scale=0.4 border=0.5;0;0;1", 2, 0},
        {"vignette", "", 1, 0},
        {"vignette", "inset=0.4 fade=:quad", 2, 0},
        {"vignette", "inset=0.5 fade=:cubic alpha=0.7", 1, 0},
        {"vignette", "inset=0.8", 1, 0},
        {"vignette", "inset=-1", 1, 0},
        {"kaleid", "", 1, 0},
        {"kaleid", "segments=5 rotation=0.07 radius=0.4", 3, 0},
        {"kaleid", "segments=4.5 radius=0.7 repeat=true alpha=0.8", 1, 0},
    };
    check_cases(cases, COUNT_OF(cases));
}

static void test_noise_equals_the_model(void **state) {
    (void)state;
    static const Case cases[] = {
        {"noise", "scale=0.2", 0, 0},
        {"noise", "scale=0.11;0.2;0.3 components=3 z=4.3 seed=3.25", 0, 0},
        {"noise", "scale=0.1 components=4 octaves=3 roughness=0.6 multiplier=0.8 offset=0.6 origin=3;-70", 0, 0},
        {"noise", "scale=0.2 shape=:cylinder components=2 default=0.2;0.3;0.4;0.5", 0, 0},
        {"noise", "scale=0.3 shape=:sphere components=3 alpha=0.7 seed=-1", 0, 0},
        {"noise", "scale=0.07 tscale=4;2;6 components=3", 1, 0},
        {"noise", "scale=0.05 tscale=3 components=3 octaves=2", 3, 0},
    };
    check_cases(cases, COUNT_OF(cases));
}

static void test_flare_equals_the_model(void **state) {
    (void)state;
    static const Case cases[] = {
        {"flare", "", 1, 0},
        {"flare", "attenuation=0 aberration=0", 1, 0},
        {"flare", "attenuation=0.5 aberration=0.5 threshold=0.2 downsample=1", 1, 0},
        {"flare", "ghosts=0 attenuation=0 halo_radius=0 upright_length=0.8 diagonal_length=0.9", 2, 0},
        {"flare", "ghosts=0 attenuation=0 halo_radius=0.5 halo_attenuation=-1", 1, 0},
        {"flare", "ghosts=2 attenuation=0.2 alpha=0.8 downsample=1", 3, 0},
    };
    check_cases(cases, COUNT_OF(cases));
}

// pictures.md 4.4 gives exact values.
static void test_exact_numbers_of_spec(void **state) {
    (void)state;
    Drawn drawn;
    drawn_open(&drawn,
               "!window\n    !shader fragment=\"\"\"${HEADER}\nin vec2 coord;\nout vec4 color;\n"
               "void main() { color = vec4(coord, 1.0 - coord.x, 1.0); }\n\"\"\"\n",
               1);
    assert_int_equal(drawn.width, 512);
    assert_int_equal(drawn.height, 512);
    assert_int_equal(drawn.pixels[0], 0xff03ffff);
    assert_int_equal(drawn.pixels[511 * 512 + 511], 0xffff0303);
    assert_int_equal(drawn.pixels[256 * 512 + 256], 0xffbcbbbb);
    assert_string_equal(drawn.reported, "");
    drawn_close(&drawn);
}

TEST_GROUP(effects) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_numbers_of_spec),
        cmocka_unit_test(test_composite_modes_equal_the_model),
        cmocka_unit_test(test_adjust_equals_the_model),
        cmocka_unit_test(test_blur_bloom_edges_and_chromakey_equal_the_model),
        cmocka_unit_test(test_feedback_equals_the_model),
        cmocka_unit_test(test_transform_vignette_kaleid),
        cmocka_unit_test(test_noise_equals_the_model),
        cmocka_unit_test(test_flare_equals_the_model),
    };
    return drawn_can_run() ? cmocka_run_group_tests(tests, NULL, NULL) : GROUP_SKIPPED;
}
