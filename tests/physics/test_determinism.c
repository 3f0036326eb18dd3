// test_determinism.c: hashes of complete states, which must be the same for every build.
//
// A hash is the FNV-1a of the text that `petri run --print state` prints for the last frame, so it depends on every bit
// of every coordinate. The constants are the same for gcc and clang, -O0 and -O3, any C library and any number of
// threads. If a change of the specification changes them, run the program; it prints the new values.
#include "world.h"

static uint64_t hash_of(const char *text) {
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * UINT64_C(0x100000001b3);
    return hash;
}

// The seed's example: charged cells in a dish.
static const char dish[] = "let CELLS=40 RADIUS=500 BEATS=10\n"
                           "!physics state=:cells dimensions=2 time=beat resolution=tempo/60/fps\n"
                           " !anchor id=:middle position=0;0\n"
                           " for i in ..CELLS\n"
                           "  let radius=10+5*beta(:size)[i]\n"
                           "  !particle id=i charge=normal(:charge)[i] radius=radius mass=(radius/10)**2"
                           " position=RADIUS*sqrt(uniform(:r)[i])*polar(uniform(:th)[i])\n"
                           "  !distance from=i to=:middle max=RADIUS-radius strength=100\n"
                           " !electrostatic strength=5e4 ease=BEATS\n"
                           " !collision strength=200 ease=BEATS\n"
                           " !drag strength=1e-3\n"
                           " !random strength=200\n";

// Nested groups with all kinds of forces and various powers.
static const char groups[] =
    "!physics state=:all dimensions=2 resolution=1/120 speed_of_light=40 run=3\n"
    " !constant acceleration=0;-1 force=0.1;0 ease=0.2\n"
    " !random strength=0.5\n"
    " for g in ..3\n"
    "  !group\n"
    "   for i in ..6\n"
    "    !particle id=g;i position=4*normal(:p;g;i)[..2] velocity=normal(:v;g;i)[..2] radius=0.2+0.1*(i%4) mass=1+0.3*i"
    " charge=1-2*(i%2) force=0.3;-0.1 ease=0.4\n"
    "   !gravity strength=2 max_distance=6\n"
    "   !random strength=0.25 ease=0.5\n"
    "   !group\n"
    "    for i in ..3\n"
    "     !particle id=g;:in;i position=3*normal(:q;g;i)[..2] radius=0.5 mass=(0;1;2.5)[i] charge=i\n"
    "    !adhesion strength=4 overlap=0.3\n"
    "    !drag strength=0.02 flow=1;0.5\n"
    "    !buoyancy density=0.7 gravity=0;-3\n"
    "   !distance from=g;0 to=g;:in;1 fixed=1.3 power=1.5 strength=3\n"
    "   !distance from=g;1 to=(g+1)%3;2 min=2 max=3 power=0.5 strength=5\n"
    " !anchor id=:sun position=2*polar(time/3) mass=6 radius=1 charge=-2\n"
    " !electrostatic strength=1.5 ease=1\n"
    " !collision strength=60 power=1.25\n"
    " !field direction=0.3;0.4 strength=0.5\n";

static const char space[] = "!physics state=:space dimensions=3 resolution=1/90\n"
                            " for i in ..24\n"
                            "  !particle id=i position=5*normal(:p;i)[..3] velocity=normal(:v;i)[..3] radius=0.3+i/60"
                            " mass=1+i/7 charge=normal(:c)[i]\n"
                            " !gravity strength=3\n !electrostatic strength=2 max_distance=4\n !collision strength=90\n"
                            " !adhesion strength=2 overlap=0.2\n !drag strength=0.003\n !buoyancy density=0.9\n"
                            " !barrier normal=0;0;1 position=-6 restitution=0.6\n";

static const char wire[] = "!physics state=:wire dimensions=1\n"
                           " !anchor id=:left position=-10\n !anchor id=:right position=10+0.5*sine(time)\n"
                           " for i in ..10\n"
                           "  !particle id=i position=-9+2*i radius=0.3+0.05*(i%4) mass=0.5+0.5*(i%3)"
                           " velocity=4*sin(i*0.15)\n"
                           "  if i\n   !distance from=i-1 to=i max=2.5 strength=6\n"
                           " !distance from=:left to=0 max=1 strength=10 power=2\n"
                           " !distance from=:right to=9 max=1 strength=10 power=0.7\n"
                           " !collision strength=800\n !drag strength=0.1\n !random strength=0.3\n";

static const char five[] = "!physics state=:five dimensions=5\n"
                           " for i in ..12\n"
                           "  !particle id=i position=2*normal(:p;i)[..5] velocity=normal(:v;i)[..5] radius=0.5+i/20"
                           " mass=1+i/3 charge=(-1)**i\n"
                           " !gravity strength=2\n !electrostatic\n !collision strength=30 power=1.1\n"
                           " !drag strength=0.02 flow=0.1\n !buoyancy\n !random strength=0.1\n";

