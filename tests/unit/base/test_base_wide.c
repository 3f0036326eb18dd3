// test_base_wide.c: tests of lib/base/wide.h without integers of 128 bits, which compilers for 32 bits lack.
#ifdef __SIZEOF_INT128__
#define HAS_WIDE
#undef __SIZEOF_INT128__
#endif
#include "base/wide.h"
#include "check.h"

static const uint64_t numbers[] = {
    0, 1, UINT32_MAX, UINT64_C(1) << 32, UINT64_C(0x123456789abcdef), UINT64_C(1) << 63, UINT64_MAX - 1, UINT64_MAX};

static void test_limits_of_products_are_exact(void **state) {
    (void)state;
    Wide largest = wide_multiply_add(UINT64_MAX, UINT64_MAX, UINT64_MAX);
    assert_int_equal(largest.high, UINT64_MAX); // 2^64 (2^64 - 1)
    assert_int_equal(largest.low, 0);
    Wide square = wide_multiply_add(UINT64_C(1) << 32, UINT64_C(1) << 32, 7);
    assert_int_equal(square.high, 1);
    assert_int_equal(square.low, 7);
}

static void test_products_equal_those_of_128_bits(void **state) {
    (void)state;
#ifdef HAS_WIDE
    enum { COUNT = sizeof numbers / sizeof *numbers };
    for (size_t i = 0; i < COUNT * COUNT * COUNT; i++) {
        uint64_t a = numbers[i % COUNT], b = numbers[i / COUNT % COUNT], c = numbers[i / COUNT / COUNT];
        __extension__ unsigned __int128 expected = a;
        expected = expected * b + c;
        Wide product = wide_multiply_add(a, b, c);
        assert_int_equal(product.low, (uint64_t)expected);
        assert_int_equal(product.high, (uint64_t)(expected >> 64));
    }
#endif
}

TEST_GROUP(base_wide) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_limits_of_products_are_exact),
        cmocka_unit_test(test_products_equal_those_of_128_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
