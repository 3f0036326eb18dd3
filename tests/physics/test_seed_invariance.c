// test_seed_invariance.c: results do not depend on the frame rate, translation, permutation of axes, or additional
// dimensions.
#include "world.h"

// All forces except those with a preferred direction, which are in `extra`.
static const char forces[] = " !collision strength=40\n !gravity strength=0.5\n !electrostatic strength=0.3 ease=0.5\n"
                             " !adhesion strength=3\n !distance from=0 to=1 fixed=1.5 strength=10\n"
                             " !distance from=2 to=3 max=0.5 power=1.5 strength=4\n";

// Reads the numbers of all keys of eight particles into one array. Returns their count.
static int read_all(World *world, double *numbers) {
    int count = 0;
    for (int i = 0; i < 8; i++) {
        char key[64];
        for (int velocity = 0; velocity < 2; velocity++) {
            snprintf(key, sizeof key, ":s;%d%s", i, velocity ? ";:velocity" : "");
            int n = world_numbers(world, key, numbers + count);
            assert_true(n > 0);
            count += n;
        }
    }
    return count;
}

// At 60, 30, 20, 10 and 5 frames per second with resolution 1/60, the same steps are taken, except for the last bits of
// their lengths.
static void test_frame_rates(void **state) {
    (void)state;
    static const int dimensions[] = {1, 2, 3, 5};
    for (size_t d = 0; d < COUNT_OF(dimensions); d++) {
        int n = dimensions[d];
        char *script = text_of("!physics state=:s dimensions=%d resolution=1/60\n"
                               " for i in ..8\n"
                               "  !particle id=i mass=1+i/4 radius=0.5 charge=(-1)**i position=3*uniform(:p;i)[..%d]"
                               " velocity=normal(:v;i)[..%d]\n%s !drag strength=0.01\n !constant acceleration=1\n"
                               " !barrier normal=1 position=-1 restitution=0.8\n",
                               n, n, n, forces);
        double wanted[80], found[80];
        static const int rates[] = {60, 30, 20, 10, 5};
        for (size_t i = 0; i < COUNT_OF(rates); i++) {
            World world;
            world_open(&world, rates[i], script);
            world_to(&world, rates[i]);
            EXPECT_NEAR(&world, ":s;:clock", 1e-13, 1);
            int count = read_all(&world, i ? found : wanted);
            assert_int_equal(count, 16 * n);
            for (int k = 0; i && k < count; k++)
                NEAR(found[k], wanted[k], 1e-9);
            world_close(&world);
        }
        free(script);
    }
}

// If the step length is a power of two and a frame lasts a whole number of steps, times are not rounded, and the
// results are bit-identical at all frame rates.
static void test_exact_frame_rates(void **state) {
    (void)state;
    char *script = text_of("!physics state=:s dimensions=2 resolution=1/64\n"
                           " for i in ..8\n"
                           "  !particle id=i radius=0.5 charge=(-1)**i position=3*uniform(:p;i)[..2]\n%s",
                           forces);
    double wanted[80], found[80];
    static const int rates[] = {64, 32, 16, 8, 1};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        World world;
        world_open(&world, rates[i], script);
        world_to(&world, rates[i]);
        EXPECT(&world, ":s;:clock", 1);
        int count = read_all(&world, i ? found : wanted);
        assert_true(i == 0 || memcmp(found, wanted, (size_t)count * sizeof *found) == 0);
        world_close(&world);
    }
    free(script);
}

// Returns a scene in which `place` transforms every position and `turn` every direction.
static char *scene(int n, const char *place, const char *turn) {
    return text_of("func turn(v)\n %s\nfunc place(v)\n %s\n"
                   "!physics state=:s dimensions=%d resolution=1/120\n"
                   " !anchor id=:o position=place(0.25*normal(:o)[..%d]) radius=1 mass=5 charge=1\n"
                   " for i in ..8\n"
                   "  !particle id=i mass=1+i/4 radius=0.5 charge=(-1)**i position=place(2*normal(:p;i)[..%d])"
                   " velocity=turn(normal(:v;i)[..%d]) force=turn(normal(:f;i)[..%d])\n"
                   "%s"
                   " !drag strength=0.05 flow=turn(normal(:w)[..%d])\n"
                   " !constant acceleration=turn(normal(:g)[..%d])\n"
                   " !field direction=turn(normal(:h)[..%d])\n"
                   " !buoyancy density=0.5 gravity=turn(normal(:b)[..%d])\n"
                   " !barrier position=place(-3*normal(:n)[..%d]) normal=turn(normal(:n)[..%d]) restitution=0.7\n"
                   " !barrier position=place(2*normal(:n)[..%d]) normal=turn(-normal(:n)[..%d]) min=1 max=3\n",
                   turn, place, n, n, n, n, n, forces, n, n, n, n, n, n, n, n);
}

