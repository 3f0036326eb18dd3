// test_recorded.c: some of the recorded systems of conformance/physics, rebuilt by hand; every digit must agree.
//
// The recordings come from an independent implementation, so they guard against an error that lib/physics and the
// reference of test_order share.
#include "support.h"

typedef struct Recorded {
    uint32_t handle;
    double position[3], velocity[3];
} Recorded;

// Simulates frames 1 … `frames` at 60 frames a second and compares.
static void check_recorded(PhysSystem *system, int frames, double resolution, size_t n, const Recorded *wanted,
                           size_t count) {
    PhysTime time = {.resolution = resolution, .lockstep = true};
    for (int frame = 1; frame <= frames; frame++) {
        time.now = frame / 60.0;
        time.clock = phys_simulate(system, &time).clock;
        time.last = time.now;
    }
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < n; k++) {
            assert_same(phys_position(system, wanted[i].handle)[k], wanted[i].position[k]);
            assert_same(phys_velocity(system, wanted[i].handle)[k], wanted[i].velocity[k]);
        }
    phys_free(system);
}

static PhysSystem *new_system(uint32_t dimensions) {
    PhysSystem *system = phys_new();
    phys_begin(system, dimensions);
    return system;
}

static void add_particle(PhysSystem *system, uint32_t group, PhysVector position, PhysVector velocity, double radius,
                         double mass) {
    PhysParticle p = {.position = position, .velocity = velocity, .radius = radius, .mass = mass};
    phys_add_particle(system, group, &p);
}

static void add_barrier(PhysSystem *system, PhysVector position, PhysVector normal, double restitution) {
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
    PhysForce force = force_of(PHYS_BARRIER);
    force.vector = position;
    force.vector2 = VEC(normal[0] / length, normal[1] / length);
    force.restitution = restitution;
    phys_add_force(system, 0, &force);
}

static void add_acceleration(PhysSystem *system, PhysVector acceleration) {
    PhysForce force = force_of(PHYS_CONSTANT);
    force.vector2 = acceleration;
    phys_add_force(system, 0, &force);
}

static void test_three_body(void **state) {
    (void)state;
    PhysSystem *system = new_system(2);
    add_particle(system, 0, VEC(1, 3), NULL, 0.05, 3);
    add_particle(system, 0, VEC(-2, -1), NULL, 0.05, 4);
    add_particle(system, 0, VEC(1, -1), NULL, 0.05, 5);
    PhysForce gravity = force_of(PHYS_GRAVITY);
    phys_add_force(system, 0, &gravity);
    const Recorded wanted[] = {
        {0, {-1.2570746157090325, -0.17299298697913965}, {2.2344691684766236, -0.41554840348164485}},
        {1, {0.46085096895947747, 0.7408606961051204}, {0.07298068359139138, 1.423919542125003}},
        {2, {0.3855639942578241, -0.48889276469661724}, {-1.3990660479590882, -0.8898065916110164}},
    };
    check_recorded(system, 560, 1 / 240.0, 2, wanted, COUNT_OF(wanted));
}

static void test_barrier_ramp(void **state) {
    (void)state;
    PhysSystem *system = new_system(2);
    add_particle(system, 0, VEC(-2, 6), NULL, 0.3, 1);
    add_particle(system, 0, VEC(0.5, 7), VEC(-1, 0), 0.5, 4);
    add_particle(system, 0, VEC(4, 5), VEC(-4, 0), 0, 1);
    add_acceleration(system, VEC(0, -9.81));
    add_barrier(system, VEC(0, 0), VEC(0.5, 1), 0.7);
    add_barrier(system, VEC(0, -2), VEC(0, 1), 0.9);
    const Recorded wanted[] = {
        {0, {0.3772589529637771, 2.126080737872447}, {5.334389015271813, -0.3710135684178924}},
        {1, {1.110593971824, 1.9630446199900529}, {5.700488489650508, 2.1823100987566604}},
        {2, {1.5637411175384324, 1.78814564658133}, {3.8386039817520548, 2.3361029537284304}},
    };
    check_recorded(system, 85, 1 / 120.0, 2, wanted, COUNT_OF(wanted));
}

