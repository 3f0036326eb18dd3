// test_predicates.c: tests of exact volumes, and of their conversion to doubles.
#include "check.h"
#include "solid/predicates.h"

#include <math.h>

enum { MAX_COORDINATE = (1 << 29) + (1 << 18) }; // half the largest difference
static const int32_t extremes[] = {-MAX_COORDINATE, 1 - MAX_COORDINATE, -1, 0, 1, MAX_COORDINATE - 1, MAX_COORDINATE};
enum { EXTREMES = sizeof extremes / sizeof *extremes };

static uint64_t next_random(uint64_t *seed) {
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (*seed >> 33) * UINT64_C(0x9e3779b97f4a7c15);
}

// Fills the corners of a tetrahedron with extreme or random coordinates.
static void set_corners(uint64_t *seed, Position corners[4]) {
    for (int i = 0; i < 12; i++) {
        uint64_t random = next_random(seed);
        int32_t any = (int32_t)(random >> 20) % MAX_COORDINATE;
        corners[i / 3][i % 3] = random % 3 ? extremes[(random >> 8) % EXTREMES] : any >> (random >> 8) % 30;
    }
}

static Volume volume_in_order(Position p[4], const char *order) {
    return volume_of(p[order[0] - 'a'], p[order[1] - 'a'], p[order[2] - 'a'], p[order[3] - 'a']);
}

static void test_volumes_change_sign_when_two_corners_are_exchanged(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 100000; i++) {
        Position corners[4];
        set_corners(&seed, corners);
        Volume volume = volume_in_order(corners, "abcd"), turned = volume_in_order(corners, "bcad");
        assert_true(turned.high == volume.high && turned.low == volume.low);
        for (const char *order = "bacd\0acbd\0abdc\0dbca\0"; *order; order += 5) {
            Volume other = volume_in_order(corners, order);
            assert_int_equal(volume_sign(other), -volume_sign(volume));
            assert_true(volume_to_double(other) == -volume_to_double(volume));
        }
    }
}

static void test_largest_volume_is_exact(void **state) {
    (void)state;
    const int32_t f = 1 << 29;
    Volume volume = volume_of((Position){-f, -f, -f}, (Position){f, f, -f}, (Position){-f, f, f}, (Position){f, -f, f});
    assert_int_equal(volume_sign(volume), 1);
    assert_true(volume_to_double(volume) == 0x1p91); // twice the cube of the edge
    Volume flat = volume_of((Position){-f, -f, 7}, (Position){f, f, 7}, (Position){-f, f, 7}, (Position){f, 3, 7});
    assert_int_equal(volume_sign(flat), 0);
    assert_false(signbit(volume_to_double(flat)));
}

static void test_conversions_round_to_nearest_even(void **state) {
    (void)state;
    static const struct {
        Volume volume;
        double expected;
    } cases[] = {
        {{0, 1}, 1},
        {{-1, INT32_MAX}, -1},
        {{1 << 22, 1}, 0x1p53},                           // 2^53 + 1: a tie
        {{1 << 22, 3}, 0x1p53 + 4},                       // a tie, upwards
        {{-(1 << 22) - 1, INT32_MAX}, -0x1p53},           // -2^53 - 1
        {{INT64_C(1) << 61, 0}, 0x1p92},                  //
        {{(INT64_C(1) << 61) + 256, 0}, 0x1p92},          // a tie
        {{(INT64_C(1) << 61) + 256, 1}, 0x1p92 + 0x1p40}, // just above it
        {{(INT64_C(1) << 61) + 255, INT32_MAX}, 0x1p92},  // just below it
        {{-(INT64_C(1) << 61) - 257, INT32_MAX}, -0x1p92 - 0x1p40},
        {{(INT64_C(1) << 62) - 1, INT32_MAX}, 0x1p93},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_true(volume_to_double(cases[i].volume) == cases[i].expected);
}

#ifdef __SIZEOF_INT128__
__extension__ typedef __int128 Exact;

static void check(Volume volume, Exact expected) {
    assert_true((Exact)volume.high * (INT64_C(1) << 31) + volume.low == expected);
    assert_in_range(volume.low, 0, INT32_MAX);
    assert_int_equal(volume_sign(volume), (expected > 0) - (expected < 0));
    double nearest = (double)expected, converted = volume_to_double(volume);
    assert_memory_equal(&converted, &nearest, sizeof nearest);
}

static void test_volumes_equal_those_of_128_bits(void **state) {
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 300000; i++) {
        Position p[4];
        set_corners(&seed, p);
        Exact expected = 0;
        for (int k = 0; k < 3; k++)
            expected += (Exact)area_of(p[0], p[1], p[2], (k + 1) % 3, (k + 2) % 3) * ((int64_t)p[3][k] - p[0][k]);
        check(volume_in_order(p, "abcd"), expected);
    }
}

// Numbers of each length, two thirds of them at most 1 from the middle between two doubles.
static void test_conversions_equal_those_of_128_bits(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 300000; i++) {
        int bits = 1 + i % 92, lost = bits > 53 ? bits - 53 : 0;
        Exact number =
            (Exact)1 << bits |
            (((Exact)next_random(&seed) << 31 ^ (Exact)next_random(&seed)) >> (92 - bits) & (((Exact)1 << bits) - 1));
        if (lost > 0 && i % 3 > 0)
            number = (number >> lost << lost) + ((Exact)1 << (lost - 1)) + (int)(next_random(&seed) % 3) - 1;
        number = i & 1 ? -number : number;
        check((Volume){(int64_t)(number >> 31), (uint32_t)number & INT32_MAX}, number);
    }
}
#endif

TEST_GROUP(predicates) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volumes_change_sign_when_two_corners_are_exchanged),
        cmocka_unit_test(test_largest_volume_is_exact),
        cmocka_unit_test(test_conversions_round_to_nearest_even),
#ifdef __SIZEOF_INT128__
        cmocka_unit_test(test_volumes_equal_those_of_128_bits),
        cmocka_unit_test(test_conversions_equal_those_of_128_bits),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
