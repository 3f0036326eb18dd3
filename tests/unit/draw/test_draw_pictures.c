// test_draw_pictures.c: tests of petri_picture: which content it chooses, and copies of frames that are rendered later.
#include "display_rows.h"
#include "petri-draw.h"
#include "picture/painter.h"
#include "player.h"

#include <dirent.h>
#include <limits.h>

static const char DISC[] = "!window size=8;4 title=\"disc \";frame\n"
                           "    !canvas\n"
                           "        !rect point=frame;0 size=1;4 fill=true color=1;0;0 antialias=false\n"
                           "    !record filename=\"a.png\" if frame==1\n";

static PetriPicture *make_picture(Player *player, PetriPictureOptions options, PetriStatus wanted) {
    PetriPicture *picture = NULL;
    assert_int_equal(petri_picture(player->session, &options, &picture), wanted);
    assert_true((picture != NULL) == (wanted == PETRI_OK));
    return picture;
}

// Returns the column of the only red pixel in the first row, or -2 if this build cannot draw.
static int red_column(PetriPicture *picture) {
    uint32_t pixels[8 * 4];
    PetriPainter *painter = petri_painter_open();
    PetriStatus status = petri_picture_draw(picture, painter, pixels, 8, 4, 8 * sizeof *pixels);
    petri_painter_close(&painter);
    if (status == PETRI_UNSUPPORTED)
        return -2;
    assert_int_equal(status, PETRI_OK);
    int column = -1;
    for (int x = 0; x < 8; x++) {
        assert_true(pixels[x] == 0xff000000u || pixels[x] == 0xffff0000u);
        if (pixels[x] == 0xffff0000u)
            column = x;
    }
    return column;
}

// The picture of each window is selected without rendering the frame again, which would continue its history.
static void test_select_windows(void **state) {
    Player *player = *state;
    static const char script[] = "!window size=8;4 id=:first title=\"1\"\n"
                                 "    !canvas\n"
                                 "        !rect point=1;0 size=1;4 fill=true color=1;0;0 antialias=false\n"
                                 "!offscreen size=8;4\n"
                                 "    !canvas\n"
                                 "!window size=8;4 title=\"2\"\n"
                                 "!window size=9;4 title=\"3\"\n"
                                 "    !canvas\n"
                                 "        !rect point=2;0 size=1;4 fill=true color=1;0;0 antialias=false\n"
                                 "!window size=0;4 title=\"4\"\n"
                                 "    !canvas\n";
    player_run(player, script, 1);
    PetriPictureOptions options = petri_default_picture_options();
    options.window = PETRI_ALL_WINDOWS;
    PetriPicture *picture = make_picture(player, options, PETRI_OK);
    assert_int_equal(petri_picture_window(picture), 0);
    assert_string_equal(petri_picture_window_id(picture, 0), "first");
    assert_string_equal(petri_picture_window_id(picture, 3), "");
    assert_string_equal(petri_picture_window_id(picture, 99), "");
    assert_int_equal(petri_picture_next_window(picture, -1), 0);
    assert_int_equal(petri_picture_next_window(picture, 0), 3);
    assert_int_equal(petri_picture_next_window(picture, 3), 4);
    assert_int_equal(petri_picture_next_window(picture, 4), -1);
    assert_int_equal(petri_picture_next_window(picture, INT_MAX), -1);
    int width, height, column = red_column(picture);
    assert_true(column == 1 || column == -2);
    assert_int_equal(petri_picture_select(picture, 3), PETRI_OK);
    petri_picture_size(picture, &width, &height);
    assert_int_equal(width, 9);
    assert_string_equal(petri_picture_title(picture), "3");
    assert_int_equal(petri_picture_window(picture), 3);
    assert_int_equal(petri_picture_select(picture, 4), PETRI_INVALID); // its size is not valid
    assert_int_equal(petri_picture_select(picture, 1), PETRI_INVALID); // an !offscreen
    assert_int_equal(petri_picture_select(picture, 5), PETRI_INVALID);
    assert_int_equal(petri_picture_select(picture, -1), PETRI_INVALID);
    assert_int_equal(petri_picture_window(picture), 3);
    petri_picture_report(player->session, picture);
    assert_non_null(strstr(player->diagnostics.text, "not 0 x 4"));
    assert_int_equal(petri_picture_select(picture, 0), PETRI_OK);
    assert_int_equal(red_column(picture), column);
    petri_picture_free(&picture);
}