static void test_barrier_rest(void **state) {
    (void)state;
    PhysSystem *system = new_system(2);
    add_particle(system, 0, VEC(0, 1.7), VEC(0.5, 0), 0.3, 1);
    add_acceleration(system, VEC(0, -9.8));
    add_barrier(system, VEC(0, 0), VEC(0, 1), 0);
    const Recorded dead[] = {{0, {0.2630952380952382, 0.3}, {0, -0.0}}};
    check_recorded(system, 114, 1 / 60.0, 2, dead, 1);
    system = new_system(2);
    add_particle(system, 0, VEC(0, 1.1), VEC(0.5, 0), 0.25, 3);
    add_acceleration(system, VEC(0, -9.8));
    add_barrier(system, VEC(0, 0), VEC(0.25, 1), 0.5);
    const Recorded soon[] = {
        {0, {0.8909575421501967, 0.03495471606355461}, {2.1866901808847598e-16, -5.4667254522118994e-17}}};
    check_recorded(system, 114, 1 / 60.0, 2, soon, 1);
}

// Springs between particles of any groups, with a collision force that never meets anybody.
static void test_groups_bridge(void **state) {
    (void)state;
    enum { A, B, C, D, TOP };
    PhysSystem *system = new_system(2);
    uint32_t first = phys_add_group(system, 0), inner = phys_add_group(system, first);
    uint32_t second = phys_add_group(system, 0), last = phys_add_group(system, second);
    add_particle(system, first, VEC(0, 0), NULL, 1, 1);
    add_particle(system, inner, VEC(1, 3), NULL, 0, 1);
    add_particle(system, second, VEC(0.5, 0), NULL, 1, 2);
    add_particle(system, last, VEC(4, 3), NULL, 0, 1);
    PhysParticle anchor = {.position = VEC(2, 6), .mass = 1, .anchor = true};
    phys_add_particle(system, 0, &anchor);
    const struct {
        uint32_t group;
        PhysForce force;
    } forces[] = {
        {first, {.kind = PHYS_COLLISION, .strength = 1, .power = 1}},
        {inner,
         {.from = B,
          .to = D,
          .has_minimum = true,
          .minimum = 2,
          .has_maximum = true,
          .maximum = 2,
          .strength = 30,
          .power = 1,
          .kind = PHYS_DISTANCE}},
        {second,
         {.from = A, .to = C, .has_minimum = true, .minimum = 3, .strength = 10, .power = 1, .kind = PHYS_DISTANCE}},
        {last,
         {.from = D, .to = TOP, .has_maximum = true, .maximum = 1, .strength = 5, .power = 2, .kind = PHYS_DISTANCE}},
        {0,
         {.from = A,
          .to = B,
          .has_maximum = true,
          .maximum = 2,
          .strength = 20,
          .power = 1,
          .ease = 0.3,
          .kind = PHYS_DISTANCE}},
    };
    for (size_t i = 0; i < COUNT_OF(forces); i++)
        phys_add_force(system, forces[i].group, &forces[i].force);
    const Recorded wanted[] = {
        {A, {-1.175847816686685, 6.123756736961817}, {0.3327298209718703, 3.746142753462857}},
        {B, {-1.2350206366149459, 3.2560379501196803}, {-1.0437077835293385, 4.4349358445641345}},
        {C, {4.601827283760924, -0.26787283840285053}, {3.4192031964159826, -0.24814819605978475}},
        {D, {-0.6499283834198667, 6.659590508607969}, {4.182029394916123, 3.6465879563709187}},
    };
    check_recorded(system, 81, 1 / 60.0, 2, wanted, COUNT_OF(wanted));
}

