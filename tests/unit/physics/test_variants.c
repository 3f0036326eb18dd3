// test_variants.c: all instruction sets, with and without neighbour lists, give the same bits on any number of threads.
// Small random systems are compared with the reference, large ones with scalar code on one thread.
#include "random_model.h"

typedef void Check(const PhysOptions *options, void *context);

// Calls `check` with each instruction set. All values of the other options occur, but not all combinations. The scalar
// level is slow, so it has fewer variants.
static void for_each_variant(Check *check, void *context) {
    static const PhysOptions options[] = {
        {.threads = 1, .neighbours = PHYS_NEIGHBOURS_NEVER, .use_fma = CPU_FMA_NEVER},
        {.threads = 1, .neighbours = PHYS_NEIGHBOURS_NEVER, .use_fma = CPU_FMA_ALWAYS},
        {.threads = 3, .neighbours = PHYS_NEIGHBOURS_NEVER, .use_fma = CPU_FMA_ALWAYS},
        {.threads = 1, .neighbours = PHYS_NEIGHBOURS_ALWAYS},
        {.threads = 8, .neighbours = PHYS_NEIGHBOURS_ALWAYS},
        {.threads = 2, .neighbours = PHYS_NEIGHBOURS_AUTO},
    };
    for (int cpu = 0; cpu <= (int)cpu_detected.level; cpu++)
        for (size_t i = cpu == CPU_SCALAR ? COUNT_OF(options) - 3 : 0; i < COUNT_OF(options); i++) {
            PhysOptions variant = options[i];
            variant.cpu = (CpuLevel)cpu;
            check(&variant, context);
        }
}

static void check_small(const PhysOptions *options, void *context) {
    (void)context;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        ModelShape shape = {.dimensions = 1 + seed % 4, .groups = 1 + (uint32_t)(seed % 5)};
        shape.particles = (uint32_t)(seed * 11 % 71);
        shape.forces = (uint32_t)(seed * 5 % 37);
        shape.hostile = seed % 3 ? 0 : seed % 2 ? 4 : 40;
        compare_random_with(seed, &shape, 3, options);
    }
}

static void test_small_systems_equal_the_reference_in_all_variants(void **state) {
    (void)state;
    for_each_variant(check_small, NULL);
}

// ---- large systems ----

enum { LARGE = 2500, FORCES = 4 };

typedef enum Layout { SPREAD, CLUSTERED, ONE_POINT, LINE, LAYOUTS } Layout;

typedef struct Scene {
    const char *name;
    uint32_t dimensions, count, groups;
    Layout layout;
    double size;     // side of the area
    double extremes; // fraction of particles with extreme values
    int force_count;
    PhysForce forces[FORCES];
    uint32_t force_group[FORCES];
    int frames;
} Scene;

typedef struct Bodies {
    PhysParticle particle[LARGE];
    double position[LARGE][3], velocity[LARGE][3];
    uint32_t group[LARGE];
} Bodies;

static void set_strange_numbers(Dice *dice, PhysParticle *p, double *position) {
    static const double places[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 1e16, 5e-324};
    static const double radii[] = {0, 1e6, 30, 1e-12, 1e300, INFINITY};
    if (dice_below(dice, 2))
        position[dice_below(dice, 3)] = places[dice_below(dice, COUNT_OF(places))];
    else
        p->radius = radii[dice_below(dice, COUNT_OF(radii))];
}

static void place_bodies(const Scene *scene, Bodies *bodies) {
    Dice dice = {scene->count * 77 + scene->dimensions};
    memset(bodies, 0, sizeof *bodies);
    for (uint32_t i = 0; i < scene->count; i++) {
        PhysParticle *p = &bodies->particle[i];
        *p = (PhysParticle){.radius = dice_between(&dice, 0.3, 0.6), .mass = 1, .charge = dice_between(&dice, -1, 1)};
        p->anchor = dice_below(&dice, 20) == 0;
        if (dice_below(&dice, 30) == 0)
            p->charge = p->mass = 0;
        bodies->group[i] = dice_below(&dice, scene->groups);
        for (uint32_t k = 0; k < 3; k++) {
            double size = scene->layout == ONE_POINT || (scene->layout == LINE && k) ? 0 : scene->size;
            bodies->position[i][k] = dice_between(&dice, 0, size);
            if (scene->layout == CLUSTERED && i % 8)
                bodies->position[i][k] *= 0.05;
            bodies->velocity[i][k] = p->anchor ? 0 : dice_between(&dice, -3, 3);
        }
        if (dice_between(&dice, 0, 1) < scene->extremes)
            set_strange_numbers(&dice, p, bodies->position[i]);
    }
}

