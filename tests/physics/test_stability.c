// test_stability.c: reports of forces that are certainly unstable, and of motion that has become meaningless.
#include "cases.h"

// A system at 60 frames per second, with the strength at which it becomes unstable. %g is the strength.
typedef struct Limit {
    const char *title;
    const char *script;
    double strength;
} Limit;

#define BALLS "  !particle id=i position=2*i;0 radius=1 mass="

static const Limit limits[] = {
    {"a mass on an anchor",
     P1 " !anchor id=0\n !particle id=1 position=1\n !distance from=0 to=1 fixed=1 strength=%g\n", 14400},
    {"two masses",
     P2 " !particle id=0 mass=3\n !particle id=1 position=1;1 mass=6\n"
        " !distance from=0 to=1 fixed=1 strength=%g\n",
     28800},
    {"a pendulum on a thread",
     P2 " !anchor id=0\n !particle id=1 position=1;0 mass=2\n"
        " !distance from=0 to=1 max=1 strength=%g\n",
     28800},
    {"three masses in a row",
     P3 " for i in ..3\n  !particle id=i position=i;0;0\n"
        " for i in ..2\n  !distance from=i to=i+1 fixed=1 strength=%g\n",
     4800},
    {"a ring of four masses",
     P2 " for i in ..4\n  !particle id=i position=cos(i/4);sin(i/4)\n"
        " for i in ..4\n  !distance from=i to=(i+1 if i < 3 else 0) fixed=1.4 strength=%g\n",
     7200},
    {"a soft boundary", P2 " !particle id=0 mass=2\n !particle id=1\n !barrier normal=0;1 min=1 strength=%g\n", 28800},
    {"equal discs", P2 " for i in ..3\n" BALLS "1\n !collision strength=%g\n", 7200},
    {"discs of several masses", P2 " for i in ..4\n" BALLS "1+i\n !collision strength=%g\n", 4 * 3600 * 12.0 / 7},
    {"a disc and an anchor", P2 " !anchor id=:a radius=1\n !particle id=0 radius=1\n !collision strength=%g\n", 14400},
    {"adhesion", P2 " for i in ..3\n" BALLS "1\n !adhesion overlap=0.5 strength=%g\n", 7200},
    {"shorter steps",
     "!physics state=:s dimensions=1 resolution=1/120\n !anchor id=0\n !particle id=1 position=1\n"
     " !distance from=0 to=1 fixed=1 strength=%g\n",
     57600},
    {"another clock",
     "!physics state=:s dimensions=1 time=beat\n !anchor id=0\n !particle id=1 position=1\n"
     " !distance from=0 to=1 fixed=1 strength=%g\n",
     // 120 beats a minute: a frame has 1/30 beat, but a step is at most 1/60
     14400},
};

static int count_at(const char *script, double strength, int64_t frame) {
    World world;
    char *text = text_of(script, strength);
    world_open(&world, 60, text);
    world_to(&world, frame);
    int count = world_count_reported(&world, "unstable-force");
    world_close(&world);
    free(text);
    return count;
}

static void test_unstable_force_is_reported_above_the_exact_limit(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        double limit = limits[i].strength;
        if (count_at(limits[i].script, limit * 0.999, 2) != 0 || count_at(limits[i].script, limit * 1.001, 2) != 1)
            fail_msg("%s: the limit is not %g", limits[i].title, limit);
    }
}

// Systems that may be stable, or whose energy grows only once.
static void test_possibly_stable(void **state) {
    (void)state;
    static const char *const scripts[] = {
        P1 " !anchor id=0\n !particle id=1 position=1\n !distance from=0 to=1 fixed=1 strength=1e6 power=2\n",
        P1 " !anchor id=0\n !particle id=1 position=1\n !distance from=0 to=1 fixed=1 strength=-1e6\n",
        P1 " !anchor id=0\n !anchor id=1 position=1\n !distance from=0 to=1 fixed=1 strength=1e6\n",
        P1 " !anchor id=0\n !particle id=1 position=1 mass=0\n !distance from=0 to=1 fixed=1 strength=1e6\n",
        P1 " !particle id=0\n !particle id=1 position=1\n !distance from=0 to=1 min=1 strength=1e6\n",
        P1 " !particle id=0\n !distance from=0 to=0 fixed=1 strength=1e6\n",
        P2 " !particle id=0 radius=1\n !particle id=1 radius=1\n !collision strength=1e6\n",
        P2 " for i in ..3\n  !particle id=i position=i;0\n !collision strength=1e6\n",
        P2 " for i in ..3\n" BALLS "1\n !collision strength=1e6 max_distance=1\n",
        P2 " for i in ..3\n" BALLS "1000\n !collision strength=1e5\n",
        P2 " for i in ..3\n" BALLS "1\n !group\n  !collision strength=1e6\n",
        P2 " !particle id=0\n !barrier normal=0;1 strength=1e6\n",
        P2 " !particle id=0\n !barrier normal=0;1 strength=1e6 min=-1\n",
        P2 " !particle id=0\n !gravity strength=1e9\n !constant strength=1e9\n !drag strength=1e9\n",
    };
    for (size_t i = 0; i < COUNT_OF(scripts); i++)
        if (count_at(scripts[i], 0, 0) != 0)
            fail_msg("a report for\n%s", scripts[i]);
}