static const char barriers[] = "!physics state=:box dimensions=2 resolution=1/240\n"
                               " for i in ..15\n"
                               "  !particle id=i position=(1;1)+8*uniform(:p;i)[..2] velocity=9*normal(:v;i)[..2]"
                               " radius=0.1+i/50 mass=(i%5)/2\n"
                               " !constant acceleration=0;-9.81\n !collision strength=300\n"
                               " !barrier normal=0.2;1 restitution=0.8\n !barrier normal=1;0.1 restitution=0.9\n"
                               " !barrier position=10 normal=-1;0.3 restitution=0\n"
                               " !barrier position=0;9 normal=0;-2 min=1.5 strength=40 power=1.5 ease=0.3\n"
                               " !barrier position=0;0 normal=1;1 max=9 strength=5\n";

// Systems that read each other's state, with counters, changing particles and runs.
static const char feedback[] = "let P=$(:lead;:a) or (0;0) T=$:turn or 0\n"
                               "!counter state=:turn rate=0.7\n"
                               "!physics state=:lead dimensions=2 run=time/0.7\n"
                               " !particle id=:a velocity=3*polar(0.1) force=-2*P\n"
                               " !random strength=2\n"
                               "!physics state=:hunt dimensions=2 time=T resolution=0.01\n"
                               " !anchor id=:bait position=P\n"
                               " for i in floor(T*5)..floor(T*5)+6\n"
                               "  !particle id=i position=5*polar(i/7) radius=0.4 mass=1+i%3\n"
                               "  !distance from=i to=:bait max=0.5 strength=8 power=1.5\n"
                               " !collision strength=50\n !drag strength=0.2\n";

// Enough particles for several threads.
static const char crowd[] =
    "!physics state=:crowd dimensions=2 resolution=1/30\n"
    " for i in ..700\n"
    "  !particle id=i position=60*normal(:p;i)[..2] radius=1+0.5*uniform(:r)[i] charge=normal(:c)[i]\n"
    " !group\n"
    "  for i in 700..900\n"
    "   !particle id=i position=30*normal(:p;i)[..2] radius=2 velocity=normal(:v;i)[..2]\n"
    "  !adhesion strength=3\n"
    " !electrostatic strength=20\n !collision strength=100 max_distance=10\n"
    " !gravity strength=2 max_distance=20\n !random\n !drag strength=0.01\n";

static const struct {
    const char *name;
    const char *script;
    int frames;
    uint64_t hash;
} scenes[] = {
    {"dish", dish, 120, UINT64_C(0xf472d431038a733a)},
    {"groups", groups, 90, UINT64_C(0x3e3d0877fe71a0a2)},
    {"space", space, 90, UINT64_C(0xbcc7168218252c65)},
    {"wire", wire, 200, UINT64_C(0x3b06fa0fe4596ec6)},
    {"five", five, 120, UINT64_C(0x729731c05be36a95)},
    {"barriers", barriers, 120, UINT64_C(0xbd3312e5bfb5f109)},
    {"feedback", feedback, 150, UINT64_C(0xfb5a5dbc4b991dbc)},
    {"crowd", crowd, 12, UINT64_C(0x386fbe18f17bc205)},
};

// Configurations in which the scenes are computed; the hash must not depend on them.
static const struct {
    const char *name;
    int threads;
    const char *cpu; // NULL: the best level; a level that this processor lacks is replaced by the best available one
                     // below it
    PetriNeighbours neighbours;
} variants[] = {
    {"1 thread", 1, NULL, PETRI_NEIGHBOURS_AUTO},
    {"2 threads", 2, NULL, PETRI_NEIGHBOURS_AUTO},
    {"3 threads", 3, NULL, PETRI_NEIGHBOURS_AUTO},
    {"8 threads", 8, NULL, PETRI_NEIGHBOURS_AUTO},
    {"as many threads as processors", 0, NULL, PETRI_NEIGHBOURS_AUTO},
    {"plain C", 1, "scalar", PETRI_NEIGHBOURS_AUTO},
    {"plain C, 3 threads", 3, "scalar", PETRI_NEIGHBOURS_AUTO},
    {"AVX2", 1, "avx2", PETRI_NEIGHBOURS_AUTO},
    {"AVX2, 3 threads", 3, "avx2", PETRI_NEIGHBOURS_AUTO},
    {"AVX-512", 1, "avx512", PETRI_NEIGHBOURS_AUTO},
    {"AVX-512, 3 threads", 3, "avx512", PETRI_NEIGHBOURS_AUTO},
    {"neighbour lists always", 2, NULL, PETRI_NEIGHBOURS_ALWAYS},
    {"neighbour lists never", 2, NULL, PETRI_NEIGHBOURS_NEVER},
    {"plain C, neighbour lists always", 1, "scalar", PETRI_NEIGHBOURS_ALWAYS},
    {"AVX2, neighbour lists always", 1, "avx2", PETRI_NEIGHBOURS_ALWAYS},
};