static void describe_scene(const Scene *scene, Bodies *bodies, PhysSystem *system, int frame) {
    phys_begin(system, scene->dimensions);
    for (uint32_t g = 1; g < scene->groups; g++)
        phys_add_group(system, g == 3 ? 1 : g - 1);
    for (uint32_t i = 0; i < scene->count; i++) {
        PhysParticle p = bodies->particle[i];
        p.position = bodies->position[i];
        p.velocity = bodies->velocity[i];
        if (frame >= 4 && i % 50 == 7) // some particles grow and shrink
            p.radius *= frame % 2 ? 1.5 : 0.5;
        uint32_t group = bodies->group[i];
        if (frame >= 6 && i == 11) // one particle moves to another group
            group = 0;
        phys_add_particle(system, group, &p);
    }
    for (int f = 0; f < scene->force_count; f++)
        phys_add_force(system, scene->force_group[f], &scene->forces[f]);
}

static void copy_results(const Scene *scene, Bodies *bodies, const PhysSystem *system, int frame) {
    for (uint32_t i = 0; i < scene->count; i++) {
        memcpy(bodies->position[i], phys_position(system, i), scene->dimensions * sizeof(double));
        memcpy(bodies->velocity[i], phys_velocity(system, i), scene->dimensions * sizeof(double));
        if (frame == 5 && i % 100 == 3) // some anchors and particles jump
            bodies->position[i][0] += 3;
        if (frame == 7 && !isfinite(bodies->position[i][0])) // particles that became non-finite return
            bodies->position[i][0] = 1;
    }
}

static void simulate_frame(PhysSystem *system, int frame) {
    PhysTime time = {.last = frame * 0.03, .now = frame * 0.03 + 0.03, .clock = frame * 0.03, .resolution = 0.01};
    time.lockstep = true;
    time.performance = 1;
    assert_int_equal(phys_simulate(system, &time).status, PHYS_OK);
}

typedef struct Recording {
    const Scene *scene;
    Bodies *start, *end; // initial bodies, and the result of the scalar code
    Bodies *now;
} Recording;

static void play_recording(const Recording *recording, const PhysOptions *options, Bodies *bodies) {
    PhysSystem *system = phys_new();
    assert_non_null(system);
    phys_set_options(system, options);
    *bodies = *recording->start;
    for (int frame = 0; frame < recording->scene->frames; frame++) {
        describe_scene(recording->scene, bodies, system, frame);
        simulate_frame(system, frame);
        copy_results(recording->scene, bodies, system, frame);
    }
    phys_free(system);
}

static void check_large(const PhysOptions *options, void *context) {
    const Recording *recording = context;
    const Scene *scene = recording->scene;
    play_recording(recording, options, recording->now);
    for (uint32_t i = 0; i < scene->count; i++) {
        if (same_bits(recording->now->position[i], recording->end->position[i], scene->dimensions) &&
            same_bits(recording->now->velocity[i], recording->end->velocity[i], scene->dimensions))
            continue;
        print_error("%s, %s, %d threads, neighbours %d: particle %u differs: %a, not %a\n", scene->name,
                    cpu_name(options->cpu), options->threads, (int)options->neighbours, i,
                    recording->now->position[i][0], recording->end->position[i][0]);
        fail();
    }
}

static void check_scene(const Scene *scene) {
    Bodies *bodies = calloc(3, sizeof *bodies);
    assert_non_null(bodies);
    Recording recording = {.scene = scene, .start = bodies, .end = bodies + 1, .now = bodies + 2};
    place_bodies(scene, recording.start);
    play_recording(&recording, &(PhysOptions){.threads = 1, .cpu = CPU_SCALAR, .neighbours = PHYS_NEIGHBOURS_NEVER},
                   recording.end);
    for_each_variant(check_large, &recording);
    free(bodies);
}

static PhysForce pair_force(PhysForceKind kind, double strength, double power, double max_distance) {
    PhysForce force = force_of(kind);
    force.strength = strength;
    force.power = power;
    force.max_distance = max_distance;
    return force;
}

// Key 0 would make all random numbers equal.
static PhysForce random_force(void) {
    PhysForce force = force_of(PHYS_RANDOM);
    force.key = UINT64_C(0x9e3779b97f4a7c15);
    return force;
}

