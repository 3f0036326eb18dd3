// test_reorder.c: reordered columns (lib/physics/reorder.c) give the same bits as a sum over all pairs in the order of
// description, also when the system changes.
#include "physics/neighbour_list.h"
#include "support.h"

enum { SIDE = 24, COUNT = SIDE * SIDE };

// A system with neighbour lists and a system without. Both undergo the same changes.
typedef struct Twins {
    PhysSystem *plain, *listed;
    size_t dimensions;
    int frame;
} Twins;

static Twins twins_of(size_t dimensions, const PhysOptions *options) {
    Twins twins = {phys_new(), phys_new(), dimensions, 0};
    assert_non_null(twins.plain);
    assert_non_null(twins.listed);
    phys_set_options(twins.plain, &(PhysOptions){.threads = 1, .neighbours = PHYS_NEIGHBOURS_NEVER});
    phys_set_options(twins.listed, options);
    return twins;
}

// Describes discs on a grid. Discs with consecutive handles are far apart.
static void describe_system(PhysSystem *system, size_t dimensions, uint32_t count, uint32_t groups, bool pushed) {
    Dice dice = {77};
    phys_begin(system, (uint32_t)dimensions);
    for (uint32_t g = 1; g < groups; g++)
        phys_add_group(system, 0);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t spot = i * 241 % COUNT;
        double place[3] = {spot % SIDE * 0.9, spot / SIDE * 0.9, spot % 7 * 0.05}, velocity[3], force[3] = {0};
        for (int k = 0; k < 3; k++)
            velocity[k] = (double)(dice_next(&dice) % 1000) * 0.004 - 2;
        PhysParticle p = {.position = place, .velocity = velocity, .radius = 0.5, .mass = 1};
        force[0] = i % 3;
        p.force = pushed ? force : NULL;
        p.ease = pushed ? i % 5 * 2 : 0;
        phys_add_particle(system, groups - 1, &p);
    }
}

static PhysForce make_wall(const double *at, const double *along) {
    PhysForce force = force_of(PHYS_BARRIER);
    force.vector = at;
    force.vector2 = along;
    return force;
}

static void add_forces(PhysSystem *system, uint32_t group) {
    const double low[3] = {-1, -1, -1}, high[3] = {SIDE, SIDE, 2}, right[3] = {1, 0, 0}, left[3] = {-1, 0, 0};
    PhysForce forces[] = {force_of(PHYS_COLLISION), force_of(PHYS_DRAG), make_wall(low, right), make_wall(high, left)};
    forces[0].strength = 300;
    forces[1].strength = 0.02;
    for (size_t i = 0; i < COUNT_OF(forces); i++)
        phys_add_force(system, group, &forces[i]);
}

static void begin_forces(Twins *twins) {
    phys_begin_forces(twins->plain);
    phys_begin_forces(twins->listed);
    add_forces(twins->plain, 0);
    add_forces(twins->listed, 0);
}

// Replaces the forces by the usual ones and an additional one.
static void add_force(Twins *twins, PhysForceKind kind) {
    PhysForce force = force_of(kind);
    begin_forces(twins);
    force.from = 3;
    force.to = 200;
    force.has_maximum = true;
    force.maximum = 1;
    force.key = 5;
    phys_add_force(twins->plain, 0, &force);
    phys_add_force(twins->listed, 0, &force);
}

static void begin_systems(Twins *twins, uint32_t count, uint32_t groups, bool pushed) {
    describe_system(twins->plain, twins->dimensions, count, groups, pushed);
    describe_system(twins->listed, twins->dimensions, count, groups, pushed);
    add_forces(twins->plain, groups - 1);
    add_forces(twins->listed, groups - 1);
}

// Changes the radius and mass of a particle, and keeps its position.
static void change_particle(Twins *twins, uint32_t particle, double radius, double mass) {
    PhysParticle p = {.radius = radius, .mass = mass};
    PhysPreserve preserve = {.position = true, .velocity = true};
    phys_update_particle(twins->plain, particle, &p, preserve);
    phys_update_particle(twins->listed, particle, &p, preserve);
}

