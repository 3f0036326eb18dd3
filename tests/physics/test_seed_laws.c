// test_seed_laws.c: physical laws in scripts, in different numbers of dimensions where possible.
#include "world.h"

#define TAU 6.283185307179586

// Reads the position and velocity of the particle `:s;ID`.
static int read_body(World *world, const char *id, double *position, double *velocity) {
    char key[64];
    snprintf(key, sizeof key, ":s;%s", id);
    int n = world_numbers(world, key, position);
    snprintf(key, sizeof key, ":s;%s;:velocity", id);
    assert_int_equal(world_numbers(world, key, velocity), n);
    return n;
}

static double square(int n, const double *v) {
    double sum = 0;
    for (int k = 0; k < n; k++)
        sum += v[k] * v[k];
    return sum;
}

// Each force between pairs conserves the momentum of twelve particles of masses 1 + i/4.
static void check_momentum(int n, const char *force) {
    enum { COUNT = 12 };
    char *script = text_of("!physics state=:s dimensions=%d\n"
                           " for i in ..12\n"
                           "  !particle id=i mass=1+i/4 radius=0.25+i/32 charge=(-1)**i*(1+i/8)"
                           " position=uniform(:p;i)[..%d] velocity=normal(:v;i)[..%d]\n"
                           " %s\n",
                           n, n, n, force);
    World world;
    world_open(&world, 60, script);
    double first[5] = {0}, size = 0;
    for (int frame = 1; frame <= 61; frame += 60) {
        double sum[5] = {0};
        world_to(&world, frame);
        for (int i = 0; i < COUNT; i++) {
            double p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS];
            char id[16];
            snprintf(id, sizeof id, "%d", i);
            assert_int_equal(read_body(&world, id, p, v), n);
            for (int k = 0; k < n; k++) {
                sum[k] += (1 + i / 4.0) * v[k];
                size += fabs((1 + i / 4.0) * v[k]);
            }
        }
        for (int k = 0; k < n; k++)
            if (frame == 1)
                first[k] = sum[k];
            else
                NEAR(sum[k], first[k], 1e-13 * size);
    }
    EXPECT_REPORTED(&world, "");
    world_close(&world);
    free(script);
}

static void test_pair_forces_conserve_momentum(void **state) {
    (void)state;
    static const char *const forces[] = {
        "!collision strength=50",
        "!gravity",
        "!electrostatic",
        "!adhesion strength=9",
        "!collision power=1.5\n !gravity max_distance=1\n for i in ..11\n  !distance from=i to=i+1 fixed=0.5",
    };
    static const int dimensions[] = {1, 2, 3, 5};
    for (size_t i = 0; i < COUNT_OF(forces); i++)
        for (size_t k = 0; k < COUNT_OF(dimensions); k++)
            check_momentum(dimensions[k], forces[i]);
}

// A mass on a spring oscillates with the period tau sqrt(m / strength), here 1.2 seconds. After a quarter period, the
// spring has its rest length.
static void test_spring_period(void **state) {
    (void)state;
    static const char *const ends[][2] = {{"1", "1.25"}, {"2", "0;1.25"}, {"3", "1.25;0;0"}, {"5", "0;0;0;0;1.25"}};
    for (size_t i = 0; i < COUNT_OF(ends); i++) {
        char *script = text_of("!physics state=:s dimensions=%s resolution=1/4800\n !anchor id=:o\n"
                               " !particle id=:a mass=3 position=%s\n"
                               " !distance from=:a to=:o fixed=1 strength=3*(tau/1.2)**2\n",
                               ends[i][0], ends[i][1]);
        World world;
        static const double lengths[] = {1.25, 1, 0.75, 1, 1.25};
        world_open(&world, 10, script);
        for (int frame = 3; frame <= 120; frame += 3) {
            double p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS];
            world_to(&world, frame);
            NEAR(sqrt(square(read_body(&world, ":a", p, v), p)), lengths[frame / 3 % 4], 2e-3);
        }
        world_close(&world);
        free(script);
    }
}