static void test_contact_forces_are_equal_in_all_variants(void **state) {
    (void)state;
    for (uint32_t n = 1; n <= 3; n++) {
        const double sizes[] = {0, 350, 25, 7};
        Scene scene = {
            .name = "contact", .dimensions = n, .count = 500 + n, .groups = 1, .size = sizes[n], .frames = 8};
        scene.forces[scene.force_count++] = pair_force(PHYS_COLLISION, 300, 1, 0);
        check_scene(&scene);
        scene.forces[scene.force_count++] = pair_force(PHYS_ADHESION, 20, 1, 0.7);
        scene.forces[scene.force_count++] = pair_force(PHYS_COLLISION, 3, 1.5, 0);
        check_scene(&scene);
    }
}

static void test_forces_of_limited_range_are_equal_in_all_variants(void **state) {
    (void)state;
    for (uint32_t n = 1; n <= 3; n++) {
        const double sizes[] = {0, 350, 25, 7};
        Scene scene = {
            .name = "bounded", .dimensions = n, .count = 400 + n, .groups = 1, .size = sizes[n], .frames = 8};
        scene.forces[scene.force_count++] = pair_force(PHYS_ELECTROSTATIC, 2, 1, 1.7);
        scene.forces[scene.force_count++] = pair_force(PHYS_COLLISION, 30, 2, 0);
        scene.forces[scene.force_count++] = pair_force(PHYS_GRAVITY, 0.5, 1, 2.5);
        check_scene(&scene);
    }
}

static void test_unlimited_forces_are_equal_in_all_variants(void **state) {
    (void)state;
    const PhysForceKind leads[] = {PHYS_GRAVITY, PHYS_ELECTROSTATIC, PHYS_COLLISION};
    for (uint32_t n = 1; n <= 3; n++)
        for (size_t lead = 0; lead < COUNT_OF(leads); lead++) {
            Scene scene = {
                .name = "unbounded", .dimensions = n, .count = 300 + n, .groups = 1, .size = 30, .frames = 2};
            scene.forces[scene.force_count++] = pair_force(leads[lead], 3, 1, 0);
            scene.forces[scene.force_count++] = pair_force(PHYS_COLLISION, 30, 2, 0);
            if (lead == 2)
                scene.forces[scene.force_count++] = pair_force(PHYS_GRAVITY, 1, 1, 0);
            check_scene(&scene);
        }
}

// On several threads, some particles are moved while forces on others are still being computed. There are enough
// particles for several threads, and their number is not a multiple of the lane count.
static void test_moved_at_once(void **state) {
    (void)state;
    for (uint32_t n = 1; n <= 3; n++) {
        Scene scene = {
            .name = "moved at once", .dimensions = n, .count = 430 + n, .groups = 1, .size = 30, .frames = 30};
        scene.forces[scene.force_count++] = pair_force(PHYS_ELECTROSTATIC, 3, 1, 0);
        scene.forces[scene.force_count++] = random_force();
        scene.forces[scene.force_count++] = force_of(PHYS_DRAG);
        scene.forces[scene.force_count] = force_of(PHYS_BARRIER);
        scene.forces[scene.force_count++].vector2 = VEC(1, 0, 0);
        check_scene(&scene);
    }
}

// Nested groups with forces at several levels, so each pass has several ranges.
static void test_nested_groups_are_equal_in_all_variants(void **state) {
    (void)state;
    Scene scene = {.name = "nested", .dimensions = 2, .count = 700, .groups = 5, .size = 29, .frames = 8};
    scene.force_count = 4;
    scene.forces[0] = pair_force(PHYS_COLLISION, 300, 1, 0);
    scene.forces[1] = pair_force(PHYS_ADHESION, 30, 1, 0);
    scene.force_group[1] = 2;
    scene.forces[2] = pair_force(PHYS_GRAVITY, 1, 1, 2);
    scene.force_group[2] = 1;
    scene.forces[3] = pair_force(PHYS_ELECTROSTATIC, 1, 1, 0);
    scene.force_group[3] = 3;
    check_scene(&scene);
}

static void test_infinities_and_nan_are_equal_in_all_variants(void **state) {
    (void)state;
    const double shares[] = {0.004, 0.05, 0.5};
    for (size_t s = 0; s < COUNT_OF(shares); s++)
        for (int layout = 0; layout < LAYOUTS; layout++) {
            Scene scene = {
                .name = "strange", .dimensions = 2 + (uint32_t)(s & 1), .count = 250, .groups = 2, .size = 16};
            scene.layout = (Layout)layout;
            scene.extremes = shares[s];
            scene.frames = 9;
            scene.forces[scene.force_count++] = pair_force(PHYS_COLLISION, 100, 1, 0);
            if (s == 1)
                scene.forces[scene.force_count++] = pair_force(PHYS_GRAVITY, 1, 1, 3);
            check_scene(&scene);
        }
}

