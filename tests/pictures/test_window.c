// test_window.c: checks that pictures in an OpenGL ES window equal those in files, without readback from the GPU. The
// window is an offscreen surface.
#include "drawn.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

enum { WIDTH = 150, HEIGHT = 90 };

static struct {
    EGLDisplay display;
    EGLConfig config;
    EGLContext context;
    EGLSurface surface;
} egl;

static bool open_window(void) {
    static const EGLint wanted[] = {EGL_SURFACE_TYPE,
                                    EGL_PBUFFER_BIT,
                                    EGL_RENDERABLE_TYPE,
                                    EGL_OPENGL_ES3_BIT,
                                    EGL_RED_SIZE,
                                    8,
                                    EGL_GREEN_SIZE,
                                    8,
                                    EGL_BLUE_SIZE,
                                    8,
                                    EGL_ALPHA_SIZE,
                                    8,
                                    EGL_NONE};
    static const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    static const EGLint size[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE};
    EGLint count = 0;
    egl.display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!eglInitialize(egl.display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_ES_API) ||
        !eglChooseConfig(egl.display, wanted, &egl.config, 1, &count) || count < 1)
        return false;
    egl.context = eglCreateContext(egl.display, egl.config, EGL_NO_CONTEXT, version);
    egl.surface = eglCreatePbufferSurface(egl.display, egl.config, size);
    return egl.context != EGL_NO_CONTEXT && egl.surface != EGL_NO_SURFACE;
}

static void use_window(bool on) {
    EGLSurface surface = on ? egl.surface : EGL_NO_SURFACE;
    assert_true(eglMakeCurrent(egl.display, surface, surface, on ? egl.context : EGL_NO_CONTEXT));
}