static void move_particle(Twins *twins, uint32_t particle, double x) {
    PhysParticle p = {.position = VEC(x, 1, 1), .radius = 0.5, .mass = 1};
    phys_update_particle(twins->plain, particle, &p, (PhysPreserve){.velocity = true});
    phys_update_particle(twins->listed, particle, &p, (PhysPreserve){.velocity = true});
}

static void check_same(const Twins *twins, int line) {
    size_t bytes = 2 * twins->dimensions * sizeof(double);
    for (uint32_t i = 0; i < phys_particle_count(twins->plain); i++)
        if (memcmp(phys_position(twins->plain, i), phys_position(twins->listed, i), bytes)) {
            print_error("line %d: particle %u differs\n", line, i);
            fail();
        }
}

static void frames(Twins *twins, int count, bool in_cell_order, int line) {
    for (int f = 0; f < count; f++, twins->frame++) {
        double now = twins->frame * 0.04;
        PhysTime time = {.last = now, .now = now + 0.04, .clock = now, .resolution = 0.01, .lockstep = true};
        time.performance = 1;
        time.keep_last_finite = twins->frame % 4 != 3;
        assert_int_equal(phys_simulate(twins->plain, &time).status, PHYS_OK);
        assert_int_equal(phys_simulate(twins->listed, &time).status, PHYS_OK);
        check_same(twins, line);
    }
    bool kept = false;
    for (int i = 0; i < PHYS_MAX_LISTS; i++)
        kept |= phys_list_is_built(&twins->listed->lists[i]);
    bool by_cell = twins->listed->column_order == ORDER_BY_CELL;
    if (by_cell == in_cell_order && kept >= in_cell_order)
        return;
    print_error("line %d: cell order is %d, built is %d\n", line, by_cell, kept);
    fail();
}

#define FRAMES(twins, count, in_cell_order) frames(twins, count, in_cell_order, __LINE__)

static void check_changes(size_t dimensions, const PhysOptions *options) {
    PhysOptions never = *options;
    never.neighbours = PHYS_NEIGHBOURS_NEVER;
    Twins twins = twins_of(dimensions, options);
    begin_systems(&twins, COUNT, 1, false);
    FRAMES(&twins, 6, true);
    for (int i = 0; i < 4; i++) { // change particles between frames, when the next step is already prepared
        move_particle(&twins, 17 + 100 * i, 1.3 + 4 * i);
        FRAMES(&twins, 1, true);
    }
    change_particle(&twins, 5, 0.4, 2);
    change_particle(&twins, 300, 0.6, 0);
    FRAMES(&twins, 3, true);
    add_force(&twins, PHYS_DISTANCE); // a link refers to column numbers
    FRAMES(&twins, 2, false);
    begin_forces(&twins);
    FRAMES(&twins, 7, true);
    add_force(&twins, PHYS_RANDOM); // random variates depend on the order of particles
    FRAMES(&twins, 2, false);
    begin_forces(&twins);
    FRAMES(&twins, 7, true);
    add_force(&twins, PHYS_GRAVITY); // gravity has no bounded range
    FRAMES(&twins, 2, false);
    begin_forces(&twins);
    FRAMES(&twins, 7, true);
    change_particle(&twins, 100, 4, 1); // forces of large particles are summed in column order
    FRAMES(&twins, 2, false);
    change_particle(&twins, 100, 0.5, 1);
    move_particle(&twins, 17, NAN);
    FRAMES(&twins, 7, true);
    move_particle(&twins, 17, 1);
    change_particle(&twins, 18, 0, 1);
    FRAMES(&twins, 3, true);
    phys_set_options(twins.listed, &never);
    FRAMES(&twins, 1, false);
    phys_set_options(twins.listed, options);
    begin_systems(&twins, COUNT, 1, true); // the new description has the same number of particles, each with its own
                                           // force
    FRAMES(&twins, 3, true);
    begin_systems(&twins, COUNT, 1, false);
    FRAMES(&twins, 1, true);
    begin_systems(&twins, COUNT - 1, 1, true);
    FRAMES(&twins, 1, true);
    begin_systems(&twins, COUNT - 1, 2, false);
    FRAMES(&twins, 3, true);
    phys_free(twins.plain);
    phys_free(twins.listed);
}