// The system is large enough to exceed every threshold for threads and lists.
static void test_large_systems_are_equal_in_all_variants(void **state) {
    (void)state;
    Scene scene = {.name = "many", .dimensions = 2, .count = LARGE, .groups = 2, .size = 55, .frames = 8};
    scene.forces[scene.force_count++] = pair_force(PHYS_COLLISION, 300, 1, 0);
    scene.forces[scene.force_count++] = force_of(PHYS_DRAG);
    scene.forces[scene.force_count++] = random_force();
    check_scene(&scene);
    scene.name = "many, unbounded";
    scene.frames = 2;
    scene.forces[0] = pair_force(PHYS_ELECTROSTATIC, 3, 1, 0);
    scene.forces[1] = pair_force(PHYS_COLLISION, 300, 1, 0);
    check_scene(&scene);
}

static PhysForce far_force(PhysForceKind kind, double theta, double max_distance) {
    PhysForce force = pair_force(kind, 2, 1, max_distance);
    force.theta = theta;
    return force;
}

// Forces with `theta`, alone and beside forces with neighbour lists, which reorder columns.
static void test_far_fields_are_equal_in_all_variants(void **state) {
    (void)state;
    for (int layout = 0; layout < LAYOUTS; layout++) {
        Scene scene = {.name = "far", .dimensions = 2 + (uint32_t)(layout & 1), .count = 1101, .groups = 1};
        scene.layout = (Layout)layout;
        scene.size = 40;
        scene.extremes = layout == SPREAD ? 0.02 : 0;
        scene.frames = 2;
        scene.forces[scene.force_count++] = far_force(PHYS_GRAVITY, 0.8, 0);
        check_scene(&scene);
        scene.forces[scene.force_count++] = pair_force(PHYS_COLLISION, 30, 1, 0);
        scene.forces[scene.force_count++] = far_force(PHYS_ELECTROSTATIC, 1.3, 11);
        check_scene(&scene);
    }
}

static void test_far_in_groups(void **state) {
    (void)state;
    Scene scene = {.name = "far in groups", .dimensions = 3, .count = LARGE, .groups = 2, .size = 30, .frames = 2};
    scene.forces[scene.force_count++] = far_force(PHYS_GRAVITY, 1.2, 0);
    scene.forces[scene.force_count] = far_force(PHYS_ELECTROSTATIC, 0.9, 0);
    scene.force_group[scene.force_count++] = 1;
    scene.forces[scene.force_count++] = pair_force(PHYS_ADHESION, 3, 1, 0);
    check_scene(&scene);
}

// Numbers are drawn ahead for one of several random forces. Anchors draw none, so that some drawn numbers are unused.
static void test_random_forces_are_equal_in_all_variants(void **state) {
    (void)state;
    for (uint32_t n = 1; n <= 3; n++)
        for (int count = 1; count <= 3; count++) {
            Scene scene = {
                .name = "random", .dimensions = n, .count = 397 + n, .groups = 1 + n, .size = 30, .frames = 2};
            for (int f = 0; f < count; f++) {
                scene.forces[f] = random_force();
                scene.forces[f].key += (uint64_t)f;
                scene.force_group[f] = f ? 1 : 0;
            }
            scene.force_count = count;
            check_scene(&scene);
        }
}

TEST_GROUP(variants) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_systems_equal_the_reference_in_all_variants),
        cmocka_unit_test(test_contact_forces_are_equal_in_all_variants),
        cmocka_unit_test(test_forces_of_limited_range_are_equal_in_all_variants),
        cmocka_unit_test(test_unlimited_forces_are_equal_in_all_variants),
        cmocka_unit_test(test_moved_at_once),
        cmocka_unit_test(test_nested_groups_are_equal_in_all_variants),
        cmocka_unit_test(test_infinities_and_nan_are_equal_in_all_variants),
        cmocka_unit_test(test_large_systems_are_equal_in_all_variants),
        cmocka_unit_test(test_far_fields_are_equal_in_all_variants),
        cmocka_unit_test(test_far_in_groups),
        cmocka_unit_test(test_random_forces_are_equal_in_all_variants),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
