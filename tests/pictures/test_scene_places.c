// test_scene_places.c: checks positions in an image that was rendered by Flitter: the six spheres of spec canvas3d.md
// 10.5.
//
// The page gives the centres and colours of the spheres, but not the script. The spheres are evenly spaced on a
// horizontal circle, ordered by hue. Four parameters of the camera are unknown: its distance and height in units of the
// circle's radius, its angle from the first sphere, and its field of view. A least-squares fit gives 3.0854, 0.5623, 10
// degrees and a sixth of a turn, with the focus at the circle's centre. With these parameters, all twelve numbers of
// the page must result.
#include "drawn.h"

#include <math.h>

static const char script[] =
    "!window size=1920;1080\n"
    "    !canvas3d fov=1/6 near=0.1 far=9 viewpoint=3.0854*cos(10/360);0.5623;3.0854*sin(10/360)\n"
    "        for i in ..6\n"
    "            !sphere size=0.03 emissive=hsv(i/6;1;1) position=cos(i/6);0;-sin(i/6)\n";

typedef struct Place {
    const char *name;
    int x, y;
    int bright[3]; // channels that are expected to be bright
} Place;

static const Place places[] = {{"red", 1093, 675, {1, 0, 0}},   {"yellow", 1518, 576, {1, 1, 0}},
                               {"green", 1298, 489, {0, 1, 0}}, {"cyan", 890, 468, {0, 1, 1}},
                               {"blue", 510, 511, {0, 0, 1}},   {"magenta", 451, 617, {1, 0, 1}}};

static bool is_of(const Drawn *drawn, int x, int y, const int bright[3]) {
    for (int k = 0; k < 3; k++)
        if ((drawn_byte(drawn, x, y, k) > 127) != bright[k])
            return false;
    return true;
}

static void test_spheres_are_where_flitter_draws_them(void **state) {
    (void)state;
    Drawn drawn;
    drawn_open(&drawn, script, 1);
    assert_text("diagnostics", drawn.reported, "");
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const Place *place = &places[i];
        double x = 0, y = 0, count = 0;
        for (int row = 0; row < drawn.height; row++)
            for (int column = 0; column < drawn.width; column++)
                if (is_of(&drawn, column, row, place->bright)) {
                    x += column + 0.5;
                    y += row + 0.5;
                    count++;
                }
        assert_claim(place->name, count > 50 && fabs(x / count - place->x) <= 1 && fabs(y / count - place->y) <= 1);
    }
    drawn_close(&drawn);
}

TEST_GROUP(scene_places) {
    if (!drawn_can_run())
        return GROUP_SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_spheres_are_where_flitter_draws_them)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
