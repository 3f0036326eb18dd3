// test_tree.c: tests the render graph: references between nodes, uniforms of shaders, and errors (spec pictures.md 2,
// 3, 8).
#include "drawn.h"

#define SIZE "!window size=4;4\n"
// An effect node without inputs whose shader function `main` has this body.
#define PROGRAM(attrs, more, main)                                                                                     \
    "!shader " attrs " fragment=\"\"\"${HEADER}\nin vec2 coord;\nout vec4 color;\n" more "void main() { " main         \
    " }\n\"\"\"\n"
#define RED "!canvas\n            !rect size=9;9 fill=true color=1;0;0\n"
#define GREEN "!canvas\n            !rect size=9;9 fill=true color=0;1;0\n"

static int at(const Drawn *drawn, int channel) {
    return drawn_byte(drawn, 1, 1, channel);
}

// Draws `frames` frames. Checks the colour and that nothing is reported.
static void check_color(const char *row, const char *script, int frames, int red, int green, int blue) {
    Drawn drawn;
    drawn_open(&drawn, script, frames);
    if (abs(at(&drawn, 0) - red) > 1 || abs(at(&drawn, 1) - green) > 1 || abs(at(&drawn, 2) - blue) > 1)
        print_error("%d %d %d\n", at(&drawn, 0), at(&drawn, 1), at(&drawn, 2));
    assert_text(row, drawn.reported, "");
    assert_claim(row, abs(at(&drawn, 0) - red) <= 1);
    assert_claim(row, abs(at(&drawn, 1) - green) <= 1);
    assert_claim(row, abs(at(&drawn, 2) - blue) <= 1);
    drawn_close(&drawn);
}

// Draws two frames. Checks the colour and that each problem is reported once.
static void check_reported(const char *row, const char *script, const char *reported, int red, int green, int blue) {
    Drawn drawn;
    drawn_open(&drawn, script, 2);
    assert_text(row, drawn.reported, reported);
    assert_int_equal(at(&drawn, 0), red);
    assert_int_equal(at(&drawn, 1), green);
    assert_int_equal(at(&drawn, 2), blue);
    drawn_close(&drawn);
}

static void test_ids_refer_to_pictures(void **state) {
    (void)state;
    check_color("refers to a hidden picture",
                SIZE "    !vignette inset=0 hidden=true\n        " RED "    !vignette inset=0\n        " GREEN
                     "    !vignette inset=0 hidden=true\n        " RED,
                1, 0, 255, 0);
    check_color("refers to an earlier picture",
                SIZE "    !vignette inset=0 hidden=true id=:a;1\n        " RED "    !reference id='a1'\n", 1, 255, 0,
                0);
    static const char later[] = SIZE "    !reference id='a'\n    " PROGRAM(
        "id='a' hidden=true", "uniform float frame;\n", "color = vec4(frame == 0.0, frame == 1.0, frame == 2.0, 1.0);");
    check_color("refers to a later picture: nothing in the first frame", later, 1, 0, 0, 0);
    check_color("refers to a later picture: that of the previous frame", later, 2, 255, 0, 0);
    check_color("refers to a later picture: again in the third frame", later, 3, 0, 255, 0);
    check_color("refers to the later of two with the same id",
                SIZE "    !vignette inset=0 hidden=true id=:a\n        " RED
                     "    !vignette inset=0 hidden=true id=:a\n        " GREEN "    !reference id=:a\n",
                1, 0, 255, 0);
    check_color("refers to an earlier offscreen",
                "!offscreen size=2;2 id=:o\n    !vignette inset=0\n        " RED SIZE "    !reference id=:o\n", 1, 255,
                0, 0);
    check_color("refers to itself: grows in each frame",
                SIZE "    !shader composite=:add id=:self\n        !reference id=:self\n        " PROGRAM(
                    "", "", "color = vec4(0.2, 0.0, 0.0, 0.2);"),
                3, 203, 0, 0); // encoded value of 0.6
    check_color("refers to an unknown id", SIZE "    !reference id=:missing\n    !vignette inset=0\n        " RED, 2,
                255, 0, 0);
}

// A shader that adds its colour in each frame.
#define ADDING(attrs, color)                                                                                           \
    PROGRAM(attrs, "uniform sampler2D last;\n", "color = texture(last, coord) + vec4(" color ", 0.1);")

