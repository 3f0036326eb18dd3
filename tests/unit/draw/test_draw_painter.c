// test_draw_painter.c: tests of what a painter draws for which options, of its caches and files, and of its estimates
// of work.
#include "drawing.h"
#include "folder.h"

enum { WIDTH = 8, HEIGHT = 4 };

static const char RED_COLUMN[] =
    "!window size=8;4\n    !canvas\n        !rect size=1;4 fill=true color=1;0;0\n    !canvas\n";

static void test_bars_beside_picture_are_black(void **state) {
    uint32_t pixels[WIDTH * 2 * HEIGHT];
    draw_script(*state, "!window size=8;4\n    !canvas\n        !rect size=8;4 fill=true color=0;1;0\n", pixels, WIDTH,
                2 * HEIGHT);
    assert_int_equal(pixels[0], 0xff000000u);
    assert_int_equal(pixels[2 * WIDTH], 0xff00ff00u);
    assert_int_equal(pixels[6 * WIDTH], 0xff000000u);
}

static void test_background_of_svg_is_black(void **state) {
    Player *player = *state;
    Notebook svg = {0};
    PetriPicture *picture = picture_of(player, "!window size=8;4\n    !canvas\n", 1);
    PetriPainter *painter = petri_painter_open();
    PetriStatus status = petri_picture_encode(picture, painter, ".svg", note, &svg);
    petri_painter_close(&painter);
    petri_picture_free(&picture);
    if (status == PETRI_UNSUPPORTED)
        skip();
    assert_int_equal(status, PETRI_OK);
    assert_non_null(strstr(svg.text, "rgb(0%"));
    assert_null(strstr(svg.text, "rgb(100%"));
    free(svg.text);
}

static void test_detail_reduces_resolution(void **state) {
    Player *player = *state;
    uint32_t pixels[WIDTH * HEIGHT];
    PetriPainter *painter = petri_painter_open();
    PetriPicture *fine = picture_of(player, RED_COLUMN, 1), *coarse = picture_of(player, RED_COLUMN, 0.5);
    draw(fine, painter, pixels, WIDTH, HEIGHT);
    assert_int_equal(pixels[0], 0xffff0000u);
    assert_int_equal(pixels[1], 0xff000000u);
    draw(coarse, painter, pixels, WIDTH, HEIGHT);
    assert_true(pixels[0] < 0xffff0000u && pixels[1] > 0xff000000u); // the column is blurred
    petri_picture_free(&fine);
    petri_picture_free(&coarse);
    petri_painter_close(&painter);
}

// A picture with several canvases uses the render graph, one with a single canvas does not.
static void test_older_picture_is_drawn_again(void **state) {
    Player *player = *state;
    uint32_t pixels[WIDTH * HEIGHT];
    PetriPainter *painter = petri_painter_open();
    PetriPicture *old = picture_of(player, RED_COLUMN, 1);
    PetriPicture *direct = picture_of(player, "!window size=8;4\n    !canvas\n", 1);
    draw(old, painter, pixels, WIDTH, HEIGHT);
    draw(direct, painter, pixels, WIDTH, HEIGHT);
    assert_int_equal(pixels[0], 0xff000000u);
    draw(old, painter, pixels, WIDTH, HEIGHT);
    assert_int_equal(pixels[0], 0xffff0000u);
    petri_picture_free(&old);
    petri_picture_free(&direct);
    petri_painter_close(&painter);
}

static void test_record_is_saved_as_jpeg(void **state) {
    Player *player = *state;
    Folder folder;
    char script[800];
    unsigned char start[3] = {0};
    folder_open(&folder);
    PetriOptions options = player_options(player);
    const char *folders[] = {folder.path, NULL};
    options.write_folders = folders;
    player_reopen(player, &options);
    snprintf(script, sizeof script,
             "!window size=8;4\n    !record filename=\"%s\"\n        !canvas\n            !rect size=8;4 fill=true\n",
             folder_file(&folder, "a.jpg"));
    PetriPicture *picture = picture_of(player, script, 1);
    PetriPainter *painter = petri_painter_open();
    PetriStatus rendered = petri_picture_render(picture, painter);
    PetriStatus saved = rendered == PETRI_OK ? petri_record_save(picture, painter, 0) : rendered;
    FILE *file = fopen(folder_file(&folder, "a.jpg"), "rb");
    size_t length = file ? fread(start, 1, sizeof start, file) : 0;
    if (file)
        fclose(file);
    folder_close(&folder);
    petri_picture_free(&picture);
    petri_painter_close(&painter);
    if (saved == PETRI_UNSUPPORTED)
        skip();
    assert_int_equal(saved, PETRI_OK);
    assert_int_equal(length, sizeof start);
    assert_memory_equal(start, "\xff\xd8\xff", 3); // start of a JPEG file
}