// Returns the largest component of a velocity in the last frame.
static double largest_velocity(World *world) {
    PetriSystem system;
    double largest = 0;
    assert_true(petri_system(world->session, 0, &system, sizeof system));
    for (size_t i = 0; i < system.particle_count; i++)
        for (size_t k = 0; k < system.dimensions; k++)
            largest = fmax(largest, fabs(system.velocity.data[i * system.velocity.stride + k]));
    return largest;
}

// Random cloths: particles of random masses in 2 or 3 dimensions, each connected with some of the earlier ones. If the
// strength is reported, the cloth explodes; with the suggested strength, and with the suggested resolution, it does
// not.
static void test_suggested_strength_and_resolution_are_stable(void **state) {
    (void)state;
    int reported = 0;
    for (int seed = 0; seed < 60; seed++) {
        static const char script[] = "!physics state=:s dimensions=%d resolution=%.17g\n"
                                     " let p=normal(:p;%d) m=uniform(:m;%d) c=uniform(:c;%d)\n"
                                     " for i in ..12\n"
                                     "  !particle id=i position=4*p[3*i..3*i+%d] mass=1+9*m[i] velocity=0.001*p[i]\n"
                                     " for i in ..12\n  for j in ..i\n   if c[12*i+j] < 0.3\n"
                                     "    let d=4*(p[3*i..3*i+%d]-p[3*j..3*j+%d])\n"
                                     "    !distance from=i to=j fixed=hypot(d) strength=%.17g\n";
        int n = 2 + seed % 2;
        double strength = 1500 * (1 + seed % 12), suggested[2] = {strength, 60};
        World world;
        char *text = text_of(script, n, 1 / suggested[1], seed, seed, seed, n, n, n, strength);
        world_open(&world, 60, text);
        world_to(&world, 0);
        bool unstable = world.reported_count == 1;
        const char *advice = unstable ? strstr(world.reported[0].text, "use strength=") : NULL;
        if (unstable)
            assert_int_equal(sscanf(advice, "use strength=%lf or resolution=1/%lf", &suggested[0], &suggested[1]), 2);
        world_to(&world, 300);
        if (unstable && largest_velocity(&world) < 1e3)
            fail_msg("reported, but stable:\n%s", text);
        world_close(&world);
        free(text);
        for (int by_resolution = 0; by_resolution < 2 && unstable; by_resolution++) {
            text = text_of(script, n, by_resolution ? 1 / suggested[1] : 1.0 / 60, seed, seed, seed, n, n, n,
                           by_resolution ? strength : suggested[0]);
            world_open(&world, 60, text);
            world_to(&world, 600);
            if (largest_velocity(&world) > 1 || world.reported_count > 0)
                fail_msg("unstable with the suggestion, velocity %g, %s:\n%s", largest_velocity(&world),
                         world.reported[0].text, text);
            world_close(&world);
            free(text);
        }
        reported += unstable;
    }
    assert_in_range(reported, 10, 50);
}

// A spring that doubles the elongation, or more, in each step.
#define EXPLOSION                                                                                                      \
    " !particle id=:a position=1;0\n !particle id=:b position=-1;0\n !constant acceleration=0;-1\n"                    \
    " !distance from=:a to=:b fixed=1.9 strength=6 power=1.001\n"

static void expect_divergence(const char *script, int64_t frame, const char *wanted[4]) {
    World world;
    world_open(&world, 1, script);
    world_to(&world, frame);
    EXPECT_REPORTED(&world, wanted[0] ? "divergence" : "");
    for (int i = 0; i < 4 && wanted[i]; i++)
        if (!strstr(world.reported[0].text, wanted[i]))
            fail_msg("'%s' does not say '%s'", world.reported[0].text, wanted[i]);
    world_close(&world);
}