#define FIRST ADDING("#one", "0.1, 0.0, 0.0")
#define SECOND ADDING("#two", "0.0, 0.2, 0.0")

static void test_nodes_continue_between_frames(void **state) {
    (void)state;
    check_color("continues", SIZE "    " ADDING("", "0.2, 0.0, 0.0"), 3, 203, 0, 0);
    // Two nodes of the same kind change places in each frame. Ids or tags identify them. The brighter of their sums
    // shows whether each node kept its previous result.
    check_color("continues by its id",
                SIZE "    !shader composite=:lighten\n"
                     "        for i in ((0;1) if frame % 2 else (1;0))\n"
                     "            " PROGRAM("id=i tint=i", "uniform sampler2D last;\nuniform float tint;\n",
                                            "color = texture(last, coord) + 0.1 * vec4(1.0 - tint, 2.0 * tint, 0.0, "
                                            "1.0);"),
                3, 149, 203, 0); // encoded values of 0.3 and 0.6
    check_color("continues by its tag",
                SIZE "    !shader composite=:lighten\n        if frame % 2\n            " FIRST "            " SECOND
                     "        else\n            " SECOND "            " FIRST,
                3, 149, 203, 0);
    // A node that was absent in a frame starts from scratch.
    check_color("restarts after a missing frame",
                SIZE "    if frame != 2\n        " ADDING("", "0.2, 0.0, 0.0") "    !canvas\n", 4, 124, 0, 0);
    // A node of another kind before this node has no effect.
    check_color("continues after a node of another kind",
                SIZE "    if frame % 2\n        !vignette\n            !canvas\n    " ADDING("", "0.2, 0.0, 0.0"), 3,
                203, 0, 0);
}

static void test_passes_see_first_and_last(void **state) {
    (void)state;
    check_color("last, first, pass, passes",
                SIZE "    " PROGRAM("passes=3", "uniform sampler2D last, first;\nuniform int pass, passes;\n",
                                    "color = pass == 0 ? vec4(0.2, 0.0, passes, 1.0) : texture(last, coord) + "
                                    "texture(first, coord);\n"
                                    "if (pass == 2) color.b = color.b == 9.0 ? 1.0 : 0.0;"),
                1, 203, 0, 255); // encoded value of 0.6, pass 3 of 3
    check_color("in pass 0, first is empty and last is the previous frame",
                SIZE "    " PROGRAM("", "uniform sampler2D last, first;\n",
                                    "color = vec4(texture(first, coord).a, texture(last, coord).g + 0.2, 0.0, 1.0);"),
                3, 0, 203, 0);
    check_color("downsample_passes",
                "!window size=12;8\n    " PROGRAM("passes=2 downsample=3 downsample_passes=0",
                                                  "uniform sampler2D last;\nuniform int pass, downsample;\n"
                                                  "uniform vec2 size;\n",
                                                  "color = pass == 0 ? vec4(size / 10.0, float(downsample) / 10.0, 1.0)"
                                                  " : texture(last, coord) * float(downsample);"),
                1, 170, 124, 149); // 4 / 10, 2 / 10, 3 / 10
    check_color("the default shader runs in several passes",
                SIZE "    !shader alpha=0.5 downsample_passes=0;1\n        " RED, 1, 188, 0, 0);
}

