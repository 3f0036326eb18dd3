// test_seed_dish.c: the seed's example, a dish of charged cells, behaves as the seed describes.
#include "world.h"

enum { CELLS = 60 };

#define RADIUS 300.0

// Returns the example script. Its forces are optional. Radii and charges are also stored as anchor positions of a
// second system, so that the test can read them.
static char *dish(const char *pragma, const char *electrostatic, const char *collision, const char *random,
                  const char *drag) {
    return text_of("%slet CELLS=60 RADIUS=300\n"
                   "!physics state=:facts dimensions=2\n"
                   " for i in ..CELLS\n"
                   "  !anchor id=i position=10+10*beta(:size)[i];normal(:charge)[i]\n"
                   "!physics state=:s dimensions=2 time=beat resolution=tempo/60/fps\n"
                   " !anchor id=:middle position=0\n"
                   " for i in ..CELLS\n"
                   "  let radius=10+10*beta(:size)[i]\n"
                   "  !particle id=i charge=normal(:charge)[i] radius=radius mass=(radius/10)**2"
                   " position=RADIUS*0.9*sqrt(uniform(:r)[i])*polar(uniform(:th)[i])\n"
                   "  !distance from=i to=:middle max=RADIUS-radius strength=100\n"
                   " %s\n %s\n %s\n %s\n",
                   pragma, electrostatic, collision, random, drag);
}

#define ELECTROSTATIC "!electrostatic strength=2e5 ease=10"
#define COLLISION "!collision strength=1000 ease=10"
#define RANDOM "!random strength=300"
#define DRAG "!drag strength=0.02"

typedef struct Cells {
    double place[CELLS][2];
    double velocity[CELLS][2];
    double radius[CELLS];
    double charge[CELLS];
} Cells;

static void read_cells(World *world, Cells *cells) {
    for (int i = 0; i < CELLS; i++) {
        char key[64];
        double numbers[WORLD_MAX_NUMBERS];
        snprintf(key, sizeof key, ":s;%d", i);
        assert_int_equal(world_numbers(world, key, numbers), 2);
        memcpy(cells->place[i], numbers, sizeof cells->place[i]);
        snprintf(key, sizeof key, ":s;%d;:velocity", i);
        assert_int_equal(world_numbers(world, key, numbers), 2);
        memcpy(cells->velocity[i], numbers, sizeof cells->velocity[i]);
        snprintf(key, sizeof key, ":facts;%d", i);
        assert_int_equal(world_numbers(world, key, numbers), 2);
        cells->radius[i] = numbers[0];
        cells->charge[i] = numbers[1];
    }
}

static double fastest(const Cells *cells) {
    double max = 0;
    for (int i = 0; i < CELLS; i++)
        max = fmax(max, hypot(cells->velocity[i][0], cells->velocity[i][1]));
    return max;
}

// Sets *overlap to the sum of the overlaps of all pairs of cells, and *products to the sum of the charge products of
// all touching pairs.
static void contacts(const Cells *cells, double *overlap, double *products) {
    *overlap = *products = 0;
    for (int i = 0; i < CELLS; i++)
        for (int j = i + 1; j < CELLS; j++) {
            double l = hypot(cells->place[i][0] - cells->place[j][0], cells->place[i][1] - cells->place[j][1]);
            double reach = cells->radius[i] + cells->radius[j];
            *overlap += l < reach ? reach - l : 0;
            *products += l < reach * 1.02 ? cells->charge[i] * cells->charge[j] : 0;
        }
}

static void run_dish(const char *electrostatic, const char *collision, const char *random, int frames, Cells *cells) {
    World world;
    char *script = dish("", electrostatic, collision, random, DRAG);
    world_open(&world, 60, script);
    world_to(&world, frames);
    EXPECT_REPORTED(&world, "");
    read_cells(&world, cells);
    world_close(&world);
    free(script);
}

// Cells leave the dish at most by as much as the elastic links allow.
static void test_cells_stay_in_the_dish(void **state) {
    (void)state;
    World world;
    char *script = dish("", ELECTROSTATIC, COLLISION, RANDOM, DRAG);
    world_open(&world, 60, script);
    for (int frame = 60; frame <= 1200; frame += 60) {
        Cells cells;
        world_to(&world, frame);
        read_cells(&world, &cells);
        for (int i = 0; i < CELLS; i++)
            assert_true(hypot(cells.place[i][0], cells.place[i][1]) < RADIUS - cells.radius[i] + 10);
    }
    world_close(&world);
    free(script);
}