// The velocity is updated before the position: after m steps of length d, any mass has fallen g d² m (m + 1) / 2.
static void test_free_fall(void **state) {
    (void)state;
    World world;
    world_open(&world, 60,
               P2 " !particle id=:a position=3;100 velocity=2;0\n !particle id=:b mass=50 position=3;100 velocity=2;0\n"
                  " !constant acceleration=0;-9.81\n");
    world_to(&world, 120);
    double fallen = 9.81 / 3600 * 120 * 121 / 2;
    EXPECT_NEAR(&world, ":s;:a", 1e-10, 7, 100 - fallen);
    EXPECT_NEAR(&world, ":s;:b", 1e-10, 7, 100 - fallen);
    EXPECT_NEAR(&world, ":s;:a;:velocity", 1e-11, 2, -19.62);
    NEAR(fallen, 9.81 * 2, 0.2); // g t² / 2, up to an error of the order of the step length
    world_close(&world);
}

// At the terminal speed v, drag equals weight: S v² r^(n-1) = m g. Particles reach it from higher and from lower
// speeds.
static void test_terminal_velocity(void **state) {
    (void)state;
    for (int n = 1; n <= 5; n++) {
        char *script = text_of("!physics state=:s dimensions=%d\n"
                               " !particle id=:a mass=2 radius=0.5\n"
                               " !particle id=:b mass=2 radius=0.5 velocity=%.*s-60\n"
                               " !constant acceleration=%.*s-10\n !drag strength=0.3\n",
                               n, 2 * (n - 1), "0;0;0;0;", 2 * (n - 1), "0;0;0;0;");
        World world;
        world_open(&world, 60, script);
        world_to(&world, 3600);
        double speed = sqrt(2 * 10 / (0.3 * pow(0.5, n - 1))), p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS];
        for (int k = 0; k < 2; k++) {
            assert_int_equal(read_body(&world, k ? ":a" : ":b", p, v), n);
            NEAR(v[n - 1], -speed, 1e-9 * speed);
        }
        world_close(&world);
        free(script);
    }
}

// Kepler's laws: the period is tau sqrt(r³ / GM), and energy and angular momentum are constant. Tests a circle and an
// ellipse, in two and three dimensions.
static void test_orbits_obey_keplers_laws(void **state) {
    (void)state;
    static const char *const cases[][3] = {
        {"2", "1;0", "0;1"}, {"3", "0;0;1", "0;1;0"}, {"2", "1;0", "0;1.2"}, {"5", "0;0;0;1;0", "1;0;0;0;0"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char *script = text_of("!physics state=:s dimensions=%s time=time*tau resolution=tau/2000\n"
                               " !anchor id=:sun mass=4\n !particle id=:a mass=1e-3 position=%s velocity=%s\n"
                               " !gravity strength=0.25\n",
                               cases[i][0], cases[i][1], cases[i][2]);
        World world;
        world_open(&world, 1, script);
        double p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS], start = i == 2 ? 1.44 / 2 - 1 : -0.5, product = 0;
        for (int turn = 1; turn <= 10; turn++) {
            world_to(&world, turn);
            int n = read_body(&world, ":a", p, v);
            double radius = sqrt(square(n, p)), energy = square(n, v) / 2 - 1 / radius;
            NEAR(energy, start, 2e-3);
            product = 0;
            for (int k = 0; k < n; k++)
                product += p[k] * v[k];
            // Twice the area swept per unit of time, which the integrator conserves up to rounding.
            NEAR(sqrt(radius * radius * square(n, v) - product * product), i == 2 ? 1.2 : 1, 1e-10);
            if (i != 2) {
                NEAR(radius, 1, 2e-3);
                NEAR(v[i == 0 || i == 1 ? 1 : 0], 1, 2e-3); // after one period, the velocity is the initial one
            }
        }
        world_close(&world);
        free(script);
    }
}