static void test_uniforms_have_values(void **state) {
    (void)state;
    check_color("numbers",
                SIZE
                "    " PROGRAM("tint=0.2;0.4;0.6 one=0.5 whole=2.7", "uniform vec3 tint, one;\nuniform int whole;\n",
                               "color = vec4(tint * one * float(whole), 1.0);"),
                1, 124, 170, 203);
    check_color("arrays",
                SIZE "    " PROGRAM("list=0.2;0;0;0;0.4;0 same=0;0.2;0.6", "uniform vec3 list[2], same[2];\n",
                                    "color = vec4(list[0] + list[1] + same[1], 1.0);"),
                1, 124, 203, 203);
    check_color("large arrays",
                SIZE "    " PROGRAM("list=((0.2 if i == 199 else 0.1);i;0) for i in ..200 whole=..500",
                                    "uniform vec3 list[200];\nuniform int whole[500];\n",
                                    "color = vec4(list[199].x, list[198].y == 198.0, whole[499] == 499, 1.0);"),
                1, 124, 255, 255);
    check_color("mismatched and unknown uniforms are 0, alpha is set",
                SIZE "    " PROGRAM("alpha=0.2 two=1;1", "uniform vec3 two;\nuniform float unknown, alpha;\n",
                                    "color = vec4(two.x, unknown, alpha, 1.0);"),
                1, 0, 0, 124);
    check_color("values of the frame",
                "%pragma tempo 60\n%pragma fps 10\n" SIZE "    " PROGRAM(
                    "", "uniform float time, beat, tempo, fps, delta;\n",
                    "color = vec4(time, beat, tempo == 60.0 && fps == 10.0 && abs(delta - 0.1) < 1e-6, 1.0);"),
                3, 124, 124, 255);
    Drawn drawn;
    drawn_open(&drawn, SIZE "    !canvas\n", 0);
    assert_int_equal(petri_define(drawn.session, "mine=0.2"), PETRI_OK);
    static const char script[] =
        SIZE "    " PROGRAM("own=mine", "uniform float mine, own;\n", "color = vec4(mine, own, 0.0, 1.0);");
    assert_int_equal(petri_load_text(drawn.session, "t.fl", script, strlen(script)), PETRI_OK);
    drawn_next(&drawn);
    assert_int_equal(at(&drawn, 0), 124);
    assert_int_equal(at(&drawn, 1), 124);
    drawn_close(&drawn);
}

// The picture of a window or !offscreen with a program and without children is that of the program, also if there are
// particles. Its attributes are uniforms.
static void test_programs_of_windows(void **state) {
    (void)state;
    static const char program[] =
        "fragment=\"\"\"${HEADER}\nout vec4 color;\nuniform vec3 tint;\nuniform float level;\n"
        "void main() { color = vec4(tint * level, 1.0); }\n\"\"\"\n";
    static const char *const starts[] = {"!window size=4;4", "!offscreen size=4;4", "!window size=4;4\n    !shader",
                                         "!window size=4;4\n    !record",
                                         ("!physics state=:s dimensions=2\n    !particle id=1 position=0;0\n"
                                          "!window size=4;4")};
    for (size_t i = 0; i < COUNT_OF(starts); i++) {
        char script[600];
        snprintf(script, sizeof script, "%s tint=1;0.2;0 level=0.2+frame*0 %s", starts[i], program);
        check_color(starts[i], script, 2, 124, 56, 0);
    }
    check_reported("without a program, other attributes are unknown", "!window size=4;4 tint=1\n    " RED,
                   "1 [unknown-attribute] !window: unknown attribute 'tint'\n", 255, 0, 0);
}

static void test_shader_errors_are_at_their_lines(void **state) {
    (void)state;
    check_color("#version 330",
                SIZE "    !shader fragment=\"\"\"\n#version 330\nout vec4 color;\nvoid main() { color = vec4(0.2, 0.0, "
                     "0.0, 1.0); }\n\"\"\"\n",
                1, 124, 0, 0);
    check_reported(
        "templates", SIZE "    !shader fragment=\"${HEADER} ${more}\"\n    !vignette inset=0\n        " RED,
        "2 [bad-shader] !shader: template '${more}' is not supported, only '${HEADER}'; the default shader is used\n",
        255, 0, 0);
    // The message comes from the driver. If the shader is written in the script, the line is a line of the script.
    static const struct {
        const char *row;
        const char *script;
        const char *reported; // start of the diagnostics
    } bad[] = {
        {"shader is a literal",
         "    !shader alpha=1 fragment=\"\"\"${HEADER}\nout vec4 color;\n\nvoid main() { wrong = 1.0; }\n\"\"\"\n",
         "7:15 [bad-shader] !shader: "},
        {"shader is indented",
         "    !shader fragment=\"\"\"\n\n    #version 330\n    out vec4 color;\n    void main() {\n"
         "        color = wrong;\n    }\n\"\"\"\n",
         "9:17 [bad-shader] !shader: "},
        {"shader is bound to a name",
         "    let text=\"${HEADER} out vec4 c; void main() { c = wrong; }\"\n    !blur fragment=text\n",
         "4:55 [bad-shader] !blur: "},
        {"vertex shader", "    !shader vertex=\"\"\"${HEADER}\nvoid main() { gl_Position = wrong; }\"\"\"\n",
         "5:29 [bad-shader] !shader: "},
        {"shader is computed", "    !shader fragment=concat('${HEADER}';\"\"\"\n\"\"\";'void main() { wrong(); }')\n",
         "4:13 [bad-shader] !shader: line 2 of the shader: "},
        {"shader is read from a file", "    !shader fragment=read('bad.glsl')\n",
         "4:13 [bad-shader] !shader: bad.glsl:3: "},
    };
    FILE *file = fopen("bad.glsl", "w");
    fputs("${HEADER}\nout vec4 c;\nvoid main() { c = wrong; }\n", file);
    fclose(file);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        Drawn drawn;
        char script[1000], start[100];
        snprintf(script, sizeof script, SIZE "    !canvas\n        !rect size=9;9 fill=true color=1;0;0\n%s",
                 bad[i].script);
        drawn_open(&drawn, script, 2);
        assert_claim(bad[i].row, at(&drawn, 0) == 255);
        unsigned line = (unsigned)strtoul(drawn.reported, NULL, 10);
        snprintf(start, sizeof start, "%u:%u%s", line, drawn.column, strchr(drawn.reported, ' '));
        start[strlen(bad[i].reported)] = 0;
        assert_text(bad[i].row, start, bad[i].reported);
        assert_claim(bad[i].row,
                     strchr(drawn.reported, '\n') == drawn.reported + strlen(drawn.reported) - 1); // exactly one line
        drawn_close(&drawn);
    }
    remove("bad.glsl");
}