// Cells form clumps, and most touching pairs have opposite charges.
static void test_opposite_charges_form_clumps(void **state) {
    (void)state;
    Cells before, after, without;
    double overlap[3], products[3];
    run_dish(ELECTROSTATIC, COLLISION, RANDOM, 1, &before);
    run_dish(ELECTROSTATIC, COLLISION, RANDOM, 1500, &after);
    run_dish("", COLLISION, RANDOM, 1500, &without);
    contacts(&before, &overlap[0], &products[0]);
    contacts(&after, &overlap[1], &products[1]);
    contacts(&without, &overlap[2], &products[2]);
    assert_true(products[1] < -10);
    assert_true(products[1] < products[2] - 10 && products[1] < products[0] - 5);
}

// The collision force prevents overlaps.
static void test_no_overlap(void **state) {
    (void)state;
    Cells with, without;
    double overlap[2], products[2];
    run_dish(ELECTROSTATIC, COLLISION, RANDOM, 1500, &with);
    run_dish(ELECTROSTATIC, "", RANDOM, 1500, &without);
    contacts(&with, &overlap[0], &products[0]);
    contacts(&without, &overlap[1], &products[1]);
    assert_true(overlap[0] < overlap[1] / 4);
    assert_true(overlap[0] / CELLS < 1); // average overlap; the radii are 10 to 20
}

// Without the random force, all cells come to rest. With the random force, they keep moving.
static void test_cells_come_to_rest_without_random_force(void **state) {
    (void)state;
    Cells still, moved;
    run_dish("", COLLISION, "", 6000, &still);
    run_dish("", COLLISION, RANDOM, 6000, &moved);
    assert_true(fastest(&still) < 1);
    assert_true(fastest(&moved) > 5);
}

// With collisions eased in over ten beats, overlapping cells move apart slowly.
static void test_eased_in(void **state) {
    (void)state;
    double max[2] = {0, 0};
    for (int sudden = 0; sudden < 2; sudden++) {
        World world;
        char *script = dish("", "", sudden ? "!collision strength=1000" : COLLISION, "", "!drag strength=0.02");
        world_open(&world, 60, script);
        for (int frame = 1; frame < 400; frame += 3) {
            Cells cells;
            world_to(&world, frame);
            read_cells(&world, &cells);
            max[sudden] = fmax(max[sudden], fastest(&cells));
        }
        world_close(&world);
        free(script);
    }
    assert_true(max[0] < max[1] / 2);
}

// The clock counts beats: at twice the tempo, everything moves twice as fast. The resolution is one frame, so each
// frame takes one step.
static void test_clock_of_beats_follows_the_tempo(void **state) {
    (void)state;
    static const struct {
        const char *pragma;
        double beats; // number of beats in 30 frames
        double fps;
    } rows[] = {{"", 1, 60},
                {"%pragma tempo 240\n", 2, 60},
                {"%pragma tempo 30\n", 0.25, 60},
                {"%pragma tempo 133\n", 4.433333333333334, 15}};
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        World world;
        char *script = dish(rows[i].pragma, ELECTROSTATIC, COLLISION, RANDOM, DRAG);
        world_open(&world, rows[i].fps, script);
        for (int frame = 1; frame <= 30; frame++) {
            world_to(&world, frame);
            assert_int_equal(last_frame(world.session).physics_steps, 2); // one step for each of the two systems
        }
        EXPECT_NEAR(&world, ":s;:clock", 1e-12, rows[i].beats);
        world_close(&world);
        free(script);
    }
}

TEST_GROUP(seed_dish) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cells_stay_in_the_dish),
        cmocka_unit_test(test_opposite_charges_form_clumps),
        cmocka_unit_test(test_no_overlap),
        cmocka_unit_test(test_cells_come_to_rest_without_random_force),
        cmocka_unit_test(test_eased_in),
        cmocka_unit_test(test_clock_of_beats_follows_the_tempo),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