static const char *provide_large_image(void *host, const char *name, size_t *length) {
    static const char header[] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\0\0\0\1\0\0\x08\x06\0\0\0";
    (void)host;
    (void)name;
    *length = sizeof header - 1;
    return header;
}

// The size is read from the first chunk, before memory is allocated.
static void test_png_with_large_size_is_reported(void **state) {
    Player *player = *state;
    uint32_t pixels[WIDTH * HEIGHT];
    PetriOptions options = player_options(player);
    options.read_file = provide_large_image;
    player_reopen(player, &options);
    draw_script(player, "!window size=8;4\n    !canvas\n        !image filename='a.png' size=4\n", pixels, WIDTH,
                HEIGHT);
    assert_non_null(strstr(player_diagnostics(player), "the picture is too large"));
}

// Draws white text. Returns false if one of the families is not installed.
static bool draw_text(Player *player, const char *nodes, uint32_t *pixels, int width, int height) {
    char script[600];
    snprintf(script, sizeof script, "!window size=%d;%d\n    !canvas color=1 font_size=20\n%s", width, height, nodes);
    draw_script(player, script, pixels, width, height);
    return !strstr(player_diagnostics(player), "unknown-font");
}

static void test_text_uses_its_own_family(void **state) {
    enum { SIDE = 60 };
    static uint32_t alone[SIDE * SIDE], after[SIDE * SIDE], spaced[SIDE * SIDE], other[SIDE * SIDE];
#define MONO "        !text text=\"iwi\" point=30;45 font_family=\"DejaVu Sans Mono\"\n"
#define SANS "        !text text=\"iwi\" point=30;15 font_family=\"DejaVu Sans\"\n"
    if (!draw_text(*state, MONO, alone, SIDE, SIDE) || !draw_text(*state, SANS MONO, after, SIDE, SIDE))
        skip();
    size_t half = sizeof alone / 2;
    assert_memory_equal(after + SIDE * SIDE / 2, alone + SIDE * SIDE / 2, half);
    // Spaces around commas are not part of a family's name.
    assert_true(draw_text(
        *state, "        !text text=\"iwi\" point=30;45 font_family=\"No Such Font , DejaVu Sans Mono , x\"\n", spaced,
        SIDE, SIDE));
    assert_memory_equal(spaced, alone, sizeof alone);
    assert_true(
        draw_text(*state, "        !text text=\"iwi\" point=30;45 font_family=\"DejaVu Sans\"\n", other, SIDE, SIDE));
    assert_memory_not_equal(other, alone, sizeof alone);
}

// Draws 20 000 rectangles with a small work limit. Returns the limit that the note names, in units of 2^20.
static double work_of(Player *player, const char *attributes) {
    static uint32_t pixels[500 * 500];
    char script[400];
    double work = 0;
    PetriOptions options = player_options(player);
    options.work_limit = 1 << 19;
    player_reopen(player, &options);
    snprintf(script, sizeof script,
             "!window size=500\n    !canvas\n        for i in ..20000\n            !rect %s fill=true color=1;0;0\n",
             attributes);
    draw_script(player, script, pixels, 500, 500);
    const char *note = strstr(player_diagnostics(player), "--work ");
    assert_non_null(note);
    assert_int_equal(sscanf(note, "--work %lfM suffices", &work), 1);
    return work;
}

static void test_estimated_work_follows_pixels_and_mode(void **state) {
    Player *player = *state;
    double small = work_of(player, "size=50"), large = work_of(player, "size=100");
    double edges = work_of(player, "size=0.5;50"), wide = work_of(player, "size=100;50");
    assert_true(work_of(player, "point=450;450 size=50") == small); // the place does not matter
    assert_true(work_of(player, "point=225;225 size=50") == small);
    // Twice the width doubles the pixels of the same rows; a narrow shape has almost only edges.
    assert_true(edges < small && small < wide && wide < large);
    assert_true(wide - edges > 1.5 * (small - edges) && wide - edges < 2.5 * (small - edges));
    assert_true(work_of(player, "size=0.5;50 composite=:multiply") < 1.2 * edges); // modes change the cost of pixels
    // Modes with conditions for each channel cost more.
    double source = work_of(player, "size=100 composite=:src");
    double multiply = work_of(player, "size=100 composite=:multiply"), hue = work_of(player, "size=100 composite=:hue");
    assert_true(large < source && source < multiply && multiply < hue);
}

TEST_GROUP(draw_painter) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_bars_beside_picture_are_black), PLAYER_TEST(test_background_of_svg_is_black),
        PLAYER_TEST(test_detail_reduces_resolution),     PLAYER_TEST(test_older_picture_is_drawn_again),
        PLAYER_TEST(test_record_is_saved_as_jpeg),       PLAYER_TEST(test_png_with_large_size_is_reported),
        PLAYER_TEST(test_text_uses_its_own_family),      PLAYER_TEST(test_estimated_work_follows_pixels_and_mode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