// Two stars orbit their common centre of mass with the period tau sqrt(d³ / G(m1 + m2)).
static void test_two_stars(void **state) {
    (void)state;
    World world;
    world_open(&world, 4,
               "!physics state=:s dimensions=2 time=time*tau resolution=tau/4000\n"
               " !particle id=:a mass=3 position=-0.25;0 velocity=0;-0.25\n"
               " !particle id=:b mass=1 position=0.75;0 velocity=0;0.75\n !gravity strength=0.25\n");
    world_to(&world, 4);
    EXPECT_NEAR(&world, ":s;:a", 2e-3, -0.25, 0);
    EXPECT_NEAR(&world, ":s;:b", 2e-3, 0.75, 0);
    world_to(&world, 10);
    EXPECT_NEAR(&world, ":s;:b", 1e-2, -0.75, 0);
    world_close(&world);
}

// If a ball falls from a height h on a floor with restitution e, it rises to e² h. The duration of its flight shows
// that height.
static void test_bounce_height(void **state) {
    (void)state;
    static const double restitutions[] = {1, 0.9, 0.7, 0.5, 0.25};
    for (size_t i = 0; i < COUNT_OF(restitutions); i++) {
        for (int n = 1; n <= 3; n++) {
            char *script = text_of("!physics state=:s dimensions=%d resolution=1/4000\n"
                                   " !particle id=:a radius=0.5 position=%.*s4.5\n"
                                   " !constant acceleration=%.*s-10\n !barrier normal=%.*s1 restitution=%g\n",
                                   n, 2 * (n - 1), "0;0;", 2 * (n - 1), "0;0;", 2 * (n - 1), "0;0;", restitutions[i]);
            World world;
            double top = 0, p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS];
            world_open(&world, 400, script);
            // The ball falls by 4 in sqrt(0.8) s, and then rises for e times that duration.
            for (int frame = 360; frame < 360 + 400; frame += 2) {
                world_to(&world, frame);
                read_body(&world, ":a", p, v);
                top = p[n - 1] > top ? p[n - 1] : top;
            }
            NEAR(top - 0.5, 4 * restitutions[i] * restitutions[i], 0.02);
            world_close(&world);
            free(script);
        }
    }
}

// In a fluid whose density decreases with height, a bubble comes to rest at the height at which m = density r^n.
static void test_buoyant_equilibrium(void **state) {
    (void)state;
    World world;
    world_open(&world, 60,
               "let H=($(:s;:a) or 0;0)[1]\n" P2 " !particle id=:a mass=2 radius=1\n"
               " !buoyancy density=4-H gravity=0;-5\n !drag strength=2\n");
    world_to(&world, 3000);
    EXPECT_NEAR(&world, ":s;:a", 0.05, 0, 2);
    EXPECT_NEAR(&world, ":s;:a;:velocity", 0.05, 0, 0);
    world_close(&world);
    // A body as dense as the fluid does not move, in any number of dimensions.
    for (int n = 1; n <= 5; n++) {
        char *script = text_of("!physics state=:s dimensions=%d\n !particle id=:a mass=3*2**%d radius=2\n"
                               " !buoyancy density=3\n",
                               n, n);
        world_open(&world, 60, script);
        world_to(&world, 60);
        double p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS];
        assert_int_equal(read_body(&world, ":a", p, v), n);
        NEAR(square(n, p) + square(n, v), 0, 0);
        world_close(&world);
        free(script);
    }
}

// In a field, the acceleration is q / m times the field strength.
static void test_field_accelerates_by_charge_over_mass(void **state) {
    (void)state;
    World world;
    world_open(&world, 60,
               P2 " for i in ..8\n  !particle id=i charge=i-3 mass=1+i/2\n !field direction=1;-2 strength=3\n");
    world_to(&world, 60);
    for (int i = 0; i < 8; i++) {
        char key[64];
        double a = 3 * (i - 3) / (1 + i / 2.0);
        snprintf(key, sizeof key, ":s;%d;:velocity", i);
        EXPECT_NEAR(&world, key, 1e-12, a, -2 * a);
    }
    world_close(&world);
}