// Compares two scenes of n dimensions. Component k in the second scene is component axis[k] in the first, with
// positions shifted.
static void compare_states(int n, const char *place, const char *turn, const int *axis, const double *shift) {
    char *scripts[2] = {scene(n, "v", "v"), scene(n, place, turn)};
    double numbers[2][80];
    for (int i = 0; i < 2; i++) {
        World world;
        world_open(&world, 60, scripts[i]);
        world_to(&world, 45);
        assert_int_equal(read_all(&world, numbers[i]), 16 * n);
        EXPECT_REPORTED(&world, "");
        world_close(&world);
        free(scripts[i]);
    }
    for (int i = 0; i < 16; i++)
        for (int k = 0; k < n; k++)
            NEAR(numbers[1][i * n + k], numbers[0][i * n + axis[k]] + (i % 2 ? 0 : shift[k]), 1e-9);
}

static void test_translation_does_not_change_the_motion(void **state) {
    (void)state;
    static const int axis[] = {0, 1, 2, 3, 4};
    compare_states(1, "v+100", "v", axis, (const double[]){100});
    compare_states(2, "v+(100;-7)", "v", axis, (const double[]){100, -7});
    compare_states(3, "v+(1;20;-30)", "v", axis, (const double[]){1, 20, -30});
    compare_states(5, "v+(1;2;3;-4;5)", "v", axis, (const double[]){1, 2, 3, -4, 5});
}

static void test_order_of_axes_does_not_change_the_motion(void **state) {
    (void)state;
    static const double none[5] = {0};
    compare_states(2, "v[1;0]", "v[1;0]", (const int[]){1, 0}, none);
    compare_states(3, "v[2;0;1]", "v[2;0;1]", (const int[]){2, 0, 1}, none);
    compare_states(3, "v[1;0;2]", "v[1;0;2]", (const int[]){1, 0, 2}, none);
    compare_states(5, "v[4;2;0;1;3]", "v[4;2;0;1;3]", (const int[]){4, 2, 0, 1, 3}, none);
}

// Additional components that are all zero do not change the motion. Drag and buoyancy are excluded, because their
// formulas depend on the number of dimensions.
static void test_zero_components_do_not_change_the_motion(void **state) {
    (void)state;
    double numbers[2][80];
    for (int more = 0; more < 2; more++) {
        int n = more ? 5 : 2;
        const char *zeros = more ? ";0;0;0" : "";
        char *script = text_of("!physics state=:s dimensions=%d\n"
                               " for i in ..8\n"
                               "  !particle id=i mass=1+i/4 radius=0.5 charge=(-1)**i position=2*normal(:p;i)[..2]%s"
                               " velocity=normal(:v;i)[..2]%s\n%s"
                               " !barrier position=-2 normal=1;1%s restitution=0.5\n",
                               n, zeros, zeros, forces, zeros);
        World world;
        world_open(&world, 60, script);
        world_to(&world, 90);
        assert_int_equal(read_all(&world, numbers[more]), 16 * n);
        world_close(&world);
        free(script);
    }
    for (int i = 0; i < 16; i++)
        for (int k = 0; k < 5; k++)
            NEAR(numbers[1][i * 5 + k], k < 2 ? numbers[0][i * 2 + k] : 0, 0);
}

TEST_GROUP(seed_invariance) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frame_rates),
        cmocka_unit_test(test_exact_frame_rates),
        cmocka_unit_test(test_translation_does_not_change_the_motion),
        cmocka_unit_test(test_order_of_axes_does_not_change_the_motion),
        cmocka_unit_test(test_zero_components_do_not_change_the_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