// Returns the hash of the state after some frames in one of the configurations.
static uint64_t run_script(const char *script, int frames, size_t variant) {
    World world;
    PetriOptions options = petri_default_options();
    options.threads = variants[variant].threads;
    options.tuning = &(PetriTuning){
        .size = sizeof(PetriTuning), .cpu = variants[variant].cpu, .neighbours = variants[variant].neighbours};
    world_open_with(&world, options, script);
    world_to(&world, frames);
    EXPECT_REPORTED(&world, strstr(script, "(1/0") || strstr(script, "0/0)") ? "not-finite" : "");
    uint64_t hash = hash_of(world_text(&world));
    world_close(&world);
    return hash;
}

static uint64_t hash_scene(size_t scene, size_t variant) {
    return run_script(scenes[scene].script, scenes[scene].frames, variant);
}

static void test_hashes_equal_the_constants_of_all_builds(void **state) {
    (void)state;
    bool same = true;
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        uint64_t hash = hash_scene(i, 0);
        if (hash != scenes[i].hash) {
            same = false;
            print_error("%s: found 0x%016llx, wanted 0x%016llx\n", scenes[i].name, (unsigned long long)hash,
                        (unsigned long long)scenes[i].hash);
        }
    }
    assert_true(same);
}

static void test_hash_is_the_same_in_all_variants(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(scenes); i++)
        for (size_t k = 0; k < COUNT_OF(variants); k++)
            if (hash_scene(i, k) != scenes[i].hash)
                fail_msg("%s: not the same with %s", scenes[i].name, variants[k].name);
}

// Particles that a grid cannot sort: one larger than the whole system, all at one point, extremely far apart, half of
// them not finite, large ones among small ones. (For 10^6 particles, see CONTRIBUTING.md, bad input.)
static void test_bad_input(void **state) {
    (void)state;
    static const char *const places[] = {
        "radius=(1e6 if i==7 else 0.5) position=(i%50)*0.97;(i//50)*0.97",
        "radius=0.5 position=3;4",
        "radius=0.5 position=1e300*normal(:p;i)[..2]",
        "radius=0.5 position=(1/0 if i%2 else (i%50)*0.97);(i//50)*0.97",
        "radius=0.5 position=(i%50)*0.97;(i//50)*0.97*(1 if i%2 else 0/0)",
        "radius=(9 if i%40==0 else 0.5) position=(i%50)*0.97;(i//50)*0.97",
        "radius=(0 if i%3 else 1e-200) position=(i%50)*1e-200;(i//50)*1e-200",
    };
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        char *script = text_of("!physics state=:s dimensions=2\n for i in ..2000\n  !particle id=i"
                               " velocity=normal(:v;i)[..2] %s\n !collision strength=100\n",
                               places[i]);
        uint64_t hash = run_script(script, 5, 5); // scalar code
        for (size_t k = 0; k < COUNT_OF(variants); k++)
            if (variants[k].neighbours != PETRI_NEIGHBOURS_AUTO || k < 3)
                if (run_script(script, 5, k) != hash)
                    fail_msg("%s: not the same with %s", places[i], variants[k].name);
        free(script);
    }
}

// Two sessions that run alternately do not affect each other. Printing between the frames does not affect them either.
static void test_sessions_side_by_side(void **state) {
    (void)state;
    World worlds[COUNT_OF(scenes)];
    for (size_t i = 0; i < COUNT_OF(scenes); i++)
        world_open(&worlds[i], 60, scenes[i].script);
    for (int frame = 0; frame <= 200; frame++)
        for (size_t i = 0; i < COUNT_OF(scenes); i++)
            if (frame <= scenes[i].frames) {
                world_to(&worlds[i], frame);
                if (frame % 16 == 0)
                    world_text(&worlds[i]);
            }
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        assert_true(hash_of(world_text(&worlds[i])) == scenes[i].hash);
        world_close(&worlds[i]);
    }
}

// The hash is sensitive: a change of one number in its last digit changes the hash.
static void test_one_digit_changes_the_hash(void **state) {
    (void)state;
    World world;
    char *script = text_of("%s", wire);
    char *place = strstr(script, "velocity=4");
    assert_non_null(place);
    memcpy(place, "velocity=5", strlen("velocity=5"));
    world_open(&world, 60, script);
    world_to(&world, 200);
    assert_true(hash_of(world_text(&world)) != scenes[3].hash);
    world_close(&world);
    free(script);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hashes_equal_the_constants_of_all_builds),
        cmocka_unit_test(test_hash_is_the_same_in_all_variants),
        cmocka_unit_test(test_bad_input),
        cmocka_unit_test(test_sessions_side_by_side),
        cmocka_unit_test(test_one_digit_changes_the_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