// Returns the number of threads of this process, or 0 if the system does not list them.
static int thread_count(void) {
    DIR *threads = opendir("/proc/self/task");
    int count = 0;
    while (threads && readdir(threads))
        count++;
    if (threads)
        closedir(threads);
    return count;
}

static void test_frames_that_must_be_rendered(void **state) {
    Player *player = *state;
    static const struct {
        const char *pictures;
        bool must, needs;
    } cases[] = {
        {"    !canvas id=:a\n", false, false},
        {"    !canvas id=:a\n    !reference id=:a\n", false, true},
        {"    !canvas id='a'\n    !reference id='a'\n", false, true},
        {"    !shader id=:a\n        !canvas\n    !reference id=:a\n", false, true},
        {"    !canvas id=:a\n    !canvas\n        !image image_id=:a\n", false, true},
        {"    !canvas id=:a\n    !record filename=null\n        !reference id=:a\n", false, true},
        {"    !reference id=:a\n    !canvas id=:a\n", true, true}, // the picture of the previous frame
        {"    !canvas id=:a\n        !image image_id=:a\n", true, true},
        {"    !canvas id=:a\n    !reference id=:b\n", true, true},
        {"    !canvas id=:a\n    !reference\n", true, true},
        {"    !image id=:a filename='missing.png'\n    !reference id=:a\n", true, true},
        {"    !canvas id=:a\n    !record filename='a.png'\n        !reference id=:a\n", true, true},
        {"    !feedback\n        !canvas\n", true, true},
        {"    !shader fragment='last'\n        !canvas\n", true, true},
        {"    !canvas id=:a\n    !shader fragment='beats'\n        !reference id=:a\n", true, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char script[300];
        snprintf(script, sizeof script, "!window size=8;4\n%s", cases[i].pictures);
        player_run(player, script, 1);
        assert_int_equal(petri_must_render(player->session), cases[i].must);
        assert_int_equal(petri_needs_history(player->session), cases[i].needs);
    }
    assert_false(petri_must_render(NULL));
}

// Pango searches for fonts in a background thread. A process may exit before the search has ended.
static void test_no_fonts_without_text(void **state) {
    Player *player = *state;
    player_run(player, DISC, 1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    int before = thread_count();
    uint32_t pixels[8 * 4];
    PetriPainter *painter = petri_painter_open();
    (void)petri_picture_draw(picture, painter, pixels, 8, 4,
                             8 * sizeof *pixels); // unsupported in builds that cannot draw
    assert_int_equal(thread_count(), before);
    petri_painter_close(&painter);
    petri_picture_free(&picture);
}

static void test_picture_outlives_session(void **state) {
    Player *player = *state;
    int width, height;
    player_run(player, DISC, 2);
    PetriPicture *second = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_true(petri_needs_history(player->session));
    player_step(player, 3);
    PetriPicture *fifth = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_false(petri_needs_history(player->session));
    assert_int_equal(petri_load_text(player->session, "t.fl", "!x", PETRI_NUL_TERMINATED), PETRI_OK);
    PetriOptions options = player_options(player);
    player_reopen(player, &options); // closes the first session
    assert_string_equal(petri_picture_title(second), "disc 1");
    assert_int_equal(petri_picture_frame(fifth), 4);
    PetriPainter *painter = petri_painter_open();
    PetriRecord record;
    assert_true(petri_picture_needs_history(second));
    assert_false(petri_picture_needs_history(fifth));
    if (petri_picture_render(second, painter) != PETRI_UNSUPPORTED) {
        assert_true(petri_picture_record(second, painter, 0, &record, sizeof record));
        assert_string_equal(record.file, "a.png");
        assert_false(petri_picture_record(second, painter, 1, &record, sizeof record));
        assert_false(petri_picture_record(fifth, painter, 0, &record, sizeof record)); // fails because another picture
                                                                                       // was rendered last
    }
    petri_painter_close(&painter);
    petri_picture_size(second, &width, &height);
    assert_int_equal(width, 8);
    assert_int_equal(height, 4);
    if (red_column(second) != -2) {
        assert_int_equal(red_column(fifth), 4);
        assert_int_equal(red_column(second), 1);
    }
    petri_picture_free(&second);
    petri_picture_free(&fifth);
    petri_picture_free(&fifth);
}

static void check_size(Player *player, PetriPictureOptions options, int width, int height) {
    int w, h;
    PetriPicture *picture = make_picture(player, options, PETRI_OK);
    petri_picture_size(picture, &w, &h);
    assert_int_equal(w, width);
    assert_int_equal(h, height);
    petri_picture_free(&picture);
}

static void test_sizes_and_options_are_checked(void **state) {
    Player *player = *state;
    PetriPictureOptions options = petri_default_picture_options();
    player_run(player, DISC, 1);
    options.scale = 2.5;
    check_size(player, options, 20, 10);
    options.scale = 1e6;
    make_picture(player, options, PETRI_INVALID);
    assert_text(
        "scale", player_diagnostics(player),
        "error a picture can have 1 to 16384 pixels in width and height, not 8000000 x 4000000 [cannot-draw]\n");
    options = petri_default_picture_options();
    options.width = 5;
    options.height = 3;
    check_size(player, options, 5, 3);
    options.height = -1;
    make_picture(player, options, PETRI_INVALID);
    make_picture(player, (PetriPictureOptions){.scale = 1, .window = -1}, PETRI_INVALID); // `size` is not initialised
    PetriPictureOptions coarse = petri_default_picture_options();
    coarse.detail = 0;
    make_picture(player, coarse, PETRI_INVALID);
    coarse.detail = 1.5;
    make_picture(player, coarse, PETRI_INVALID);
    options = petri_default_picture_options();
    options.size = SIZE_MAX;
    make_picture(player, options, PETRI_INVALID);
    player_run(player, "!window\n    !canvas\n", 1);
    options.size = offsetof(PetriPictureOptions, detail); // an earlier version of petri-draw.h
    options.detail = -1;
    check_size(player, options, 512, 512);
    check_size(player, petri_default_picture_options(), 512, 512);
    player_run(player, "!window\n    !canvas size=30;20\n", 1);
    check_size(player, petri_default_picture_options(), 512, 512);
}

// Chooses between windows, canvases and particles.
static void test_choice_of_content(void **state) {
    Player *player = *state;
    PetriPictureOptions options = petri_default_picture_options();
    make_picture(player, options, PETRI_INVALID);
    player_run(player, "!x\n", 1);
    assert_false(petri_has_picture(player->session));
    make_picture(player, options, PETRI_INVALID);
    player_run(player, "!window size=3;3\n    !video\n!offscreen size=4;4\n    !canvas\n", 1);
    assert_true(petri_has_picture(player->session));
    check_size(player, options, 4, 4);
    options.window = 0;
    check_size(player, options, 3, 3);
    options.window = 2;
    make_picture(player, options, PETRI_INVALID);
    options = petri_default_picture_options();
    options.automatic = PETRI_AUTO_ALWAYS;
    make_picture(player, options, PETRI_INVALID);
    player_run(player, "!physics state=:a dimensions=2\n    !particle id=1 position=0/0;0\n    !particle id=2\n", 1);
    assert_true(petri_has_picture(player->session));
    check_size(player, petri_default_picture_options(), 1080, 1080);
    options.automatic = PETRI_AUTO_NEVER;
    make_picture(player, options, PETRI_INVALID);
}

typedef struct Bytes {
    char text[8];
    size_t length;
} Bytes;

static bool collect_bytes(void *host, const char *text, size_t length) {
    Bytes *bytes = host;
    bytes->length = length < sizeof bytes->text ? length : sizeof bytes->text;
    memcpy(bytes->text, text, bytes->length);
    return true;
}

static bool reject_bytes(void *host, const char *text, size_t length) {
    (void)host, (void)text, (void)length;
    return false;
}

// Encodes a file to memory.
static bool reject_shader(void *user_data, const char *vertex, const char *fragment, PetriShaderProblem *problem) {
    (void)vertex;
    (void)fragment;
    problem->failed = user_data; // NULL: the driver rejected the shader
    strcpy(problem->text, "rejected by the test");
    return false;
}

static bool lacks_shader(Player *player, void *user_data) {
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    PetriPainter *painter = petri_painter_open();
    petri_painter_test_shaders(painter, reject_shader, user_data);
    assert_false(petri_picture_lacks_shader(picture));
    PetriStatus status = petri_picture_render(picture, painter);
    assert_true(status == PETRI_OK || status == PETRI_UNSUPPORTED);
    bool lacks = petri_picture_lacks_shader(picture);
    petri_painter_close(&painter);
    petri_picture_free(&picture);
    return lacks;
}

static void test_failed_shader_is_lacking(void **state) {
    Player *player = *state;
    player_run(player, "!window size=9\n    !shader fragment='void main() {}'\n", 1);
    PetriShaderProblem problem;
    bool has_opengl = petri_shader_try("#version 300 es\nvoid main() { gl_Position = vec4(1); }",
                                       "#version 300 es\nvoid main() {}", &problem, sizeof problem);
    assert_false(petri_picture_lacks_shader(NULL));
    assert_false(lacks_shader(player, NULL));
    assert_int_equal(lacks_shader(player, player), has_opengl);
}

static void test_encode_to_memory(void **state) {
    Player *player = *state;
    player_run(player, DISC, 1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    PetriPainter *painter = petri_painter_open();
    Bytes bytes = {.length = 0};
    PetriStatus status = petri_picture_encode(picture, painter, ".png", collect_bytes, &bytes);
    if (status != PETRI_UNSUPPORTED) {
        assert_int_equal(status, PETRI_OK);
        assert_memory_equal(bytes.text, "\x89PNG\r\n", 6);
        assert_int_equal(petri_picture_encode(picture, painter, "any.svg", collect_bytes, &bytes), PETRI_OK);
        assert_memory_equal(bytes.text, "<?xml", 5);
        assert_int_equal(petri_picture_encode(picture, painter, ".svg", reject_bytes, NULL), PETRI_INVALID);
    }
    assert_int_equal(petri_picture_encode(picture, painter, ".svg", NULL, NULL), PETRI_INVALID);
    assert_int_equal(petri_picture_encode(picture, painter, "svg", collect_bytes, &bytes), PETRI_INVALID);
    assert_int_equal(petri_picture_encode(picture, NULL, ".svg", collect_bytes, &bytes), PETRI_INVALID);
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

static void test_misuse_is_rejected(void **state) {
    Player *player = *state;
    uint32_t pixels[16];
    player_run(player, DISC, 1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    PetriPainter *painter = petri_painter_open();
    assert_int_equal(petri_picture_draw(picture, painter, pixels, 0, 4, 64), PETRI_INVALID);
    assert_int_equal(petri_picture_draw(picture, painter, pixels, 4, 4, 15), PETRI_INVALID);
    assert_int_equal(petri_picture_draw(picture, painter, pixels, 4, 1, 12), PETRI_INVALID);
    assert_int_equal(petri_picture_save(picture, painter, "x.jpg"), PETRI_INVALID);
    petri_picture_report(player->session, picture);
    assert_text("suffix", player_diagnostics(player),
                "error cannot write 'x.jpg': the name of a picture must end in .png, .svg or .pdf [cannot-write]\n");
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

// Frames 0 and 1 of windows whose systems have not been simulated before cannot show particles yet.
static void test_ready_once_particles_can_be_shown(void **state) {
    Player *player = *state;
    PetriPictureOptions own = petri_default_picture_options(), automatic = own;
    automatic.automatic = PETRI_AUTO_ALWAYS;
    static const char window[] = "!window size=8;4\n    !canvas\n";
    static const struct {
        const char *system;
        bool ready[3];
    } rows[] = {
        {"", {true, true, true}},
        {"!physics state=:a dimensions=1\n    !particle id=1\n", {false, false, true}},
        // The time stands still, so the system is never simulated and its particles are not stored.
        {"!physics state=:a dimensions=1 time=0\n    !particle id=1\n", {false, false, true}},
        // A system without `state` is skipped, so there are no particles to wait for.
        {"!physics dimensions=1\n    !particle id=1\n", {true, true, true}},
        {"!counter state=:a\n", {true, true, true}},
    };
    char script[300];
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        snprintf(script, sizeof script, "%s%s", rows[i].system, window);
        for (int frame = 0; frame < 3; frame++) {
            if (frame == 0) {
                player_run(player, script, 1);
                petri_reset(player->session);
            }
            player_step(player, 1);
            assert_int_equal(petri_frame_number(player->session), frame);
            assert_int_equal(petri_picture_ready(player->session, &own), rows[i].ready[frame]);
            assert_true(petri_picture_ready(player->session, &automatic));
        }
    }
    player_run(player, rows[1].system, 1); // without a canvas, the automatic picture is chosen
    assert_true(petri_picture_ready(player->session, &own));
    snprintf(script, sizeof script, "%s%s", rows[1].system, window);
    player_run(player, script, 5);
    player_run(player, script, 1); // reloaded: frame 0, with the old state
    assert_int_equal(petri_frame_number(player->session), 0);
    assert_true(petri_picture_ready(player->session, &own));
}

// Draws a panel with one line of text over blue pixels. Only pixels in the panel change, and none becomes transparent.
static void test_label_changes_only_its_panel(void **state) {
    enum { WIDTH = 100, HEIGHT = 60 };
    (void)state;
    static uint32_t pixels[HEIGHT][WIDTH];
    const uint32_t blue = 0xff0000ff, panel = 0xff800000;
    PetriLabel label = {.text = "HHH\n",
                        .x = 10,
                        .y = 10,
                        .width = 40,
                        .height = 20,
                        .size = 8,
                        .line_height = 10,
                        .padding = 6,
                        .background = {128 / 255.0, 0, 0, 1},
                        .foreground = {1, 1, 1, 1},
                        .accent = {0, 1, 0, 1}};
    PetriPainter *painter = petri_painter_open();
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            pixels[y][x] = blue;
    PetriStatus status =
        petri_painter_draw_labels(painter, &label, 1, sizeof label, 2, pixels[0], WIDTH, HEIGHT, sizeof pixels[0]);
    petri_painter_close(&painter);
    if (status == PETRI_UNSUPPORTED)
        return;
    int letter_pixels = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            bool inside = x >= 20 && y >= 20;
            assert_true(inside || pixels[y][x] == blue);
            assert_int_equal(pixels[y][x] >> 24, 255);
            letter_pixels += (pixels[y][x] >> 16 & 255) > 192;
        }
    assert_int_equal(pixels[40][22], 0xff00ff00u); // a pixel of the green stripe
    assert_int_equal(pixels[24][60], panel);
    assert_true(letter_pixels > 10);
}

static void test_labels_need_painter_and_pixels(void **state) {
    (void)state;
    uint32_t pixel = 7;
    PetriPainter *painter = petri_painter_open();
    if (petri_painter_draw_labels(painter, NULL, 0, sizeof(PetriLabel), 1, &pixel, 1, 1, 4) != PETRI_UNSUPPORTED) {
        assert_int_equal(petri_painter_draw_labels(NULL, NULL, 0, 0, 0, NULL, 0, 0, 0), PETRI_INVALID);
        assert_int_equal(petri_painter_draw_labels(painter, NULL, 0, sizeof(PetriLabel), 1, NULL, 1, 1, 4),
                         PETRI_INVALID);
        assert_int_equal(petri_painter_draw_labels(painter, NULL, 1, sizeof(PetriLabel), 1, &pixel, 1, 1, 4),
                         PETRI_INVALID);
        assert_int_equal(pixel, 7);
    }
    petri_painter_close(&painter);
}

// Images are read by the host's callback, not from disk.
static const char *provide_image(void *host, const char *name, size_t *length) {
    (void)host;
    static const char bytes[] = "not an image";
    *length = sizeof bytes - 1;
    return strcmp(name, "images/a.png") == 0 ? bytes : NULL;
}

static void test_images_come_from_host(void **state) {
    Player *player = *state;
    uint32_t pixels[8 * 4];
    PetriOptions options = player_options(player);
    options.read_file = provide_image;
    player_reopen(player, &options);
    player_run(player,
               "!window size=8;4\n    !canvas\n        !image filename='images/./a.png' size=4;4\n"
               "        !image filename='/etc/passwd' size=4;4\n",
               1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    PetriPainter *painter = petri_painter_open();
    PetriStatus status = petri_picture_draw(picture, painter, pixels, 8, 4, 8 * sizeof *pixels);
    petri_picture_report(player->session, picture);
    const char *reported = player_diagnostics(player);
    if (status != PETRI_UNSUPPORTED) {
        assert_non_null(strstr(reported, "cannot read 'images/./a.png': it is neither PNG nor JPEG"));
        assert_non_null(strstr(reported, "cannot read '/etc/passwd': No such file"));
    }
    petri_painter_close(&painter);
    petri_picture_free(&picture);
}

// Returns one letter for each command of a picture's display list, without the operands.
static const char *kinds_of(PetriPicture *picture) {
    static char letters[256];
    const double *n;
    size_t count, length = 0;
    assert_int_equal(petri_picture_display_list(picture, &n, &count), PETRI_OK);
    for (size_t at = 3; at < count; length++) {
        size_t size = display_row_size(n + at);
        letters[length] = (char)('a' + (int)n[at]);
        at += size;
        assert_true(size > 0 && at <= count && length + 2 < sizeof letters);
    }
    letters[length] = 0;
    return letters;
}

static void check_kinds(Player *player, const char *script, const char *wanted) {
    player_run(player, script, 1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_string_equal(kinds_of(picture), wanted);
    petri_picture_free(&picture);
}

// Display lists for hosts with their own renderer contain the whole canvas, whatever this build can draw.
static void test_display_list_has_whole_canvas(void **state) {
    Player *player = *state;
    const double *n;
    size_t count;
    check_kinds(player, "!window size=8;4\n    !canvas\n        !rect size=1;2 fill=true color=1;0.5;0\n", "abef");
    check_kinds(
        player,
        "!window size=8;4\n    !canvas\n        !group translate=1;2\n            !rect size=1\n            !clip\n"
        "            !gradient start=0;0 end=1;1\n                !stop color=1\n                !stop color=0\n"
        "            !rect size=4;2 fill=true\n        !layer size=3 alpha=0.5\n            !text text='é' point=1;2\n"
        "        !image filename='a.png' size=2\n",
        "jabeicefkjabeilabegmabehk");
    check_kinds(player, "!window size=8;4\n    !bloom radius=2\n        !canvas\n    !canvas3d\n", "nn");
    check_kinds(player,
                "!window size=8;4\n    !canvas\n        !pattern image_id=:other\n        !rect size=4;2 fill=true\n"
                "    !canvas id=:other\n",
                "nabnef");
    // Filters that are nested too deeply are ignored.
    check_kinds(player,
                "func nest(n)\n    !offset offset=1;0\n        if n > 0\n            nest(n-1)\n"
                "!window size=8;4\n    !canvas\n        nest(120)\n        !rect size=1;2 fill=true\n",
                "abef");
    // If path effects create too many elements, this is reported once, and later paths are drawn without effects.
    check_kinds(player,
                "!window size=8;4\n    !canvas\n        !group\n            !jitter length=0.00004 deviation=1\n"
                "            for i in ..25\n                !line points=0;0;4;i stroke=true\n",
                "abeffffffffffffffffffffnfffff");
    // The automatic picture: background, clip, axes, a disc, the scale bar.
    player_run(player, "!physics state=:p dimensions=2 time=time\n    !particle id=1 position=3;4 radius=2 charge=1\n",
               3);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_string_equal(kinds_of(picture), "ojaibefbfbefk");
    assert_int_equal(petri_picture_display_list(picture, &n, &count), PETRI_OK);
    assert_true(n[2] == 0); // neither filters nor noise
    assert_int_equal(petri_picture_display_list(picture, NULL, &count), PETRI_INVALID);
    assert_int_equal(petri_picture_display_list(NULL, &n, &count), PETRI_INVALID);
    petri_picture_free(&picture);
}

// The alpha of the canvas applies to a !color node as well as to a gradient.
static void test_display_list_multiplies_alpha_of_color_nodes(void **state) {
    Player *player = *state;
    const double *n, wanted[] = {PETRI_DRAW_SOLID, 1, 0.5, 0, 0.25, 0.5};
    size_t count, at = 3;
    player_run(player,
               "!window size=8;4\n    !canvas color=0;0;1;0.5\n        !color color=1;0.5;0;0.25\n"
               "        !rect size=1;2 fill=true\n",
               1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_int_equal(petri_picture_display_list(picture, &n, &count), PETRI_OK);
    while (at < count && n[at] != PETRI_DRAW_SOLID)
        at += display_row_size(n + at);
    assert_true(at + 6 <= count);
    for (size_t i = 0; i < 6; i++)
        assert_true(n[at + i] == wanted[i]);
    petri_picture_free(&picture);
}

static void check_whole(Player *player, const char *script, bool whole) {
    player_run(player, script, 1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_int_equal(petri_picture_is_display_list(picture), whole);
    petri_picture_free(&picture);
}

static void test_is_display_list_without_effects(void **state) {
    Player *player = *state;
    check_whole(player, "!window\n    !canvas\n", true);
    check_whole(player, "!window\n    !canvas\n    !canvas\n", false);
    check_whole(player, "!window\n    !canvas3d\n", false);
    check_whole(player, "!window\n    !bloom\n        !canvas\n", false);
    check_whole(player, "!physics state=:p dimensions=2 time=time\n    !particle id=1\n", true);
    assert_false(petri_picture_is_display_list(NULL));
}

// A host's backend that fills the left half of each picture. The green level is `count`, the length of the display
// list. Returns false if the list has no commands.
static bool fill_black(void *host, const double *numbers, size_t count, int width, int height, uint32_t *pixels) {
    ++*(int *)host;
    assert_int_equal(numbers[0], width);
    assert_int_equal(numbers[1], height);
    for (int i = 0; i < width * height; i++)
        pixels[i] = i % width < width / 2 ? 0xff000000u | (uint32_t)count << 8 : 0;
    return count > 3;
}

static const uint32_t *provide_pixels(void *host, const char *file, int *width, int *height) {
    static const uint32_t pixels[] = {0xff0000ffu, 0xff0000ffu};
    (void)host;
    *width = 2, *height = 1;
    return strcmp(file, "a.png") == 0 ? pixels : NULL;
}

// A painter without a backend is what builds without Cairo open.
static void test_host_backend_draws_canvases(void **state) {
    Player *player = *state;
    PetriPainter *painter = painter_open(NULL);
    int calls = 0;
    uint32_t pixels[8];
    PetriCanvasBackend host = {.size = sizeof host, .draw = fill_black, .image = provide_pixels, .user_data = &calls};
    assert_int_equal(petri_painter_use_backend(NULL, &host), PETRI_INVALID);
    assert_int_equal(petri_painter_use_backend(painter, NULL), PETRI_INVALID);
    assert_int_equal(petri_painter_use_backend(painter, &(PetriCanvasBackend){.size = sizeof host}), PETRI_INVALID);
    assert_int_equal(petri_painter_use_backend(painter, &host), PETRI_OK);
    player_run(player,
               "!window size=4;2\n    !image filename='a.png' size=4;2\n    !image filename='b.png'\n    !canvas\n"
               "        !rect size=1 fill=true\n",
               1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_int_equal(petri_picture_draw(picture, painter, pixels, 4, 2, 4 * sizeof *pixels), PETRI_OK);
    petri_picture_report(player->session, picture);
    assert_non_null(strstr(player_diagnostics(player), "cannot read 'b.png'"));
    assert_int_equal(calls, 1);
    assert_int_equal(pixels[1] >> 16, 0xff00);
    assert_true((pixels[1] & 0xff00) > 0 && (pixels[1] & 0xff) == 0);
    assert_int_equal(pixels[2], 0xff0000ffu);
    assert_int_equal(petri_painter_use_backend(painter, &host), PETRI_INVALID); // a picture was rendered
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

// At another size, the picture is scaled to fit and centred.
static void test_host_backend_scales_rendered_pictures(void **state) {
    Player *player = *state;
    PetriPainter *painter = painter_open(NULL);
    int calls = 0;
    uint32_t pixels[4 * 6];
    PetriCanvasBackend host = {.size = sizeof host, .draw = fill_black, .user_data = &calls};
    assert_int_equal(petri_painter_use_backend(painter, &host), PETRI_OK);
    player_run(player, "!window size=4;2\n    !canvas\n        !rect size=1 fill=true\n    !canvas\n", 1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    petri_picture_draw(picture, painter, pixels, 4, 6, 4 * sizeof *pixels); // the second canvas is empty, so it fails
    assert_int_equal(calls, 2);
    for (int y = 0; y < 6; y++) {
        bool green = (pixels[4 * y] & 0xff00) > 0;
        assert_int_equal(green, y == 2 || y == 3);
    }
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

static bool take_bytes(void *user_data, const char *bytes, size_t length) {
    (void)user_data, (void)bytes, (void)length;
    return true;
}

static void test_painter_without_backend_reports_that_it_cannot_draw(void **state) {
    Player *player = *state;
    PetriPainter *painter = painter_open(NULL);
    uint32_t pixels[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    PetriLabel label = {.text = "a", .width = 2, .height = 2, .size = 1, .line_height = 1};
    player_run(player, "!window size=4;2\n    !image filename='a.png'\n    !canvas\n        !rect size=1 fill=true\n",
               1);
    PetriPicture *picture = make_picture(player, petri_default_picture_options(), PETRI_OK);
    assert_int_equal(petri_picture_render(picture, painter), PETRI_OK); // canvases and images are left out
    assert_int_equal(petri_picture_draw(picture, painter, pixels, 4, 2, 4 * sizeof *pixels), PETRI_UNSUPPORTED);
    assert_int_equal(pixels[0], 0);
    assert_int_equal(petri_picture_encode(picture, painter, ".png", take_bytes, NULL), PETRI_UNSUPPORTED);
    assert_int_equal(petri_picture_encode(picture, painter, ".svg", take_bytes, NULL), PETRI_UNSUPPORTED);
    assert_int_equal(petri_painter_draw_labels(painter, &label, 1, sizeof label, 1, pixels, 4, 2, 16),
                     PETRI_UNSUPPORTED);
    petri_picture_report(player->session, picture);
    assert_non_null(strstr(player_diagnostics(player), "this build of petri cannot draw"));
    petri_painter_serve(painter, player->session);
    player_run(player, "!print text=measure_text('a')\n", 1);
    assert_non_null(strstr(player_diagnostics(player), "there are no fonts"));
    petri_painter_serve(NULL, player->session);
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

TEST_GROUP(draw_pictures) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_frames_that_must_be_rendered),
        PLAYER_TEST(test_no_fonts_without_text),
        PLAYER_TEST(test_select_windows),
        PLAYER_TEST(test_picture_outlives_session),
        PLAYER_TEST(test_sizes_and_options_are_checked),
        PLAYER_TEST(test_choice_of_content),
        PLAYER_TEST(test_failed_shader_is_lacking),
        PLAYER_TEST(test_encode_to_memory),
        PLAYER_TEST(test_misuse_is_rejected),
        PLAYER_TEST(test_ready_once_particles_can_be_shown),
        PLAYER_TEST(test_label_changes_only_its_panel),
        PLAYER_TEST(test_labels_need_painter_and_pixels),
        PLAYER_TEST(test_images_come_from_host),
        PLAYER_TEST(test_display_list_has_whole_canvas),
        PLAYER_TEST(test_display_list_multiplies_alpha_of_color_nodes),
        PLAYER_TEST(test_is_display_list_without_effects),
        PLAYER_TEST(test_host_backend_draws_canvases),
        PLAYER_TEST(test_host_backend_scales_rendered_pictures),
        PLAYER_TEST(test_painter_without_backend_reports_that_it_cannot_draw),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