// Reads the rows of the window from the top, which is the order in files.
static void read_window(uint32_t *pixels) {
    unsigned char row[WIDTH * 4];
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    for (int y = 0; y < HEIGHT; y++) {
        glReadPixels(0, HEIGHT - 1 - y, WIDTH, 1, GL_RGBA, GL_UNSIGNED_BYTE, row);
        for (int x = 0; x < WIDTH; x++)
            pixels[y * WIDTH + x] = (uint32_t)row[4 * x + 3] << 24 | (uint32_t)row[4 * x] << 16 |
                                    (uint32_t)row[4 * x + 1] << 8 | row[4 * x + 2];
    }
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

// Returns the largest difference between two pictures in any channel.
static int distance(const uint32_t *one, const uint32_t *other) {
    int max = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        for (unsigned shift = 0; shift < 32; shift += 8) {
            int apart = abs((int)(one[i] >> shift & 255) - (int)(other[i] >> shift & 255));
            max = apart > max ? apart : max;
        }
    return max;
}

static const PetriLabel label = {.text = "on top",
                                 .x = 10.3,
                                 .y = 20.6,
                                 .width = 200,
                                 .height = 30.2,
                                 .size = 13,
                                 .line_height = 19,
                                 .padding = 5,
                                 .background = {0.1, 0.2, 0.3, 0.8},
                                 .foreground = {1, 1, 1, 1},
                                 .accent = {1, 0, 0, 1}};

// Presents frames with one painter and draws their pixels and labels with another one. Returns the largest difference.
static int present_script(const char *script, int frames, size_t labels) {
    uint32_t seen[WIDTH * HEIGHT], wanted[WIDTH * HEIGHT];
    Drawn drawn;
    PetriPictureOptions options = petri_default_picture_options();
    drawn_open(&drawn, script, 0);
    PetriPainter *painter = petri_painter_open();
    use_window(true);
    assert_int_equal(petri_painter_use_gl(painter), PETRI_OK);
    for (int i = 0; i < frames; i++) {
        PetriPicture *picture = NULL;
        assert_int_equal(petri_step(drawn.session), PETRI_OK);
        assert_int_equal(petri_picture(drawn.session, &options, &picture), PETRI_OK);
        glClearColor(1, 0, 1, 1);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        assert_int_equal(petri_painter_present(painter, picture, &label, labels, sizeof label, 1.5, WIDTH, HEIGHT),
                         PETRI_OK);
        read_window(seen);
        assert_int_equal(petri_painter_readback_count(painter), 0);
        use_window(false);
        assert_int_equal(petri_picture_draw(picture, drawn.painter, wanted, WIDTH, HEIGHT, WIDTH * sizeof *wanted),
                         PETRI_OK);
        use_window(true);
        petri_picture_report(drawn.session, picture);
        petri_picture_free(&picture);
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        wanted[i] |= 0xff000000u;
    assert_int_equal(petri_painter_draw_labels(drawn.painter, &label, labels, sizeof label, 1.5, wanted, WIDTH, HEIGHT,
                                               WIDTH * sizeof *wanted),
                     PETRI_OK);
    assert_string_equal(drawn.reported, "");
    petri_painter_close(&painter);
    use_window(false);
    drawn_close(&drawn);
    return distance(seen, wanted);
}

#define LIGHTS                                                                                                         \
    "    !bloom radius=6 exposure=1\n"                                                                                 \
    "        !canvas\n"                                                                                                \
    "            for i in ..60\n"                                                                                      \
    "                !rect point=2.5*i;i size=20;30 color=hsv(i/60;1;i/40) fill=true\n"

static void test_window_equals_file(void **state) {
    (void)state;
    assert_int_equal(present_script("!window size=150;90\n" LIGHTS, 1, 0), 0);
    assert_int_equal(present_script("!window size=150;90 colorbits=32\n" LIGHTS, 1, 0), 0);
    assert_int_equal(present_script("!offscreen size=150;90 id=:o alpha=0.7\n" LIGHTS, 1, 0), 0);
    assert_int_equal(present_script("!window size=150;90\n    !feedback mixer=0.9 translate=5;3\n        !canvas\n"
                                    "            !ellipse point=20+20*frame;40 radius=15 color=1;0.5;0.2 fill=true\n",
                                    4, 0),
                     0);
}

// Cairo draws canvases at the window's resolution.
static void test_canvas_is_drawn_at_window_size(void **state) {
    (void)state;
    assert_int_equal(
        present_script("!window size=70;70\n    !canvas\n        !ellipse point=35;35 radius=30 color=1;0.5;0.2 "
                       "fill=true\n",
                       1, 0),
        0);
    assert_int_equal(
        present_script("!window size=150;90 alpha=0.8\n    !canvas\n        !rect size=90;70 color=1;0.5;0.2 "
                       "fill=true\n",
                       1, 0),
        0);
}

// Cairo interpolates positions between pixels in steps of 1/128.
static void test_picture_is_scaled_to_window(void **state) {
    (void)state;
    assert_in_range(present_script("!window size=300;100\n" LIGHTS, 1, 0), 0, 2);
    assert_in_range(present_script("!window size=67;83\n" LIGHTS, 1, 0), 0, 2);
}

static void test_labels_are_drawn_over_picture(void **state) {
    (void)state;
    assert_in_range(present_script("!window size=150;90\n" LIGHTS, 1, 1), 0, 2);
    assert_in_range(
        present_script("!window size=150;90\n    !canvas\n        !rect size=90;70 fill=true color=1\n", 1, 1), 0, 2);
}

static void test_without_picture(void **state) {
    (void)state;
    uint32_t seen[WIDTH * HEIGHT];
    PetriPainter *painter = petri_painter_open();
    use_window(true);
    assert_int_equal(petri_painter_present(painter, NULL, NULL, 0, 0, 1, WIDTH, HEIGHT), PETRI_INVALID);
    assert_int_equal(petri_painter_use_gl(painter), PETRI_OK);
    assert_int_equal(petri_painter_use_gl(painter), PETRI_INVALID);
    assert_int_equal(petri_painter_present(painter, NULL, NULL, 1, 0, 1, WIDTH, HEIGHT), PETRI_INVALID);
    assert_int_equal(petri_painter_present(painter, NULL, NULL, 0, 0, 1, 0, HEIGHT), PETRI_INVALID);
    assert_int_equal(petri_painter_present(painter, NULL, NULL, 0, 0, 1, WIDTH, HEIGHT), PETRI_OK);
    read_window(seen);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_int_equal(seen[i], 0xff000000u);
    use_window(false);
    assert_int_equal(petri_painter_present(painter, NULL, NULL, 0, 0, 1, WIDTH, HEIGHT),
                     PETRI_INVALID); // fails, because no context is current
    petri_painter_close(&painter);
}

static void test_gl_must_be_adopted_first(void **state) {
    (void)state;
    Drawn drawn;
    drawn_open(&drawn, "!window size=2;2\n    !vignette\n        !canvas\n", 1);
    use_window(true);
    assert_int_equal(petri_painter_use_gl(drawn.painter), PETRI_INVALID);
    assert_int_equal(petri_painter_readback_count(drawn.painter), 1);
    use_window(false);
    drawn_close(&drawn);
    PetriPainter *painter = petri_painter_open();
    assert_int_equal(petri_painter_use_gl(painter), PETRI_UNSUPPORTED); // fails, because there is no context
    petri_painter_close(&painter);
}

TEST_GROUP(window) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_window_equals_file),
        cmocka_unit_test(test_canvas_is_drawn_at_window_size),
        cmocka_unit_test(test_picture_is_scaled_to_window),
        cmocka_unit_test(test_labels_are_drawn_over_picture),
        cmocka_unit_test(test_without_picture),
        cmocka_unit_test(test_gl_must_be_adopted_first),
    };
    if (!drawn_can_run())
        return GROUP_SKIPPED;
    if (!open_window()) {
        printf("skipped: EGL has no windows in memory here\n");
        return GROUP_SKIPPED;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