// Drag of any strength never reverses a particle's velocity relative to the medium. At most, the particle comes to rest
// relative to it.
static void test_drag_never_reverses(void **state) {
    (void)state;
    static const char *const strengths[] = {"1e-3", "0.1", "1", "100", "1e9", "1e300", "inf"};
    for (size_t i = 0; i < COUNT_OF(strengths); i++) {
        char *script = text_of(P3 " !particle id=:a radius=1 mass=0.1 velocity=7;-3;-4\n"
                                  " !particle id=:b radius=3 mass=5 velocity=-1;-1;0\n !drag flow=1;-1;0 strength=%s\n",
                               strengths[i]);
        World world;
        double last = 8;
        world_open(&world, 10, script);
        for (int frame = 1; frame < 40; frame++) {
            double p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS];
            world_to(&world, frame);
            read_body(&world, ":a", p, v);
            // v - flow stays parallel to (6; -2; -4) and gets shorter.
            double along = (v[0] - 1) / 6;
            assert_true(along >= -1e-15 && along <= last);
            NEAR(v[1] + 1, -2 * along, 1e-14);
            NEAR(v[2], -4 * along, 1e-14);
            last = along;
            read_body(&world, ":b", p, v);
            assert_true(v[0] <= 1 + 1e-15 && v[0] >= -1);
        }
        world_close(&world);
        free(script);
    }
}

// A constant force of 1 that is eased in over E gives the velocity t² / 2E during that time, and t − E / 2 afterwards.
static void test_eased_force_grows_linearly(void **state) {
    (void)state;
    World world;
    world_open(&world, 10,
               "!physics state=:s dimensions=1 resolution=1/2000\n !particle id=:a\n !particle id=:b force=1 ease=4\n"
               " !group\n  !particle id=:c\n  !constant force=1 ease=4\n");
    for (int frame = 1; frame <= 80; frame++) {
        double t = frame / 10.0, v = t < 4 ? t * t / 8 : t - 2;
        world_to(&world, frame);
        EXPECT(&world, ":s;:a;:velocity", 0);
        EXPECT_NEAR(&world, ":s;:b;:velocity", 1e-3, v);
        EXPECT_NEAR(&world, ":s;:c;:velocity", 1e-3, v);
    }
    world_close(&world);
}

// Two balls that collide on a line exchange their velocities. A stronger force reduces their overlap.
static void test_equal_balls_exchange_their_velocities(void **state) {
    (void)state;
    double nearest[3] = {9, 9, 9};
    static const int strengths[] = {10, 100, 1000};
    for (int i = 0; i < 3; i++) {
        char *script = text_of("!physics state=:s dimensions=1 resolution=1/10000\n"
                               " !particle id=:a position=-2 velocity=1 radius=0.5\n"
                               " !particle id=:b position=2 velocity=-0.5 radius=0.5\n !collision strength=%d\n",
                               strengths[i]);
        World world;
        world_open(&world, 100, script);
        for (int frame = 1; frame <= 500; frame++) {
            world_to(&world, frame);
            double d = world_number(&world, ":s;:b") - world_number(&world, ":s;:a");
            nearest[i] = d < nearest[i] ? d : nearest[i];
        }
        EXPECT_NEAR(&world, ":s;:a;:velocity", 1e-3, -0.5);
        EXPECT_NEAR(&world, ":s;:b;:velocity", 1e-3, 1);
        // At the largest overlap x, the spring stores the kinetic energy of the relative motion: s x² / 2 = (m/2) v² /
        // 2.
        NEAR(1 - nearest[i], 1.5 / sqrt(2.0 * strengths[i]), 1e-2);
        world_close(&world);
        free(script);
    }
    assert_true(nearest[0] < nearest[1] && nearest[1] < nearest[2]);
}