// petri_view draws the last picture again while a changed script is loaded.
static void test_pictures_outlive_scripts(void **state) {
    (void)state;
    static const char bad[] =
        SIZE "    !shader fragment=\"\"\"${HEADER}\nout vec4 color;\nvoid main() { wrong = 1.0; }\"\"\"\n";
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    Drawn drawn;
    drawn_open(&drawn, SIZE "    !canvas\n", 1);
    assert_int_equal(petri_load_text(drawn.session, "t.fl", bad, PETRI_NUL_TERMINATED), PETRI_OK);
    assert_int_equal(petri_step(drawn.session), PETRI_OK);
    assert_int_equal(petri_picture(drawn.session, &options, &picture), PETRI_OK);
    assert_int_equal(petri_load_text(drawn.session, "t.fl", SIZE, PETRI_NUL_TERMINATED), PETRI_OK);
    assert_int_equal(petri_step(drawn.session), PETRI_OK);
    assert_int_equal(petri_picture_render(picture, drawn.painter), PETRI_OK);
    drawn.reported[0] = '\0';
    petri_picture_report(drawn.session, picture);
    const char *start = "0 [bad-shader] !shader: line "; // line 0: the diagnostic has no position
    assert_memory_equal(drawn.reported, start, strlen(start));
    petri_picture_free(&picture);
    drawn_close(&drawn);
}

static void test_bad_input_is_reported_once(void **state) {
    (void)state;
    static char deep[20000];
    check_reported("sizes out of range",
                   SIZE "    !blur size=100000;4\n        " RED "    !vignette inset=0\n        " RED,
                   "2 [bad-size] !blur: a picture can have 1 to 16384 pixels in width and height\n", 255, 0, 0);
    check_reported("nan",
                   SIZE
                   "    !blur radius=0/0 sigma=1/0\n        !transform rotate=0/0 scale=1e300\n            !canvas\n"
                   "    !vignette inset=0/0\n        " RED,
                   "2 [bad-attribute] !blur: radius should be one number or two, not nan\n"
                   "2 [bad-attribute] !blur: sigma should be one number or two, not inf\n"
                   "3 [bad-attribute] !transform: rotate should be number, not nan\n"
                   "5 [bad-attribute] !vignette: inset should be number, not nan\n",
                   255, 0, 0);
    check_reported(
        "unknown composite mode",
        SIZE "    !blur composite=:nonsense\n        " RED "        " RED "    !vignette inset=0\n        " GREEN,
        "2 [bad-attribute] !blur: composite should be :over, :dest_over, :lighten, :darken, :add, :difference "
        "or :multiply, not :nonsense\n",
        0, 255, 0);
    check_reported("ids that refer to each other",
                   SIZE "    !blur id=:a\n        !reference id=:b\n    !blur id=:b\n        !reference id=:a\n"
                        "        " RED,
                   "", 255, 0, 0);
    int end = snprintf(deep, sizeof deep, SIZE);
    for (int i = 0; i < 98; i++)
        end += snprintf(deep + end, sizeof deep - (size_t)end, "%*s!vignette inset=0\n", i + 1, "");
    snprintf(deep + end, sizeof deep - (size_t)end, "%*s!canvas\n%*s!rect size=9;9 fill=true color=1;0;0\n", 99, "",
             100, "");
    check_reported("98 levels are drawn", deep, "", 255, 0, 0);
    end = snprintf(deep, sizeof deep, SIZE " !canvas\n  !rect size=9;9 fill=true color=0;1;0\n");
    for (int i = 0; i < 100; i++)
        end += snprintf(deep + end, sizeof deep - (size_t)end, "%*s!vignette inset=0\n", i + 1, "");
    snprintf(deep + end, sizeof deep - (size_t)end, "%*s!canvas\n%*s!rect size=9;9 fill=true color=1;0;0\n", 101, "",
             102, "");
    check_reported("100 levels are reported", deep,
                   "0 [too-deep] pictures are nested more than 100 deep; the innermost are left out\n", 0, 255, 0);
}