static void test_divergence_names_frame_particle_and_force(void **state) {
    (void)state;
    static const struct {
        const char *script;
        const char *wanted[4];
    } rows[] = {
        {P2 EXPLOSION, {"millionfold", "in frame 30", "at particle :a", "this !distance"}},
        // The largest force is found among several, and in groups.
        {P2 " !particle id=7 position=1;0\n !group\n  !gravity strength=0.1\n  !constant acceleration=0;1e99\n"
            "  !particle id=:a;8 position=-1;0\n",
         {"1e100", "in frame 10", "at particle :a;8", "this !constant"}},
        {P1 " !particle id=:a force=1e99\n", {"1e100", "in frame 10", "at particle :a", "attribute 'force'"}},
        // The position overflows between two checks.
        {P1 " !particle id=:a\n if frame == 3\n  !constant force=1.7e308\n", {"infinite", "in frame 4", ":a"}},
        // The motion restarts, and diverges again, with the same report.
        {"!physics state=:s dimensions=2 run=frame/50\n" EXPLOSION, {"in frame 30", ":a"}},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        expect_divergence(rows[i].script, 200, (const char **)rows[i].wanted);
}

// Energy that grows fast for other reasons, and numbers that are large from the start.
static void test_no_divergence(void **state) {
    (void)state;
    static const char *const scripts[] = {
        P1 " !particle id=:a velocity=1e-9\n !constant force=1e9\n",
        P1 " !particle id=:a velocity=1e-9\n if frame == 10 or frame == 15\n  !constant force=10**frame\n",
        P1 " !particle id=:a velocity=1e-9\n !constant force=1e30 ease=1e9\n",
        P2 " !particle id=:a velocity=1e-12 position=1\n !particle id=:b position=2\n !random strength=1e6\n",
        P2 " !anchor id=:a position=0;1e-6\n !particle id=:b\n !gravity strength=1e6\n",
        P2 " for i in ..9\n  !particle id=i position=3*i;0 radius=1\n !collision strength=0.1\n"
           " !anchor id=:hand position=frame-50;0 radius=5\n",
        P1 " !particle id=:a velocity=1e101\n !constant force=1e101\n",
        P1 " !particle id=:a velocity=1e308\n",
        P1 " !particle id=:a velocity=1e300 mass=0\n !anchor id=:b position=10**(3*frame)\n",
        P2 " !particle id=:a position=1e99 velocity=1e97\n",
    };
    for (size_t i = 0; i < COUNT_OF(scripts); i++)
        expect_divergence(scripts[i], 100, (const char *[4]){NULL});
}

// The report is the same however the system is computed.
static void test_divergence_is_deterministic(void **state) {
    (void)state;
    static const struct {
        int threads;
        const char *cpu;
        PetriNeighbours neighbours;
    } ways[] = {
        {1, "scalar", PETRI_NEIGHBOURS_NEVER}, {3, "avx2", PETRI_NEIGHBOURS_ALWAYS}, {8, NULL, PETRI_NEIGHBOURS_AUTO}};
    char first[256] = "";
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        World world;
        PetriOptions options = petri_default_options();
        options.fps = 1;
        options.threads = ways[i].threads;
        options.tuning =
            &(PetriTuning){.size = sizeof(PetriTuning), .cpu = ways[i].cpu, .neighbours = ways[i].neighbours};
        world_open_with(&world, options,
                        P2 " let p=uniform(:p)\n for i in ..3000\n  !particle id=i position=50*p[2*i;2*i+1] radius=1\n"
                           " for i in ..2999\n  !distance from=i to=i+1 fixed=1 strength=5 power=1.001\n"
                           " !collision strength=0.1\n");
        world_to(&world, 60);
        EXPECT_REPORTED(&world, "divergence");
        if (i == 0)
            snprintf(first, sizeof first, "%s", world.reported[0].text);
        assert_string_equal(world.reported[0].text, first);
        world_close(&world);
    }
}

TEST_GROUP(stability) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unstable_force_is_reported_above_the_exact_limit),
        cmocka_unit_test(test_possibly_stable),
        cmocka_unit_test(test_suggested_strength_and_resolution_are_stable),
        cmocka_unit_test(test_divergence_names_frame_particle_and_force),
        cmocka_unit_test(test_no_divergence),
        cmocka_unit_test(test_divergence_is_deterministic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