static bool interrupt_later(void *user_data) {
    int *calls_left = user_data;
    return --*calls_left == 0;
}

// A frame is interrupted at each place where this is possible, then repeated. What it had prepared for the next step is
// not used.
static void test_interrupted_frames_leave_no_trace(void **state) {
    (void)state;
    int calls_left;
    atomic_bool interrupt;
    Budget budget = {.memory_limit = SIZE_MAX, .should_interrupt = interrupt_later, .user_data = &calls_left};
    PhysResult result = {.status = PHYS_STOPPED};
    int call = 1;
    for (; result.status == PHYS_STOPPED; call++) {
        Twins twins = twins_of(
            2, &(PhysOptions){
                   .threads = 2, .cpu = cpu_detected.level, .neighbours = PHYS_NEIGHBOURS_ALWAYS, .budget = &budget});
        begin_systems(&twins, COUNT, 1, false);
        for (int i = 0; i < 2; i++) {
            atomic_store(&interrupt, false);
            calls_left = 0;
            budget_begin(&budget, UINT64_MAX, &interrupt);
            FRAMES(&twins, 2, true);
            double now = twins.frame * 0.04;
            calls_left = call;
            result = phys_simulate(twins.listed, &(PhysTime){.last = now,
                                                             .now = now + 0.04,
                                                             .clock = now,
                                                             .resolution = 0.01,
                                                             .lockstep = true,
                                                             .performance = 1});
            if (result.status != PHYS_STOPPED)
                break;
        }
        phys_free(twins.plain);
        phys_free(twins.listed);
    }
    assert_int_equal(result.status, PHYS_OK);
    assert_true(call > 2 * 4); // each of the four steps can be interrupted twice
}

// While no particle moves, lists are not rebuilt, with and without reordered columns.
static void test_resting_particles_keep_lists(void **state) {
    (void)state;
    enum { DISTANT = 200, STEPS = 20 };
    for (int linked = 0; linked <= 1; linked++) {
        PhysSystem *system = phys_new();
        phys_set_options(system,
                         &(PhysOptions){.threads = 2, .cpu = cpu_detected.level, .neighbours = PHYS_NEIGHBOURS_ALWAYS});
        phys_begin(system, 2);
        for (uint32_t i = 0; i < DISTANT; i++)
            phys_add_particle(system, 0,
                              &(PhysParticle){.position = VEC(i % 20 * 1.1, i / 20 * 1.1), .radius = 0.5, .mass = 1});
        PhysForce collision = force_of(PHYS_COLLISION), link = force_of(PHYS_DISTANCE);
        link.strength = 0;
        link.to = 1;
        phys_add_force(system, 0, &collision);
        if (linked)
            phys_add_force(system, 0, &link);
        assert_int_equal(run_until(system, STEPS, 1).steps, STEPS);
        assert_int_equal(system->column_order, linked ? ORDER_FIXED : ORDER_BY_CELL);
        assert_true(phys_list_is_built(&system->lists[0]));
        assert_int_equal(system->lists[0].age, STEPS);
        phys_free(system);
    }
}

static void test_all_levels(void **state) {
    (void)state;
    for (int cpu = 0; cpu <= (int)cpu_detected.level; cpu++)
        for (size_t n = 2; n <= 3; n++)
            check_changes(
                n, &(PhysOptions){.threads = cpu + 1, .cpu = (CpuLevel)cpu, .neighbours = PHYS_NEIGHBOURS_ALWAYS});
}