// Without OpenGL, the children of effects are drawn without the effect. This test must be the last one, because OpenGL
// cannot be used after it.
static void test_without_gpu_children_are_drawn(void **state) {
    (void)state;
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
    setenv("EGL_PLATFORM", "nonsense", 1);
    Drawn drawn;
    drawn_open(&drawn, SIZE "    !adjust exposure=-9\n        " RED "    !blur radius=3 alpha=0\n        " GREEN, 2);
    assert_int_equal(at(&drawn, 0), 255);
    assert_int_equal(at(&drawn, 1), 0);
    assert_claim(drawn.reported, strstr(drawn.reported, "[needs-gpu] effects and 3-D scenes are left out: ") != NULL);
    assert_claim(drawn.reported, strchr(drawn.reported, '\n') == drawn.reported + strlen(drawn.reported) - 1);
    drawn_close(&drawn);
}

// GPU memory of nodes counts towards --memory. Pictures that exceed the limit are omitted, and the rest is drawn in
// each frame.
static void test_memory_limit_is_reported_once(void **state) {
    (void)state;
    static const char *const nodes[] = {
        "    !blur size=2000;2000 radius=1\n        !canvas\n            !rect size=2000 fill=true color=1;0;0\n",
        "    !canvas3d size=1500;1500 samples=4\n        !light color=1\n        !sphere size=500 color=1;0;0\n",
    };
    static const char *const reports[] = {
        "5 [memory-limit] !blur: a picture of 2000 x 2000 pixels exceeds the memory limit (--memory); "
        "it is left out\n",
        "5 [memory-limit] !canvas3d: a picture of 1500 x 1500 pixels exceeds the memory limit "
        "(--memory); it is left out\n",
    };
    for (size_t i = 0; i < COUNT_OF(nodes); i++) {
        char script[1000];
        Drawn drawn;
        snprintf(script, sizeof script, SIZE "    !vignette inset=0\n        " GREEN "%s", nodes[i]);
        drawn_open_with(&drawn, script, 3, 60 << 20);
        assert_text("memory limit", drawn.reported, reports[i]);
        assert_int_equal(at(&drawn, 1), 255);
        assert_int_equal(at(&drawn, 0), 0);
        drawn_close(&drawn);
        drawn_open(&drawn, script, 1);
        assert_text("usual memory", drawn.reported, "");
        assert_in_range(at(&drawn, 0), 200, 255);
        drawn_close(&drawn);
    }
}

TEST_GROUP(tree) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ids_refer_to_pictures),
        cmocka_unit_test(test_memory_limit_is_reported_once),
        cmocka_unit_test(test_nodes_continue_between_frames),
        cmocka_unit_test(test_passes_see_first_and_last),
        cmocka_unit_test(test_uniforms_have_values),
        cmocka_unit_test(test_programs_of_windows),
        cmocka_unit_test(test_shader_errors_are_at_their_lines),
        cmocka_unit_test(test_pictures_outlive_scripts),
        cmocka_unit_test(test_bad_input_is_reported_once),
    };
    static const struct CMUnitTest without[] = {cmocka_unit_test(test_without_gpu_children_are_drawn)};
    if (argc > 1)
        return cmocka_run_group_tests(without, NULL, NULL);
    return drawn_can_run() ? cmocka_run_group_tests(tests, NULL, NULL) : GROUP_SKIPPED;
}
