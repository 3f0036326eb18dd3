// test_maths_random.c: tests of random streams and trigonometry in turns, with the examples of builtins.md B9 and B1.2.
#include "check.h"
#include "maths/random.h"

static const uint64_t empty_key = UINT64_C(0xe220a8397b1dcdaf), one_key = UINT64_C(0x03953eea0e693074);

static void test_raw_items_match_spec(void **state) {
    (void)state;
    assert_true(random_raw(one_key, 1) == UINT64_C(0x8175f7480693d57d));
    assert_true(random_raw(one_key, 0) == random_raw(one_key, 0));
    assert_true(random_raw(one_key, 1) != random_raw(empty_key, 1));
}

static void test_seed_hash_matches_spec(void **state) {
    (void)state;
    assert_true(RANDOM_HASH_START == empty_key);
    assert_true(random_hash_step(RANDOM_HASH_START, random_hash_number(1)) == one_key);
    static const struct {
        double x;
        uint64_t bits;
    } rows[] = {{1, 0x3ff0000000000000},
                {1.9, 0x3ff0000000000000},
                {-0.3, 0xbff0000000000000},
                {0, 0},
                {-0.0, 0x8000000000000000},
                {INFINITY, 0x7ff0000000000000},
                {0.5, 0},
                {-INFINITY, 0xfff0000000000000},
                {NAN, 0x7ff8000000000000},
                {-NAN, 0x7ff8000000000000}};
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_true(random_hash_number(rows[i].x) == rows[i].bits);
}

static void test_uniform_items_match_spec(void **state) {
    (void)state;
    static const double from_empty[] = {0.11377270426292592, 0.12216453115897499, 0.16838215125240424,
                                        0.0731532577968758};
    for (size_t i = 0; i < COUNT_OF(from_empty); i++)
        assert_number("uniform()", random_uniform(empty_key, i), from_empty[i]);
    static const struct {
        uint64_t i;
        double x;
    } rows[] = {{0, 0.3236437711805903},
                {1, 0.5057062674373606},
                {2, 0.17853683594231115},
                {UINT64_MAX, 0.9828360224742672},
                {UINT64_C(1000000000000000), 0.2866916867763784}};
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_number("uniform(1)", random_uniform(one_key, rows[i].i), rows[i].x);
}

static void test_beta_and_normal_items_match_spec(void **state) {
    (void)state;
    assert_number("beta()[0]", random_beta(empty_key, 0), 0.12216453115897499);
    assert_number("beta(1)[0]", random_beta(one_key, 0), 0.3236437711805903);
    assert_number("beta(1)[1]", random_beta(one_key, 1), 0.6619503345041775);
    static const double normal[] = {-1.5011077911134676, -0.05384309512351037, -1.3848472029966286, 1.2361710621158093};
    for (size_t i = 0; i < COUNT_OF(normal); i++)
        assert_number("normal(1)", random_normal(one_key, i), normal[i]);
    assert_number("normal()[0]", random_normal(empty_key, 0), 1.5003277345391304);
    for (uint64_t i = 0; i < 10000; i++) { // the median does not depend on the order of the three numbers
        double a = random_uniform(one_key, 4 * i), b = random_uniform(one_key, 4 * i + 1),
               c = random_uniform(one_key, 4 * i + 2), m = random_beta(one_key, i);
        assert_true(m == a || m == b || m == c);
        assert_true((m <= a) + (m <= b) + (m <= c) >= 2 && (m >= a) + (m >= b) + (m >= c) >= 2);
        assert_true(isfinite(random_normal(one_key, i)));
    }
}

static void test_quarter_turns_are_exact(void **state) {
    (void)state;
    static const double sines[] = {0, 1, -0.0, -1}, cosines[] = {1, -0.0, -1, 0};
    for (int k = 0; k < 1000; k++) {
        assert_number("sine", turns_sin(k * 0.25), sines[k % 4]);
        assert_number("cosine", turns_cos(k * 0.25), cosines[k % 4]);
        assert_true(turns_sin(k * -0.25) == -sines[k % 4]);
    }
    assert_number("sin(0.1)", turns_sin(0.1), 0.5877852522924731);
    assert_number("cos(0.1)", turns_cos(0.1), 0.8090169943749475);
    assert_number("sin(-0.3)", turns_sin(-0.3), -0.9510565162951536);
    assert_number("nan", turns_sin(NAN), NAN);
    assert_number("inf", turns_sin(INFINITY), NAN);
    assert_number("-inf", turns_cos(-INFINITY), NAN);
}

// Computes the definition in B1.2 with remquo.
static double sine_by_remquo(double t) {
    if (t < 0)
        return -sine_by_remquo(-t);
    int quadrant = 0;
    double angle = remquo(t * 4, 1.0, &quadrant) * 1.5707963267948966;
    double part = quadrant & 1 ? cos(angle) : sin(angle);
    return quadrant & 2 ? -part : part;
}

static void test_sine_of_turns_matches_remquo(void **state) {
    (void)state;
    static const double scales[] = {1e-300, 1e-3, 1, 50, 1e6, 2e8, 3e8, 1e15, 1e17, 1e300};
    for (size_t k = 0; k < COUNT_OF(scales); k++)
        for (uint64_t i = 0; i < 2000; i++) {
            double t = (random_uniform(k, i) - 0.5) * scales[k];
            t = i % 3 ? t : rint(t * 8) / 8; // every third argument is a tie or a quarter turn
            double found = turns_sin(t), wanted = sine_by_remquo(t);
            assert_memory_equal(&found, &wanted, sizeof found);
        }
    static const double odd[] = {0.0, -0.0, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < COUNT_OF(odd); i++) {
        double found = turns_sin(odd[i]), wanted = sine_by_remquo(odd[i]);
        assert_true(isnan(found) ? isnan(wanted) : memcmp(&found, &wanted, sizeof found) == 0);
    }
}

TEST_GROUP(maths_random) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sine_of_turns_matches_remquo),     cmocka_unit_test(test_raw_items_match_spec),
        cmocka_unit_test(test_seed_hash_matches_spec),           cmocka_unit_test(test_uniform_items_match_spec),
        cmocka_unit_test(test_beta_and_normal_items_match_spec), cmocka_unit_test(test_quarter_turns_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