static void test_kept_forces(void **state) {
    (void)state;
    check_changes(
        2, &(PhysOptions){
               .threads = 4, .keep_forces = true, .cpu = cpu_detected.level, .neighbours = PHYS_NEIGHBOURS_ALWAYS});
}

// Enough particles for several chunks per thread. Equal systems on one thread and on several threads store the forces
// or do not.
static void test_threads_and_kept_forces_do_not_change_results(void **state) {
    (void)state;
    enum { MANY = 40000, ROW = 200, STEPS = 4, SYSTEMS = 4 };
    PhysSystem *systems[SYSTEMS];
    for (int s = 0; s < SYSTEMS; s++) {
        systems[s] = phys_new();
        phys_set_options(systems[s], &(PhysOptions){.threads = s < 2 ? 1 : 4,
                                                    .keep_forces = s % 2,
                                                    .cpu = cpu_detected.level,
                                                    .neighbours = PHYS_NEIGHBOURS_ALWAYS});
        phys_begin(systems[s], 2);
        Dice dice = {5};
        for (uint32_t i = 0; i < MANY; i++) {
            double place[] = {i % ROW * 0.95, i / ROW * 0.95}, velocity[] = {dice_next(&dice) % 9 - 4.0, i % 5 - 2.0};
            phys_add_particle(systems[s], 0,
                              &(PhysParticle){.position = place, .velocity = velocity, .radius = 0.5, .mass = 1});
        }
        PhysForce collision = force_of(PHYS_COLLISION);
        collision.strength = 300;
        phys_add_force(systems[s], 0, &collision);
        for (int f = 0; f < STEPS; f++) {
            PhysTime time = {.last = f * 0.01, .now = (f + 1) * 0.01, .resolution = 0.01, .performance = 1};
            time.keep_last_finite = f % 2;
            assert_int_equal(phys_simulate(systems[s], &time).status, PHYS_OK);
        }
        assert_int_equal(systems[s]->column_order, ORDER_BY_CELL);
    }
    for (int s = 1; s < SYSTEMS; s++) {
        for (uint32_t i = 0; i < MANY; i++)
            assert_memory_equal(phys_position(systems[0], i), phys_position(systems[s], i), 4 * sizeof(double));
        phys_free(systems[s]);
    }
    phys_free(systems[0]);
}

// Sparse systems in strips that are two cells wide. Consecutive particles can be several rows of cells apart.
static void test_narrow_strips_equal_the_sum_over_all_pairs(void **state) {
    (void)state;
    enum { MANY = 48, SEEDS = 200 };
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        PhysSystem *systems[2];
        for (int s = 0; s < 2; s++) {
            Dice dice = {seed};
            systems[s] = phys_new();
            phys_set_options(systems[s],
                             &(PhysOptions){.threads = 1,
                                            .cpu = cpu_detected.level,
                                            .neighbours = s ? PHYS_NEIGHBOURS_ALWAYS : PHYS_NEIGHBOURS_NEVER});
            phys_begin(systems[s], 2);
            for (uint32_t i = 0; i < MANY; i++) {
                double y = dice_between(&dice, 0, 30), x = dice_between(&dice, y < 2 ? 1.5 : 0, 3);
                phys_add_particle(systems[s], 0, &(PhysParticle){.position = VEC(x, y), .radius = 0.5, .mass = 1});
            }
            PhysForce collision = force_of(PHYS_COLLISION);
            phys_add_force(systems[s], 0, &collision);
            one_step(systems[s]);
        }
        for (uint32_t i = 0; i < MANY; i++)
            assert_memory_equal(phys_position(systems[0], i), phys_position(systems[1], i), 4 * sizeof(double));
        phys_free(systems[0]);
        phys_free(systems[1]);
    }
}

// ---- systems that change in any state ----

enum { MAX_DIMENSIONS = 40, MAX_GROUPS = 3 };