// A pair in a group that adheres, under a drag from above; and one of four that does so gradually.
static void test_adhesion(void **state) {
    (void)state;
    PhysSystem *system = new_system(2);
    uint32_t pair = phys_add_group(system, 0), group = phys_add_group(system, 0);
    add_particle(system, pair, VEC(0, 5), NULL, 1, 1);
    add_particle(system, pair, VEC(1.2, 5 + 0.2), NULL, 0.5, 0.5);
    add_particle(system, group, VEC(10, 0), NULL, 1, 1);
    add_particle(system, group, VEC(11.5, 0), NULL, 1, 1);
    add_particle(system, group, VEC(10.5, 1), NULL, 0.75, 1);
    add_particle(system, group, VEC(10.5, 0.5), NULL, 0, 1);
    PhysForce adhesion = force_of(PHYS_ADHESION), drag = force_of(PHYS_DRAG);
    adhesion.strength = 40;
    phys_add_force(system, pair, &adhesion);
    adhesion.strength = 20;
    adhesion.ease = 0.5;
    phys_add_force(system, group, &adhesion);
    drag.strength = 0.6;
    phys_add_force(system, 0, &drag);
    const Recorded wanted[] = {
        {0, {-0.01597820896259683, 4.997336965172899}, {-0.056218938322474515, -0.009369823053745863}},
        {1, {1.231054978597418, 5.205175829766237}, {0.11156072470611891, 0.01859345411768671}},
        {2, {9.936114102828455, -0.27754596236848816}, {-0.08719493900046153, 0.00012816734284968288}},
        {3, {11.357091980229333, 0.06317052738818184}, {0.1393817190060678, -0.05189408078374554}},
        {4, {10.708569267258127, 1.2255872354428439}, {-0.04871118878270895, 0.06272151396284391}},
        {5, {10.5, 0.5}, {0, 0}},
    };
    check_recorded(system, 90, 1 / 60.0, 2, wanted, COUNT_OF(wanted));
}

static void test_drag(void **state) {
    (void)state;
    PhysSystem *system = new_system(2);
    add_particle(system, 0, VEC(0, 0), NULL, 0.5, 1);
    add_particle(system, 0, VEC(0, 0), VEC(-3, 2), 1, 2);
    PhysForce drag = force_of(PHYS_DRAG);
    drag.vector = VEC(4, -1);
    drag.strength = 0.8;
    phys_add_force(system, 0, &drag);
    drag.vector = VEC(1, 1);
    drag.strength = 0.1;
    drag.ease = 1;
    phys_add_force(system, 0, &drag);
    const Recorded wanted[] = {
        {0, {2.576552330528603, -0.6077870962290715}, {2.6994246970778084, -0.5956857425650238}},
        {1, {1.7416203373088222, 0.23269082577563296}, {2.6027334564994047, -0.36587129118034967}},
    };
    check_recorded(system, 81, 1 / 60.0, 2, wanted, COUNT_OF(wanted));
}

static void test_soft_barriers(void **state) {
    (void)state;
    PhysSystem *system = new_system(2);
    add_particle(system, 0, VEC(0, 5), NULL, 0, 1);
    add_particle(system, 0, VEC(3, 2), VEC(1, 0), 0.2, 1);
    add_acceleration(system, VEC(0, -5));
    PhysForce barrier = force_of(PHYS_BARRIER);
    barrier.vector2 = VEC(0, 1);
    barrier.has_minimum = true;
    barrier.minimum = 1.5;
    barrier.strength = 60;
    barrier.power = 2;
    phys_add_force(system, 0, &barrier);
    barrier.has_minimum = false;
    barrier.has_maximum = true;
    barrier.maximum = 4;
    barrier.strength = 5;
    barrier.power = 0.5;
    barrier.ease = 0.5;
    phys_add_force(system, 0, &barrier);
    const Recorded wanted[] = {
        {0, {0, 3.3197227820772515}, {0, 4.642161152833157}},
        {1, {4.833333333333327, 1.7961391771082282}, {1, -1.3867076926296884}},
    };
    check_recorded(system, 110, 1 / 60.0, 2, wanted, COUNT_OF(wanted));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_three_body),    cmocka_unit_test(test_barrier_ramp), cmocka_unit_test(test_barrier_rest),
        cmocka_unit_test(test_groups_bridge), cmocka_unit_test(test_adhesion),     cmocka_unit_test(test_drag),
        cmocka_unit_test(test_soft_barriers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
