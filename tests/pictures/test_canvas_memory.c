// test_canvas_memory.c: lets each allocation during drawing fail in turn, also on an offscreen surface. Checks that all
// Cairo objects are freed.
#include "drawn.h"
#include "heap.h"

#include <cairo.h>
#include <unistd.h>

// Number of existing Cairo contexts, counted with --wrap.
static int contexts;

cairo_t *__real_cairo_create(cairo_surface_t *target);
cairo_t *__wrap_cairo_create(cairo_surface_t *target);
void __real_cairo_destroy(cairo_t *cr);
void __wrap_cairo_destroy(cairo_t *cr);

cairo_t *__wrap_cairo_create(cairo_surface_t *target) {
    contexts++;
    return __real_cairo_create(target);
}

void __wrap_cairo_destroy(cairo_t *cr) {
    contexts -= cr != NULL;
    __real_cairo_destroy(cr);
}

static const char script[] = "!window size=40;40\n"
                             "    !canvas\n"
                             "        !group\n"
                             "            !blend mode=:xor\n"
                             "                !shadow radius=2 offset=3;3\n"
                             "                !paint color=1;0;0\n"
                             "            !noise frequency=0.1 octaves=1\n"
                             "            !rect size=20;20 fill=true\n"
                             "        !blur radius=1\n"
                             "        !pattern filename='tests/pictures/images/small.png'\n"
                             "        !sum\n"
                             "            !round_corners radius=2\n"
                             "            !jitter length=2 deviation=1\n"
                             "        !rect point=5;5 size=20;20 fill=true stroke=true\n"
                             "        !image filename='tests/pictures/images/small.png'\n"
                             "    !canvas linear=true colorbits=16 composite=:add\n"
                             "        !layer size=30;30 alpha=0.5\n"
                             "            !blur radius=1\n"
                             "            !rect size=20;20 fill=true color=3\n";

// Draws once with a new painter, while allocation number `fail_at` fails, and also all later ones if `all` is true.
// Returns the status of drawing. heap.count is then the number of allocations.
static PetriStatus draw_failing(PetriPicture *picture, uint32_t *pixels, long fail_at, bool all) {
    heap_fail(fail_at, all);
    PetriPainter *painter = petri_painter_open();
    PetriStatus status =
        painter ? petri_picture_draw(picture, painter, pixels, 40, 40, 40 * sizeof *pixels) : PETRI_OUT_OF_MEMORY;
    long count = heap.count;
    heap_restore();
    petri_painter_close(&painter);
    heap.count = count;
    return status;
}

static void test_each_failed_allocation_frees_all(void **state) {
    (void)state;
    static uint32_t wanted[1600], pixels[1600];
    Drawn drawn;
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    drawn_open(&drawn, script, 0);
    assert_int_equal(petri_step(drawn.session), PETRI_OK);
    assert_int_equal(petri_picture(drawn.session, &options, &picture), PETRI_OK);
    assert_int_equal(draw_failing(picture, wanted, -1, false), PETRI_OK);
    petri_picture_report(drawn.session, picture);
    assert_string_equal(drawn.reported, "");
    long count = heap.count, failed = 0;
    assert_true(count > 30);
    assert_int_equal(contexts, 0);
    for (long i = 0; i < 2 * count; i++) {
        PetriStatus status = draw_failing(picture, pixels, i / 2, i % 2);
        assert_int_equal(contexts, 0);
        failed += status == PETRI_OUT_OF_MEMORY;
        if (status == PETRI_OK)
            assert_memory_equal(pixels, wanted, sizeof wanted);
        else
            assert_int_equal(status, PETRI_OUT_OF_MEMORY);
    }
    assert_true(failed > count);
    petri_picture_free(&picture);
    drawn_close(&drawn);
}

int main(int argc, char **argv) {
    if (argc < 2 || chdir(argv[1]) != 0)
        return 2;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_failed_allocation_frees_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