// Describes a random system, twice.
static void describe_any(Twins *twins, Dice *dice) {
    static const uint32_t dimensions[] = {1, 2, 2, 3, 3, 4, 5, 6, 8, 13, MAX_DIMENSIONS},
                          counts[] = {0, 1, 5, 150, 150, 150};
    uint32_t count = counts[dice_below(dice, COUNT_OF(counts))],
             groups = 1 + dice_below(dice, 9) / 6 * dice_below(dice, MAX_GROUPS);
    bool pushed = dice_below(dice, 2), equal = dice_below(dice, 2);
    uint64_t seed = dice_next(dice);
    twins->dimensions = dimensions[dice_below(dice, COUNT_OF(dimensions))];
    PhysSystem *systems[] = {twins->plain, twins->listed};
    for (int s = 0; s < 2; s++) {
        Dice own = {seed};
        phys_begin(systems[s], (uint32_t)twins->dimensions);
        for (uint32_t g = 1; g < groups; g++)
            phys_add_group(systems[s], dice_below(&own, g));
        for (uint32_t i = 0; i < count; i++) {
            double place[MAX_DIMENSIONS], velocity[MAX_DIMENSIONS], force[MAX_DIMENSIONS];
            for (int k = 0; k < MAX_DIMENSIONS; k++) {
                place[k] = dice_between(&own, 0, k < 2 ? 12 : 1);
                velocity[k] = dice_between(&own, -1, 1);
                force[k] = dice_between(&own, -1, 1);
            }
            PhysParticle p = {.position = place, .velocity = velocity, .radius = 0.5, .mass = 1};
            if (!equal) {
                p.radius = dice_between(&own, 0, 0.6);
                p.charge = dice_between(&own, -1, 1);
                p.anchor = dice_below(&own, 9) == 0;
            }
            p.force = pushed ? force : NULL;
            p.ease = pushed ? i % 3 : 0;
            phys_add_particle(systems[s], i % groups, &p);
        }
    }
}

// Replaces the forces of both systems by random ones. Most of them permit neighbour lists in cell order.
static void choose_forces(Twins *twins, Dice *dice) {
    uint32_t count = 1 + dice_below(dice, 12) * dice_below(dice, 2), groups = phys_group_count(twins->plain);
    phys_begin_forces(twins->plain);
    phys_begin_forces(twins->listed);
    for (uint32_t f = 0; f < count; f++) {
        bool any = f > 0 && dice_below(dice, 3) == 0;
        PhysForce force = force_of(any ? (PhysForceKind)dice_below(dice, PHYS_FORCE_KINDS) : PHYS_COLLISION);
        double vectors[2][MAX_DIMENSIONS] = {{0.5, 1}, {0, 1}};
        force.vector = vectors[0];
        force.vector2 = vectors[1];
        if (twins->dimensions == 1)
            vectors[1][0] = 1;
        force.strength = dice_between(dice, 0, 20);
        force.max_distance = dice_below(dice, 2) ? 0 : 1;
        force.theta = dice_below(dice, 2) ? 0 : 0.5;
        force.has_maximum = true;
        force.maximum = dice_between(dice, 0, 10);
        force.from = dice_below(dice, 200);
        force.to = dice_below(dice, 200);
        uint32_t group = groups > 1 ? dice_below(dice, groups) : 0;
        phys_add_force(twins->plain, group, &force);
        phys_add_force(twins->listed, group, &force);
    }
}

static void update_any(Twins *twins, Dice *dice) {
    uint32_t count = phys_particle_count(twins->plain);
    if (!count)
        return;
    double numbers[MAX_DIMENSIONS];
    for (int k = 0; k < MAX_DIMENSIONS; k++)
        numbers[k] = dice_between(dice, 0, 3);
    PhysParticle p = {.position = numbers, .velocity = numbers, .radius = dice_between(dice, 0, 1), .mass = 1};
    p.force = dice_below(dice, 2) ? numbers : NULL;
    p.ease = dice_below(dice, 2);
    uint32_t handle = dice_below(dice, count);
    PhysPreserve preserve = {.position = dice_below(dice, 2), .velocity = dice_below(dice, 2)};
    phys_update_particle(twins->plain, handle, &p, preserve);
    phys_update_particle(twins->listed, handle, &p, preserve);
}

