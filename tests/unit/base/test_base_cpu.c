// test_base_cpu.c: PETRI_CPU limits the detected level. meson also runs this test with other values of PETRI_CPU.
#include "base/cpu.h"
#include "check.h"

#include <stdlib.h>

static void test_environment_limits_detected_level(void **state) {
    (void)state;
    const char *wish = getenv("PETRI_CPU");
    const char *use = wish ? wish + strcspn(wish, "+-") : "";
    assert_int_equal(cpu_detected.use_fma, !cpu_detected.fma      ? CPU_FMA_NEVER
                                           : !strcmp(use, "+fma") ? CPU_FMA_ALWAYS
                                                                  : CPU_FMA_FASTER);
    if (wish && !strcmp(wish, "scalar")) {
        assert_int_equal(cpu_detected.level, CPU_SCALAR);
        assert_false(cpu_detected.fma);
        assert_false(cpu_detected.sha256);
        return;
    }
    if (wish && !strncmp(wish, "avx2", 4))
        assert_true(cpu_detected.level <= CPU_AVX2);
#if defined(__x86_64__)
    assert_int_equal(cpu_detected.level > CPU_SCALAR, __builtin_cpu_supports("avx2") != 0);
    bool allowed = cpu_detected.level > CPU_SCALAR && strcmp(use, "-fma");
    assert_int_equal(cpu_detected.fma, allowed && __builtin_cpu_supports("fma"));
#endif
}

static void test_requested_level_is_limited(void **state) {
    (void)state;
    static const struct {
        const char *wish;
        bool known;
        CpuLevel at_most;
    } rows[] = {
        {NULL, true, CPU_AVX512}, {"", true, CPU_AVX512},       {"scalar", true, CPU_SCALAR},
        {"avx2", true, CPU_AVX2}, {"avx512", true, CPU_AVX512}, {"none", false, CPU_AVX512},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        CpuLevel level;
        assert_int_equal(cpu_choose(rows[i].wish, &level), rows[i].known);
        assert_int_equal(level, cpu_detected.level < rows[i].at_most ? cpu_detected.level : rows[i].at_most);
    }
}

TEST_GROUP(base_cpu) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_environment_limits_detected_level),
                                       cmocka_unit_test(test_requested_level_is_limited)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