// A stiff spring diverges with one step per frame. With a sufficiently small resolution, it oscillates.
static void test_resolution_tames(void **state) {
    (void)state;
    for (int fine = 0; fine < 2; fine++) {
        char *script = text_of("!physics state=:s dimensions=1 %s\n !anchor id=:o\n !particle id=:a position=1.5\n"
                               " !distance from=:o to=:a fixed=1 strength=20000\n",
                               fine ? "resolution=1/1000" : "");
        World world;
        double max = 0;
        world_open(&world, 60, script);
        for (int frame = 1; frame < 100; frame++) {
            world_to(&world, frame);
            max = fmax(max, fabs(world_number(&world, ":s;:a")));
        }
        assert_true(fine ? max < 1.55 : max > 10);
        world_close(&world);
        free(script);
    }
}

// Gravity is constant within the radii. Two bodies that pass through each other therefore stay slow, unlike points.
static void test_radii_tame_gravity(void **state) {
    (void)state;
    double max[2] = {0, 0};
    for (int points = 0; points < 2; points++) {
        char *script = text_of("!physics state=:s dimensions=1\n !particle id=:a position=-1 radius=%s\n"
                               " !particle id=:b position=1.003 radius=%s\n !gravity\n",
                               points ? "0" : "0.25", points ? "0" : "0.25");
        World world;
        world_open(&world, 60, script);
        for (int frame = 1; frame < 600; frame++) {
            world_to(&world, frame);
            max[points] = fmax(max[points], fabs(world_number(&world, ":s;:a;:velocity")));
        }
        world_close(&world);
        free(script);
    }
    // From distance 2 to 1/2, the potential energy falls by 3/2. At smaller distances, the force is 4, so the energy
    // falls by another 2. Each of the two bodies has v²/2, so v² is at most 3.5.
    NEAR(max[0], sqrt(3.5), 0.05);
    assert_true(max[1] > 3 * max[0]);
}

// Without drag, the energy of a bouncing ball is conserved; drag reduces it.
static void test_drag_takes_energy(void **state) {
    (void)state;
    double energy[2] = {0, 0};
    for (int drag = 0; drag < 2; drag++) {
        char *script = text_of("!physics state=:s dimensions=2\n"
                               " for i in ..6\n  !particle id=i position=i;0 velocity=normal(i)[..2] radius=0.25\n"
                               " !barrier position=-1 normal=1;0\n !barrier position=-1 normal=0;1\n"
                               " !barrier position=7 normal=-1;0\n !barrier position=7 normal=0;-1\n %s\n",
                               drag ? "!drag strength=0.5" : "");
        World world;
        world_open(&world, 60, script);
        for (int frame = 1; frame <= 1201; frame += 1200) {
            double sum = 0, p[WORLD_MAX_NUMBERS], v[WORLD_MAX_NUMBERS];
            world_to(&world, frame);
            for (int i = 0; i < 6; i++) {
                char id[16];
                snprintf(id, sizeof id, "%d", i);
                sum += square(read_body(&world, id, p, v), v);
            }
            if (frame == 1)
                energy[drag] = sum;
            else if (drag)
                assert_true(sum < energy[drag] / 10);
            else
                NEAR(sum, energy[drag], 1e-11);
        }
        world_close(&world);
        free(script);
    }
}

TEST_GROUP(seed_laws) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pair_forces_conserve_momentum),
        cmocka_unit_test(test_spring_period),
        cmocka_unit_test(test_free_fall),
        cmocka_unit_test(test_terminal_velocity),
        cmocka_unit_test(test_orbits_obey_keplers_laws),
        cmocka_unit_test(test_two_stars),
        cmocka_unit_test(test_bounce_height),
        cmocka_unit_test(test_buoyant_equilibrium),
        cmocka_unit_test(test_field_accelerates_by_charge_over_mass),
        cmocka_unit_test(test_drag_never_reverses),
        cmocka_unit_test(test_eased_force_grows_linearly),
        cmocka_unit_test(test_equal_balls_exchange_their_velocities),
        cmocka_unit_test(test_resolution_tames),
        cmocka_unit_test(test_radii_tame_gravity),
        cmocka_unit_test(test_drag_takes_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