// Simulates a frame. The system with lists is first interrupted at the call with this number, if that call is made.
static void frame_of_any(Twins *twins, Budget *budget, atomic_bool *interrupt, int call, int *calls_left) {
    PhysTime time = {.last = twins->frame * 0.02, .now = twins->frame * 0.02 + 0.02, .resolution = 0.01};
    time.clock = time.last;
    time.lockstep = true;
    time.keep_last_finite = twins->frame % 3 > 0;
    twins->frame++;
    assert_int_equal(phys_simulate(twins->plain, &time).status, PHYS_OK);
    for (int attempt = 0; attempt < 2; attempt++) {
        atomic_store(interrupt, false);
        *calls_left = attempt ? 0 : call;
        budget_begin(budget, UINT64_MAX, interrupt);
        PhysStatus status = phys_simulate(twins->listed, &time).status;
        if (status == PHYS_OK)
            break;
        assert_int_equal(attempt, 0);
        assert_int_equal(status, PHYS_STOPPED);
    }
    check_same(twins, __LINE__);
}

// Dimensions, numbers of particles, groups, kinds of forces, attributes and options change in every state of a system
// and of the order of its columns, also after an interrupted frame.
static void test_anything_changes_in_any_state(void **state) {
    (void)state;
    enum { SEEDS = 40, CHANGES = 60 };
    int wider_from_cell_order = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        Dice dice = {seed * UINT64_C(0x9e3779b97f4a7c15)};
        int calls_left = 0;
        atomic_bool interrupt = false;
        Budget budget = {.memory_limit = SIZE_MAX, .should_interrupt = interrupt_later, .user_data = &calls_left};
        PhysOptions options = {.cpu = (CpuLevel)(seed % (cpu_detected.level + 1u)),
                               .threads = 1 + (int)(seed / 8 % 2),
                               .neighbours = PHYS_NEIGHBOURS_ALWAYS,
                               .budget = &budget};
        Twins twins = twins_of(2, &options);
        for (int change = 0; change < CHANGES; change++) {
            bool by_cell = twins.listed->column_order == ORDER_BY_CELL;
            switch (dice_below(&dice, 5)) {
            case 0:
            case 1:
                describe_any(&twins, &dice);
                choose_forces(&twins, &dice);
                wider_from_cell_order += by_cell && twins.dimensions > PHYS_VECTOR_DIMENSIONS;
                break;
            case 2:
                choose_forces(&twins, &dice);
                break;
            case 3:
                update_any(&twins, &dice);
                break;
            default:
                options.keep_forces = dice_below(&dice, 2);
                options.neighbours = dice_below(&dice, 4) ? PHYS_NEIGHBOURS_ALWAYS : PHYS_NEIGHBOURS_AUTO;
                phys_set_options(twins.listed, &options);
            }
            for (uint32_t f = dice_below(&dice, 4); f > 0; f--)
                frame_of_any(&twins, &budget, &interrupt, 1 + (int)dice_below(&dice, 20), &calls_left);
        }
        phys_free(twins.plain);
        phys_free(twins.listed);
    }
    assert_true(wider_from_cell_order > SEEDS);
}

TEST_GROUP(reorder) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all_levels),
                                       cmocka_unit_test(test_anything_changes_in_any_state),
                                       cmocka_unit_test(test_kept_forces),
                                       cmocka_unit_test(test_interrupted_frames_leave_no_trace),
                                       cmocka_unit_test(test_resting_particles_keep_lists),
                                       cmocka_unit_test(test_threads_and_kept_forces_do_not_change_results),
                                       cmocka_unit_test(test_narrow_strips_equal_the_sum_over_all_pairs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
